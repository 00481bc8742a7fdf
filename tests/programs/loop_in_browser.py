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


PAIR = """format = 1
name = "on the bench"
[gearbox]
kind = "pair"
module_mm = 2.0
[pinion]
teeth = 17
shift = 0.0
face_width_mm = 10.0
[wheel]
teeth = 51
shift = 0.0
face_width_mm = 10.0
"""


def write_bench(path):
    """Forward and backward, five loads, five speeds, twice; an efficiency of 0.96 and a drag that grows with speed."""
    noise = random.Random(3)
    lines = ["direction,input_speed_rpm,input_torque_nm,output_torque_nm,temperature_c,input_angle_deg"]
    points = [(d, n, load) for d in ("forward", "backward") for n in (60, 150, 400, 900, 1800) for load in (1, 3, 6, 9, 12)] * 2
    noise.shuffle(points)
    for direction, speed, load in points:
        drag, angle = 0.05 + 1e-4 * speed, noise.uniform(0, 720)
        torque_in = load / 3 / 0.96 + drag if direction == "forward" else max(0, load / 3 * 0.96 - drag)
        lines.append(f"{direction},{speed},{torque_in + noise.gauss(0, 0.002):.5f},{load + noise.gauss(0, 0.005):.5f},"
                     f"{30 + 3 * noise.random():.2f},{angle:.1f}")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return len(points)


class BenchInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(OUTPUT, exist_ok=True)
        design, data = os.path.join(OUTPUT, "pair.toml"), os.path.join(OUTPUT, "bench.csv")
        with open(design, "w", encoding="utf-8") as file:
            file.write(PAIR)
        cls.points = write_bench(data)
        folder = os.path.join(OUTPUT, "bench")
        subprocess.run([PROGRAM, "loop", design, data, "-o", folder, "-q"], check=True)
        cls.page = os.path.join(folder, "loop.html")

    def test_torque_and_residual_are_drawn_before_and_after(self):
        with Browser() as browser:
            browser.open(self.page)
            captions = browser.run("[...document.querySelectorAll('figure')].filter(f => f.querySelector('.points')).map(f => f.querySelector('figcaption').textContent)")
            for word in ("forward", "backward", "load", "input speed", "temperature", "input angle"):
                self.assertEqual(sum(word in c.split(" torque")[0] or c.endswith(word) for c in captions), 1, (word, captions))
            dots = browser.run("[...document.querySelectorAll('.points')].map(s => [s.querySelectorAll('.a').length, s.querySelectorAll('.w').length])")
            for after, before in dots:
                self.assertEqual(after, before)
            self.assertEqual(sorted({after for after, _ in dots}), [self.points // 2, self.points])
            # letters that can be read: 12 pixels at the least where the chart stands on a screen
            small = browser.run("Math.min(...[...document.querySelectorAll('.points text, .four text')].map(t => parseFloat(getComputedStyle(t).fontSize)"
                                " * t.ownerSVGElement.getBoundingClientRect().width / t.ownerSVGElement.viewBox.baseVal.width))")
            self.assertGreaterEqual(small, 12)
            # the fit brings the means to the line
            means = "document.querySelectorAll('.points')[3].querySelector('.%s').getAttribute('d')"
            heights = {k: [float(p.split()[1]) for p in browser.run(means % k)[1:].split("L")] for k in ("wm", "am")}
            zero = browser.run("+document.querySelectorAll('.points')[3].querySelector('.zero').getAttribute('d').split(' ')[1].split('h')[0]")
            self.assertLess(max(abs(h - zero) for h in heights["am"]), 0.5 * max(abs(h - zero) for h in heights["wm"]))
            # values under the pointer
            place = browser.run("(() => { const c = document.querySelector('.points .a'); c.scrollIntoView({block: 'center'});"
                                " const r = c.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()")
            browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=place[0], y=place[1])
            browser.wait("!document.querySelector('.tip').hidden")
            self.assertRegex(browser.run("document.querySelector('.tip').textContent"), r"rpm, .* N m driving: measured")
            browser.picture(os.path.join(OUTPUT, "bench_desktop.png"), whole=True)
            self.assertEqual(browser.problems, [])
            self.assertEqual(len(browser.requests), 1, browser.requests)

    def test_fits_a_phone(self):
        with Browser() as browser:
            browser.size(390, 844, scale=2, mobile=True)
            browser.open(self.page)
            self.assertLessEqual(browser.run("document.documentElement.scrollWidth"), 390)
            browser.picture(os.path.join(OUTPUT, "bench_phone.png"), whole=True)
            self.assertEqual(browser.problems, [])


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
