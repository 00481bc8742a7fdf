// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank {

/// @name A value in the file's unit that reads back to exactly the value inside, with the fewest
/// digits; the nearest where rounding leaves a gap (no degree maps to every radian)
/// @{
[[nodiscard]] double file_deg(double angle_rad);
[[nodiscard]] double file_um(double length_mm);
/// @}

}  // namespace trueflank
