# SPDX-License-Identifier: GPL-3.0-or-later
"""The fix command: a failing design mended, its comments kept, the mended one passes `check`; exit codes."""
import json
import os
import pathlib
import shutil
import subprocess
import tomllib

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "fix"
FAILING = """# a ring and a pinion of nearly its size
format = 1
name = "near"     # our name

[gearbox]
kind = "pair"
module_mm = 1.0   # from the catalogue
backlash_mm = 0.05

[pinion]
teeth = 25
face_width_mm = 10
# no shift yet

[wheel]
internal = true
teeth = 29        # 4 more
face_width_mm = 10
"""
PASSING = """format = 1
[gearbox]
kind = "pair"
module_mm = 1.0
backlash_mm = 0.05
[pinion]
teeth = 24
face_width_mm = 10
[wheel]
teeth = 60
face_width_mm = 10
"""


def run(*arguments, code):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout


def toml_text(tables):
    """A design file of plain values."""
    value = lambda v: json.dumps(v)
    text = "".join(f"{k} = {value(v)}\n" for k, v in tables.items() if not isinstance(v, dict))
    for table, keys in tables.items():
        if isinstance(keys, dict):
            text += f"[{table}]\n" + "".join(f"{k} = {value(v)}\n" for k, v in keys.items())
    return text


def check_tells_one_change(design):
    """Of all that fails, `check` prints one change, once; made by hand, it mends the design."""
    told = run("check", design, "--json", OUTPUT / "near.json", code=1)
    assert told.count("one change after which every check passes") == 1, told
    report = json.loads((OUTPUT / "near.json").read_text())
    cure = report["joint_cure"]
    assert cure["cured"] and cure["changes"] and cure["contradiction"] is None, cure
    assert not cure["still_failing"], cure
    for check in report["checks"]:
        assert check["status"] != "fail" or not check["cure"], check
    assert "neither a shorter tip" not in told, told
    for cost in (*cure["contact_ratio"].values(), *cure["efficiency"].values()):
        assert cost["before"] > 0 and cost["after"] > 0, cure
    tables = tomllib.loads(FAILING)
    for change in cure["changes"]:
        assert change["key"] in told, (change, told)
        table, key = change["key"].rsplit(".", 1)
        tables.setdefault(table, {}).pop(key, None)
        if change["after"] is not None:
            tables[table][key] = json.loads(change["after"])
    by_hand = OUTPUT / "by_hand.toml"
    by_hand.write_text(toml_text(tables))
    run("check", by_hand, "--json", OUTPUT / "by_hand.json", "-q", code=0)
    assert json.loads((OUTPUT / "by_hand.json").read_text())["joint_cure"] is None


def main():
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    design, fixed = OUTPUT / "near.toml", OUTPUT / "fixed.toml"
    design.write_text(FAILING)
    check_tells_one_change(design)
    table = run("fix", design, "-o", fixed, code=0)
    text = fixed.read_text()
    for comment in ("# a ring and a pinion of nearly its size\n", "# our name\n", "# from the catalogue\n",
                    "# no shift yet\n", "# 4 more\n"):
        assert comment in text, (comment, text)
    before, after = tomllib.loads(FAILING), tomllib.loads(text)
    changed = [f"{t}.{k}" for t, keys in after.items() if isinstance(keys, dict)
               for k, value in keys.items() if before.get(t, {}).get(k) != value]
    assert changed, text
    for key in changed:
        assert key in table, (key, table)
    assert "contact ratio pinion-wheel" in table and "efficiency forward" in table, table
    run("check", fixed, "--json", OUTPUT / "fixed.json", "-q", code=0)
    report = json.loads((OUTPUT / "fixed.json").read_text())
    assert not [c for c in report["checks"] if c["status"] == "fail"]

    # what passes is left as it is, to the byte
    design.write_text(PASSING)
    run("fix", design, "-o", fixed, "-q", code=0)
    assert fixed.read_text() == PASSING

    # standard output is the design alone
    design.write_text(FAILING)
    assert tomllib.loads(run("fix", design, "-o", "-", code=0)) == after

    # what no change near it mends: six planets as large as the sun's room
    hopeless = OUTPUT / "hopeless.toml"
    hopeless.write_text('format = 1\n[gearbox]\nkind = "simple"\nplanets = 12\nmodule_mm = 1\n'
                        "[sun]\nteeth = 12\nface_width_mm = 8\n[planet]\nteeth = 60\nface_width_mm = 8\n[ring]\nteeth = 132\nface_width_mm = 8\n")
    said = run("fix", hopeless, "-o", fixed, code=1)
    assert "planet_spacing" in said, said
    told = run("check", hopeless, code=1)
    assert "still fails" in told and "trueflank fix DESIGN" in told, told
    run("fix", OUTPUT / "nothing.toml", "-o", fixed, code=3)
    hopeless.write_text("format = 2\n")
    run("fix", hopeless, "-o", fixed, code=2)


main()
