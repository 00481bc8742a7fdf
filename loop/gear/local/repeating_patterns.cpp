// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/repeating_patterns.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "trueflank/loop/gear/effects/repeating_pattern.h"

namespace trueflank::loop {
namespace {

using gear_effects::kPatternValues;

/// Means of a pattern's teeth; empty where one of them was not measured.
std::vector<double> means_of(const ValuesOfTeeth& values, int every, int first) {
  const auto teeth = static_cast<int>(values.sum.size());
  const auto count = static_cast<std::size_t>(every);
  std::vector<double> sum(count, 0.0), weight(count, 0.0);
  for (int since = 0; since < teeth; ++since) {
    const auto tooth = static_cast<std::size_t>((first - 1 + since) % teeth);
    const auto k = static_cast<std::size_t>(since % every);
    sum[k] += values.sum[tooth];
    weight[k] += values.count[tooth];
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (!(weight[k] > 0.0)) return {};
    sum[k] /= weight[k];
  }
  return sum;
}

/// Means as shape values: about their mean over the teeth, of a mean square of 1; none where all
/// are alike.
std::optional<EffectShape> as_shape(int teeth, int every, int first, bool opposite,
                                    std::vector<double> means) {
  double mean = 0.0, square = 0.0;
  for (int since = 0; since < teeth; ++since)
    mean += means[static_cast<std::size_t>(since % every)] / teeth;
  for (int since = 0; since < teeth; ++since)
    square += std::pow(means[static_cast<std::size_t>(since % every)] - mean, 2) / teeth;
  if (!(square > 0.0)) return std::nullopt;
  EffectShape shape{double(every), double(first), opposite ? 1.0 : 0.0};
  for (const double value : means) shape.push_back((value - mean) / std::sqrt(square));
  return shape;
}

}  // namespace

ValuesOfTeeth::ValuesOfTeeth(const FlankGeometry& geometry, const Observations& table,
                             const std::vector<float>& residual_um, FlankChoice flank,
                             bool opposite)
    : sum(static_cast<std::size_t>(geometry.teeth()), 0.0),
      count(static_cast<std::size_t>(geometry.teeth()), 0.0) {
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const Observation& row = table.rows[r];
    const Place& place = table.place(row);
    if (row.kind != ObservationKind::kIndex || place.surface != Surface::kFlank) continue;
    if (flank != FlankChoice::kBoth && flank_of(geometry, place) != flank) continue;
    const auto tooth = static_cast<std::size_t>(place.tooth - 1);
    sum[tooth] += (opposite ? place.side : 1) * static_cast<double>(residual_um[r]);
    count[tooth] += 1.0;
  }
}

std::vector<EffectShape> repeating_patterns(const ValuesOfTeeth& values, bool opposite,
                                            std::size_t most) {
  constexpr int kFewestBeside = 4;
  const auto teeth = static_cast<int>(values.sum.size());
  double all = 0.0, sum = 0.0, number = 0.0;
  int measured = 0;
  for (std::size_t t = 0; t < values.sum.size(); ++t) {
    if (!(values.count[t] > 0.0)) continue;
    all += values.sum[t] * values.sum[t] / values.count[t];
    sum += values.sum[t];
    number += values.count[t];
    ++measured;
  }
  if (!(number > 0.0)) return {};
  const double of_mean = sum * sum / number;
  std::vector<std::pair<double, EffectShape>> found;
  for (int every = gear_effects::kFewestOfPattern;
       every <= gear_effects::most_of_pattern(teeth) && every + kFewestBeside <= measured; ++every)
    for (int first = 1; first <= (teeth % every == 0 ? 1 : teeth); ++first) {
      std::vector<double> means = means_of(values, every, first);
      if (means.empty()) continue;
      double explained = -of_mean;
      for (int since = 0; since < teeth; ++since) {
        const auto tooth = static_cast<std::size_t>((first - 1 + since) % teeth);
        explained += means[static_cast<std::size_t>(since % every)] * values.sum[tooth];
      }
      const double left = std::max(all - of_mean - explained, 1e-9 * all);
      if (!(explained > 0.0) || !(all - of_mean > 0.0)) continue;
      if (auto shape = as_shape(teeth, every, first, opposite, std::move(means)))
        found.emplace_back(measured * std::log(left) + kChiSquareOfValue * (every - 1),
                           std::move(*shape));
    }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<EffectShape> shapes;
  for (auto& [cost, shape] : found) {
    if (shapes.size() == most) break;
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

EffectShape with_means_of(const EffectShape& shape, const ValuesOfTeeth& values) {
  const auto teeth = static_cast<int>(values.sum.size());
  const auto every = static_cast<int>(shape[gear_effects::kPatternEvery]),
             first = static_cast<int>(shape[gear_effects::kPatternFirst]);
  std::vector<double> means = means_of(values, every, first);
  if (means.empty()) return shape;
  return as_shape(teeth, every, first, shape[gear_effects::kPatternOpposite] != 0.0,
                  std::move(means))
      .value_or(shape);
}

}  // namespace trueflank::loop
