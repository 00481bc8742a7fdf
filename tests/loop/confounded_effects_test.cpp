// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"
#include "trueflank/geometry/tooth_span.h"

// Pairs of effects that some data cannot tell apart: both are named, with the measurement that would tell, and
// with that measurement only the true one is left.
namespace trueflank::test {
namespace {

bool mentions(const std::vector<std::string>& sentences, const std::string& words) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
    return sentence.find(words) != std::string::npos;
  });
}

/// One effect, which is one of the pair and names the other.
void expect_open(const loop::LoopResult& result, const std::string& truth, const std::string& other) {
  SCOPED_TRACE("open: " + list(result));
  ASSERT_EQ(result.effects.size(), 1u);
  const auto& found = result.effects[0];
  ASSERT_TRUE(found.id == truth || found.id == other);
  const std::string& second = found.id == truth ? other : truth;
  EXPECT_NE(std::find(found.confounded_with.begin(), found.confounded_with.end(), second),
            found.confounded_with.end());
  EXPECT_TRUE(mentions(result.measure_next, found.id + " from " + second));
}

/// The true effect is there and does not name the other any more.
void expect_told(const loop::LoopResult& result, const std::string& truth, const std::string& other) {
  SCOPED_TRACE("told: " + list(result));
  const auto* found = find(result, truth);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(find(result, other), nullptr);
  EXPECT_EQ(std::find(found->confounded_with.begin(), found->confounded_with.end(), other),
            found->confounded_with.end());
}

loop::InspectionData one_flank(loop::InspectionData data) {
  std::erase_if(data.rows, [](const auto& row) { return row.flank == Flank::kRight; });
  return data;
}

InspectionOptions only(bool profile, bool helix, bool index) {
  InspectionOptions options;
  options.profile = profile;
  options.helix = helix;
  options.index = index;
  return options;
}

TEST(Confounded, ScaleAndPressureAngleUntilThicknessAndTipAreMeasured) {
  const MadeGear gear = spur(20);
  const auto traces = inspection_of(gear, {scaled(0.1)}, only(true, true, true));
  expect_open(close(gear, traces), "scale", "pressure_angle_error");
  InspectionOptions common = only(true, true, true);
  common.common_zero = true;
  loop::MeasuredData data;
  data.inspections.push_back(inspection_of(gear, {scaled(0.1)}, common));
  loop::SizeData sizes;
  sizes.rows.push_back({loop::SizeQuantity::kTipDiameter, 2.0 * gear.tip_mm * 1.001, kNaN, 1.0});
  data.sizes.push_back(sizes);
  const auto told = loop::close_loop(geometry_of(gear), "gear", data, {})->result;
  expect_told(told, "scale", "pressure_angle_error");
  expect_told(told, "scale", "contour_offset");
}

TEST(Confounded, ALeanOfTheProfileOnTracesAloneIsNotToldAsAPartThatHasGrown) {
  const MadeGear gear = spur(20);
  const auto lean = grown([](auto&, const FlankSpot& s, auto&) { return 3.0 * s.u; });
  const auto result = close(gear, inspection_of(gear, {lean}, only(true, true, true)));
  expect_open(result, "pressure_angle_error", "scale");
  EXPECT_EQ(result.effects[0].id, "pressure_angle_error");
}

TEST(Confounded, EccentricityAndIndexWaveUntilBothFlanksAreMeasured) {
  const MadeGear gear = spur(20);
  const auto both = inspection_of(gear, {off_centre(8, 40)}, only(false, false, true));
  expect_open(close(gear, one_flank(both)), "eccentricity", "pitch_wave");
  expect_told(close(gear, both), "eccentricity", "pitch_wave");
}

TEST(Confounded, LobingAndIndexWaveUntilBothFlanksAreMeasured) {
  const MadeGear gear = spur(20);
  const auto both = inspection_of(gear, {out_of_round(3, 10, 40)}, only(false, false, true));
  expect_open(close(gear, one_flank(both)), "lobing", "pitch_wave");
  expect_told(close(gear, both), "lobing", "pitch_wave");
}

