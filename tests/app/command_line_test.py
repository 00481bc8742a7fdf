# SPDX-License-Identifier: GPL-3.0-or-later
"""The program as its users meet it: commands, exit codes, messages, files that appear or do not."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
DESIGN = SOURCE / "examples/bilateral_drive/design.toml"

PAIR = """format = 1
name = "p"
[gearbox]
kind = "pair"
module_mm = 1.0
backlash_mm = 0.05
[pinion]
teeth = 17
face_width_mm = 8.0
[wheel]
teeth = 40
face_width_mm = 8.0
"""


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=60, **options)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = OUTPUT / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def design(self, text=PAIR, name="design.toml"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def expect_error(self, result, code, *words):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        for word in words:
            self.assertIn(word, result.stderr)
        for line in result.stderr.splitlines():
            self.assertTrue(line.startswith("trueflank: "), line)


class CheckOptions(Case):
    def test_tolerances_add_findings(self):
        result = run("check", self.design(), "--tolerance", "tooth_thickness_um=5", "--json", "-")
        self.assertEqual(result.returncode, 0, result.stderr)
        ids = [(c["id"], c["where"]) for c in json.loads(result.stdout)["checks"]]
        self.assertIn(("tolerance", "pinion-wheel"), ids)
        self.assertIn(("tolerance", "train"), ids)

    def test_a_wrong_tolerance_is_wrong_usage(self):
        self.expect_error(run("check", self.design(), "--tolerance", "fine"), 2, "fine")

    def test_pictures_are_drawn_for_every_mesh(self):
        result = run("check", DESIGN, "--pictures", self.folder / "pictures", "-q")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(p.name for p in (self.folder / "pictures").iterdir()),
                         ["planet1-ring1.svg", "planet2-ring2.svg", "sun-planet1.svg"])


class CommandLine(Case):
    def test_alone_it_tells_a_newcomer_what_to_do(self):
        result = run()
        self.assertEqual(result.returncode, 0)
        self.assertIn("trueflank new", result.stdout)
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)

    def test_help_everywhere_and_version(self):
        for command in [[], ["check"], ["make"], ["compare"], ["search"], ["loop"], ["new"]]:
            result = run(*command, "--help")
            self.assertEqual(result.returncode, 0, command)
            self.assertIn("Usage", result.stdout)
            self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80, command)
        self.assertRegex(run("--version").stdout, r"^trueflank \d+\.\d+\.\d+\n$")

    def test_wrong_usage_is_two(self):
        for arguments in [["frobnicate"], ["check"], ["make", DESIGN], ["check", DESIGN, "--no"],
                          ["make", DESIGN, "-o", self.folder, "--formats", "stp"],
                          ["make", DESIGN, "-o", self.folder, "--tolerance-um", "0"],
                          ["make", DESIGN, "-o", self.folder, "--tolerance-um", "nan"],
                          ["make", DESIGN, "-o", self.folder, "--part", "moon"]]:
            result = run(*arguments)
            self.expect_error(result, 2)
        self.assertEqual(list(self.folder.iterdir()), [])


class Check(Case):
    def test_table_fits_a_terminal_and_json_holds_the_same(self):
        result = run("check", DESIGN, "--json", self.folder / "r.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)
        self.assertNotIn("\033", result.stdout)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["format"], "trueflank-report")
        self.assertAlmostEqual(report["train"]["ratio"], 96.2419, places=4)
        self.assertAlmostEqual(report["efficiency"]["by_formula"]["forward"], 0.908, places=3)
        self.assertAlmostEqual(report["efficiency"]["forward"], 0.915, places=3)
        self.assertIn(f"{report['train']['ratio']:.4f}", result.stdout)
        self.assertEqual([g for g in report["gears"]],
                         ["sun", "planet1", "ring1", "planet2", "ring2"])

    def test_a_design_in_inches_is_told_in_both(self):
        design = self.folder / "inch.toml"
        gear = lambda name, teeth: f"[{name}]\nteeth = {teeth}\nface_width_in = 0.25\n"
        design.write_text('format = 1\n[gearbox]\nkind = "pair"\ndiametral_pitch = 24\n' + gear("pinion", 20) + gear("wheel", 30))
        result = run("check", design, "--json", self.folder / "r.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)
        self.assertIn("centre distance 1.04167 in", result.stdout)
        report = json.loads((self.folder / "r.json").read_text())
        inches = report["inches"]
        self.assertAlmostEqual(inches["centre_distance_in"] * 25.4, report["train"]["centre_distance_mm"])
        self.assertAlmostEqual(inches["gears"]["wheel"]["tip_diameter_in"], 32 / 24, places=9)
        self.assertEqual(inches["gears"]["wheel"]["diametral_pitch"], 24)
        self.assertNotIn(" in\n", run("check", self.design()).stdout)

    def test_a_mistyped_centre_distance_is_named_not_what_nobody_wrote(self):
        design = self.folder / "far.toml"
        gear = lambda name, teeth: f"[{name}]\nteeth = {teeth}\nface_width_mm = 5\n"
        for typed in (30, 250, 2500):
            design.write_text('format = 1\n[gearbox]\nkind = "pair"\nmodule_mm = 1\n'
                              f"centre_distance_mm = {typed}\n" + gear("pinion", 20) + gear("wheel", 30))
            result = run("check", design)
            self.expect_error(result, 2, "gearbox.centre_distance_mm", "25 mm")
            self.assertNotIn("tip_diameter", result.stderr)

    def test_a_rack_too_steep_for_its_depth_is_told_by_its_angle_too(self):
        steep = PAIR + "[rack]\npressure_angle_deg = 33\n"
        self.expect_error(run("check", self.design(steep)), 2, "rack", "a pressure angle of at most 32.1")
        for refused in ("45", "47.5", "50"):
            self.expect_error(run("check", self.design(steep.replace("33", refused))), 2,
                              f"rack.pressure_angle_deg = {refused}", "from 5 to 44 deg")

    def test_helical_sets_tell_hands_overlap_thrust_and_what_cannot_be_measured(self):
        design = SOURCE / "examples/helical_planetary/design.toml"
        result = run("check", design, "--json", self.folder / "r.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        table = result.stdout[result.stdout.index("helix: "):]
        self.assertLessEqual(max(map(len, table.splitlines())), 80)
        self.assertIn("net axial thrust", table)
        report = json.loads((self.folder / "r.json").read_text())
        gears, meshes = report["gears"], report["meshes"]
        self.assertEqual([gears[g]["hand"] for g in gears], ["right", "left", "left"])
        self.assertAlmostEqual(gears["sun"]["transverse_module_mm"], 1.0641778, places=7)
        self.assertEqual(gears["ring"]["over_pins_with"], "balls")
        self.assertIsNone(gears["ring"]["span_mm"])
        self.assertIn("ring", gears["ring"]["span_note"])
        for mesh in meshes.values():
            self.assertAlmostEqual(mesh["overlap_ratio"], 1.5242, places=4)
            self.assertAlmostEqual(mesh["total_contact_ratio"],
                                   mesh["effective_contact_ratio"] + mesh["overlap_ratio"])
        bodies = {name: b["n_per_nm"] for name, b in report["axial_thrust"]["bodies"].items()}
        self.assertGreater(abs(bodies["sun"]), 10)
        self.assertLess(abs(bodies["sun"] + bodies["ring"]), 0.02 * abs(bodies["sun"]) + 1e-9 +
                        3 * abs(bodies["planet"]))
        narrow = design.read_text().replace("face_width_mm = 14.0", "face_width_mm = 2.0")
        report = json.loads(run("check", self.design(narrow), "--json", "-").stdout)
        self.assertIsNone(report["gears"]["planet"]["span_mm"])
        self.assertIn("face width", report["gears"]["planet"]["span_note"])

    def test_modified_flanks_are_checked(self):
        result = run("check", SOURCE / "examples/relieved_3k/design.toml", "--json", "-")
        report = json.loads(result.stdout)
        self.assertTrue(report["gears"]["planet1"]["modified"])
        self.assertFalse(report["gears"]["ring1"]["modified"])
        for mesh in report["meshes"].values():
            self.assertLessEqual(mesh["unrelieved_contact_ratio"], mesh["effective_contact_ratio"])
            self.assertAlmostEqual(mesh["modified_backlash_mm"], 0.05, places=4)

    def test_json_on_standard_output_is_alone_there(self):
        result = run("check", DESIGN, "--json", "-")
        json.loads(result.stdout)
        self.assertEqual(run("check", DESIGN, "--json", "-").stdout, result.stdout)

    def test_html_is_one_page(self):
        result = run("check", DESIGN, "--html", self.folder / "r.html", "--quiet")
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        page = (self.folder / "r.html").read_text()
        self.assertIn("</html>", page)

    def test_failing_design_is_one(self):
        text = PAIR.replace("backlash_mm = 0.05", "centre_distance_mm = 28.3")
        text = text.replace("teeth = 17", "teeth = 17\nshift = 0.0")
        text = text.replace("teeth = 40", "teeth = 40\nshift = 0.0")
        result = run("check", self.design(text))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("verdict: fail", result.stdout)

    def test_errors_name_file_line_key_value_and_cure(self):
        path = self.design(PAIR.replace("teeth = 17", "teeths = 17").replace(
            "face_width_mm = 8.0\n[wheel]", "face_width_mm = -8.0\n[wheel]"))
        result = run("check", path)
        self.expect_error(result, 2, f"{path}:8: pinion.teeths", "-8", "pinion.face_width_mm")
        self.assertGreaterEqual(len(result.stderr.splitlines()), 2)

    def test_layout_errors_have_a_line_too(self):
        text = PAIR.replace("backlash_mm = 0.05", "centre_distance_mm = 12.0")
        self.expect_error(run("check", self.design(text)), 2, "design.toml:6:", "centre_distance_mm")

    def test_parts_that_cannot_be_built_fail_here_and_not_only_when_made(self):
        # the ring's shift is solved: how large its root circle is shows only then
        path = self.design("""format = 1
