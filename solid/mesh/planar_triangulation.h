// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trueflank/geometry/point2.h"

namespace trueflank {

using IndexTriangle = std::array<std::uint32_t, 3>;

/// Triangulates a polygon by ear clipping.
/// Requires: a simple polygon, counter-clockwise, as indices into points; it may touch itself along an
/// edge used both ways (a cut to a hole, a bridge).
/// Guarantees: counter-clockwise triangles that cover the polygon. Cost: number of vertices times number
/// of reflex ones; meant for the small polygons of one tooth or one hole.
[[nodiscard]] std::vector<IndexTriangle> clip_ears(const std::vector<Point2>& points,
                                                   const std::vector<std::uint32_t>& polygon);

/// Flips edges until the triangulation is constrained Delaunay: no triangulation of the same points
/// within the same boundary has a larger smallest angle. Edges with one triangle are the boundary.
/// Requires: counter-clockwise triangles; an edge has at most two.
void make_delaunay(const std::vector<Point2>& points, std::vector<IndexTriangle>& triangles);

}  // namespace trueflank