TEST(Confounded, UnequalAxesAndOvalityUntilBothFlanksAreMeasured) {
  const MadeGear gear = spur(20);
  const auto both = inspection_of(gear, {stretched(0.1, 20)}, only(false, false, true));
  const auto open = close(gear, one_flank(both));
  ASSERT_EQ(open.effects.size(), 1u) << list(open);
  const std::vector<std::string> pair = {"scale_xy", "lobing", "pitch_wave"};
  int named = 0;
  for (const std::string& id : pair)
    named += open.effects[0].id == id || std::count(open.effects[0].confounded_with.begin(),
                                                    open.effects[0].confounded_with.end(), id) > 0;
  EXPECT_EQ(named, 3) << list(open);
  const auto told = close(gear, both);
  expect_told(told, "scale_xy", "lobing");
}

TEST(Confounded, SkewAndUnequalAxesDifferInPhaseOnly) {
  // An axis that is longer at 45 degrees is the same as a skew: only a mark or a second part tells.
  const MadeGear gear = spur(20);
  ScanOptions options;
  options.points = 5000;
  expect_open(close(gear, scan_of(gear, {stretched(0.2, 45)}, options), true), "skew", "scale_xy");
  expect_told(close(gear, scan_of(gear, {stretched(0.2, 10)}, options), true), "scale_xy", "skew");
}

TEST(Confounded, HelixErrorAndTaperUntilBothFlanksAreMeasured) {
  const MadeGear gear = spur(20);
  const auto both = inspection_of(gear, {twisted(6)}, only(false, true, false));
  expect_open(close(gear, one_flank(both)), "helix_error", "taper");
  expect_told(close(gear, both), "helix_error", "taper");
}

TEST(Confounded, TaperAndElephantFootUntilMoreHeightsAreMeasured) {
  const MadeGear gear = spur(20);
  const Process foot = grown([](auto&, auto&, const Vec3& p) { return 12.0 * std::exp(-p[2] / 0.8); });
  InspectionOptions few = only(false, true, false);
  few.points = 2;
  expect_open(close(gear, inspection_of(gear, {foot}, few)), "elephant_foot", "taper");
  expect_told(close(gear, inspection_of(gear, {foot}, only(false, true, false))), "elephant_foot",
              "taper");
}

TEST(Confounded, TiltAndLayerShiftUntilMoreHeightsAreMeasured) {
  const MadeGear gear = spur(20);
  InspectionOptions few = only(false, true, false);
  few.points = 2;
  expect_open(close(gear, inspection_of(gear, {leaning(1.0, 30)}, few)), "axis_tilt", "layer_shift");
  expect_told(close(gear, inspection_of(gear, {leaning(1.0, 30)}, only(false, true, false))),
              "axis_tilt", "layer_shift");
}

TEST(Confounded, EccentricityAndTiltHideInAFreePoseUntilTheBoreIsScanned) {
  const MadeGear gear = spur(20);
  ScanOptions options;
  options.points = 8000;
  options.any_pose = true;
  options.bore_mm = 4.0;
  for (const auto& [id, process] :
       {std::pair<std::string, Process>{"eccentricity", off_centre(20, 30)}, {"axis_tilt", leaning(5, 30)}}) {
    options.bore = false;
    const auto open = close(gear, scan_of(gear, {process}, options), false);
    EXPECT_EQ(open.verdict, loop::Verdict::kNoEffect) << list(open);
    EXPECT_TRUE(mentions(open.not_observable, id));
    EXPECT_TRUE(mentions(open.measure_next, "bore"));
    options.bore = true;
    loop::MeasuredData data;
    data.scans.push_back(scan_of(gear, {process}, options));
    const loop::FlankGeometry geometry(*ToothProfile::make(design_of(gear)), gear.face_mm, options.bore_mm);
    const auto told = loop::close_loop(geometry, "gear", data, {})->result;
    ASSERT_EQ(told.effects.size(), 1u) << list(told);
    EXPECT_EQ(told.effects[0].id, id) << list(told);
  }
}

