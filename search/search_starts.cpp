// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_starts.h"

#include <algorithm>
#include <array>
#include <optional>

namespace trueflank {
namespace {

constexpr int kGridDistances = 21;  ///< centre distances of the start grid
constexpr int kGridShifts = 21;     ///< ring shifts of it, per layer
constexpr std::size_t kPeaks = 4;   ///< best peaks over the distance that are looked at closer
constexpr std::size_t kStarts = 2;  ///< of them that the optimiser starts from
constexpr int kZoomLevels = 4;
constexpr int kZoomDistances = 5;
constexpr int kZoomShifts = 9;
constexpr double kZoomFactor = 0.4;
/// What a start may lack of a limit, in modules, and what that costs it in efficiency.
constexpr double kBreachTolerance = 0.05;
constexpr double kBreachPrice = 3.0;

using Range = std::array<double, 2>;

/// Best ring shifts at one centre distance, on grids over two ranges. At a fixed distance the layers
/// are independent, and any gain of a mesh is one of the train. Points a little beyond a limit count
/// too, at a price: the feasible region has islands smaller than a cell.
std::optional<SearchStart> best_at(SetValues& values, double a, const Range& range1,
                                   const Range& range2, int count, double tolerance) {
  const double least = values.grid_margin() - tolerance;
  const auto price = [&](double margin) {
    return margin < values.grid_margin() ? kBreachPrice * (values.grid_margin() - margin) : 0.0;
  };
  const auto worth2 = [&](const Layer2Evaluation& e) { return e.planet_ring.driving1; };
  std::optional<SearchStart> layer2_best;
  MeshLoss layer2;
  for (int k = 0; k < count; ++k) {
    const double x = at_grid(range2[0], range2[1], k, count);
    const auto better = [&](const Layer2Evaluation& e) {
      return !layer2_best || worth2(e) > layer2_best->merit;
    };
    const Layer2Evaluation e = values.layer2(a, x, least, better);
    if (!(e.least_margin >= least)) continue;
    const double score = worth2(e) - 0.1 * price(e.least_margin);
    if (layer2_best && !(score > layer2_best->merit)) continue;
    layer2_best = SearchStart{{a, 0.0, x}, score, e.least_margin};
    layer2 = e.planet_ring;
  }
  if (!layer2_best) return std::nullopt;
  std::optional<SearchStart> best;
  for (int k = 0; k < count; ++k) {
    const double x = at_grid(range1[0], range1[1], k, count);
    const auto merit = [&](const Layer1Evaluation& e) {
      return values.model().efficiency(e.sun_planet, e.planet_ring, layer2, values.guide());
    };
    const auto better = [&](const Layer1Evaluation& e) { return !best || merit(e) > best->merit; };
    const Layer1Evaluation e = values.layer1(a, x, least, better);
    if (!(e.least_margin >= least)) continue;
    const double margin = std::min(e.least_margin, layer2_best->margin);
    const double score = merit(e) - price(margin);
    if (!best || score > best->merit)
      best = SearchStart{{a, x, layer2_best->free.ring2_shift}, score, margin};
  }
  return best;
}

void add_peaks(SetValues& values, double tolerance, std::vector<FreeShifts>& starts) {
  std::vector<std::optional<SearchStart>> line;
  const ToothSet& set = values.model().set();
  for (int i = 0; i < kGridDistances; ++i) {
    const double a = at_grid(set.centre_distance_min, set.centre_distance_max, i, kGridDistances);
    line.push_back(best_at(values, a, values.model().ring1_shift_range(a),
                           values.model().ring2_shift_range(a), kGridShifts, tolerance));
  }
  const auto merit_at = [&](std::size_t i) {
    return i < line.size() && line[i] ? line[i]->merit : -1e9;
  };
  std::vector<SearchStart> peaks;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] && merit_at(i) >= merit_at(i - 1) && merit_at(i) > merit_at(i + 1))
      peaks.push_back(*line[i]);
  const auto better = [](const SearchStart& p, const SearchStart& q) { return p.merit > q.merit; };
  std::stable_sort(peaks.begin(), peaks.end(), better);
  if (peaks.size() > kPeaks) peaks.resize(kPeaks);
  const double distance_step =
      (set.centre_distance_max - set.centre_distance_min) / (kGridDistances - 1);
  const SearchRequirements& r = values.requirements();
  const double shift_step = (r.shift_max - r.shift_min) / (kGridShifts - 1);
  for (SearchStart& peak : peaks)
    peak = zoomed(values, peak, distance_step, shift_step, tolerance);
  std::stable_sort(peaks.begin(), peaks.end(), better);
  if (peaks.size() > kStarts) peaks.resize(kStarts);
  for (const SearchStart& peak : peaks) starts.push_back(peak.free);
}

}  // namespace

SearchStart zoomed(SetValues& values, SearchStart start, double distance_step, double shift_step,
                   double tolerance) {
  const ToothSet& set = values.model().set();
  for (int level = 0; level < kZoomLevels; ++level) {
    const SearchStart centre = start;
    for (int i = 0; i < kZoomDistances; ++i) {
      const double a = std::clamp(
          at_grid(centre.free.centre_distance - distance_step,
                  centre.free.centre_distance + distance_step, i, kZoomDistances),
          set.centre_distance_min, set.centre_distance_max);
      // ring1's shift goes up with the distance about as planet1's mesh asks: follow its range
      const auto range1 = values.model().ring1_shift_range(a);
      const auto range2 = values.model().ring2_shift_range(a);
      const auto around = [&](double x, const Range& range) {
        return Range{std::max(range[0], x - shift_step), std::min(range[1], x + shift_step)};
      };
      const auto best = best_at(values, a, around(centre.free.ring1_shift, range1),
                                around(centre.free.ring2_shift, range2), kZoomShifts,
                                tolerance);
      if (best && best->merit > start.merit) start = *best;
    }
    distance_step *= kZoomFactor;
    shift_step *= kZoomFactor;
  }
  return start;
}

std::vector<FreeShifts> grid_starts(SetValues& values) {
  std::vector<FreeShifts> starts;
  add_peaks(values, 0.0, starts);
  add_peaks(values, kBreachTolerance, starts);
  return starts;
}

}  // namespace trueflank
