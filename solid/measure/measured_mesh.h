// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/solid/mesh/gear_mesh.h"

namespace trueflank {

/// A part's mesh and how far it was found to be from the true surface.
struct MeasuredMesh {
  PartMesh part;
  double accuracy_mm = kNaN;  ///< the larger of both ways, measured (mesh_accuracy.h)
};

/// part_mesh(), measured; where the tolerance was missed the part is meshed again, finer, until it
/// is kept. The mesher takes its errors from few places of a facet: where teeth are bent by several
/// modifications at once that may be too few.
/// Guarantees: at most a few rounds. Where none keeps the tolerance, the most accurate mesh: the
/// caller compares accuracy_mm with what was asked for.
[[nodiscard]] MeasuredMesh measured_part_mesh(const PartShape& shape,
                                              const MeshOptions& options = {});

}  // namespace trueflank
