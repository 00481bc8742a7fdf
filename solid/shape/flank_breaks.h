// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/geometry/toothing.h"

namespace trueflank {

/// The breaks of a deviation on the flank of a toothing, where a mesh has columns. A break wanders
/// along the flank with height, tooth and side (break_parameter()); a parameter between breaks goes
/// with those beside it, so that what is laid once for the whole toothing keeps its order
/// everywhere.
class FlankBreaks {
 public:
  /// Within chamfers: columns follow a break as far as it stays on the flank, or go with the
  /// chamfered flank as it is.
  enum class InChamfers { kFollowed, kLeft };
  FlankBreaks() = default;
  /// Breaks that stand on the flank on one of the teeth at one of the heights, by more than
  /// `least_mm` from its ends and from each other.
  FlankBreaks(const Toothing& toothing, const std::vector<int>& teeth,
              const std::vector<double>& heights_mm, double least_mm,
              InChamfers in_chamfers = InChamfers::kLeft);

  /// Where the columns of the breaks stand, from the flank's begin to its end.
  [[nodiscard]] const std::vector<double>& parameters() const { return parameters_; }
  /// The column of a break is another one, not farther than `least_mm` from it.
  void move_column(std::size_t index, double parameter) { parameters_[index] = parameter; }
  /// The place at which a place of the section is drawn at a height. Requires: the toothing this
  /// was made for.
  [[nodiscard]] ToothPlace drawn(const Toothing& toothing, const ToothPlace& place,
                                 double z_mm) const;

 private:
  struct Break {
    double roll_mm = 0.0, parameter = 0.0;
  };
  [[nodiscard]] double share_of(double parameter) const {
    return (parameter - begin_) / (end_ - begin_);
  }
  [[nodiscard]] double least_share(double roll_mm) const;
  void keep_apart(std::vector<Break> breaks);
  [[nodiscard]] double break_at(const Toothing& toothing, int tooth, int side, double roll_mm,
                                double z_mm) const;

  std::size_t flank_ = 0;
  double begin_ = 0.0, end_ = 1.0, least_mm_ = 0.0;
  bool wander_ = false;
  InChamfers in_chamfers_ = InChamfers::kLeft;
  std::vector<double> rolls_mm_, parameters_;
};

}  // namespace trueflank
