// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sweep of search_sweep.h on a coarse grid, without profiles: every limit may be broken by what
// a margin changes on the way to the nearest point of the grid, and what merits change on that way
// is added.
#include "trueflank/search/search_bound.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/search/search_values.h"

namespace trueflank {
namespace {

constexpr int kDistances = 21;
constexpr int kShifts = 17;
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

double greatest_with_room(const std::vector<double>& line) {
  double greatest = -1.0;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] >= 0.0) greatest = std::max(greatest, line[i] + room_at(line, i));
  return greatest;
}

class Bound {
 public:
  Bound(const SearchRequirements& requirements, const ToothSet& set, DriveDirection direction)
      : values_(requirements, set, {}), model_(values_.model()), direction_(direction) {
    ideal_.sun_planet = ideal_.planet_ring = {1.0, 1.0};
    line_.resize(kShifts);
  }

  double run(BoundBy by) {
    by_ = by;
    const ToothSet& set = model_.set();
    const double low = set.centre_distance_min, high = set.centre_distance_max;
    step_ = (high - low) / (kDistances - 1);
    std::vector<double> merits;
    for (int i = 0; i < kDistances; ++i)
      merits.push_back(at(low + (high - low) * inside(i, kDistances)));
    const double bound = greatest_with_room(merits);
    return bound < 0.0 ? bound : bound + kRoom;
  }

 private:
  static double inside(int i, int count) {
    return kInside + (1.0 - 2.0 * kInside) * i / (count - 1);
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
    const double slack = kSlack * (step_ + width / (kShifts - 1));
    std::vector<LayerEvaluation> outlines;
    for (int i = 0; i < kShifts; ++i) {
      outlines.push_back(
          model_.outline(layer, distance, from + width * inside(i, kShifts), -slack));
      line_[static_cast<std::size_t>(i)] =
          values_.layer_margin(layer, outlines.back(), true) < -slack
              ? -1.0
              : merit(layer, outlines.back(), other);
    }
    return by_ == BoundBy::kOutlines ? best_outline(outlines, found)
                                     : best_profile(layer, distance, from, width, other, found);
  }

  double merit(int layer, const LayerEvaluation& e, const LayerEvaluation& other) const {
    return layer == 0 ? model_.efficiency(e, other, direction_)
                      : model_.efficiency(other, e, direction_);
  }

  double best_outline(const std::vector<LayerEvaluation>& outlines, LayerEvaluation& found) const {
    const auto best = std::max_element(line_.begin(), line_.end());
    found = outlines[static_cast<std::size_t>(best - line_.begin())];
    return greatest_with_room(line_);
  }

  /// From the best outline downwards: no profile is worth more than its outline.
  double best_profile(int layer, double distance, double from, double width,
                      const LayerEvaluation& other, LayerEvaluation& found) const {
    const double slack = kProfileSlack * (step_ + width / (kShifts - 1));
    std::vector<std::size_t> order(line_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t p, std::size_t q) { return line_[p] > line_[q]; });
    double greatest = -1.0, bound = -1.0;
    for (const std::size_t i : order) {
      if (line_[i] < 0.0 || line_[i] + room_at(line_, i) <= bound) break;
      const double shift = from + width * inside(static_cast<int>(i), kShifts);
      const LayerEvaluation e = layer == 0 ? model_.layer1(distance, shift, -slack)
                                           : model_.layer2(distance, shift, -slack);
      if (values_.layer_margin(layer, e, false) < -slack) continue;
      const double here = merit(layer, e, other);
      if (here > greatest) greatest = here, found = e;
      bound = std::max(bound, here + room_at(line_, i));
    }
    return bound;
  }

  SetValues values_;
  const SearchModel& model_;
  DriveDirection direction_;
  LayerEvaluation ideal_;
  BoundBy by_ = BoundBy::kOutlines;
  double step_ = 0.0;
  std::vector<double> line_;
};

}  // namespace

double efficiency_bound(const SearchRequirements& requirements, const ToothSet& set,
                        DriveDirection direction, BoundBy by) {
  return Bound(requirements, set, direction).run(by);
}

}  // namespace trueflank
