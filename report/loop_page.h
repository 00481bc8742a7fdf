// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/result/loop_result.h"

// What the pages of a gear's and of a drive's loop have in common, in the style of report.html.
namespace trueflank::loop {

/// Head and style, verdict and figures, every effect in words with its intervals, what is left. What the
/// page itself found not to add up stands in the alarm with what the result tells.
[[nodiscard]] std::string loop_page_opening(const LoopResult& result, const std::string& heading,
                                            const std::vector<std::string>& not_adding_up = {});
/// The printed text, and loop_json() whole (script element "loop-data", '<' written as \u003c).
[[nodiscard]] std::string loop_page_end(const LoopResult& result);

}  // namespace trueflank::loop
