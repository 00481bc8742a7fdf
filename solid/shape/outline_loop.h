// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// An outline as a closed polygon, counter-clockwise; every vertex lies on the outline, every corner
/// of the outline is a vertex.
struct OutlineLoop {
  std::vector<Point2> points;
  int teeth = 0;             ///< 0: no teeth
  int points_per_tooth = 0;  ///< tooth k owns points [k n, (k + 1) n), see SectionPolygon
  bool teeth_alike = true;   ///< teeth are turned copies of the first
  double chord_error_mm = 0.0;
  /// The polygon lies between these circles about `centre`, and is star-shaped seen from there
  /// unless it has teeth.
  Point2 centre = Point2::Zero();
  double inner_radius_mm = 0.0, outer_radius_mm = 0.0;
};

/// Whether the section away from the end faces is the profile itself: no deviation, no displacement.
[[nodiscard]] bool has_profile_section(const ToothedOutline& outline);
/// Whether every section is the profile itself, not turned: no twist and no chamfer either.
[[nodiscard]] bool is_plain_prism(const ToothedOutline& outline);

/// Circles about the outline's centre between which it lies (the true curve, not a polygon).
struct OutlineExtent {
  Point2 centre = Point2::Zero();
  double inner_radius_mm = 0.0, outer_radius_mm = 0.0;
};
[[nodiscard]] OutlineExtent extent(const Outline& outline);

/// A circle or bore moved outwards (inwards where negative); corners stay sharp.
/// Requires: no teeth.
[[nodiscard]] Outline grown(Outline outline, double by_mm);
/// A circle or bore as it is at a height of the part: its bed chamfer is in its size.
/// Requires: no teeth.
[[nodiscard]] Outline outline_at_height(const Outline& outline, double z_mm);
/// Up to which height of the part the bed chamfer of an outline reaches; 0: none.
[[nodiscard]] double bed_height_mm(const Outline& outline);

/// True where two outlines are one and the same curve.
[[nodiscard]] bool same_outline(const Outline& a, const Outline& b);

/// Largest distance from the axis to a bore's edge: the corner of keyway and hexagon; 0 without bore.
[[nodiscard]] double largest_radius_mm(const BoreDesign& bore);

/// A straight edge of a bore or an arc of its circle; arcs run counter-clockwise about the axis.
struct BoreEdge {
  Point2 from, to;
  bool arc = false;
};
/// The edges of a bore, counter-clockwise, joined end to start. A round bore is one arc from +x to +x.
/// Requires: diameter > 0 and a variant that part_shapes() accepts.
[[nodiscard]] std::vector<BoreEdge> bore_edges(const BoreDesign& bore);

/// A toothing with a deviation: its section at mid face; a twisted one: as it stands at the lower face.
/// Requires: tolerance_mm > 0.
/// Guarantees: distance polygon to outline and outline to polygon <= chord_error_mm <= tolerance, with
/// the fewest vertices on each smooth piece, but `least_segments` at least on a whole circle.
[[nodiscard]] OutlineLoop outline_loop(const Outline& outline, double tolerance_mm,
                                       int least_segments = 8);

/// The loop about a centre through points that are known, with its radii.
[[nodiscard]] OutlineLoop loop_through(std::vector<Point2> points,
                                       const Point2& centre = Point2::Zero());

}  // namespace trueflank
