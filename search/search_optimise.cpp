// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_optimise.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <nlopt.hpp>
#include <optional>

#include "trueflank/search/search_starts.h"
#include "trueflank/search/search_values.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/strength.h"

namespace trueflank {
namespace {

constexpr int kCoarse = 7;  ///< places a variable of the grid for a set of which no start is known
constexpr int kSlsqpSteps = 60;
constexpr int kSimplexSteps = 150;
constexpr int kRestoreSteps = 200;
/// Price of a breach (modules, or shares of a bound) against the merit, for the simplex method.
constexpr double kSimplexPrice = 5.0;
/// Step of the one-sided differences, in modules; profiles are solved to 1e-12.
constexpr double kDifference = 1e-6;
/// Compromises between two objectives: shares of the way from one optimum to the other.
constexpr std::array<double, 3> kCompromises{0.25, 0.5, 0.75};

bool needs_strength(SearchObjective objective) { return objective == SearchObjective::kTorque; }

class SetOptimiser {
 public:
  SetOptimiser(const SearchRequirements& requirements, const ToothSet& set,
               const LimitReserve& reserve)
      : values_(requirements, set, reserve) {}

  SetResult run() {
    const std::vector<FreeShifts> starts = grid_starts(values_);
    if (!starts.empty()) collect(starts);
    if (result_.candidates.empty() && result_.failed_limit < 0)
      if (const auto restored = restore()) collect({*restored});
    result_.evaluations = values_.evaluations();
    return std::move(result_);
  }

 private:
  using State = SetValues::State;

  void collect(const std::vector<FreeShifts>& starts);
  std::optional<FreeShifts> restore();
  std::optional<FreeShifts> climb(const std::vector<FreeShifts>& starts, SearchObjective objective,
                                  const std::vector<MeritBound>& bounds);
  void slsqp(FreeShifts start, SearchObjective objective, const std::vector<MeritBound>& bounds);
  void simplex(FreeShifts start, SearchObjective objective, const std::vector<MeritBound>& bounds,
               double step);
  void remember(const FreeShifts& free, const State& s, double merit_value,
                const std::vector<double>& bound_margins);
  void set_box(nlopt::opt& opt) const;
  [[nodiscard]] SearchObjective guide() const {
    return values_.guide() == DriveDirection::kForward ? SearchObjective::kForward
                                                         : SearchObjective::kBackward;
  }

