#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One gear: its sizes, its exact section as an array, and a mesh within a tolerance."""
import numpy as np
import trueflank

gear = trueflank.Gear(17, module_mm=2, shift=0.2, face_width_mm=10)
print(f"tip {gear.tip_diameter_mm:.3f} mm, root {gear.root_diameter_mm:.3f} mm, "
      f"involute from diameter {gear.root_form_diameter_mm:.4f} mm"
      + (", undercut" if gear.undercut else ""))
print(f"span over {gear.span_teeth} teeth {gear.span_mm():.4f} mm")

points = gear.profile(tolerance_um=1)
x, y = points.T
area = 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)
print(f"{len(points)} points keep the section within 1 um; its area is {area:.4f} mm2")

mesh = gear.mesh(tolerance_um=5)
print(f"{len(mesh.triangles)} triangles within {mesh.chord_error_um:.2f} um, {mesh.volume_mm3:.2f} mm3")
assert mesh.is_valid and abs(mesh.volume_mm3 / (10 * area) - 1) < 1e-3

wheel = trueflank.Gear(40, module_mm=2, thinning_mm=0.05)
pair = trueflank.GearPair(gear, wheel)
print(f"with 40 teeth: centre distance {pair.centre_distance_mm:.4f} mm, contact ratio "
      f"{pair.contact_ratio:.3f}, backlash {pair.backlash_mm:.3f} mm")
