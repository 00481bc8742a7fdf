// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/finite_displacement.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

namespace {

/// Moves points of scanned flanks back by what a fit says moved them.
class MoveBack {
 public:
  MoveBack(const FlankGeometry& geometry, const PointFit& fit) : geometry_(geometry), fit_(fit) {
    for (int e = 0; e < static_cast<int>(fit.effects().size()); ++e)
      if (fit.effects()[static_cast<std::size_t>(e)].family->displacement_mm) body_.push_back(e);
  }

  struct Moved {
    Place place;
    double deviation_um = 0.0;
  };
  /// Where a row's point lay, and its deviation there; nothing where it is on no flank, or would
  /// come onto another one.
  [[nodiscard]] std::optional<Moved> operator()(const Observations& table, std::size_t i) const {
    const Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kScanFlank) return {};
    const Place& place = table.places[row.first_place];
    const PlacedPoint placed = geometry_.nearest_flank(moved_back(table.points_mm[i]));
    if (placed.place.tooth != place.tooth || placed.place.side != place.side ||
        !(placed.place.roll_mm > 0.0))
      return {};
    Moved moved{placed.place, um_from_mm(placed.distance_mm)};
    moved.place.surface = place.surface;
    double values[8];
    for (const int e : body_) {
      const Effect& effect = fit_.effects()[static_cast<std::size_t>(e)];
      effect.evaluate(geometry_, placed.place, values);
      for (int k = 0; k < effect.columns(); ++k)
        moved.deviation_um += values[k] * fit_.coefficients()[fit_.first_column(e) + k];
    }
    return moved;
  }

 private:
  [[nodiscard]] std::array<double, 3> moved_back(const std::array<double, 3>& p) const {
    std::array<double, 3> back = p;
    // The displacement belongs to the point before it was moved: two steps find it.
    for (int step = 0; step < 2; ++step) {
      std::array<double, 3> q = p;
      for (const int e : body_) {
        const Effect& effect = fit_.effects()[static_cast<std::size_t>(e)];
        const auto u = effect.family->displacement_mm(
            geometry_, back, effect.shape, fit_.coefficients().data() + fit_.first_column(e));
        for (std::size_t k = 0; k < 3; ++k) q[k] -= u[k];
      }
      back = q;
    }
    return back;
  }

  const FlankGeometry& geometry_;
  const PointFit& fit_;
  std::vector<int> body_;
};

}  // namespace

double change_of_sample_um(const FlankGeometry& geometry, const PointFit& fit,
                           const Observations& table) {
  constexpr std::size_t kSample = 8192;
  const MoveBack move_back(geometry, fit);
  const std::size_t stride = std::max<std::size_t>(1, table.points_mm.size() / kSample);
  double most = 0.0;
  for (std::size_t i = 0; i < table.points_mm.size(); i += stride)
    if (const auto moved = move_back(table, i))
      most = std::max(most, std::abs(moved->deviation_um - table.rows[i].deviation_um));
  return most;
}

double linearise_at(const FlankGeometry& geometry, const PointFit& fit, Observations& table) {
  const MoveBack move_back(geometry, fit);
  table.is_displaced = true;
  return largest_of_points(table, [&](std::size_t i) {
    const auto moved = move_back(table, i);
    if (!moved) return 0.0;
    Observation& row = table.rows[i];
    const double change = std::abs(moved->deviation_um - row.deviation_um);
    row.deviation_um = moved->deviation_um;
    table.places[row.first_place] = moved->place;
    return change;
  });
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
