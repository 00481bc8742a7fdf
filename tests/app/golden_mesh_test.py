# SPDX-License-Identifier: GPL-3.0-or-later
"""The golden-mesh recipe of docs/golden-meshes.md, run as its user would: as CMake tests and as the
commands of the workflow; and refused where a part has changed."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
EXAMPLE = SOURCE / "examples/golden_mesh"


def run(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=120)


class GoldenMesh(unittest.TestCase):
    def setUp(self):
        self.folder = OUTPUT / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def project(self, design):
        """Configures and runs the user's project, copied, on a design."""
        copy = self.folder / "project"
        shutil.copytree(EXAMPLE, copy)
        configured = run("cmake", "-S", copy, "-B", self.folder / "build", f"-DTRUEFLANK={PROGRAM}",
                         f"-DDESIGN={design}")
        self.assertEqual(configured.returncode, 0, configured.stderr)
        return run("ctest", "--test-dir", self.folder / "build", "--output-on-failure")

    def changed(self, old, new):
        text = (EXAMPLE / "drive.toml").read_text()
        self.assertIn(old, text)
        path = self.folder / "drive.toml"
        path.write_text(text.replace(old, new))
        return path

    def test_the_example_project_passes(self):
        result = self.project(EXAMPLE / "drive.toml")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("golden.sun", result.stdout)
        self.assertIn("golden.planet", result.stdout)
        self.assertIn("0 tests failed out of 3", result.stdout)

    def test_a_changed_shift_is_refused_with_part_place_and_size(self):
        result = self.project(self.changed("shift = 0.3", "shift = 0.35"))
        self.assertNotEqual(result.returncode, 0, result.stdout)
        self.assertRegex(result.stdout, r"golden\.sun \.+\*+Failed")
        self.assertRegex(result.stdout, r"golden\.planet \.+ +Passed")  # the shift is the sun's alone
        # 0.05 more shift at module 1: the root circle moves by 50 um
        found = re.search(r"^sun: ([\d.]+) um too much material at the root between teeth (\d+) and (\d+)$",
                          result.stdout, re.MULTILINE)
        self.assertIsNotNone(found, result.stdout)
        self.assertAlmostEqual(float(found[1]), 50.0, delta=0.5)
        picture = self.folder / "build/pictures/sun.svg"
        texts = [t.text or "" for t in xml.etree.ElementTree.parse(picture).iter(
            "{http://www.w3.org/2000/svg}text")]
        self.assertTrue(any("too much material" in t for t in texts), texts)

    def test_figures_of_json_are_those_of_the_change(self):
        made = self.folder / "made"
        design = self.changed("bore_mm = 5.0", "bore_mm = 5.1")
        self.assertIn(run(PROGRAM, "make", design, "-o", made, "--formats", "stl", "-q",
                          "--tolerance-um", "5").returncode, (0,))
        result = run(PROGRAM, "compare", EXAMPLE / "golden/sun.stl", made / "sun.stl",
                     "--tolerance-um", "12", "--json", "-")
        self.assertEqual(result.returncode, 1)
        found = json.loads(result.stdout)
        self.assertEqual((found["part"], found["difference"]["place"]), ("sun", "bore"))
        self.assertAlmostEqual(found["difference"]["deviation_um"], -50.0, delta=10.0)
        self.assertEqual(found["difference"]["teeth"], 12)
        self.assertEqual([r["teeth_beyond"] for r in found["difference"]["regions"]], [0, 0, 0, 0])

    def test_text_fits_a_terminal(self):
        made = self.folder / "made"
        run(PROGRAM, "make", self.changed("shift = 0.3", "shift = 0.35"), "-o", made, "--formats", "stl",
            "-q", "--tolerance-um", "5")
        result = subprocess.run([PROGRAM, "compare", str(EXAMPLE / "golden/sun.stl"), "sun.stl"],
                                cwd=made, capture_output=True, text=True)
        for line in result.stdout.splitlines():
            if not line.startswith("golden "):
                self.assertLessEqual(len(line), 80, line)

    def test_goldens_are_small_and_the_page_shows_these_files(self):
        for file in (EXAMPLE / "golden").iterdir():
            self.assertLess(file.stat().st_size, 200_000, file.name)
        page = (SOURCE / "docs/golden-meshes.md").read_text()
        for file in ["CMakeLists.txt", ".github/workflows/golden.yml"]:
            text = (EXAMPLE / file).read_text()
            # but for the licence line
            body = "".join(line for line in text.splitlines(True) if "SPDX" not in line).strip()
            self.assertIn(body, page, file)

    def test_the_workflow_runs_the_commands_tested_here(self):
        steps = (EXAMPLE / ".github/workflows/golden.yml").read_text()
        self.assertIn('cmake -S design -B build -DTRUEFLANK=', steps)
        self.assertIn("ctest --test-dir build --output-on-failure", steps)


if __name__ == "__main__":
    unittest.main(verbosity=1)
