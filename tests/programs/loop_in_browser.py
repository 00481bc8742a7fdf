# SPDX-License-Identifier: GPL-3.0-or-later
"""loop.html in a real browser: silent, offline, loop.json's numbers, words before charts, phone."""
import json
import math
import os
import random
import subprocess
import unittest

from browser import Browser, pixels

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = os.environ["TRUEFLANK_TEST_OUTPUT"]
GEAR = """format = 1
name = "measured"
[gearbox]
kind = "gear"
module_mm = 1.0
[gear]
teeth = 24
shift = 0.0
face_width_mm = 10.0
"""


def write_measurement(path):
    """Index of an eccentric gear, and profiles and helices with a crowning: all three kinds of record."""
    noise = random.Random(5)
    lines = ["# zero = common", "record,tooth,flank,diameter_mm,z_mm,deviation_um"]
    for tooth in range(1, 25):
        for flank, side in (("left", 1), ("right", -1)):
            angle = 2 * math.pi * (tooth - 1) / 24 + side * (math.pi / 48 + math.pi / 2 - math.radians(20))
            off = 25 * math.cos(angle - 0.7)
            lines.append(f"index,{tooth},{flank},24,5,{off + noise.gauss(0, 0.5):.3f}")
            for i in range(12):
                lines.append(f"profile,{tooth},{flank},{23.2 + 2.6 * i / 11:.3f},5,{off + noise.gauss(0, 0.5):.3f}")
                z = 0.5 + 9 * i / 11
                lines.append(f"helix,{tooth},{flank},24,{z:.3f},{off - 8 * (2 * z / 10 - 1) ** 2 + noise.gauss(0, 0.5):.3f}")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


class LoopInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(OUTPUT, exist_ok=True)
        design, data = os.path.join(OUTPUT, "gear.toml"), os.path.join(OUTPUT, "inspection.csv")
        with open(design, "w", encoding="utf-8") as file:
            file.write(GEAR)
        write_measurement(data)
        cls.folder = os.path.join(OUTPUT, "closed")
        subprocess.run([PROGRAM, "loop", design, data, "-o", cls.folder, "-q"], check=True)
        with open(os.path.join(cls.folder, "loop.json"), encoding="utf-8") as file:
            cls.loop = json.load(file)
        cls.page = os.path.join(cls.folder, "loop.html")

    def test_words_first_then_charts_before_and_after(self):
        with Browser() as browser:
            browser.open(self.page)
            self.assertEqual(browser.run("JSON.parse(document.getElementById('loop-data').textContent)"), self.loop)
            text = browser.run("document.querySelector('main').innerText")
            for effect in self.loop["effects"]:
                if effect["named"]:
                    self.assertIn(effect["id"].replace("_", " "), text)
                self.assertIn(effect["correction"], text)
                for value in effect["parameters"].values():
                    self.assertIn(f"{value['value']:.4g}", text)
            self.assertIn(f"{self.loop['before']['rms_um']:.3g}", text)
            self.assertIn(f"{self.loop['after']['rms_um']:.3g}", text)
            top = "document.querySelector('%s').getBoundingClientRect().top"
            self.assertLess(browser.run(top % ".card"), browser.run(top % "figure"))
            # before and after side by side, at one height
            rows = browser.run("[...document.querySelectorAll('figure')].map(f => [f.querySelector('b').textContent, f.getBoundingClientRect().top])")
            maps = [r for r in rows if r[0] in ("profiles", "helices")]  # of what is left
            rows = [r for r in rows if r not in maps]
            self.assertGreaterEqual(len(maps), 2)
            self.assertGreaterEqual(len(rows), 16)
            for before, after in zip(rows[::2], rows[1::2]):
                self.assertEqual((before[0], after[0]), ("before", "after"))
                self.assertEqual(before[1], after[1])
            # the index charts: bars as tall as the eccentricity before, almost nothing after
            heights = browser.run("[...document.querySelectorAll('figure')].map(f => Math.max(0, ...[...f.querySelectorAll('rect.b')].map(r => +r.getAttribute('height'))))")
            tall = [h for h in heights if h > 0]
            self.assertGreater(tall[0], 10 * tall[1])
            browser.picture(os.path.join(OUTPUT, "desktop.png"), whole=True)
            self.assertEqual(browser.problems, [])
            self.assertEqual(len(browser.requests), 1, browser.requests)

    def test_fits_a_phone_and_the_dark(self):
        with Browser() as browser:
            browser.size(360, 740, scale=2, mobile=True)
            browser.open(self.page)
            self.assertLessEqual(browser.run("document.documentElement.scrollWidth"), 360)
            browser.picture(os.path.join(OUTPUT, "phone.png"), whole=True)
            browser.media(prefers_color_scheme="dark")
            self.assertLess(sum(pixels(browser.picture())[2][2]), 150)
            self.assertEqual(browser.problems, [])


if __name__ == "__main__":
    unittest.main(verbosity=1)