TEST(Confounded, CausesThatGeometryCannotTellAreSaid) {
  const MadeGear gear = spur(20);
  ScanOptions options;
  options.points = 5000;
  const auto shrunk = close(gear, scan_of(gear, {scaled(-0.3)}, options), true);
  EXPECT_TRUE(mentions(shrunk.measure_next, "gauge block"));
  EXPECT_TRUE(mentions(shrunk.measure_next, "second part"));
  const auto lobed = close(gear, scan_of(gear, {out_of_round(3, 20, 0)}, options), true);
  EXPECT_TRUE(mentions(lobed.measure_next, "unclamping"));
  const auto indexed_by = close(gear, inspection_of(gear, {indexed(3, 6, 0)}, {}));
  EXPECT_TRUE(mentions(indexed_by.measure_next, "two orientations on the table"));
}

TEST(Sizes, AloneTellThicknessWithAnInterval) {
  const MadeGear gear = spur(20);
  const Gear design = design_of(gear);
  loop::MeasuredData data;
  loop::SizeData sizes;
  for (const int teeth : {2, 3, 4})
    sizes.rows.push_back({loop::SizeQuantity::kSpan, base_tangent_length_mm(design, teeth) - 0.015,
                          static_cast<double>(teeth), 1.0});
  sizes.rows.push_back({loop::SizeQuantity::kTipDiameter, 2.0 * gear.tip_mm, kNaN, 1.0});
  data.sizes.push_back(sizes);
  const auto result = loop::close_loop(geometry_of(gear), "gear", data, {})->result;
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  ASSERT_EQ(result.effects[0].id, "tooth_thickness");
  const auto& amount = parameter(result.effects[0], "amount_um");
  EXPECT_NEAR(amount.value, -15.0 / std::cos(gear.pressure_angle_rad), 0.1);
  EXPECT_GT(amount.high - amount.low, 1.0);  // three values of 1 um each
  EXPECT_LT(amount.high - amount.low, 8.0);
}

TEST(Sizes, TellThicknessFromOffset) {
  // Traces with zeros of their own say nothing of thickness; span, pins and diameters do.
  const MadeGear gear = spur(20);
  const Gear design = design_of(gear);
  const Process thick = grown([](auto&, auto&, auto&) { return 10.0; });
  const double pin = 1.75, span_teeth = 3;
  for (const bool walls : {false, true}) {
    loop::MeasuredData data;
    data.inspections.push_back(inspection_of(gear, {thick}, only(true, true, true)));
    loop::SizeData sizes;
    // Parallel faces move apart by what each flank grows; pins ride up by it over sin(alpha_M) each.
    sizes.rows.push_back({loop::SizeQuantity::kSpan,
                          base_tangent_length_mm(design, static_cast<int>(span_teeth)) + 0.020, span_teeth, 1.0});
    const double m = over_pins_mm(design, pin);
    const double to_centre = 0.5 * (m - pin);
    const double rise = 0.010 / std::sin(std::acos(gear.base() / to_centre));
    sizes.rows.push_back({loop::SizeQuantity::kOverPins, m + 2.0 * rise, pin, 1.0});
    sizes.rows.push_back(
        {loop::SizeQuantity::kTipDiameter, 2.0 * gear.tip_mm + (walls ? 0.020 : 0.0), kNaN, 1.0});
    data.sizes.push_back(sizes);
    const auto result = loop::close_loop(geometry_of(gear), "gear", data, {})->result;
    SCOPED_TRACE(list(result));
    const auto* found = find(result, walls ? "contour_offset" : "tooth_thickness");
    if (found == nullptr) {
      ADD_FAILURE();
      continue;
    }
    if (walls) EXPECT_NEAR(parameter(*found, "offset_um").value, 10.0, 0.7);
    else EXPECT_NEAR(parameter(*found, "amount_um").value, 20.0 / std::cos(gear.pressure_angle_rad), 1.5);
  }
}

}  // namespace
}  // namespace trueflank::test
