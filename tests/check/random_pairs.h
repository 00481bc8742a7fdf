// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "trueflank/train/gear_train.h"

namespace trueflank::test {

/// A random design of any kind that a designer might try: standard and odd shifts, undercut, thinned,
/// sharp and round tools, fillet and shaper rings, tips too long, distances slightly wrong, 3k sets.
/// The same seed gives the same design. Not every one can be laid out.
[[nodiscard]] GearboxDesign random_design(std::uint64_t seed);

/// The design in a line, for messages.
[[nodiscard]] std::string describe(const GearboxDesign& design);

}  // namespace trueflank::test
