// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/check/cure_survey.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>

#include "tests/check/random_pairs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/joint_cure.h"

namespace trueflank::test {
namespace {

int failing_in(const Findings& findings) {
  return static_cast<int>(std::count_if(findings.begin(), findings.end(),
                                        [](const Finding& f) { return f.status == CheckStatus::kFail; }));
}

}  // namespace

CureSurvey survey_cures(std::uint64_t first_seed, int failing) {
  CureSurvey survey;
  std::map<std::string, int> left;
  for (std::uint64_t seed = first_seed; survey.failing < failing; ++seed) {
    const auto train = lay_out(random_design(seed));
    if (!train) continue;
    const Findings before = check_gearbox(*train);
    if (failing_in(before) == 0) continue;
    ++survey.failing;
    const auto start = std::chrono::steady_clock::now();
    const JointCure cure = joint_cure(*train);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    survey.seconds += seconds;
    survey.longest_s = std::max(survey.longest_s, seconds);
    const auto after = lay_out(cure.design);
    const int now = after ? failing_in(check_gearbox(*after)) : 1000;
    if (now == 0) ++survey.cured;
    if (now > failing_in(before)) ++survey.worse;
    if (now != failing_in(cure.findings)) ++survey.claims_broken;
    if (now == 0) continue;
    for (const Finding& f : cure.findings)
      if (f.status == CheckStatus::kFail) ++left[f.id];
    std::printf("seed %llu (%.1f s): %d fail, then %d: %s\n  %s\n", static_cast<unsigned long long>(seed), seconds,
                failing_in(before), now, cure.conflict.c_str(), describe(train->design).c_str());
  }
  std::printf("%d failing designs, %d cured, %d made worse, %d claims broken; %.2f s a design, longest %.1f s\n",
              survey.failing, survey.cured, survey.worse, survey.claims_broken, survey.seconds / survey.failing,
              survey.longest_s);
  for (const auto& [id, times] : left) std::printf("  %s still fails in %d\n", id.c_str(), times);
  return survey;
}

}  // namespace trueflank::test
