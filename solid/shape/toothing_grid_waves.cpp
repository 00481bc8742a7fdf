// SPDX-License-Identifier: GPL-3.0-or-later
//
// Waves of a displacement that are shorter than the ways at whose middles rows and columns look. Source:
// docs/theory/helical-facets.md.
#include <algorithm>
#include <cmath>

#include "trueflank/solid/shape/bend_survey.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

/// Chords that looked right and are off by so many tolerances hide a wave.
constexpr double kHidden = 1.5;
/// Heights at which an edge is looked at, on each tooth and side.
constexpr int kHeightsOfEdge = 12;
/// No more rows, nor columns of a half tooth: the estimate refused such a job before.
constexpr std::size_t kMostWays = 200'000;

}  // namespace

ToothingGrid::Point ToothingGrid::displaced_by(const Place& place, int tooth, double z_mm) const {
  Toothing unmoved = toothing_;
  unmoved.displacement = nullptr;
  return (*toothing_.displacement)(surface_point(unmoved, place_at(place, tooth, z_mm), z_mm));
}

bool ToothingGrid::hides_upright(double lower_mm, double upper_mm, double error_mm) const {
  SpreadShares shares;
  for (const int tooth : some_teeth())
    for (const Place& place : points_)
      if (is_off_chord(shares.next(), error_mm, [&](double share) {
            return displaced_by(place, tooth, std::lerp(lower_mm, upper_mm, share));
          }))
        return true;
  return false;
}

bool ToothingGrid::hides_across(const HalfEdge& edge, double error_mm) const {
  SpreadShares shares, heights;
  for (const int tooth : some_teeth())
    for (const int side : {-1, 1})
      for (int k = 0; k < kHeightsOfEdge; ++k) {
        const double z = std::lerp(levels_mm_.front(), levels_mm_.back(), heights.next());
        if (is_off_chord(shares.next(), error_mm, [&](double share) {
              return displaced_by({side, edge.piece, std::lerp(edge.from, edge.to, share)}, tooth, z);
            }))
          return true;
      }
  return false;
}

/// Halves ways in which a wave hides until none is left; false where there was none.
bool ToothingGrid::cut_hidden_waves(double aim_mm) {
  if (toothing_.displacement == nullptr || heights_mm_.size() < 2) return false;
  const std::size_t columns = edges_.size(), rows = heights_mm_.size();
  std::vector<HalfEdge> edges(edges_.rbegin(), edges_.rend()), split;  // the next one last
  while (!edges.empty()) {
    const HalfEdge e = edges.back();
    edges.pop_back();
    const double middle = 0.5 * (e.from + e.to);
    const Curve& curve = toothing_.profile->pieces()[e.piece].curve;
    const bool is_short =
        (point_at(curve, e.to) - point_at(curve, e.from)).norm() < kShortestCut * aim_mm;
    const bool halved = !is_short && split.size() + edges.size() < kMostWays &&
                        hides_across(e, kHidden * aim_mm);
    if (!halved) {
      split.push_back(e);
      continue;
    }
    edges.push_back({e.piece, middle, e.to});
    edges.push_back({e.piece, e.from, middle});
  }
  edges_ = std::move(split);
  if (edges_.size() > columns) place_columns();
  std::vector<double> above(heights_mm_.rbegin(), heights_mm_.rend()), heights{above.back()};
  above.pop_back();
  while (!above.empty()) {
    const double lower = heights.back(), upper = above.back(), middle = 0.5 * (lower + upper);
    const bool halved = upper - lower > kShortestCut * aim_mm &&
                        heights.size() + above.size() < kMostWays &&
                        hides_upright(lower, upper, kHidden * aim_mm);
    if (halved) {
      above.push_back(middle);
      continue;
    }
    heights.push_back(upper);
    above.pop_back();
  }
  heights_mm_ = std::move(heights);
  return edges_.size() > columns || heights_mm_.size() > rows;
}

}  // namespace trueflank
