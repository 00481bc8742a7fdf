// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/few_index_values.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::loop {

std::optional<RemainderFinding> eccentricity_of_few_values(const PartModel& model) {
  constexpr std::size_t kFewest = 6, kMost = 14;
  constexpr double kLevel = 1e-3, kWidestGap = 0.5;  // by chance; of a turn
  if (model.options.joined || !model.options.given.empty() || model.table->rows.size() < kFewest ||
      model.table->rows.size() > kMost)
    return {};
  const int side = model.table->place(model.table->rows.front()).side;
  std::set<int> teeth;
  for (const Observation& row : model.table->rows) {
    if (row.kind != ObservationKind::kIndex || row.places != 1 ||
        model.table->place(row).side != side || row.source != model.table->rows.front().source)
      return {};
    teeth.insert(model.table->place(row).tooth);
  }
  int widest = model.geometry.teeth() - *teeth.rbegin() + *teeth.begin();
  for (auto tooth = teeth.begin(); std::next(tooth) != teeth.end(); ++tooth)
    widest = std::max(widest, *std::next(tooth) - *tooth);
  if (teeth.size() < kFewest || widest > kWidestGap * model.geometry.teeth()) return {};
  const Effect wave{find_family("eccentricity"), FlankChoice::kBoth, {}};
  const auto n = static_cast<Eigen::Index>(model.table->rows.size());
  Eigen::MatrixXd columns(n, 3);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Observation& row = model.table->rows[static_cast<std::size_t>(i)];
    std::array<double, 2> own{};
    wave.evaluate(model.geometry, model.table->place(row), own.data());
    columns.row(i) << 1.0, own[0], own[1];
    values[i] = row.deviation_um;
  }
  const Eigen::VectorXd x = least_squares(columns, values);
  const double left = (values - columns * x).squaredNorm(),
               all = (values.array() - values.mean()).matrix().squaredNorm();
  const double degrees = static_cast<double>(n - 3);
  RemainderFinding finding;
  finding.p_value = f_tail((all - left) / 2.0 / std::max(1e-12, left / degrees), 2.0, degrees);
  if (!(finding.p_value < kLevel)) return {};
  finding.effect = wave;
  return finding;
}

}  // namespace trueflank::loop
