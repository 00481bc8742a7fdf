// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/residual_grid.h"

#include <algorithm>

#include "trueflank/base/threads.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

constexpr int kParts = FlankResiduals::kParts;

struct Mean {
  double sum = 0.0, count = 0.0;
  void add(double value) {
    sum += value;
    count += 1.0;
  }
  [[nodiscard]] double value() const { return count > 0.0 ? sum / count : kNaN; }
};

int part_of(double coordinate) {
  return std::clamp(static_cast<int>(0.5 * (coordinate + 1.0) * kParts), 0, kParts - 1);
}

}  // namespace

ResidualGrid residual_grid(const GearLoop& closed, bool after) {
  struct FlankMeans {
    std::array<Mean, kParts> profile, helix;
    Mean place, index;
  };
  const FlankGeometry& g = closed.geometry;
  std::vector<std::array<FlankMeans, 2>> means(g.teeth());
  std::array<std::array<std::array<Mean, kParts>, kParts>, 2> topography;
  const RowsByClass of_side(closed.table.rows.size(), 2, [&](std::size_t i) {
    const Observation& row = closed.table.rows[i];
    const Place& place = closed.table.place(row);
    return place.surface != Surface::kFlank || row.places != 1 ? -1 : place.side > 0 ? 1 : 0;
  });
  const auto add = [&](std::size_t i, std::size_t side) {
    const Observation& row = closed.table.rows[i];
    const Place& place = closed.table.place(row);
    const double value = after ? closed.after_um[i] : closed.before_um[i];
    FlankMeans& flank = means[place.tooth - 1][side];
    const int u = part_of(g.profile_coordinate(place.roll_mm));
    const int v = part_of(g.face_coordinate(place.z_mm));
    const bool scan = row.kind == ObservationKind::kScanFlank;
    if (scan || row.kind == ObservationKind::kProfile) flank.profile[u].add(value);
    if (scan || row.kind == ObservationKind::kHelix) flank.helix[v].add(value);
    if (scan) {
      flank.place.add(value);
      topography[side][u][v].add(value);
    }
    if (row.kind == ObservationKind::kIndex) flank.index.add(value);
  };
  for_each_piece(2, [&](std::size_t side) {
    of_side.for_each(side, closed.table, [&](std::size_t i) { add(i, side); });
  });
  ResidualGrid grid;
  grid.teeth.resize(means.size());
  for (std::size_t k = 0; k < means.size(); ++k)
    for (int side = 0; side < 2; ++side) {
      const FlankMeans& from = means[k][side];
      FlankResiduals& to = grid.teeth[k][side];
      for (int i = 0; i < kParts; ++i) {
        to.profile[i] = from.profile[i].value();
        to.helix[i] = from.helix[i].value();
      }
      to.index = from.index.count > 0.0 ? from.index.value() : from.place.value();
    }
  for (int side = 0; side < 2; ++side)
    for (int u = 0; u < kParts; ++u)
      for (int v = 0; v < kParts; ++v) grid.topography[side][u][v] = topography[side][u][v].value();
  return grid;
}

}  // namespace trueflank::loop