[gearbox]
kind = "simple"
module_mm = 0.3
planets = 3
centre_distance_mm = 12.15
[sun]
teeth = 43
face_width_mm = 3
[planet]
teeth = 38
face_width_mm = 3
[ring]
teeth = 119
face_width_mm = 3
outer_diameter_mm = 36.3
""")
        for command in (["check", path], ["make", path, "-o", self.folder / "out"]):
            self.expect_error(run(*command), 2, f"{path}:16: ring.outer_diameter_mm", "too thin")
        self.assertFalse((self.folder / "out").exists())

    def test_environment_is_three(self):
        self.expect_error(run("check", self.folder / "none.toml"), 3, "none.toml")
        self.expect_error(run("check", DESIGN, "--json", self.folder / "no/such/r.json"), 3)
        self.expect_error(run("check", DESIGN, "--json", "/dev/full"), 3, "/dev/full")
        self.assertTrue(os.path.exists("/dev/full") and not os.path.isfile("/dev/full"))

    def test_rubbish_is_two(self):
        for content in [b"\x7fELF\x00\x01\x02" * 50, b"", b"\xff\xfe", "ä = 1".encode(),
                        b"30\xef\xb9\xbf = 1", b"[" * 2000]:
            self.expect_error(run("check", self.design(content)), 2)
        self.expect_error(run("check", self.folder), 2)

    def test_full_standard_output_is_three(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "check", str(DESIGN)], stdout=full,
                                    stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(result.returncode, 3)


class Make(Case):
    def test_writes_every_part_format_and_report(self):
        result = run("make", DESIGN, "-o", self.folder / "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        out = self.folder / "out"
        for extension in ["stl", "3mf", "obj", "ply", "glb", "step", "dxf", "svg", "scad"]:
            for part in ["sun", "planet", "ring1", "ring2"]:
                self.assertTrue((out / f"{part}.{extension}").is_file(), f"{part}.{extension}")
        for extension in ["3mf", "glb", "step", "scad"]:
            self.assertTrue((out / f"assembly.{extension}").is_file(), extension)
        report = json.loads((out / "report.json").read_text())
        self.assertTrue((out / "report.html").is_file())
        meshes = [f for f in report["files"]
                  if f["format"] in ("stl", "3mf", "obj", "ply", "glb") and f["part"] != "assembly"]
        self.assertEqual(len(meshes), 20)
        for file in meshes:
            self.assertLessEqual(file["accuracy_um"], 1.0, file)
            self.assertGreater(file["accuracy_um"], 0.5, file)
        self.assertEqual([p for p in out.iterdir() if p.name.startswith(".") or "tmp" in p.name], [])

    def test_the_same_input_gives_the_same_bytes(self):
        for name in "ab":
            self.assertEqual(run("make", DESIGN, "-o", self.folder / name, "-q").returncode, 0)
        for file in (self.folder / "a").iterdir():
            self.assertEqual(file.read_bytes(), (self.folder / "b" / file.name).read_bytes(),
                             file.name)

    def test_tolerance_is_kept(self):
        for tolerance in ["10", "0.1"]:
            out = self.folder / tolerance
            self.assertEqual(run("make", DESIGN, "-o", out, "--formats", "stl",
                                 "--tolerance-um", tolerance, "-q").returncode, 0)
            for file in json.loads((out / "report.json").read_text())["files"]:
                if file["accuracy_um"] is not None:
                    self.assertLessEqual(file["accuracy_um"], float(tolerance), file)

    def test_one_part_and_some_formats(self):
        self.assertEqual(run("make", DESIGN, "-o", self.folder / "out", "--part", "sun",
                             "--formats", "stl,step", "-q").returncode, 0)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                         ["report.html", "report.json", "sun.step", "sun.stl"])

    def test_failing_design_writes_the_report_and_no_part(self):
        text = PAIR.replace("backlash_mm = 0.05", "centre_distance_mm = 28.3")
        text = text.replace("teeth = 17", "teeth = 17\nshift = 0.0")
        text = text.replace("teeth = 40", "teeth = 40\nshift = 0.0")
        design = self.design(text)
        self.assertEqual(run("make", design, "-o", self.folder / "out").returncode, 1)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                         ["report.html", "report.json"])
        self.assertEqual(run("make", design, "-o", self.folder / "out", "--formats", "stl",
                             "--allow-failing").returncode, 1)
        self.assertTrue((self.folder / "out" / "pinion.stl").is_file())

    def test_modified_teeth_keep_the_tolerance_and_differ_from_the_design(self):
        out = self.folder / "out"
        text = PAIR + "[pinion.modifications]\ncrowning_um = 20\nedge_chamfer_mm = 0.2\n"
        result = run("make", self.design(text), "-o", out, "--formats", "stl")
        self.assertEqual(result.returncode, 0, result.stderr)
        plain = self.folder / "plain"
        self.assertEqual(run("make", self.design(PAIR), "-o", plain, "--formats", "stl").returncode, 0)
        files, before = ({f["part"]: f for f in json.loads((d / "report.json").read_text())["files"]}
                         for d in (out, plain))
        self.assertLessEqual(files["pinion"]["accuracy_um"], 1.0)
        self.assertLess(files["pinion"]["volume_mm3"], before["pinion"]["volume_mm3"] - 1.0)
        self.assertEqual(files["wheel"], before["wheel"])

    def test_modified_and_grooved_teeth_are_exact_in_step_and_in_drawings(self):
        text = PAIR.replace("backlash_mm", "helix_angle_deg = 20.0\nherringbone = true\n"
                            "relief_groove_mm = 1.0\nbacklash_mm")
        text += "[pinion.modifications]\ncrowning_um = 20\nedge_chamfer_mm = 0.2\n"
        out = self.folder / "out"
        result = run("make", self.design(text), "-o", out, "--formats", "step,dxf,svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        files = json.loads((out / "report.json").read_text())["files"]
        for file in files:
            self.assertLessEqual(file["accuracy_um"], 0.01 if file["format"] == "step" else 1.0, file)
        self.assertIn("B_SPLINE_SURFACE_WITH_KNOTS", (out / "pinion.step").read_text())

    def test_a_part_without_a_file_is_named(self):
        result = run("loop", self.design(), "p1=", "--gear", "pinion", "-o", self.folder / "out")
        self.expect_error(result, 3, "p1=: there is no such file")

    def test_where_nothing_is_held_out_what_is_left_is_told_of_all_values(self):
        (self.folder / "one.csv").write_text("record,tooth,flank,diameter_mm,z_mm,deviation_um\n" +
                                             "".join(f"helix,1,left,17,4,{k}\n" for k in range(300)))
        result = run("loop", self.design(), self.folder / "one.csv", "--gear", "pinion", "-o", self.folder / "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        loop = json.loads((self.folder / "out" / "loop.json").read_text())
        self.assertEqual(loop["data"]["held_out"], 0)
        told = loop["structure_left"]["description"]
        self.assertIn("what is left, 86.6 um, is more than the measurement's own noise", told)

    def test_a_correction_too_sharp_for_splines_goes_into_meshes_only(self):
        loop = {"format": "trueflank-loop", "version": 1, "gear": "pinion", "effects": [
            {"id": "contour_offset", "flank": "both", "parameters": {"offset_um": {"value": 20}}}]}
        (self.folder / "loop.json").write_text(json.dumps(loop))
        out = self.folder / "out"
        result = run("make", self.design(PAIR), "-o", out, "--formats", "stl,step,svg", "--correct",
                     self.folder / "loop.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("not written: step, svg (meshes hold the correction", result.stdout)
        self.assertTrue((out / "pinion.stl").is_file())
        self.assertFalse((out / "pinion.step").exists())

    def test_correction_displaces_the_toothing_within_the_tolerance(self):
        design = self.design(PAIR)
        loop = {"format": "trueflank-loop", "version": 1, "gear": "pinion", "effects": [
            {"id": "eccentricity", "flank": "both",
             "parameters": {"amplitude_um": {"value": 40}, "phase_deg": {"value": 30}}},
            {"id": "crowning", "flank": "both", "parameters": {"amount_um": {"value": 15}}}]}
        (self.folder / "loop.json").write_text(json.dumps(loop))
        out = self.folder / "out"
        result = run("make", design, "-o", out, "--formats", "stl", "--correct",
                     self.folder / "loop.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("corrected on pinion: eccentricity", result.stdout)
        for file in json.loads((out / "report.json").read_text())["files"]:
            self.assertLessEqual(file["accuracy_um"], 1.0, file)
        plain = self.folder / "plain"
        self.assertEqual(run("make", design, "-o", plain, "--formats", "stl").returncode, 0)
        compared = run("compare", plain / "pinion.stl", out / "pinion.stl", "--tolerance-um", "30")
        self.assertEqual(compared.returncode, 1, compared.stdout)
        compared = run("compare", plain / "pinion.stl", out / "pinion.stl", "--tolerance-um", "60")
        self.assertEqual(compared.returncode, 0, compared.stdout)

    def test_helical_and_herringbone_pairs_are_written_within_the_tolerance(self):
        for more in ["", "herringbone = true\n"]:
            design = self.design(PAIR.replace("backlash_mm", "helix_angle_deg = 15.0\n" + more +
                                              "backlash_mm"))
            out = self.folder / f"out{len(more)}"
            result = run("make", design, "-o", out, "--formats", "stl,3mf", "--tolerance-um", "2")
            self.assertEqual(result.returncode, 0, result.stderr)
            files = json.loads((out / "report.json").read_text())["files"]
            self.assertEqual(len(files), 6)
            for file in files:
                self.assertGreater(file["accuracy_um"], 1.0, file)
                self.assertLessEqual(file["accuracy_um"], 2.0, file)

    def test_every_format_holds_modified_flanks(self):
        design = self.design(PAIR + "[pinion.modifications]\ncrowning_um = 20\n")
        result = run("make", design, "-o", self.folder / "out", "--tolerance-um", "20")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("not written", result.stdout)
        scad = (self.folder / "out" / "pinion.scad").read_text()
        self.assertIn("modified_rows(", scad.split("// ---")[0])
        self.assertLess(len(scad), 40000)

    def test_folder_that_is_a_file_is_three(self):
        (self.folder / "taken").write_text("mine")
        self.expect_error(run("make", DESIGN, "-o", self.folder / "taken"), 3, "taken")
        self.assertEqual((self.folder / "taken").read_text(), "mine")

    def test_interrupted_leaves_nothing_half_written(self):
        out = self.folder / "out"
        process = subprocess.Popen([PROGRAM, "make", str(DESIGN), "-o", str(out),
                                    "--tolerance-um", "0.02"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        for _ in range(400):
            time.sleep(0.005)
            if out.is_dir() and any(out.iterdir()):
                break
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertIn(process.returncode, (0, 3))
        if process.returncode == 3:
            for file in out.iterdir():
                self.assertRegex(file.name, r"^[a-z0-9_]+\.[a-z0-9]+$")
                if file.suffix == ".stl":
                    size = file.stat().st_size
                    count = int.from_bytes(file.read_bytes()[80:84], "little")
                    self.assertEqual(size, 84 + 50 * count)


class Compare(Case):
    def setUp(self):
        super().setUp()
        run("make", DESIGN, "-o", self.folder / "a", "--formats", "stl,obj,3mf", "--part", "sun", "-q")
        run("make", DESIGN, "-o", self.folder / "b", "--formats", "stl", "--part", "sun", "-q",
            "--tolerance-um", "3")

    def test_same_shape_is_zero_whatever_format_and_mesh(self):
        a = self.folder / "a"
        self.assertEqual(run("compare", a / "sun.stl", a / "sun.stl").returncode, 0)
        self.assertEqual(run("compare", a / "sun.stl", a / "sun.obj").returncode, 0)
        self.assertEqual(run("compare", a / "sun.stl", a / "sun.3mf").returncode, 0)
        self.assertEqual(run("compare", a / "sun.stl", self.folder / "b/sun.stl",
                             "--tolerance-um", "4.2").returncode, 0)

    def test_different_shape_is_one_and_tells_where(self):
        moved = PAIR.replace("backlash_mm = 0.05", "backlash_mm = 0.07")
        run("make", self.design(), "-o", self.folder / "c", "--formats", "stl", "-q")
        run("make", self.design(moved), "-o", self.folder / "d", "--formats", "stl", "-q")
        result = run("compare", self.folder / "c/pinion.stl", self.folder / "d/pinion.stl")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex(result.stdout, r"\d+\.\d+ um")

    def test_what_is_no_mesh_is_two_and_what_is_not_there_three(self):
        mesh = self.folder / "a/sun.stl"
        self.expect_error(run("compare", mesh, DESIGN), 2)
        self.expect_error(run("compare", mesh, self.folder / "none.stl"), 3)
        (self.folder / "cut.stl").write_bytes(mesh.read_bytes()[:-100])
        self.expect_error(run("compare", mesh, self.folder / "cut.stl"), 2, "cut.stl")


class New(Case):
    def test_what_it_writes_makes_at_once(self):
        for kind in ["3k", "stepped", "simple", "two-stage", "pair", "gear"]:
            result = run("new", f"d{kind}", "--kind", kind, cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            made = run("make", self.folder / f"d{kind}.toml", "-o", self.folder / kind, "-q",
                       "--formats", "stl")
            self.assertEqual(made.returncode, 0, made.stdout + made.stderr)

    def test_a_name_must_name_something(self):
        for name in ["", "..", ".toml", str(self.folder) + "/"]:
            result = run("new", name, cwd=self.folder)
            self.expect_error(result, 2, "NAME", "a name")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_the_next_command_runs_whatever_the_name(self):
        result = run("new", "it's a $gear", "--kind", "gear", cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        command = result.stdout.split("next: trueflank ")[1].strip()
        made = subprocess.run(f"{PROGRAM} {command} --formats svg", shell=True, cwd=self.folder,
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertTrue((self.folder / "it's a $gear" / "gear.svg").exists())

    def test_it_never_replaces_a_file(self):
        (self.folder / "mine.toml").write_text("mine")
        self.expect_error(run("new", "mine", cwd=self.folder), 2, "mine.toml")
        self.assertEqual((self.folder / "mine.toml").read_text(), "mine")


if __name__ == "__main__":
    unittest.main(verbosity=1)
