// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"

// A gear that was clamped anew between two files of records.
namespace trueflank::test {
namespace {

/// The index of a gear made so, as one file.
loop::InspectionData index_file(const MadeGear& gear, const std::string& name,
                                const std::vector<Process>& processes, unsigned seed) {
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = 0.5;
  options.seed = seed;
  loop::InspectionData data = inspection_of(gear, processes, options);
  data.file = name;
  return data;
}

loop::LoopResult close_files(const MadeGear& gear, std::vector<loop::InspectionData> files) {
  loop::MeasuredData data;
  data.inspections = std::move(files);
  return loop::close_loop(geometry_of(gear), "gear", data, {})->result;
}

void keep_side(loop::InspectionData& data, Flank side) {
  std::erase_if(data.rows, [&](const loop::InspectionRow& row) { return row.flank != side; });
}

/// Amplitude and direction [deg] of the term that speaks of a file; NaN: none does.
std::array<double, 2> clamping_of(const loop::LoopResult& result, const std::string& file) {
  for (const loop::FoundEffect& effect : result.effects)
    for (const loop::Term& term : effect.terms)
      if (term.text.rfind(file + ": the teeth stand off the axis", 0) == 0)
        return {term.amplitude(), std::atan2(term.sin, term.cos) * 180.0 / M_PI};
  return {std::nan(""), std::nan("")};
}

void expect_clamping(const loop::LoopResult& result, const std::string& file, double um,
                     double deg) {
  const auto [amplitude, direction] = clamping_of(result, file);
  EXPECT_NEAR(amplitude, um, 0.4) << file << ": " << list(result);
  EXPECT_NEAR(std::remainder(direction - deg, 360.0), 0.0, 12.0) << file << ": " << list(result);
}

TEST(Clampings, TwoFilesOfAnIndexHaveAnEccentricityEach) {
  for (unsigned seed = 1; seed <= survey_size(2U, 8U); ++seed) {
    const MadeGear gear = seed % 2 == 0 ? ring(51) : spur(34);
    const double off = 40.0 + 37.0 * seed;
    const auto result = close_files(
        gear, {index_file(gear, "first.csv", {off_centre(4.0, 20.0)}, seed),
               index_file(gear, "second.csv", {off_centre(3.0, 20.0 + off)}, seed + 50)});
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << seed << ": " << list(result);
    EXPECT_FALSE(has_name(result)) << seed << ": " << list(result);
    expect_clamping(result, "first.csv", 4.0, 20.0);
    expect_clamping(result, "second.csv", 3.0, 20.0 + off);
  }
}

TEST(Clampings, WhatTheGearHasStandsBesideThem) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(38);
    const Process wave = indexed(3, 6.0, 70.0);
    const auto result =
        close_files(gear, {index_file(gear, "a.csv", {off_centre(4.0, 200.0), wave}, seed),
                           index_file(gear, "b.csv", {off_centre(4.0, 330.0), wave}, seed + 50)});
    const auto* found = find(result, "pitch_wave");
    ASSERT_NE(found, nullptr) << list(result);
    EXPECT_NEAR(parameter(*found, "amplitude_um").value, 6.0, 0.5) << list(result);
    expect_clamping(result, "a.csv", 4.0, 200.0);
    expect_clamping(result, "b.csv", 4.0, 330.0);
    EXPECT_EQ(result.effects.size(), 2U) << list(result);
  }
}

TEST(Clampings, OneFileOfThreeStandsOtherwise) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(30);
    const auto result =
        close_files(gear, {index_file(gear, "a.csv", {off_centre(5.0, 100.0)}, seed),
                           index_file(gear, "b.csv", {off_centre(5.0, 250.0)}, seed + 30),
                           index_file(gear, "c.csv", {off_centre(5.0, 100.0)}, seed + 60)});
    const auto* found = find(result, "eccentricity");
    ASSERT_NE(found, nullptr) << list(result);
    EXPECT_NEAR(parameter(*found, "amplitude_um").value, 5.0, 0.4) << list(result);
    EXPECT_FALSE(std::isnan(clamping_of(result, "b.csv")[0])) << list(result);
    EXPECT_TRUE(std::isnan(clamping_of(result, "a.csv")[0])) << list(result);
    EXPECT_TRUE(std::isnan(clamping_of(result, "c.csv")[0])) << list(result);
  }
}

