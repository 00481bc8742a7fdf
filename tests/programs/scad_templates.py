# SPDX-License-Identifier: GPL-3.0-or-later
"""The OpenSCAD templates as `make` delivers them: rendered, one manifold body, clear of what turns."""
import functools
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
WHOLE = "TRUEFLANK_CAMPAIGN" in os.environ


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
                    "--formats", "scad,stl,obj", "--tolerance-um", "10", "-q"], check=True, stdout=subprocess.DEVNULL)
    return folder


@functools.lru_cache(maxsize=None)
def rendered(folder, name, *settings):
    """STL of a template, each rendered once; fails where OpenSCAD warns of anything."""
    out = os.path.join(folder, f"{name}.{abs(hash(settings))}.rendered.stl")
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


def placed_bodies(folder):
    """Corners of every body of the assembly, where it stands: {name: n x 3}."""
    found, corners = {}, []
    with open(os.path.join(folder, "assembly.obj"), encoding="utf-8") as file:
        for line in file:
            if line.startswith("o "):
                corners = found.setdefault(line[2:].strip(), [])
            elif line.startswith("v "):
                corners.append([float(word) for word in line.split()[1:4]])
    return {name: numpy.array(points) for name, points in found.items() if points}


def swept(points):
    """Rings (inner, outer radius, lower, upper height) that hold whatever the body turns through about
    the gearbox's axis: one from level to level, as wide as the corners on either."""
    radius, levels = numpy.hypot(points[:, 0], points[:, 1]), numpy.unique(points[:, 2].round(6))
    rings = []
    for low, high in zip(levels, levels[1:]):
        on = radius[(abs(points[:, 2] - low) < 1e-5) | (abs(points[:, 2] - high) < 1e-5)]
        rings.append((on.min(), on.max(), low, high))
    return rings


def samples(corners, step=0.6):
    """Points all over a mesh's triangles, no farther apart than the step."""
    edges = numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2).max(1)
    parts = []
    for count in numpy.unique(numpy.ceil(edges / step).astype(int)):
        some = corners[numpy.ceil(edges / step).astype(int) == count]
        u, v = numpy.array([(i, j) for i in range(count + 1) for j in range(count + 1 - i)]).T / max(count, 1)
        parts.append((some[:, None, 0] * (1 - u - v)[:, None] + some[:, None, 1] * u[:, None]
                      + some[:, None, 2] * v[:, None]).reshape(-1, 3))
    return numpy.vstack(parts)


def holds(corners, point):
    """Whether a closed mesh has the point inside: crossings of the ray upwards."""
    a, b, c = (corners[:, i, :2] - point[:2] for i in range(3))
    cross = [p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] for p, q in ((b, c), (c, a), (a, b))]
    total = sum(cross)
    hit = ((cross[0] > 0) == (cross[1] > 0)) & ((cross[1] > 0) == (cross[2] > 0)) & (total != 0)
    heights = sum(w[hit] * corners[hit, i, 2] for i, w in enumerate(cross)) / total[hit]
    return int((heights > point[2]).sum()) % 2 == 1


def collisions(template, bodies_by_name, clearance=0.0):
    """Names of bodies that would touch the template somewhere while turning about the axis."""
    corners = template.astype(float)
    points = samples(corners)
    radius, touching = numpy.hypot(points[:, 0], points[:, 1]), []
    for name, body in bodies_by_name.items():
        for inner, outer, low, high in swept(body):
            within = ((radius > inner - clearance) & (radius < outer + clearance)
                      & (points[:, 2] > low + 1e-4 - clearance) & (points[:, 2] < high - 1e-4 + clearance))
            middle = numpy.array([0.5 * (inner + outer) + 0.0123, 0.0271, 0.5 * (low + high) + 0.0017])
            if within.any() or holds(corners, middle):
                touching.append(name)
                break
    return touching


class Templates(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.drive = made("carried_drive")
        cls.simple = made("simple_planetary")
        cls.pair = made("external_pair")

    def test_each_renders_to_manifold_bodies(self):
        seen = set()
        for folder in (self.drive, self.simple, self.pair):
            names = sorted(f[:-5] for f in os.listdir(folder) if f.startswith("template_") and f.endswith(".scad"))
            self.assertIn("template_fit_coupon", names)
            for name in names:
                if name in seen and not WHOLE:
                    continue  # of another design; the other tests render some of these, too
                seen.add(name)
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

    def test_nothing_that_turns_touches_the_housing(self):
        turning = {n: p for n, p in placed_bodies(self.drive).items() if n != "ring1"}
        self.assertGreaterEqual(len(turning), 6, list(turning))
        housing = triangles(rendered(self.drive, "template_housing"))
        self.assertEqual(collisions(housing, turning, clearance=0.4), [])
        # and where it were in the way, this would tell
        raised = triangles(rendered(self.drive, "template_housing", "lowest=0"))
        self.assertIn("carrier", " ".join(collisions(raised, turning)))
        fixed = triangles(rendered(self.simple, "template_housing"))
        simple = {n: p for n, p in placed_bodies(self.simple).items() if n != "ring"}
        self.assertEqual(collisions(fixed, simple, clearance=0.4), [])

    def test_the_output_flange_touches_only_its_ring(self):
        bodies_there = placed_bodies(self.drive)
        ring = bodies_there.pop("ring2")
        flange = triangles(rendered(self.drive, "template_output_flange")).astype(float)
        self.assertLess(abs(flange[..., 2].min()), 1e-4)
        on_ring = flange + [0, 0, ring[:, 2].max()]
        self.assertEqual(collisions(on_ring, bodies_there), [])
        self.assertNotEqual(collisions(flange, bodies_there), [])  # 27 mm lower it is in the way

    def test_the_motor_adapter_lies_on_the_housings_floor(self):
        adapter, housing = (triangles(rendered(self.drive, n)).astype(float)
                            for n in ("template_motor_adapter", "template_housing"))
        # screwed to the housing's flange by holes of one circle: as wide as the flange at least
        self.assertGreaterEqual(numpy.hypot(*adapter.reshape(-1, 3)[:, :2].T).max() + 0.5,
                                numpy.hypot(*housing.reshape(-1, 3)[:, :2].T).max())
        below = adapter + [0, 0, housing[..., 2].min() - adapter[..., 2].max()]
        self.assertEqual(collisions(below, placed_bodies(self.drive)), [])

    def test_gears_on_the_jig_stand_at_the_centre_distance(self):
        jig = triangles(rendered(self.drive, "template_test_jig")).reshape(-1, 3)
        top = jig[jig[:, 2] > jig[:, 2].max() - 1e-4]
        left, right = (top[(abs(top[:, 1]) < 15) & side] for side in (top[:, 0] < 12, top[:, 0] >= 12))
        middles = [0.5 * (part[:, 0].min() + part[:, 0].max()) for part in (left, right)]
        self.assertLess(abs(middles[1] - middles[0] - 25.6826), 1e-3)

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
