# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command of the program that README and the newcomer's pages show, run as it stands, in order."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import unittest

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])


def commands(page):
    """Lines of shell blocks that call the program."""
    text = (SOURCE / page).read_text()
    lines = [line.split("#")[0].strip() for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL)
             for line in block.splitlines()]
    return [line for line in lines if re.match(r"(build/)?trueflank ", line)]


class DocumentedCommands(unittest.TestCase):
    def run_page(self, page, at_least):
        folder = OUTPUT / page.replace("/", "_")
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "build").mkdir(parents=True)
        (folder / "build/trueflank").symlink_to(PROGRAM)
        (folder / "examples").symlink_to(SOURCE / "examples")
        (folder / "drive.toml").symlink_to(SOURCE / "examples/golden_mesh/drive.toml")
        shown = commands(page)
        self.assertGreaterEqual(len(shown), at_least, page)
        for command in shown:
            words = shlex.split(command)
            words[0] = PROGRAM
            done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, f"{page}: {command}\n{done.stdout[-2000:]}{done.stderr}")
        return folder

    def test_readme(self):
        self.run_page("README.md", 3)

    def test_getting_started(self):
        folder = self.run_page("docs/getting-started.md", 4)
        for file in ("parts/report.html", "parts/template_fit_coupon.scad", "my-parts/assembly.3mf"):
            self.assertTrue((folder / file).is_file(), file)

    def test_golden_meshes(self):
        folder = self.run_page("docs/golden-meshes.md", 1)
        self.assertTrue((folder / "parts/sun.stl").is_file())

    def test_the_readmes_design_makes(self):
        text = re.search(r"```toml\n(.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL)[1]
        OUTPUT.mkdir(parents=True, exist_ok=True)
        (OUTPUT / "readme.toml").write_text(text)
        done = subprocess.run([PROGRAM, "check", OUTPUT / "readme.toml", "-q"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
