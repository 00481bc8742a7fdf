// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact predicates on double coordinates suffice: nothing is constructed, so nothing is rounded.
#include "trueflank/check/clearance/tooth_crossing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "trueflank/geometry/polyline.h"

namespace trueflank {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Edge {
  Point2 a, b;
  double low_x, high_x, low_y, high_y;
};

/// A gear's section, placed, and the circles between which it lies.
struct PlacedSection {
  std::vector<Point2> points;
  Point2 centre_mm = Point2::Zero();
  double least_radius_mm = 0.0, largest_radius_mm = 0.0;
};

PlacedSection placed(const SectionPolygon& section, double rotation_rad, const Point2& centre_mm) {
  PlacedSection result{.points = {}, .centre_mm = centre_mm};
  result.points.reserve(section.points.size());
  const Point2 axis = unit_vector(rotation_rad);
  double least = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const Point2& p : section.points) {
    result.points.push_back(centre_mm + p.x() * axis + p.y() * perpendicular(axis));
    least = std::min(least, p.squaredNorm());
    largest = std::max(largest, p.squaredNorm());
  }
  // chords of a circle dip below it by no more than the chord error; none reaches beyond its ends
  result.least_radius_mm = std::sqrt(least) - section.chord_error_mm;
  result.largest_radius_mm = std::sqrt(largest);
  return result;
}

/// Edges of a section that reach between the circles of the other.
std::vector<Edge> edges_near(const PlacedSection& section, const PlacedSection& other) {
  const std::size_t n = section.points.size();
  std::vector<Edge> edges;
  double last_mm = (section.points.back() - other.centre_mm).norm();
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 &a = section.points[i == 0 ? n - 1 : i - 1], &b = section.points[i];
    const double to_a_mm = last_mm, to_b_mm = last_mm = (b - other.centre_mm).norm();
    // no point of the edge is farther than its ends, or nearer than them by more than its length
    if (std::max(to_a_mm, to_b_mm) < other.least_radius_mm ||
        std::min(to_a_mm, to_b_mm) - (b - a).norm() > other.largest_radius_mm)
      continue;
    edges.push_back({a, b, std::min(a.x(), b.x()), std::max(a.x(), b.x()), std::min(a.y(), b.y()),
                     std::max(a.y(), b.y())});
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
                          const Point2& centre2_mm, double tolerance_mm) {
  const SectionPolygon section1 = section_polygon(*pair.profile1, tolerance_mm);
  const SectionPolygon section2 = section_polygon(*pair.profile2, tolerance_mm);
  const PlacedSection one = placed(section1, rotation1_rad, Point2::Zero());
  const PlacedSection two = placed(section2, rotation2_rad, centre2_mm);
  auto first = edges_near(one, two), second = edges_near(two, one);
  return {any_meet(first, second), section1.chord_error_mm + section2.chord_error_mm};
}

}  // namespace trueflank
