# SPDX-License-Identifier: GPL-3.0-or-later
"""Helical, herringbone and modified gears as other programs see them: OpenSCAD renders the same solid
from the .scad, PrusaSlicer and admesh find the meshes whole."""
import os
import pathlib
import re
import subprocess
import unittest

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
TOLERANCE_UM = 10

PAIR = """format = 1
name = "twisted"
[gearbox]
kind = "pair"
module_mm = 1.0
backlash_mm = 0.05
helix_angle_deg = 25.0
{more}
[pinion]
teeth = 17
face_width_mm = 10.0
bore_mm = 5.0
bore_d_flat_mm = 4.5
[wheel]
teeth = 40
internal = true
face_width_mm = 10.0
outer_diameter_mm = 56
{ring}
"""
BOLTS = "bolt_count = 4\nbolt_circle_diameter_mm = 50\nbolt_hole_diameter_mm = 2\n"
DESIGNS = {
    "groove": PAIR.format(more="herringbone = true\nrelief_groove_mm = 1.0", ring=BOLTS),
    "modified": PAIR.format(more="", ring="[pinion.modifications]\ncrowning_um = 30\n"
                                          "tip_relief_um = 20\ntip_relief_start_diameter_mm = 19.5\n"
                                          "edge_chamfer_mm = 0.3\n"),
}
# in all of these a part's module has the part's name: none of the library's may have it
EXAMPLES = ["helical_planetary", "herringbone_pair", "relieved_3k"]
PARTS = {"groove": ["pinion", "wheel"], "modified": ["pinion", "wheel"],
         "helical_planetary": ["sun", "planet", "ring"], "herringbone_pair": ["pinion", "wheel"],
         "relieved_3k": ["sun", "planet", "ring1", "ring2"]}


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout + done.stderr


class Twisted(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        OUTPUT.mkdir(parents=True, exist_ok=True)
        for name, text in DESIGNS.items():
            (OUTPUT / f"{name}.toml").write_text(text)
        for name in PARTS:
            design = SOURCE / "examples" / name / "design.toml" if name in EXAMPLES else OUTPUT / f"{name}.toml"
            run(PROGRAM, "make", design, "-o", OUTPUT / name, "-q", "--tolerance-um", TOLERANCE_UM,
                "--formats", "stl,scad")

    def test_openscad_renders_the_same_solid(self):
        for name, parts in PARTS.items():
            for part in parts:
                with self.subTest(f"{name}/{part}"):
                    rendered = OUTPUT / f"{name}.{part}.stl"
                    text = run("openscad", "-o", rendered, "--export-format", "binstl",
                               OUTPUT / name / f"{part}.scad")
                    self.assertNotIn("WARNING", text)
                    # both are within the tolerance of the true surface
                    run(PROGRAM, "compare", OUTPUT / name / f"{part}.stl", rendered,
                        "--tolerance-um", 2 * TOLERANCE_UM)

    def test_prusa_slicer_and_admesh_find_whole_parts(self):
        for name, parts in PARTS.items():
            for part in parts:
                with self.subTest(f"{name}/{part}"):
                    file = OUTPUT / name / f"{part}.stl"
                    info = run("prusa-slicer", "--info", file)
                    self.assertIn("manifold = yes", info)
                    self.assertEqual(re.search(r"number_of_parts = +(\d+)", info).group(1), "1")
                    report = run("admesh", file)
                    for what in ["Total disconnected facets", "Degenerate facets", "Backwards edges",
                                 "Edges fixed", "Facets reversed"]:
                        counts = re.search(what + r" *: *(\d+)", report)
                        self.assertEqual(counts.group(1), "0", what)


if __name__ == "__main__":
    unittest.main()
