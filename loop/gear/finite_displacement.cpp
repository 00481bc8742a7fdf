// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/finite_displacement.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/threads.h"

namespace trueflank::loop {

double linearise_at(const FlankGeometry& geometry, const PointFit& fit, const Observations& measured,
                    Observations& table) {
  std::vector<int> body;
  for (int e = 0; e < static_cast<int>(fit.effects().size()); ++e)
    if (fit.effects()[e].family->displacement_mm) body.push_back(e);
  /// Returns by how much the deviation of a row changes.
  const auto move_row = [&](std::size_t i) {
    const Observation& row = measured.rows[i];
    if (row.kind != ObservationKind::kScanFlank) return 0.0;
    const std::array<double, 3> p = measured.points_mm[i];
    // The displacement belongs to the point before it was moved: two steps find it.
    std::array<double, 3> back = p;
    for (int step = 0; step < 2; ++step) {
      std::array<double, 3> q = p;
      for (const int e : body) {
        const Effect& effect = fit.effects()[e];
        const auto u = effect.family->displacement_mm(
            geometry, back, effect.shape, fit.coefficients().data() + fit.first_column(e));
        for (int k = 0; k < 3; ++k) q[k] -= u[k];
      }
      back = q;
    }
    const PlacedPoint placed = geometry.nearest_flank(back);
    if (placed.place.tooth != measured.place(row).tooth ||
        placed.place.side != measured.place(row).side || !(placed.place.roll_mm > 0.0))
      return 0.0;
    double deviation = um_from_mm(placed.distance_mm);
    double values[8];
    for (const int e : body) {
      fit.effects()[e].evaluate(geometry, placed.place, values);
      for (int k = 0; k < fit.effects()[e].columns(); ++k)
        deviation += values[k] * fit.coefficients()[fit.first_column(e) + k];
    }
    const double change = std::abs(deviation - table.rows[i].deviation_um);
    table.rows[i].deviation_um = deviation;
    Place& place = table.places[table.rows[i].first_place].place;
    const Surface surface = place.surface;
    place = placed.place;
    place.surface = surface;
    return change;
  };
  constexpr std::size_t kRowsOfWork = 16384;
  const std::size_t rows = measured.points_mm.size();
  std::vector<double> largest((rows + kRowsOfWork - 1) / kRowsOfWork, 0.0);
  for_each_piece(largest.size(), [&](std::size_t piece) {
    const std::size_t end = std::min(rows, (piece + 1) * kRowsOfWork);
    for (std::size_t i = piece * kRowsOfWork; i < end; ++i)
      largest[piece] = std::max(largest[piece], move_row(i));
  });
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

}  // namespace trueflank::loop
