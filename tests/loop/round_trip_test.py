# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole loop with the program alone: make a gear, let a process the loop is not told of distort its mesh,
scan the mesh, close the loop, make the corrected gear, let the same process distort it, measure both against
the design. Process, scan and measurement are written here and share nothing with the library."""
import json
import math
import os
import pathlib
import subprocess
import unittest

import numpy

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
TEETH, MODULE, FACE, ALPHA = 24, 1.0, 8.0, math.radians(20.0)
DESIGN = f"""format = 1
name = "made"
[gearbox]
kind = "gear"
module_mm = {MODULE}
[gear]
teeth = {TEETH}
shift = 0.1
face_width_mm = {FACE}
bore_mm = 6.0
"""


def run(*arguments, code=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    if code is not None and done.returncode != code:
        raise AssertionError(f"{arguments}: {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done


def triangles(path):
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    rows = numpy.frombuffer(data, dtype=numpy.dtype([("f", "<f4", 12), ("a", "<u2")]), offset=84, count=count)
    return rows["f"][:, 3:].reshape(-1, 3, 3).astype(float)


def process(points):
    """Shrinks, shears, twists and presses out of round; the same for every part."""
    x, y, z = points.T
    turn = 2.5e-4 * (z - FACE / 2)
    x, y = x * numpy.cos(turn) - y * numpy.sin(turn), x * numpy.sin(turn) + y * numpy.cos(turn)
    angle = numpy.arctan2(y, x)
    lobe = 0.018 * numpy.cos(3 * angle - 0.9)
    x, y = x + lobe * numpy.cos(angle), y + lobe * numpy.sin(angle)
    return numpy.column_stack([(x + 0.0025 * y) * 0.996, y * 0.996, z * 0.996])


def scan(mesh, count, seed, shift=(0.0, 0.0, 0.0), noise_mm=0.004):
    """Points spread over the facets by area, with noise along their normals."""
    random = numpy.random.default_rng(seed)
    a, b, c = mesh[:, 0], mesh[:, 1], mesh[:, 2]
    normal = numpy.cross(b - a, c - a)
    area = numpy.linalg.norm(normal, axis=1)
    pick = random.choice(len(mesh), size=count, p=area / area.sum())
    r, s = random.random(count), random.random(count)
    over = r + s > 1
    r[over], s[over] = 1 - r[over], 1 - s[over]
    points = a[pick] + r[:, None] * (b - a)[pick] + s[:, None] * (c - a)[pick]
    points += (noise_mm * random.standard_normal(count) / area[pick])[:, None] * normal[pick]
    return points + numpy.array(shift)


def flank_errors(mesh):
    """Distance of the mesh's flank vertices from the involutes of the design [um]."""
    points = numpy.unique(mesh.reshape(-1, 3), axis=0)
    reference = 0.5 * MODULE * TEETH
    base = reference * math.cos(ALPHA)
    half = 0.5 * math.pi / TEETH + 2 * 0.1 * math.tan(ALPHA) / TEETH + math.tan(ALPHA) - ALPHA
    radius = numpy.hypot(points[:, 0], points[:, 1])
    points = points[(radius > reference - 0.6) & (radius < reference + 0.9)]
    radius = numpy.hypot(points[:, 0], points[:, 1])
    angle = numpy.arctan2(points[:, 1], points[:, 0])
    off = (angle + math.pi / TEETH) % (2 * math.pi / TEETH) - math.pi / TEETH
    unwound = numpy.sqrt(radius**2 - base**2)
    distance = 1e3 * (base * (numpy.abs(off) - half) + unwound - base * numpy.arctan2(unwound, base))
    # A turn of the whole gear is no error: a shear has one in it.
    return distance - numpy.sign(off) * numpy.mean(numpy.sign(off) * distance)


def rms(values):
    return math.sqrt(numpy.mean(values**2))


def write_xyz(path, points, head=""):
    path.write_text(head + "\n".join(f"{x:.6f} {y:.6f} {z:.6f}" for x, y, z in points) + "\n")


