// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

// What of a change a design's verdict needs; the last step of the joint cure.
namespace trueflank {

struct JudgedDesign {
  GearboxDesign design;
  Findings findings;  ///< of every check
};

/// Every check of a design; nothing where it cannot be made.
using DesignJudge = std::function<std::optional<Findings>(const GearboxDesign&)>;

/// A changed design with every single key as it was, or nearer to what it was, for which the
/// findings get no worse: nothing else fails or warns. Keys are taken back one after the other, the
/// most expensive first, until none can be. `most_judged`: how often the judge may be asked. Guarantees:
/// taking back one more key that was changed brings a failure or a warning, unless the judge was
/// asked that often.
[[nodiscard]] JudgedDesign with_needed_changes(const GearTrain& before, JudgedDesign changed,
                                               const DesignJudge& judge, int most_judged);

}  // namespace trueflank
