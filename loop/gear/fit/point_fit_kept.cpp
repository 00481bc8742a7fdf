// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of a fit that are computed once and kept.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "trueflank/loop/gear/fit/point_fit.h"
#include "trueflank/loop/gear/table/alike_rows.h"

namespace trueflank::loop {

/// Rows of traces are asked three times: for their zeros, for all sums, for what is left.
void PointFit::keep_features(Known known) {
  constexpr std::size_t kMost = 4'000'000;
  const auto width = static_cast<std::size_t>(columns_) + 1;
  if (table_.traces == 0 || !table_.points_mm.empty() || table_.rows.size() * width > kMost) return;
  std::vector<std::uint32_t> rows;
  for (std::size_t i = 0; i < table_.rows.size(); i += stride_)
    if (patches_.patch_of_row[i] >= 0) rows.push_back(static_cast<std::uint32_t>(i));
  kept_.assign(table_.rows.size() * width, 0.0);
  const auto add = [&](const PreparedEffect& effect, std::uint32_t asked, double* values) {
    double one[8];
    const Observation& row = table_.rows[asked];
    for (std::uint32_t k = 0; k < row.places; ++k) {
      effect.evaluate(table_.places[row.first_place + k], one);
      for (int c = 0; c < effect.columns(); ++c) values[c] += row.weight * one[c];
    }
  };
  for (const std::uint32_t i : rows) {
    double* const values = kept_.data() + i * width;
    const Observation& row = table_.rows[i];
    for (std::uint32_t k = 0; k < row.places; ++k)
      nuisance_.add(table_.places[row.first_place + k], row.kind, row.source, row.weight, values);
    values[columns_] = row.deviation_um;
  }
  std::vector<KeptColumns> taken;
  std::optional<AlikeRows> alike;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const Effect& effect = effects_[e];
    if (is_in_known(e, known, taken)) continue;
    double* const column = kept_.data() + first_column_[e];
    if (!effect.family->same_on_every_tooth || !effect.family->same_on_every_tooth(effect.shape)) {
      for (const std::uint32_t i : rows) add(prepared_[e], i, column + i * width);
      continue;
    }
    if (!alike) alike = alike_rows(table_, rows);
    for (const std::uint32_t i : alike->first) add(prepared_[e], i, column + i * width);
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (const std::uint32_t first = alike->first[alike->kind[r]]; first != rows[r])
        std::copy_n(column + first * width, effect.columns(), column + rows[r] * width);
  }
  for (const std::uint32_t i : rows)
    for (const KeptColumns& columns : taken)
      std::copy_n(columns.from + i * columns.width, columns.count,
                  kept_.data() + i * width + columns.to);
}

/// Whether a fit has the columns of an effect, and where; those beside the last ones go with them.
bool PointFit::is_in_known(std::size_t e, Known known, std::vector<KeptColumns>& taken) const {
  for (const auto& fit : known) {
    const auto found = std::find(fit->effects_.begin(), fit->effects_.end(), effects_[e]);
    if (found == fit->effects_.end() || fit->kept_.empty() || fit->stride_ != stride_) continue;
    const KeptColumns columns{
        .from = fit->kept_.data() +
                fit->first_column_[static_cast<std::size_t>(found - fit->effects_.begin())],
        .width = static_cast<std::size_t>(fit->columns_) + 1,
        .to = first_column_[e],
        .count = effects_[e].columns()};
    if (!taken.empty() && taken.back().from + taken.back().count == columns.from &&
        taken.back().to + taken.back().count == columns.to)
      taken.back().count += columns.count;
    else
      taken.push_back(columns);
    return true;
  }
  return false;
}

bool PointFit::is_of_traces_alone() const {
  return std::all_of(
      patches_.patches.begin(), patches_.patches.end(), [](const Patches::Patch& patch) {
        return patch.kind == ObservationKind::kProfile || patch.kind == ObservationKind::kHelix;
      });
}

}  // namespace trueflank::loop
