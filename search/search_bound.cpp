// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweep of search_sweep.h on a coarse grid, first without profiles: every limit may be broken by
// what a margin changes on the way to the nearest point of the grid, and what merits change on that
// way is added. Then the stretch of centre distances whose bound is the highest is halved, with half
// of the steps and of what is added, until the highest is one of the shortest.
#include "trueflank/search/search_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

#include "trueflank/search/search_values.h"

namespace trueflank {
namespace {

constexpr int kDistances = 21;
constexpr int kShifts = 17;  ///< at first; halved as often as the stretch of centre distances
constexpr int kFinest = 3;   ///< halvings
/// Margins change by less than this on the way to the nearest point of the grid, per step of it:
/// those of the outline, and with those of the corners in the roots. No set of 7 000 needed 0.3.
constexpr double kSlack = 0.5;
constexpr double kProfileSlack = 1.0;
constexpr double kInside = 1e-9;
/// Added to every bound: of 2 974 sets the least that a bound was above the optimum was 1e-4.
constexpr double kRoom = 1e-3;

/// What a function may rise above a value on half of the way to a neighbour.
double room_at(const std::vector<double>& line, std::size_t i) {
  double step = 0.0;
  for (const std::size_t beside : {i - 1, i + 1})
    if (beside < line.size() && line[beside] >= 0.0)
      step = std::max(step, std::abs(line[i] - line[beside]));
  return 0.5 * step;
}

class Bound {
 public:
  Bound(const SearchRequirements& requirements, const ToothSet& set, DriveDirection direction)
      : values_(requirements, set, {}), model_(values_.model()), direction_(direction) {
    ideal_.sun_planet = ideal_.planet_ring = {1.0, 1.0};
    low_ = model_.set().centre_distance_min;
    high_ = model_.set().centre_distance_max;
  }

  double run(BoundBy by, double enough) {
    profiles_ = by != BoundBy::kOutlines;
    const std::vector<Stretch> line = whole_range();
    std::priority_queue<Stretch> open;
    for (const Stretch& stretch : line)
      if (stretch.bound >= 0.0) open.push(stretch);
    while (by == BoundBy::kHalving && !open.empty() && open.top().bound >= enough) {
      const Stretch widest = open.top();
      if (widest.halvings == kFinest) break;
      open.pop();
      for (const double side : {-0.25, 0.25})
        if (const auto half = half_of(widest, side); half.bound >= 0.0) open.push(half);
    }
    return open.empty() ? -1.0 : open.top().bound;
  }

 private:
  /// Centre distances within half a step of the middle.
  struct Stretch {
    double middle = kNaN, bound = -1.0;
    double room = 0.0;  ///< of the bound, for what lies off the middle
    int halvings = 0;
    bool operator<(const Stretch& other) const { return bound < other.bound; }
  };

  static double inside(int i, int count) {
    return kInside + (1.0 - 2.0 * kInside) * i / (count - 1);
  }

  std::vector<Stretch> whole_range() {
    set_grid(0);
    std::vector<Stretch> line(kDistances);
    std::vector<double> merits;
    for (int i = 0; i < kDistances; ++i) {
      line[static_cast<std::size_t>(i)].middle = low_ + (high_ - low_) * inside(i, kDistances);
      merits.push_back(at(line[static_cast<std::size_t>(i)].middle));
    }
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (merits[i] < 0.0) continue;
      line[i].room = room_at(merits, i);
      line[i].bound = merits[i] + line[i].room + kRoom;
    }
    return line;
  }

  /// No more than the whole is.
  Stretch half_of(const Stretch& whole, double side) {
    set_grid(whole.halvings);
    Stretch half{.middle = whole.middle + side * step_,
                 .room = 0.5 * whole.room,
                 .halvings = whole.halvings + 1};
    if (half.middle < low_ || half.middle > high_) return half;
    set_grid(half.halvings);
    const double merit = at(half.middle);
    if (merit >= 0.0) half.bound = std::min(whole.bound, merit + half.room + kRoom);
    return half;
  }

  void set_grid(int halvings) {
    step_ = (high_ - low_) / ((kDistances - 1) << halvings);
    halvings_ = halvings;
  }

