// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

// Values that scatter more over a part of their courses than over the rest. Knows nothing of gears.
namespace trueflank::loop {

/// A value of a course, and where it stands (0 ... 1).
struct ValueAlong {
  double at = 0.0, um = 0.0;
};

/// A part of all courses over which neighbouring values differ more.
struct RoughZone {
  double from = 0.0, to = 0.0;               ///< 0 ... 1, whole twelfths
  double inside_um = 0.0, outside_um = 0.0;  ///< standard deviations of the values
  double at_least = 1.0;  ///< values differ so many times as much, as far as is sure
  double p_value = 1.0;                      ///< corrected for all places and lengths looked at
};

/// The zone from end to end, or inside, of which all courses are surest: in each the median size of
/// second differences inside is compared with that outside, and the logarithms of the ratios of all
/// courses with each other. Empty where the usual ratio is below 1.7: where values stand unevenly,
/// neighbours differ by that much. Requires four courses with values that are not all rounded to
/// few levels; of less it tells nothing. Values of a course in order of their place.
[[nodiscard]] std::optional<RoughZone> rough_zone(
    const std::vector<std::vector<ValueAlong>>& courses);

}  // namespace trueflank::loop