  SetValues values_;
  SetResult result_;
  std::optional<FreeShifts> best_;
  double best_merit_ = 0.0;
};

FreeShifts free_of(const double* v) { return {v[0], v[1], v[2]}; }

/// NLopt's view of a lambda: value and gradient of one function, or of all constraints.
template <class F>
double call_objective(unsigned, const double* x, double* gradient, void* data) {
  return (*static_cast<F*>(data))(x, gradient);
}
template <class F>
void call_constraints(unsigned, double* values, unsigned, const double* x, double* gradient,
                      void* data) {
  (*static_cast<F*>(data))(values, x, gradient);
}

/// Runs and takes round-off stops and the like as ends: what counts is remembered on the way.
void run_quietly(nlopt::opt& opt, std::vector<double>& x) {
  double value = 0.0;
  try {
    opt.optimize(x, value);
  } catch (const std::bad_alloc&) {  // another answer for want of memory would be a wrong one
    throw;
  } catch (const std::exception&) {  // roundoff_limited, generic failure of a line search
  }
}

void SetOptimiser::set_box(nlopt::opt& opt) const {
  const ToothSet& set = values_.model().set();
  const SearchRequirements& r = values_.requirements();
  opt.set_lower_bounds({set.centre_distance_min, r.shift_min, r.shift_min});
  opt.set_upper_bounds({set.centre_distance_max, r.shift_max, r.shift_max});
}

/// Nothing on the grid keeps all limits: goes to where the breaches are least.
std::optional<FreeShifts> SetOptimiser::restore() {
  const ToothSet& set = values_.model().set();
  FreeShifts best;
  double best_margin = -1e300;
  for (int i = 0; i < kCoarse; ++i) {
    const double a = at_grid(set.centre_distance_min, set.centre_distance_max, i, kCoarse);
    const auto range1 = values_.model().ring1_shift_range(a);
    const auto range2 = values_.model().ring2_shift_range(a);
    double margin1 = -1e300, margin2 = -1e300, x1 = 0.0, x2 = 0.0;
    for (int k = 0; k < kCoarse; ++k) {
      const double at1 = at_grid(range1[0], range1[1], k, kCoarse);
      const double at2 = at_grid(range2[0], range2[1], k, kCoarse);
      const double m1 = values_.layer1(a, at1).least_margin;
      const double m2 = values_.layer2(a, at2).least_margin;
      if (m1 > margin1) margin1 = m1, x1 = at1;
      if (m2 > margin2) margin2 = m2, x2 = at2;
    }
    if (std::min(margin1, margin2) > best_margin)
      best_margin = std::min(margin1, margin2), best = {a, x1, x2};
  }
  double least = best_margin;
  const auto value = [&](const double* v, double*) {
    const State st = values_.state(free_of(v));
    const double now = values_.least_margin(st);
    if (now > least) least = now, best = free_of(v);
    return values_.breach(st);
  };
  auto value_copy = value;
  nlopt::opt opt(nlopt::LN_SBPLX, 3);
  set_box(opt);
  opt.set_min_objective(call_objective<decltype(value_copy)>, &value_copy);
  opt.set_maxeval(kRestoreSteps);
  opt.set_stopval(0.0);
  opt.set_xtol_abs(1e-6);
  opt.set_initial_step(std::vector<double>{0.05, 0.1, 0.1});
  std::vector<double> x{best.centre_distance, best.ring1_shift, best.ring2_shift};
  run_quietly(opt, x);
  if (least >= 0.0) return best;
  std::array<double, kLimits> at_best;
  values_.margins(values_.state(best), at_best.data());
  result_.failed_limit = static_cast<int>(
      std::min_element(at_best.begin(), at_best.end()) - at_best.begin());
  return std::nullopt;
}

void SetOptimiser::remember(const FreeShifts& free, const State& s, double merit_value,
                            const std::vector<double>& bound_margins) {
  if (!(values_.least_margin(s) >= 0.0) || !std::isfinite(merit_value)) return;
  for (const double margin : bound_margins)
    if (!(margin >= 0.0)) return;
  if (best_ && !(merit_value > best_merit_)) return;
  best_ = free;
  best_merit_ = merit_value;
}

void SetOptimiser::slsqp(FreeShifts start, SearchObjective objective,
                         const std::vector<MeritBound>& bounds) {
  const std::size_t count = kLimits + bounds.size();
  const double at_start = values_.merit(values_.state(start), start, objective);
  const double scale = std::isfinite(at_start) ? std::max(1.0, std::abs(at_start)) : 1.0;
  // one point's value and differences serve objective and constraints
  struct Point {
    double value = 0.0;
    std::vector<double> margin;
  };
  const auto point_of = [&](const State& s, const FreeShifts& free) {
    Point point{values_.merit(s, free, objective) / scale, std::vector<double>(count)};
    if (!std::isfinite(point.value)) point.value = -1.0;
    values_.margins(s, point.margin.data());
    for (std::size_t b = 0; b < bounds.size(); ++b)
      point.margin[kLimits + b] = values_.bound_margin(s, free, bounds[b]);
    return point;
  };
  std::array<double, 3> at{kNaN, kNaN, kNaN};
  Point here;
  std::array<Point, 3> moved;
  const auto update = [&](const double* v) {
    if (std::equal(at.begin(), at.end(), v)) return;
    std::copy(v, v + 3, at.begin());
    const FreeShifts free = free_of(v);
    const State s = values_.state(free);
    here = point_of(s, free);
    remember(free, s, here.value * scale, {here.margin.begin() + kLimits, here.margin.end()});
    for (std::size_t d = 0; d < 3; ++d) {
      std::array<double, 3> w = at;
      w[d] += kDifference;
      const FreeShifts beside = free_of(w.data());
      State t = s;  // a ring's shift moves its own layer only
      if (d != 2) t.layer1 = values_.layer1(beside.centre_distance, beside.ring1_shift);
      if (d != 1) t.layer2 = values_.layer2(beside.centre_distance, beside.ring2_shift);
      moved[d] = point_of(t, beside);
    }
  };
  auto value = [&](const double* v, double* gradient) {
    update(v);
    for (std::size_t d = 0; gradient && d < 3; ++d)
      gradient[d] = -(moved[d].value - here.value) / kDifference;
    return -here.value;
  };
  auto constraints = [&](double* values, const double* v, double* gradient) {
    update(v);
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = -here.margin[i];
      for (std::size_t d = 0; gradient && d < 3; ++d)
        gradient[3 * i + d] = -(moved[d].margin[i] - here.margin[i]) / kDifference;
    }
  };
  nlopt::opt opt(nlopt::LD_SLSQP, 3);
  set_box(opt);
  opt.set_min_objective(call_objective<decltype(value)>, &value);
  opt.add_inequality_mconstraint(call_constraints<decltype(constraints)>, &constraints,
                                 std::vector<double>(count, 0.0));
  opt.set_maxeval(kSlsqpSteps);
  opt.set_xtol_abs(1e-7);
  opt.set_ftol_rel(1e-9);
  std::vector<double> x{start.centre_distance, start.ring1_shift, start.ring2_shift};
  run_quietly(opt, x);
}

void SetOptimiser::simplex(FreeShifts start, SearchObjective objective,
                           const std::vector<MeritBound>& bounds, double step) {
  const double at_start = values_.merit(values_.state(start), start, objective);
  const double scale = std::isfinite(at_start) ? std::max(1.0, std::abs(at_start)) : 1.0;
  auto value = [&](const double* v, double*) {
    const FreeShifts free = free_of(v);
    const State s = values_.state(free);
    const double here = values_.merit(s, free, objective);
    double price = kSimplexPrice * values_.breach(s);
    std::vector<double> bound_margins;
    for (const MeritBound& bound : bounds) {
      bound_margins.push_back(values_.bound_margin(s, free, bound));
      price += kSimplexPrice * std::max(0.0, -bound_margins.back());
    }
    remember(free, s, here, bound_margins);
    return (std::isfinite(here) ? -here / scale : 0.0) + price;
  };
  nlopt::opt opt(nlopt::LN_SBPLX, 3);
  set_box(opt);
  opt.set_min_objective(call_objective<decltype(value)>, &value);
  opt.set_maxeval(kSimplexSteps);
  opt.set_xtol_abs(1e-6);
  opt.set_initial_step(step);
  std::vector<double> x{start.centre_distance, start.ring1_shift, start.ring2_shift};
  run_quietly(opt, x);
}

std::optional<FreeShifts> SetOptimiser::climb(const std::vector<FreeShifts>& starts,
                                              SearchObjective objective,
                                              const std::vector<MeritBound>& bounds) {
  best_.reset();
  const bool smooth = bounds.empty() && !needs_strength(objective);
  for (const FreeShifts& start : starts) {
    const State s = values_.state(start);
    std::vector<double> bound_margins;
    for (const MeritBound& bound : bounds)
      bound_margins.push_back(values_.bound_margin(s, start, bound));
    remember(start, s, values_.merit(s, start, objective), bound_margins);
    slsqp(start, objective, bounds);
    if (!smooth) simplex(start, objective, bounds, 0.05);
  }
  // the limiting tooth may have changed on the way
  if (best_ && !smooth) slsqp(FreeShifts(*best_), objective, bounds);
  // the limits have kinks (tip shortening, undercut) at which a line search may stop early
  if (best_) simplex(*best_, objective, bounds, smooth ? 0.005 : 0.01);
  if (best_ && smooth && objective == guide()) {
    const SearchStart finest = zoomed(values_, {*best_, best_merit_, 0.0}, 0.05, 0.1, 0.0);
    remember(finest.free, values_.state(finest.free), finest.merit, {});
  }
  return best_;
}

void SetOptimiser::collect(const std::vector<FreeShifts>& starts) {
  const SearchRequirements& r = values_.requirements();
  std::vector<MeritBound> asked;
  std::vector<FreeShifts> from = starts;
  if (r.output_torque_nm) {
    const auto strongest = climb(starts, SearchObjective::kTorque, {});
    if (!strongest) return;
    if (values_.allowable_torque(*strongest) < *r.output_torque_nm) {
      result_.failed_limit = static_cast<int>(kLimits);
      return;
    }
    asked.push_back({SearchObjective::kTorque, *r.output_torque_nm});
    from.insert(from.begin(), *strongest);
  }
  const auto keep = [&](const std::optional<FreeShifts>& free) {
    if (free) result_.candidates.push_back(evaluate_candidate(r, values_.model(), *free, values_.reserve()));
  };
  for (const SearchObjective objective : r.objectives) {
    std::optional<FreeShifts> free;
    if (!asked.empty() && !needs_strength(objective)) {
      // mostly the torque asked for binds nowhere, and the smooth way is the better one
      free = climb(starts, objective, {});
      if (free && values_.allowable_torque(*free) < *r.output_torque_nm) free.reset();
    }
    if (!free) free = climb(from, objective, needs_strength(objective) ? std::vector<MeritBound>{}
                                                                      : asked);
    keep(free);
    if (free) from.push_back(*free);
  }
  const std::vector<SearchCandidate> ends = result_.candidates;
  for (std::size_t other = 1; other < ends.size(); ++other)
    for (const double share : kCompromises) {
      const SearchObjective objective = r.objectives[other];
      const double at_first = ends.front().merit(objective), at_own = ends[other].merit(objective);
      if (!(at_own > at_first)) continue;
      std::vector<MeritBound> bounds = asked;
      bounds.push_back({objective, at_first + share * (at_own - at_first)});
      keep(climb({ends[other].free, ends.front().free}, r.objectives.front(), bounds));
    }
}

}  // namespace

