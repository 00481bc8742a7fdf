// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "trueflank/solid/mesh/triangle_mesh.h"

namespace trueflank {

/// What is right and wrong with a mesh as the boundary of a solid.
struct MeshValidity {
  bool indices_in_range = true;
  bool coordinates_finite = true;
  std::size_t open_edges = 0;          ///< half-edges without a partner
  std::size_t misoriented_edges = 0;   ///< half-edges run twice the same way
  std::size_t non_manifold_vertices = 0;  ///< whose triangles form more than one fan
  std::size_t degenerate_triangles = 0;   ///< without area, or with a vertex used twice
  std::size_t unused_vertices = 0;
  std::size_t components = 0;
  double smallest_altitude_mm = 0.0;
  double volume_mm3 = 0.0;

  /// Closed, oriented, 2-manifold, outward, no degenerate triangle. Says nothing about surfaces that
  /// cross: part_mesh() excludes that by construction, the tests prove it with CGAL.
  [[nodiscard]] bool valid() const {
    return indices_in_range && coordinates_finite && open_edges == 0 && misoriented_edges == 0 &&
           non_manifold_vertices == 0 && degenerate_triangles == 0 && volume_mm3 > 0.0;
  }
};

/// Cost: linear in the triangles.
[[nodiscard]] MeshValidity mesh_validity(const TriangleMesh& mesh);

}  // namespace trueflank
