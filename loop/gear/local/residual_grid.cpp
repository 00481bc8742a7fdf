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

struct FlankMeans {
  std::array<Mean, kParts> profile, helix;
  Mean place, index;
};

/// Means of one kind of residuals, as they are added.
struct Means {
  explicit Means(int teeth) : flanks(static_cast<std::size_t>(teeth)) {}
  std::vector<std::array<FlankMeans, 2>> flanks;
  std::array<std::array<std::array<Mean, kParts>, kParts>, 2> topography;

  void add(const Observation& row, std::size_t tooth, std::size_t side, std::size_t u,
           std::size_t v, double value) {
    FlankMeans& flank = flanks[tooth][side];
    const bool scan = row.kind == ObservationKind::kScanFlank;
    if (scan || row.kind == ObservationKind::kProfile) flank.profile[u].add(value);
    if (scan || row.kind == ObservationKind::kHelix) flank.helix[v].add(value);
    if (scan) {
      flank.place.add(value);
      topography[side][u][v].add(value);
    }
    if (row.kind == ObservationKind::kIndex) flank.index.add(value);
  }
  [[nodiscard]] ResidualGrid grid() const {
    ResidualGrid result;
    result.teeth.resize(flanks.size());
    for (std::size_t k = 0; k < flanks.size(); ++k)
      for (std::size_t side = 0; side < 2; ++side) {
        const FlankMeans& from = flanks[k][side];
        FlankResiduals& to = result.teeth[k][side];
        for (std::size_t i = 0; i < kParts; ++i) {
          to.profile[i] = from.profile[i].value();
          to.helix[i] = from.helix[i].value();
        }
        to.index = from.index.count > 0.0 ? from.index.value() : from.place.value();
      }
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t u = 0; u < kParts; ++u)
        for (std::size_t v = 0; v < kParts; ++v)
          result.topography[side][u][v] = topography[side][u][v].value();
    return result;
  }
};

/// Grids of some residuals of the rows, gathered in one go.
template <std::size_t count>
std::array<ResidualGrid, count> grids_of(
    const GearLoop& closed, const std::array<const std::vector<float>*, count>& residuals_um) {
  const FlankGeometry& g = closed.geometry;
  std::vector<Means> means(count, Means(g.teeth()));
  const RowsByClass of_side(closed.table.rows.size(), 2, [&](std::size_t i) {
    const Observation& row = closed.table.rows[i];
    const Place& place = closed.table.place(row);
    return place.surface != Surface::kFlank || row.places != 1 ? -1 : place.side > 0 ? 1 : 0;
  });
  for_each_piece(2, [&](std::size_t side) {
    of_side.for_each(side, closed.table, [&](std::size_t i) {
      const Observation& row = closed.table.rows[i];
      const Place& place = closed.table.place(row);
      const auto tooth = static_cast<std::size_t>(place.tooth - 1),
                 u = static_cast<std::size_t>(part_of(g.profile_coordinate(place.roll_mm), kParts)),
                 v = static_cast<std::size_t>(part_of(g.face_coordinate(place.z_mm), kParts));
      for (std::size_t k = 0; k < count; ++k)
        means[k].add(row, tooth, side, u, v, static_cast<double>((*residuals_um[k])[i]));
    });
  });
  std::array<ResidualGrid, count> grids;
  for (std::size_t k = 0; k < count; ++k) grids[k] = means[k].grid();
  return grids;
}

}  // namespace

ResidualGrid residual_grid_before(const GearLoop& closed) {
  return grids_of<1>(closed, {&closed.before_um})[0];
}

std::array<ResidualGrid, 2> residual_grids(const GearLoop& closed) {
  return grids_of<2>(closed, {&closed.before_um, &closed.after_um});
}

}  // namespace trueflank::loop
