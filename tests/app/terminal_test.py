# SPDX-License-Identifier: GPL-3.0-or-later
"""What a person at a terminal sees: help, mistyped words, the order of the table, progress."""
import json
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import subprocess
import time
import unittest

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
DESIGN = SOURCE / "examples/bilateral_drive/design.toml"
FAILING = """format = 1
name = "p"
[gearbox]
kind = "pair"
module_mm = 1.0
centre_distance_mm = 28.3
[pinion]
teeth = 17
shift = 0.0
face_width_mm = 8.0
[wheel]
teeth = 40
shift = 0.0
face_width_mm = 8.0
"""
ORDER = ["fail", "warn", "pass"]


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120)


def errors_on_a_terminal(*arguments, paused=False):
    """What the program writes to standard error where that is a terminal.

    `paused` stops the process again and again for longer than the second after which progress is shown, until it
    shows something: whenever the work begins, it then takes longer than that, on a fast machine and on a slow one.
    """
    own, its = pty.openpty()
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=its)
    os.close(its)
    while paused and process.poll() is None and not select.select([own], [], [], 0.1)[0]:
        process.send_signal(signal.SIGSTOP)
        time.sleep(1.2)
        process.send_signal(signal.SIGCONT)
    text = b""
    while True:
        try:
            block = os.read(own, 4096)
        except OSError:  # the other end is closed
            break
        if not block:
            break
        text += block
    os.close(own)
    return process.wait(timeout=60), text.decode()


class Terminal(unittest.TestCase):
    def setUp(self):
        self.folder = OUTPUT / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def failing(self):
        path = self.folder / "failing.toml"
        path.write_text(FAILING)
        return path

    def test_a_mistyped_command_is_answered_with_the_one_that_was_meant(self):
        for typed, meant in [("halp", "help"), ("chek", "check"), ("cehck", "check"), ("mak", "make"), ("serach", "search"),
                             ("compair", "compare"), ("loops", "loop")]:
            result = run(typed, DESIGN)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertEqual(result.stderr, f"trueflank: {typed}: no such command; did you mean {meant}?\n")
        self.assertIn("wanted: check, make", run("frobnicate").stderr)
        self.assertIn("did you mean trueflank check my.toml?", run("my.toml").stderr)

    def test_a_mistyped_option_is_answered_with_the_one_that_was_meant(self):
        result = run("make", DESIGN, "-o", self.folder, "--fromats", "stl")
        self.assertEqual(result.returncode, 2)
        self.assertIn("did you mean --formats?", result.stderr)
        self.assertIn("did you mean --json?", run("check", DESIGN, "--jsno=-").stderr)
        self.assertIn("see trueflank check --help", run("check", DESIGN, "--frobnicate").stderr)

    def test_help_is_a_command_too(self):
        self.assertEqual(run("help").stdout, run("--help").stdout)
        self.assertEqual(run("help", "make").stdout, run("make", "--help").stdout)
        self.assertEqual(run("help", "help").stdout, run("--help").stdout)
        self.assertIn("did you mean make?", run("help", "maek").stderr)

    def test_what_failed_stands_first_and_what_passed_is_one_line(self):
        report = self.folder / "report.json"
        shown = run("check", self.failing(), "--json", report).stdout
        checks = json.loads(report.read_text())["checks"]
        passed = sum(c["status"] == "pass" for c in checks)
        self.assertIn(f"\n{passed} passed (-v shows them)\n", shown)
        words = re.findall(r"^(pass|warn|fail) ", shown, re.M)
        self.assertEqual(words, sorted(words, key=ORDER.index))
        self.assertEqual(len(words), sum(c["status"] in ("warn", "fail") for c in checks))
        every = run("check", self.failing(), "-v").stdout
        words = re.findall(r"^(pass|warn|fail) ", every, re.M)
        self.assertEqual(words.count("pass"), passed)
        self.assertEqual(words, sorted(words, key=ORDER.index))
        self.assertNotIn("-v shows", every)

    def test_the_last_line_says_which_page_to_open(self):
        out = self.folder / "out"
        last = run("make", DESIGN, "-o", out, "--formats", "svg").stdout.splitlines()[-1]
        self.assertEqual(last, f"open {out}/report.html in a browser")
        page = self.folder / "page.html"
        last = run("check", DESIGN, "--html", page).stdout.splitlines()[-1]
        self.assertEqual(last, f"open {page} in a browser")
        self.assertTrue(page.is_file())

    def test_a_failing_make_takes_away_the_parts_of_the_earlier_design(self):
        out = self.folder / "out"
        self.assertEqual(run("make", DESIGN, "-o", out, "--formats", "svg,scad", "-q").returncode, 0)
        self.assertTrue((out / "sun.svg").is_file())
        self.assertTrue((out / "template_housing.scad").is_file())
        failed = run("make", self.failing(), "-o", out, "--formats", "svg")
        self.assertEqual(failed.returncode, 1)
        self.assertIn("files of an earlier run", failed.stdout)
        self.assertEqual(failed.stdout.splitlines()[-1], f"open {out}/report.html in a browser")
        self.assertEqual(sorted(p.name for p in out.iterdir()), ["report.html", "report.json"])

    def test_long_work_shows_progress_on_a_terminal_and_none_in_a_pipe(self):
        long = ["make", DESIGN, "-o", self.folder / "out", "--tolerance-um", "0.01", "--formats", "obj,stl"]
        code, shown = errors_on_a_terminal(*long, paused=True)
        self.assertEqual(code, 0)
        self.assertRegex(shown, r"making bilateral-drive.*, \d+ s")
        self.assertTrue(shown.endswith("\r\033[K"), shown[-40:])  # gone when the work is done
        self.assertEqual(run(*long).stderr, "")
        self.assertEqual(errors_on_a_terminal(*long, "-q"), (0, ""))
        self.assertEqual(errors_on_a_terminal("check", "--help"), (0, ""))


