#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole-process time and memory of the program on the example gearbox, beside `cp` of the same files
and beside peers where they are installed.

Every figure is the median of several runs after a warm-up, of whole processes as a user starts them;
the ratio to `cp` is taken in the same loop, run by run, because machines are noisy.

  python3 bench/whole_set.py [PROGRAM] [--runs N]

Peers: OpenSCAD with BOSL2 (found where OPENSCADPATH has a folder BOSL2) on the same tooth numbers.
"""
import argparse
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent
DESIGN = SOURCE / "examples/bilateral_drive/design.toml"

# One body a file: OpenSCAD would unite them with exact arithmetic, which takes a minute and says
# nothing of its gears.
BOSL2 = [
    "spur_gear(mod=1, teeth=12, thickness=10, profile_shift=0.3, shaft_diam=5);",
    "spur_gear(mod=1, teeth=39, thickness=10, profile_shift=-0.3);",
    "spur_gear(mod=1, teeth=32, thickness=10, profile_shift=0);",
    "ring_gear(mod=1, teeth=90, thickness=10, backing=4, profile_shift=-0.3);",
    "ring_gear(mod=1, teeth=81, thickness=10, backing=4, profile_shift=1.14);",
]


def run(command, **options):
    """Seconds and peak MiB of one run."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    if os.waitstatus_to_exitcode(status) != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}")
    return seconds, usage.ru_maxrss / 1024.0


def row(name, seconds, mebibytes, note=""):
    print(f"{name:44} {1e3 * statistics.median(seconds):9.1f} ms "
          f"({1e3 * min(seconds):.1f} .. {1e3 * max(seconds):.1f})"
          f"  {max(mebibytes):6.1f} MiB  {note}")


def measure(program, folder, formats, runs, tolerance="1"):
    out = folder / "out"
    command = [program, "make", DESIGN, "-o", out, "-q", "--tolerance-um", tolerance,
               "--formats", formats]
    seconds, memory, ratios = [], [], []
    for i in range(runs + 1):
        shutil.rmtree(out, ignore_errors=True)
        shutil.rmtree(folder / "copy", ignore_errors=True)
        s, m = run(command)
        c, _ = run(["cp", "-r", out, folder / "copy"])
        if i > 0:
            seconds.append(s)
            memory.append(m)
            ratios.append(s / c)
    size = sum(f.stat().st_size for f in out.iterdir()) / 1e6
    row(f"make {formats} at {tolerance} um", seconds, memory,
        f"{size:.1f} MB, {statistics.median(ratios):.1f} x cp")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", nargs="?", default=SOURCE / "build/trueflank")
    parser.add_argument("--runs", type=int, default=7)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        seconds, memory = zip(*[run([arguments.program, "--version"]) for _ in range(20)])
        row("start (--version)", seconds[1:], memory)
        seconds, memory = zip(*[run([arguments.program, "check", DESIGN, "-q"])
                                for _ in range(arguments.runs + 1)])
        row("check, every mesh turned", seconds[1:], memory)
        for formats in ("stl,3mf", "stl,3mf,step", "stl,3mf,obj,ply,glb,step,dxf,svg,scad"):
            measure(arguments.program, folder, formats, arguments.runs)
        print("linear growth: twice the points at a quarter of the tolerance")
        for tolerance in ("4", "1", "0.25", "0.0625"):
            measure(arguments.program, folder, "stl", arguments.runs, tolerance)
        paths = os.environ.get("OPENSCADPATH", "").split(":")
        if shutil.which("openscad") and any((pathlib.Path(p) / "BOSL2").is_dir() for p in paths if p):
            totals, memory = [], []
            for _ in range(3):
                runs = []
                for body in BOSL2:
                    scad = folder / "body.scad"
                    scad.write_text(f"include <BOSL2/std.scad>\ninclude <BOSL2/gears.scad>\n{body}\n")
                    runs.append(run(["openscad", "-o", folder / "body.stl", scad]))
                totals.append(sum(seconds for seconds, _ in runs))
                memory.append(max(mebibytes for _, mebibytes in runs))
            row("peer: OpenSCAD with BOSL2, 5 bodies, STL", totals, memory, "chords of about 3 um")
        else:
            print("peer OpenSCAD with BOSL2: not installed here (OPENSCADPATH)")


if __name__ == "__main__":
    main()