class RoundTrip(unittest.TestCase):
    def setUp(self):
        self.folder = OUTPUT / self.id().split(".")[-1]
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "design.toml").write_text(DESIGN)
        # Chords of 1 um are a real deviation of the mesh, and the loop finds it.
        run("make", self.folder / "design.toml", "-o", self.folder / "made", "--formats", "stl",
            "--tolerance-um", "0.1", "--quiet")
        self.made = triangles(self.folder / "made/gear.stl")

    def corrected(self, *data):
        run("loop", self.folder / "design.toml", *data, "--aligned", "-o", self.folder / "loop", "--quiet")
        run("make", self.folder / "design.toml", "-o", self.folder / "corrected", "--formats", "stl",
            "--correct", self.folder / "loop/loop.json", "--quiet")
        return (json.loads((self.folder / "loop/loop.json").read_text()),
                triangles(self.folder / "corrected/gear.stl"))

    def test_what_the_process_does_to_the_corrected_part_is_the_design(self):
        self.assertLess(rms(flank_errors(self.made)), 0.05)  # the mesh as made lies on the involutes
        distorted = process(self.made.reshape(-1, 3)).reshape(-1, 3, 3)
        write_xyz(self.folder / "scan.xyz", scan(distorted, 60000, 1))
        result, corrected = self.corrected(self.folder / "scan.xyz")
        ids = sorted(e["id"] for e in result["effects"])
        before = flank_errors(distorted)
        after = flank_errors(process(corrected.reshape(-1, 3)).reshape(-1, 3, 3))
        print("one part:", ids, f"{rms(before):.2f} -> {rms(after):.2f} um rms,",
              f"largest {abs(before).max():.1f} -> {abs(after).max():.1f}")
        self.assertEqual(ids, ["helix_error", "lobing", "scale", "skew"])
        self.assertGreater(rms(before), 12.0)
        self.assertLess(rms(after), rms(before) / 12)

    def test_of_three_parts_only_what_repeats_is_corrected(self):
        distorted = process(self.made.reshape(-1, 3)).reshape(-1, 3, 3)
        files = []
        for number, shift in enumerate([(0, 0, 0), (0.03, 0.01, 0), (0, 0, 0)], 1):
            path = self.folder / f"scan{number}.xyz"
            named = number == 3
            write_xyz(path, scan(distorted, 30000, number, shift), "# part = third\n" if named else "")
            files.append(path if named else f"part{number}={path}")
        result, corrected = self.corrected(*files)
        once = {e["id"]: e.get("part") for e in result["effects"] if not e["repeatable"]}
        always = sorted(e["id"] for e in result["effects"] if e["repeatable"])
        after = flank_errors(process(corrected.reshape(-1, 3)).reshape(-1, 3, 3))
        print("three parts:", always, once, result["new_part"], f"{rms(after):.2f} um")
        self.assertEqual([p["name"] for p in result["parts"]], ["part1", "part2", "third"])
        self.assertEqual(always, ["helix_error", "lobing", "scale", "skew"])
        self.assertEqual(once, {"eccentricity": "part2"})
        self.assertLess(rms(after), 2.0)

    def test_an_effect_of_the_users_own_is_found_and_corrected(self):
        random = self.made.reshape(-1, 3)
        sectors = process_of_declared(random).reshape(-1, 3, 3)
        write_xyz(self.folder / "scan.xyz", scan(sectors, 40000, 5))
        (self.folder / "mine.toml").write_text("""[leaning_sector]
description = "the gear turns with height, more on one side"
cause = "belt of one axis"
[leaning_sector.form]
amount_um = "side * v * (1 + cos(angle))"
""")
        run("loop", self.folder / "design.toml", self.folder / "scan.xyz", "--aligned", "--effects",
            self.folder / "mine.toml", "-o", self.folder / "loop", "--quiet")
        result = json.loads((self.folder / "loop/loop.json").read_text())
        found = {e["id"]: e for e in result["effects"]}
        self.assertEqual(list(found), ["leaning_sector"])
        self.assertAlmostEqual(found["leaning_sector"]["parameters"]["amount_um"]["value"], 10.0, delta=0.7)
        self.assertEqual(found["leaning_sector"]["cause"], "belt of one axis")
        self.assertIn("form", found["leaning_sector"])
        run("make", self.folder / "design.toml", "-o", self.folder / "corrected", "--formats", "stl",
            "--correct", self.folder / "loop/loop.json", "--quiet")
        corrected = triangles(self.folder / "corrected/gear.stl")
        before = rms(flank_errors(sectors))
        after = rms(flank_errors(process_of_declared(corrected.reshape(-1, 3)).reshape(-1, 3, 3)))
        print(f"declared: {before:.2f} -> {after:.2f} um rms")
        self.assertLess(after, before / 8)

    def test_a_scale_on_twisted_teeth_keeps_the_facets_on_the_corrected_flanks(self):
        beta, scale, amount = math.radians(25.0), 0.002, 14.0
        design = self.folder / "helical.toml"
        design.write_text(DESIGN.replace(f"module_mm = {MODULE}", f"module_mm = {MODULE}\n"
                                         "helix_angle_deg = 25.0"))
        loop = {"format": "trueflank-loop", "version": 1, "gear": "gear", "effects": [
            {"id": "scale", "parameters": {"percent": {"value": 100 * scale}}},
            {"id": "profile_crowning", "parameters": {"amount_um": {"value": amount}}}]}
        (self.folder / "loop.json").write_text(json.dumps(loop))
        run("make", design, "-o", self.folder / "corrected", "--formats", "stl", "--tolerance-um", "0.3",
            "--correct", self.folder / "loop.json", "--quiet")
        # Points inside the facets, not at their corners: facets must follow the flanks, too.
        made = scan(triangles(self.folder / "corrected/gear.stl"), 20000, 3, noise_mm=0.0)
        reference = 0.5 * MODULE * TEETH / math.cos(beta)
        alpha = math.atan(math.tan(ALPHA) / math.cos(beta))
        base = reference * math.cos(alpha)
        beta_b = math.atan(math.tan(beta) * math.cos(alpha))
        half = (0.5 * math.pi + 2 * 0.1 * math.tan(ALPHA)) / TEETH + math.tan(alpha) - alpha
        grown = made * (1 + scale)
        radius = numpy.hypot(grown[:, 0], grown[:, 1])
        angle = numpy.arctan2(grown[:, 1], grown[:, 0]) - math.tan(beta) / reference * grown[:, 2]
        off = (angle + math.pi / TEETH) % (2 * math.pi / TEETH) - math.pi / TEETH
        unwound = numpy.sqrt(numpy.maximum(radius**2 - base**2, 0.0))
        distance = 1e3 * math.cos(beta_b) * (base * (numpy.abs(off) - half) + unwound -
                                             base * numpy.arctan2(unwound, base))
        gear = json.loads((self.folder / "corrected/report.json").read_text())["gears"]["gear"]
        low, high = (math.sqrt(gear[f"{end}_form_diameter_mm"]**2 / 4 - base**2) for end in ("root", "tip"))
        distance -= amount * (2 * (unwound - low) / (high - low) - 1) ** 2
        on_flank = ((numpy.abs(radius - reference - 0.1) < 0.7) & (numpy.abs(distance) < 40.0) &
                    (numpy.abs(grown[:, 2] - FACE / 2) < 0.45 * FACE))
        self.assertGreater(numpy.count_nonzero(on_flank), 3000)
        self.assertLess(numpy.abs(distance[on_flank]).max(), 0.8)

    def test_what_a_compensated_part_still_lacks_is_corrected_on_top(self):
        (self.folder / "own.toml").write_text("[process.wide]\nhorizontal_expansion_mm = 0.03\n")
        (self.folder / "design.toml").write_text('tools = "own.toml"\n' + DESIGN +
                                                 '[made]\nprocess = "wide"\n')
        def make(name, *options, code=0):
            done = run("make", self.folder / "design.toml", "-o", self.folder / name, "--formats", "stl,step",
                       "--tolerance-um", "0.3", *options, code=code)
            return done if code else triangles(self.folder / name / "gear.stl")
        def closed(mesh):
            points = scan(mesh, 30000, 4)
            radius = numpy.hypot(points[:, 0], points[:, 1])
            write_xyz(self.folder / "scan.xyz", points[(radius > 11.4) & (radius < 12.9)])
            run("loop", self.folder / "design.toml", self.folder / "scan.xyz", "--aligned", "-o",
                self.folder / "loop", "--quiet")
            return [e["id"] for e in json.loads((self.folder / "loop/loop.json").read_text())["effects"]]
        both = ("--compensate", "--correct", self.folder / "loop/loop.json")
        grown = growing_process(make("moved", "--compensate"))
        found = closed(grown)
        corrected = make("corrected", *both)
        before, after = rms(flank_errors(grown)), rms(flank_errors(growing_process(corrected)))
        print(f"compensated: {found} {before:.2f} -> {after:.2f} um rms")
        self.assertIn("helix_error", found)
        self.assertGreater(before, 8.0)
        self.assertLess(after, before / 8)
        # without the compensation the corrected part would be too thick by all of the expansion
        self.assertGreater(rms(flank_errors(growing_process(make("alone", *both[1:])))), 25.0)
        files = json.loads((self.folder / "corrected/report.json").read_text())["files"]
        self.assertEqual([(f["format"], f["compensated_for"]) for f in files], [("stl", "wide")])
        # a part made without it shows the expansion, which must not be taken away twice
        found = closed(growing_process(make("plain")))
        self.assertTrue({"tooth_thickness", "contour_offset"} & set(found), found)
        self.assertIn("made without --compensate", make("twice", *both, code=2).stderr)
        self.assertLess(rms(flank_errors(growing_process(make("alone", *both[1:])))), before / 8)

    def test_the_upper_layer_of_a_whole_planet_is_found_in_the_frame_of_the_part(self):
        design = self.folder / "3k.toml"
        design.write_text("""format = 1
name = "compound"
[gearbox]
kind = "3k"
output = "ring2"
planets = 3
module_mm = 1.0
centre_distance_mm = 25.6826
[sun]
teeth = 12
face_width_mm = 8.0
[planet1]
teeth = 39
face_width_mm = 8.0
[ring1]
teeth = 90
shift = 0.5225
face_width_mm = 8.0
[planet2]
teeth = 32
face_width_mm = 9.0
[ring2]
teeth = 81
shift = 1.9967
face_width_mm = 9.0
""")
        run("make", design, "-o", self.folder / "made", "--formats", "stl", "--part", "planet", "--quiet",
            "--allow-failing", "--tolerance-um", "0.3", code=None)
        points = scan(triangles(self.folder / "made/planet.stl"), 60000, 7)
        upper = points[:, 2] > 8.5
        turn = 1e-4 * (points[upper, 2] - 9.0 - 4.5)  # the upper toothing alone is twisted
        x, y = points[upper, 0].copy(), points[upper, 1].copy()
        points[upper, 0] = x * numpy.cos(turn) - y * numpy.sin(turn)
        points[upper, 1] = x * numpy.sin(turn) + y * numpy.cos(turn)
        write_xyz(self.folder / "planet.xyz", points)
        run("loop", design, self.folder / "planet.xyz", "--aligned", "--gear", "planet2", "-o",
            self.folder / "loop", "--quiet")
        result = json.loads((self.folder / "loop/loop.json").read_text())
        self.assertTrue(any("frame of the part" in note for note in result["notes"]), result["notes"])
        found = {e["id"]: e["parameters"] for e in result["effects"]}
        self.assertAlmostEqual(found["helix_error"]["slope_um"]["value"], 1e3 * 1e-4 * 9.0 * 16 * math.cos(ALPHA),
                               delta=1.0)

    def test_a_byte_order_mark_is_no_column(self):
        table = self.folder / "bom.csv"
        rows = [f"index,{k},{flank},24,4,{math.sin(k):.3f}" for k in range(1, 25) for flank in ("left", "right")]
        table.write_text("\ufeffrecord,tooth,flank,diameter_mm,z_mm,deviation_um\n" + "\n".join(rows) + "\n",
                         encoding="utf-8")
        run("loop", self.folder / "design.toml", table, "-o", self.folder / "loop", "--quiet")

    def test_deviations_in_millimetres_are_doubted(self):
        table = self.folder / "mm.csv"
        rows = [f"index,{k},{flank},24,4,{1e-3 * math.sin(k):.6f}" for k in range(1, 25)
                for flank in ("left", "right")]
        table.write_text("record,tooth,flank,diameter_mm,z_mm,deviation_um\n" + "\n".join(rows) + "\n")
        run("loop", self.folder / "design.toml", table, "-o", self.folder / "loop", "--quiet")
        notes = json.loads((self.folder / "loop/loop.json").read_text())["notes"]
        self.assertTrue(any("millimetres" in note for note in notes), notes)

    def test_wrong_files_of_effects_are_refused_with_line_and_remedy(self):
        write_xyz(self.folder / "scan.xyz", scan(self.made, 2000, 5))
        for text, words in (("", "declares no effect"),
                            ("[a]\ndescription = \"x\"\n[a.form]\nb_um = \"u + w\"\n", "mine.toml:4"),
                            ("[scale]\ndescription = \"x\"\n[scale.form]\nb_um = \"u\"\n", "another name"),
                            ("[a]\ndescription = 3\n", "a.description"),
                            ("a = [\n", "mine.toml:1")):
            (self.folder / "mine.toml").write_text(text)
            done = run("loop", self.folder / "design.toml", self.folder / "scan.xyz", "--effects",
                       self.folder / "mine.toml", "-o", self.folder / "loop", code=2)
            self.assertIn(words, done.stderr, text)

    def test_useless_files_are_refused_and_half_good_ones_used(self):
        empty = self.folder / "empty.csv"
        empty.write_text("")
        self.assertIn("empty", run("loop", self.folder / "design.toml", empty, "-o", self.folder / "l",
                                   code=2).stderr)
        inches = self.folder / "inches.xyz"
        write_xyz(inches, scan(self.made, 4000, 5) / 25.4)
        self.assertIn("unit", run("loop", self.folder / "design.toml", inches, "-o", self.folder / "l",
                                  code=2).stderr)
        for seed in range(3):
            random = self.folder / "random.xyz"
            write_xyz(random, numpy.random.default_rng(seed).uniform(-13, 13, (5000, 3)))
            run("loop", self.folder / "design.toml", random, "-o", self.folder / "l", code=2)
        run("loop", self.folder / "design.toml", self.folder / "nowhere.xyz", "-o", self.folder / "l", code=3)
        half = self.folder / "half.xyz"
        lines = [f"{x} {y} {z}" for x, y, z in scan(self.made, 6000, 5)]
        half.write_text("\n".join(f"{line}\nnot a number here" for line in lines))
        run("loop", self.folder / "design.toml", half, "--aligned", "-o", self.folder / "l")
        notes = json.loads((self.folder / "l/loop.json").read_text())["notes"]
        self.assertTrue(any("half.xyz" in note for note in notes), notes)


