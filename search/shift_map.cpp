// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/shift_map.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/search/search_optimise.h"
#include "trueflank/search/search_sweep.h"
#include "trueflank/search/search_values.h"

namespace trueflank {
namespace {

constexpr int kCoarse = 61;       ///< points an axis of the first look, for what is feasible
constexpr double kAround = 0.12;  ///< of the feasible stretch is shown beyond it
/// Of the whole range, where nothing or one line alone is feasible.
constexpr double kLeastShown = 0.04;

struct Stretch {
  double low = 0.0, high = 0.0;
};

double& value_of(FreeShifts& free, MapAxis axis) {
  switch (axis) {
    case MapAxis::kCentreDistance:
      return free.centre_distance;
    case MapAxis::kLayer1Shift:
      return free.layer1_shift;
    case MapAxis::kLayer2Shift:
      break;
  }
  return free.layer2_shift;
}

class Surface {
 public:
  Surface(const SearchRequirements& requirements, const ToothSet& set)
      : values_(requirements, set, {}), limits_(set.train->limits) {
    const SearchTrain& train = *set.train;
    for (std::size_t l = 0; l < train.layers.size(); ++l) {
      const int gear = train.layers[l].ring >= 0 ? train.layers[l].ring : train.layers[l].planet;
      for (const char* end : {"least", "greatest"})
        limits_.push_back({Limit::kShift, static_cast<int>(l) + 1,
                           train.topology.gears[static_cast<std::size_t>(gear)].name, end});
    }
  }

  ShiftSurface run(int points) {
    ShiftSurface surface;
    surface.limits = limits_;
    const SweepResult found = sweep(values_, values_.guide());
    best_ = surface.best = found.nearest.free;
    if (!found.peaks.empty()) {
      best_ = surface.best = found.peaks.front().free;
      surface.efficiency = found.peaks.front().merit;
    }
    std::vector<std::array<MapAxis, 2>> pairs{{MapAxis::kCentreDistance, MapAxis::kLayer1Shift}};
    if (values_.model().has_layer2()) {
      pairs.push_back({MapAxis::kCentreDistance, MapAxis::kLayer2Shift});
      pairs.push_back({MapAxis::kLayer1Shift, MapAxis::kLayer2Shift});
    }
    for (const auto& [across, up] : pairs) {
      const ShiftMap coarse = map(across, up, whole(across), whole(up), kCoarse);
      surface.maps.push_back(map(across, up, shown(coarse, across), shown(coarse, up), points));
    }
    return surface;
  }

 private:
  [[nodiscard]] Stretch whole(MapAxis axis) const {
    const ToothSet& set = values_.model().set();
    if (axis == MapAxis::kCentreDistance) return {set.centre_distance_min, set.centre_distance_max};
    return {values_.requirements().shift_min, values_.requirements().shift_max};
  }

  /// What is feasible along an axis of a map, and somewhat more.
  [[nodiscard]] Stretch shown(const ShiftMap& map, MapAxis axis) {
    const auto& line = axis == map.across ? map.x : map.y;
    double low = value_of(best_, axis), high = low;
    for (std::size_t k = 0; k < map.efficiency.size(); ++k) {
      if (!map.feasible(k)) continue;
      const double at = line[axis == map.across ? k % map.x.size() : k / map.x.size()];
      low = std::min(low, at), high = std::max(high, at);
    }
    const Stretch all = whole(axis);
    const double around = std::max({kAround * (high - low), kLeastShown * (all.high - all.low),
                                    line.size() > 1 ? line[1] - line[0] : 0.0});
    return {low - around, high + around};
  }

  ShiftMap map(MapAxis across, MapAxis up, Stretch x, Stretch y, int points) {
    ShiftMap result{.across = across, .up = up};
    const auto line = [&](const Stretch& s) {
      std::vector<double> values;
      for (int i = 0; i < points; ++i)
        values.push_back(s.low + (s.high - s.low) * i / (points - 1));
      return values;
    };
    result.x = line(x), result.y = line(y);
    result.margins.assign(limits_.size(), {});
    // a layer that does not depend on `up` (or on `across`) is computed once a column (a row)
    std::vector<LayerEvaluation> columns, rows;
    const int by_column = up == MapAxis::kLayer1Shift ? 1 : 0;
    for (std::size_t j = 0; j < result.y.size(); ++j)
      for (std::size_t i = 0; i < result.x.size(); ++i) {
        FreeShifts free = best_;
        value_of(free, across) = result.x[i];
        value_of(free, up) = result.y[j];
        SetValues::State state;
        LayerEvaluation& column_layer = by_column == 1 ? state.layer2 : state.layer1;
        LayerEvaluation& other_layer = by_column == 1 ? state.layer1 : state.layer2;
        if (j == 0) columns.push_back(evaluate(by_column, free));
        column_layer = columns[i];
        if (across != MapAxis::kCentreDistance) {
          if (i == 0) rows.push_back(evaluate(1 - by_column, free));
          other_layer = rows[j];
        } else {
          other_layer = evaluate(1 - by_column, free);
        }
        add(result, state, free);
      }
    return result;
  }

