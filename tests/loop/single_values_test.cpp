// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/loop/made_gears.h"

// Index and traces of one gear that say different things, as after a second clamping.
namespace trueflank::test {
namespace {

/// The index of one process, the helix traces of another.
loop::InspectionData clamped_twice(const MadeGear& gear, const Process& index,
                                   const Process& traces) {
  InspectionOptions options;
  options.points = 24;
  options.noise_um = 0.3;
  options.profile = options.helix = false;
  loop::InspectionData data = inspection_of(gear, {index}, options);
  options.helix = true;
  options.index = false;
  const loop::InspectionData helix = inspection_of(gear, {traces}, options);
  data.rows.insert(data.rows.end(), helix.rows.begin(), helix.rows.end());
  return data;
}

TEST(SingleValues, AnEccentricityThatTracesContradictIsSaidToBeAndItsIntervalHoldsBoth) {
  const MadeGear gear = helical(16, 25.0);
  const auto result =
      close(gear, clamped_twice(gear, off_centre(8.0, 40.0), off_centre(20.0, 170.0)));
  const auto* found = find(result, "eccentricity");
  ASSERT_NE(found, nullptr) << list(result);
  const loop::Parameter& amplitude = parameter(*found, "amplitude_um");
  EXPECT_LT(amplitude.low, 8.0) << list(result);
  EXPECT_GT(amplitude.high, 20.0) << list(result);
  EXPECT_TRUE(std::any_of(result.notes.begin(), result.notes.end(), [](const std::string& note) {
    return note.find("eccentricity, amplitude_um: values one a tooth") != std::string::npos;
  })) << list(result);
}

TEST(SingleValues, RecordsThatAgreeSayNothingOfAContradiction) {
  const MadeGear gear = helical(16, 25.0);
  const auto result =
      close(gear, clamped_twice(gear, off_centre(8.0, 40.0), off_centre(8.0, 40.0)));
  const auto* found = find(result, "eccentricity");
  ASSERT_NE(found, nullptr) << list(result);
  const loop::Parameter& amplitude = parameter(*found, "amplitude_um");
  EXPECT_NEAR(amplitude.value, 8.0, 0.3);
  EXPECT_LT(amplitude.high - amplitude.low, 1.0);
  EXPECT_TRUE(result.notes.empty());
}

}  // namespace
}  // namespace trueflank::test
