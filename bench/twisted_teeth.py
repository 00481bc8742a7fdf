#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Processor time a facet of helical and herringbone teeth beside straight ones: `make` less `check`,
files read back and measured included. The straight pair at a finer tolerance, so that it has facets
enough to be timed.

  python3 bench/twisted_teeth.py [PROGRAM] [--runs N]
"""
import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PAIR = """format = 1
name = "pair"
[gearbox]
kind = "pair"
module_mm = 1.0
backlash_mm = 0.05
{twist}
[pinion]
teeth = 17
face_width_mm = 10.0
[wheel]
teeth = 40
face_width_mm = 10.0
"""
CASES = [("spur", "", "0.01"),
         ("helical", "helix_angle_deg = 20.0", "1"),
         ("helical", "helix_angle_deg = 20.0", "0.1"),
         ("herringbone", "helix_angle_deg = 20.0\nherringbone = true", "1"),
         ("crowned spur", "CROWNED", "1")]


def used(*command):
    """Processor seconds of one run."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", nargs="?", default=SOURCE / "build/trueflank")
    parser.add_argument("--runs", type=int, default=9)
    arguments = parser.parse_args()
    straight = None
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        design, out = folder / "design.toml", folder / "out"
        for name, twist, tolerance in CASES:
            crowned = "[pinion.modifications]\ncrowning_um = 10\n[wheel.modifications]\ncrowning_um = 10\n"
            design.write_text(PAIR.format(twist="") + crowned if twist == "CROWNED"
                              else PAIR.format(twist=twist))
            seconds = statistics.median(
                used(arguments.program, "make", design, "-o", out, "-q", "--formats", "stl",
                     "--tolerance-um", tolerance) - used(arguments.program, "check", design, "-q")
                for _ in range(arguments.runs))
            files = json.loads((out / "report.json").read_text())["files"]
            facets = sum(file["triangles"] for file in files)
            straight = straight or seconds / facets
            print(f"{name:12} at {tolerance:>4} um: {facets:8} facets, {1e3 * seconds:7.1f} ms, "
                  f"{1e6 * seconds / facets:.2f} us a facet, {seconds / facets / straight:.2f} x spur")


if __name__ == "__main__":
    main()
