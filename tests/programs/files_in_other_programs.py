#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What other programs make of the files of `trueflank make`.

PrusaSlicer and admesh must find closed bodies with nothing to repair, OpenSCAD must render the same
shape from the .scad, ezdxf must find no error in the .dxf and the area of the section in it, xmllint
must take .svg and the model in the .3mf for well-formed.
"""
import functools
import os
import pathlib
import struct
import subprocess
import sys
import unittest
import zipfile

import ezdxf
import numpy as np

import segments

SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
# OpenSCAD takes minutes for the union of a carrier's many prisms (docs/formats.md).
# Helical and modified teeth have twisted_in_other_programs.py, the housing's parts printed_actuator.py.
# The union of one sun's takes as long as all other parts, which are put together of prisms too: in the campaign.
LONG_IN_OPENSCAD = set() if "TRUEFLANK_CAMPAIGN" in os.environ else {("two_stage", "sun2")}
EXAMPLES = sorted(p.parent.name for p in SOURCE.glob("examples/*/design.toml")
                  if p.parent.name not in ("carried_drive", "helical_planetary", "relieved_3k", "herringbone_pair")
                  and "[housing]" not in p.read_text(encoding="utf-8"))
if "TRUEFLANK_CAMPAIGN" not in os.environ:  # the drive, and every other one
    EXAMPLES = [name for at, name in enumerate(EXAMPLES) if name == "bilateral_drive" or at % 2 == 1]
DRIVE = "bilateral_drive"
TOLERANCE_MM = 1e-3
CLOSE_MM = 0.01  # beside a strip of points: what is farther off is looked for among all segments


def run(*command, timeout=120):
    environment = dict(os.environ, HOME=str(OUTPUT), LC_ALL="C")
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=timeout,
                          env=environment, errors="replace")
    if done.returncode != 0:
        raise AssertionError(f"{command}: exit {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout + done.stderr


def read_stl(path):
    """Triangles as an array n x 3 x 3 of a binary or text STL."""
    data = path.read_bytes()
    if data.startswith(b"solid"):
        numbers = [line.split()[1:] for line in data.decode().splitlines()
                   if line.strip().startswith("vertex")]
        return np.array(numbers, dtype=float).reshape(-1, 3, 3)
    count = struct.unpack_from("<I", data, 80)[0]
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, record, count, 84)["corners"].astype(float)


def volume_of(triangles):
    return float(np.einsum("ij,ij->i", triangles[:, 0],
                           np.cross(triangles[:, 1], triangles[:, 2])).sum() / 6)


def above_mm(triangles, z):
    """Heights of all corners above a plane; next to nothing counts as none."""
    above = triangles[:, :, 2] - z
    return np.where(np.abs(above) < 1e-4, 0.0, above)


def section(triangles, z):
    """Where a plane cuts walls or touches their edges, as arrays of ends (n x 2)."""
    above = above_mm(triangles, z)
    cut = (above.min(axis=1) <= 0) & (above.max(axis=1) >= 0) & ((above == 0).sum(axis=1) < 3)
    triangles, above = triangles[cut], above[cut]
    found = np.full((len(triangles), 6, 2), np.nan)  # corners in the plane, then sides through it
    for k in range(3):
        n = (k + 1) % 3
        on, through = above[:, k] == 0, above[:, k] * above[:, n] < 0
        found[on, k] = triangles[on, k, :2]
        share = above[through, k] / (above[through, k] - above[through, n])
        begin, end = triangles[through, k, :2], triangles[through, n, :2]
        found[through, 3 + k] = begin + share[:, None] * (end - begin)
    there = ~np.isnan(found[:, :, 0])
    two = there.sum(axis=1) == 2
    ends = found[two][there[two]].reshape(-1, 2, 2)
    return ends[:, 0], ends[:, 1]


def wall_corners(triangles, z):
    """Corners of walls at a height (n x 2)."""
    walls = triangles[np.ptp(triangles[:, :, 2], axis=1) > 1e-4]
    return np.unique(walls[above_mm(walls, z) == 0][:, :2], axis=0)


def area_inside(polyline):
    """Area inside a closed LWPOLYLINE of lines and arcs, from the points and bulges that ezdxf reads: the polygon and, of an arc of
    4 atan(bulge), the segment between it and its chord."""
    x, y, bulge = np.array(polyline.get_points("xyb")).T
    along = np.roll(x, -1) - x, np.roll(y, -1) - y
    angle = 4 * np.arctan(bulge)
    curved = np.abs(angle) > 1e-3  # below: the first term of the series
    segment = np.where(curved, (angle - np.sin(angle)) / (8 * np.sin(np.where(curved, angle, 1.0) / 2) ** 2), angle / 12)
    chord = along[0] ** 2 + along[1] ** 2
    return abs((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2 + (segment * chord).sum())


@functools.cache
def rendered(path, *definitions):
    """What OpenSCAD makes of a file: triangles and what it says."""
    out = OUTPUT / "rendered.stl"
    text = run("openscad", "-o", out, *(f"-D{d}" for d in definitions), path)
    return read_stl(out), text


def prusa(path):
    """Values of `prusa-slicer --info`, a dictionary for each object of the file."""
    objects = []
    for line in run("prusa-slicer", "--info", path).splitlines():
        if line.startswith("["):
            if "trace" not in line:
                objects.append({})
        elif " = " in line and objects:
            key, value = line.split(" = ")
            objects[-1][key.strip()] = value.strip()
    return objects


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for name in EXAMPLES:
            formats = "stl,3mf,obj,dxf,svg,scad" if name == DRIVE else "stl,scad,dxf"
            run(PROGRAM, "make", SOURCE / "examples" / name / "design.toml", "-o", OUTPUT / name,
                "--formats", formats)

    def parts(self, name):
        return sorted(p.stem for p in (OUTPUT / name).glob("*.stl") if p.stem != "assembly")

    def test_prusa_slicer_finds_one_closed_body_in_every_part(self):
        for part in self.parts(DRIVE):
            exact = volume_of(read_stl(OUTPUT / DRIVE / f"{part}.stl"))
            for extension in ("stl", "3mf", "obj"):
                with self.subTest(f"{part}.{extension}"):
                    objects = prusa(OUTPUT / DRIVE / f"{part}.{extension}")
                    self.assertEqual(len(objects), 1)
                    self.assertEqual(objects[0]["manifold"], "yes")
                    self.assertEqual(objects[0]["number_of_parts"], "1")
                    self.assertAlmostEqual(float(objects[0]["volume"]) / exact, 1, delta=1e-4)

    def test_prusa_slicer_finds_every_body_of_the_assembly_in_its_place(self):
        objects = prusa(OUTPUT / DRIVE / "assembly.3mf")
        self.assertEqual(len(objects), 6)
        for found in objects:
            self.assertEqual(found["manifold"], "yes")
        middles = sorted((round((float(o["min_x"]) + float(o["max_x"])) / 2, 1),
                          round((float(o["min_y"]) + float(o["max_y"])) / 2, 1), float(o["min_z"]))
                         for o in objects)
        expected = sorted([(0, 0, 0), (0, 0, 0), (0, 0, 13), (25.7, 0, 0), (-12.8, 22.2, 0),
                           (-12.8, -22.2, 0)])
        for found, wanted in zip(middles, expected):
            np.testing.assert_allclose(found, wanted, atol=0.1)

    def test_admesh_has_nothing_to_repair(self):
        clean = ("disconnected facets", "Degenerate facets", "Edges fixed", "Facets removed",
                 "Facets reversed", "Backwards edges", "Normals fixed", "Facets added")
        for name in EXAMPLES:
            for part in self.parts(name):
                text = run("admesh", OUTPUT / name / f"{part}.stl")
                for line in text.splitlines():
                    if any(word in line for word in clean):
                        numbers = line.split(":")[1].split()
                        self.assertEqual(numbers[-1] if len(numbers) == 2 else numbers[0], "0",
                                         f"{name}/{part}: {line}")

    def test_openscad_renders_the_same_shape(self):
        for name in EXAMPLES:
            for part in self.parts(name):
                if (name, part) in LONG_IN_OPENSCAD:
                    continue
                with self.subTest(f"{name}/{part}"):
                    theirs, text = rendered(OUTPUT / name / f"{part}.scad")
                    self.assertNotIn("WARNING", text)
                    ours = read_stl(OUTPUT / name / f"{part}.stl")
                    self.assertAlmostEqual(volume_of(theirs) / volume_of(ours), 1, delta=1e-4)
                    heights = [np.unique(np.round(t[:, :, 2], 3)) for t in (ours, theirs)]
                    for z in np.unique(np.concatenate(heights)):
                        # corners of both lie on the true surface, facets within the tolerance of it
                        for one, other in ((ours, theirs), (theirs, ours)):
                            corners = wall_corners(one, z)
                            if len(corners) > 0:
                                self.assertLess(segments.nearest(corners, *section(other, z), CLOSE_MM).max(), TOLERANCE_MM + 1e-4)

    def test_openscad_takes_new_sizes(self):
        def volume(part, *definitions):
            return volume_of(rendered(OUTPUT / DRIVE / f"{part}.scad", *definitions)[0])
        whole = volume("planet")
        # 2 x 39 flanks and 2 x 32 flanks lose about half of 0.1 mm each over their height
        thinner = volume("planet", "extra_thinning_um=100")
        self.assertAlmostEqual(whole - thinner, 0.1 * (39 * 12 + 32 * 14) * 2.25, delta=40)
        self.assertAlmostEqual(volume("planet", "bore_diameter=0") - whole, np.pi * 9.5**2 * 27, delta=2)
        self.assertAlmostEqual(volume("ring1", "face_width=24") / volume("ring1"), 2, delta=1e-4)
        self.assertAlmostEqual(volume("ring1", "hole_diameter=0") - volume("ring1"),
                               8 * np.pi * 2.25**2 * 12, delta=1)

    def test_openscad_places_the_assembly(self):
        out = OUTPUT / "assembly.csg"
        run("openscad", "-o", out, OUTPUT / DRIVE / "assembly.scad")
        self.assertEqual(out.read_text().count("polyhedron("), 3)

    def test_ezdxf_finds_no_error_and_the_area_of_the_section(self):
        for name in EXAMPLES:
            for part in self.parts(name):
                with self.subTest(f"{name}/{part}"):
                    document = ezdxf.readfile(str(OUTPUT / name / f"{part}.dxf"))
                    audit = document.audit()
                    self.assertEqual((len(audit.errors), len(audit.fixes)), (0, 0))
                    self.assertEqual(document.units, 4)
                    areas = []
                    for entity in document.modelspace():
                        if entity.dxf.layer.startswith("SECTION_1_"):
                            if entity.dxftype() == "CIRCLE":  # ezdxf's path of it is 0.03 % off
                                areas.append(np.pi * entity.dxf.radius**2)
                                continue
                            self.assertTrue(entity.closed)
                            areas.append(area_inside(entity))
                    section = max(areas) - (sum(areas) - max(areas))
                    mesh = read_stl(OUTPUT / name / f"{part}.stl")
                    low = mesh[np.isclose(mesh[:, :, 2], 0).all(axis=1)][:, :, :2]
                    u, v = low[:, 1] - low[:, 0], low[:, 2] - low[:, 0]
                    exact = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum() / 2
                    self.assertAlmostEqual(section / exact, 1, delta=5e-4)  # circles against chords

    def test_xml_is_well_formed(self):
        for path in (OUTPUT / DRIVE).glob("*.svg"):
            run("xmllint", "--noout", path)
        for path in (OUTPUT / DRIVE).glob("*.3mf"):
            with zipfile.ZipFile(path) as archive:
                self.assertIsNone(archive.testzip())
                for entry in archive.namelist():
                    out = OUTPUT / "entry.xml"
                    out.write_bytes(archive.read(entry))
                    run("xmllint", "--noout", out)


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
