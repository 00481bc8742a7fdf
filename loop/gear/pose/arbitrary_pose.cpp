// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/pose/arbitrary_pose.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trueflank::loop {

bool is_of_any_pose(const Observations& table) {
  const bool all_free = !table.pose_is_free.empty() &&
                        std::find(table.pose_is_free.begin(), table.pose_is_free.end(), false) ==
                            table.pose_is_free.end();
  return all_free && may_be_turned(table);
}

bool may_be_turned(const Observations& table) {
  return !table.points_mm.empty() &&
         std::all_of(table.rows.begin() + static_cast<std::ptrdiff_t>(table.points_mm.size()),
                     table.rows.end(),
                     [](const Observation& row) { return row.kind == ObservationKind::kSize; });
}

double height_of_flanks_um(const FlankGeometry& geometry, const PointFit& fit, int effect) {
  constexpr double kAlike = 1e-6;
  const Effect& one = fit.effects()[static_cast<std::size_t>(effect)];
  if (one.columns() != 1 || one.family->local || one.order() > 0.0) return kNaN;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const double amount = fit.coefficients()[fit.first_column(effect)];
  const int own_side = flank_side(one.flank == FlankChoice::kLeft ? Flank::kLeft : Flank::kRight,
                                  geometry.gear().kind);
  double height = kNaN;
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
    for (const int side : {1, -1})
      for (const double at : {0.1, 0.37, 0.6, 0.9})
        for (const double v : {0.1, 0.4, 0.9}) {
          const Place place =
              geometry.on_flank(tooth, side, low + at * (high - low), v * geometry.face_width_mm());
          if (one.flank != FlankChoice::kBoth && side != own_side) continue;
          double column = 0.0;
          one.evaluate(geometry, place, &column);
          if (std::isnan(height)) height = amount * column;
          if (!(std::abs(amount * column - height) <= kAlike * std::abs(height))) return kNaN;
        }
  return height;
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
