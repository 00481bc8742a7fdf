// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_optimise.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <nlopt.hpp>
#include <optional>

#include "trueflank/search/search_sweep.h"
#include "trueflank/search/search_values.h"

namespace trueflank {
namespace {

constexpr int kSlsqpSteps = 60;
constexpr int kSimplexSteps = 150;
/// Price of a breach (modules, or shares of a bound) against the merit, for the simplex method.
constexpr double kSimplexPrice = 5.0;
/// Step of the one-sided differences, in modules; profiles are solved to 1e-12.
constexpr double kDifference = 1e-6;
/// Compromises between two objectives: shares of the way from one optimum to the other.
constexpr std::array<double, 3> kCompromises{0.25, 0.5, 0.75};

bool is_efficiency(SearchObjective objective) {
  return objective == SearchObjective::kForward || objective == SearchObjective::kBackward;
}
DriveDirection direction_of(SearchObjective objective) {
  return objective == SearchObjective::kForward ? DriveDirection::kForward
                                                : DriveDirection::kBackward;
}
/// Whether an objective is computed of the laid-out design, and has kinks.
bool of_design(SearchObjective objective) {
  return !is_efficiency(objective) && objective != SearchObjective::kSize;
}

/// What values of an objective are divided by, so that all are of the order of 1.
double scale_of(SearchObjective objective, double value) {
  if (!std::isfinite(value) || value == 0.0) return 1.0;
  const bool small = objective == SearchObjective::kWeighted || is_efficiency(objective);
  return small ? std::max(1.0, std::abs(value)) : std::abs(value);
}

class SetOptimiser {
 public:
  SetOptimiser(const SearchRequirements& requirements, const ToothSet& set,
               const LimitReserve& reserve)
      : values_(requirements, set, reserve) {}

  SetResult run() {
    const SweepResult& found = swept(values_.guide());
    if (found.peaks.empty())
      name_failed_limit(found.nearest.free);
    else
      collect();
    result_.evaluations = values_.evaluations();
    return std::move(result_);
  }

 private:
  using State = SetValues::State;

  void collect();
  /// Starts from which every limit asked for is kept, one of them first; false: there is none.
  bool reach_limits(std::vector<FreeShifts>& from);
  [[nodiscard]] bool keeps(const FreeShifts& free, const std::vector<MeritBound>& bounds);
  /// The best of one objective with its gap.
  struct Best {
    std::optional<FreeShifts> free;
    double gap = kNaN;
  };
  Best best_of(SearchObjective objective, const std::vector<FreeShifts>& from);
  void keep_compromises();
  void keep(const Best& best);
  void name_failed_limit(const FreeShifts& nearest);
  /// Of an objective that is an efficiency, without bounds.
  const SweepResult& swept(DriveDirection direction);
  std::optional<FreeShifts> climb(const std::vector<FreeShifts>& starts, SearchObjective objective,
                                  const std::vector<MeritBound>& bounds);
  void slsqp(FreeShifts start, SearchObjective objective, const std::vector<MeritBound>& bounds);
  void simplex(FreeShifts start, SearchObjective objective, const std::vector<MeritBound>& bounds,
               double step);
  void remember(const FreeShifts& free, const State& s, double merit_value,
                const std::vector<double>& bound_margins);
  void set_box(nlopt::opt& opt) const;

