// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/joint_cure.h"
#include "trueflank/report/reported_cure.h"

namespace trueflank {

/// A cure in the keys of the design file, with its costs.
[[nodiscard]] io::ReportedCure reported_cure_of(const GearTrain& before, const JointCure& cure);

/// Looks for the one change that mends a failing train, as long as a check may take, and takes those cures from the
/// findings that it makes needless: what is left stays true after the change.
[[nodiscard]] io::ReportedCure take_joint_cure(const GearTrain& train, Findings& findings);

}  // namespace trueflank
