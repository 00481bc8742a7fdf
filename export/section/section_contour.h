// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/solid/shape/part_shape.h"

// Outlines for drawings: closed contours of vertices with arcs between them.
namespace trueflank::io {

struct ContourVertex {
  Point2 point = Point2::Zero();
  /// Of the edge to the next vertex: tangent of a quarter of the arc's angle, positive where the arc
  /// runs counter-clockwise; 0: straight.
  double bulge = 0.0;
};

/// A closed curve, counter-clockwise: a whole circle, or vertices.
struct Contour {
  std::optional<CircleOutline> circle;
  std::vector<ContourVertex> vertices;
  double chord_error_mm = 0.0;  ///< largest distance of chord and outline, arcs left aside
};

/// The vertices lie on the outline and their chords within the tolerance of it, for readers that know
/// no arcs. With the arcs, circular pieces are exact and the others nearer by far: every edge's arc
/// passes through three points of the true curve.
/// Requires: tolerance_mm > 0.
[[nodiscard]] Contour contour_of(const Outline& outline, double tolerance_mm);

/// The contour turned and moved.
[[nodiscard]] Contour placed(Contour contour, double rotation_rad, const Point2& translation);

/// Smallest upright box around the chords (around a circle exactly).
struct Box2 {
  Point2 low = Point2::Constant(1e300), high = Point2::Constant(-1e300);
};
void include(Box2& box, const Contour& contour);

/// One body's (or part's) outlines at one height.
struct SectionBody {
  std::string name;
  PartRole role = PartRole::kOther;
  Contour outer;
  std::vector<Contour> holes;
  bool frozen = false;  ///< DXF: on a frozen layer, to be looked at and not to be cut
};
/// All that one plane cuts.
struct Section {
  std::string name;  ///< "section 1"
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  std::vector<SectionBody> bodies;
};

/// A part's sections, bottom to top: one a slab.
[[nodiscard]] std::vector<Section> part_sections(const PartShape& part, double tolerance_mm);

/// Sections of the assembly where gears mesh: one a layer of teeth, bottom to top.
[[nodiscard]] std::vector<Section> assembly_sections(const PartShapes& shapes, double tolerance_mm);

}  // namespace trueflank::io
