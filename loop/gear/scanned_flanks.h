// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "trueflank/loop/gear/random_error.h"

namespace trueflank::loop {

/// A variance, that of the held-out values and how many they are: these may be louder than the
/// rest. What chance makes of the sum of their squares, as a variance, where some are louder: each
/// counts as its size does, and how loud it is is known from its own few values.
struct Variance {
  double all = 0.0, held_out = 0.0, held_out_count = 0.0, of_held_out_sum = 0.0;
};

/// Mean of chi-square over its median, for so many degrees of freedom (Wilson and Hilferty).
[[nodiscard]] double mean_over_median(double degrees);

/// What the usual member's variance becomes if some are louder.
[[nodiscard]] Variance of_louder(double variance, const std::vector<double>& loud, const std::vector<double>& values,
                                 const std::vector<double>& held_out);

/// Variance of the random error of one side of a scan's teeth [um^2], and mean square of its usual flank, whatever
/// its form; 0 where no flank has values enough.
struct ScannedSide {
  Variance variance;
  double usual = 0.0, count = 0.0;
};

/// Both sides of a scan, from its flanks as random_error says; `source`: the scan among the table's.
[[nodiscard]] std::array<ScannedSide, 2> scanned_sides(const FlankGeometry& geometry, const Observations& table,
                                                       const Patches& patches, const std::vector<float>& row_um,
                                                       int source, const WhatIsLeft& left);

}  // namespace trueflank::loop
