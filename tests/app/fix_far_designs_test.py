# SPDX-License-Identifier: GPL-3.0-or-later
"""Designs far from any that works: `fix` gives the nearest that passes, or says which two checks contradict each other."""
import json
import os
import pathlib
import re
import subprocess
import unittest

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
WHOLE = "TRUEFLANK_CAMPAIGN" in os.environ


def design(kind, teeth, gearbox="", more="", ring=False):
    text = f'format = 1\nname = "far"\n[gearbox]\nkind = "{kind}"\nmodule_mm = 1.0\n{gearbox}\n'
    for name, count in teeth.items():
        text += f"[{name}]\nteeth = {count}\nface_width_mm = 8.0\n" + ("internal = true\n" if ring and name == "wheel" else "")
    return text + more + "\n"


def pair(z1, z2, more="", ring=False):
    return design("pair", {"pinion": z1, "wheel": z2}, more=more, ring=ring)


FEASIBLE = {
    "a rack too steep": pair(17, 40, "[rack]\npressure_angle_deg = 40\naddendum = 0.5\ndedendum = 0.6\nroot_radius = 0.1"),
    "teeth too low": pair(17, 40, "[rack]\naddendum = 0.3\ndedendum = 0.4\nroot_radius = 0.1"),
    "five teeth in five": pair(5, 5),
    "six teeth in seven": pair(6, 7),
    "a ring with one tooth more": pair(20, 21, ring=True),
    "thirty planets": design("simple", {"sun": 60, "planet": 8, "ring": 76}, "planets = 30"),
    "a 3k of few teeth": design("3k", {"sun": 8, "planet1": 12, "ring1": 32, "planet2": 7, "ring2": 27},
                                'planets = 4\noutput = "ring2"'),
}
CONTRADICTING = {
    "a clearance larger than the teeth leave": pair(12, 15, "[made]\nclearance_um = 600"),
    "the same in a ring": pair(25, 60, "[made]\nclearance_um = 500", ring=True),
}


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def failing(text):
    """Ids of the checks that fail; None where the file is refused."""
    path = OUTPUT / "tried.toml"
    path.write_text(text)
    done = run("check", path, "-q", "--json", OUTPUT / "tried.json")
    if done.returncode == 2:
        return None
    return {c["id"] for c in json.loads((OUTPUT / "tried.json").read_text())["checks"] if c["status"] == "fail"}


class FarDesigns(unittest.TestCase):
    def fixed(self, text):
        path, out = OUTPUT / "far.toml", OUTPUT / "fixed.toml"
        path.write_text(text)
        return run("fix", path, "-o", out), out

    def test_the_nearest_design_that_passes_is_found(self):
        for name, text in list(FEASIBLE.items())[::1 if WHOLE else 2]:
            with self.subTest(name):
                self.assertTrue(failing(text))
                done, out = self.fixed(text)
                self.assertEqual(done.returncode, 0, done.stdout)
                self.assertEqual(failing(out.read_text()), set())

    def test_two_checks_that_are_named_contradict_each_other(self):
        for name, text in CONTRADICTING.items():
            with self.subTest(name):
                done, _ = self.fixed(text)
                self.assertEqual(done.returncode, 1)
                named = re.search(r"^(\w+) and (\w+) contradict each other near this design", done.stdout, re.M)
                self.assertTrue(named, done.stdout)
                self.assertEqual(set(named.groups()), {"overlap", "contact_ratio"})

    def test_what_no_change_reaches_is_named(self):
        done, _ = self.fixed(pair(17, 40, "[made]\naxis_tolerance_um = 900"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("nothing near this design clears tolerance", done.stdout)


if __name__ == "__main__":
    OUTPUT.mkdir(parents=True, exist_ok=True)
    unittest.main(verbosity=1)