  /// What the layers allow together: the losses of both where they are least.
  double at(double distance) {
    double room = 0.0;
    LayerEvaluation second = ideal_;
    if (model_.has_layer2()) {
      const double merit = best(1, distance, ideal_, second);
      if (merit < 0.0) return -1.0;
      room = merit - model_.efficiency(ideal_, second, direction_);
    }
    LayerEvaluation first;
    const double merit = best(0, distance, second, first);
    return merit < 0.0 ? merit : merit + room;
  }

  double best(int layer, double distance, const LayerEvaluation& other, LayerEvaluation& found) {
    const auto range = model_.shift_range(layer, distance);
    if (!(range[1] >= range[0] - step_)) return -1.0;
    const double from = std::min(range[0], range[1]), width = std::abs(range[1] - range[0]);
    const Shifts range_of{layer, distance, width, other};
    std::vector<Cell> cells;
    std::vector<double> merits;
    for (int i = 0; i < kShifts; ++i) {
      cells.push_back(outlined({.shift = from + width * inside(i, kShifts)}, range_of));
      merits.push_back(cells.back().bound);
    }
    std::priority_queue<Cell> open;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (merits[i] < 0.0) continue;
      cells[i].room = room_at(merits, i);
      cells[i].bound += cells[i].room;
      open.push(cells[i]);
    }
    return highest(open, range_of, found);
  }

  /// Of a layer at a centre distance, with the other layer as it is.
  struct Shifts {
    int layer = 0;
    double distance = kNaN, width = 0.0;
    const LayerEvaluation& other;
  };
  /// Shifts within half a step of one.
  struct Cell {
    double shift = kNaN, bound = -1.0;
    double room = 0.0;  ///< of the bound, for what lies off the middle
    int halvings = 0;
    bool whole = false;  ///< its profiles were looked at
    LayerEvaluation evaluation;
    bool operator<(const Cell& other_cell) const { return bound < other_cell.bound; }
  };

  double slack(double share, const Cell& cell, const Shifts& s) const {
    return share * (step_ + s.width / ((kShifts - 1) << cell.halvings));
  }

  Cell outlined(Cell cell, const Shifts& s) const {
    const double loose = slack(kSlack, cell, s);
    cell.evaluation = model_.outline(s.layer, s.distance, cell.shift, -loose);
    const bool out = values_.layer_margin(s.layer, cell.evaluation, true) < -loose;
    cell.bound = out ? -1.0 : merit(s.layer, cell.evaluation, s.other) + cell.room;
    return cell;
  }

  Cell profiled(Cell cell, const Shifts& s) const {
    const double loose = slack(kProfileSlack, cell, s);
    cell.whole = true;
    cell.evaluation = s.layer == 0 ? model_.layer1(s.distance, cell.shift, -loose)
                                   : model_.layer2(s.distance, cell.shift, -loose);
    const bool out = values_.layer_margin(s.layer, cell.evaluation, false) < -loose;
    cell.bound =
        out ? -1.0 : std::min(cell.bound, merit(s.layer, cell.evaluation, s.other) + cell.room);
    return cell;
  }

  /// No profile is worth more than its outline, no half more than the whole.
  double highest(std::priority_queue<Cell>& open, const Shifts& s, LayerEvaluation& found) const {
    const auto push = [&](const Cell& cell) {
      if (cell.bound >= 0.0) open.push(cell);
    };
    while (!open.empty()) {
      const Cell top = open.top();
      if (!profiles_ || (top.whole && top.halvings == halvings_)) {
        found = top.evaluation;
        return top.bound;
      }
      open.pop();
      if (!top.whole) {
        push(profiled(top, s));
        continue;
      }
      const double quarter = 0.25 * s.width / ((kShifts - 1) << top.halvings);
      for (const double side : {-quarter, quarter}) {
        Cell half = outlined({.shift = top.shift + side,
                              .room = 0.5 * top.room,
                              .halvings = top.halvings + 1},
                             s);
        half.bound = std::min(half.bound, top.bound);
        push(half);
      }
    }
    return -1.0;
  }

  double merit(int layer, const LayerEvaluation& e, const LayerEvaluation& other) const {
    return layer == 0 ? model_.efficiency(e, other, direction_)
                      : model_.efficiency(other, e, direction_);
  }

