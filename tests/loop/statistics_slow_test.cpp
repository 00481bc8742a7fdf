// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/counted_runs.h"
#include "tests/support/survey_size.h"

// The claims of docs/loop.md, counted: at most 5 % false alarms, intervals of 95 % that hold the truth
// in 90 to 98 % of the runs. The seeds are fixed, so that a count is the same every time.
namespace trueflank::test {
namespace {

const int kRuns = survey_size(30, 200);

void expect_few_alarms(DataKind kind, double correlation) {
  const auto count = count_false_alarms(kind, correlation, kRuns);
  std::printf("%d alarms in %d runs\n", count.alarms, count.runs);
  EXPECT_LE(count.alarms, kRuns / 20) << "the first: " << count.first;
}

TEST(NullRuns, OfScansWithWhiteNoise) { expect_few_alarms(DataKind::kScan, 0.0); }
TEST(NullRuns, OfScansWithCorrelatedNoise) { expect_few_alarms(DataKind::kScan, 0.8); }
TEST(NullRuns, OfTracesWithWhiteNoise) { expect_few_alarms(DataKind::kTraces, 0.0); }
TEST(NullRuns, OfTracesWithCorrelatedNoise) { expect_few_alarms(DataKind::kTraces, 0.8); }
TEST(NullRuns, OfTracesOfFourTeeth) { expect_few_alarms(DataKind::kFourTeeth, 0.0); }

void expect_coverage(DataKind kind, double correlation) {
  const auto count = count_coverage(kind, correlation, kRuns);
  for (const auto& [name, n] : count.intervals)
    std::printf("%s: %.3f of %d\n", name.c_str(), count.share(name), n);
  std::printf("missed %d of %d\n", count.missed, count.runs);
  EXPECT_LE(count.missed, kRuns / 10);
  EXPECT_GE(count.share(), 0.90);
  EXPECT_LE(count.share(), 0.98);
  for (const auto& [name, n] : count.intervals) EXPECT_GE(count.share(name), 0.88) << name;
}

TEST(Intervals, OfScansWithWhiteNoise) { expect_coverage(DataKind::kScan, 0.0); }
TEST(Intervals, OfScansWithCorrelatedNoise) { expect_coverage(DataKind::kScan, 0.8); }
TEST(Intervals, OfTraces) { expect_coverage(DataKind::kTraces, 0.5); }

}  // namespace
}  // namespace trueflank::test
