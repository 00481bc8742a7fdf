// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/found_effects.h"

// What is said of a form, without data.
namespace trueflank::test {

inline loop::Effect effect_of(const std::string& family, loop::EffectShape shape,
                              loop::FlankChoice flank = loop::FlankChoice::kBoth) {
  return {loop::find_family(family), flank, std::move(shape)};
}
inline std::string said_of(const loop::FlankGeometry& g, const loop::Effect& effect,
                           const std::vector<double>& amounts = {}) {
  return loop::words_for(g, effect, amounts);
}

}  // namespace trueflank::test