def growing_process(mesh):
    """Flanks come out 30 um too far outwards, and turned with height by 25 um over the face."""
    x, y, z = mesh.reshape(-1, 3).T
    base = 0.5 * MODULE * TEETH * math.cos(ALPHA)
    off = (numpy.arctan2(y, x) + math.pi / TEETH) % (2 * math.pi / TEETH) - math.pi / TEETH
    turn = (0.030 * numpy.sign(off) + 0.025 * (z / FACE - 0.5)) / base
    return numpy.column_stack([x * numpy.cos(turn) - y * numpy.sin(turn),
                               x * numpy.sin(turn) + y * numpy.cos(turn), z]).reshape(-1, 3, 3)


def process_of_declared(points):
    """Turns sections with height, more on the side of +x: 10 um (1 + cos) at the ends of the face."""
    x, y, z = points.T
    base = 0.5 * MODULE * TEETH * math.cos(ALPHA)
    v = 2 * z / FACE - 1
    turn = 0.010 * v * (1 + numpy.cos(numpy.arctan2(y, x))) / base
    return numpy.column_stack([x * numpy.cos(turn) - y * numpy.sin(turn),
                               x * numpy.sin(turn) + y * numpy.cos(turn), z])


if __name__ == "__main__":
    unittest.main(verbosity=2)
