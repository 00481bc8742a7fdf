// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/finite_displacement.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/threads.h"

namespace trueflank::loop {

namespace {

constexpr std::size_t kRowsOfWork = 16384;

/// Does `work(i)` for every row of a scan, on all processors; returns the largest of its results.
template <class Work>
double largest_of_points(const Observations& table, const Work& work) {
  const std::size_t rows = table.points_mm.size();
  std::vector<double> largest((rows + kRowsOfWork - 1) / kRowsOfWork, 0.0);
  for_each_piece(largest.size(), [&](std::size_t piece) {
    const std::size_t end = std::min(rows, (piece + 1) * kRowsOfWork);
    double most = 0.0;
    for (std::size_t i = piece * kRowsOfWork; i < end; ++i) most = std::max(most, work(i));
    largest[piece] = most;
  });
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

}  // namespace

double linearise_at(const FlankGeometry& geometry, const PointFit& fit, Observations& table) {
  std::vector<int> body;
  for (int e = 0; e < static_cast<int>(fit.effects().size()); ++e)
    if (fit.effects()[e].family->displacement_mm) body.push_back(e);
  /// Returns by how much the deviation of a row changes.
  const auto move_row = [&](std::size_t i) {
    Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kScanFlank) return 0.0;
    Place& place = table.places[row.first_place];
    const std::array<double, 3> p = table.points_mm[i];
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
    if (placed.place.tooth != place.tooth || placed.place.side != place.side ||
        !(placed.place.roll_mm > 0.0))
      return 0.0;
    double deviation = um_from_mm(placed.distance_mm);
    double values[8];
    for (const int e : body) {
      fit.effects()[e].evaluate(geometry, placed.place, values);
      for (int k = 0; k < fit.effects()[e].columns(); ++k)
        deviation += values[k] * fit.coefficients()[fit.first_column(e) + k];
    }
    const double change = std::abs(deviation - row.deviation_um);
    row.deviation_um = deviation;
    const Surface surface = place.surface;
    place = placed.place;
    place.surface = surface;
    return change;
  };
  table.is_displaced = true;
  return largest_of_points(table, move_row);
}

void undo_displacement(const FlankGeometry& geometry, Observations& table) {
  if (!table.is_displaced) return;
  largest_of_points(table, [&](std::size_t i) {
    Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kScanFlank) return 0.0;
    const PlacedPoint placed = as_designed(geometry, table, i);
    row.deviation_um = um_from_mm(placed.distance_mm);
    table.places[row.first_place] = placed.place;
    return 0.0;
  });
  table.is_displaced = false;
}

}  // namespace trueflank::loop
