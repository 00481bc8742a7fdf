// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/possible_effects.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop {
namespace {

/// Deviations larger than this share of the module are no deviations of a gear: rows of that size are not read.
constexpr double kMostInModules = 0.5;
/// How many times what was measured one effect may add up to while others take it back.
constexpr double kMostTakenBack = 8.0;

/// How many times what traces see of an effect around the gear (rms) it may be anywhere: a gear
/// that is out of round turns helix traces by a thirtieth of that, and so does much else.
constexpr double kMostUnseen = 15.0;

/// The most an effect moves a flank anywhere on the gear [um].
double most_on_the_gear_um(const FlankGeometry& geometry, const Effect& effect, const Eigen::VectorXd& b) {
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  double most = 0.0, columns[8];
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
    for (const int side : {1, -1})
      for (const double u : {0.0, 0.5, 1.0})
        for (const double v : {0.0, 0.5, 1.0}) {
          const Place place = geometry.on_flank(tooth, side, low + u * (high - low),
                                                v * geometry.face_width_mm());
          effect.evaluate(geometry, place, columns);
          double sum = 0.0;
          for (int k = 0; k < effect.columns(); ++k) sum += b[k] * columns[k];
          most = std::max(most, std::abs(sum));
        }
  return most;
}

/// True of a step that stands as near to an end as it may: it moves all of the face, or none.
bool is_step_at_an_end(const FlankGeometry& geometry, const Effect& effect) {
  constexpr double kAtTheEnd = 1e-3;
  if (!effect.family->shape_is_step || !effect.family->shape_limits) return false;
  const auto [low, high] = effect.family->shape_limits(geometry, 0);
  const double share = (effect.shape[0] - low) / (high - low);
  return share < kAtTheEnd || share > 1.0 - kAtTheEnd;
}

}  // namespace

bool is_possible(const FlankGeometry& geometry, const PointFit& fit, int effect) {
  const Effect& one = fit.effects()[effect];
  const Eigen::VectorXd b = fit.coefficients().segment(fit.first_column(effect), one.columns());
  if (one.family->only_positive && !(b.array() > 0.0).all()) return false;
  if (is_step_at_an_end(geometry, one)) return false;
  const double module_um = 1e3 * geometry.gear().normal_module_mm;
  const double most_um = most_on_the_gear_um(geometry, one, b);
  if (most_um > kMostInModules * module_um) return false;
  if (one.family->named && one.order() > 0.0 && fit.is_of_traces_alone() &&
      most_um > kMostUnseen * fit.effect_size_um(effect))
    return false;
  const double before = fit.errors(std::vector<bool>(fit.effects().size(), false)).rms_um;
  return !(before > 0.0) || fit.effect_size_um(effect) <= kMostTakenBack * before;
}

}  // namespace trueflank::loop
