#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures a gear that sits 30 um off its axis (the data are made here), lets the loop find out, and
makes the mesh that corrects it."""
import pathlib

import numpy as np
import trueflank

gearbox = trueflank.read_text("""
format = 1
name = "measured"
[gearbox]
kind = "gear"
module_mm = 1.0
[gear]
teeth = 36
shift = 0.0
face_width_mm = 10.0
""")

# cumulative pitch of both flanks, as an inspection machine writes it: along the flank normal, 1 um noise
random = np.random.default_rng(1)
teeth, pressure_angle = 36, np.radians(20)
half_tooth = np.pi / (2 * teeth)
lines = ["# zero = common", "record,tooth,flank,diameter_mm,z_mm,deviation_um"]
for tooth in range(1, teeth + 1):
    for flank, side in (("left", 1), ("right", -1)):
        normal = 2 * np.pi * (tooth - 1) / teeth + side * (half_tooth + np.pi / 2 - pressure_angle)
        deviation = 30 * np.cos(normal - 0.7) + random.normal(0, 1)
        lines.append(f"index,{tooth},{flank},36,5,{deviation:.3f}")
pathlib.Path("inspection.csv").write_text("\n".join(lines) + "\n")

loop = gearbox.close_loop("gear", "inspection.csv")
rms = [float(np.sqrt(np.mean(r.astype(float) ** 2))) for r in (loop.before_um, loop.after_um)]
print(f"{loop.verdict}: rms {rms[0]:.1f} um before, {rms[1]:.1f} um after")
for effect in loop.result["effects"]:
    print(effect["id"], {name: round(p["value"], 2) for name, p in effect["parameters"].items()})
assert loop.result["effects"][0]["id"] == "eccentricity"

pathlib.Path("loop.json").write_text(loop.json_text())
pathlib.Path("loop.html").write_text(loop.html(), encoding="utf-8")
corrected = gearbox.corrected_meshes("loop.json", tolerance_um=5)["gear"]
difference = trueflank.compare(gearbox.mesh("gear", tolerance_um=5), corrected)
print(f"the corrected gear differs from the design by {difference['max_um']:.1f} um at most")
