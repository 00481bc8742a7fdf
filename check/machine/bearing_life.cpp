// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/bearing_life.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>


namespace trueflank {
namespace {

constexpr double kX = 0.56;
struct Row {
  double ratio, e, y;  ///< Fa / C0
};
constexpr std::array<Row, 9> kTable{{{0.014, 0.19, 2.30},
                                     {0.028, 0.22, 1.99},
                                     {0.056, 0.26, 1.71},
                                     {0.084, 0.28, 1.55},
                                     {0.11, 0.30, 1.45},
                                     {0.17, 0.34, 1.31},
                                     {0.28, 0.38, 1.15},
                                     {0.42, 0.42, 1.04},
                                     {0.56, 0.44, 1.00}}};

Row row_at(double ratio) {
  if (ratio <= kTable.front().ratio) return kTable.front();
  for (std::size_t i = 1; i < kTable.size(); ++i) {
    if (ratio > kTable[i].ratio) continue;
    const double t = (ratio - kTable[i - 1].ratio) / (kTable[i].ratio - kTable[i - 1].ratio);
    return {ratio, std::lerp(kTable[i - 1].e, kTable[i].e, t),
            std::lerp(kTable[i - 1].y, kTable[i].y, t)};
  }
  return kTable.back();
}

/// Rollers touch along lines.
constexpr double kBallExponent = 3.0, kRollerExponent = 10.0 / 3.0;

BearingLife crossed_roller_loads(const Bearing& bearing, const BearingLoad& load) {
  const double pitch_mm = 0.5 * (bearing.bore_mm + bearing.outer_mm);
  const double across = load.radial_n + 2.0 * load.tilting_nmm / pitch_mm;
  const bool mostly_across = load.axial_n <= 1.5 * across;
  BearingLife life{.equivalent_n = mostly_across ? across + 0.45 * load.axial_n
                                                 : 0.67 * across + 0.67 * load.axial_n,
                   .static_equivalent_n = across + 0.44 * load.axial_n};
  if (bearing.static_n > 0.0) life.static_safety = bearing.static_n / life.static_equivalent_n;
  return life;
}

BearingLife ball_bearing_loads(const Bearing& bearing, const BearingLoad& load) {
  BearingLife life{.equivalent_n = load.radial_n};
  life.static_equivalent_n = std::max(load.radial_n, 0.6 * load.radial_n + 0.5 * load.axial_n);
  if (bearing.static_n > 0.0) {
    const Row row = row_at(load.axial_n / bearing.static_n);
    if (load.axial_n > row.e * load.radial_n)
      life.equivalent_n = std::max(load.radial_n, kX * load.radial_n + row.y * load.axial_n);
    life.static_safety = bearing.static_n / life.static_equivalent_n;
  }
  return life;
}

}  // namespace

BearingLife bearing_life(const Bearing& bearing, const BearingLoad& load) {
  const bool rollers = bearing.kind == BearingKind::kCrossedRollers;
  BearingLife life =
      rollers ? crossed_roller_loads(bearing, load) : ball_bearing_loads(bearing, load);
  if (!(bearing.dynamic_n > 0.0)) return life;
  const double turns = 1e6 * std::pow(bearing.dynamic_n / life.equivalent_n,
                                      rollers ? kRollerExponent : kBallExponent);
  life.life_h = load.speed_rpm > 0.0 && life.equivalent_n > 0.0
                    ? turns / (60.0 * load.speed_rpm)
                    : std::numeric_limits<double>::infinity();
  return life;
}

}  // namespace trueflank
