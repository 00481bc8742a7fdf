// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact predicates on double coordinates suffice: nothing is constructed, so nothing is rounded.
#include "trueflank/check/tooth_crossing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/geometry/polyline.h"

namespace trueflank {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double kChordError = 2e-5;  // of the module

struct Edge {
  Point2 a, b;
  double low_x, high_x, low_y, high_y;
};

/// Edges of all teeth of a gear, placed, that lie inside a box.
std::vector<Edge> edges_near(const SectionPolygon& section, double rotation_rad,
                             const Point2& centre_mm, const Point2& low, const Point2& high) {
  const std::size_t n = section.points.size();
  std::vector<Point2> placed(n);
  for (std::size_t i = 0; i < n; ++i)
    placed[i] = centre_mm + rotated(section.points[i], rotation_rad);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 &a = placed[i], &b = placed[(i + 1) % n];
    const Edge e{a, b, std::min(a.x(), b.x()), std::max(a.x(), b.x()), std::min(a.y(), b.y()),
                 std::max(a.y(), b.y())};
    if (e.high_x < low.x() || e.low_x > high.x() || e.high_y < low.y() || e.low_y > high.y())
      continue;
    edges.push_back(e);
  }
  return edges;
}

bool meet(const Edge& e, const Edge& f) {
  if (e.high_x < f.low_x || f.high_x < e.low_x || e.high_y < f.low_y || f.high_y < e.low_y)
    return false;
  const Kernel::Segment_2 s({e.a.x(), e.a.y()}, {e.b.x(), e.b.y()});
  const Kernel::Segment_2 t({f.a.x(), f.a.y()}, {f.b.x(), f.b.y()});
  return CGAL::do_intersect(s, t);
}

/// Do any edges of two sets meet? Both are sorted by their lowest y and swept.
bool any_meet(std::vector<Edge>& first, std::vector<Edge>& second) {
  const auto lower = [](const Edge& e, const Edge& f) { return e.low_y < f.low_y; };
  std::sort(first.begin(), first.end(), lower);
  std::sort(second.begin(), second.end(), lower);
  double tallest = 0.0;
  for (const Edge& f : second) tallest = std::max(tallest, f.high_y - f.low_y);
  std::size_t from = 0;
  for (const Edge& e : first) {
    while (from < second.size() && second[from].low_y + tallest < e.low_y) ++from;
    for (std::size_t j = from; j < second.size() && second[j].low_y <= e.high_y; ++j)
      if (meet(e, second[j])) return true;
  }
  return false;
}

}  // namespace

ToothCrossing teeth_cross(const GearPair& pair, double rotation1_rad, double rotation2_rad,
                          const Point2& centre2_mm) {
  const double tolerance = kChordError * pair.gear1().normal_module_mm;
  const SectionPolygon section1 = section_polygon(*pair.profile1, tolerance);
  const SectionPolygon section2 = section_polygon(*pair.profile2, tolerance);
  // all of gear 1 that can be near: its own outline against everything of gear 2 in that box
  const double reach = pair.profile1->tip_radius_mm() + pair.gear1().normal_module_mm;
  auto first = edges_near(section1, rotation1_rad, Point2::Zero(), Point2(-reach, -reach),
                          Point2(reach, reach));
  auto second =
      edges_near(section2, rotation2_rad, centre2_mm, Point2(-reach, -reach), Point2(reach, reach));
  return {any_meet(first, second), section1.chord_error_mm + section2.chord_error_mm};
}

}  // namespace trueflank
