// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/shape_refinement.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "trueflank/loop/gear/fit/trial_fit.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kMostRows = 40000;  // of the search; the final fit takes all
constexpr double kStep = 1e-4;            // of a shape value, for its derivative

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

/// A value of a shape a little lower and higher.
struct Beside {
  EffectShape down, up;
};

/// True for values of a form without a name that are places, lengths or widths.
bool is_length(const EffectFamily& family, std::size_t k) {
  return family.term_keys.size() == family.shape_names.size() &&
         family.term_keys[k].kind == TermKey::Kind::kNumber;
}

/// The nearest of some shapes on both sides in which nothing but a length is another; equal: there
/// are none.
Beside nearest_beside(const Effect& effect, const std::vector<EffectShape>& shapes, std::size_t k) {
  Beside beside{effect.shape, effect.shape};
  if (!is_length(*effect.family, k)) return beside;
  double down = -1e300, up = 1e300;
  for (const EffectShape& shape : shapes) {
    const double step = shape[k] - effect.shape[k];
    EffectShape same = shape;
    same[k] = effect.shape[k];
    if (same != effect.shape || step == 0.0) continue;
    if (step < 0.0 && step > down) {
      down = step;
      beside.down = shape;
    } else if (step > 0.0 && step < up) {
      up = step;
      beside.up = shape;
    }
  }
  return beside;
}

/// Between the shapes nearest to one, where each length by itself leaves least: the parabola
/// through what is left with the length below, as it is and above. The same shape where there are
/// none.
EffectShape lowest_between(const Effect& effect, const std::vector<EffectShape>& shapes,
                           const std::vector<TrialFit::Trial>& trials, double square) {
  EffectShape lowest = effect.shape;
  const auto left_with = [&](const EffectShape& shape) {
    const auto at = std::find(shapes.begin(), shapes.end(), shape) - shapes.begin();
    return trials[static_cast<std::size_t>(at)].square - square;
  };
  for (std::size_t k = 0; k < effect.shape.size(); ++k) {
    const auto [down, up] = nearest_beside(effect, shapes, k);
    if (down == effect.shape || up == effect.shape) continue;
    const double below = effect.shape[k] - down[k], above = up[k] - effect.shape[k];
    const double slope_below = left_with(down) / below, slope_above = left_with(up) / above;
    const double bends = slope_below + slope_above;
    if (!(bends > 0.0)) continue;
    const double off = 0.5 * (above * slope_below - below * slope_above) / bends;
    lowest[k] += std::clamp(off, -below, above);
  }
  return lowest;
}

/// Between which shapes the derivative of a value is taken; equal: the value is not free.
Beside moved_a_little(const FlankGeometry& geometry, const Effect& effect, std::size_t k,
                      FreeShapes free) {
  Beside beside{effect.shape, effect.shape};
  if (effect.family->shape_is_continuous) {
    if (is_step(effect)) return beside;
    const double h = kStep * effect.shape[k];
    beside.up[k] = effect.shape[k] + h;
    beside.down[k] = effect.shape[k] - h;
    return beside;
  }
  if (free != FreeShapes::kAll || !effect.family->nearby) return beside;
  return nearest_beside(effect, effect.family->nearby(geometry, effect.shape), k);
}

Extended with_derivatives(const FlankGeometry& geometry, const std::vector<Effect>& effects,
                          const Eigen::VectorXd& coefficients, const PointFit& fit,
                          FreeShapes free) {
  Extended result;
  result.effects = effects;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const Effect& effect = effects[e];
    const Eigen::VectorXd b =
        coefficients.segment(fit.first_column(static_cast<int>(e)), effect.columns());
    for (std::size_t k = 0; k < effect.shape.size(); ++k) {
      const Beside beside = moved_a_little(geometry, effect, k, free);
      const double range = beside.up[k] - beside.down[k];
      if (range == 0.0) continue;
      EffectFamily family;
      family.columns = [](const std::vector<double>&) { return 1; };
      family.evaluate = [effect, b, beside, range](const FlankGeometry& g, const Place& p,
                                                   const std::vector<double>&, double* c) {
        double up[8], down[8];
        Effect moved = effect;
        moved.shape = beside.up;
        moved.evaluate(g, p, up);
        moved.shape = beside.down;
        moved.evaluate(g, p, down);
        c[0] = 0.0;
        for (int i = 0; i < b.size(); ++i) c[0] += b[i] * (up[i] - down[i]) / range;
      };
      result.families.push_back(std::move(family));
      result.slots.push_back(
          {static_cast<int>(e), static_cast<int>(k), static_cast<int>(result.effects.size())});
      result.effects.push_back({&result.families.back(), FlankChoice::kBoth, {}});
    }
  }
  return result;
}

