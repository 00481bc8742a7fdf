// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_sweep.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

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

  /// The best place of a range; without a feasible one the place of the least breach.
  Place best(double low, double high, int count) {
    if (!(high >= low)) return {.shift = 0.5 * (low + high)};
    const double inside = kInside * (high - low), step = (high - low) / (count - 1);
    for (int i = 0; i < count; ++i)
      line_.push_back(look(low + inside + (high - low - 2.0 * inside) * i / (count - 1), false));
    best_of_grid();
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) cell(i, step);
    return best_.value_or(Place{});
  }

 private:
  /// Without profiles an undercut's losses are taken as the least they can be.
  Place look(double shift, bool whole) {
    Place place{.shift = shift, .whole = whole};
    place.evaluation = !whole       ? values_.outline(layer_, distance_, shift, -kFarBreach)
                       : layer_ == 0 ? values_.layer1(distance_, shift, -kFarBreach)
                                     : values_.layer2(distance_, shift, -kFarBreach);
    place.margin = values_.layer_margin(layer_, place.evaluation, !whole);
    place.merit = merit_(place.evaluation);
    if (whole && (!best_ || better(place, *best_))) best_ = place;
    return place;
  }
  void complete(Place& place) {
    if (!place.whole) place = look(place.shift, true);
  }

  /// From the best merit downwards until no other can be better than the best feasible one.
  void best_of_grid() {
    std::vector<std::size_t> order(line_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return line_[i].merit > line_[j].merit; });
    for (const std::size_t i : order) {
      if (best_ && best_->feasible() && !(line_[i].merit > best_->merit)) return;
      if (line_[i].margin >= 0.0) complete(line_[i]);
    }
  }

  /// What lies between two neighbours of the grid.
  void cell(std::size_t i, double step) {
    Place &p = line_[i], &q = line_[i + 1];
    if (std::max(p.margin, q.margin) < -kSteepest * step) return;
    const double most = std::max(p.merit, q.merit) + 0.25 * std::abs(p.merit - q.merit);
    const bool had = best_ && best_->feasible();
    if (had && most < best_->merit) return;
    if (p.margin >= 0.0) complete(p);
    if (q.margin >= 0.0) complete(q);
    if (p.feasible() != q.feasible()) return p.feasible() ? border(p, q) : border(q, p);
    if (p.feasible()) {
      if (had && std::max(p.merit, q.merit) < best_->merit) return;
      return inner_peak(p.shift, q.shift);
    }
    // the same limit at both ends: an interval between them lies at a peak of the margin, or where
    // a limit ends suddenly: a corner that no longer reaches a fillet
    const double most_margin = std::max(p.margin, q.margin);
    if (close(p, q)) return split(p, q, kSplits, kHalvings);
    if (std::min(p.margin, q.margin) < -2.0 * kSteepest * step) return;
    for (const std::size_t beside : {i - 1, i + 2})
      if (beside < line_.size() && line_[beside].margin > most_margin) return;
    narrow(p, q);
  }

  /// Whether the limits that both places break are close to being kept.
  [[nodiscard]] bool close(const Place& p, const Place& q) const {
    const std::uint64_t both = broken(p) & broken(q);
    return std::max(values_.margin_of_limits(layer_, p.evaluation, both),
                    values_.margin_of_limits(layer_, q.evaluation, both)) > -kClose;
  }

  /// Looks between two infeasible places by halving. Where no limit is broken at both ends there is
  /// but one half to go on with: however narrow the interval is, it is found. Else both halves are
  /// looked at, `depth` times.
  void split(const Place& p, const Place& q, int depth, int halvings) {
    if (depth == 0 || halvings == 0) return;
    const Place middle = look(0.5 * (p.shift + q.shift), true);
    if (middle.feasible()) {
      border(middle, p);
      border(middle, q);
      return inner_peak(p.shift, q.shift);
    }
    const bool apart_p = (broken(p) & broken(middle)) == 0,
               apart_q = (broken(q) & broken(middle)) == 0;
    if (apart_p != apart_q) {
      if (apart_p) return split(p, middle, depth, halvings - 1);
      return split(middle, q, depth, halvings - 1);
    }
    if (close(p, middle)) split(p, middle, depth - 1, halvings - 1);
    if (close(middle, q)) split(middle, q, depth - 1, halvings - 1);
  }

  [[nodiscard]] std::uint64_t broken(const Place& place) const {
    return values_.broken_limits(layer_, place.evaluation);
  }

  /// The best inside of an interval, where it is better than its ends.
  void inner_peak(double low, double high) {
    golden(
        low, high, [](const Place& p, const Place& q) { return better(p, q); }, false);
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
        true);
    if (!found) return;
    border(*found, left);
    border(*found, right);
    inner_peak(left.shift, right.shift);
  }

  template <class Better>
  std::optional<Place> golden(double low, double high, const Better& is_better,
                              bool until_feasible) {
    Place p = look(high - kGolden * (high - low), true),
          q = look(low + kGolden * (high - low), true);
    for (int k = 0; k < kShiftSteps; ++k) {
      if (until_feasible && (p.feasible() || q.feasible())) return p.feasible() ? p : q;
      // nothing can be hidden here that is feasible
      if (until_feasible && std::max(p.margin, q.margin) < -kSteepest * (high - low))
        return std::nullopt;
      if (is_better(p, q)) {
        high = q.shift, q = p;
        p = look(high - kGolden * (high - low), true);
      } else {
        low = p.shift, p = q;
        q = look(low + kGolden * (high - low), true);
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
  std::vector<Place> line_;
  std::optional<Place> best_;
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
  /// Best shifts at a centre distance.
  SweepPoint at(double distance, int count) {
    SweepPoint point{.free = {distance, 0.0, 0.0}};
    const SearchModel& model = values_.model();
    Place second{.shift = 0.0, .margin = 1e9, .merit = 0.0, .evaluation = ideal_};
    if (model.has_layer2()) {
      const auto range = model.shift_range(1, distance);
      second = LayerProblem(values_, 1, distance, [&](const LayerEvaluation& e) {
                 return model.efficiency(ideal_, e, direction_);
               }).best(range[0], range[1], count);
    }
    const auto range = model.shift_range(0, distance);
    const Place first =
        LayerProblem(values_, 0, distance, [&](const LayerEvaluation& e) {
          return model.efficiency(e, second.margin >= 0.0 ? second.evaluation : ideal_, direction_);
        }).best(range[0], range[1], count);
    point.free.layer1_shift = first.shift;
    point.free.layer2_shift = second.shift;
    point.margin = std::min(first.margin, second.margin);
    if (point.feasible()) point.merit = first.merit;
    return point;
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