class ControlCharacters(unittest.TestCase):
    """A file's name, or a design's, must not move the cursor or rename the window."""

    NAME = "a\x1b]0;owned\x07b\nc\x9b.toml"

    def setUp(self):
        self.folder = OUTPUT / "control"
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def expect_plain(self, result):
        for text in (result.stdout, result.stderr):
            self.assertEqual(re.findall(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", text), [], repr(text))

    def test_of_a_missing_file_are_shown_as_numbers(self):
        result = run("check", self.NAME)
        self.assertEqual(result.returncode, 3)
        self.expect_plain(result)
        self.assertIn("a\\x1b]0;owned\\x07b\\x0ac", result.stderr)

    def test_of_files_that_are_there_too(self):
        design = self.folder / self.NAME
        design.write_text(FAILING)
        for arguments in (["check", design], ["make", design, "-o", self.folder / "out\x1b[2J", "--allow-failing",
                                              "--formats", "stl", "--tolerance-um", "50"],
                          ["compare", self.folder / "out\x1b[2J" / "pinion.stl", design]):
            result = run(*arguments)
            self.assertIn(result.returncode, (1, 2), result.stderr)
            self.expect_plain(result)

    def test_of_a_design_are_no_part_of_the_tables(self):
        design = self.folder / "d.toml"
        design.write_text(FAILING.replace('"p"', '"p\\u001b[2J\\u0007"'))
        self.expect_plain(run("check", design))

    def test_of_measured_rows_that_are_left_out_too(self):
        design, data = self.folder / "gear.toml", self.folder / "t\x1b]0;x\x07.csv"
        design.write_text('format = 1\nname = "g"\n[gearbox]\nkind = "gear"\nmodule_mm = 1.0\n'
                          '[gear]\nteeth = 12\nshift = 0.3\nface_width_mm = 4.0\n')
        data.write_text("record,tooth,flank,diameter_mm,z_mm,deviation_um\n" + "".join(
            f"profile,{t},{f},{10.8 + 0.1 * k:.1f},1,{0.3 * ((7 * t + 3 * k) % 5)}\n"
            for t in (1, 4, 8) for f in ("left", "right") for k in range(20)) + "pro\x1b[2Jfile,1,left,11,1,2\n")
        result = run("loop", design, data, "-o", self.folder / "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("left out", result.stderr)
        self.expect_plain(result)

    def test_umlauts_stay(self):
        self.assertIn("größe.toml", run("check", "größe.toml").stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
