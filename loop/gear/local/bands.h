// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/local/patches.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Bands that come again over the face with sharp edges, or a flight of steps, and how likely
/// chance makes them.
struct Bands {
  Effect form;  ///< unnamed_bands, unnamed_flight
  double p_value = 1.0;
  double amount_um = 0.0;
};

/// What scanned flanks and helix traces have in common over the face, of values that are not held
/// out; on both flanks alike or opposite, or on one. It says more than a wave with its second,
/// third and fourth multiple, and than a sawtooth or arches of any period. `row_um`: what is left
/// in every row of the table.
[[nodiscard]] std::optional<Bands> bands_over_face(const FlankGeometry& geometry,
                                                   const Observations& table,
                                                   const Patches& patches,
                                                   const std::vector<float>& row_um);

}  // namespace trueflank::loop
