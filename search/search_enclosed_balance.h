// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/search/search_interval.h"
#include "trueflank/search/search_model.h"

namespace trueflank {

/// A train's efficiency from ranges of its meshes', by Cramer's rule on the balance of torques.
class EnclosedBalance {
 public:
  /// The model must outlive the balance.
  EnclosedBalance(const SearchModel& model, DriveDirection direction);

  /// The most that meshes within these ranges give. Numerator and denominator of the efficiency are
  /// linear in each mesh's torque ratio: where neither changes its sign at the corners, there is no
  /// pole and the quotient is greatest at one of them. 1 where there may be one.
  [[nodiscard]] double most(const std::vector<Interval>& meshes) const;

 private:
  static constexpr std::size_t kMost = 3;
  using Row = std::array<Interval, kMost>;
  struct Quotient {
    Interval over, under;
  };
  [[nodiscard]] Quotient at(const std::array<Interval, kMost>& ratios) const;
  [[nodiscard]] Interval share(std::size_t row, std::size_t k, const Interval& ratio) const;
  [[nodiscard]] Interval determinant(const std::array<Row, kMost>& rows) const;

  std::size_t meshes_;
  bool forward_;
  double ratio_;  ///< input speed over output speed
  std::array<double, kMost> teeth_ratio_{};
  std::array<bool, kMost> gear1_drives_{};
  /// What a mesh's torque on its gear 1, and that on gear 2, do to a body: of those in balance,
  /// then of the output; and the torque from outside on each.
  std::array<std::array<double, kMost>, kMost + 1> acts1_{}, acts2_{};
  std::array<double, kMost> outside_{};
};

}  // namespace trueflank
