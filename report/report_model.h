// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/report/report_html.h"

namespace trueflank::io {

/// What the page draws, as JSON (templates/report/README.md says what its scripts read): outlines of
/// one tooth, bodies with their places and speeds, lines of action, drive torques, tolerances.
[[nodiscard]] std::string report_model_json(const Report& report, const HtmlModel& model);

}  // namespace trueflank::io
