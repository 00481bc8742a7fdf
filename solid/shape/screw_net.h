// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

// The facets of twisted teeth: which vertices of a screw surface are joined. Lengths along the
// surface enter as steps along the section and turns of the section about the axis. Source:
// docs/theory/helical-facets.md.
namespace trueflank {

/// The screw surface between two neighbouring columns (places of the section), counter-clockwise.
/// Supports are distances p.n of the axis from the section's tangent, square to it; signs as for a
/// circle about the axis, where support and radius of curvature are the radius.
struct NetEdge {
  int region = 0;            ///< neighbours with the same number lie on one smooth surface
  bool developable = false;  ///< turns and supports say all: a circle about the axis, an involute
  bool across =
      false;  ///< of a surface: joined from edge to edge of the patch, not column to column
  int strips =
      1;  ///< of a surface joined across: as many, one above the other, between rows of vertices
  bool in_chamfer = false;  ///< facets of rows lean by no more than a step; strips may be trapezia
  double length_mm = 0.0;
  double turn_rad = 0.0;  ///< of the section's normal on the way
  double support_mm = 0.0, support_from_mm = 0.0,
         support_to_mm = 0.0;  ///< in the middle, at the ends
  double cosine = 1.0;         ///< between the surface's normal and the section's plane
};

/// A vertex: column (those from the number of edges on are the next tooth's), and row: 0 on the
/// patch's lower edge, then the column's inner vertices, last the upper edge.
struct NetNode {
  int column = 0, row = 0;
};

/// A point of a surface and its normal there, of length 1.
struct NetPoint {
  Eigen::Vector3d at = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();
};
/// The surface of an edge at its beginning or end, at a height (share of the patch).
using NetSurface = std::function<NetPoint(int edge, bool at_end, double height)>;

/// The columns that have a vertex on the lower and on the upper edge of a patch, and the error from
/// which on strips are joined in other ways, too.
struct NetRows {
  std::vector<bool> lower, upper;
  double tolerance_mm = 0.0;
};

/// One tooth between two heights, from the beginning of a region on.
struct NetPatch {
  std::vector<std::vector<double>>
      inner;  ///< by column: heights of inner vertices, shares of the patch
  std::vector<std::array<NetNode, 3>> facets;  ///< counter-clockwise seen from the axis' outside
  std::vector<int> region;                     ///< of each facet
};

/// Joins the vertices. Developable regions are strips along their generators and have no vertices
/// but on their border: columns inside such a region have none in `inner`. Elsewhere neighbouring
/// columns are joined in bands. Of all ways to do that, the one of least error in the sum of fourth
/// powers. `turn_rad`: of the section from the lower to the upper edge. Requires: edges, their
/// number of columns.
[[nodiscard]] NetPatch net_patch(const std::vector<NetEdge>& edges,
                                 std::vector<std::vector<double>> inner, double turn_rad);
/// The same where the surface is no screw: errors are taken from its points and normals (a chord
/// departs by an eighth of the way along it that the normal makes between its ends). What is
/// marked as developable is a strip as above, though it need be so only nearly. All regions are
/// strips: columns inside them have vertices on the patch's edges alone, if at all. Requires: the
/// columns at the ends of regions on both rows.
[[nodiscard]] NetPatch net_patch(const std::vector<NetEdge>& edges,
                                 std::vector<std::vector<double>> inner, double turn_rad,
                                 const NetSurface& surface, const NetRows& rows);

/// Distance of a paraboloid from the triangle through its points, from its (signed) distances at
/// the middles of the edges. On saddles and cylinders the largest of these; on a dome the height
/// over the circumcentre, in the metric of its curvature.
[[nodiscard]] double triangle_error(double a, double b, double c);

}  // namespace trueflank
