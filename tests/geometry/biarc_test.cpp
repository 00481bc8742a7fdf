// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/biarc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

PlaneCurve circle(double radius_mm) {
  return {[=](double t) { return Point2(radius_mm * unit_vector(t)); },
          [](double t) { return perpendicular(unit_vector(t)); }};
}

/// y = x^3 / 3: turns one way, then the other.
PlaneCurve cubic() {
  return {[](double t) { return Point2(t, t * t * t / 3.0); },
          [](double t) { return Point2(Point2(1.0, t * t).normalized()); }};
}

TEST(Biarc, CircleIsOneBiarcToTheLastBit) {
  const ArcChain chain = fit_arcs(circle(10.0), 0.2, 1.4, 1e-9);
  EXPECT_EQ(chain.edges.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const Point2 end = i == 0 ? chain.edges[1].start : chain.end;
    for (double u : {0.0, 0.3, 0.7, 1.0})
      EXPECT_NEAR(point_on(chain.edges[static_cast<std::size_t>(i)], end, u).norm(), 10.0, 1e-13);
  }
}

TEST(Biarc, DistanceIsToTheArcOrItsEnds) {
  const ArcEdge quarter{Point2(1.0, 0.0), std::tan(kPi / 8.0)};
  const Point2 end(0.0, 1.0);
  EXPECT_NEAR(distance_mm(quarter, end, Point2(1.0, 1.0)), std::sqrt(2.0) - 1.0, 1e-15);
  EXPECT_NEAR(distance_mm(quarter, end, Point2(0.0, 0.0)), 1.0, 1e-15);
  EXPECT_NEAR(distance_mm(quarter, end, Point2(2.0, -1.0)), std::sqrt(2.0), 1e-15);
  const ArcEdge straight{Point2(0.0, 0.0), 0.0};
  EXPECT_NEAR(distance_mm(straight, Point2(2.0, 0.0), Point2(1.0, 3.0)), 3.0, 1e-15);
}

TEST(Biarc, ChainStaysWithinItsToleranceBothWaysAndIsSmooth) {
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    const ArcChain chain = fit_arcs(cubic(), -1.0, 1.2, tolerance);
    EXPECT_LE(chain.deviation_mm, tolerance);
    const auto end_of = [&](std::size_t i) {
      return i + 1 < chain.edges.size() ? chain.edges[i + 1].start : chain.end;
    };
    for (int k = 0; k <= 5000; ++k) {  // the curve from the chain
      const Point2 p = cubic().point(-1.0 + 2.2 * k / 5000.0);
      double nearest = 1e9;
      for (std::size_t i = 0; i < chain.edges.size(); ++i)
        nearest = std::min(nearest, distance_mm(chain.edges[i], end_of(i), p));
      EXPECT_LE(nearest, 1.02 * tolerance);
    }
    for (std::size_t i = 0; i < chain.edges.size(); ++i) {  // the chain from the curve
      const Point2 p = point_on(chain.edges[i], end_of(i), 0.5);
      double nearest = 1e9;
      double at = 0.0;
      for (int k = 0; k <= 20000; ++k) {
        const double t = -1.0 + 2.2 * k / 20000.0;
        if (const double d = (cubic().point(t) - p).norm(); d < nearest) nearest = d, at = t;
      }
      nearest = std::abs(cross(cubic().tangent(at), p - cubic().point(at)));  // of the tangent there
      EXPECT_LE(nearest, 1.02 * tolerance + 1e-7);
    }
    for (std::size_t i = 0; i + 1 < chain.edges.size(); ++i) {
      const auto direction = [&](std::size_t k, bool at_end) {
        const Point2 chord = end_of(k) - chain.edges[k].start;
        const double half = 2.0 * std::atan(chain.edges[k].bulge);
        return rotated(chord.normalized(), at_end ? half : -half);
      };
      EXPECT_NEAR(cross(direction(i, true), direction(i + 1, false)), 0.0, 1e-9);
    }
  }
}

TEST(Biarc, ThousandTimesFinerTakesAboutTenTimesTheArcs) {
  // biarcs err with the third power of their length
  const std::size_t coarse = fit_arcs(cubic(), -1.0, 1.2, 1e-4).edges.size();
  const std::size_t fine = fit_arcs(cubic(), -1.0, 1.2, 1e-7).edges.size();
  EXPECT_GT(fine, 5 * coarse);
  EXPECT_LT(fine, 20 * coarse);
}

}  // namespace
}  // namespace trueflank
