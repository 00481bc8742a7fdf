// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/sample_bench.h"
#include "tests/support/survey_size.h"

// Counts over many benches; the larger counts are in docs/drive-loop.md.
namespace trueflank::test {
namespace {

int false_alarms(BenchPlan plan, int runs) {
  int alarms = 0;
  for (int run = 1; run <= runs; ++run) {
    plan.seed = 1000 + static_cast<std::uint64_t>(run);
    const auto closed = close_hidden({}, plan);
    if (closed->result.verdict == loop::Verdict::kNoEffect) continue;
    ++alarms;
    std::printf("alarm of seed %d\n", 1000 + run);
  }
  return alarms;
}

const int kNull = survey_size(40, 200), kMost = kNull / 20;

TEST(DriveStatistics, FalseAlarmsAreRare) { EXPECT_LE(false_alarms({}, kNull), kMost); }

TEST(DriveStatistics, FalseAlarmsAreRareWhereTheNoiseGoesOnFromRowToRow) {
  for (const double correlation : {0.3, 0.6})
    for (const bool shuffled : {true, false})
      EXPECT_LE(false_alarms({.noise_correlation = correlation, .shuffled = shuffled}, kNull),
                kMost)
          << "correlation " << correlation << (shuffled ? ", shuffled" : ", in the sweep's order");
}

TEST(DriveStatistics, IntervalsCover) {
  HiddenDrive drive;
  drive.friction = [](auto&, int) { return 0.12; };
  drive.loss_nm = [](auto&) { return 0.003; };
  int found_both = 0, friction = 0, drag = 0;
  const int kRuns = survey_size(20, 60);
  for (int run = 1; run <= kRuns; ++run) {
    BenchPlan plan;
    plan.seed = 5000 + static_cast<std::uint64_t>(run);
    const auto closed = close_hidden(drive, plan);
    const loop::FoundEffect* mu = found(closed->result, "friction_coefficient");
    const loop::FoundEffect* torque = found(closed->result, "drag_torque");
    if (mu == nullptr || torque == nullptr) continue;
    ++found_both;
    const loop::Parameter *value = parameter(*mu, "value"), *t = parameter(*torque, "torque_nm");
    friction += value->low <= 0.12 && 0.12 <= value->high;
    drag += t->low <= 0.003 && 0.003 <= t->high;
  }
  EXPECT_GE(60 * found_both, 55 * kRuns);
  // 95 % of 60: below 51 comes once in 2000 trials.
  EXPECT_GE(60 * friction, 51 * found_both);
  EXPECT_GE(60 * drag, 51 * found_both);
}

}  // namespace
}  // namespace trueflank::test