/// Keeps a shape value where it means something.
double limited(const FlankGeometry& g, const Effect& effect, std::size_t k, double value) {
  if (!effect.family->shape_limits) return value;
  const auto [least, most] = effect.family->shape_limits(g, k);
  return std::clamp(value, least, most);
}

/// Tries heights of steps about where they are, twice, the second time finer.
void refine_steps(const FlankGeometry& geometry, std::size_t first, TrialFit& fit) {
  for (std::size_t e = first; e < fit.effects().size(); ++e) {
    if (!is_step(fit.effects()[e])) continue;
    std::vector<Effect> best = fit.effects();
    double reach = 0.065 * geometry.face_width_mm();
    for (int round = 0; round < 2; ++round, reach /= 8.0) {
      const EffectShape middle = best[e].shape;
      std::vector<EffectShape> tried;
      for (int i = -8; i <= 8; ++i) {
        tried.push_back(middle);
        tried.back()[0] = limited(geometry, best[e], 0, middle[0] + reach * i / 8.0);
      }
      double least = 1e300;
      const std::vector<TrialFit::Trial> trials = fit.with_shapes(e, tried, 0.0);
      for (std::size_t i = 0; i < tried.size(); ++i) {
        if (trials[i].square >= least) continue;
        least = trials[i].square;
        best[e].shape = tried[i];
      }
    }
    fit.set_shapes(best);
  }
}

/// One step of Gauss and Newton over all continuous shapes from the first effect on, damped.
std::vector<Effect> stepped(const FlankGeometry& geometry, const TrialFit& fit, std::size_t first,
                            double damping) {
  struct Slot {
    std::size_t effect, value;
  };
  std::vector<Slot> slots;
  for (std::size_t e = first; e < fit.effects().size(); ++e) {
    const Effect& effect = fit.effects()[e];
    if (!effect.family->shape_is_continuous || is_step(effect)) continue;
    for (std::size_t k = 0; k < effect.shape.size(); ++k) slots.push_back({e, k});
  }
  std::vector<TrialFit::Change> derivatives;
  for (const auto& [e, k] : slots) {
    const Effect& effect = fit.effects()[e];
    const double h = kStep * effect.shape[k];
    TrialFit::Change change{effect, effect, fit.coefficients(e) / (2.0 * h)};
    change.from.shape[k] -= h;
    change.to.shape[k] += h;
    derivatives.push_back(std::move(change));
  }
  const Eigen::VectorXd change = fit.joint_coefficients(derivatives);
  std::vector<Effect> effects = fit.effects();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    Effect& effect = effects[slots[i].effect];
    double& value = effect.shape[slots[i].value];
    value = limited(geometry, effect, slots[i].value,
                    value + damping * change[static_cast<Eigen::Index>(i)]);
  }
  return effects;
}

}  // namespace

TrialFit fit_to_refine(const FlankGeometry& geometry, const SharedTable& table,
                       const Patches& patches, const std::vector<Effect>& effects) {
  return {geometry, table, patches, effects, stride_for(table)};
}

bool is_refined_by_all_rows(const Observations& table) { return stride_for(table) == 1; }

bool can_be_refined(const std::vector<Effect>& effects, std::size_t first) {
  bool any = false;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const EffectFamily& family = *effects[e].family;
    any = any || static_cast<bool>(family.nearby) ||
          (e >= first && (family.shape_is_step || family.shape_is_continuous));
  }
  return any;
}

namespace {

enum class Steps { kAsListed, kBetweenToo };

bool refine_to_nearby(const FlankGeometry& geometry, TrialFit& fit, Steps steps) {
  constexpr double kWorthIt = 4.0;  // chi-square
  constexpr int kMostSteps = 8;
  bool moved = false;
  std::vector<Effect> effects = fit.effects();
  for (std::size_t e = 0; e < effects.size(); ++e) {
    if (!effects[e].family->nearby) continue;
    TrialFit::Trial now = fit.as_is(e);
    for (int step = 0; step < kMostSteps; ++step) {
      TrialFit::Trial best{now.square - kWorthIt, 0.0};
      EffectShape shape;
      const std::vector<EffectShape> tried = effects[e].family->nearby(geometry, effects[e].shape);
      const std::vector<TrialFit::Trial> trials = fit.with_shapes(e, tried, best.square);
      for (std::size_t i = 0; i < tried.size(); ++i) {
        if (!(trials[i].square < best.square) ||
            trials[i].retained < std::min(now.retained, kToldApart))
          continue;
        best = trials[i];
        shape = tried[i];
      }
      if (shape.empty()) {
        if (steps == Steps::kAsListed) break;
        shape = lowest_between(effects[e], tried, trials, now.square);
        best = fit.with_shapes(e, {shape}, now.square - kWorthIt).front();
        if (!(best.square < now.square - kWorthIt) ||
            best.retained < std::min(now.retained, kToldApart))
          break;
      }
      effects[e].shape = shape;
      fit.set_shapes(effects);
      now = best;
      moved = true;
    }
  }
  return moved;
}

}  // namespace

