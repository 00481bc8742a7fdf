#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Searches tooth numbers and profile shifts of a 3K gearbox near 96:1 and shows the best."""
import trueflank

found = trueflank.search_text("""
format = 1
name = "around-96"
[gearbox]
kind = "3k"
[ratio]
min = 90.0
max = 100.0
[teeth]
sun_min = 12
sun_max = 12
planet1_min = 39
planet1_max = 39
ring1_min = 90
ring1_max = 90
planet2_min = 31
planet2_max = 33
ring2_min = 80
ring2_max = 82
[search]
results = 3
""")
for gearbox in found.designs:
    report = gearbox.report()
    teeth = "/".join(str(gear["teeth"]) for gear in report["gears"].values())
    print(f"{teeth}: ratio {report['train']['ratio']:.2f}, forward "
          f"{report['efficiency']['forward']:.2%}, backward {report['efficiency']['backward']:.2%}")
assert found.designs, "nothing found"
