// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/observations.h"

// Patterns of some teeth that repeat around the gear, in values one a tooth.
namespace trueflank::loop {

/// A value of every tooth: the sum of what was measured there, and how many values that were.
struct ValuesOfTeeth {
  std::vector<double> sum, count;  ///< of tooth 1, 2, ...

  /// Of index values [um] of some flanks, a residual for each row of the table; `opposite`: of how
  /// far teeth stand aside.
  ValuesOfTeeth(const FlankGeometry& geometry, const Observations& table,
                const std::vector<float>& residual_um, FlankChoice flank, bool opposite);
};

/// The shapes (effects/repeating_pattern.h) that leave least of the values, the best first: of all
/// numbers of teeth, and of all teeth to begin at where that matters. Each has the means of its own
/// teeth. At most `most`; none of fewer than two turns of a pattern, of a tooth that was not
/// measured, or that leave fewer than four values a pattern does not have.
[[nodiscard]] std::vector<EffectShape> repeating_patterns(const ValuesOfTeeth& values,
                                                          bool opposite, std::size_t most);

/// The same pattern with other means; as it is where a tooth of it was not
/// measured, or all are alike.
[[nodiscard]] EffectShape with_means_of(const EffectShape& shape, const ValuesOfTeeth& values);

}  // namespace trueflank::loop
