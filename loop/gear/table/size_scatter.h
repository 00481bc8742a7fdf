// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/observations.h"
#include "trueflank/loop/measured/measurement.h"

namespace trueflank::loop {

/// A size in the table.
struct SizeInTable {
  std::size_t row = 0;
  SizeQuantity quantity = SizeQuantity::kSpan;
  double detail = kNaN;  ///< teeth spanned, or pin diameter
};

/// A size is measured at some teeth, the file does not say which, and stands for all of them in the
/// fit. So its error is more than the device's where teeth differ: by what the index, if there is
/// one, says of such sizes around the gear, and by how far repeated sizes scatter beyond their
/// errors (the ratio of Birge, Phys. Rev. 40, 207, 1932). Sets the sizes' sigmas and `size_degrees`
/// of the table. Returns a sentence for the notes where repeated sizes scatter, else nothing.
[[nodiscard]] std::string widen_size_errors(const FlankGeometry& geometry,
                                            const std::vector<SizeInTable>& sizes,
                                            Observations& table);

}  // namespace trueflank::loop
