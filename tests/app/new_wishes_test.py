#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""trueflank new with a ratio: the design it writes passes every check, has the ratio and the size asked for."""
import json
import os
import pathlib
import re
import subprocess
import unittest

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
WHOLE = "TRUEFLANK_CAMPAIGN" in os.environ


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False, cwd=OUTPUT,
                          timeout=900)


class NewWishes(unittest.TestCase):
    def test_the_design_passes_and_is_what_was_asked_for(self):
        (OUTPUT / "joint.toml").unlink(missing_ok=True)
        made = run("new", "joint", "--kind", "3k", "--ratio", "96", "--motor", "nema17", "--process", "fdm-0.4",
                   "--material", "pla", "--bed", "220x220", "--outer-diameter", "90")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("for 96.000 asked", made.stdout)
        text = (OUTPUT / "joint.toml").read_text(encoding="utf-8")
        self.assertIn("# ratio", text)
        self.assertIn('bed = "220x220"', text)
        report = json.loads(run("check", "joint.toml", "--json", "-").stdout)
        self.assertEqual(report["verdict"], "pass")
        self.assertAlmostEqual(report["train"]["ratio"] / 96, 1, delta=0.02)
        size = [c["value"] for c in report["checks"] if c["id"] == "housing_size"]
        self.assertLessEqual(size[0], 90)
        # that the file exists is told before anything is searched for, and by that what else is wrong
        again = run("new", "joint", "--ratio", "96", "--outer-diameter", "4")
        self.assertEqual(again.returncode, 2)
        self.assertIn("exists", again.stderr)

    def test_every_kind_is_found_and_passes(self):
        motor = ("--motor", "nema17")
        kinds = (
                ("simple", ("--kind", "simple", *motor), 5),
                ("held_simple", ("--kind", "simple", "--output", "ring", *motor), 4),
                ("stepped", ("--kind", "stepped", *motor), 10),
                ("held_stepped", ("--kind", "stepped", "--output", "ring", *motor), 9),
                ("pair", ("--kind", "pair"), 3),
                ("boxed_pair", ("--kind", "pair", *motor), 3),
                ("split_ring", ("--input", "carrier", *motor), 40),
                ("type_two", ("--output", "ring1", "--motor", "nema14"), 60))
        # the gate: every kind of train once, and every part that may be held
        for name, wishes, ratio in kinds if WHOLE else (kinds[0], kinds[3], kinds[5], kinds[7]):
            with self.subTest(name):
                (OUTPUT / f"{name}.toml").unlink(missing_ok=True)
                made = run("new", name, "--ratio", str(ratio), *wishes)
                self.assertEqual(made.returncode, 0, made.stderr)
                report = json.loads(run("check", f"{name}.toml", "--json", "-").stdout)
                self.assertEqual(report["verdict"], "pass")
                self.assertAlmostEqual(abs(report["train"]["ratio"]) / ratio, 1, delta=0.02)
                size = [c["value"] for c in report["checks"] if c["id"] == "housing_size"]
                self.assertEqual(len(size), 1 if motor[0] in wishes else 0)
                for value in size:
                    self.assertLessEqual(value, 90)

    def test_what_cannot_be_met_names_what_can(self):
        wishes = ["--kind", "pair", "--ratio", "1.39", "--motor", "nema23"]
        told = run("new", "tight", *wishes, "--outer-diameter", "60")
        self.assertEqual(told.returncode, 2)
        self.assertIn("was tried and gives a design", told.stderr)
        larger = re.search(r"--outer-diameter (\d+)", told.stderr)
        self.assertIsNotNone(larger, told.stderr)
        (OUTPUT / "wider.toml").unlink(missing_ok=True)
        made = run("new", "wider", *wishes, "--outer-diameter", larger[1])
        self.assertEqual(made.returncode, 0, made.stderr)

    def test_a_round_shaft_that_glue_alone_would_hold_gets_a_flat(self):
        (OUTPUT / "filed.toml").unlink(missing_ok=True)
        made = run("new", "filed", "--input", "carrier", "--output", "ring1", "--ratio", "30", "--motor",
                   "outrunner-2212", "--outer-diameter", "120")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("file a flat on it", made.stdout)
        self.assertIn("flat_mm = 4.5", (OUTPUT / "filed.toml").read_text(encoding="utf-8"))
        self.assertEqual(json.loads(run("check", "filed.toml", "--json", "-").stdout)["verdict"], "pass")

    def test_a_carrier_on_the_shaft_has_as_thick_a_plate_as_the_flat_wants(self):
        (OUTPUT / "thick.toml").unlink(missing_ok=True)
        made = run("new", "thick", "--input", "carrier", "--output", "ring1", "--ratio", "12.8", "--motor", "nema17")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("plate_thickness_mm", (OUTPUT / "thick.toml").read_text(encoding="utf-8"))
        self.assertEqual(json.loads(run("check", "thick.toml", "--json", "-").stdout)["verdict"], "pass")

    def test_a_bearing_is_no_larger_than_the_process_bridges_its_seat(self):
        (OUTPUT / "bridged.toml").unlink(missing_ok=True)
        made = run("new", "bridged", "--input", "carrier", "--output", "ring1", "--ratio", "24.3", "--motor", "nema17",
                   "--process", "fdm-0.25", "--outer-diameter", "110")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(json.loads(run("check", "bridged.toml", "--json", "-").stdout)["verdict"], "pass")

    def test_a_motor_of_ones_own_comes_from_a_file(self):
        (OUTPUT / "workshop").mkdir(exist_ok=True)
        (OUTPUT / "workshop/tools.toml").write_text(
            "[motor.geared]\npilot_diameter_mm = 12\npilot_height_mm = 5\nbolt_circle_diameter_mm = 31\n"
            "bolt_count = 6\nthread_depth_mm = 5\nshaft_diameter_mm = 6\nshaft_length_mm = 21\nflat_mm = 5.5\n"
            "flat_length_mm = 12\ntorque_nm = 0.8\n", encoding="utf-8")
        (OUTPUT / "designs").mkdir(exist_ok=True)
        (OUTPUT / "designs/own.toml").unlink(missing_ok=True)
        wishes = ("--kind", "pair", "--ratio", "3", "--motor", "geared")
        made = run("new", "designs/own", *wishes, "--tools", "workshop/tools.toml")
        self.assertEqual(made.returncode, 0, made.stderr)
        report = json.loads(run("check", "designs/own.toml", "--json", "-").stdout)
        self.assertEqual(report["verdict"], "pass")
        told = run("new", "designs/none", *wishes, "--tools", "workshop/no.toml")
        self.assertEqual(told.returncode, 3)
        self.assertIn("workshop/no.toml", told.stderr)

    def test_what_is_not_known_is_told(self):
        for option, value in (("--motor", "nema18"), ("--process", "fdm-0.5"), ("--material", "cheese"),
                              ("--kind", "gear"), ("--kind", "stepped"), ("--input", "planet"), ("--bed", "tiny"),
                              ("--output", "carrier"), ("--outer-diameter", "4")):
            with self.subTest((option, value)):
                told = run("new", "other", "--ratio", "96", option, value)
                self.assertEqual(told.returncode, 2)
                self.assertIn("--ratio" if value == "stepped" else option, told.stderr)
                self.assertFalse((OUTPUT / "other.toml").exists())


if __name__ == "__main__":
    unittest.main()
