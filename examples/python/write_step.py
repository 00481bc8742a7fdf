#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A pair of gears as exact STEP, as STL within a micrometre, and its report as a page."""
import pathlib

import trueflank

gearbox = trueflank.read_text("""
format = 1
name = "pair"
[gearbox]
kind = "pair"
module_mm = 1.0
backlash_mm = 0.04
[pinion]
teeth = 17
shift = 0.3
face_width_mm = 8.0
[wheel]
teeth = 40
face_width_mm = 8.0
""")
if gearbox.report()["verdict"] == "fail":
    raise SystemExit("a check failed; see gearbox.checks()")
for file in gearbox.export("parts", formats=["step", "stl"], tolerance_um=1):
    measured = "" if file["accuracy_um"] is None else f", measured within {file['accuracy_um']:.2f} um"
    print(f"{file['path']:14} {file['bytes']:8} bytes{measured}")
pathlib.Path("parts/report.html").write_text(gearbox.report_html(), encoding="utf-8")
