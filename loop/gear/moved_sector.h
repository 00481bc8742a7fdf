// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/local/patches.h"
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

/// Views of a scan that are each moved outwards by an amount of their own, of every number the
/// likeliest, and radii that drift once around: from the residuals of points by the direction in
/// which they lie.
[[nodiscard]] std::vector<Effect> views_and_spirals(const FlankGeometry& geometry,
                                                    const Observations& table,
                                                    const Patches& patches,
                                                    const std::vector<float>& row_um);

}  // namespace trueflank::loop