TEST(Clampings, FilesOfOneClampingShowAnEccentricityAndNoMore) {
  for (unsigned seed = 1; seed <= survey_size(2U, 12U); ++seed) {
    const MadeGear gear = spur(33);
    const double um = seed % 2 == 0 ? 0.0 : 4.0;
    const auto result =
        close_files(gear, {index_file(gear, "a.csv", {off_centre(um, 100.0)}, seed),
                           index_file(gear, "b.csv", {off_centre(um, 100.0)}, seed + 30)});
    EXPECT_EQ(result.effects.size(), um > 0.0 ? 1U : 0U) << seed << ": " << list(result);
    EXPECT_EQ(find(result, "eccentricity") != nullptr, um > 0.0) << seed << ": " << list(result);
  }
}

TEST(Clampings, AFarLargerEccentricityOfBothFilesIsTheGears) {
  const MadeGear gear = spur(33);
  const auto result = close_files(gear, {index_file(gear, "a.csv", {off_centre(20.0, 100.0)}, 3),
                                         index_file(gear, "b.csv", {off_centre(20.0, 110.0)}, 4)});
  const auto* found = find(result, "eccentricity");
  ASSERT_NE(found, nullptr) << list(result);
  EXPECT_NEAR(parameter(*found, "amplitude_um").value, 20.0, 0.5) << list(result);
}

TEST(Clampings, LeftFlanksInOneFileAndRightOnesInAnother) {
  const MadeGear gear = spur(40);
  auto left = index_file(gear, "left.csv", {off_centre(4.0, 340.0)}, 5),
       right = index_file(gear, "right.csv", {off_centre(3.0, 100.0)}, 6);
  keep_side(left, Flank::kLeft);
  keep_side(right, Flank::kRight);
  const auto result = close_files(gear, {left, right});
  expect_clamping(result, "left.csv", 4.0, 340.0);
  expect_clamping(result, "right.csv", 3.0, 100.0);
  EXPECT_FALSE(has_name(result)) << list(result);
}

/// The index of one file, its flanks measured in two clampings.
loop::InspectionData flanks_apart(const MadeGear& gear, const Process& left, const Process& right,
                                  unsigned seed) {
  auto data = index_file(gear, "m.csv", {left}, seed),
       other = index_file(gear, "m.csv", {right}, seed + 40);
  keep_side(data, Flank::kLeft);
  keep_side(other, Flank::kRight);
  data.rows.insert(data.rows.end(), other.rows.begin(), other.rows.end());
  return data;
}

// With names each would be twice as large as what either flank has.
TEST(Clampings, OfOneFileWhereNamesWouldTakeEachOtherBack) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(40);
    const auto result =
        close_files(gear, {flanks_apart(gear, off_centre(7.0, 242.0), off_centre(4.5, 1.0), seed)});
    EXPECT_FALSE(has_name(result)) << seed << ": " << list(result);
    ASSERT_EQ(result.effects.size(), 2U) << seed << ": " << list(result);
    for (const loop::FoundEffect& found : result.effects) {
      const bool left = found.flank == "left";
      ASSERT_EQ(found.terms.size(), 1U) << seed << ": " << list(result);
      EXPECT_NEAR(found.terms.front().amplitude(), left ? 7.0 : 4.5, 0.4) << list(result);
      EXPECT_NE(found.sentence.find("pitch wave once per turn"), std::string::npos)
          << found.sentence;
    }
  }
}

TEST(Clampings, TwoNamesAreToldWithTheClampingsThatTheyMayBe) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(40);
    const auto result = close_files(
        gear, {index_file(gear, "m.csv", {off_centre(5.0, 60.0), indexed(1, 5.0, 60.0)}, seed)});
    for (const char* id : {"eccentricity", "pitch_wave"}) {
      const auto* found = find(result, id);
      ASSERT_NE(found, nullptr) << list(result);
      EXPECT_NE(found->sentence.find("measured in two clampings"), std::string::npos)
          << found->sentence;
      EXPECT_EQ(found->sentence.find("calibrate the table"), std::string::npos) << found->sentence;
    }
  }
  // An eccentricity alone needs no second clamping.
  const MadeGear gear = spur(40);
  const auto alone = close_files(gear, {index_file(gear, "m.csv", {off_centre(4.0, 340.0)}, 5)});
  ASSERT_EQ(alone.effects.size(), 1U) << list(alone);
  EXPECT_EQ(alone.effects.front().sentence.find("two clampings"), std::string::npos);
}

}  // namespace
}  // namespace trueflank::test
