# SPDX-License-Identifier: GPL-3.0-or-later
"""Scan points against the design: trueflank's loop (pose, distance, discovery) beside CloudCompare's
cloud-to-mesh distance alone, on the same points. Times, memory, and how far each is from the truth.

    bench/cloud_to_mesh.py build/trueflank [points ...]

CloudCompare is Debian's package cloudcompare; where it is missing only trueflank is timed.
"""
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import numpy

TEETH, FACE, ALPHA = 24, 8.0, math.radians(20.0)
DESIGN = f"""format = 1
name = "bench"
[gearbox]
kind = "gear"
module_mm = 1.0
[gear]
teeth = {TEETH}
face_width_mm = {FACE}
"""


def flank_points(count, seed=1):
    """Points on the exact flanks, each moved along its normal by noise of 5 um and crowning of 10 um."""
    random = numpy.random.default_rng(seed)
    base = 0.5 * TEETH * math.cos(ALPHA)
    half = 0.5 * math.pi / TEETH + math.tan(ALPHA) - ALPHA
    side = random.choice([-1.0, 1.0], count)
    middle = 2 * math.pi * random.integers(0, TEETH, count) / TEETH
    roll = random.uniform(1.6, 5.9, count)
    z = random.uniform(0.1, FACE - 0.1, count)
    xi = roll / base
    angle = middle + side * (half - (xi - numpy.arctan(xi)))
    normal = middle + side * (math.pi / 2 + half - xi)
    off = 5e-3 * random.standard_normal(count) - 10e-3 * (2 * z / FACE - 1) ** 2
    radius = numpy.hypot(base, roll)
    points = numpy.column_stack([radius * numpy.cos(angle) + off * numpy.cos(normal),
                                 radius * numpy.sin(angle) + off * numpy.sin(normal), z])
    return points, off


def timed(command, **options):
    """Seconds on the clock, of one processor, and MB at most, of a child."""
    before = time.monotonic()
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(list(map(str, command)), stdout=output, stderr=subprocess.STDOUT, **options)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        said = output.read()
    figures = (f"{time.monotonic() - before:.1f} s, {used.ru_utime + used.ru_stime:.1f} s of processor, "
               f"{used.ru_maxrss / 1024:.0f} MB, exit code {process.returncode}")
    return figures, said


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    other = shutil.which("CloudCompare") or shutil.which("cloudcompare")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "design.toml").write_text(DESIGN)
        subprocess.run([program, "make", folder / "design.toml", "-o", folder, "--formats", "stl", "--quiet"],
                       check=True)
        for count in map(int, sys.argv[2:] or ["200000"]):
            points, off = flank_points(count)
            numpy.savetxt(folder / "scan.xyz", points, fmt="%.6f")
            figures, _ = timed([program, "loop", folder / "design.toml", folder / "scan.xyz",
                                "-o", folder / "loop", "--quiet"])
            print(f"{count} points: trueflank loop, any pose, all effects: {figures}")
            if other is None:
                print("CloudCompare is not installed")
                continue
            figures, output = timed(
                [other, "-SILENT", "-AUTO_SAVE", "OFF", "-C_EXPORT_FMT", "ASC", "-PREC", "6", "-O", folder / "scan.xyz",
                 "-O", folder / "gear.stl", "-C2M_DIST", "-SAVE_CLOUDS", "FILE", folder / "distance.asc"],
                env={"QT_QPA_PLATFORM": "offscreen", "PATH": "/usr/bin:/bin", "HOME": name})
            print(f"{count} points: CloudCompare C2M, aligned, distance only: {figures}")
            written = sorted(folder.glob("distance*"))
            if not written:
                print(output[-600:])
                continue
            distance = numpy.loadtxt(written[0], comments="/")[:, -1]
            error = 1e3 * (numpy.abs(distance) - numpy.abs(off))
            print(f"  its distance against the truth: {numpy.sqrt(numpy.mean(error**2)):.3f} um rms")


if __name__ == "__main__":
    main()
