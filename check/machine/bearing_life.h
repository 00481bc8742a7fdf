// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/units.h"
#include "trueflank/train/machine/elements.h"

namespace trueflank {

/// Load on one bearing.
struct BearingLoad {
  double radial_n = 0.0, axial_n = 0.0;
  double tilting_nmm = 0.0;  ///< moment; crossed rollers alone hold one
  double speed_rpm = 0.0;    ///< of the inner ring against the outer
};

struct BearingLife {
  double equivalent_n = 0.0;         ///< P, dynamic
  double static_equivalent_n = 0.0;  ///< P0
  double life_h = kNaN;              ///< L10h; NaN: no rating, infinite at rest or without load
  double static_safety = kNaN;       ///< C0 / P0; NaN: no rating
};

/// Basic rating life of a deep-groove ball bearing of normal clearance. Source: ISO 281 (L10 =
/// (C/P)^3 million turns, X = 0.56, Y and e by Fa/C0 as catalogues print them, straight lines
/// between) and ISO 76 (P0 = 0.6 Fr + 0.5 Fa, not below Fr). Of a crossed-roller bearing:
/// P = X (Fr + 2 M / d_pw) + Y Fa with X = 1, Y = 0.45 where Fa is not above 1.5 (Fr + 2 M / d_pw),
/// else X = Y = 0.67; P0 = Fr + 2 M / d_pw + 0.44 Fa; d_pw = (d + D) / 2; L10 = (C/P)^(10/3)
/// million turns (IKO's catalogue of needle and crossed-roller bearings, and ISO 281 for the
/// exponent).
[[nodiscard]] BearingLife bearing_life(const Bearing& bearing, const BearingLoad& load);

}  // namespace trueflank
