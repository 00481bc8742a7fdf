// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a design, lays it out, checks it, and says what fails or warns.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "trueflank/session/evaluate.h"

int main(int argc, char** argv) {
  using namespace trueflank;
  const char* source = std::getenv("TRUEFLANK_SOURCE_DIR");
  const std::string path = argc > 1 ? argv[1]
                                    : std::string(source ? source : ".") +
                                          "/examples/bilateral_drive/design.toml";
  const auto gearbox = Gearbox::read(path);
  if (!gearbox) {
    for (const Error& error : gearbox.error())
      std::fprintf(stderr, "%s:%d: %s\n", error.file.c_str(), error.line, error.message.c_str());
    return 2;
  }
  const io::Report report = evaluate(*gearbox);
  for (const Finding& finding : report.findings)
    if (finding.status != CheckStatus::kPass && finding.status != CheckStatus::kNotApplicable)
      std::printf("%s %s at %s: %s\n", to_text(finding.status), finding.id.c_str(),
                  finding.where.c_str(), finding.message.c_str());
  std::printf("ratio %.4f, efficiency %.2f %% forward, %.2f %% backward\n",
              1.0 / gearbox->train().speeds.output, 100.0 * report.efficiency.forward,
              100.0 * report.efficiency.backward);
  return verdict(report.findings) == CheckStatus::kFail ? 1 : 0;
}
