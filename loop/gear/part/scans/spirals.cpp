// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/scans/spirals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/local/spirals.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

using gear_effects::kFirstOfDrift;
using gear_effects::kLastOfDrift;
using gear_effects::kMeanOfDrift;

double left_by(const PartModel& model, const std::vector<Effect>& beside,
               const std::vector<Effect>& more) {
  std::vector<Effect> with = beside;
  with.insert(with.end(), more.begin(), more.end());
  return fit_of(model, with)->residual_square();
}

}  // namespace

std::optional<RemainderFinding> spiral_of_flanks(const PartModel& model) {
  constexpr double kNoWorse = 9.0, kHardly = 4.0;  // chi-square
  if (model.options.joined || is_rounding(model) || model.table->points_mm.empty()) return {};
  const auto row_um = fit_of(model, model.options.given)->residuals_um();
  const std::optional<Spiral> spiral =
      spiral_around(model.geometry, model.table, model.patches, *row_um);
  if (!spiral) return {};
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  Effect form{find_family("unnamed_spiral"),
              FlankChoice::kBoth,
              {spiral->from_deg, kMeanOfDrift, spiral->outwards ? 0.0 : 1.0}};
  // (a gear off its axis would draw the jump aside)
  std::vector<Effect> beside = model.options.given;
  const Effect off_axis{find_family("eccentricity"), FlankChoice::kBoth, {}};
  if (is_told_apart(model, off_axis, beside)) beside.push_back(off_axis);
  std::vector<Effect> with = beside;
  with.push_back(form);
  // (where no point lies about a jump, places beside it leave as much)
  {
    const std::size_t at = with.size() - 1;
    const TrialFit fit = fit_to_refine(model.geometry, model.table, model.patches, with);
    std::vector<EffectShape> near;
    for (double off = -4.0; off <= 4.0; off += 0.5) {
      near.push_back(form.shape);
      near.back()[0] += off;
    }
    const std::vector<TrialFit::Trial> trials = fit.with_shapes(at, near, 1e300);
    const auto best = std::min_element(
        trials.begin(), trials.end(),
        [](const TrialFit::Trial& a, const TrialFit::Trial& b) { return a.square < b.square; });
    form.shape = near[static_cast<std::size_t>(best - trials.begin())];
    move_alone(model.geometry, fit, at, form.shape);
  }
  // What drifts with the teeth jumps between two of them, and that is simpler. A level beside
  // either costs a value.
  const auto cost = [&](const Effect& effect) {
    return std::min(left_by(model, beside, {effect}),
                    left_by(model, beside, {effect, level}) + kChiSquareOfValue);
  };
  const auto finding_of = [&](const Effect& effect) {
    RemainderFinding finding;
    finding.p_value = spiral->p_value;
    finding.effect = effect;
    return finding;
  };
  const double of_spiral = cost(form);
  const int z = model.geometry.teeth();
  const int jump = static_cast<int>(std::lround(form.shape[0] / 360.0 * z));
  for (const int off : {-1, 0, 1, 2}) {
    const Effect ramp{find_family("unnamed_ramp"),
                      FlankChoice::kBoth,
                      {double(((jump + off) % z + z) % z + 1), 0.0, 0.0, 0.0, kMeanOfDrift}};
    if (cost(ramp) < of_spiral + kHardly) return finding_of(ramp);
  }
  // From nothing at its beginning or its end, where that says the level, too.
  double least = left_by(model, beside, {form, level}) + kNoWorse;
  for (const double zero_at : {kMeanOfDrift, kFirstOfDrift, kLastOfDrift}) {
    Effect other = form;
    other.shape[1] = zero_at;
    const double left = left_by(model, beside, {other});
    if (left >= least) continue;
    least = left;
    form.shape[1] = zero_at;
  }
  return finding_of(form);
}

}  // namespace trueflank::loop
