// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace trueflank {

/// A number for a sentence: fixed notation, at most `digits` decimals, no trailing zeros, never "-0".
/// "nothing" where it is NaN.
[[nodiscard]] std::string number_text(double value, int digits = 4);
/// Where a value is named that has to be reached, or not to be exceeded: rounded up, or down, at the last decimal, so
/// that the number as it is printed keeps the bound.
enum class Rounded { kUp, kDown };
[[nodiscard]] std::string bound_text(double value, Rounded rounded, int digits = 4);
/// "0.25 mm", to 0.1 um.
[[nodiscard]] std::string mm_text(double length_mm);
/// "12.3 um", to 0.01 um; the argument is in mm.
[[nodiscard]] std::string um_text(double length_mm);
/// "12.34 deg"; the argument is in radians.
[[nodiscard]] std::string deg_text(double angle_rad);

}  // namespace trueflank