  SetValues values_;
  const SearchModel& model_;
  DriveDirection direction_;
  LayerEvaluation ideal_;
  bool profiles_ = false;
  double low_ = 0.0, high_ = 0.0;  ///< centre distances
  double step_ = 0.0;              ///< of them
  int halvings_ = 0;
};

}  // namespace

double efficiency_bound(const SearchRequirements& requirements, const ToothSet& set,
                        DriveDirection direction, BoundBy by, double enough) {
  // A shaped ring's fillet may shorten the path by more than the grid is loosened by.
  if (requirements.cutter) return 1.0;
  return Bound(requirements, set, direction).run(by, enough);
}

double least_size_mm(const SearchRequirements& r, const ToothSet& set) {
  if (r.outer_diameter_mm) return *r.outer_diameter_mm;
  const SearchModel model(r, set);
  // at one distance every gear's circle changes one way with its layer's shift: the ends tell
  std::vector<double> least;
  for (int i = 0; i < kDistances; ++i) {
    const double distance = set.centre_distance_min +
                            (set.centre_distance_max - set.centre_distance_min) * i / (kDistances - 1);
    const auto first = model.shift_range(0, distance);
    const auto second = model.has_layer2() ? model.shift_range(1, distance) : std::array{0.0, 0.0};
    double here = std::numeric_limits<double>::infinity();
    for (const double x1 : first)
      for (const double x2 : second) here = std::min(here, model.outer_diameter({distance, x1, x2}));
    least.push_back(here);
  }
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < least.size(); ++i) {
    double step = 0.0;
    for (const std::size_t beside : {i - 1, i + 1})
      if (beside < least.size()) step = std::max(step, std::abs(least[i] - least[beside]));
    bound = std::min(bound, least[i] - step);
  }
  return bound * r.module_mm;
}

namespace {

/// What designs are ranked by; of a weighted product its factors.
std::vector<SearchObjective> ranked_by(const SearchRequirements& r) {
  std::vector<SearchObjective> all;
  for (const SearchObjective objective : r.objectives)
    if (objective != SearchObjective::kWeighted) all.push_back(objective);
  for (const ObjectiveWeight& w : r.weights) all.push_back(w.objective);
  return all;
}

bool is_bounded(SearchObjective objective) {
  return objective == SearchObjective::kForward || objective == SearchObjective::kBackward ||
         objective == SearchObjective::kSize;
}

}  // namespace

bool has_bounds(const SearchRequirements& r) {
  const std::vector<SearchObjective> all = ranked_by(r);
  // more of the meshes is more of the drive, as long as friction does not fall with the load
  return (!r.losses || r.losses->load_friction >= 0.0) &&
         std::all_of(all.begin(), all.end(), is_bounded);
}

void MeshBounds::lower(const SearchRequirements& r, const ToothSet& set, BoundBy by, double enough) {
  const std::vector<SearchObjective> all = ranked_by(r);
  const auto asked = [&](SearchObjective o) { return std::count(all.begin(), all.end(), o) > 0; };
  // where neither is ranked by, one tells whether there are shifts
  const bool other = asked(SearchObjective::kBackward);
  if (asked(SearchObjective::kForward) || !other)
    forward = std::min(forward, efficiency_bound(r, set, DriveDirection::kForward, by, enough));
  if (other && forward >= 0.0)
    backward = std::min(backward, efficiency_bound(r, set, DriveDirection::kBackward, by, enough));
}

Merits merit_bounds(const SearchRequirements& r, double ratio, const MeshBounds& meshes,
                    double least_size_mm) {
  const ToldEfficiencies told = told_efficiencies(r, ratio, meshes.forward, meshes.backward);
  Merits merits;
  for (const SearchObjective objective : r.objectives)
    merits.push_back(objective == SearchObjective::kForward    ? told.forward
                     : objective == SearchObjective::kBackward ? told.backward
                     : objective == SearchObjective::kSize     ? -least_size_mm
                     : objective == SearchObjective::kWeighted && has_bounds(r)
                         ? weighted_score(r, told, {.size_mm = least_size_mm})
                         : std::numeric_limits<double>::infinity());
  return merits;
}

}  // namespace trueflank
