// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/bore_wall.h"

#include <Eigen/Core>
#include <cmath>
#include <map>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

using Form = Eigen::Matrix<double, 6, 1>;

/// A cone that stands off the axis and leans: how far its wall lies off at a place.
Form form_at(const FlankGeometry& geometry, const Place& place) {
  const double v = geometry.face_coordinate(place.z_mm);
  const double c = place.polar_direction[0], s = place.polar_direction[1];
  Form form;
  form << 1.0, v, c, s, v * c, v * s;
  return form;
}

/// How far each row lies from the cone that those within the limit make.
std::vector<double> distances_um(const FlankGeometry& geometry, const Observations& table,
                                 const std::vector<std::uint32_t>& rows,
                                 const std::vector<double>& before, double limit_um) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(6, 6);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(6);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!(std::abs(before[k]) <= limit_um)) continue;
    const Observation& row = table.rows[rows[k]];
    const Form form = form_at(geometry, table.place(row));
    gram += form * form.transpose();
    right += row.deviation_um * form;
  }
  gram.diagonal().array() += 1e-9 * (1.0 + gram.trace());
  const Eigen::VectorXd cone = symmetric_solution(gram, right);
  std::vector<double> left;
  for (const std::uint32_t i : rows)
    left.push_back(table.rows[i].deviation_um -
                   cone.dot(form_at(geometry, table.place(table.rows[i]))));
  return left;
}

}  // namespace

std::vector<std::uint32_t> rows_off_the_bore(const FlankGeometry& geometry,
                                             const Observations& table) {
  constexpr std::size_t kFewest = 24;
  constexpr int kRounds = 12;
  constexpr double kFar = 6.0;  // scatters
  std::map<int, std::vector<std::uint32_t>> of_source;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].kind == ObservationKind::kScanBore)
      of_source[table.rows[i].source].push_back(static_cast<std::uint32_t>(i));
  std::vector<std::uint32_t> off;
  for (const auto& [source, rows] : of_source) {
    if (rows.size() < kFewest) continue;
    std::vector<double> left(rows.size(), 0.0);
    double limit_um = 0.0;  // all at first
    for (int round = 0; round < kRounds; ++round) {
      left = distances_um(geometry, table, rows, left, limit_um);
      limit_um = kFar * robust_sigma(left);
    }
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (std::abs(left[k]) > limit_um) off.push_back(rows[k]);
  }
  return off;
}

}  // namespace trueflank::loop
