// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/finite_displacement.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop {

double linearise_at(const FlankGeometry& geometry, const PointFit& fit, const Observations& measured,
                    Observations& table) {
  std::vector<int> body;
  for (int e = 0; e < static_cast<int>(fit.effects().size()); ++e)
    if (fit.effects()[e].family->displacement_mm) body.push_back(e);
  double largest = 0.0;
  double values[8];
  for (std::size_t i = 0; i < measured.points_mm.size(); ++i) {
    const Observation& row = measured.rows[i];
    if (row.kind != ObservationKind::kScanFlank) continue;
    std::array<double, 3> p = measured.points_mm[i];
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
      continue;
    double deviation = um_from_mm(placed.distance_mm);
    for (const int e : body) {
      fit.effects()[e].evaluate(geometry, placed.place, values);
      for (int k = 0; k < fit.effects()[e].columns(); ++k)
        deviation += values[k] * fit.coefficients()[fit.first_column(e) + k];
    }
    largest = std::max(largest, std::abs(deviation - table.rows[i].deviation_um));
    table.rows[i].deviation_um = deviation;
    Place& place = table.places[table.rows[i].first_place].place;
    const Surface surface = place.surface;
    place = placed.place;
    place.surface = surface;
  }
  return largest;
}

}  // namespace trueflank::loop
