// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/local/pits/levelled_flanks.h"

namespace trueflank::loop {

struct FoundPit {
  std::size_t flank = 0;
  double along_mm = 0.0, up_mm = 0.0, half_mm = 0.0, depth_um = 0.0;  ///< + = material
  double score = 0.0;                                                 ///< standard errors
};

inline constexpr double kWidestPit_mm = 1.0;  ///< half of it

/// Where a point has the middle of a pit so hollowed (HollowOfPits) 1.
[[nodiscard]] double part_of_depth(const FoundPit& pit, int hollow, const PointOfFlank& point);
/// Where a bell has no depth that counts, in its half widths; the others end at 1.
[[nodiscard]] double end_of_pit(int hollow);
[[nodiscard]] double usual_half_mm(const std::vector<FoundPit>& pits);

/// Places, widths and depths of pits that were found on levelled flanks, by least squares of the
/// points about each. `least_half_mm`: no pit is narrower.
class PitFit {
 public:
  PitFit(LevelledFlanks& flanks, double least_half_mm)
      : flanks_(flanks), least_half_mm_(least_half_mm), near_(flanks.points.size()) {}

  /// All of them hollowed alike, as leaves least: how.
  [[nodiscard]] int all_alike(std::vector<FoundPit>& found);
  /// Each by itself; `usual_mm`: the others' half width, which few points are held by (0: none).
  void each(std::vector<FoundPit>& found, int hollow, double usual_mm) const;
  /// Beyond its edge, to all sides, nothing is left of a pit: a line or a wave runs on.
  [[nodiscard]] bool are_round(const std::vector<FoundPit>& found, int hollow) const;
  /// Takes the pits off the flanks.
  void take_away(const std::vector<FoundPit>& found, int hollow);

 private:
  struct Fitted {
    double depth_um = 0.0, left = 0.0;
  };
  template <class Take>
  void for_points_about(const FoundPit& p, double reach, const Take& take) const;
  [[nodiscard]] static Fitted fitted(const std::vector<PointOfFlank>& about, const FoundPit& p,
                                     int hollow);
  void one(FoundPit& p, int hollow, double usual_mm) const;
  [[nodiscard]] double left_of(const std::vector<FoundPit>& these,
                               const std::vector<FoundPit>& found, int hollow) const;
  void gather_near(const std::vector<FoundPit>& found);

  LevelledFlanks& flanks_;
  double least_half_mm_;
  std::vector<std::vector<PointOfFlank>> near_;  ///< points about pits, where they were gathered
};

}  // namespace trueflank::loop
