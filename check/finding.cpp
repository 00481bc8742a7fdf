// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/finding.h"

#include <algorithm>

namespace trueflank {

const char* to_text(CheckStatus status) {
  switch (status) {
    case CheckStatus::kPass: return "pass";
    case CheckStatus::kWarn: return "warn";
    case CheckStatus::kFail: return "fail";
    case CheckStatus::kNotApplicable: return "not_applicable";
  }
  return "";
}

void renew_findings(Findings& findings, const Findings& anew) {
  std::erase_if(findings, [&](const Finding& old) {
    return std::any_of(anew.begin(), anew.end(), [&](const Finding& f) { return f.id == old.id; });
  });
  findings.insert(findings.end(), anew.begin(), anew.end());
}

CheckStatus verdict(const Findings& findings) {
  CheckStatus worst = CheckStatus::kPass;
  for (const Finding& finding : findings) {
    if (finding.status == CheckStatus::kFail) return CheckStatus::kFail;
    if (finding.status == CheckStatus::kWarn) worst = CheckStatus::kWarn;
  }
  return worst;
}

}  // namespace trueflank
