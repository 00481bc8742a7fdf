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


# its sun's tip stands in the planet's root; the tolerances ask for backlash too
JAMS = """format = 1
[gearbox]
kind = "simple"
planets = 5
module_mm = 0.5
helix_angle_deg = 30
backlash_mm = 0.01
centre_distance_mm = 7.0032
[made]
tolerance_class = 7
[sun]
teeth = 12
face_width_mm = 4
tip_diameter_mm = 8.036   # too long
[planet]
teeth = 12
face_width_mm = 4
[ring]
teeth = 38
shift = 0.175
face_width_mm = 4
"""


# a 3k set whose planets all mesh with one tooth less on its first ring
ONE_TOOTH = """format = 1
[gearbox]
kind = "3k"
output = "ring1"
planets = 3
module_mm = 2
backlash_mm = 0.06
[sun]
teeth = 12
face_width_mm = 16
[planet1]
teeth = 24
face_width_mm = 16
[ring1]
teeth = 61
face_width_mm = 16
[planet2]
teeth = 21
face_width_mm = 16
[ring2]
teeth = 57
face_width_mm = 16
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

    # one that only warns too, unless it is asked for
    warning = PASSING.replace("teeth = 24", "teeth = 12").replace('kind = "pair"', 'kind = "pair"\ntips = "standard"')
    warns = lambda path: [c["id"] for c in json.loads(path.read_text())["checks"] if c["status"] == "warn"]
    design.write_text(warning)
    run("check", design, "-q", "--json", OUTPUT / "warns.json", code=0)
    assert "fillet_interference" in warns(OUTPUT / "warns.json"), warns(OUTPUT / "warns.json")
    assert "nothing is changed" in run("fix", design, "-o", fixed, code=0)
    assert fixed.read_text() == warning
    run("fix", design, "-o", fixed, "--warnings", "-q", code=0)
    run("check", fixed, "-q", "--json", OUTPUT / "warns.json", code=0)
    assert "fillet_interference" not in warns(OUTPUT / "warns.json"), fixed.read_text()

    # backlash is for tolerances: none is added for a tip that stands in a root
    design.write_text(JAMS)
    run("fix", design, "-o", fixed, "-q", code=0)
    run("check", fixed, "-q", code=0)
    assert tomllib.loads(fixed.read_text())["gearbox"]["backlash_mm"] < 0.15, fixed.read_text()

    # what cannot be made is told as `check` tells it
    design.write_text(FAILING.replace("# no shift yet", "bore_mm = 40"))
    run("check", design, "-q", code=2)
    run("fix", design, "-o", fixed, code=2)

    # standard output is the design alone
    design.write_text(FAILING)
    assert tomllib.loads(run("fix", design, "-o", "-", code=0)) == after

    # far too many planets: as many as fit
    crowded = OUTPUT / "crowded.toml"
    crowded.write_text('format = 1\n[gearbox]\nkind = "simple"\nplanets = 12\nmodule_mm = 1\n'
                       "[sun]\nteeth = 12\nface_width_mm = 8\n[planet]\nteeth = 60\nface_width_mm = 8\n[ring]\nteeth = 132\nface_width_mm = 8\n")
    run("fix", crowded, "-o", fixed, "-q", code=0)
    assert tomllib.loads(fixed.read_text())["gearbox"]["planets"] in (2, 3), fixed.read_text()

    # what no change near it mends: axes that stray by nearly the module
    hopeless = OUTPUT / "hopeless.toml"
    hopeless.write_text('format = 1\n[gearbox]\nkind = "pair"\nmodule_mm = 1\n'
                        "[pinion]\nteeth = 17\nface_width_mm = 8\n[wheel]\nteeth = 40\nface_width_mm = 8\n"
                        "[made]\naxis_tolerance_um = 900\n")
    said = run("fix", hopeless, "-o", fixed, code=1)
    assert "tolerance" in said and "still fails" in said, said
    told = run("check", hopeless, code=1)
    assert "still fails" in told and "trueflank fix DESIGN" in told, told
    run("fix", OUTPUT / "nothing.toml", "-o", fixed, code=3)
    hopeless.write_text("format = 2\n")
    run("fix", hopeless, "-o", fixed, code=2)

    # a gearbox: its housing as wide as it must be, its gears as far as that holds; `check` tells the same
    housed = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"]) / "examples/printed_actuator/design.toml"
    narrow = housed.read_text().replace("[housing]", "[housing]\nouter_diameter_mm = 60", 1)
    for text, changed in ((narrow, ["housing.outer_diameter_mm"]),
                          (narrow.replace("shift = 0.67", "shift = -0.4"), ["housing.outer_diameter_mm", "ring1.shift"])):
        design.write_text(text)
        run("check", design, "-q", "--json", OUTPUT / "housed.json", code=1)
        told = json.loads((OUTPUT / "housed.json").read_text())["joint_cure"]
        assert told["cured"] and set(changed) == {c["key"] for c in told["changes"]}, told
        said = run("fix", design, "-o", fixed, code=0)
        for change in told["changes"]:
            assert change["key"] in said and (change["after"] or "-") in said, (change, said)
        run("check", fixed, "-q", code=0)

    # a tooth too many: one tooth, and nothing that goes with such a change elsewhere
    design.write_text(ONE_TOOTH)
    run("check", design, "-q", code=1)
    run("fix", design, "-o", fixed, "-q", code=0)
    text = fixed.read_text()
    was, now = ([tables["teeth"] for tables in tomllib.loads(t).values() if isinstance(tables, dict) and "teeth" in tables]
                for t in (ONE_TOOTH, text))
    assert sum(abs(a - b) for a, b in zip(was, now)) == 1 and "centre_distance_mm" not in text, text


main()
