// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Traces on one zero that stand higher from one to the next; where that is as even by the teeth
/// between them, a drift around the gear. Before anything was found.
[[nodiscard]] std::optional<RemainderFinding> drift_over_traces(const PartModel& model);
/// Teeth that drift aside as one body, and a wave that does not close, are drifts, sectors, waves
/// and odd teeth together.
[[nodiscard]] bool tell_as_drift_aside(PartModel& model);
/// A drift beside larger effects, or on one flank, is not seen before waves of several orders, and
/// odd teeth where it begins anew, have taken it up: together they are tried against it.
[[nodiscard]] bool tell_as_drift(PartModel& model);

/// A drift of a lean or a bow that begins anew every so many teeth, beside its mean: a form along
/// the flanks that grows evenly from nothing, and anew.
[[nodiscard]] bool tell_as_form_that_grows_anew(PartModel& model);

/// What differs from tooth to tooth by turns or drifts, about a mean that all teeth have by another
/// form or a name: the same from nothing, where that leaves as little. True where one was found.
[[nodiscard]] bool tell_from_nothing(PartModel& model);

}  // namespace trueflank::loop