double SearchCandidate::merit(SearchObjective objective) const {
  switch (objective) {
    case SearchObjective::kForward: return forward;
    case SearchObjective::kBackward: return backward;
    case SearchObjective::kTorque: return torque_nm;
    case SearchObjective::kSize: return -size_mm;
  }
  return kNaN;
}

SetResult optimise_set(const SearchRequirements& requirements, const ToothSet& set,
                       const LimitReserve& reserve) {
  return SetOptimiser(requirements, set, reserve).run();
}

SearchCandidate evaluate_candidate(const SearchRequirements& requirements, const SearchModel& model,
                                   const FreeShifts& free, const LimitReserve& reserve) {
  const Layer1Evaluation layer1 = model.layer1(free.centre_distance, free.ring1_shift);
  const Layer2Evaluation layer2 = model.layer2(free.centre_distance, free.ring2_shift);
  SearchCandidate candidate{.free = free};
  candidate.forward = model.efficiency(layer1.sun_planet, layer1.planet_ring, layer2.planet_ring,
                                       DriveDirection::kForward);
  candidate.backward = model.efficiency(layer1.sun_planet, layer1.planet_ring, layer2.planet_ring,
                                        DriveDirection::kBackward);
  if (requirements.losses) {
    // A mesh's loss is in proportion to its friction; the best shifts are those of the meshes alone.
    const double forward = 1.0 - candidate.forward, backward = 1.0 - candidate.backward;
    const MeshEfficiencies meshes = [&](double mu_forward, double mu_backward) {
      const double friction = std::max(requirements.friction, 1e-9);
      return std::pair(1.0 - forward * mu_forward / friction,
                       candidate.backward > 0.0 ? 1.0 - backward * mu_backward / friction : 0.0);
    };
    const LossyEfficiency lossy = lossy_efficiency(*requirements.losses, requirements.friction,
                                                   std::abs(signed_ratio(model.set())), meshes);
    candidate.forward = lossy.forward;
    candidate.backward = lossy.backward;
  }
  candidate.size_mm = model.outer_diameter(free) * model.module_mm(free);
  candidate.least_margin = 1e300;
  for (std::size_t i = 0; i < kLimits; ++i) {
    const double margin = i < kLayer1Limits ? layer1.margins[i] : layer2.margins[i - kLayer1Limits];
    candidate.least_margin =
        std::min(candidate.least_margin,
                 margin - reserve[static_cast<std::size_t>(limit_entries()[i].limit)]);
  }
  if (auto train = lay_out(model.design(free)))
    if (auto result = strength(*train, requirements.strength))
      candidate.torque_nm = result->output_torque_nm;
  return candidate;
}

}  // namespace trueflank
