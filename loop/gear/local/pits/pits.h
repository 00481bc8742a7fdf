// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Many pits or lumps on the flanks of scans, and how likely chance makes as many.
struct Pits {
  Effect effect;
  double p_value = 1.0;
};

/// Round places that lie back (or stand out) beyond doubt, at random over the flanks, beside what
/// the flanks have in common and what each has smoothly by itself. None where they are few, where
/// as many lie to the other side, where they are not round, line up over the flanks, or cover much
/// of them.
[[nodiscard]] std::optional<Pits> pits_of_scans(const FlankGeometry& geometry,
                                                const Observations& table);

}  // namespace trueflank::loop
