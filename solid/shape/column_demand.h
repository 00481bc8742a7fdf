// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace trueflank {

/// How many columns or chords a panel asks for from its begin to a parameter.
class ColumnDemand {
 public:
  ColumnDemand(double from, double to) : from_(from), to_(to), sums_{0.0} {}
  void add(double columns) { sums_.push_back(sums_.back() + columns); }
  [[nodiscard]] double whole() const { return sums_.back(); }
  [[nodiscard]] double at(double parameter) const {
    const double cells = static_cast<double>(sums_.size() - 1);
    const double place = std::clamp((parameter - from_) / (to_ - from_), 0.0, 1.0) * cells;
    const auto cell = std::min(static_cast<std::size_t>(place), sums_.size() - 2);
    return std::lerp(sums_[cell], sums_[cell + 1], place - static_cast<double>(cell));
  }
  [[nodiscard]] double parameter_of(double sum) const {
    std::size_t cell = 0;
    while (cell + 2 < sums_.size() && sums_[cell + 1] < sum) ++cell;
    const double inside = (sum - sums_[cell]) / (sums_[cell + 1] - sums_[cell]);
    return std::lerp(from_, to_,
                     (static_cast<double>(cell) + std::clamp(inside, 0.0, 1.0)) /
                         static_cast<double>(sums_.size() - 1));
  }
  /// The end of part i of a stretch that is cut into parts of equal demand.
  [[nodiscard]] double between(double from, double to, int i, int parts) const {
    if (i == 0) return from;
    return i == parts ? to
                      : parameter_of(std::lerp(at(from), at(to), static_cast<double>(i) / parts));
  }

 private:
  double from_, to_;
  std::vector<double> sums_;
};

/// The fewest whole parts.
[[nodiscard]] inline int whole_parts(double demand) {
  return std::max(1, static_cast<int>(std::ceil(std::min(demand, 1e6) - 1e-9)));
}

}  // namespace trueflank
