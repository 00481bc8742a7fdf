// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_sweep.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "trueflank/search/search_parts.h"

namespace trueflank {
namespace {

constexpr int kDistances = 33;  ///< centre distances of the first sweep
constexpr int kShifts = 21;     ///< shifts of a layer at each
constexpr std::size_t kPeaks = 4;
constexpr int kFirstSteps = 8;    ///< golden sections of the centre distance around each peak
constexpr int kCheckedSteps = 4;  ///< the last of them, of which the gap is reported
constexpr int kChecks = 6;        ///< centre distances looked at again around the best
constexpr int kCheckShifts = 29;  ///< with these shifts of each layer
constexpr int kLastSteps = 18;    ///< and then around the best
constexpr int kShiftSteps = 20;
/// No margin changes faster than this with a shift or the centre distance, in modules a module, but
/// where it is far from its limit anyway.
constexpr double kSteepest = 6.0;
constexpr double kGolden = 0.6180339887498949;
/// Ends of ranges are taken this share inside, so that rounding leaves them there.
constexpr double kInside = 1e-9;

/// A layer at one shift. What is not whole lacks what only profiles tell: its margin and its merit
/// are no less than the true ones.
struct Place {
  double shift = kNaN, margin = -1e9, merit = kNaN;
  bool whole = false;
  LayerEvaluation evaluation;
  [[nodiscard]] bool feasible() const { return whole && margin >= 0.0; }
};

/// Feasible before infeasible; then the better merit, the smaller breach.
bool better(bool feasible1, double merit1, double margin1, bool feasible2, double merit2,
            double margin2) {
  if (feasible1 != feasible2) return feasible1;
  return feasible1 ? merit1 > merit2 : margin1 > margin2;
}
bool better(const Place& p, const Place& q) {
  return better(p.feasible(), p.merit, p.margin, q.feasible(), q.merit, q.margin);
}
bool better(const SweepPoint& p, const SweepPoint& q) {
  return better(p.feasible(), p.merit, p.margin, q.feasible(), q.merit, q.margin);
}

/// One layer at one centre distance: the best shift of a range. Merits are known before profiles
/// are; profiles are made from the best merit downwards, and where an end of a feasible interval
/// may lie.
class LayerProblem {
 public:
  using Merit = std::function<double(const LayerEvaluation&)>;
  LayerProblem(SetValues& values, int layer, double distance, Merit merit)
      : values_(values), layer_(layer), distance_(distance), merit_(std::move(merit)) {}

  /// Lays out the grid, and looks at it as far as the best of it needs.
  void look_at_grid(int count) {
    const auto [low, high] = values_.model().shift_range(layer_, distance_);
    middle_ = 0.5 * (low + high);
    if (!(high >= low)) return;
    const double inside = kInside * (high - low);
    step_ = (high - low) / (count - 1);
    for (int i = 0; i < count; ++i)
      line_.push_back(look(low + inside + (high - low - 2.0 * inside) * i / (count - 1), false));
    outlines_ = line_;
    whole_.resize(line_.size());
    best_of_grid();
  }
  /// Begins again with another merit; nothing of the grid is computed twice.
  void begin_again(Merit merit) {
    merit_ = std::move(merit);
    best_.reset();
    line_ = outlines_;
    for (Place& place : line_) place.merit = merit_(place.evaluation);
    best_of_grid();
  }
  [[nodiscard]] bool is_feasible() const { return best_ && best_->feasible(); }
  /// Requires: it is feasible.
  [[nodiscard]] const Place& best_so_far() const { return *best_; }

  /// The best place; without a feasible one the place of the least breach. Ends at any place that
  /// keeps more than `enough`.
  Place best(double enough = 1e300) {
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
      if (best_ && best_->margin > enough) break;
      cell(i, step_);
    }
    return line_.empty() ? Place{.shift = middle_} : best_.value_or(Place{});
  }

 private:
  /// Without profiles an undercut's losses are taken as the least they can be.
  Place look(double shift, bool whole) {
    Place place{.shift = shift, .whole = whole};
    place.evaluation = !whole        ? values_.outline(layer_, distance_, shift, -kFarBreach)
                       : layer_ == 0 ? values_.layer1(distance_, shift, -kFarBreach)
                                     : values_.layer2(distance_, shift, -kFarBreach);
    place.margin = values_.layer_margin(layer_, place.evaluation, !whole);
    place.merit = merit_(place.evaluation);
    if (whole) keep(place);
    return place;
  }
  void keep(const Place& place) {
    if (!best_ || better(place, *best_)) best_ = place;
  }
  /// A place of the grid with its profiles.
  void complete(std::size_t i) {
    if (line_[i].whole) return;
    auto& known = whole_[i];
    if (!known) {
      known = line_[i] = look(line_[i].shift, true);
      return;
    }
    line_[i] = *known;
    line_[i].merit = merit_(known->evaluation);
    keep(line_[i]);
  }