  LayerEvaluation evaluate(int layer, const FreeShifts& free) {
    return layer == 0 ? values_.layer1(free.centre_distance, free.layer1_shift)
                      : values_.layer2(free.centre_distance, free.layer2_shift);
  }

  void add(ShiftMap& map, const SetValues::State& state, const FreeShifts& free) {
    std::vector<double> margins(kLimits);
    values_.margins(state, margins.data());
    std::size_t l = 0;
    for (; l < values_.model().limits(); ++l) map.margins[l].push_back(margins[l] + kLimitReserve);
    const SearchRequirements& r = values_.requirements();
    const double shifts[] = {free.layer1_shift, free.layer2_shift};
    for (std::size_t layer = 0; l < limits_.size(); ++layer, l += 2) {
      map.margins[l].push_back(shifts[layer] - r.shift_min + kLimitReserve);
      map.margins[l + 1].push_back(r.shift_max - shifts[layer] + kLimitReserve);
    }
    const double merit = values_.model().efficiency(state.layer1, state.layer2, values_.guide());
    map.efficiency.push_back(merit > 0.0 ? merit : kNaN);
  }

  SetValues values_;
  std::vector<LimitEntry> limits_;
  FreeShifts best_;
};

/// The pieces of a margin's border within one cell of a map.
void add_border(const ShiftMap& map, const std::vector<double>& margin,
                const std::array<std::size_t, 4>& corners, std::vector<BorderPiece>& pieces) {
  std::vector<std::array<double, 2>> crossings;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t p = corners[k], q = corners[(k + 1) % 4];
    if ((margin[p] >= 0.0) == (margin[q] >= 0.0)) continue;
    const double share = margin[p] / (margin[p] - margin[q]);
    const auto between = [&](const std::vector<double>& line, std::size_t a, std::size_t b) {
      return line[a] + share * (line[b] - line[a]);
    };
    const std::size_t columns = map.x.size();
    crossings.push_back(
        {between(map.x, p % columns, q % columns), between(map.y, p / columns, q / columns)});
  }
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
    pieces.push_back({crossings[k], crossings[k + 1]});
}

}  // namespace

std::vector<BorderPiece> limit_border(const ShiftMap& map, std::size_t limit) {
  std::vector<char> feasible;
  for (std::size_t k = 0; k < map.efficiency.size(); ++k) feasible.push_back(map.feasible(k));
  const bool any = std::find(feasible.begin(), feasible.end(), 1) != feasible.end();
  std::vector<BorderPiece> pieces;
  const std::size_t columns = map.x.size();
  for (std::size_t j = 0; j + 1 < map.y.size(); ++j)
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const std::size_t at = j * columns + i;
      const std::array<std::size_t, 4> corners{at, at + 1, at + columns + 1, at + columns};
      if (any &&
          std::none_of(corners.begin(), corners.end(), [&](std::size_t k) { return feasible[k]; }))
        continue;
      add_border(map, map.margins[limit], corners, pieces);
    }
  return pieces;
}

double best_efficiency(const SearchRequirements& requirements, const ToothSet& set) {
  SetValues values(requirements, set, {});
  const SweepResult found = sweep(values, values.guide());
  return found.peaks.empty() ? kNaN : found.peaks.front().merit;
}

bool ShiftMap::feasible(std::size_t point) const {
  return std::all_of(margins.begin(), margins.end(),
                     [&](const std::vector<double>& margin) { return margin[point] >= 0.0; });
}

std::size_t ShiftMap::nearest_limit(std::size_t point) const {
  std::size_t nearest = 0;
  for (std::size_t l = 1; l < margins.size(); ++l)
    if (margins[l][point] < margins[nearest][point]) nearest = l;
  return nearest;
}

ShiftSurface shift_surface(const SearchRequirements& requirements, const ToothSet& set,
                           int points) {
  TRUEFLANK_EXPECTS(points >= 2);
  return Surface(requirements, set).run(points);
}

}  // namespace trueflank
