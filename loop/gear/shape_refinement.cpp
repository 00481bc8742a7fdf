// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/shape_refinement.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace trueflank::loop {
namespace {

constexpr std::size_t kMostRows = 40000;  // of the search; the final fit takes all

bool is_step(const Effect& effect) { return effect.family->shape_is_step; }

std::size_t stride_for(const Observations& table) {
  return std::max<std::size_t>(1, table.rows.size() / kMostRows);
}

/// Effects together with one derivative column per continuous shape value.
struct Extended {
  std::deque<EffectFamily> families;  // addresses stay
  std::vector<Effect> effects;
  struct Slot {
    int effect, value, column_effect;
  };
  std::vector<Slot> slots;
};

Extended with_derivatives(const FlankGeometry& geometry, const std::vector<Effect>& effects,
                          const Eigen::VectorXd& coefficients, const PointFit& fit) {
  Extended result;
  result.effects = effects;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const Effect& effect = effects[e];
    if (!effect.family->shape_is_continuous || is_step(effect)) continue;
    const Eigen::VectorXd b =
        coefficients.segment(fit.first_column(static_cast<int>(e)), effect.columns());
    for (std::size_t k = 0; k < effect.shape.size(); ++k) {
      EffectFamily family;
      family.columns = [](const std::vector<double>&) { return 1; };
      family.evaluate = [effect, b, k](const FlankGeometry& g, const Place& p,
                                       const std::vector<double>&, double* c) {
        double up[8], down[8];
        Effect moved = effect;
        const double h = 1e-4 * effect.shape[k];
        moved.shape[k] = effect.shape[k] + h;
        moved.evaluate(g, p, up);
        moved.shape[k] = effect.shape[k] - h;
        moved.evaluate(g, p, down);
        c[0] = 0.0;
        for (int i = 0; i < b.size(); ++i) c[0] += b[i] * (up[i] - down[i]) / (2.0 * h);
      };
      result.families.push_back(std::move(family));
      result.slots.push_back({static_cast<int>(e), static_cast<int>(k),
                              static_cast<int>(result.effects.size())});
      result.effects.push_back({&result.families.back(), FlankChoice::kBoth, {}});
    }
  }
  static_cast<void>(geometry);
  return result;
}

/// Keeps a shape value where it means something.
double limited(const FlankGeometry& g, const Effect& effect, std::size_t k, double value) {
  if (!effect.family->shape_limits) return value;
  const auto [least, most] = effect.family->shape_limits(g, k);
  return std::clamp(value, least, most);
}

void refine_steps(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
                  std::vector<Effect>& effects) {
  for (Effect& effect : effects) {
    if (!is_step(effect)) continue;
    double reach = 0.065 * geometry.face_width_mm();
    for (int round = 0; round < 2; ++round, reach /= 8.0) {
      const double middle = effect.shape[0];
      double best = 1e300, at = middle;
      for (int i = -8; i <= 8; ++i) {
        effect.shape[0] = limited(geometry, effect, 0, middle + reach * i / 8.0);
        const double square =
            PointFit(geometry, table, patches, effects, stride_for(table)).residual_square();
        if (square < best) {
          best = square;
          at = effect.shape[0];
        }
      }
      effect.shape[0] = at;
    }
  }
}

}  // namespace

void refine_shapes(const FlankGeometry& geometry, const Observations& table,
                   const Patches& patches, std::vector<Effect>& effects) {
  refine_steps(geometry, table, patches, effects);
  const bool smooth = std::any_of(effects.begin(), effects.end(), [](const Effect& effect) {
    return effect.family->shape_is_continuous && !is_step(effect);
  });
  if (!smooth) return;
  const std::size_t stride = stride_for(table);
  double last = 1e300;
  double damping = 1.0;
  std::vector<Effect> best = effects;
  for (int round = 0; round < 12; ++round) {
    const PointFit fit(geometry, table, patches, effects, stride);
    if (fit.residual_square() < last) {
      if (last - fit.residual_square() < 1e-6 * last && round > 0) {
        best = effects;
        break;
      }
      last = fit.residual_square();
      best = effects;
    } else {
      damping *= 0.4;
      effects = best;
      if (damping < 0.05) break;
      const PointFit back(geometry, table, patches, effects, stride);
      const Extended extended = with_derivatives(geometry, effects, back.coefficients(), back);
      const PointFit joint(geometry, table, patches, extended.effects, stride);
      for (const auto& slot : extended.slots)
        effects[slot.effect].shape[slot.value] =
            limited(geometry, effects[slot.effect], slot.value,
                    effects[slot.effect].shape[slot.value] +
                        damping * joint.coefficients()[joint.first_column(slot.column_effect)]);
      continue;
    }
    const Extended extended = with_derivatives(geometry, effects, fit.coefficients(), fit);
    const PointFit joint(geometry, table, patches, extended.effects, stride);
    for (const auto& slot : extended.slots)
      effects[slot.effect].shape[slot.value] =
          limited(geometry, effects[slot.effect], slot.value,
                  effects[slot.effect].shape[slot.value] +
                      damping * joint.coefficients()[joint.first_column(slot.column_effect)]);
  }
  effects = best;
}

ShapeUncertainty shape_uncertainty(const FlankGeometry& geometry, const Observations& table,
                                   const Patches& patches, const PointFit& fit) {
  ShapeUncertainty result;
  result.covariance = fit.covariance();
  bool smooth = false;
  for (const Effect& effect : fit.effects()) {
    result.errors.emplace_back(effect.shape.size(), kNaN);
    if (is_step(effect)) result.errors.back()[0] = 0.005 * geometry.face_width_mm();
    else smooth = smooth || effect.family->shape_is_continuous;
  }
  if (!smooth) return result;
  const Extended extended = with_derivatives(geometry, fit.effects(), fit.coefficients(), fit);
  const PointFit joint(geometry, table, patches, extended.effects);
  const auto p = result.covariance.rows();
  result.covariance = joint.covariance().topLeftCorner(p, p);
  for (const auto& slot : extended.slots) {
    const int column = joint.first_column(slot.column_effect);
    result.errors[slot.effect][slot.value] = std::sqrt(joint.covariance()(column, column));
  }
  return result;
}

}  // namespace trueflank::loop
