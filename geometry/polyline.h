// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {

/// Vertices on a half tooth (see ToothProfile), all exactly on the curve.
struct HalfToothPolyline {
  /// Edge i joins points i and i + 1 along one piece of the profile.
  struct Edge {
    int piece = 0;                ///< index of the profile piece
    double from = 0.0, to = 0.0;  ///< parameters of its ends on that piece
  };
  std::vector<Point2> points;  ///< from the tooth's middle (angle 0) to the gap's middle (pi/z)
  std::vector<Edge> edges;
  double chord_error_mm = 0.0;  ///< largest distance between polyline and curve
  /// Middle of the tip land / of the root arc is a vertex (true where the arc needs an even count
  /// of edges); otherwise one edge straddles it and the mirror image supplies its other end.
  bool vertex_at_tooth_middle = true;
  bool vertex_at_gap_middle = true;
};

/// Closed polygon of a whole gear or ring section, counter-clockwise, one tooth after the other.
/// Tooth k (0-based) owns points [k n, (k + 1) n), n = points_per_tooth, starting at the clockwise
/// gap's end of the tooth, symmetric about its middle where the profile is.
struct SectionPolygon {
  std::vector<Point2> points;
  int teeth = 0;
  int points_per_tooth = 0;
  double chord_error_mm = 0.0;
};

/// The fewest vertices on each smooth piece that keep the chord error within the tolerance, spread so
/// that all chords of a piece have the same error. Joints of pieces (but the two middles) are vertices;
/// a piece shorter than a quarter of the tolerance is skipped, its ends are one vertex.
/// Requires: tolerance_mm > 0.
/// Guarantees: distance polyline to curve and curve to polyline <= tolerance, both ways.
[[nodiscard]] HalfToothPolyline tessellate(const ToothProfile& profile, double tolerance_mm);

/// The half tooth with vertices in the middles of tooth and gap, whatever its arcs ask for: halves that
/// are no mirror images join there.
[[nodiscard]] HalfToothPolyline with_middles(HalfToothPolyline half, const ToothProfile& profile);

/// All teeth. Frame: gear axis at the origin, tooth 1 centred on the direction `rotation_rad`.
[[nodiscard]] SectionPolygon section_polygon(const ToothProfile& profile, double tolerance_mm,
                                             double rotation_rad = 0.0);

/// Fewest equal chords of a full circle within a tolerance (vertices on the circle); at least 8.
[[nodiscard]] int circle_segments(double radius_mm, double tolerance_mm);

}  // namespace trueflank
