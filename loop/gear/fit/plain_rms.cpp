// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/plain_rms.h"

#include <algorithm>
#include <cmath>

#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {

double least_plain_rms_um(const FlankGeometry& geometry, const Observations& table,
                          const Patches& patches) {
  constexpr std::size_t kMostPoints = 2000;
  const NuisanceColumns nuisance(geometry, table);
  const std::size_t stride = std::max<std::size_t>(1, table.points_mm.size() / kMostPoints);
  std::vector<double> values;
  for (std::size_t i = 0; i < table.points_mm.size(); i += stride) {
    const Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kScanFlank || patches.patch_of_row[i] < 0) continue;
    const PlacedPoint placed = as_designed(geometry, table, i);
    values.resize(values.size() + static_cast<std::size_t>(nuisance.count()) + 1, 0.0);
    double* const own =
        values.data() + values.size() - static_cast<std::size_t>(nuisance.count()) - 1;
    nuisance.add(placed.place, row.kind, row.source, row.weight, own);
    own[nuisance.count()] = um_from_mm(placed.distance_mm);
  }
  if (values.empty()) return 0.0;
  const Eigen::Index columns = nuisance.count() + 1;
  const Eigen::Map<const Eigen::MatrixXd> rows(values.data(), columns,
                                               static_cast<Eigen::Index>(values.size()) / columns);
  const Eigen::MatrixXd fitted = rows.topRows(columns - 1).transpose();
  const Eigen::VectorXd value = rows.row(columns - 1).transpose();
  const Eigen::VectorXd best = least_squares(fitted, value);
  return (value - fitted * best).norm() / std::sqrt(static_cast<double>(table.rows.size()));
}

}  // namespace trueflank::loop
