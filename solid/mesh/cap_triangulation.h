// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/solid/mesh/planar_triangulation.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {

/// A plane face between closed loops. Vertex numbers: the outer loop's points, then each hole's, in
/// their order, then the points added inside.
struct CapTriangulation {
  std::vector<Point2> added_points;        ///< inside the face, on no loop
  std::vector<IndexTriangle> triangles;    ///< counter-clockwise
};

/// Triangulates the face between an outer loop and its holes.
/// How: teeth are separated from the rest by a polygon of added points on a circle between root and
/// what lies behind it; one tooth is triangulated and the others are copies; what is left is
/// bounded by star-shaped loops and zipped by angle, cut into sectors where there are holes beside
/// the axis; holes that have no sector of their own are joined by bridges, the nearest first. Each zone is constrained Delaunay. Cost: linear in the points.
/// Requires: at most one hole about the outer loop's centre; every other hole is a circle; a circle
/// about that centre fits between any two loops about it, and no two holes touch.
[[nodiscard]] CapTriangulation triangulate_cap(const OutlineLoop& outer,
                                               const std::vector<const OutlineLoop*>& holes);

}  // namespace trueflank
