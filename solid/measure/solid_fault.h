// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/solid/mesh/triangle_mesh.h"

namespace trueflank {

/// Why a mesh is not the boundary of a solid.
enum class SolidFault {
  kNone,
  kBroken,         ///< not closed, not 2-manifold, triangles without area or numbers that are none
  kInsideOut,      ///< its facets look inwards
  kCrossesItself,  ///< facets go through each other
};

/// In a few words: "crosses itself".
[[nodiscard]] const char* to_text(SolidFault fault);

/// The first of the faults that a mesh has. Whether facets cross is answered exactly for the
/// coordinates as they are. Cost: some seconds for a million triangles.
[[nodiscard]] SolidFault solid_fault(const TriangleMesh& mesh);

}  // namespace trueflank
