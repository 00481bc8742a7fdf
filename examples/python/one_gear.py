#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One gear: its sizes, its exact section as an array, and a mesh within a tolerance."""
import numpy as np
import trueflank

gearbox = trueflank.read_text("""
format = 1
name = "one-gear"
[gearbox]
kind = "gear"
module_mm = 2.0
[gear]
teeth = 17
shift = 0.2
face_width_mm = 10.0
""")
size = gearbox.report()["gears"]["gear"]
print(f"tip {size['tip_diameter_mm']:.3f} mm, root {size['root_diameter_mm']:.3f} mm, "
      f"involute from diameter {size['root_form_diameter_mm']:.4f} mm"
      + (", undercut" if size["undercut"] else ""))
print(f"span over {size['span_teeth']} teeth {size['span_mm']:.4f} mm")

points = gearbox.profile(tolerance_um=1)
x, y = points.T
area = 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)
print(f"{len(points)} points keep the section within 1 um; its area is {area:.4f} mm2")

mesh = gearbox.mesh("gear", tolerance_um=5)
print(f"{len(mesh.triangles)} triangles within {mesh.chord_error_um:.2f} um, {mesh.volume_mm3:.2f} mm3")
assert mesh.is_valid and abs(mesh.volume_mm3 / (10 * area) - 1) < 1e-3
