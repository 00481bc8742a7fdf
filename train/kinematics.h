// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// Angular speed of every member of a topology per unit of input speed, counter-clockwise positive.
struct MemberSpeeds {
  std::vector<double> of;  ///< in the order of Topology::members; NaN where tooth numbers leave it open
  double output = kNaN;    ///< NaN where there is none

  /// Standing: the housing.
  [[nodiscard]] double of_arm(int member) const {
    return member == kHousing ? 0.0 : of[static_cast<std::size_t>(member)];
  }
};

/// Tooth numbers in the order of the gears, a ring's negative (as ISO 21771 counts them).
[[nodiscard]] std::vector<int> signed_teeth(const GearboxDesign& design);

/// Willis: in every mesh z1 (w1 - w_arm) + z2 (w2 - w_arm) = 0; held members stand, the input turns at 1.
/// These equations are solved in whole numbers: what stands, stands at exactly 0, and the other speeds
/// are rounded once.
/// Requires: one signed tooth number for every gear.
[[nodiscard]] MemberSpeeds member_speeds(const Topology& topology, const std::vector<int>& signed_teeth);

}  // namespace trueflank
