// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/gear/close_loop.h"
#include "trueflank/loop/gear/table/shared_table.h"

namespace trueflank::loop {

/// What was measured of one part.
struct PartTable {
  std::string name;
  SharedTable table;
};

/// Closes the loop of several parts of one process.
/// The procedure runs on all parts together, then on each part with what was found for all in the model.
/// Every effect is fitted to each part alone; it repeats where its mean over the parts is larger than
/// its scatter between them allows a mean of zero (F test, 5 %): an effect that comes and goes with
/// random sign or phase passes in one case of twenty, whatever the number of parts. One-off effects are
/// told with their part. The error on a new part is that of each part under the mean of the others'
/// repeatable effects.
/// Requires: two parts or more. Derivation and limits: docs/decisions/0072-repeatable-effects.md.
[[nodiscard]] GearLoop close_loop_of_parts(const FlankGeometry& geometry,
                                           std::vector<PartTable> parts,
                                           const LoopOptions& options);

/// All parts in one table: scans first, sources and traces renumbered.
[[nodiscard]] Observations joined_table(const std::vector<const Observations*>& tables);

}  // namespace trueflank::loop
