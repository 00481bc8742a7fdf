// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/train/process.h"

// Ways of making a gear, as far as they differ in what can go wrong: they decide which causes a
// deviation can have.
namespace trueflank::loop {

/// A set of ways of making: bits.
using Makings = unsigned;

inline constexpr Makings kExtrusion = 1U << 0, kResin = 1U << 1, kPowder = 1U << 2,
                         kWireCutting = 1U << 3, kBeamCutting = 1U << 4, kHobbing = 1U << 5,
                         kShaping = 1U << 6, kGrinding = 1U << 7, kMilling = 1U << 8,
                         kMoulding = 1U << 9, kSintering = 1U << 10;
inline constexpr Makings kPrinting = kExtrusion | kResin | kPowder, kOnPlate = kExtrusion | kResin,
                         kGearMachines = kHobbing | kShaping | kGrinding,
                         kMachining = kGearMachines | kMilling,
                         kContourCutting = kWireCutting | kBeamCutting | kMilling,
                         kInMould = kMoulding | kSintering, kAnyMaking = (1U << 11) - 1;

/// A cause of an effect, and the ways of making that have it.
struct CauseOfMaking {
  Makings makings = kAnyMaking;
  std::string cause;
};

/// The way a process of this name makes: "fdm-0.4", "grinding", "cnc-hobbing"; nothing where the
/// name says none.
[[nodiscard]] std::optional<Makings> making_named(std::string_view process);
/// The same of a process of a design: one with a name of its own is told by whether it has layers
/// or a kerf.
[[nodiscard]] std::optional<Makings> making_of(const Process& process);

/// "printing", "cutting on a gear machine, milling"; "any process" for all.
[[nodiscard]] std::string making_text(Makings makings);

/// The causes that a way of making can have, joined; each with its ways of making in front where
/// several are left open. Empty: none.
[[nodiscard]] std::string causes_text(const std::vector<CauseOfMaking>& causes, Makings makings);

/// What the maker should do: `correction`, its first action that of the one way of making that is
/// left. Where several are left, or none of these, it stays as it is.
[[nodiscard]] std::string correction_text(const std::string& correction,
                                          const std::vector<CauseOfMaking>& by_making,
                                          Makings makings);

}  // namespace trueflank::loop
