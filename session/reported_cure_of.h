// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include "trueflank/check/cure/joint_cure.h"
#include "trueflank/report/reported_cure.h"

namespace trueflank {

/// A cure in the keys of the design file, with its costs.
[[nodiscard]] io::ReportedCure reported_cure_of(const GearTrain& before, const JointCure& cure);

/// Of the parts around the gears of a design with [housing], none of another; nothing where parts
/// cannot be made.
[[nodiscard]] std::optional<Findings> findings_around(const GearTrain& gears);

/// Looks for the one change that mends a failing train, as long as a check may take, and takes
/// those cures from the findings that it makes needless: what is left stays true after the change.
/// `findings`: of the parts around the gears too.
[[nodiscard]] io::ReportedCure take_joint_cure(const GearTrain& train, Findings& findings);

}  // namespace trueflank
