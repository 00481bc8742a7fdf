// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/report/drawing/sheet.h"
#include "trueflank/solid/shape/part_shape.h"

// What of a part or of an assembly is seen from below, along +z, and what lies hidden behind it.
namespace trueflank::io {

/// A part where it stands; nothing is owned.
struct ViewedBody {
  const PartShape* part = nullptr;
  double rotation_rad = 0.0;
  Point2 offset = Point2::Zero();
  double z_mm = 0.0;
};

/// A stretch of an edge, in the frame of the bodies: an arc, or the corners of a bore that is not round.
struct ViewedEdge {
  Point2 centre = Point2::Zero();
  double radius_mm = 0.0;
  double from_rad = 0.0, to_rad = 0.0;  ///< counter-clockwise; 0 and 2 pi: the whole circle
  std::vector<Point2> corners;          ///< closed; empty: an arc
  Pen pen = Pen::kThick;                ///< by ISO 2203: tip circle thick, reference circle chain, root circle thin
  bool hidden = false;
  bool hole_off_axis = false;           ///< of its part: a hidden one is worth its dashes
};

/// Edges of the lower faces of all slabs, nearest first, each circle once. A toothing hides what a disc
/// with its tip circle hides: where teeth mesh, both tip circles are seen.
/// Accuracy: ends of arcs to 1e-6 rad; stretches below half a degree may be missed.
[[nodiscard]] std::vector<ViewedEdge> view_from_below(const std::vector<ViewedBody>& bodies);

/// Where a view stands on the sheet: x points up, y to the right.
struct ViewPlace {
  Point2 centre = Point2::Zero();
  double scale = 1.0;
  [[nodiscard]] Point2 operator()(const Point2& p) const { return centre + scale * Point2(p.y(), p.x()); }
};
/// What is seen, and hidden holes off the axis of their part in dashes.
void draw_view(Sheet& sheet, const std::vector<ViewedEdge>& edges, const ViewPlace& place);

}  // namespace trueflank::io
