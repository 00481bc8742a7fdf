#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What ezdxf makes of the DXF files of `trueflank make --kerf-mm`, and the made options of the program.

A pair with a keyway is written with and without kerf; every point of the path must be half the kerf
from the outline in the other file, whose area grows by perimeter and corners as an offset's does.
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import unittest

import ezdxf
import numpy as np

import segments

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
KERF_MM = 0.25
DESIGN = """format = 1
[gearbox]
kind = "gear"
module_mm = 1.0
[gear]
teeth = 24
face_width_mm = 5
bore_mm = 8
bore_keyway_width_mm = 3
bore_keyway_depth_mm = 1.4
"""


def make(name, *options, design=DESIGN, expect=0):
    path = OUTPUT / f"{name}.toml"
    path.write_text(design)
    done = subprocess.run([PROGRAM, "make", path, "-o", OUTPUT / name, "--formats", "dxf", *options],
                          capture_output=True, text=True, timeout=60)
    if done.returncode != expect:
        raise AssertionError(f"exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def dense(entity):
    """Points on a closed LWPOLYLINE, arcs by their bulges (ezdxf's own paths of arcs are 0.03 % off)."""
    vertices = [(np.array(v[:2]), v[2]) for v in entity.get_points("xyb")]
    points = []
    for (a, bulge), (b, _) in zip(vertices, vertices[1:] + vertices[:1]):
        angle = 4 * math.atan(bulge)
        count = max(2, math.ceil(abs(angle) / 0.004))
        chord = b - a
        for i in range(count):
            if abs(angle) < 1e-12:
                points.append(a + chord * i / count)
                continue
            # the chord to a point of the arc: its angle at a is half the arc's that is left
            t = angle * i / count
            turn = (t - angle) / 2
            length = math.sin(t / 2) / math.sin(angle / 2)
            c, s = math.cos(turn), math.sin(turn)
            points.append(a + length * np.array([c * chord[0] - s * chord[1], s * chord[0] + c * chord[1]]))
    return np.array(points)


def contours(folder, layer):
    """Dense points of every contour of a layer, the outermost first."""
    document = ezdxf.readfile(str(OUTPUT / folder / "gear.dxf"))
    lines = []
    for entity in document.modelspace():
        if entity.dxf.layer == layer:
            lines.append(dense(entity))
    return sorted(lines, key=lambda line: -np.hypot(*line.T).max())


def distances(points, line):
    """From each point to a closed chain of points."""
    return segments.nearest(points, line, np.roll(line, -1, axis=0), KERF_MM)


def area(line):
    x, y = line.T
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


class Kerf(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        make("plain", "--tolerance-um", "0.02")
        cls.told = make("kerf", "--kerf-mm", str(KERF_MM))
        cls.outline = contours("plain", "SECTION_1_GEAR")
        cls.path = contours("kerf", "SECTION_1_GEAR_KERF_250UM")

    def test_ezdxf_finds_no_error_and_the_layers(self):
        document = ezdxf.readfile(str(OUTPUT / "kerf" / "gear.dxf"))
        audit = document.audit()
        self.assertEqual((len(audit.errors), len(audit.fixes)), (0, 0))
        self.assertTrue(document.layers.get("SECTION_1_GEAR_AS_CUT").is_frozen())
        self.assertFalse(document.layers.get("SECTION_1_GEAR_KERF_250UM").is_frozen())
        self.assertEqual([len(self.outline), len(self.path)], [2, 2])
        for entity in document.modelspace():
            if entity.dxftype() == "LWPOLYLINE":
                self.assertTrue(entity.closed)
                self.assertLess(len(entity), 24 * 40)

    def test_every_point_of_the_path_is_half_the_kerf_from_the_outline(self):
        for path, outline in zip(self.path, self.outline):
            away = distances(path[::5], outline)
            self.assertLess(abs(away - KERF_MM / 2).max(), 1.02e-3)

    def test_path_goes_round_the_part_and_inside_its_bore(self):
        self.assertGreater(area(self.path[0]), area(self.outline[0]))
        self.assertLess(area(self.path[1]), area(self.outline[1]))

    def test_area_of_the_bores_path_is_that_of_its_arcs_and_lines(self):
        d, r, half_width, depth = KERF_MM / 2, 4.0, 1.5, 1.4
        mouth = math.asin(half_width / r)
        corner = np.array([r * math.cos(mouth), half_width])

        def arc(centre, radius, begin, end):
            angles = np.linspace(begin, end, 20001)
            return centre + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        floor = r + depth - d
        path = np.vstack([
            arc(np.zeros(2), r - d, mouth, 2 * math.pi - mouth),
            arc(corner * [1, -1], d, math.pi - mouth, math.pi / 2),  # round the mouth's corner
            [[floor, d - half_width], [floor, half_width - d]],
            arc(corner, d, 1.5 * math.pi, math.pi + mouth)])
        self.assertAlmostEqual(area(self.path[1]), area(path), delta=1e-3)

    def test_unreached_corners_are_told(self):
        report = json.loads((OUTPUT / "kerf" / "report.json").read_text())
        entry = report["files"][0]
        self.assertEqual(entry["kerf_mm"], KERF_MM)
        self.assertEqual(entry["unreached_corners"], 2)
        self.assertAlmostEqual(entry["left_um"], 125 * (math.sqrt(2) - 1), delta=0.05)
        self.assertLess(entry["accuracy_um"], 1.0)
        self.assertIn("2 corners", " ".join(self.told.split()))

    def test_kerf_of_the_design_file_does_the_same(self):
        make("written", design=DESIGN + "[made]\nkerf_mm = 0.25\n")
        self.assertEqual((OUTPUT / "written" / "gear.dxf").read_bytes(),
                         (OUTPUT / "kerf" / "gear.dxf").read_bytes())

    def test_what_cannot_be_is_an_error(self):
        told = make("wide", "--kerf-mm", "9", expect=2)
        self.assertIn("does not fit", told)
        self.assertIn("no width of a cut", make("negative", "--kerf-mm", "-1", expect=2))
        self.assertIn("fdm-0.4", make("process", "--process", "magic", expect=2))

    def test_compensation_moves_the_walls_of_meshes_only(self):
        (OUTPUT / "own.toml").write_text("[process.wide]\nhorizontal_expansion_mm = 0.02\n")
        design = 'tools = "own.toml"\n' + DESIGN + '[made]\nprocess = "wide"\n'
        make("nominal", "--formats", "stl", design=design)
        told = make("moved", "--formats", "stl", "--compensate", design=design)
        self.assertIn("20 um inwards", told)
        files = [{f["format"]: f for f in json.loads((OUTPUT / name / "report.json").read_text())["files"]}
                 for name in ("nominal", "moved")]
        self.assertEqual(files[1]["stl"]["compensated_for"], "wide")
        self.assertNotIn("compensated_for", files[1]["dxf"])
        self.assertEqual(*[(OUTPUT / name / "gear.dxf").read_bytes() for name in ("nominal", "moved")])
        # walls times expansion, from the outlines' own lengths
        length = sum(np.hypot(*(np.roll(line, -1, axis=0) - line).T).sum() for line in self.outline)
        lost = files[0]["stl"]["volume_mm3"] - files[1]["stl"]["volume_mm3"]
        self.assertAlmostEqual(lost / (5 * 0.02 * length), 1, delta=0.01)
        self.assertIn("needs a process", make("none", "--compensate", expect=2))

    def test_the_face_on_the_bed_is_chamfered_against_the_elephant_foot(self):
        told = make("foot", "--formats", "stl,step", "--process", "fdm-0.4", "--compensate")
        self.assertIn("chamfered by 150 um at the face that lies on the bed (z = 0", told)
        raw = (OUTPUT / "foot" / "gear.stl").read_bytes()
        facets = np.frombuffer(raw[84:], dtype=np.dtype([("f", "<f4", 12), ("a", "<u2")]))["f"]
        points = facets[:, 3:].reshape(-1, 3).astype(float)
        radii = np.hypot(points[:, 0], points[:, 1])
        tip = max(np.hypot(*line.T).max() for line in self.outline)
        for z, inwards in ((0.0, 0.05 + 0.15), (0.4, 0.05), (points[:, 2].max(), 0.05)):
            self.assertAlmostEqual(radii[np.abs(points[:, 2] - z) < 1e-5].max(), tip - inwards, delta=2e-5)
        for name in ("gear.stl", "gear.step"):
            files = json.loads((OUTPUT / "foot" / "report.json").read_text())["files"]
            self.assertLess(next(f["accuracy_um"] for f in files if f["path"] == name), 1.0)

    def test_process_warns_and_the_parts_are_made(self):
        told = make("printed", "--process", "fdm-0.4",
                    design=DESIGN.replace("module_mm = 1.0", "module_mm = 0.5").replace(
                        "bore_mm = 8", "bore_mm = 3").replace("width_mm = 3", "width_mm = 1").replace(
                        "depth_mm = 1.4", "depth_mm = 0.5"))
        self.assertIn("manufacturability", told)
        self.assertTrue((OUTPUT / "printed" / "gear.dxf").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
