// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>
#include <vector>

#include "trueflank/geometry/bezier_fit.h"
#include "trueflank/solid/shape/part_shape.h"

// An outline as formats with curves know it: straight lines, true arcs and splines.
namespace trueflank {

/// A circle that arcs of a path lie on; all tip arcs of a gear share one.
struct PathCircle {
  Point2 centre = Point2::Zero();
  double radius_mm = 1.0;
  double reference_rad = 0.0;  ///< a direction in which no arc of the path passes (full circle: begins)
};

struct PathSegment {};
/// Counter-clockwise about its centre.
struct PathArc {
  int circle = 0;  ///< index into OutlinePath::circles
};
struct PathSpline {
  PlaneSpline spline;  ///< runs from this piece's start to the next one's, to the last bit
};

/// One smooth piece; it ends where the next one starts. A whole circle is a path of one piece.
struct PathPiece {
  Point2 start = Point2::Zero();
  std::variant<PathSegment, PathArc, PathSpline> shape;
};

/// Closed, counter-clockwise, whatever the outline bounds.
struct OutlinePath {
  std::vector<PathCircle> circles;
  std::vector<PathPiece> pieces;
  double fit_error_mm = 0.0;  ///< largest distance from the true curves, left out pieces included
};

struct PathTolerance {
  double flank_mm = 1e-8;   ///< of an involute's spline: 0.00001 um, one Bezier span up to module 10
  double fillet_mm = 1e-7;  ///< of a trochoid's spline
  double lead_mm = 1e-7;    ///< of splines along the face, where the teeth change along it
  /// Shorter pieces of a half tooth are left out, their neighbours meet: kernels with a resolution of
  /// 1e-5 mm would take them for points.
  double shortest_mm = 5e-6;
};

/// Tip, root and fillet arcs of a ring are single arcs across the middle of tooth and gap; every flank
/// and every fillet side is one spline. A toothing that changes along the face: its section at mid
/// face, turned by its twist there; deviated flanks are split where the deviation bends, and a ring's
/// fillet arcs are splines then.
/// Accuracy: fit_error_mm, tested against the profile's own curves in tests/solid/outline_path_test.cpp.
[[nodiscard]] OutlinePath outline_path(const Outline& outline, const PathTolerance& tolerance = {});

/// A polygon through the path, for tests of what lies within what. Accuracy: 1 um for gears up to
/// module 10; vertices are on the path.
[[nodiscard]] std::vector<Point2> path_polygon(const OutlinePath& path);
[[nodiscard]] bool contains(const std::vector<Point2>& polygon, const Point2& point);

}  // namespace trueflank
