// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/crossed_rollers.h"

namespace trueflank {
namespace {

constexpr const char* kSource =
    "unverified: as remembered of makers' catalogues; compare with your supplier's";

/// Bore, outer diameter, width, C and C0.
Bearing crossed(const char* name, double d, double D, double B, double C, double C0) {
  return {.name = name,
          .bore_mm = d,
          .outer_mm = D,
          .width_mm = B,
          .dynamic_n = C,
          .static_n = C0,
          .kind = BearingKind::kCrossedRollers,
          .source = kSource};
}

}  // namespace

const std::vector<Bearing>& crossed_roller_bearings() {
  static const std::vector<Bearing> bearings{
      crossed("RB2008", 20, 36, 8, 3230, 3100),     crossed("RB2508", 25, 41, 8, 3630, 3830),
      crossed("RB3010", 30, 55, 10, 7350, 8360),    crossed("RB3510", 35, 60, 10, 7640, 9120),
      crossed("RB4010", 40, 65, 10, 8330, 10600),   crossed("RB5013", 50, 80, 13, 16700, 20900),
      crossed("RB6013", 60, 90, 13, 18000, 24300),  crossed("RB7013", 70, 100, 13, 19400, 27700),
      crossed("RB8016", 80, 120, 16, 30100, 42100),
  };
  return bearings;
}

}  // namespace trueflank