  /// From the best merit downwards until no other can be better than the best feasible one.
  void best_of_grid() {
    std::vector<std::size_t> order(line_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return line_[i].merit > line_[j].merit; });
    for (const std::size_t i : order) {
      if (is_feasible() && !(line_[i].merit > best_->merit)) return;
      if (line_[i].margin >= 0.0) complete(i);
    }
  }

  /// What lies between two neighbours of the grid.
  void cell(std::size_t i, double step) {
    Place &p = line_[i], &q = line_[i + 1];
    if (std::max(p.margin, q.margin) < -kSteepest * step) return;
    const double most = std::max(p.merit, q.merit) + 0.25 * std::abs(p.merit - q.merit);
    const bool had = is_feasible();
    if (had && most < best_->merit) return;
    if (p.margin >= 0.0) complete(i);
    if (q.margin >= 0.0) complete(i + 1);
    if (p.feasible() != q.feasible()) return p.feasible() ? border(p, q) : border(q, p);
    if (p.feasible()) {
      if (had && std::max(p.merit, q.merit) < best_->merit) return;
      return inner_peak(p.shift, q.shift);
    }
    // the same limit at both ends: an interval between them lies at a peak of the margin, or where
    // a limit ends suddenly: a corner that no longer reaches a fillet
    const double most_margin = std::max(p.margin, q.margin);
    PlaceInParts left = in_parts(p), right = in_parts(q);
    if (may_be_close(left, right, -kClose)) return split(left, right, kSplits, kHalvings);
    if (std::min(p.margin, q.margin) < -2.0 * kSteepest * step) return;
    for (const std::size_t beside : {i - 1, i + 2})
      if (beside < line_.size() && line_[beside].margin > most_margin) return;
    narrow(p, q);
  }

  [[nodiscard]] PlaceInParts in_parts(const Place& place) {
    return {values_, layer_, place.shift, place.evaluation, place.margin, corners_};
  }

  /// Looks between two infeasible places by halving. Where no limit is broken at both ends there is
  /// but one half to go on with: however narrow the interval is, it is found. Else both halves are
  /// looked at, `depth` times.
  void split(PlaceInParts& p, PlaceInParts& q, int depth, int halvings) {
    if (depth == 0 || halvings == 0) return;
    PlaceInParts middle(values_, layer_, distance_, 0.5 * (p.shift() + q.shift()), -kFarBreach,
                        corners_);
    if (middle.is_feasible(p, std::min(0.0, infeasible_best()))) {
      const Place found = look(middle.shift(), true);
      border(found, {.shift = p.shift(), .margin = p.margin()});
      border(found, {.shift = q.shift(), .margin = q.margin()});
      return inner_peak(p.shift(), q.shift());
    }
    keep_infeasible(middle);
    const bool apart_p = !break_the_same(p, middle), apart_q = !break_the_same(q, middle);
    if (apart_p != apart_q) {
      if (apart_p) return split(p, middle, depth, halvings - 1);
      return split(middle, q, depth, halvings - 1);
    }
    if (depth == 1) return;
    if (may_be_close(p, middle, -kClose)) split(p, middle, depth - 1, halvings - 1);
    if (may_be_close(middle, q, -kClose)) split(middle, q, depth - 1, halvings - 1);
  }

  /// What an infeasible place must keep more than to be the best so far.
  [[nodiscard]] double infeasible_best() const {
    return !best_ ? kLeastOfAll_mm : is_feasible() ? 0.0 : best_->margin;
  }
  void keep_infeasible(PlaceInParts& place) {
    if (is_feasible()) return;
    if (const auto margin = place.margin_above(infeasible_best()))
      best_ = {.shift = place.shift(),
               .margin = *margin,
               .whole = true,
               .evaluation = place.evaluation()};
  }

