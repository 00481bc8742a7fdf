// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "tests/loop/made_gears.h"

// Profile traces of flanks at several heights.
namespace trueflank::test {

enum class Zeros { kCommon, kOfFlanks, kOfTraces };

/// Profiles at these heights (shares of the face), of every so many-th tooth.
inline loop::InspectionData topography(const MadeGear& gear, const Process& process, Zeros zeros,
                                       const std::vector<double>& heights, int every,
                                       double noise_um, double zero_um, unsigned seed) {
  std::mt19937_64 random(seed * 7919U + 3U);
  std::normal_distribution<double> normal(0.0, 1.0);
  constexpr int kPoints = 30;
  loop::InspectionData data;
  data.file = "topography";
  data.common_zero = zeros == Zeros::kCommon;
  for (int tooth = 1; tooth <= gear.teeth; tooth += every)
    for (const int side : {1, -1}) {
      double zero = zeros == Zeros::kCommon ? 0.0 : zero_um * normal(random);
      for (const double height : heights) {
        if (zeros == Zeros::kOfTraces) zero = zero_um * normal(random);
        for (int i = 0; i < kPoints; ++i) {
          const FlankSpot spot{tooth, side, 2.0 * (i + 0.5) / kPoints - 1.0, 2.0 * height - 1.0};
          const Vec3 p = point_on(gear, spot);
          loop::InspectionRow row;
          row.record = loop::RecordKind::kProfile;
          row.tooth = tooth;
          row.flank = flank_name(gear, side);
          row.diameter_mm = 2.0 * std::hypot(p[0], p[1]);
          row.z_mm = p[2];
          row.deviation_um = deviation_um(gear, spot, {process}) + zero + noise_um * normal(random);
          data.rows.push_back(row);
        }
      }
    }
  return data;
}

}  // namespace trueflank::test
