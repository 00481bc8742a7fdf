// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/orders_alike.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop {

std::vector<int> traced_teeth(const Observations& table) {
  std::set<int> teeth;
  for (const Observation& row : table.rows) {
    if (row.kind == ObservationKind::kScanFlank) return {};
    if (row.kind == ObservationKind::kHelix || row.kind == ObservationKind::kProfile)
      teeth.insert(table.place(row).tooth);
  }
  return {teeth.begin(), teeth.end()};
}

namespace {

/// True where the middle of the flank, where an index is taken, has a good part of the effect.
bool shows_in_an_index(const FlankGeometry& geometry, const Effect& effect,
                       const Eigen::VectorXd& coefficients) {
  constexpr double kPart = 0.2;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const double middle = geometry.roll_at_radius_mm(geometry.reference_radius_mm());
  const auto size_at = [&](double roll, double share) {
    double columns[8], most = 0.0;
    for (const int side : {1, -1}) {
      effect.evaluate(geometry, geometry.on_flank(1, side, roll, share * geometry.face_width_mm()),
                      columns);
      double sum = 0.0;
      for (Eigen::Index k = 0; k < coefficients.size(); ++k) sum += coefficients[k] * columns[k];
      most = std::max(most, std::abs(sum));
    }
    return most;
  };
  double most = 0.0;
  for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0})
    for (const double v : {0.0, 0.25, 0.5, 0.75, 1.0})
      most = std::max(most, size_at(low + u * (high - low), v));
  return size_at(middle, 0.5) > kPart * most;
}

}  // namespace

std::vector<int> orders_alike(const FlankGeometry& geometry, const Observations& table,
                              const PointFit& fit, int which) {
  const Effect& effect = fit.effects()[static_cast<std::size_t>(which)];
  const Eigen::VectorXd coefficients =
      fit.coefficients().segment(fit.first_column(which), effect.columns());
  constexpr int kMostOrder = 8;
  constexpr double kAlike = 0.3;  // of the effect may differ
  const bool whole_ring =
      std::any_of(table.rows.begin(), table.rows.end(), [](const Observation& row) {
        return row.kind == ObservationKind::kIndex || row.kind == ObservationKind::kRadial;
      });
  if (effect.family->local || gear_effects::is_of_teeth(effect) || effect.family->displacement_mm ||
      effect.family->tells_order_along_profile ||
      (whole_ring && shows_in_an_index(geometry, effect, coefficients)))
    return {};
  const std::vector<int> teeth = traced_teeth(table);
  const auto n = static_cast<Eigen::Index>(teeth.size());
  if (n == 0) return {};
  const auto angle = [&](Eigen::Index i) {
    return kTwoPi * (teeth[static_cast<std::size_t>(i)] - 1) / geometry.teeth();
  };
  const auto waves = [&](double order) {
    Eigen::MatrixXd columns(n, 2);
    for (Eigen::Index i = 0; i < n; ++i)
      columns.row(i) << std::cos(order * angle(i)), std::sin(order * angle(i));
    return columns;
  };
  const double own = effect.order();
  const bool wave = own > 0.0 && coefficients.size() == 2;
  if (own > 0.0 && !wave) return {};
  const Eigen::VectorXd seen =
      wave ? Eigen::VectorXd(waves(own) * coefficients) : Eigen::VectorXd::Ones(n);
  std::vector<int> alike;
  for (int order = 1; order <= kMostOrder && 2 * order <= geometry.teeth(); ++order) {
    if (order == static_cast<int>(own)) continue;
    const Eigen::MatrixXd other = waves(order);
    const Eigen::VectorXd left = seen - other * least_squares(other, seen);
    if (left.norm() < kAlike * seen.norm()) alike.push_back(order);
  }
  return alike;
}

std::string waves_in_words(const std::vector<int>& orders) {
  if (orders.size() == 1) return "a wave " + std::to_string(orders.front()) + " times per turn";
  std::string text = "waves ";
  for (std::size_t i = 0; i < orders.size(); ++i)
    text += (i == 0 ? "" : i + 1 < orders.size() ? ", " : " and ") + std::to_string(orders[i]);
  return text + " times per turn";
}

}  // namespace trueflank::loop
