# SPDX-License-Identifier: GPL-3.0-or-later
"""search.html in a real browser: silent, offline, the search's numbers, hover, sorting, links, phone."""
import csv
import json
import os
import subprocess
import unittest

from browser import Browser, pixels

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = os.environ["TRUEFLANK_TEST_OUTPUT"]
NEEDS = """format = 1
name = "around <96>"
[gearbox]
kind = "3k"
output = "any"
[ratio]
min = 90
max = 100
[teeth]
sun_min = 12
sun_max = 12
planet1_min = 38
planet1_max = 39
ring1_min = 87
ring1_max = 90
planet2_max = 34
[search]
objectives = "forward, size"
results = 4
"""


class SearchInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(OUTPUT, exist_ok=True)
        needs = os.path.join(OUTPUT, "needs.toml")
        with open(needs, "w", encoding="utf-8") as file:
            file.write(NEEDS)
        cls.folder = os.path.join(OUTPUT, "found")
        subprocess.run([PROGRAM, "search", needs, "-o", cls.folder, "-q"], check=True)
        with open(os.path.join(cls.folder, "search.json"), encoding="utf-8") as file:
            cls.search = json.load(file)
        with open(os.path.join(cls.folder, "search.csv"), encoding="utf-8") as file:
            cls.rows = list(csv.DictReader(file))
        cls.page = os.path.join(cls.folder, "search.html")
        cls.browser = Browser().__enter__()  # to start one takes longer than any test of the page

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def opened(self, page=None, **size):
        """The page anew, as a browser that has just been started shows it."""
        browser = self.browser
        browser.media()
        browser.size(**({"width": 1200, "height": 900} | size))
        browser.open("/dev/null")  # what the last test left ends before its complaints are forgotten
        browser.problems.clear()
        browser.requests.clear()
        browser.open(page or self.page)
        return browser

    def test_shows_the_search(self):
        self.assertGreater(len(self.rows), 10)
        browser = self.opened()
        self.assertEqual(browser.run("JSON.parse(document.getElementById('search-data').textContent)"), self.search)
        self.assertIn("around <96>", browser.run("document.querySelector('h1').textContent"))
        self.assertEqual(browser.run("document.querySelectorAll('#plot circle:not(.at)').length"), len(self.rows))
        files = [d["file"] for d in self.search["designs"]]
        links = browser.run("[...document.querySelectorAll('#plot a')].map(a => a.getAttribute('href'))")
        self.assertEqual(sorted(links), sorted(files))
        table = browser.run("[...document.querySelectorAll('#table tbody tr')].map(r => [...r.children].map(c => c.textContent))")
        self.assertEqual(len(table), min(500, len(self.rows)))
        for cells, row in zip(table, self.rows):
            self.assertEqual(cells[0], row["rank"])
            self.assertEqual(cells[1], "/".join(row[k] for k in ("sun", "planet1", "ring1", "planet2", "ring2")))
            self.assertEqual(cells[3], f"{100 * float(row['forward']):.2f} %")
            self.assertEqual(cells[-1], row["file"])
        browser.picture(os.path.join(OUTPUT, "desktop.png"), whole=True)
        # sorting: by ratio, both ways, by mouse and by keyboard
        values = "[...document.querySelectorAll('#table tbody tr')].map(r => parseFloat(r.children[2].textContent))"
        browser.run("document.querySelectorAll('#table th button')[2].click()")
        up = browser.run(values)
        self.assertEqual(up, sorted(up))
        browser.run("document.querySelectorAll('#table th button')[2].focus()")
        browser.press("Enter")
        down = browser.run(values)
        self.assertEqual(down, sorted(down, reverse=True))
        self.assertEqual(browser.run("document.querySelectorAll('#table th')[2].getAttribute('aria-sort')"), "descending")
        # hover: the tip tells the design under the pointer
        place = browser.run("(() => { const c = document.querySelector('#plot a circle'); c.scrollIntoView({block: 'center'});"
                            " const r = c.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()")
        browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=place[0], y=place[1])
        browser.wait("!document.getElementById('tip').hidden")
        self.assertRegex(browser.run("document.getElementById('tip').textContent"), r"click opens design-\d+\.toml")
        browser.picture(os.path.join(OUTPUT, "hover.png"))
        # other axes, and the written designs alone
        browser.run("(() => { const x = document.getElementById('x'); x.value = 'outer_diameter_mm'; x.dispatchEvent(new Event('change'));"
                    " document.getElementById('only').click(); })()")
        self.assertEqual(browser.run("document.querySelectorAll('#plot circle:not(.at)').length"), len(files))
        self.assertEqual(browser.run("document.querySelectorAll('#table tbody tr').length"), len(files))
        self.assertEqual(browser.problems, [])
        self.assertTrue(all(url.startswith("file://") for url in browser.requests), browser.requests)

    def test_ratio_is_drawn_as_its_size_and_bubbles_by_area(self):
        browser = self.opened()
        choose = "(() => { const e = document.getElementById('%s'); e.value = '%s'; e.dispatchEvent(new Event('change')); })()"
        browser.run(choose % ("x", "absolute"))
        # ratios of both directions are among these: the candidates fill the width all the same
        self.assertTrue(any(float(r["ratio"]) < 0 for r in self.rows) and any(float(r["ratio"]) > 0 for r in self.rows))
        across = browser.run("[...document.querySelectorAll('#plot circle:not(.at)')].map(c => +c.getAttribute('cx'))")
        self.assertGreater(max(across) - min(across), 0.7 * 885)
        browser.run(choose % ("bubble", "output_torque_nm"))
        seen = browser.run("places.map(p => [p.r.output_torque_nm, p.radius, Boolean(p.r.file)])")
        largest = max(radius for torque, radius, _ in seen)
        most = max(torque for torque, *_ in seen if torque is not None)
        known = [row for row in seen if row[0] is not None]
        self.assertGreater(len(known), len(seen) / 2)  # contact may be interrupted: no torque then
        for torque, radius, made in known:
            area = largest * (torque / most) ** 0.5
            self.assertAlmostEqual(radius, max(area, 6 if made else 2), places=6)
        browser.picture(os.path.join(OUTPUT, "bubbles.png"), whole=True)

    def test_the_best_designs_are_drawn_to_scale(self):
        browser = self.opened()
        drawn = browser.run("[...document.querySelectorAll('#gears li')].map(li => [li.querySelector('a').getAttribute('href'),"
                            " li.querySelector('svg').getAttribute('viewBox').split(' ').map(Number),"
                            " [...li.querySelectorAll('circle')].map(c => [c.getAttribute('class'), ...['cx', 'cy', 'r'].map(k => +c.getAttribute(k))])])")
        self.assertEqual([d[0] for d in drawn], [d["file"] for d in self.search["designs"]])
        rows = {row["file"]: row for row in self.rows if row["file"]}
        for file, box, circles in drawn:
            row, of = rows[file], {}
            for name, x, y, r in circles:
                of.setdefault(name, []).append((x, y, r))
                self.assertLessEqual(abs(x) + r, box[2] / 2)
            self.assertEqual({name: len(c) for name, c in of.items()}, {"sun": 1, "planet": 3, "step": 3, "ring": 1, "upper": 1})
            sun, ring, upper = of["sun"][0][2], of["ring"][0][2], of["upper"][0][2]
            distance = float(row["centre_distance_modules"])
            for x, y, r in of["planet"]:  # touches its ring; in the ratio of the teeth
                self.assertAlmostEqual((x * x + y * y) ** 0.5, distance, places=4)
                self.assertAlmostEqual(distance + r, ring, places=4)
                self.assertAlmostEqual(ring / r, int(row["ring1"]) / int(row["planet1"]), places=4)
            for _, _, r in of["step"]:
                self.assertAlmostEqual(distance + r, upper, places=4)
            self.assertAlmostEqual(sun, distance * int(row["sun"]) / (int(row["sun"]) + int(row["planet1"])), places=4)
        # one scale: where the centre distance is as many modules, circles of as many teeth are as large
        scales = {round(box[2] * 1000) for _, box, _ in drawn}
        self.assertEqual(len(scales), 1)

    def test_a_search_that_finds_nothing_says_so(self):
        needs = os.path.join(OUTPUT, "nothing.toml")
        with open(needs, "w", encoding="utf-8") as file:
            file.write(NEEDS.replace("min = 90\nmax = 100", "min = 9990\nmax = 9991"))
        folder = os.path.join(OUTPUT, "nothing")
        subprocess.run([PROGRAM, "search", needs, "-o", folder, "-q"], check=True)
        browser = self.opened(os.path.join(folder, "search.html"))
        self.assertEqual(browser.problems, [])
        self.assertIn("No candidate", browser.run("document.querySelector('#stage').innerText"))
        self.assertGreater(browser.run("document.querySelectorAll('#fell tr').length"), 0)

    def test_a_click_opens_the_design_file(self):
        browser = self.opened()
        place = browser.run("(() => { const c = [...document.querySelectorAll('#plot a circle')].at(-1); c.scrollIntoView({block: 'center'});"
                            " const r = c.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()")
        target = browser.run("[...document.querySelectorAll('#plot a')].at(-1).getAttribute('href')")
        for kind in ("mousePressed", "mouseReleased"):
            browser.call("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", clickCount=1)
        # a .toml is shown or saved, as the browser likes: that it is asked for is what the page does
        opened = any(browser.run("new Promise(done => setTimeout(() => done(location.href), 50))").endswith(target)
                     or any(url.endswith(target) for url in browser.requests) for _ in range(60))
        self.assertTrue(opened, browser.requests)

    def test_fits_a_phone_and_the_dark(self):
        browser = self.opened(width=360, height=740, scale=2, mobile=True)
        self.assertLessEqual(browser.run("document.documentElement.scrollWidth"), 360)
        browser.picture(os.path.join(OUTPUT, "phone.png"), whole=True)
        browser.media(prefers_color_scheme="dark")
        dark = pixels(browser.picture())
        self.assertLess(sum(dark[2][2]), 150)
        self.assertEqual(browser.problems, [])


if __name__ == "__main__":
    unittest.main(verbosity=1)
