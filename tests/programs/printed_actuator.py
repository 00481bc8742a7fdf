#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The printed actuators and the boxed pair in PrusaSlicer: no plate needs repair, and plates hold every part that bom.csv says is
made, as often as it says. Plates are sliced without a warning: in the campaign all of them, as PrusaSlicer does by itself, else the boxed
pair's, with walls that are quick to lay out."""
import csv
import os
import pathlib
import re
import subprocess
import unittest
import zipfile
from collections import Counter

SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
BED = "0x0,250x0,250x210,0x210"  # prusa-mk4, as the design says
# Where a seam is seen least takes a third of the slicer's time, and asks nothing of a plate.
QUICK = ["--layer-height", "0.3", "--first-layer-height", "0.3", "--perimeters", "2", "--fill-density", "10%",
         "--seam-position", "rear"]
CAMPAIGN = "TRUEFLANK_CAMPAIGN" in os.environ
# Walls whose width varies (Arachne) take half of the slicer's time, and short segments of paths some. What it warns of is looked
# for before it lays out walls, and in layers that stay empty: of walls of one width more than of such.
QUICK += [] if CAMPAIGN else ["--perimeter-generator", "classic", "--gcode-resolution", "0.1"]


def run(*command):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, timeout=1500)
    return result.returncode, result.stdout + result.stderr


class PrintedActuator(unittest.TestCase):
    EXAMPLE, PLATES, SLICED = "printed_actuator", 2, 0

    @classmethod
    def setUpClass(cls):
        cls.design = SOURCE / "examples" / cls.EXAMPLE / "design.toml"
        cls.folder = OUTPUT / cls.EXAMPLE
        code, cls.told = run(PROGRAM, "make", cls.design, "-o", cls.folder, "--formats", "3mf", "--tolerance-um", "20")
        assert code == 0, cls.told
        cls.plates = sorted(cls.folder.glob("plate_*.3mf"))

    def test_nothing_warns(self):
        _, text = run(PROGRAM, "check", self.design, "-v")
        self.assertIn("verdict: pass", text)
        self.assertNotRegex(text, r"(?m)^(warn|fail)")

    def test_the_plates_hold_what_the_bill_says_is_made(self):
        with open(self.folder / "bom.csv", encoding="utf-8") as file:
            wanted = {row["part"]: int(row["count"]) for row in csv.DictReader(file) if row["part"]}
        found = Counter()
        for plate in self.plates:
            model = zipfile.ZipFile(plate).read("3D/3dmodel.model").decode()
            names = dict(re.findall(r'<object id="(\d+)" type="model" name="([^"]+)"', model))
            found.update(names[item] for item in re.findall(r'<item objectid="(\d+)"', model))
        self.assertEqual(found, Counter(wanted))
        self.assertIn("housing", wanted)

    def test_prusa_slicer_has_nothing_to_repair(self):
        for plate in self.plates:
            _, text = run("prusa-slicer", "--info", plate)
            manifold = re.findall(r"manifold = (\w+)", text)
            self.assertGreater(len(manifold), 0)
            self.assertEqual(set(manifold), {"yes"}, plate.name)
            self.assertNotRegex(text, r"(?i)repair|edges_fixed|open edges")

    def test_prusa_slicer_slices_plates_without_a_warning(self):
        self.assertGreaterEqual(len(self.plates), self.PLATES)
        for plate in self.plates if CAMPAIGN else self.plates[:self.SLICED]:
            gcode = plate.with_suffix(".gcode")
            code, text = run("prusa-slicer", "--export-gcode", "--dont-arrange", "--bed-shape", BED, *QUICK,
                             "-o", gcode, plate)
            self.assertEqual(code, 0, text)
            self.assertNotRegex(text, r"(?i)warn|error|outside|unstable|empty layer", plate.name)
            self.assertGreater(gcode.stat().st_size, 1_000_000)


class BoxedPair(PrintedActuator):
    EXAMPLE, PLATES, SLICED = "boxed_pair", 1, 1


class PlanetaryActuator(PrintedActuator):
    EXAMPLE, PLATES, SLICED = "planetary_actuator", 1, 0


class SteppedActuator(PrintedActuator):
    EXAMPLE, PLATES, SLICED = "stepped_actuator", 1, 0


if __name__ == "__main__":
    unittest.main()
