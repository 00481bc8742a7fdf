// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/report/build_guide.h"
#include "trueflank/solid/measure/bill_of_materials.h"

namespace trueflank::io {

/// The guide as one page with a picture a step, to be read on a screen or printed; it needs no
/// other file and no network. The same input, the same bytes.
[[nodiscard]] std::string build_html(const GearTrain& train, const PartShapes& shapes,
                                     const BuildGuide& guide, const BillOfMaterials& bill);

}  // namespace trueflank::io
