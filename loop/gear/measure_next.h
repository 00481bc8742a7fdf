// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/gear/observations.h"
#include "trueflank/loop/result/loop_result.h"

namespace trueflank::loop {

/// For what is confounded or hidden, or rests on one value: the measurement that would tell (one
/// sentence each). What the table has is not asked for, but for more of the same where all that
/// would tell was measured.
[[nodiscard]] std::vector<std::string> measurements_that_separate(
    const std::vector<FoundEffect>& effects, const std::vector<std::string>& not_observable,
    const Observations& table);

}  // namespace trueflank::loop
