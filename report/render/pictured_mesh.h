// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "trueflank/solid/mesh/triangle_mesh.h"

namespace trueflank::io {

/// A mesh with the normals by which it is lit.
struct PicturedMesh {
  TriangleMesh mesh;
  /// One a corner of every triangle: facets that meet in less than a crease share theirs, so that
  /// walls look as round as they are.
  std::vector<std::array<Eigen::Vector3f, 3>> normals;
};

/// Requires: a closed, outward mesh.
[[nodiscard]] PicturedMesh pictured_mesh(TriangleMesh mesh);

}  // namespace trueflank::io
