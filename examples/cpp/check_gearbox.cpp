// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a design, lays it out, checks it, and says what fails or warns.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_file.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/gear_train.h"

int main(int argc, char** argv) {
  using namespace trueflank;
  const char* source = std::getenv("TRUEFLANK_SOURCE_DIR");
  const std::string path = argc > 1 ? argv[1]
                                    : std::string(source ? source : ".") +
                                          "/examples/bilateral_drive/design.toml";
  const auto train = read_design(path).and_then(lay_out);
  if (!train) {
    for (const Error& error : train.error())
      std::fprintf(stderr, "%s:%d: %s\n", error.file.c_str(), error.line, error.message.c_str());
    return 2;
  }
  const Findings findings = check_gearbox(*train);
  for (const Finding& finding : findings)
    if (finding.status != CheckStatus::kPass && finding.status != CheckStatus::kNotApplicable)
      std::printf("%s %s at %s: %s\n", to_text(finding.status), finding.id.c_str(),
                  finding.where.c_str(), finding.message.c_str());
  const EfficiencyResult efficient = efficiency(*train);
  std::printf("ratio %.4f, efficiency %.2f %% forward, %.2f %% backward\n",
              1.0 / member_speeds(*train).output, 100.0 * efficient.forward,
              100.0 * efficient.backward);
  return verdict(findings) == CheckStatus::kFail ? 1 : 0;
}
