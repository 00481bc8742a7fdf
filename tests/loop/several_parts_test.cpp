// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/correction.h"
#include "trueflank/loop/gear/several_parts.h"

// Several parts of one process: what repeats is told from what happened once.
namespace trueflank::test {
namespace {

/// Scans of parts, each with its own processes.
loop::MeasuredData parts_of(const MadeGear& gear, const std::vector<std::vector<Process>>& processes,
                            unsigned seed = 1) {
  loop::MeasuredData data;
  for (std::size_t p = 0; p < processes.size(); ++p) {
    ScanOptions options;
    options.points = 3000;
    options.seed = seed + static_cast<unsigned>(p);
    data.scans.push_back(scan_of(gear, processes[p], options));
    data.scans.back().part = "p" + std::to_string(p + 1);
  }
  return data;
}

loop::LoopResult close_parts(const MadeGear& gear, const loop::MeasuredData& data) {
  return loop::close_loop(geometry_of(gear), "gear", data, {.aligned = true})->result;
}

TEST(SeveralParts, TellTheShrinkageOfAllFromTheShiftOfOne) {
  const MadeGear gear = spur(18);
  const auto result = close_parts(
      gear, parts_of(gear, {{scaled(0.3)}, {scaled(0.29), off_centre(25, 70)}, {scaled(0.31)}}));
  SCOPED_TRACE(list(result));
  const auto* scale = find(result, "scale");
  const auto* shift = find(result, "eccentricity");
  ASSERT_NE(scale, nullptr);
  ASSERT_NE(shift, nullptr);
  EXPECT_EQ(result.effects.size(), 2u);
  EXPECT_TRUE(*scale->repeatable);
  EXPECT_NEAR(parameter(*scale, "percent").value, 0.30, 0.01);
  ASSERT_EQ(scale->in_parts.size(), 3u);
  EXPECT_NEAR(scale->in_parts[2].parameters[0].second, 0.31, 0.01);
  EXPECT_FALSE(*shift->repeatable);
  EXPECT_EQ(shift->part, "p2");
  EXPECT_NEAR(parameter(*shift, "amplitude_um").value, 25, 1.5);
  EXPECT_EQ(result.verdict, loop::Verdict::kExplained);
  ASSERT_EQ(result.parts.size(), 3u);
  EXPECT_GT(result.parts[1].before.rms, result.parts[0].before.rms);
  EXPECT_NEAR(result.after.held_out_rms, 5.0, 0.4);
  // Learnt on two parts, the third is explained but for what is its own: 25 um of shift on one of three.
  const double own = std::sqrt(25.0 + 25.0 * 25.0 / 2.0 / 3.0);
  EXPECT_NEAR(result.new_part_after, own, 0.5);
  EXPECT_GT(result.new_part_before, result.new_part_after + 1.0) << result.parts[0].before.rms << " "
      << result.parts[1].before.rms << " " << result.parts[2].before.rms;
}

TEST(SeveralParts, AnEffectOfRandomPhaseDoesNotRepeat) {
  const MadeGear gear = spur(18);
  const auto result = close_parts(gear, parts_of(gear, {{off_centre(20, 10)},
                                                        {off_centre(22, 130)},
                                                        {off_centre(19, 250)},
                                                        {off_centre(21, 20)}}));
  SCOPED_TRACE(list(result));
  ASSERT_EQ(result.effects.size(), 4u);
  for (const auto& effect : result.effects) {
    EXPECT_EQ(effect.id, "eccentricity");
    EXPECT_FALSE(*effect.repeatable);
    EXPECT_FALSE(effect.correctable);
  }
  // Nothing is learnt for a new part: its error stays.
  EXPECT_NEAR(result.new_part_after, result.new_part_before, 0.01);
}

TEST(SeveralParts, WithoutAnyEffectSayNoEffect) {
  const MadeGear gear = spur(12);
  const auto result = close_parts(gear, parts_of(gear, {{}, {}, {}}, 40));
  EXPECT_EQ(result.verdict, loop::Verdict::kNoEffect) << list(result);
}

TEST(SeveralParts, OnlyWhatRepeatsIsCorrected) {
  const MadeGear gear = spur(18);
  const auto result = close_parts(
      gear, parts_of(gear, {{scaled(0.3)}, {scaled(0.3), off_centre(25, 70)}, {scaled(0.3)}}));
  const auto correction = loop::Correction::make(loop_json(result), geometry_of(gear));
  ASSERT_TRUE(correction) << correction.error().message;
  EXPECT_EQ(correction->corrected(), std::vector<std::string>{"scale"});
  ASSERT_EQ(correction->left().size(), 1u);
  EXPECT_NE(correction->left()[0].find("p2"), std::string::npos);
  const auto u = correction->displacement_mm({9.0, 0.0, 0.0});
  EXPECT_NEAR(u[0], -9.0 * 0.003 / 1.003, 1e-3);
}

TEST(SeveralParts, OfTracesAndSizesKeepTheirRows) {
  const MadeGear gear = spur(18);
  loop::MeasuredData data;
  for (const char* name : {"a", "b"}) {
    InspectionOptions options;
    options.seed = name[0];
    data.inspections.push_back(inspection_of(gear, {twisted(6)}, options));
    data.inspections.back().part = name;
    loop::SizeData sizes;
    sizes.part = name;
    sizes.rows.push_back({loop::SizeQuantity::kTipDiameter, 2.0 * gear.tip_mm, kNaN, 1.0});
    data.sizes.push_back(sizes);
  }
  const auto closed = loop::close_loop(geometry_of(gear), "gear", data, {});
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->table.rows.size(), closed->before_um.size());
  EXPECT_EQ(closed->table.rows.size(), closed->after_um.size());
  ASSERT_EQ(closed->result.effects.size(), 1u) << list(closed->result);
  EXPECT_EQ(closed->result.effects[0].id, "helix_error");
  EXPECT_TRUE(*closed->result.effects[0].repeatable);
}

TEST(SeveralParts, AFileThatNamesNoPartIsOneOfItsOwn) {
  const MadeGear gear = spur(18);
  for (const std::size_t unnamed : survey_of(1, {1u, 0u, 2u})) {
    auto data = parts_of(gear, {{scaled(0.3)}, {scaled(0.3)}, {scaled(0.3)}});
    data.scans[unnamed].part.clear();
    const auto closed = loop::close_loop(geometry_of(gear), "gear", data, {.aligned = true});
    ASSERT_TRUE(closed) << unnamed << ": " << closed.error().front().message;
    ASSERT_EQ(closed->result.parts.size(), 3u);
    EXPECT_EQ(closed->result.parts[0].name, "(unnamed)");  // parts stand in the order of their names
  }
}

TEST(Distributions, TheFTailIsTheSquareOfStudents) {
  for (const double t : {0.5, 2.0, 12.7})
    for (const double n : {1.0, 4.0, 30.0})
      EXPECT_NEAR(loop::f_tail(t * t, 1.0, n), loop::student_two_sided(t, n), 1e-10);
  // Printed tables: F(0.05; 2, 4) = 6.944, F(0.05; 3, 10) = 3.708.
  EXPECT_NEAR(loop::f_tail(6.944, 2.0, 4.0), 0.05, 1e-4);
  EXPECT_NEAR(loop::f_tail(3.708, 3.0, 10.0), 0.05, 1e-4);
}

}  // namespace
}  // namespace trueflank::test
