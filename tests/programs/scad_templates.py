# SPDX-License-Identifier: GPL-3.0-or-later
"""The OpenSCAD templates as `make` delivers them: rendered, one manifold body, clear of what turns."""
import os
import re
import struct
import subprocess
import time
import unittest

import numpy

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = os.environ["TRUEFLANK_SOURCE_DIR"]
OUTPUT = os.environ["TRUEFLANK_TEST_OUTPUT"]


def triangles(path):
    """n x 3 x 3 corners of a binary STL."""
    with open(path, "rb") as file:
        data = file.read()
    (count,) = struct.unpack_from("<I", data, 80)
    records = numpy.frombuffer(data, dtype=numpy.dtype([("f", "<f4", 12), ("a", "<u2")]), offset=84, count=count)
    return records["f"].reshape(-1, 4, 3)[:, 1:]


def volume(corners):
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    return float(numpy.einsum("ij,ij->i", a.astype(float), numpy.cross(b.astype(float), c)).sum() / 6)


def made(example):
    folder = os.path.join(OUTPUT, example)
    subprocess.run([PROGRAM, "make", os.path.join(SOURCE, "examples", example, "design.toml"), "-o", folder,
                    "--formats", "scad,stl", "--tolerance-um", "10", "-q"], check=True, stdout=subprocess.DEVNULL)
    return folder


def rendered(folder, name, *settings):
    """STL of a template; fails where OpenSCAD warns of anything."""
    out = os.path.join(folder, f"{name}.rendered.stl")
    command = ["openscad", "-o", out, "--export-format", "binstl"]
    for setting in settings:
        command += ["-D", setting]
    start = time.monotonic()
    run = subprocess.run(command + [os.path.join(folder, name + ".scad")], capture_output=True, text=True, check=False)
    assert run.returncode == 0 and "WARNING" not in run.stderr and "ERROR" not in run.stderr, name + ": " + run.stderr
    print(f"{name} {' '.join(settings)}: {time.monotonic() - start:.1f} s")
    return out


def bodies(path):
    """Closed bodies of a mesh file; an error where it is not manifold."""
    info = subprocess.run(["prusa-slicer", "--info", path], capture_output=True, text=True, check=True).stdout
    assert "manifold = yes" in info, path + ": " + info
    return int(re.search(r"number_of_parts = +(\d+)", info).group(1))


def extent(path):
    """Smallest and largest radius and height of a mesh's corners."""
    points = triangles(path).reshape(-1, 3)
    radius = numpy.hypot(points[:, 0], points[:, 1])
    return radius.min(), radius.max(), points[:, 2].min(), points[:, 2].max()


class Templates(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.drive = made("carried_drive")
        cls.simple = made("simple_planetary")
        cls.pair = made("external_pair")

    def test_each_renders_to_manifold_bodies(self):
        for folder in (self.drive, self.simple, self.pair):
            names = sorted(f[:-5] for f in os.listdir(folder) if f.startswith("template_") and f.endswith(".scad"))
            self.assertIn("template_fit_coupon", names)
            for name in names:
                with self.subTest(folder=folder, name=name):
                    count = bodies(rendered(folder, name))
                    if name != "template_fit_coupon":
                        self.assertEqual(count, 1)

    def test_the_housing_clears_the_ring_that_turns_and_holds_the_one_that_does_not(self):
        housing = triangles(rendered(self.drive, "template_housing")).reshape(-1, 3)
        radius = numpy.hypot(housing[:, 0], housing[:, 1])
        _, moving, _, height = extent(os.path.join(self.drive, "ring2.stl"))
        bottom = 13.0  # planet1's 12 mm and the layer gap
        beside = (housing[:, 2] > bottom - 1.5) & (housing[:, 2] < bottom + height + 1e-3)
        # facets cut corners of a polygon of 120
        self.assertGreater(radius[beside].min() * numpy.cos(numpy.pi / 120), moving)
        _, fixed, _, _ = extent(os.path.join(self.drive, "ring1.stl"))
        seat = radius[(abs(housing[:, 2]) < 1e-3)]
        self.assertLess(abs(seat[seat > fixed - 0.5].min() - fixed), 0.05)

    def test_the_housing_stays_below_what_the_carrier_sweeps(self):
        housing = triangles(rendered(self.drive, "template_housing")).reshape(-1, 3)
        floor = housing[:, 2][numpy.hypot(housing[:, 0], housing[:, 1]) < 30].max()
        self.assertLess(floor, -8.3)  # the lower plate of 8 mm with its clearance

    def test_the_carrier_is_the_designs_own(self):
        lower = volume(triangles(rendered(self.drive, "template_carrier", 'part="lower"', "$fn=96")))
        part = volume(triangles(os.path.join(self.drive, "carrier.stl")))
        self.assertLess(abs(lower / part - 1), 2e-3)

    def test_the_ring_in_the_housing_has_the_parts_own_teeth(self):
        housing = triangles(rendered(self.drive, "template_housing", "ring_in_one_piece=true")).reshape(-1, 3)
        tip, _, _, _ = extent(os.path.join(self.drive, "ring1.stl"))
        inside = (housing[:, 2] > -1e-3) & (housing[:, 2] < 12.001)
        radius = numpy.hypot(housing[inside, 0], housing[inside, 1])
        self.assertLess(abs(radius.min() - tip), 2e-3)

    def test_the_coupons_first_copy_is_the_gear_itself(self):
        points = triangles(rendered(self.pair, "template_fit_coupon", "steps=[0]")).reshape(-1, 3)
        _, tip, _, _ = extent(os.path.join(self.pair, "pinion.stl"))
        own = points[abs(points[:, 1]) < tip + 4]
        reached = numpy.hypot(own[:, 0] + tip, own[:, 1]).max()
        self.assertLess(abs(reached - tip), 2e-3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
