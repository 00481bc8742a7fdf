// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/search_optimise.h"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <optional>

#include "trueflank/train/gear_train.h"
#include "trueflank/train/strength.h"

namespace trueflank {
namespace {

constexpr int kGridDistances = 21;  ///< centre distances of the start grid
constexpr int kGridShifts = 21;     ///< ring shifts of it, per layer
constexpr int kCoarse = 7;          ///< the same where nothing on the fine grid keeps all limits
constexpr std::size_t kPeaks = 4;   ///< best peaks over the distance that are looked at closer
constexpr std::size_t kStarts = 2;  ///< of them that the optimiser starts from
constexpr int kZoomLevels = 4;
constexpr int kZoomDistances = 5;
constexpr int kZoomShifts = 9;
constexpr double kZoomFactor = 0.4;
/// What a start may lack of a limit, in modules, and what that costs it in efficiency.
constexpr double kBreachTolerance = 0.05;
constexpr double kBreachPrice = 3.0;
constexpr int kSlsqpSteps = 60;
constexpr int kSimplexSteps = 150;
constexpr int kRestoreSteps = 200;
/// A margin beyond this is as good or bad as can be: far values would spoil an optimiser's models.
constexpr double kFarMargin = 2.0;
/// Price of a breach (modules, or shares of a bound) against the merit, for the simplex method.
constexpr double kSimplexPrice = 5.0;
/// Step of the one-sided differences, in modules; profiles are solved to 1e-12.
constexpr double kDifference = 1e-6;
/// Limits are approached to this (modules), so that rounding leaves a design on the good side.
constexpr double kLimitReserve = 1e-7;
/// And corners in roots to this, more than sampling hides. Not more: near its fillet a tip keeps a
/// nearly constant distance over a wide range of shifts, and 1e-3 would cost half a percent.
constexpr double kCornerReserve = 5e-6;
/// Compromises between two objectives: shares of the way from one optimum to the other.
constexpr std::array<double, 3> kCompromises{0.25, 0.5, 0.75};

/// A lower bound on another objective's merit, for compromises and a torque that is asked for.
struct MeritBound {
  SearchObjective objective;
  double merit = 0.0;
};

bool needs_strength(SearchObjective objective) { return objective == SearchObjective::kTorque; }

double at_grid(double low, double high, int i, int count) {
  // cell middles and a hair inside of the ends: optima often lie at a bound
  if (i == 0) return low + 1e-6 * (high - low);
  if (i == count - 1) return high - 1e-6 * (high - low);
  return low + (high - low) * i / (count - 1);
}

class SetOptimiser {
 public:
  SetOptimiser(const SearchRequirements& requirements, const ToothSet& set,
               const LimitReserve& reserve)
      : r_(requirements), model_(requirements, set), reserve_(reserve) {
    for (std::size_t i = 0; i < kLimits; ++i) {
      const Limit limit = limit_entries()[i].limit;
      const bool corner = limit == Limit::kFillet || limit == Limit::kTrochoid;
      offset_[i] = reserve_[static_cast<std::size_t>(limit)] +
                   (corner ? kCornerReserve : 0.0) + kLimitReserve;
      grid_margin_ = std::max(grid_margin_, offset_[i]);
    }
    if (requirements.objectives.front() == SearchObjective::kBackward)
      guide_ = DriveDirection::kBackward;
  }

  SetResult run() {
    const std::vector<FreeShifts> starts = grid_starts();
    if (!starts.empty()) collect(starts);
    if (result_.candidates.empty() && result_.failed_limit < 0)
      if (const auto restored = restore()) collect({*restored});
    result_.evaluations = evaluations_;
    return std::move(result_);
  }

 private:
  struct State {
    Layer1Evaluation layer1;
    Layer2Evaluation layer2;
  };

  State state(const FreeShifts& free) {
    evaluations_ += 2;
    return {model_.layer1(free.centre_distance, free.ring1_shift),
            model_.layer2(free.centre_distance, free.ring2_shift)};
  }

  void margins(const State& s, double* out) const {
    for (std::size_t i = 0; i < kLimits; ++i) {
      const double margin =
          i < kLayer1Limits ? s.layer1.margins[i] : s.layer2.margins[i - kLayer1Limits];
      out[i] = margin == margin ? std::clamp(margin - offset_[i], -kFarMargin, kFarMargin)
                                : -kFarMargin;
    }
  }

