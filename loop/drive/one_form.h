// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "trueflank/loop/drive/drive_selection.h"

namespace trueflank::loop {

/// What the best of so many shapes takes off by chance (chi-square). Neighbouring shapes do nearly
/// the same: a quarter of them are counted.
[[nodiscard]] inline double cost_of_looks(std::size_t shapes) {
  return 2.0 * std::log(1.0 + 0.25 * static_cast<double>(shapes));
}

/// A set in place of the outcome's, with what it leaves.
struct DriveSelection::OneForm {
  std::vector<DriveEffect> effects;
  std::vector<int> from;  ///< of each, its place in the outcome; -1: new
  double square = std::numeric_limits<double>::max();
  int size = 0;
  /// The least is told.
  [[nodiscard]] double figure(double noise) const {
    constexpr double kEachFigure = 6.6, kOddShape = 4.0;  // chi-square
    double odd = 0.0;
    for (const DriveEffect& e : effects)
      odd += (e.family->named ? 0.0 : 1.0) +
             (e.family->is_odd && e.family->is_odd(e.shape) ? 1.0 : 0.0);
    return square / noise + kEachFigure * size + kOddShape * odd;
  }
  /// What a loss that begins, jumps or is largest at a speed must leave less than one that grows by
  /// a power of it and has no place (chi-square).
  static constexpr double kAPlace = 9.0;
  /// Two that leave the same of the rows seen: those that are locked away say on which side they
  /// are.
  static constexpr double kTheSame = 1e-6;
  [[nodiscard]] bool has_a_place() const {
    return std::any_of(effects.begin(), effects.end(), [](const DriveEffect& e) {
      return e.family->has_a_place && e.family->over(e.shape) == 1.0;
    });
  }
  [[nodiscard]] bool begins_nowhere() const {
    return !has_a_place() && std::any_of(effects.begin(), effects.end(), [](const DriveEffect& e) {
      return e.family->begins_nowhere && e.family->begins_nowhere(e.shape);
    });
  }
  /// True where one that should begin nowhere lies at the end of what it can be.
  [[nodiscard]] bool is_at_an_end() const {
    return std::any_of(effects.begin(), effects.end(), [](const DriveEffect& e) {
      return e.family->begins_nowhere && !e.family->begins_nowhere(e.shape);
    });
  }
};

/// A set with what the looks for its last form cost, and those for one before it (chi-square).
struct DriveSelection::PricedForm {
  OneForm set;
  double looks_before = 0.0, looks = 0.0;
};

}  // namespace trueflank::loop
