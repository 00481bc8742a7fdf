// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/measured/measurement.h"

namespace trueflank::loop {

/// A file of a part that has all rows of an earlier one, to the last digit, is a copy: it is left
/// out. Returns what is to be said of it.
[[nodiscard]] std::vector<std::string> leave_out_copies(std::vector<InspectionData>& inspections);

/// Rows of a file that stand there twice to the last digit are one measurement: they are counted
/// once. Where one place was measured again with another value, equal values are chance, and stay.
/// Traces that are about 1000 or 25.4 times smaller than all others, their scatter with them, are
/// in another unit: they are left out. Returns what is to be said of either.
[[nodiscard]] std::vector<std::string> leave_out_odd_rows(InspectionData& data);

}  // namespace trueflank::loop
