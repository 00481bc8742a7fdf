// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/counted_runs.h"

// A small count of what statistics_slow_test.cpp counts at length.
namespace trueflank::test {
namespace {

TEST(Statistics, AlarmsAreRareWhereNothingIsHidden) {
  int alarms = 0;
  for (const DataKind kind : {DataKind::kScan, DataKind::kTraces})
    for (const double correlation : {0.0, 0.8}) {
      const auto count = count_false_alarms(kind, correlation, 8, 500);
      alarms += count.alarms;
      EXPECT_LE(count.alarms, 1) << count.first;
    }
  EXPECT_LE(alarms, 2);
}

TEST(Statistics, IntervalsHoldTheTruthMostly) {
  const auto count = count_coverage(DataKind::kScan, 0.0, 12, 900);
  EXPECT_LE(count.missed, 1);
  EXPECT_GE(count.share(), 0.85);
}

TEST(Statistics, StrengthDecidesWhatIsFound) {
  // Parts of sigma: nothing at none, nothing sure below a tenth, always at two and ten.
  const MadeGear gear = small_gear();
  for (const double strength : {0.0, 2.0, 10.0}) {
    const auto result =
        run_on(gear, {off_centre(5.0 * strength, 20)}, DataKind::kScan, 0.0, 77);
    const auto* found = find(result, "eccentricity");
    EXPECT_EQ(found != nullptr, strength > 0.0) << strength << ": " << list(result);
    EXPECT_EQ(result.effects.size(), strength > 0.0 ? 1u : 0u) << list(result);
    if (found == nullptr) continue;
    EXPECT_NEAR(parameter(*found, "amplitude_um").value, 5.0 * strength, 1.0);
    EXPECT_NEAR(result.after.held_out_rms, 5.0, 0.5);
  }
}

}  // namespace
}  // namespace trueflank::test
