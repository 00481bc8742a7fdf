// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/remainder_around.h"

namespace trueflank::loop {

/// Neighbouring teeth that stand aside as one body: a scan put together of two views, halves of a
/// mould that do not meet, a blank that was clamped anew.
struct MovedSector {
  int first = 0, count = 0;  ///< teeth of the gear
  double p_value = 1.0;      ///< corrected for all sectors asked about
  double amount_um = 0.0;    ///< how far they stand aside
};

/// The likeliest, from the heights of both flanks of every tooth, beside the whole gear's own place,
/// turn and thickness: an F test. Nothing where a sector of another height or a drift says as much, or
/// other structure is left around the gear beside it: then it is a part of another form.
[[nodiscard]] std::optional<MovedSector> moved_sector(const FlankGeometry& geometry,
                                                      const std::vector<ToothMoments>& of_teeth);

}  // namespace trueflank::loop
