// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/check/cure_survey.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <optional>
#include <string>

#include "tests/check/random_pairs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_edit.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"

namespace trueflank::test {
namespace {

int failing_in(const Findings& findings) {
  return static_cast<int>(std::count_if(findings.begin(), findings.end(),
                                        [](const Finding& f) { return f.status == CheckStatus::kFail; }));
}

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The cured design as a person gets it: written into the old file, read again.
std::optional<GearTrain> read_back(const GearboxDesign& before, const GearboxDesign& after) {
  const auto text = edited_design_text(design_file_text(before), "random.toml", after);
  if (!text) return std::nullopt;
  const auto file = read_design_file_text(*text, "random.toml");
  if (!file) return std::nullopt;
  auto train = lay_out(file->design);
  if (!train) return std::nullopt;
  return std::move(*train);
}

bool passed(const Findings& findings, const Finding& asked) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
    return f.id == asked.id && f.where == asked.where && f.status == CheckStatus::kPass;
  });
}

/// Checks that passed before and fail now.
int newly_failing(const Findings& before, const Findings& after) {
  return static_cast<int>(std::count_if(after.begin(), after.end(), [&](const Finding& f) {
    return f.status == CheckStatus::kFail && passed(before, f);
  }));
}

}  // namespace

CureSurvey survey_cures(std::uint64_t first_seed, int failing, const JointCureOptions& options) {
  CureSurvey survey;
  std::map<std::string, int> left;
  for (std::uint64_t seed = first_seed; survey.failing < failing; ++seed) {
    const auto train = lay_out(random_design(seed));
    if (!train) continue;
    const Findings before = check_gearbox(*train);
    if (failing_in(before) == 0) continue;
    ++survey.failing;
    const double start = processor_s();
    const JointCure cure = joint_cure(*train, before, options);
    const double seconds = processor_s() - start;
    survey.seconds += seconds;
    survey.longest_s = std::max(survey.longest_s, seconds);
    const auto after = read_back(train->design, cure.design);
    const Findings found = after ? check_gearbox(*after) : Findings{};
    const int now = after ? failing_in(found) : 1000;
    if (newly_failing(before, found) > 0) ++survey.newly_failing;
    if (now == 0) ++survey.cured;
    if (now > failing_in(before)) ++survey.worse;
    if (now != failing_in(cure.findings)) ++survey.claims_broken;
    if (now == 0) continue;
    for (const Finding& f : cure.findings)
      if (f.status == CheckStatus::kFail) ++left[f.id];
    std::printf("seed %llu (%.1f s): %d fail, then %d: %s\n  %s\n", static_cast<unsigned long long>(seed), seconds,
                failing_in(before), now, cure.conflict.c_str(), describe(train->design).c_str());
  }
  std::printf("%d failing designs, %d cured, %d made worse, %d with a check that passed before, %d claims broken;"
              " %.2f s of the processor a design, longest %.1f s\n",
              survey.failing, survey.cured, survey.worse, survey.newly_failing, survey.claims_broken,
              survey.seconds / survey.failing, survey.longest_s);
  for (const auto& [id, times] : left) std::printf("  %s still fails in %d\n", id.c_str(), times);
  return survey;
}

}  // namespace trueflank::test
