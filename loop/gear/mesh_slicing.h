// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/solid/mesh/triangle_mesh.h"

namespace trueflank::loop {

/// The mesh with every triangle cut at given heights: the same surface, with vertices where a
/// correction bends. A vertex on an edge is shared by both its triangles: closed stays closed.
[[nodiscard]] TriangleMesh sliced(const TriangleMesh& mesh, const std::vector<double>& heights_mm);

}  // namespace trueflank::loop
