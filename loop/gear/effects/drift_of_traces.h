// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace trueflank::loop::gear_effects {

/// Shape values of a drift over the traces of some teeth, in the order of these
/// (unnamed_drift_of_traces): in which order their flanks come, within which share of the traces it
/// levels off (0: it is even), where it is nothing (columns.h), and from there on the teeth.
enum DriftOfTraces : std::size_t { kFlanksInTurn, kDriftWithin, kZeroOfTraces, kTeethInTurn };

/// Orders in which the flanks come (kFlanksInTurn): both of a tooth alike; of each tooth the left
/// one first, the right one first; all left ones first, all right ones first.
enum FlanksInTurn : int {
  kAlike,
  kLeftOfEachFirst,
  kRightOfEachFirst,
  kAllLeftFirst,
  kAllRightFirst
};
inline constexpr int kFlankOrders = 5;

/// How far a drift is on one of so many traces, the first is 0: from 0 to 1.
[[nodiscard]] double drift_at_trace(double trace, double traces, double within);
/// Which trace that of a flank is, of a tooth that comes as that many-th (both from 0 on), and of
/// how many.
[[nodiscard]] double trace_in_turn(int flanks, double tooth, double teeth, bool left);
[[nodiscard]] double traces_in_turn(int flanks, double teeth);

}  // namespace trueflank::loop::gear_effects