  /// Sum of all breaches; 0 where every limit is kept.
  double breach(const State& s) const {
    std::array<double, kLimits> m;
    margins(s, m.data());
    double sum = 0.0;
    for (const double margin : m) sum += std::max(0.0, -margin);
    return sum;
  }

  double least_margin(const State& s) const {
    std::array<double, kLimits> m;
    margins(s, m.data());
    // what the offset keeps back is no breach of the limit
    return *std::min_element(m.begin(), m.end()) + kLimitReserve;
  }

  double allowable_torque(const FreeShifts& free) {
    auto train = lay_out(model_.design(free));
    if (!train) return 0.0;
    auto result = strength(*train, r_.strength);
    return result && std::isfinite(result->output_torque_nm) ? result->output_torque_nm : 0.0;
  }

  double merit(const State& s, const FreeShifts& free, SearchObjective objective) {
    switch (objective) {
      case SearchObjective::kForward:
        return model_.efficiency(s.layer1.sun_planet, s.layer1.planet_ring, s.layer2.planet_ring,
                                 DriveDirection::kForward);
      case SearchObjective::kBackward:
        return model_.efficiency(s.layer1.sun_planet, s.layer1.planet_ring, s.layer2.planet_ring,
                                 DriveDirection::kBackward);
      case SearchObjective::kTorque: return allowable_torque(free);
      case SearchObjective::kSize: return -model_.outer_diameter(free) * model_.module_mm(free);
    }
    return kNaN;
  }

  struct Start {
    FreeShifts free;
    double merit = 0.0;
    double margin = 0.0;
  };
  using Range = std::array<double, 2>;

  std::vector<FreeShifts> grid_starts();
  std::optional<Start> best_at(double a, const Range& range1, const Range& range2, int count,
                               double tolerance);
  Start zoomed(Start start, double distance_step, double shift_step, double tolerance);
  void add_peaks(double tolerance, std::vector<FreeShifts>& starts);
  void collect(const std::vector<FreeShifts>& starts);
  std::optional<FreeShifts> restore();
  std::optional<FreeShifts> climb(const std::vector<FreeShifts>& starts, SearchObjective objective,
                                  const std::vector<MeritBound>& bounds);
  void slsqp(FreeShifts start, SearchObjective objective, const std::vector<MeritBound>& bounds);
  double bound_margin(const State& s, const FreeShifts& free, const MeritBound& bound);
  void simplex(FreeShifts start, SearchObjective objective, const std::vector<MeritBound>& bounds,
               double step);
  void remember(const FreeShifts& free, const State& s, double merit_value,
                const std::vector<double>& bound_margins);
  void set_box(nlopt::opt& opt) const;
  [[nodiscard]] SearchObjective guide() const {
    return guide_ == DriveDirection::kForward ? SearchObjective::kForward
                                              : SearchObjective::kBackward;
  }

