# SPDX-License-Identifier: GPL-3.0-or-later
"""report.html in a real browser: complete, silent, offline, the report's numbers, keyboard, phone."""
import json
import os
import re
import subprocess
import sys
import unittest

from browser import Browser, pixels

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = os.environ["TRUEFLANK_SOURCE_DIR"]
OUTPUT = os.environ["TRUEFLANK_TEST_OUTPUT"]

DESIGNS = {
    "drive": os.path.join(SOURCE, "examples/bilateral_drive/design.toml"),
    "gear": None,
}
GEAR = """format = 1
name = "single <gear> & \\"friends\\""
[gearbox]
kind = "gear"
module_mm = 0.4
[gear]
teeth = 17
face_width_mm = 6.0
bore_mm = 2.0
[gear.modifications]
crowning_um = 12
edge_chamfer_mm = 0.1
"""


def made(name):
    """Folder with report.json and report.html of a design."""
    folder = os.path.join(OUTPUT, name)
    design = DESIGNS[name]
    if design is None:
        os.makedirs(OUTPUT, exist_ok=True)
        design = os.path.join(OUTPUT, name + ".toml")
        with open(design, "w", encoding="utf-8") as file:
            file.write(GEAR)
    subprocess.run([PROGRAM, "make", design, "-o", folder, "--formats", "stl", "--allow-failing", "-q"],
                   check=False, stdout=subprocess.DEVNULL)
    return folder


def has_3d(folder):
    with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
        return "WebGLRenderer" in file.read()


def contrast_count(png):
    """How many pixels of a picture differ clearly from the pixel of its left edge in their row."""
    count = 0
    for row in pixels(png):
        first = row[0]
        count += sum(max(abs(a - b) for a, b in zip(p, first)) > 40 for p in row)
    return count


