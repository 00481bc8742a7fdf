// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/geometry/point2.h"
#include "trueflank/solid/mesh/triangle_mesh.h"

namespace trueflank {

/// A plane with its own axes: point (a, b) of it stands at origin + a u + b v.
/// Requires: u and v of unit length, at right angles.
struct SectionPlane {
  Eigen::Vector3d origin_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX(), v = Eigen::Vector3d::UnitY();
};

/// Where a plane cuts a mesh.
struct MeshSection {
  /// Closed polygons [mm] in the plane's axes, material on the left seen against u x v; the first
  /// corner is not repeated.
  std::vector<std::vector<Point2>> loops;
  bool closed = true;  ///< false: the mesh has gaps there, and pieces that do not close were left out
};

/// Vertices in the plane count as above it, so each loop is closed where the mesh is.
/// Requires: indices in range. Cost: linear in the triangles.
[[nodiscard]] MeshSection mesh_section(const TriangleMesh& mesh, const SectionPlane& plane);

/// Whether a point lies in the material of a section (even-odd rule).
[[nodiscard]] bool in_material(const MeshSection& section, const Point2& point);

}  // namespace trueflank
