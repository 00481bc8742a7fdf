// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/arbitrary_pose.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trueflank::loop {

bool is_of_any_pose(const Observations& table) {
  const bool all_free = !table.pose_is_free.empty() &&
                        std::find(table.pose_is_free.begin(), table.pose_is_free.end(), false) ==
                            table.pose_is_free.end();
  return all_free &&
         std::all_of(table.rows.begin() + static_cast<std::ptrdiff_t>(table.points_mm.size()),
                     table.rows.end(),
                     [](const Observation& row) { return row.kind == ObservationKind::kSize; });
}

bool hangs_on_pose(const FlankGeometry& geometry, const PointFit& fit,
                   const std::vector<int>& effects) {
  constexpr int kOfGrid = 7;
  constexpr double kAlike = 0.05;  // of the largest value
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const auto value = [&](int tooth, int side, int u, int v) {
    const Place place = geometry.on_flank(tooth, side, low + (u + 0.5) / kOfGrid * (high - low),
                                          (v + 0.5) / kOfGrid * geometry.face_width_mm());
    double sum = 0.0;
    for (const int e : effects) {
      const Effect& effect = fit.effects()[static_cast<std::size_t>(e)];
      std::array<double, 8> columns{};
      effect.evaluate(geometry, place, columns.data());
      for (int k = 0; k < effect.columns(); ++k)
        sum += fit.coefficients()[fit.first_column(e) + k] * columns[static_cast<std::size_t>(k)];
    }
    return sum;
  };
  const bool knows_its_end = std::any_of(
      fit.effects().begin(), fit.effects().end(),
      [](const Effect& effect) { return effect.family->named && effect.family->tells_its_end; });
  double most = 0.0, differs = 0.0;
  for (int u = 0; u < kOfGrid; ++u)
    for (int v = 0; v < kOfGrid; ++v)
      for (const int side : {1, -1}) {
        const double first = value(1, side, u, v);
        if (!knows_its_end)
          differs = std::max(differs, std::abs(first - value(1, -side, u, kOfGrid - 1 - v)));
        for (int tooth = 1; tooth <= geometry.teeth(); ++tooth) {
          const double other = value(tooth, side, u, v);
          most = std::max(most, std::abs(other));
          differs = std::max(differs, std::abs(other - first));
        }
      }
  return differs > kAlike * most;
}

}  // namespace trueflank::loop