bool refine_nearby(const FlankGeometry& geometry, TrialFit& fit) {
  return refine_to_nearby(geometry, fit, Steps::kAsListed);
}

bool refine_between_steps(const FlankGeometry& geometry, TrialFit& fit) {
  return refine_to_nearby(geometry, fit, Steps::kBetweenToo);
}

void refine_shapes(const FlankGeometry& geometry, std::size_t first, TrialFit& fit) {
  bool smooth = false, steps = false;
  for (std::size_t e = first; e < fit.effects().size(); ++e) {
    const Effect& effect = fit.effects()[e];
    steps = steps || is_step(effect);
    smooth = smooth || (effect.family->shape_is_continuous && !is_step(effect));
  }
  if (!smooth && !steps) return;
  refine_steps(geometry, first, fit);
  std::vector<Effect> effects = fit.effects();
  double least = fit.residual_square(), damping = 1.0;
  for (int round = 0; smooth && round < 12; ++round) {
    fit.set_shapes(stepped(geometry, fit, first, damping));
    const double square = fit.residual_square();
    if (square < least) {
      const bool done = least - square < 1e-6 * least;
      least = square;
      effects = fit.effects();
      if (done) return;
      continue;
    }
    damping *= 0.4;
    fit.set_shapes(effects);
    if (damping < 0.05) return;
  }
}

bool refine_nearby(const FlankGeometry& geometry, const SharedTable& table, const Patches& patches,
                   std::vector<Effect>& effects) {
  if (std::none_of(effects.begin(), effects.end(),
                   [](const Effect& effect) { return static_cast<bool>(effect.family->nearby); }))
    return false;
  TrialFit fit = fit_to_refine(geometry, table, patches, effects);
  const bool moved = refine_nearby(geometry, fit);
  effects = fit.effects();
  return moved;
}

void refine_shapes(const FlankGeometry& geometry, const SharedTable& table, const Patches& patches,
                   std::vector<Effect>& effects, std::size_t first) {
  if (std::none_of(effects.begin() + static_cast<std::ptrdiff_t>(first), effects.end(),
                   [](const Effect& effect) {
                     return effect.family->shape_is_step || effect.family->shape_is_continuous;
                   }))
    return;
  TrialFit fit = fit_to_refine(geometry, table, patches, effects);
  refine_shapes(geometry, first, fit);
  effects = fit.effects();
}

ShapeUncertainty shape_uncertainty(const FlankGeometry& geometry, const Observations& table,
                                   const Patches& patches, const PointFit& fit, FreeShapes free) {
  ShapeUncertainty result;
  result.covariance = fit.covariance();
  for (const Effect& effect : fit.effects()) {
    result.errors.emplace_back(effect.shape.size(), kNaN);
    if (is_step(effect)) result.errors.back()[0] = 0.005 * geometry.face_width_mm();
  }
  const Extended extended =
      with_derivatives(geometry, fit.effects(), fit.coefficients(), fit, free);
  if (extended.slots.empty()) return result;
  const PointFit joint(geometry, table, patches, extended.effects);
  const auto p = result.covariance.rows();
  result.covariance = joint.covariance().topLeftCorner(p, p);
  for (const auto& slot : extended.slots) {
    const int column = joint.first_column(slot.column_effect);
    result.errors[slot.effect][slot.value] = std::sqrt(joint.covariance()(column, column));
  }
  return result;
}

double move_alone(const FlankGeometry& geometry, const TrialFit& fit, std::size_t effect,
                  EffectShape& shape) {
  constexpr double kWorthIt = 4.0;  // chi-square
  constexpr int kMostSteps = 8;
  double least = fit.with_shapes(effect, {shape}, 1e300).front().square;
  for (int step = 0; step < kMostSteps; ++step) {
    const std::vector<EffectShape> tried = fit.effects()[effect].family->nearby(geometry, shape);
    const std::vector<TrialFit::Trial> trials = fit.with_shapes(effect, tried, least - kWorthIt);
    double best = least - kWorthIt;
    const EffectShape* moved = nullptr;
    for (std::size_t i = 0; i < tried.size(); ++i)
      if (trials[i].square < best && trials[i].retained >= kToldApart) {
        best = trials[i].square;
        moved = &tried[i];
      }
    if (moved == nullptr) break;
    least = best;
    shape = *moved;
  }
  return least;
}

}  // namespace trueflank::loop