  const SearchRequirements& r_;
  SearchModel model_;
  LimitReserve reserve_;
  std::array<double, kLimits> offset_{};
  double grid_margin_ = 0.0;  ///< enough for every limit
  DriveDirection guide_ = DriveDirection::kForward;
  SetResult result_;
  int evaluations_ = 0;
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
  } catch (const std::exception&) {  // roundoff_limited, generic failure of a line search
  }
}

/// Best ring shifts at one centre distance, on grids over two ranges. At a fixed distance the layers
/// are independent, and any gain of a mesh is one of the train. Points a little beyond a limit count
/// too, at a price: the feasible region has islands smaller than a cell.
std::optional<SetOptimiser::Start> SetOptimiser::best_at(double a, const Range& range1,
                                                         const Range& range2, int count,
                                                         double tolerance) {
  const double least = grid_margin_ - tolerance;
  const auto price = [&](double margin) {
    return margin < grid_margin_ ? kBreachPrice * (grid_margin_ - margin) : 0.0;
  };
  const auto worth2 = [&](const Layer2Evaluation& e) { return e.planet_ring.driving1; };
  std::optional<Start> layer2_best;
  MeshLoss layer2;
  for (int k = 0; k < count; ++k) {
    const double x = at_grid(range2[0], range2[1], k, count);
    const auto better = [&](const Layer2Evaluation& e) {
      return !layer2_best || worth2(e) > layer2_best->merit;
    };
    const Layer2Evaluation e = model_.layer2(a, x, least, better);
    ++evaluations_;
    if (!(e.least_margin >= least)) continue;
    const double score = worth2(e) - 0.1 * price(e.least_margin);
    if (layer2_best && !(score > layer2_best->merit)) continue;
    layer2_best = Start{{a, 0.0, x}, score, e.least_margin};
    layer2 = e.planet_ring;
  }
  if (!layer2_best) return std::nullopt;
  std::optional<Start> best;
  for (int k = 0; k < count; ++k) {
    const double x = at_grid(range1[0], range1[1], k, count);
    const auto merit = [&](const Layer1Evaluation& e) {
      return model_.efficiency(e.sun_planet, e.planet_ring, layer2, guide_);
    };
    const auto better = [&](const Layer1Evaluation& e) { return !best || merit(e) > best->merit; };
    const Layer1Evaluation e = model_.layer1(a, x, least, better);
    ++evaluations_;
    if (!(e.least_margin >= least)) continue;
    const double margin = std::min(e.least_margin, layer2_best->margin);
    const double score = merit(e) - price(margin);
    if (!best || score > best->merit)
      best = Start{{a, x, layer2_best->free.ring2_shift}, score, margin};
  }
  return best;
}

/// Finer and finer grids around a start: the feasible region has many corners, and an optimum is
/// mostly one of them.
SetOptimiser::Start SetOptimiser::zoomed(Start start, double distance_step, double shift_step,
                                         double tolerance) {
  const ToothSet& set = model_.set();
  for (int level = 0; level < kZoomLevels; ++level) {
    const Start centre = start;
    for (int i = 0; i < kZoomDistances; ++i) {
      const double a = std::clamp(
          at_grid(centre.free.centre_distance - distance_step,
                  centre.free.centre_distance + distance_step, i, kZoomDistances),
          set.centre_distance_min, set.centre_distance_max);
      // ring1's shift goes up with the distance about as planet1's mesh asks: follow its range
      const auto range1 = model_.ring1_shift_range(a), range2 = model_.ring2_shift_range(a);
      const auto around = [&](double x, const Range& range) {
        return Range{std::max(range[0], x - shift_step), std::min(range[1], x + shift_step)};
      };
      const auto best = best_at(a, around(centre.free.ring1_shift, range1),
                                around(centre.free.ring2_shift, range2), kZoomShifts,
                                tolerance);
      if (best && best->merit > start.merit) start = *best;
    }
    distance_step *= kZoomFactor;
    shift_step *= kZoomFactor;
  }
  return start;
}

void SetOptimiser::add_peaks(double tolerance, std::vector<FreeShifts>& starts) {
  std::vector<std::optional<Start>> line;
  const ToothSet& set = model_.set();
  for (int i = 0; i < kGridDistances; ++i) {
    const double a = at_grid(set.centre_distance_min, set.centre_distance_max, i, kGridDistances);
    line.push_back(best_at(a, model_.ring1_shift_range(a), model_.ring2_shift_range(a), kGridShifts,
                           tolerance));
  }
  const auto merit_at = [&](std::size_t i) {
    return i < line.size() && line[i] ? line[i]->merit : -1e9;
  };
  std::vector<Start> peaks;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] && merit_at(i) >= merit_at(i - 1) && merit_at(i) > merit_at(i + 1))
      peaks.push_back(*line[i]);
  const auto better = [](const Start& p, const Start& q) { return p.merit > q.merit; };
  std::stable_sort(peaks.begin(), peaks.end(), better);
  if (peaks.size() > kPeaks) peaks.resize(kPeaks);
  const double distance_step =
      (set.centre_distance_max - set.centre_distance_min) / (kGridDistances - 1);
  for (Start& peak : peaks)
    peak = zoomed(peak, distance_step, (r_.shift_max - r_.shift_min) / (kGridShifts - 1), tolerance);
  std::stable_sort(peaks.begin(), peaks.end(), better);
  if (peaks.size() > kStarts) peaks.resize(kStarts);
  for (const Start& peak : peaks) starts.push_back(peak.free);
}

