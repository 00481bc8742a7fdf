// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/reading_steps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "trueflank/loop/discovery/mixed_bits.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// Even shares that make up a nearly normal one; their variance is a half.
constexpr int kShares = 6;

bool is_in_trace(const Observation& row) {
  return row.kind == ObservationKind::kProfile || row.kind == ObservationKind::kHelix;
}

std::pair<int, int> kind_and_source(const Observation& row) {
  return {static_cast<int>(row.kind), row.source};
}

/// A number of 0 to 1 for each row, as if at random: its number's bits, mixed.
double row_share(std::uint64_t row) {
  return static_cast<double>(mixed_bits(row + 1) >> 11) * 0x1p-53;
}

}  // namespace

ReadingSteps::ReadingSteps(const Observations& table, const std::vector<float>& row_um) {
  constexpr double kCoarse = 1.0;  // step over the scatter of what is left
  struct Values {
    std::vector<double> read;
    double square = 0.0;
  };
  std::map<std::pair<int, int>, Values> of;
  for (std::size_t i = table.points_mm.size(); i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    if (!is_in_trace(row)) continue;
    Values& values = of[kind_and_source(row)];
    values.read.push_back(row.deviation_um);
    values.square += double{row_um[i]} * row_um[i];
  }
  for (auto& [key, values] : of) {
    const double scatter = std::sqrt(values.square / static_cast<double>(values.read.size()));
    const double step = step_of_readings(std::move(values.read));
    if (step > kCoarse * scatter) step_um_[key] = step;
  }
}

double ReadingSteps::step_um(const Observations& table, std::size_t row) const {
  const Observation& one = table.rows[row];
  if (step_um_.empty() || !is_in_trace(one)) return 0.0;
  const auto found = step_um_.find(kind_and_source(one));
  return found == step_um_.end() ? 0.0 : found->second;
}

double ReadingSteps::spread_um(const Observations& table, std::size_t row) const {
  const double step = step_um(table, row);
  return step > 0.0 ? step * (row_share(row) - 0.5) : 0.0;
}

double ReadingSteps::wide_spread_um(const Observations& table, std::size_t row) const {
  const double step = step_um(table, row);
  if (!(step > 0.0)) return 0.0;
  double sum = 0.0;
  for (int k = 0; k < kShares; ++k)
    sum += row_share(kShares * static_cast<std::uint64_t>(row) + k) - 0.5;
  return step * sum;
}

double ReadingSteps::wide_variance(ObservationKind kind, int source) const {
  const auto found = step_um_.find({static_cast<int>(kind), source});
  return found == step_um_.end() ? 0.0 : found->second * found->second * kShares / 12.0;
}

}  // namespace trueflank::loop
