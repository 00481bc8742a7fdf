# SPDX-License-Identifier: GPL-3.0-or-later
"""Every function of the Python package, its values against the program's own files."""
import json
import os
import pathlib
import shutil
import subprocess
import unittest

import numpy as np
import trueflank

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


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120)


class Bindings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = OUTPUT / "made"
        shutil.rmtree(OUTPUT, ignore_errors=True)
        OUTPUT.mkdir(parents=True)
        result = program("make", DESIGN, "-o", cls.made, "--formats", "stl,step,ply", "-q")
        assert result.returncode == 0, result.stderr
        cls.report = json.loads((cls.made / "report.json").read_text())
        cls.gearbox = trueflank.read(DESIGN)

    def test_report_is_the_programs(self):
        report = self.gearbox.report()
        for key in ("design", "train", "gears", "meshes", "efficiency", "checks", "verdict"):
            self.assertEqual(report[key], self.report[key], key)
        self.assertEqual(self.gearbox.checks(), self.report["checks"])
        page = self.gearbox.report_html()
        self.assertTrue(page.rstrip().endswith("</html>"))

    def test_names_and_sizes(self):
        g = self.gearbox
        self.assertEqual((g.name, g.kind), ("bilateral-drive", "3k"))
        self.assertEqual(g.gears, list(self.report["gears"]))
        self.assertEqual(g.parts, ["sun", "planet", "ring1", "ring2"])
        self.assertEqual(g.centre_distance_mm, self.report["train"]["centre_distance_mm"])
        self.assertIn("bilateral-drive", repr(g))

    def test_design_text_reads_back(self):
        again = trueflank.read_text(self.gearbox.design_text(), name="again.toml")
        self.assertEqual(again.report(), self.gearbox.report())

    def test_profile_lies_between_root_and_tip(self):
        for name, gear in self.report["gears"].items():
            points = self.gearbox.profile(name, tolerance_um=1)
            self.assertEqual(points.shape[1], 2)
            self.assertEqual(len(points) % gear["teeth"], 0)
            radii = np.hypot(*points.T)
            ends = sorted([gear["tip_diameter_mm"], gear["root_diameter_mm"]])
            self.assertAlmostEqual(2 * radii.min(), ends[0], places=6)
            self.assertAlmostEqual(2 * radii.max(), ends[1], places=6)
        self.assertGreater(len(self.gearbox.profile("sun", 0.1)), len(self.gearbox.profile("sun", 10)))

    def test_mesh_is_the_programs_file(self):
        for part in self.gearbox.parts:
            mesh = self.gearbox.mesh(part, tolerance_um=1)
            file = trueflank.Mesh.read(self.made / f"{part}.ply")
            self.assertTrue(mesh.is_valid)
            self.assertLessEqual(mesh.chord_error_um, 1.0)
            self.assertIsNone(file.chord_error_um)
            row = next(f for f in self.report["files"] if f["path"] == f"{part}.ply")
            self.assertEqual(len(file.triangles), row["triangles"])
            self.assertAlmostEqual(file.volume_mm3, row["volume_mm3"], delta=1e-9 * file.volume_mm3)
            # files are made a little finer, so that rounding stays within the tolerance: not the same
            # corners, the same surface
            self.assertTrue(trueflank.compare(mesh, file, tolerance_um=1.1)["same"], part)
            # both lie within 1 um of it: no more than that times its area lies between them
            corners = mesh.vertices[mesh.triangles]
            sides = corners[:, 1:] - corners[:, :1]
            area_mm2 = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum()
            self.assertAlmostEqual(mesh.volume_mm3, file.volume_mm3, delta=1e-3 * area_mm2)

    def test_arrays_are_views_that_outlive_their_mesh(self):
        vertices = self.gearbox.mesh("sun").vertices
        copy = vertices.copy()
        np.testing.assert_array_equal(vertices, copy)
        self.assertEqual(vertices.dtype, np.float64)
        with self.assertRaises(ValueError):
            vertices[0, 0] = 1.0

    def test_mesh_from_arrays(self):
        tetrahedron = trueflank.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                                     np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
        self.assertTrue(tetrahedron.is_valid)
        self.assertAlmostEqual(tetrahedron.volume_mm3, 1 / 6)
        for vertices, triangles in [([[0, 0]], [[0, 0, 0]]), ([[0, 0, 0]], [[0, 0, 1]]),
                                    ([[0, 0, 0]], [[0, 0, -1]]), ([[0, 0, 0]], [0, 0, 0])]:
            with self.assertRaises(trueflank.InputError):
                trueflank.Mesh(vertices, triangles)

    def test_assembly_places_every_body(self):
        bodies = self.gearbox.assembly()
        self.assertEqual([b["part"] for b in bodies].count("planet"), 3)
        whole = trueflank.Mesh.read(self.made / "assembly.ply")
        meshes = {part: trueflank.Mesh.read(self.made / f"{part}.ply") for part in self.gearbox.parts}
        corners = np.vstack([meshes[b["part"]].vertices @ b["matrix"][:3, :3].T + b["matrix"][:3, 3]
                             for b in bodies])
        self.assertEqual(corners.shape, whole.vertices.shape)
        np.testing.assert_allclose(corners.min(0), whole.vertices.min(0), atol=1e-6)
        np.testing.assert_allclose(corners.max(0), whole.vertices.max(0), atol=1e-6)

    def test_step_and_export_are_the_programs_files(self):
        self.assertEqual(self.gearbox.step_text("planet"), (self.made / "planet.step").read_text())
        self.assertEqual(self.gearbox.step_text(), (self.made / "assembly.step").read_text())
        folder = OUTPUT / "exported"
        files = self.gearbox.export(folder, formats=["stl", "step", "ply"], tolerance_um=1)
        self.assertEqual(files, self.report["files"])
        for file in files:
            self.assertEqual((folder / file["path"]).read_bytes(), (self.made / file["path"]).read_bytes())
        one = self.gearbox.export(OUTPUT / "one", part="sun")
        self.assertEqual([f["path"] for f in one], ["sun.stl", "sun.3mf"])

    def test_efficiency(self):
        result = self.gearbox.efficiency()
        self.assertEqual(result["forward"], self.report["efficiency"]["forward"])
        self.assertEqual(result["backward"], self.report["efficiency"]["backward"])
        self.assertEqual([m["basic_efficiency"] for m in result["meshes"]],
                         [m["by_path_integral"] for m in self.report["efficiency"]["meshes"].values()])
        self.assertAlmostEqual(self.gearbox.efficiency(friction=0)["forward"], 1.0, places=12)
        drive = result["forward_drive"]
        self.assertAlmostEqual(sum(m["power"] for m in drive["members"]), 1 - result["forward"], places=12)
        self.assertNotEqual(self.gearbox.efficiency(loss_model="contact_ratios")["forward"], result["forward"])

    def test_compare_is_the_programs(self):
        golden = SOURCE / "examples/golden_mesh/golden/sun.stl"
        mine = program("compare", golden, self.made / "sun.stl", "--json", "-")
        theirs = trueflank.compare(trueflank.Mesh.read(golden), trueflank.Mesh.read(self.made / "sun.stl"))
        expected = json.loads(mine.stdout)
        self.assertFalse(theirs["same"])
        for key in ("golden_to_new", "new_to_golden", "max_um", "difference"):
            self.assertEqual(theirs[key], expected[key], key)
        mesh = self.gearbox.mesh("sun")
        self.assertTrue(trueflank.compare(mesh, mesh, tolerance_um=0.01)["same"])

    def test_search_finds_what_the_program_finds(self):
        text = (SOURCE / "examples/python/search.py").read_text().split('"""')[3]
        requirements = OUTPUT / "around-96.toml"
        requirements.write_text(text)
        self.assertEqual(program("search", requirements, "-o", OUTPUT / "search", "-q").returncode, 0)
        found = trueflank.search(requirements, threads=1)
        self.assertEqual(found.summary, json.loads((OUTPUT / "search/search.json").read_text()))
        self.assertEqual(found.csv_text(), (OUTPUT / "search/search.csv").read_text())
        self.assertEqual(len(found.designs), len(found.summary["designs"]))
        file = trueflank.read(OUTPUT / "search/design-001.toml")
        self.assertEqual(found.designs[0].report(), file.report())
        self.assertEqual(trueflank.search_text(text).summary["considered"], found.summary["considered"])

    def test_loop_is_the_programs(self):
        design = OUTPUT / "gear.toml"
        design.write_text('format = 1\nname = "g"\n[gearbox]\nkind = "gear"\nmodule_mm = 1.0\n[gear]\n'
                          "teeth = 36\nshift = 0.0\nface_width_mm = 10.0\n")
        random = np.random.default_rng(3)
        rows = ["# zero = common", "record,tooth,flank,diameter_mm,z_mm,deviation_um"]
        for tooth in range(1, 37):
            for flank, side in (("left", 1), ("right", -1)):
                angle = 2 * np.pi * (tooth - 1) / 36 + side * (np.pi / 72 + np.pi / 2 - np.radians(20))
                rows.append(f"index,{tooth},{flank},36,5,{30 * np.cos(angle - 0.7) + random.normal():.4f}")
        data = OUTPUT / "inspection.csv"
        data.write_text("\n".join(rows) + "\n")
        self.assertEqual(program("loop", design, data, "-o", OUTPUT / "loop", "-q").returncode, 0)
        gearbox = trueflank.read(design)
        loop = gearbox.close_loop("gear", [data])
        self.assertEqual(loop.json_text(), (OUTPUT / "loop/loop.json").read_text())
        self.assertEqual(loop.result, json.loads(loop.json_text()))
        self.assertEqual(loop.html(), (OUTPUT / "loop/loop.html").read_text())
        self.assertEqual(loop.verdict, loop.result["verdict"])
        self.assertIn("eccentricity", loop.text())
        self.assertEqual(len(loop.before_um), 72)
        self.assertLess(np.std(loop.after_um), 0.2 * np.std(loop.before_um))
        corrected = gearbox.corrected_meshes(OUTPUT / "loop/loop.json", tolerance_um=5)
        self.assertEqual(list(corrected), ["gear"])
        self.assertEqual(program("make", design, "-o", OUTPUT / "corrected", "--formats", "ply", "-q",
                                 "--tolerance-um", "5", "--correct", OUTPUT / "loop/loop.json").returncode, 0)
        self.assertTrue(trueflank.compare(corrected["gear"], trueflank.Mesh.read(OUTPUT / "corrected/gear.ply"),
                                          tolerance_um=5.1)["same"])
        self.assertGreater(trueflank.compare(gearbox.mesh("gear", 5), corrected["gear"])["max_um"], 25)

    def test_loop_of_several_parts_and_own_effects_is_the_programs(self):
        design = OUTPUT / "parts.toml"
        design.write_text('format = 1\nname = "g"\n[gearbox]\nkind = "gear"\nmodule_mm = 1.0\n[gear]\n'
                          "teeth = 20\nshift = 0.0\nface_width_mm = 10.0\n")
        mine = OUTPUT / "mine.toml"
        mine.write_text('[split]\ndescription = "halves"\n[split.form]\n'
                        'amount_um = "step(sin(theta))"\n')
        files = {}
        for part, seed in (("a", 5), ("b", 6)):
            random = np.random.default_rng(seed)
            rows = ["# zero = common", "record,tooth,flank,diameter_mm,z_mm,deviation_um"]
            for tooth in range(1, 21):
                for flank in ("left", "right"):
                    value = 20.0 * (np.sin(2 * np.pi * (tooth - 1) / 20) > 0) + random.normal()
                    rows.append(f"index,{tooth},{flank},20,5,{value:.4f}")
            files[part] = OUTPUT / f"{part}.csv"
            files[part].write_text("\n".join(rows) + "\n")
        arguments = [f"{part}={path}" for part, path in files.items()]
        self.assertEqual(program("loop", design, *arguments, "--effects", mine, "-o", OUTPUT / "parts",
                                 "-q").returncode, 0)
        text = (OUTPUT / "parts/loop.json").read_text()
        self.assertIn("split", [e["id"] for e in json.loads(text)["effects"]])
        gearbox = trueflank.read(design)
        for data in (files, {"a": [files["a"]], "b": files["b"]}, arguments):
            self.assertEqual(gearbox.close_loop("gear", data, effects=mine).json_text(), text)

    def test_drive_loop_is_the_programs(self):
        random, ratio = np.random.default_rng(4), self.report["train"]["ratio"]
        rows = ["direction,input_speed_rpm,input_torque_nm,output_torque_nm"]
        for speed in range(300, 3000, 300):
            for torque in np.arange(0.3, 1.5, 0.1):
                out = ratio * 0.9083 * (torque - 0.03) + random.normal(0, 0.05)
                rows.append(f"forward,{speed},{torque:.4f},{out:.4f}")
        bench = OUTPUT / "bench.csv"
        bench.write_text("\n".join(rows) + "\n")
        self.assertEqual(program("loop", DESIGN, bench, "-o", OUTPUT / "drive", "-q").returncode, 0)
        loop = self.gearbox.close_drive_loop(bench)
        self.assertEqual(loop.json_text(), (OUTPUT / "drive/loop.json").read_text())
        self.assertEqual(loop.html(), (OUTPUT / "drive/loop.html").read_text())
        self.assertEqual(loop.verdict, loop.result["verdict"])
        self.assertEqual((len(loop.before_nm), len(loop.after_nm)), (len(rows) - 1, len(rows) - 1))
        self.assertLess(np.std(loop.after_nm), np.abs(np.mean(loop.before_nm)))
        self.assertTrue(loop.text())

    def test_new_designs_read(self):
        for kind in ("3k", "simple", "pair", "gear"):
            gearbox = trueflank.read_text(trueflank.new_design(kind, "mine"))
            self.assertEqual((gearbox.kind, gearbox.name), (kind, "mine"))

    def test_errors_have_key_value_remedy(self):
        wrong = PAIR.replace("teeth = 17", "teeths = 17").replace("8.0\n[wheel]", "-8.0\n[wheel]")
        with self.assertRaises(trueflank.InputError) as caught:
            trueflank.read_text(wrong, name="wrong.toml")
        error = caught.exception
        self.assertIsInstance(error, ValueError)
        self.assertEqual((error.file, error.line, error.key), ("wrong.toml", 7, "pinion.teeth"))
        self.assertIn((8, "pinion.teeths"), [(p.line, p.key) for p in error.problems])
        negative = next(p for p in error.problems if p.key == "pinion.face_width_mm")
        self.assertIn("-8", negative.value)
        self.assertTrue(negative.remedy)
        self.assertEqual(len(str(error).splitlines()), len(error.problems))
        with self.assertRaises(trueflank.SystemFailure) as caught:
            trueflank.read(OUTPUT / "none.toml")
        self.assertIsInstance(caught.exception, OSError)
        self.assertEqual(caught.exception.code, "file_not_found")

    def test_every_format_holds_modified_teeth(self):
        relieved = trueflank.read_text(PAIR + "[pinion.modifications]\ncrowning_um = 5\n")
        self.assertTrue(relieved.mesh("pinion", tolerance_um=5).is_valid)
        files = relieved.export(OUTPUT / "relieved", formats=["scad", "step", "dxf"])
        self.assertEqual({f["format"] for f in files}, {"scad", "step", "dxf"})
        for file in files:
            self.assertGreater((OUTPUT / "relieved" / file["path"]).stat().st_size, 500, file["path"])

    def test_wrong_arguments_are_input_errors(self):
        g = self.gearbox
        for call, key in [(lambda: g.profile("moon"), "gear"), (lambda: g.profile(), "gear"),
                          (lambda: g.mesh("moon"), "part"), (lambda: g.mesh("sun", 0), "tolerance_um"),
                          (lambda: g.mesh("sun", float("nan")), "tolerance_um"),
                          (lambda: g.export(OUTPUT, formats=["stp"]), "--formats"),
                          (lambda: g.efficiency(friction=-1), "friction"),
                          (lambda: g.efficiency(loss_model="none"), "loss_model"),
                          (lambda: trueflank.new_design("4k"), "kind"),
                          (lambda: trueflank.search_text("format = 1", threads=-1), None)]:
            with self.assertRaises(trueflank.InputError) as caught:
                call()
            if key:
                self.assertEqual(caught.exception.key, key)
        with self.assertRaises(TypeError):
            trueflank.read(3)


if __name__ == "__main__":
    unittest.main(verbosity=1)
