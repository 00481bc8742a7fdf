// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mesh/planar_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>

#include "trueflank/base/units.h"

namespace trueflank::test {
namespace {

using Polygon = std::vector<std::uint32_t>;

Polygon all_of(const std::vector<Point2>& points) {
  Polygon polygon(points.size());
  std::iota(polygon.begin(), polygon.end(), 0U);
  return polygon;
}

/// A star about the origin: simple, counter-clockwise, with many reflex corners.
std::vector<Point2> star(std::mt19937& random, int corners) {
  std::uniform_real_distribution<double> radius(0.2, 2.0);
  std::vector<Point2> points;
  for (int i = 0; i < corners; ++i)
    points.push_back(radius(random) * unit_vector(kTwoPi * i / corners));
  return points;
}

double twice_area(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double smallest_angle(const Point2& a, const Point2& b, const Point2& c) {
  const auto at = [](const Point2& p, const Point2& q, const Point2& r) {
    const Point2 u = q - p, v = r - p;
    return std::acos(std::clamp(u.dot(v) / (u.norm() * v.norm()), -1.0, 1.0));
  };
  return std::min({at(a, b, c), at(b, c, a), at(c, a, b)});
}

/// Every side of a triangle is one of the polygon's, the same way round, or another triangle's, the
/// other way round; all turn to the left, and their areas add up to the polygon's.
void expect_cover(const std::vector<Point2>& points, const Polygon& polygon,
                  const std::vector<IndexTriangle>& triangles) {
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  double area = 0.0, whole = 0.0;
  for (const IndexTriangle& t : triangles) {
    const double own = twice_area(points[t[0]], points[t[1]], points[t[2]]);
    EXPECT_GT(own, 0.0);
    area += own;
    for (std::size_t e = 0; e < 3; ++e) ++sides[{t[e], t[(e + 1) % 3]}];
  }
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::uint32_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    whole += points[a].x() * points[b].y() - points[a].y() * points[b].x();
    ++sides[{b, a}];  // what lies outside
  }
  EXPECT_NEAR(area, whole, 1e-12 * whole);
  for (const auto& [side, times] : sides) {
    EXPECT_EQ(
        times,
        (sides.contains({side.second, side.first}) ? sides.at({side.second, side.first}) : 0));
  }
}

TEST(PlanarTriangulation, EarsCoverThePolygon) {
  std::mt19937 random(1);
  for (int corners : {3, 4, 5, 6, 9, 20, 60})
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<Point2> points = star(random, corners);
      expect_cover(points, all_of(points), clip_ears(points, all_of(points)));
    }
}

TEST(PlanarTriangulation, EarsCoverAPolygonAroundAHole) {
  // a square in a square, cut open along a bridge that is used both ways
  const std::vector<Point2> points{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}};
  const Polygon polygon{0, 1, 2, 3, 0, 4, 7, 6, 5, 4};
  const auto triangles = clip_ears(points, polygon);
  expect_cover(points, polygon, triangles);
  for (const IndexTriangle& t : triangles) {
    const Point2 middle = (points[t[0]] + points[t[1]] + points[t[2]]) / 3.0;
    EXPECT_GE(std::max(std::abs(middle.x() - 1.5), std::abs(middle.y() - 1.5)), 0.5);
  }
}

TEST(PlanarTriangulation, APointOnASideIsNoInsideOfAnEar) {
  // the reflex corner 3 lies on the line from 0 to 2: the ear there would have it on its side
  const std::vector<Point2> points{{0, 0}, {2, -1}, {4, 0}, {2, 0}, {2, 3}};
  const auto triangles = clip_ears(points, {0, 1, 2, 3, 4});
  for (const IndexTriangle& t : triangles)
    EXPECT_GT(twice_area(points[t[0]], points[t[1]], points[t[2]]), 0.0);
  double area = 0.0;
  for (const IndexTriangle& t : triangles)
    area += twice_area(points[t[0]], points[t[1]], points[t[2]]);
  EXPECT_NEAR(area, 2.0 * (2.0 + 3.0), 1e-12);
}

TEST(PlanarTriangulation, CornersInLineMakeNoEmptyTriangle) {
  // seen from the middle in turn, on a grid: many corners on a line, and on sides of ears
  std::mt19937 random(4);
  std::uniform_int_distribution<int> place(-4, 4);
  int tried = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::map<std::pair<int, int>, Point2> by_direction;
    for (int i = 0; i < 14; ++i) {
      const int x = place(random), y = place(random), common = std::gcd(x, y);
      if (common > 0) by_direction.insert({{x / common, y / common}, Point2(x, y)});
    }
    std::vector<Point2> points;
    for (const auto& [direction, p] : by_direction) points.push_back(p);
    const auto angle = [](const Point2& p) { return std::atan2(p.y(), p.x()); };
    std::sort(points.begin(), points.end(),
              [&](const Point2& p, const Point2& q) { return angle(p) < angle(q); });
    bool around = points.size() > 3;
    for (std::size_t i = 0; i < points.size(); ++i)
      around = around && twice_area(Point2(0, 0), points[i], points[(i + 1) % points.size()]) > 0.0;
    if (!around) continue;
    ++tried;
    std::vector<IndexTriangle> triangles = clip_ears(points, all_of(points));
    expect_cover(points, all_of(points), triangles);
    make_delaunay(points, triangles);
    expect_cover(points, all_of(points), triangles);
  }
  EXPECT_GT(tried, 100);
}