std::vector<FreeShifts> SetOptimiser::grid_starts() {
  std::vector<FreeShifts> starts;
  add_peaks(0.0, starts);
  add_peaks(kBreachTolerance, starts);
  return starts;
}

void SetOptimiser::set_box(nlopt::opt& opt) const {
  const ToothSet& set = model_.set();
  opt.set_lower_bounds({set.centre_distance_min, r_.shift_min, r_.shift_min});
  opt.set_upper_bounds({set.centre_distance_max, r_.shift_max, r_.shift_max});
}

/// Nothing on the grid keeps all limits: goes to where the breaches are least.
std::optional<FreeShifts> SetOptimiser::restore() {
  const ToothSet& set = model_.set();
  FreeShifts best;
  double best_margin = -1e300;
  for (int i = 0; i < kCoarse; ++i) {
    const double a = at_grid(set.centre_distance_min, set.centre_distance_max, i, kCoarse);
    const auto range1 = model_.ring1_shift_range(a), range2 = model_.ring2_shift_range(a);
    double margin1 = -1e300, margin2 = -1e300, x1 = 0.0, x2 = 0.0;
    for (int k = 0; k < kCoarse; ++k) {
      const double at1 = at_grid(range1[0], range1[1], k, kCoarse);
      const double at2 = at_grid(range2[0], range2[1], k, kCoarse);
      const double m1 = model_.layer1(a, at1).least_margin, m2 = model_.layer2(a, at2).least_margin;
      evaluations_ += 2;
      if (m1 > margin1) margin1 = m1, x1 = at1;
      if (m2 > margin2) margin2 = m2, x2 = at2;
    }
    if (std::min(margin1, margin2) > best_margin)
      best_margin = std::min(margin1, margin2), best = {a, x1, x2};
  }
  double least = best_margin;
  const auto value = [&](const double* v, double*) {
    const State st = state(free_of(v));
    const double now = least_margin(st);
    if (now > least) least = now, best = free_of(v);
    return breach(st);
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
  margins(state(best), at_best.data());
  result_.failed_limit = static_cast<int>(
      std::min_element(at_best.begin(), at_best.end()) - at_best.begin());
  return std::nullopt;
}

void SetOptimiser::remember(const FreeShifts& free, const State& s, double merit_value,
                            const std::vector<double>& bound_margins) {
  if (!(least_margin(s) >= 0.0) || !std::isfinite(merit_value)) return;
  for (const double margin : bound_margins)
    if (!(margin >= 0.0)) return;
  if (best_ && !(merit_value > best_merit_)) return;
  best_ = free;
  best_merit_ = merit_value;
}

void SetOptimiser::slsqp(FreeShifts start, SearchObjective objective,
                         const std::vector<MeritBound>& bounds) {
  const std::size_t count = kLimits + bounds.size();
  const double at_start = merit(state(start), start, objective);
  const double scale = std::isfinite(at_start) ? std::max(1.0, std::abs(at_start)) : 1.0;
  // one point's value and differences serve objective and constraints
  struct Point {
    double value = 0.0;
    std::vector<double> margin;
  };
  const auto point_of = [&](const State& s, const FreeShifts& free) {
    Point point{merit(s, free, objective) / scale, std::vector<double>(count)};
    if (!std::isfinite(point.value)) point.value = -1.0;
    margins(s, point.margin.data());
    for (std::size_t b = 0; b < bounds.size(); ++b)
      point.margin[kLimits + b] = bound_margin(s, free, bounds[b]);
    return point;
  };
  std::array<double, 3> at{kNaN, kNaN, kNaN};
  Point here;
  std::array<Point, 3> moved;
  const auto update = [&](const double* v) {
    if (std::equal(at.begin(), at.end(), v)) return;
    std::copy(v, v + 3, at.begin());
    const FreeShifts free = free_of(v);
    const State s = state(free);
    here = point_of(s, free);
    remember(free, s, here.value * scale, {here.margin.begin() + kLimits, here.margin.end()});
    for (std::size_t d = 0; d < 3; ++d) {
      std::array<double, 3> w = at;
      w[d] += kDifference;
      const FreeShifts beside = free_of(w.data());
      State t = s;  // a ring's shift moves its own layer only
      if (d != 2) t.layer1 = model_.layer1(beside.centre_distance, beside.ring1_shift), ++evaluations_;
      if (d != 1) t.layer2 = model_.layer2(beside.centre_distance, beside.ring2_shift), ++evaluations_;
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

double SetOptimiser::bound_margin(const State& s, const FreeShifts& free, const MeritBound& bound) {
  // relative, so that newton metres and efficiencies weigh alike
  const double margin = (merit(s, free, bound.objective) - bound.merit) /
                        std::max(1e-9, std::abs(bound.merit));
  return std::isfinite(margin) ? std::clamp(margin, -kFarMargin, kFarMargin) : -kFarMargin;
}

void SetOptimiser::simplex(FreeShifts start, SearchObjective objective,
                           const std::vector<MeritBound>& bounds, double step) {
  const double at_start = merit(state(start), start, objective);
  const double scale = std::isfinite(at_start) ? std::max(1.0, std::abs(at_start)) : 1.0;
  auto value = [&](const double* v, double*) {
    const FreeShifts free = free_of(v);
    const State s = state(free);
    const double here = merit(s, free, objective);
    double price = kSimplexPrice * breach(s);
    std::vector<double> bound_margins;
    for (const MeritBound& bound : bounds) {
      bound_margins.push_back(bound_margin(s, free, bound));
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
    const State s = state(start);
    std::vector<double> bound_margins;
    for (const MeritBound& bound : bounds) bound_margins.push_back(bound_margin(s, start, bound));
    remember(start, s, merit(s, start, objective), bound_margins);
    slsqp(start, objective, bounds);
    if (!smooth) simplex(start, objective, bounds, 0.05);
  }
  // the limiting tooth may have changed on the way
  if (best_ && !smooth) slsqp(FreeShifts(*best_), objective, bounds);
  // the limits have kinks (tip shortening, undercut) at which a line search may stop early
  if (best_) simplex(*best_, objective, bounds, smooth ? 0.005 : 0.01);
  if (best_ && smooth && objective == guide()) {
    const Start finest = zoomed({*best_, best_merit_, 0.0}, 0.05, 0.1, 0.0);
    remember(finest.free, state(finest.free), finest.merit, {});
  }
  return best_;
}

void SetOptimiser::collect(const std::vector<FreeShifts>& starts) {
  std::vector<MeritBound> asked;
  std::vector<FreeShifts> from = starts;
  if (r_.output_torque_nm) {
    const auto strongest = climb(starts, SearchObjective::kTorque, {});
    if (!strongest) return;
    if (allowable_torque(*strongest) < *r_.output_torque_nm) {
      result_.failed_limit = static_cast<int>(kLimits);
      return;
    }
    asked.push_back({SearchObjective::kTorque, *r_.output_torque_nm});
    from.insert(from.begin(), *strongest);
  }
  const auto keep = [&](const std::optional<FreeShifts>& free) {
    if (free) result_.candidates.push_back(evaluate_candidate(r_, model_, *free, reserve_));
  };
  for (const SearchObjective objective : r_.objectives) {
    std::optional<FreeShifts> free;
    if (!asked.empty() && !needs_strength(objective)) {
      // mostly the torque asked for binds nowhere, and the smooth way is the better one
      free = climb(starts, objective, {});
      if (free && allowable_torque(*free) < *r_.output_torque_nm) free.reset();
    }
    if (!free) free = climb(from, objective, needs_strength(objective) ? std::vector<MeritBound>{}
                                                                      : asked);
    keep(free);
    if (free) from.push_back(*free);
  }
  const std::vector<SearchCandidate> ends = result_.candidates;
  for (std::size_t other = 1; other < ends.size(); ++other)
    for (const double share : kCompromises) {
      const SearchObjective objective = r_.objectives[other];
      const double at_first = ends.front().merit(objective), at_own = ends[other].merit(objective);
      if (!(at_own > at_first)) continue;
      std::vector<MeritBound> bounds = asked;
      bounds.push_back({objective, at_first + share * (at_own - at_first)});
      keep(climb({ends[other].free, ends.front().free}, r_.objectives.front(), bounds));
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
