// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/loop/made_gears.h"
#include "trueflank/geometry/tooth_span.h"

// A span rests on two flanks of teeth that the file does not name; it stands for all teeth in the fit.
namespace trueflank::test {
namespace {

constexpr int kSpanned = 3;

double span_mm(const MadeGear& gear) {
  return base_tangent_length_mm(geometry_of(gear).gear(), kSpanned);
}

loop::SizeData spans_of(const MadeGear& gear, const std::vector<double>& deviations_um) {
  loop::SizeData sizes;
  for (const double um : deviations_um)
    sizes.rows.push_back({loop::SizeQuantity::kSpan, span_mm(gear) + mm_from_um(um), kSpanned, 1.0});
  return sizes;
}

/// Of the flanks of every tooth, + towards the next one [um].
std::vector<double> wave_of_pitch(const MadeGear& gear, double um) {
  std::vector<double> ahead_um;
  for (int tooth = 1; tooth <= gear.teeth; ++tooth)
    ahead_um.push_back(um * std::cos(2.0 * kPi * 3.0 * tooth / gear.teeth));
  return ahead_um;
}

loop::InspectionData index_of(const MadeGear& gear, const std::vector<double>& ahead_um) {
  InspectionOptions options;
  options.profile = options.helix = false;
  options.noise_um = 0.3;
  loop::InspectionData data = inspection_of(gear, {}, options);
  for (loop::InspectionRow& row : data.rows)
    row.deviation_um += (row.flank == Flank::kLeft ? 1.0 : -1.0) *
                        (ahead_um[static_cast<std::size_t>(row.tooth) - 1] - ahead_um[0]);
  return data;
}

/// What a caliper over three teeth from this one on reads beyond the span [um].
double over_teeth_from(const std::vector<double>& ahead_um, std::size_t tooth) {
  return ahead_um[(tooth + kSpanned - 1) % ahead_um.size()] - ahead_um[tooth];
}

loop::LoopResult closed(const MadeGear& gear, const loop::MeasuredData& data) {
  return loop::close_loop(geometry_of(gear), "gear", data, {}).value().result;
}

bool tells_of_thickness(const loop::LoopResult& result) {
  for (const char* id : {"contour_offset", "tooth_thickness", "scale"})
    if (find(result, id)) return true;
  return false;
}

TEST(SizeScatter, SpansThatScatterBeyondTheirErrorsSayNothingWithinTheirScatter) {
  const MadeGear gear = spur(24);
  int believed = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> teeth(0.0, 6.0);
    std::vector<double> read_um;
    for (int i = 0; i < 6; ++i) read_um.push_back(teeth(random));
    loop::MeasuredData data;
    data.sizes.push_back(spans_of(gear, read_um));
    believed += tells_of_thickness(closed(gear, data)) ? 1 : 0;
  }
  EXPECT_EQ(believed, 0);
}

TEST(SizeScatter, IsSaidInTheNotes) {
  const MadeGear gear = spur(24);
  loop::MeasuredData data;
  data.sizes.push_back(spans_of(gear, {-5.0, 4.0, 6.0, -5.0}));
  const loop::LoopResult result = closed(gear, data);
  EXPECT_TRUE(std::any_of(result.notes.begin(), result.notes.end(), [](const std::string& note) {
    return note.starts_with("repeated sizes scatter by 5.83 um, 5.8 times their errors");
  })) << list(result);
}

TEST(SizeScatter, ThinTeethAreFoundThoughSpansScatter) {
  const MadeGear gear = spur(24);
  loop::MeasuredData data;
  data.sizes.push_back(spans_of(gear, {-68.0, -61.0, -59.0, -64.0, -57.0, -62.0}));
  const loop::LoopResult result = closed(gear, data);
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_TRUE(tells_of_thickness(result)) << list(result);
  const loop::Parameter& amount = result.effects[0].parameters[0];
  // the mean, -61.8 um, within 2.571 times its error, 1.62 um (Student's t of five degrees)
  EXPECT_NEAR((amount.high - amount.low) / std::abs(amount.value), 2.0 * 2.571 * 1.62 / 61.8, 0.01)
      << list(result);
}

TEST(SizeScatter, ASpanOfAGearWhoseTeethDifferIsJudgedByTheIndex) {
  const MadeGear gear = spur(24);
  const std::vector<double> ahead_um = wave_of_pitch(gear, 6.0);
  for (std::size_t tooth = 0; tooth < 8; ++tooth) {
    loop::MeasuredData data;
    data.inspections.push_back(index_of(gear, ahead_um));
    data.sizes.push_back(spans_of(gear, {over_teeth_from(ahead_um, tooth)}));
    const loop::LoopResult result = closed(gear, data);
    EXPECT_TRUE(find(result, "pitch_wave")) << tooth << ": " << list(result);
    EXPECT_FALSE(tells_of_thickness(result)) << tooth << ": " << list(result);
  }
}

TEST(SizeScatter, AKnockedToothIsFoundBesideSpansThatRestOnIt) {
  const MadeGear gear = spur(17);
  InspectionOptions options;
  options.noise_um = 0.6;
  options.points = 64;
  loop::MeasuredData data;
  data.inspections.push_back(inspection_of(gear, {}, options));
  auto& rows = data.inspections.back().rows;
  std::erase_if(rows, [](const loop::InspectionRow& row) {
    return row.record != loop::RecordKind::kIndex && row.tooth % 2 == 0;
  });
  for (loop::InspectionRow& row : rows)
    if (row.record == loop::RecordKind::kIndex && row.tooth == 14) row.deviation_um -= 10.0;
  data.sizes.push_back(spans_of(gear, {-8.0, 0.5, -0.4, -9.0, 0.3, 0.0}));
  const loop::LoopResult result = closed(gear, data);
  const auto* found = find(result, "single_tooth");
  ASSERT_NE(found, nullptr) << list(result);
  EXPECT_EQ(parameter(*found, "tooth").value, 14.0);
  EXPECT_FALSE(tells_of_thickness(result)) << list(result);
}

// Whichever tooth it is, also one that is held out: there the size alone says something of it.
TEST(SizeScatter, AnIndexKeepsItsKnockedToothBesideOneSpan) {
  const MadeGear gear = spur(40);
  for (int tooth = 2; tooth <= 12; tooth += survey_size(3, 1)) {
    loop::MeasuredData data;
    data.inspections.push_back(index_of(gear, std::vector<double>(40, 0.0)));
    for (loop::InspectionRow& row : data.inspections.back().rows)
      if (row.tooth == tooth) row.deviation_um += 8.0;
    data.sizes.push_back(spans_of(gear, {-2.5}));
    const loop::LoopResult result = closed(gear, data);
    EXPECT_TRUE(find(result, "single_tooth")) << tooth << ": " << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
