// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank {

/// inv a = tan a - a. Accuracy: full double precision relative to the result from |a| > 1e-3 on;
/// below, a series keeps it.
[[nodiscard]] double involute_function(double angle_rad);

/// The angle in [0, pi/2) whose involute function is given.
/// Requires: inv >= 0. Accuracy: 4e-16 rad + 1e-15 relative, tested against involute_function.
[[nodiscard]] double inverse_involute_rad(double involute);

/// Pressure angle of an involute at a radius: arccos(r_b / r); 0 at and below the base circle.
[[nodiscard]] double pressure_angle_at_radius_rad(double radius_mm, double base_radius_mm);

/// Roll length L = sqrt(r^2 - r_b^2), the length of the base tangent; 0 at and below the base circle.
[[nodiscard]] double roll_length_mm(double radius_mm, double base_radius_mm);

}  // namespace trueflank
