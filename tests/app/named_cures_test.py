# SPDX-License-Identifier: GPL-3.0-or-later
"""What a check names as its cure is followed to the letter; zero has no sign: named_cures_test.py [DESIGNS] [FIRST_SEED].

Of random designs every value that a single check names (a tip diameter, a shift, a backlash, a rounding) is written into
the file as it was printed. The check must then no longer say what it said."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tomllib
from collections import Counter

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from random_designs import random_design  # noqa: E402

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
GEAR = "sun|planet1|planet2|planet|ring1|ring2|ring|pinion|wheel"
NAMED = [
    (rf"tip diameter of ({GEAR}) (?:of )?(?:below )?([\d.]+) mm", None, "tip_diameter_mm"),
    (r"tip diameter of (?:at (?:most|least) )?()([\d.]+) mm", None, "tip_diameter_mm"),
    (r"profile shift of at least ()(-?[\d.]+)", None, "shift"),
    (r"backlash_mm (?:= |of at least )()([\d.]+)", "gearbox", "backlash_mm"),
    (r"rack\.root_radius of at most ()([\d.]+)", "rack", "root_radius"),
]
MINUS_ZERO = re.compile(r"(?<![\w.])-0(\.0+)?(?![\d.eE])")


def toml_text(tables, prefix=""):
    text = "".join(f"{k} = {json.dumps(v)}\n" for k, v in tables.items() if not isinstance(v, dict))
    for name, keys in tables.items():
        if isinstance(keys, dict):
            text += f"[{prefix}{name}]\n" + toml_text(keys, f"{prefix}{name}.")
    return text


def checked(text):
    (OUTPUT / "design.toml").write_text(text)
    done = subprocess.run([PROGRAM, "check", OUTPUT / "design.toml", "-v", "--json", OUTPUT / "report.json"],
                          capture_output=True, text=True)
    if done.returncode == 2:
        return done, None
    assert done.returncode in (0, 1), done.stderr
    return done, json.loads((OUTPUT / "report.json").read_text())


def followed(text, finding, table, key, value):
    """What is wrong with following a cure; empty where it holds."""
    tables = tomllib.loads(text)
    tables.setdefault(table, {})[key] = float(value)
    done, report = checked(toml_text(tables))
    if report is None:
        return f"is refused: {done.stderr.splitlines()[0]}"
    now = next((c for c in report["checks"] if (c["id"], c["where"]) == (finding["id"], finding["where"])), None)
    better = now and (now["status"] in ("pass", "not_applicable") or (finding["status"], now["status"]) == ("fail", "warn"))
    said = finding["message"].split(";")
    if finding["id"] == "profile" and now:  # one finding for all that is not as asked
        better = better or len(now["message"].split(";")) < len(said)
    return "" if better else f"leaves {now and (now['status'], now['value'], now['limit'], now['message'])}"


def main():
    designs = int(sys.argv[1]) if len(sys.argv) > 1 else 80
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    OUTPUT.mkdir(parents=True, exist_ok=True)
    tried, wrong = Counter(), 0
    for seed in range(first, first + designs):
        text = random_design(seed)
        done, report = checked(text)
        for line in done.stdout.splitlines() + ((OUTPUT / "report.json").read_text().splitlines() if report else []):
            if MINUS_ZERO.search(line):
                wrong += 1
                print(f"seed {seed}: a zero with a sign: {line}")
        if report is None or "_in =" in text or "diametral" in text:  # keys in inches would be said twice
            continue
        gears = report["gears"]
        for finding in report["checks"]:
            left = finding["cure"]
            for pattern, place, key in NAMED:
                for match in re.finditer(pattern, left):
                    table = place or match.group(1) or finding["where"]
                    if place is None and table not in gears:
                        continue
                    tried[finding["id"]] += 1
                    what = followed(text, finding, table, key, match.group(2))
                    if what:
                        wrong += 1
                        print(f"seed {seed}: {finding['id']} {finding['where']}: {table}.{key} = {match.group(2)} {what}\n"
                              f"  named in: {finding['cure']}\n  because: {finding['message']}")
                left = re.sub(pattern, "", left)
    print(f"{sum(tried.values())} cures followed ({', '.join(f'{k} {v}' for k, v in sorted(tried.items()))}), {wrong} wrong")
    sys.exit(1 if wrong or sum(tried.values()) < designs / 8 else 0)


main()
