// SPDX-License-Identifier: GPL-3.0-or-later
//
// Helicoid flanks in strips along their generators, which lie on the surface: fewer facets than rows and
// columns, where a flank is long.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "trueflank/solid/shape/flank_strips.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

using Point3 = Eigen::Vector3d;

Point3 point_of(const std::array<double, 3>& p) { return Point3(p.data()); }

}  // namespace

bool ToothingGrid::is_whole(std::size_t row) const {
  return strips_.empty() || std::any_of(breaks_mm_.begin(), breaks_mm_.end(), [&](double z) {
           return std::abs(z - heights_mm_[row]) < 1e-9;
         });
}

bool ToothingGrid::falls(const Strip& strip, std::size_t layer) const {
  const auto turns_back = [&](std::size_t j) {
    return section_turn_rad(toothing_.twist, heights_mm_[j + 1]) <
           section_turn_rad(toothing_.twist, heights_mm_[j]);
  };
  return strip.falling == (turns_back(layer) == turns_back(0));
}

double ToothingGrid::row_turn_rad(std::size_t layer) const {
  return std::abs(toothing_.twist.turn_rad_per_mm) * (heights_mm_[layer + 1] - heights_mm_[layer]);
}

void ToothingGrid::try_strips(double tolerance_mm) {
  // columns that turn as much as a row does, so that diagonals of the patch are generators
  double row_turn = 0.0;
  for (std::size_t j = 0; j + 1 < heights_mm_.size(); ++j) row_turn = std::max(row_turn, row_turn_rad(j));
  const auto is_flank = [&](const HalfEdge& e) {
    return toothing_.profile->pieces()[e.piece].kind == PieceKind::kInvolute;
  };
  const auto begin = std::find_if(edges_.begin(), edges_.end(), is_flank);
  const auto end = std::find_if_not(begin, edges_.end(), is_flank);
  if (begin == edges_.end() || begin == edges_.begin() || end == edges_.end()) return;
  const double from = begin->from, to = std::prev(end)->to;
  const int columns = std::max(2, static_cast<int>(std::ceil(std::abs(to - from) / row_turn - 1e-9)));
  const auto layers = static_cast<int>(heights_mm_.size()) - 1;
  const auto patches = static_cast<int>(breaks_mm_.size()) - 1;
  if (patches * columns + layers >= (end - begin) * layers) return;  // rows and columns are fewer
  const ToothingGrid before = *this;
  const HalfEdge flank = *begin;
  const auto at_flank = edges_.erase(begin, end);
  std::vector<HalfEdge> even;
  const auto angle = [&](int k) { return k == columns ? to : from + (to - from) * k / columns; };
  for (int k = 0; k < columns; ++k) even.push_back({flank.piece, angle(k), angle(k + 1)});
  edges_.insert(at_flank, even.begin(), even.end());
  place_columns();
  column_turn_rad_ = std::abs(to - from) / columns;
  double error = cut(tolerance_mm);
  // both flanks of a tooth are runs of involute edges
  const int n = points_per_tooth();
  for (int i = 0; i < n; ++i) {
    if (!is_flank(edges_[edge_of_[static_cast<std::size_t>(i)]]) ||
        middles_[static_cast<std::size_t>(i)].piece != flank.piece)
      continue;
    if (strips_.empty() || strips_.back().last != i ||
        points_[static_cast<std::size_t>(i - 1)].side != middles_[static_cast<std::size_t>(i)].side)
      strips_.push_back({i, i, true});
    ++strips_.back().last;
  }
  for (Strip& strip : strips_) {
    strip.falling = !rises(0, 0, (strip.first + strip.last) / 2);
    error = std::max(error, strip_error_mm(strip));
  }
  if (error <= tolerance_mm && strips_.size() == 2) return;
  const double section = section_error_mm_;
  edges_ = before.edges_, points_ = before.points_, middles_ = before.middles_;
  chord_middles_ = before.chord_middles_;
  edge_of_ = before.edge_of_, rises_ = before.rises_, facet_error_mm_ = before.facet_error_mm_;
  section_error_mm_ = section;
  strips_.clear();
}

double ToothingGrid::strip_error_mm(const Strip& strip) const {
  double error = 0.0;
  std::size_t first = 0;
  for (std::size_t last = 1; last < heights_mm_.size(); ++last) {
    if (!is_whole(last)) continue;
    const int columns = strip.last - strip.first, rows = static_cast<int>(last - first);
    const auto parameter = [&](int column) {
      const auto i = static_cast<std::size_t>(strip.first + column);
      // the flank's ends are joints: their places may be of the neighbouring piece
      const std::size_t edge = column < columns ? i : i - 1;
      const HalfEdge& e = edges_[edge_of_[edge]];
      const bool upwards = middles_[edge].side > 0;
      return (column < columns) == upwards ? e.from : e.to;
    };
    const Place flank = middles_[static_cast<std::size_t>(strip.first)];
    for (const auto& t : strips(columns, rows, falls(strip, first), column_turn_rad_, row_turn_rad(first))) {
      std::array<Point3, 3> corner;
      std::array<std::array<double, 2>, 3> place;
      for (std::size_t k = 0; k < 3; ++k) {
        place[k] = {parameter(t[k][0]), heights_mm_[first + static_cast<std::size_t>(t[k][1])]};
        corner[k] = point_of(at({flank.side, flank.piece, place[k][0]}, 0, place[k][1]));
      }
      const Point3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
      for (std::size_t k = 0; k < 3; ++k)
        for (const double share : {0.25, 0.5, 0.75}) {
          const std::size_t to = (k + 1) % 3;
          const Point3 on = point_of(at({flank.side, flank.piece, std::lerp(place[k][0], place[to][0], share)},
                                         0, std::lerp(place[k][1], place[to][1], share)));
          error = std::max(error, std::abs((on - corner[k]).dot(normal)));
        }
    }
    first = last;
  }
  return error;
}

}  // namespace trueflank