  SetValues values_;
  SetResult result_;
  std::optional<FreeShifts> best_;
  double best_merit_ = 0.0;
  std::array<std::optional<SweepResult>, 2> swept_;
  std::vector<MeritBound> asked_;
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
  const bool two = values_.model().has_layer2();
  opt.set_lower_bounds({set.centre_distance_min, r.shift_min, two ? r.shift_min : 0.0});
  opt.set_upper_bounds({set.centre_distance_max, r.shift_max, two ? r.shift_max : 0.0});
}

const SweepResult& SetOptimiser::swept(DriveDirection direction) {
  auto& result = swept_[direction == DriveDirection::kForward ? 0 : 1];
  if (!result) result = sweep(values_, direction);
  return *result;
}

void SetOptimiser::name_failed_limit(const FreeShifts& nearest) {
  std::vector<double> margins(kLimits);
  values_.margins(values_.state(nearest), margins.data());
  margins.resize(values_.model().limits());
  result_.failed_limit =
      static_cast<int>(std::min_element(margins.begin(), margins.end()) - margins.begin());
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
  const std::size_t limits = values_.model().limits(), count = limits + bounds.size();
  const double at_start = values_.merit(values_.state(start), start, objective);
  const double scale = scale_of(objective, at_start);
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
      point.margin[limits + b] = values_.bound_margin(s, free, bounds[b]);
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
    remember(free, s, here.value * scale,
             {here.margin.begin() + static_cast<std::ptrdiff_t>(limits), here.margin.end()});
    for (std::size_t d = 0; d < 3; ++d) {
      std::array<double, 3> w = at;
      w[d] += kDifference;
      const FreeShifts beside = free_of(w.data());
      State t = s;  // a ring's shift moves its own layer only
      if (d != 2) t.layer1 = values_.layer1(beside.centre_distance, beside.layer1_shift);
      if (d != 1) t.layer2 = values_.layer2(beside.centre_distance, beside.layer2_shift);
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
  std::vector<double> x{start.centre_distance, start.layer1_shift, start.layer2_shift};
  run_quietly(opt, x);
}

void SetOptimiser::simplex(FreeShifts start, SearchObjective objective,
                           const std::vector<MeritBound>& bounds, double step) {
  const double at_start = values_.merit(values_.state(start), start, objective);
  const double scale = scale_of(objective, at_start);
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
  std::vector<double> x{start.centre_distance, start.layer1_shift, start.layer2_shift};
  run_quietly(opt, x);
}

std::optional<FreeShifts> SetOptimiser::climb(const std::vector<FreeShifts>& starts,
                                              SearchObjective objective,
                                              const std::vector<MeritBound>& bounds) {
  best_.reset();
  const bool smooth = bounds.empty() && !of_design(objective);
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
  return best_;
}

bool SetOptimiser::keeps(const FreeShifts& free, const std::vector<MeritBound>& bounds) {
  if (bounds.empty()) return true;
  const State s = values_.state(free);
  return std::all_of(bounds.begin(), bounds.end(), [&](const MeritBound& bound) {
    return values_.bound_margin(s, free, bound) >= 0.0;
  });
}

bool SetOptimiser::reach_limits(std::vector<FreeShifts>& from) {
  const auto limits = asked_limits(values_.requirements());
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const MeritBound next{limits[i].figure, merit_of_figure(limits[i].figure, limits[i].value)};
    std::vector<MeritBound> with = asked_;
    with.push_back(next);
    const auto kept = std::find_if(from.begin(), from.end(),
                                   [&](const FreeShifts& free) { return keeps(free, with); });
    if (kept != from.end()) {
      std::rotate(from.begin(), kept, kept + 1);
    } else {
      const auto farthest = climb(from, next.objective, asked_);
      if (!farthest) return false;
      if (!keeps(*farthest, with)) {
        result_.failed_limit = static_cast<int>(kLimits + i);
        return false;
      }
      from.insert(from.begin(), *farthest);
    }
    asked_ = std::move(with);
  }
  return true;
}

SetOptimiser::Best SetOptimiser::best_of(SearchObjective objective,
                                         const std::vector<FreeShifts>& from) {
  if (is_efficiency(objective)) {
    // mostly what is asked for binds nowhere, and the sweep is the better way
    const SweepResult& found = swept(direction_of(objective));
    if (!found.peaks.empty() && keeps(found.peaks.front().free, asked_)) {
      // a discontinuity of the swept function may have stopped a bracket short: climb on from the
      // peaks
      const SweepPoint& best = found.peaks.front();
      std::vector<FreeShifts> peaks;
      for (const SweepPoint& peak : found.peaks)
        if (peaks.size() < 2) peaks.push_back(peak.free);
      const auto free = climb(peaks, objective, {});
      const double merit = best_merit_;
      const bool better = free && merit > best.merit && keeps(*free, asked_);
      return {better ? *free : best.free, found.gap + (better ? merit - best.merit : 0.0)};
    }
  } else if (!of_design(objective) && !asked_.empty()) {
    if (const auto free = climb(from, objective, {}); free && keeps(*free, asked_)) return {free};
  }
  return {climb(from, objective, asked_)};
}

void SetOptimiser::keep(const Best& best) {
  if (!best.free) return;
  result_.candidates.push_back(
      evaluate_candidate(values_.requirements(), values_.model(), *best.free, values_.reserve()));
  result_.candidates.back().gap = best.gap;
}

void SetOptimiser::keep_compromises() {
  const SearchRequirements& r = values_.requirements();
  const std::vector<SearchCandidate> ends = result_.candidates;
  if (ends.size() < r.objectives.size()) return;
  for (std::size_t other = 1; other < ends.size(); ++other)
    for (const double share : kCompromises) {
      const SearchObjective objective = r.objectives[other];
      const double at_first = ends.front().merit(objective), at_own = ends[other].merit(objective);
      if (!(at_own > at_first)) continue;
      std::vector<MeritBound> bounds = asked_;
      bounds.push_back({objective, at_first + share * (at_own - at_first)});
      keep({climb({ends[other].free, ends.front().free}, r.objectives.front(), bounds)});
    }
}

void SetOptimiser::collect() {
  std::vector<FreeShifts> from;
  for (const SweepPoint& peak : swept(values_.guide()).peaks) from.push_back(peak.free);
  if (!reach_limits(from)) return;
  for (const SearchObjective objective : values_.requirements().objectives) {
    const Best best = best_of(objective, from);
    keep(best);
    if (best.free) from.push_back(*best.free);
  }
  keep_compromises();
}

}  // namespace

double SearchCandidate::merit(SearchObjective objective) const {
  return merit_of_figure(objective, value(objective));
}

double SearchCandidate::value(SearchObjective objective) const {
  switch (objective) {
    case SearchObjective::kForward:
      return forward;
    case SearchObjective::kBackward:
      return backward;
    case SearchObjective::kTorque:
      return torque_nm;
    case SearchObjective::kSize:
      return size_mm;
    case SearchObjective::kWeighted:
      return score;
    default:
      return figure_of(figures, objective);
  }
}

SetResult optimise_set(const SearchRequirements& requirements, const ToothSet& set,
                       const LimitReserve& reserve) {
  return SetOptimiser(requirements, set, reserve).run();
}

SearchCandidate evaluate_candidate(const SearchRequirements& requirements, const SearchModel& model,
                                   const FreeShifts& free, const LimitReserve& reserve) {
  const LayerEvaluation layer1 = model.layer1(free.centre_distance, free.layer1_shift);
  const LayerEvaluation layer2 = model.layer2(free.centre_distance, free.layer2_shift);
  SearchCandidate candidate{.free = free};
  const double forward = model.efficiency(layer1, layer2, DriveDirection::kForward),
               backward = model.efficiency(layer1, layer2, DriveDirection::kBackward);
  const ToldEfficiencies told = told_efficiencies(requirements, model.ratio(), forward, backward);
  candidate.forward = told.forward;
  candidate.backward = told.backward;
  const DesignValues values = design_values(requirements, model, free, forward, backward);
  candidate.dimensions = values.dimensions;
  candidate.torque_nm = values.torque_nm;
  candidate.size_mm = values.size_mm;
  candidate.figures = values.figures;
  if (!requirements.weights.empty())
    candidate.score = weighted_score(requirements, told, values);
  candidate.least_margin = 1e300;
  const std::size_t first2 = model.train().layer1_limits;
  for (std::size_t i = 0; i < model.limits(); ++i) {
    const double margin = i < first2 ? layer1.margins[i] : layer2.margins[i - first2];
    candidate.least_margin =
        std::min(candidate.least_margin,
                 margin - reserve[static_cast<std::size_t>(model.train().limits[i].limit)]);
  }
  return candidate;
}

}  // namespace trueflank
