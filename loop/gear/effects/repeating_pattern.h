// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace trueflank::loop::gear_effects {

/// Shape values of a pattern that repeats around the gear (unnamed_pattern): how many teeth it has,
/// where it begins, whether it is opposite on the two flanks (the teeth then stand aside), and from
/// there on what each of its teeth has: its mean over the gear's teeth is 0, its mean square 1. The
/// amount is then the pattern's standard deviation.
enum Pattern : std::size_t { kPatternEvery, kPatternFirst, kPatternOpposite, kPatternValues };

/// A pattern stands where it is seen twice.
inline constexpr int kFewestOfPattern = 3;
[[nodiscard]] constexpr int most_of_pattern(int teeth) { return teeth / 2; }

}  // namespace trueflank::loop::gear_effects
