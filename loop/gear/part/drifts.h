// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Teeth that drift aside as one body, and a wave that does not close, are drifts, sectors, waves
/// and odd teeth together.
[[nodiscard]] bool tell_as_drift_aside(PartModel& model);
/// A drift beside larger effects, or on one flank, is not seen before waves of several orders, and
/// odd teeth where it begins anew, have taken it up: together they are tried against it.
[[nodiscard]] bool tell_as_drift(PartModel& model);

}  // namespace trueflank::loop
