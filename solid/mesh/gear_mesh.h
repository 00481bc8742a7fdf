// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/solid/mesh/triangle_mesh.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

struct MeshOptions {
  /// Largest distance between a facet and the true surface, both ways. Where a wall of the part is
  /// thinner than a few tolerances, or the teeth are small, a smaller one is used.
  double tolerance_mm = 1e-3;
};

struct PartMesh {
  TriangleMesh mesh;
  /// Bound on the distance of every facet to the true surface and of the surface to the facets, all
  /// circles included: the largest chord height of the outlines.
  double chord_error_mm = 0.0;
};

/// What a part is meshed to where a tolerance is asked for: that, or less where its walls and teeth
/// are small.
[[nodiscard]] double meshing_tolerance_mm(const PartShape& shape, double tolerance_mm);

/// One closed shell of a part, built directly: no boolean operation, vertices shared.
/// Frame: the part's (PartShape).
/// Requires: slabs as part_shapes() makes them: stacked, touching, outlines that do not touch.
/// Guarantees: closed, 2-manifold, outward, no self-intersection; every vertex of a wall lies on the
/// true curve; faces are constrained Delaunay zone by zone. Cost: linear in the points.
[[nodiscard]] PartMesh part_mesh(const PartShape& shape, const MeshOptions& options = {});

}  // namespace trueflank
