// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "trueflank/geometry/point2.h"

// Curves as chains of circular arcs that meet tangentially, as machine controls know them.
namespace trueflank {

/// An edge of a chain: the chain goes from `start` to the next edge's start (the chain's end).
struct ArcEdge {
  Point2 start = Point2::Zero();
  /// Tangent of a quarter of the arc's angle, positive counter-clockwise; 0: straight.
  double bulge = 0.0;
};

struct ArcChain {
  std::vector<ArcEdge> edges;
  Point2 end = Point2::Zero();
  double deviation_mm = 0.0;  ///< largest distance found between curve and chain, both ways
};

/// Any smooth curve: point and unit tangent in the direction of travel.
struct PlaneCurve {
  std::function<Point2(double parameter)> point;
  std::function<Point2(double parameter)> tangent;
};

/// Biarcs through points of the curve with its tangents there, halved until all samples of the curve
/// are within the tolerance. The chain is tangent-continuous and has the curve's end tangents.
/// Requires: tolerance_mm > 0; the curve turns by less than a half circle between `from` and `to`
/// or is long against its tolerance.
/// Accuracy: deviation_mm, sampled at 16 places of each biarc, tested in tests/geometry/biarc_test.cpp.
[[nodiscard]] ArcChain fit_arcs(const PlaneCurve& curve, double from, double to,
                                double tolerance_mm);

/// Distance of a point from an edge that ends at `end`.
[[nodiscard]] double distance_mm(const ArcEdge& edge, const Point2& end, const Point2& point);
/// Point of an edge, share 0 .. 1 of its angle.
[[nodiscard]] Point2 point_on(const ArcEdge& edge, const Point2& end, double share);

}  // namespace trueflank