class ReportInBrowser(unittest.TestCase):
    showing = None

    @classmethod
    def setUpClass(cls):
        cls.folders = {name: made(name) for name in DESIGNS}
        cls.browser = Browser().__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def open(self, name, width=1200, height=900, mobile=False, scheme="light", motion="reduce"):
        folder = self.folders[name]
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
        # loading is what takes time: a page as wanted is left open
        wanted = (name, width, height, mobile, scheme, motion)
        if wanted == ReportInBrowser.showing:
            return report
        ReportInBrowser.showing = wanted
        self.browser.problems.clear()
        self.browser.requests.clear()
        self.browser.size(width, height, 1, mobile)
        self.browser.media(prefers_color_scheme=scheme, prefers_reduced_motion=motion)
        self.browser.open(os.path.join(folder, "report.html"))
        if has_3d(folder):
            self.browser.wait("document.querySelector('#viewer').dataset.frames > 0")
        return report

    def shot(self, name, **where):
        return self.browser.picture(os.path.join(OUTPUT, name + ".png"), **where)

    def test_the_console_stays_silent_and_nothing_is_fetched(self):
        for name in DESIGNS:
            self.open(name)
            self.assertEqual(self.browser.problems, [], name)
            outside = [r for r in self.browser.requests if not r.startswith(("file:", "data:", "blob:"))]
            self.assertEqual(outside, [], name)

    def test_every_number_is_that_of_report_json(self):
        for name in DESIGNS:
            report = self.open(name)
            shown = self.browser.run(
                "[...document.querySelectorAll('[data-path]')].map(e => [e.dataset.path, Number(e.dataset.factor ?? 1),"
                " [...e.childNodes].filter(n => n.nodeType === 3).map(n => n.data).join('')])")
            self.assertGreater(len(shown), 25)
            for path, factor, text in shown:
                value = report
                for key in path.split("/"):
                    value = value[int(key)] if isinstance(value, list) else value[key]
                if value is None:
                    self.assertEqual(text, "–", path)
                    continue
                number = re.match(r"[−0-9.]+", text).group().replace("−", "-")
                digits = len(number.partition(".")[2])
                self.assertLessEqual(abs(float(number) - factor * value), 0.5000001 * 10.0 ** -digits, path)
            self.assertEqual(self.browser.run("JSON.stringify(trueflank.report)"),
                             self.browser.run("JSON.stringify(%s)" % json.dumps(report)))

    def test_every_check_gear_and_file_has_its_row(self):
        report = self.open("drive")
        rows = self.browser.run("document.querySelectorAll('.checks-table tbody tr').length")
        self.assertEqual(rows, len(report["checks"]))
        self.assertEqual(self.browser.run("document.querySelectorAll('#files tbody tr').length"), len(report["files"]))
        self.assertEqual(self.browser.run("document.querySelectorAll('.mesh').length"), len(report["meshes"]))
        text = self.browser.run("document.querySelector('#main').innerText")
        for check in report["checks"]:
            self.assertIn(check["message"], text)

    def test_the_picture_in_3d_shows_the_gearbox(self):
        if not has_3d(self.folders["drive"]):
            self.skipTest("built without three.js")
        self.open("drive")
        whole = contrast_count(self.shot("model", selector="#viewer canvas"))
        self.assertGreater(whole, 40000)
        frames = self.browser.run("document.querySelector('#viewer').dataset.frames")
        self.browser.run("document.querySelector('#viewer-cut').click()")
        self.browser.wait(f"document.querySelector('#viewer').dataset.frames > {frames}")
        cut = contrast_count(self.shot("model_cut", selector="#viewer canvas"))
        self.assertLess(cut, 0.95 * whole)
        self.assertGreater(cut, 0.3 * whole)
        self.browser.run("document.querySelector('#viewer-cut').click()")

    def test_the_model_turns_by_the_true_ratio(self):
        if not has_3d(self.folders["drive"]):
            self.skipTest("built without three.js")
        report = self.open("drive")
        turn = "(() => { const v = trueflank.viewer, b = v.bodies.find(x => x.name.startsWith('%s'));" \
               " v.sun = 0; v.pose(); const r = b.group.rotation.z; v.sun = 2 * Math.PI; v.pose();" \
               " return (b.group.rotation.z - r) / (2 * Math.PI); })()"
        self.assertAlmostEqual(self.browser.run(turn % "sun"), 1.0, places=9)
        self.assertAlmostEqual(1.0 / self.browser.run(turn % "ring2"), report["train"]["ratio"], places=6)
        self.assertAlmostEqual(self.browser.run(turn % "ring1"), 0.0, places=9)

    def test_the_meshes_touch_nowhere_nearer_than_the_report_says(self):
        report = self.open("drive")
        for index, (name, mesh) in enumerate(report["meshes"].items()):
            seen = self.browser.run(
                "(() => { const d = trueflank.meshes[%d], seen = [];"
                " for (let i = 0; i < 12; ++i) { d.phase = i / 12; d.show(); seen.push(d.gapNow.textContent); }"
                " return seen; })()" % index)
            # half of the backlash is on either flank, less the chords of the drawing
            expected = 500 * mesh["backlash_mm"] * 0.9
            for text in seen:
                nearest = 0.0 if text.startswith("under") else float(text.split()[0])
                self.assertLess(abs(nearest - expected), 0.12 * expected + 3, f"{name}: {seen}")

    def test_everything_works_from_the_keyboard(self):
        self.open("drive")
        self.browser.run("document.body.focus()")
        self.browser.press("Tab")
        self.assertEqual(self.browser.run("document.activeElement.className"), "skip")
        self.browser.press("Enter")
        self.assertEqual(self.browser.run("location.hash"), "#main")
        reached = set()
        for _ in range(60):
            self.browser.press("Tab")
            reached.add(self.browser.run("document.activeElement.id || document.activeElement.textContent.slice(0, 20)"))
        for needed in ("viewer-explode", "viewer-cut", "tolerance-class", "torque"):
            if needed.startswith("viewer") and not has_3d(self.folders["drive"]):
                continue
            self.assertIn(needed, reached)
        self.browser.run("document.querySelector('[data-status=warn], [data-status=pass]').focus()")
        status = self.browser.run("document.activeElement.dataset.status")
        self.browser.press("Enter")
        others = self.browser.run(
            f"[...document.querySelectorAll('.checks-table tbody tr')].filter(r => !r.hidden && r.dataset.status !== '{status}').length")
        self.assertEqual(others, 0)
        if has_3d(self.folders["drive"]):
            self.browser.run("document.querySelector('#viewer canvas').focus()")
            before = self.browser.run("trueflank.viewer.camera.position.toArray()")
            self.browser.press("ArrowLeft")
            self.assertNotEqual(before, self.browser.run("trueflank.viewer.camera.position.toArray()"))
            self.browser.press(" ", "Space")
            self.assertTrue(self.browser.run("trueflank.viewer.playing"))
            self.browser.press(" ", "Space")

    def test_a_phone_shows_it_without_scrolling_sideways(self):
        for name in DESIGNS:
            self.open(name, 360, 740, mobile=True)
            self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), 360, name)
            self.shot(name + "_phone")
            small = self.browser.run(
                "[...document.querySelectorAll('button, select')].filter(e => e.offsetParent && e.offsetHeight < 30).length")
            self.assertEqual(small, 0)

    def test_it_is_readable_in_the_dark(self):
        self.open("drive", scheme="dark")
        background, ink = self.browser.run(
            "[getComputedStyle(document.body).backgroundColor, getComputedStyle(document.body).color]")
        brightness = [sum(map(int, re.findall(r"\d+", c)[:3])) for c in (background, ink)]
        self.assertLess(brightness[0], 120)
        self.assertGreater(brightness[1], 600)
        self.shot("drive_dark")

    def test_it_prints_with_its_picture(self):
        self.open("drive")
        self.browser.run("window.dispatchEvent(new Event('beforeprint'))")
        data = self.browser.call("Page.printToPDF", printBackground=True)["data"]
        self.assertGreater(len(data), 50000)
        if has_3d(self.folders["drive"]):
            self.assertGreater(self.browser.run("document.querySelector('#viewer .print').src.length"), 20000)
        ReportInBrowser.showing = None
        self.browser.media("print", prefers_reduced_motion="reduce")
        self.assertEqual(self.browser.run("[...document.querySelectorAll('button')].filter(b => b.offsetParent).length"), 0)
        # nothing is cut off at the edge of a sheet: A4 less its margins is 688 pixels wide
        self.browser.size(688, 1000)
        try:
            self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), 688)
        finally:
            self.browser.media()
            self.browser.size(1200, 900)


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main(verbosity=2)