  /// The best inside of an interval, where it is better than its ends. Looks without profiles
  /// first: mostly the merit is best at an end, and what a layer is worth without them is no less
  /// than with.
  void inner_peak(double low, double high) {
    if (is_feasible() && !(most_between(low, high) > best_->merit)) return;
    golden(
        low, high, [](const Place& p, const Place& q) { return better(p, q); },
        [&](double shift) { return look(shift, true); }, false);
  }
  /// The best merit found between two places, without profiles.
  double most_between(double low, double high) {
    double most = 0.0;
    golden(
        low, high, [](const Place& p, const Place& q) { return p.merit > q.merit; },
        [&](double shift) {
          const Place place = look(shift, false);
          most = std::max(most, place.merit);
          return place;
        },
        false);
    return most;
  }

  /// Closes in on the end of a feasible interval.
  void border(Place in, Place out) {
    for (int k = 0; k < 40 && std::abs(in.shift - out.shift) > 1e-11; ++k) {
      double share = 0.5;
      if (k % 3 != 2 && out.margin > -1.0)
        share = std::clamp(in.margin / (in.margin - out.margin), 0.02, 0.98);
      const Place middle = look(in.shift + share * (out.shift - in.shift), true);
      if (middle.feasible() && middle.margin < 1e-11) return;
      (middle.feasible() ? in : out) = middle;
    }
  }

  /// Looks for a feasible interval narrower than the grid, then for its ends.
  void narrow(const Place& left, const Place& right) {
    const auto found = golden(
        left.shift, right.shift, [](const Place& p, const Place& q) { return p.margin > q.margin; },
        [&](double shift) { return look(shift, true); }, true);
    if (!found) return;
    border(*found, left);
    border(*found, right);
    inner_peak(left.shift, right.shift);
  }

  template <class Better, class Look>
  std::optional<Place> golden(double low, double high, const Better& is_better, const Look& look_at,
                              bool until_feasible) {
    Place p = look_at(high - kGolden * (high - low)), q = look_at(low + kGolden * (high - low));
    for (int k = 0; k < kShiftSteps; ++k) {
      if (until_feasible && (p.feasible() || q.feasible())) return p.feasible() ? p : q;
      // nothing can be hidden here that is feasible
      if (until_feasible && std::max(p.margin, q.margin) < -kSteepest * (high - low))
        return std::nullopt;
      if (is_better(p, q)) {
        high = q.shift, q = p;
        p = look_at(high - kGolden * (high - low));
      } else {
        low = p.shift, p = q;
        q = look_at(low + kGolden * (high - low));
      }
    }
    return std::nullopt;
  }

  static constexpr int kHalvings = 34;
  static constexpr int kSplits = 4;  ///< halvings of a cell of which both ends are close to a limit
  static constexpr double kClose = 0.01;     ///< in modules
  static constexpr double kFarBreach = 0.5;  ///< farther beyond a limit nothing is computed

  SetValues& values_;
  int layer_;
  double distance_;
  Merit merit_;
  double middle_ = kNaN, step_ = 0.0;
  std::vector<Place> line_;      ///< the grid, as far as it is known
  std::vector<Place> outlines_;  ///< without profiles
  std::vector<std::optional<Place>> whole_;
  std::optional<Place> best_;
  CornerPlaces corners_{};
};

class Sweep {
 public:
  Sweep(SetValues& values, DriveDirection direction) : values_(values), direction_(direction) {
    ideal_.sun_planet = ideal_.planet_ring = {1.0, 1.0};
  }