/// No corner lies within the circle through the corners of a triangle on the other side of an edge.
void expect_delaunay(const std::vector<Point2>& points,
                     const std::vector<IndexTriangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;
  for (const IndexTriangle& t : triangles)
    for (std::size_t e = 0; e < 3; ++e) opposite[{t[e], t[(e + 1) % 3]}] = t[(e + 2) % 3];
  for (const auto& [side, c] : opposite) {
    const auto other = opposite.find({side.second, side.first});
    if (other == opposite.end()) continue;
    // centre of the circle through three corners, from its two chords' bisectors
    const Point2 a = points[side.first], b = points[side.second] - a, p = points[c] - a;
    const double twice = 2.0 * (b.x() * p.y() - b.y() * p.x());
    const Point2 centre = a + Point2(p.y() * b.squaredNorm() - b.y() * p.squaredNorm(),
                                     b.x() * p.squaredNorm() - p.x() * b.squaredNorm()) /
                                  twice;
    EXPECT_GE((points[other->second] - centre).norm(), (a - centre).norm() * (1.0 - 1e-9));
  }
}

TEST(PlanarTriangulation, AFanInAnyOrderBecomesDelaunay) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const std::uint32_t corners = 5 + static_cast<std::uint32_t>(trial % 20);
    std::vector<Point2> points;
    for (std::uint32_t i = 0; i < corners; ++i) {
      const Point2 p = unit_vector(kTwoPi * (i + 0.3 * (i % 3)) / corners);
      points.emplace_back(3.0 * p.x(), p.y());
    }
    std::vector<IndexTriangle> triangles;
    for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0U, i, i + 1});
    std::shuffle(triangles.begin(), triangles.end(), random);
    make_delaunay(points, triangles);
    expect_cover(points, all_of(points), triangles);
    expect_delaunay(points, triangles);
  }
}

TEST(PlanarTriangulation, NoOpenCircleHoldsANeighbour) {
  std::mt19937 random(2);
  for (int corners : {4, 5, 8, 20, 60})
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<Point2> points = star(random, corners);
      std::vector<IndexTriangle> triangles = clip_ears(points, all_of(points));
      make_delaunay(points, triangles);
      expect_cover(points, all_of(points), triangles);
      expect_delaunay(points, triangles);
    }
}

/// Largest smallest angle that any triangulation of corners first .. last, on a chord, has.
double best_smallest_angle(const std::vector<Point2>& points, std::size_t first, std::size_t last) {
  if (last - first < 2) return kPi;
  double best = 0.0;
  for (std::size_t k = first + 1; k < last; ++k)
    best = std::max(best, std::min({smallest_angle(points[first], points[k], points[last]),
                                    best_smallest_angle(points, first, k),
                                    best_smallest_angle(points, k, last)}));
  return best;
}

TEST(PlanarTriangulation, NoOtherOneOfAConvexPolygonHasALargerSmallestAngle) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(0.0, kTwoPi), wide(1.0, 3.0);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<double> angles(8);
    for (double& a : angles) a = angle(random);
    std::sort(angles.begin(), angles.end());
    const double width = wide(random);
    std::vector<Point2> points;
    for (double a : angles) points.emplace_back(width * std::cos(a), std::sin(a));
    std::vector<IndexTriangle> triangles = clip_ears(points, all_of(points));
    make_delaunay(points, triangles);
    double smallest = kPi;
    for (const IndexTriangle& t : triangles)
      smallest = std::min(smallest, smallest_angle(points[t[0]], points[t[1]], points[t[2]]));
    EXPECT_NEAR(smallest, best_smallest_angle(points, 0, 7), 1e-9);
  }
}

TEST(PlanarTriangulation, CornersOnOneCircleStayAsTheyAre) {
  std::vector<Point2> points;
  for (int i = 0; i < 24; ++i) points.push_back(3.0 * unit_vector(kTwoPi * i / 24));
  const std::vector<IndexTriangle> before = clip_ears(points, all_of(points));
  std::vector<IndexTriangle> after = before;
  make_delaunay(points, after);
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace trueflank::test
