#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The sizes of every example design: against textbook formulas, and against goldens to be read.

Closed forms (closed_forms.py, apart from the program) hold to 1e-9. What has none stands in NAME.toml
beside this file, in as many digits as the named source vouches for; a golden is met within one of its last
digit.

  examples_test.py --update    writes the goldens anew, keeping their digits and words; look at the diff
"""
import decimal
import functools
import json
import os
import pathlib
import re
import subprocess
import sys
import tomllib
import unittest

import closed_forms

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
PROGRAM = os.environ.get("TRUEFLANK_PROGRAM", SOURCE / "build/trueflank")
EXAMPLES = sorted(p.parent.name for p in (SOURCE / "examples").glob("*/design.toml"))


@functools.cache
def report_of(name):
    run = subprocess.run([PROGRAM, "check", SOURCE / "examples" / name / "design.toml", "--json", "-"],
                         capture_output=True, check=False)
    return json.loads(run.stdout)


def value_at(report, path):
    value = report
    for key in path.split("/"):
        value = value[key]
    return value


class Examples(unittest.TestCase):
    def near(self, got, wanted, what):
        if wanted is None or got is None:
            self.assertIs(got, wanted, what)
        else:
            self.assertLessEqual(abs(got - wanted), 1e-9 * max(1.0, abs(wanted)), f"{what}: {got}, not {wanted}")

    def test_gears_have_the_sizes_of_the_closed_forms(self):
        compared = 0
        for name in EXAMPLES:
            for gear_name, gear in report_of(name)["gears"].items():
                for key, wanted in closed_forms.gear_sizes(gear).items():
                    self.near(gear[key], wanted, f"{name}: {gear_name}.{key}")
                    compared += 1
        self.assertGreater(compared, 200)

    def test_meshes_have_the_sizes_of_the_closed_forms(self):
        compared = 0
        for name in EXAMPLES:
            report = report_of(name)
            gears = report["gears"]
            for mesh_name, mesh in report.get("meshes", {}).items():
                inner, outer = (gears[gear] for gear in mesh_name.split("-"))
                if inner["internal"]:
                    inner, outer = outer, inner
                face = min(inner["face_width_mm"], outer["face_width_mm"])
                if inner["hand"] == "herringbone":  # of one half
                    face = 0.5 * (face - inner["relief_groove_mm"])
                # of several stages each has its own, and its gears end in its number
                train = report["train"]["stages"][int(mesh_name[-1]) - 1] if report["train"].get("stages") else report["train"]
                wanted = closed_forms.mesh_sizes(inner, outer, train["centre_distance_mm"], face,
                                                 report["efficiency"]["friction"])
                for key, value in wanted.items():
                    self.near(mesh[key], value, f"{name}: {mesh_name}.{key}")
                    compared += 1
        self.assertGreater(compared, 80)

    def test_goldens(self):
        goldens = sorted(HERE.glob("*.toml"))
        self.assertGreaterEqual(len(goldens), 4)
        for path in goldens:
            report = report_of(path.stem)
            for key, golden in tomllib.loads(path.read_text(), parse_float=decimal.Decimal).items():
                got = value_at(report, key)
                if isinstance(golden, decimal.Decimal):
                    last_digit = decimal.Decimal(1).scaleb(golden.as_tuple().exponent)
                    self.assertLessEqual(abs(decimal.Decimal(got) - golden), last_digit,
                                         f"{path.name}: {key} is {got}, golden {golden}")
                else:
                    self.assertEqual(got, golden, f"{path.name}: {key}")


def update():
    for path in sorted(HERE.glob("*.toml")):
        report = report_of(path.stem)

        def renewed(match):
            key, number = match.group(2), match.group(4)
            digits = len(number.partition(".")[2])
            return f"{match.group(1)}{key}{match.group(3)}{value_at(report, key):.{digits}f}"

        text = path.read_text()
        path.write_text(re.sub(r'^(")([^"\n]+)(" = )(-?\d+\.\d+)', renewed, text, flags=re.M))


if __name__ == "__main__":
    if "--update" in sys.argv:
        update()
    else:
        unittest.main()
