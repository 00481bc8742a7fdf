// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/units.h"

namespace trueflank {

enum class CheckStatus { kPass, kWarn, kFail, kNotApplicable };

/// What one check found at one place (docs/checks.md lists the ids).
struct Finding {
  std::string id;     ///< "tip_clearance", ...
  std::string where;  ///< a gear's name, a mesh's (planet2-ring2) or "train"
  CheckStatus status = CheckStatus::kPass;
  double value = kNaN;
  double limit = kNaN;
  double margin = kNaN;  ///< how far on the good side of the limit, in `unit`; negative: beyond it
  std::string unit = {};     ///< "mm", "um", "deg", "" for pure numbers
  std::string message = {};  ///< what was found, with its numbers and place
  std::string cure = {};     ///< what would mend it, by how much; empty where nothing needs mending
};

using Findings = std::vector<Finding>;

[[nodiscard]] const char* to_text(CheckStatus status);
/// What was found anew, in the place of what the same checks said before.
void renew_findings(Findings& findings, const Findings& anew);
/// fail where any finding fails, else warn where any warns, else pass.
[[nodiscard]] CheckStatus verdict(const Findings& findings);

}  // namespace trueflank
