// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/scans/pixels.h"

#include <optional>
#include <utility>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/plane/alike_over_height.h"
#include "trueflank/loop/gear/plane/plane_waves.h"
#include "trueflank/loop/gear/table/scanned_flank_rows.h"

namespace trueflank::loop {
namespace {

constexpr double kSure = 1e-6;

std::vector<bool> rows_in_patches(const PartModel& model) {
  std::vector<bool> used(model.table->rows.size());
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = model.patches.patch_of_row[i] >= 0;
  return used;
}

}  // namespace

std::vector<RemainderFinding> pixels_of_plane(const PartModel& model) {
  std::vector<RemainderFinding> found;
  if (model.table->points_mm.empty() || model.options.joined || is_rounding(model)) return found;
  const auto row_um = fit_of(model, model.options.given)->residuals_um();
  const std::vector<bool> used = rows_in_patches(model);
  const auto alike = alike_over_height(model.geometry, model.table, *row_um, used);
  if (!alike || alike->p_value > kSure) return found;
  for (const PlaneWave& saw : likeliest_pixels(model.geometry, model.table, *row_um,
                                               scanned_flank_rows(model.table, used))) {
    found.emplace_back();
    found.back().p_value = saw.p_value;
    found.back().amount_um = saw.amplitude_um;
    found.back().effect = Effect{find_family("unnamed_plane_saw"), FlankChoice::kBoth, saw.shape()};
  }
  return found;
}

bool tell_pattern_alike_over_height(PartModel& model) {
  if (model.table->points_mm.empty() || model.options.joined || is_rounding(model)) return false;
  const auto alike =
      alike_over_height(model.geometry, model.table, *fit_of(model, model.effects)->residuals_um(),
                        rows_in_patches(model));
  if (!alike || alike->p_value > kSure) return false;
  RemainderFinding finding;
  finding.p_value = alike->p_value;
  finding.text =
      printed("a fine pattern of the section, alike at every height, %.3g um rms",
              alike->pattern_um) +
      printed(" beside an error of %.3g um that differs from height to height", alike->noise_um);
  finding.amount_um = alike->pattern_um;
  finding.noise_um = alike->noise_um;
  model.remainder.push_back(std::move(finding));
  return true;
}

}  // namespace trueflank::loop
