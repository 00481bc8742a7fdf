// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// About how many facets a part's mesh will have, estimated without meshing it.
/// Accuracy: within a factor of three for parts of a thousand facets and more, tested in
/// tests/solid/mesh_estimate_test.cpp. Cost: that of one section of a tooth; where
/// teeth are displaced, that of bend_cuts(), too.
[[nodiscard]] double estimated_facets(const PartShape& shape, double tolerance_mm);

}  // namespace trueflank
