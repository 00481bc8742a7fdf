# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits of a file's size and of open files: what met one is named with the limit and what helps; nothing is left half."""
import os
import pathlib
import resource
import shutil
import subprocess
import unittest

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "limits"
GEAR = """format = 1
name = "g"
[gearbox]
kind = "gear"
[gear]
teeth = 11
shift = 0.4
face_width_mm = 2
module_mm = 1
"""
TRACES = "record,tooth,flank,diameter_mm,z_mm,deviation_um\n" + "".join(
    f"profile,{t},{f},{10 + 0.1 * k:.1f},1,{0.3 * ((7 * t + 3 * k) % 5)}\n"
    for t in (1, 4, 8) for f in ("left", "right") for k in range(12))


def run(arguments, what=None, limit=None, output=subprocess.PIPE):
    def limited():
        if what is not None:
            resource.setrlimit(what, (limit, limit))

    return subprocess.run([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE,
                          text=True, timeout=60, preexec_fn=limited, close_fds=True)


def files_of(folder):
    return {p.name: p.read_bytes() for p in folder.rglob("*") if p.is_file()}


class Limits(unittest.TestCase):
    def setUp(self):
        self.folder = OUTPUT / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        (self.folder / "gear.toml").write_text(GEAR)
        (self.folder / "traces.csv").write_text(TRACES)

    def commands(self):
        gear = self.folder / "gear.toml"
        return {
            "make": lambda d: ["make", gear, "-o", d, "--formats", "stl,3mf,glb,step,svg,dxf,scad,pdf,png", "--tolerance-um", 20],
            "check": lambda d: ["check", gear, "--json", d / "c.json", "--html", d / "c.html"],
            "new": lambda d: ["new", d / "mine"],
            "loop": lambda d: ["loop", gear, self.folder / "traces.csv", "--gear", "gear", "-o", d],
        }

    def tried(self, name, arguments, what, limit):
        """A run within a limit: stopped by it and saying so, or as ever; what stands there is whole."""
        folder = self.folder / "limited"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        done = run(arguments(folder), what, limit)
        told = (name, limit, done.returncode, done.stderr)
        self.assertIn(done.returncode, (0, 3), told)
        for file, content in files_of(folder).items():
            self.assertEqual(content, self.whole[name].get(file), (told, file))
        self.assertEqual(done.returncode == 0, files_of(folder) == self.whole[name], told)
        return done

    def undisturbed(self):
        self.whole = {}
        for name, arguments in self.commands().items():
            folder = self.folder / f"{name}_whole"
            folder.mkdir()
            done = run(arguments(folder))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.whole[name] = files_of(folder)

    def test_a_file_larger_than_the_limit_is_named_with_the_limit_and_what_helps(self):
        self.undisturbed()
        for name, arguments in self.commands().items():
            sizes = sorted(len(content) for content in self.whole[name].values())
            for limit in {0, sizes[0] - 1, sizes[len(sizes) // 2] - 1, sizes[-1] - 1}:
                done = self.tried(name, arguments, resource.RLIMIT_FSIZE, limit)
                self.assertEqual(done.returncode, 3, (name, limit))
                self.assertRegex(done.stderr, rf"{self.folder}/limited/\S+'?: File too large: no file may grow beyond {limit} bytes "
                                              r"here; wanted: a higher limit \(ulimit -f unlimited\)")
            self.assertEqual(self.tried(name, arguments, resource.RLIMIT_FSIZE, sizes[-1]).returncode, 0)

    def test_standard_output_in_a_file_that_may_not_grow_is_named(self):
        with open(self.folder / "told.json", "w") as output:
            done = run(["check", self.folder / "gear.toml", "--json", "-"], resource.RLIMIT_FSIZE, 100, output)
        self.assertEqual(done.returncode, 3)
        self.assertIn("standard output: File too large: no file may grow beyond 100 bytes here; wanted: a higher limit", done.stderr)

    def test_too_many_open_files_are_told_with_the_limit_and_what_helps(self):
        self.undisturbed()
        stopped = 0
        for name, arguments in self.commands().items():
            for limit in range(4, 9):  # the system's loader needs a fourth
                done = self.tried(name, arguments, resource.RLIMIT_NOFILE, limit)
                if done.returncode == 3:
                    stopped += 1
                    self.assertRegex(done.stderr, rf"{self.folder}/\S+'?: Too many open files: a program may have {limit} open "
                                                  r"here; wanted: a higher limit \(ulimit -n")
        self.assertGreater(stopped, 0)

    def test_a_format_of_assimp_needs_no_more_files_than_its_pipe(self):
        mesh = self.folder / "tetrahedron.off"
        mesh.write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
        if "not installed" in run(["compare", mesh, mesh]).stderr:
            self.skipTest("without assimp")
        codes = []
        for limit in range(4, 8):
            done = run(["compare", mesh, mesh], resource.RLIMIT_NOFILE, limit)
            codes.append(done.returncode)
            if done.returncode:
                self.assertIn(f"Too many open files: a program may have {limit} open here; wanted: a higher limit (ulimit -n",
                              done.stderr)
        self.assertEqual(codes, sorted(codes, reverse=True))
        self.assertLessEqual(set(codes), {0, 3})


if __name__ == "__main__":
    unittest.main()