  SweepResult run() {
    const ToothSet& set = values_.model().set();
    const double low = set.centre_distance_min, high = set.centre_distance_max;
    const double inside = kInside * (high - low), step = (high - low) / (kDistances - 1);
    std::vector<SweepPoint> line;
    for (int i = 0; i < kDistances; ++i)
      line.push_back(
          at(low + inside + (high - low - 2.0 * inside) * i / (kDistances - 1), kShifts));
    std::vector<std::size_t> peaks;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const bool first = i == 0, last = i + 1 == line.size();
      const bool peak =
          (first || !better(line[i - 1], line[i])) && (last || better(line[i], line[i + 1]));
      if (peak && line[i].margin > -kSteepest * step) peaks.push_back(i);
    }
    std::stable_sort(peaks.begin(), peaks.end(),
                     [&](std::size_t p, std::size_t q) { return better(line[p], line[q]); });
    if (peaks.size() > kPeaks) peaks.resize(kPeaks);
    SweepResult result;
    result.nearest =
        *std::max_element(line.begin(), line.end(),
                          [](const SweepPoint& p, const SweepPoint& q) { return better(q, p); });
    std::vector<Bracket> brackets;
    for (const std::size_t i : peaks) {
      brackets.push_back({line[i > 0 ? i - 1 : 0].free.centre_distance,
                          line[std::min(i + 1, line.size() - 1)].free.centre_distance, line[i]});
      golden(brackets.back(), kFirstSteps);
    }
    std::stable_sort(brackets.begin(), brackets.end(),
                     [](const Bracket& p, const Bracket& q) { return better(p.best, q.best); });
    if (!brackets.empty()) result.gap = finish(brackets.front(), step);
    for (const Bracket& bracket : brackets) {
      if (better(bracket.best, result.nearest)) result.nearest = bracket.best;
      if (bracket.best.feasible()) result.peaks.push_back(bracket.best);
    }
    std::stable_sort(result.peaks.begin(), result.peaks.end(),
                     [](const SweepPoint& p, const SweepPoint& q) { return better(p, q); });
    return result;
  }

 private:
  /// Best shifts at a centre distance. Where one layer has none, no more of the other is computed
  /// than that it lacks less.
  SweepPoint at(double distance, int count) {
    SweepPoint point{.free = {distance, 0.0, 0.0}};
    const SearchModel& model = values_.model();
    const auto merit_beside = [&](const LayerEvaluation& second) {
      return [this, &model, second](const LayerEvaluation& e) {
        return model.efficiency(e, second, direction_);
      };
    };
    const auto worth = [&](const Place& first, const Place& second) {
      point.free.layer1_shift = first.shift;
      point.free.layer2_shift = second.shift;
      point.margin = std::min(first.margin, second.margin);
      if (point.feasible()) point.merit = first.merit;
      return point;
    };
    LayerProblem layer1(values_, 0, distance, merit_beside(ideal_));
    layer1.look_at_grid(count);
    if (!model.has_layer2())
      return worth(layer1.best(), {.shift = 0.0, .margin = 1e9, .merit = 0.0});
    LayerProblem layer2(values_, 1, distance, [&](const LayerEvaluation& e) {
      return model.efficiency(ideal_, e, direction_);
    });
    layer2.look_at_grid(count);
    if (layer2.is_feasible() && !layer1.is_feasible()) {
      const Place first = layer1.best();
      if (!first.feasible()) return worth(first, layer2.best_so_far());
    }
    const Place second = layer2.best();
    if (!second.feasible()) {
      const bool computed = second.margin > PlaceInParts::kNotComputed;
      return worth(computed ? layer1.best(second.margin) : layer1.best(), second);
    }
    layer1.begin_again(merit_beside(second.evaluation));
    return worth(layer1.best(), second);
  }

  /// A stretch of centre distances with the best point seen in it.
  struct Bracket {
    double low, high;
    SweepPoint best;
  };
  /// Solves a bracket to the end; then looks again around the best, at other places. Returns how
  /// much the last steps and that look added.
  double finish(Bracket& bracket, double step) {
    golden(bracket, kLastSteps - kCheckedSteps);
    const double before = bracket.best.merit;
    golden(bracket, kCheckedSteps);
    for (int i = 0; i < kChecks; ++i) {
      const double distance =
          bracket.best.free.centre_distance + step * (2.0 * (i + 0.5) / kChecks - 1.0) / 3.0;
      const ToothSet& set = values_.model().set();
      const SweepPoint point =
          at(std::clamp(distance, set.centre_distance_min, set.centre_distance_max), kCheckShifts);
      if (!better(point, bracket.best)) continue;
      bracket = {distance - step / kChecks, distance + step / kChecks, point};
      golden(bracket, kLastSteps);
    }
    return bracket.best.feasible() ? bracket.best.merit - std::max(0.0, before) : kNaN;
  }

  void golden(Bracket& bracket, int steps) {
    double &low = bracket.low, &high = bracket.high;
    const auto look = [&](double distance) {
      const SweepPoint point = at(distance, kShifts);
      if (better(point, bracket.best)) bracket.best = point;
      return point;
    };
    SweepPoint p = look(high - kGolden * (high - low)), q = look(low + kGolden * (high - low));
    for (int k = 0; k < steps; ++k) {
      if (better(p, q)) {
        high = q.free.centre_distance, q = p;
        p = look(high - kGolden * (high - low));
      } else {
        low = p.free.centre_distance, p = q;
        q = look(low + kGolden * (high - low));
      }
    }
  }

  SetValues& values_;
  DriveDirection direction_;
  LayerEvaluation ideal_;
};

}  // namespace

SweepResult sweep(SetValues& values, DriveDirection direction) {
  return Sweep(values, direction).run();
}

}  // namespace trueflank
