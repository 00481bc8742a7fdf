// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"

namespace trueflank::test {
namespace {

using loop::Verdict;

struct NamedCase {
  std::string id;
  std::vector<Process> process;
  std::vector<std::pair<std::string, double>> truth;  ///< parameter, value
};

std::vector<NamedCase> named_cases() {
  return {
      {"eccentricity", {off_centre(20, 30)}, {{"amplitude_um", 20}, {"phase_deg", 30}}},
      {"axis_tilt", {leaning(3, -70)}, {{"slope_um_per_mm", 3}, {"phase_deg", -70}}},
      {"scale", {scaled(-0.3)}, {{"percent", -0.3}}},
      {"scale_xy", {stretched(0.2, 20)}, {{"percent", 0.2}, {"phase_deg", 20}}},
      {"skew", {sheared(0.2)}, {{"percent", 0.2}}},
      {"pressure_angle_error",
       {grown([](auto&, const FlankSpot& s, auto&) { return 6.0 * s.u; })},
       {{"slope_um", 12}}},
      {"profile_crowning",
       {grown([](auto&, const FlankSpot& s, auto&) { return -10.0 * s.u * s.u; })},
       {{"amount_um", 10}}},
      {"crowning",
       {grown([](auto&, const FlankSpot& s, auto&) { return -10.0 * s.v * s.v; })},
       {{"amount_um", 10}}},
      {"taper", {grown([](auto&, const FlankSpot& s, auto&) { return 5.0 * s.v; })},
       {{"slope_um", 10}}},
      {"helix_error", {twisted(-10)}, {{"slope_um", -10}}},
      {"tip_relief",
       {grown([](auto&, const FlankSpot& s, auto&) {
         const double t = (s.u - 0.2) / 0.8;
         return t > 0.0 ? -15.0 * t * t : 0.0;
       })},
       {{"amount_um", 15}}},
      {"elephant_foot",
       {grown([](auto&, auto&, const Vec3& p) { return 40.0 * std::exp(-p[2] / 0.5); })},
       {{"amount_um", 40}, {"height_mm", 0.5}}},
      {"layer_shift", {shifted_above(6.3, 15, -8)},
       {{"height_mm", 6.3}, {"dx_um", 15}, {"dy_um", -8}}},
      {"pitch_wave", {indexed(3, 10, 40)}, {{"order", 3}, {"amplitude_um", 10}, {"phase_deg", 40}}},
      {"lobing", {out_of_round(3, 15, 50)}, {{"order", 3}, {"amplitude_um", 15}, {"phase_deg", 50}}},
      {"single_tooth",
       {grown([](auto&, const FlankSpot& s, auto&) { return s.tooth == 7 ? 15.0 : 0.0; })},
       {{"tooth", 7}, {"amount_um", 15}}},
      {"flank_wear",
       {grown([](auto&, const FlankSpot& s, auto&) {
         const double t = (s.u - 0.1) / 0.3;
         return s.side > 0 ? -12.0 * std::exp(-t * t) : 0.0;
       })},
       {{"depth_um", 12}}},
  };
}

/// The effect is the only one found, and its parameters lie within three half intervals of the truth.
void expect_found(const NamedCase& c, const loop::LoopResult& result) {
  SCOPED_TRACE(c.id + " -> " + list(result));
  ASSERT_EQ(result.effects.size(), 1u);
  EXPECT_EQ(result.effects[0].id, c.id);
  EXPECT_EQ(result.verdict, Verdict::kExplained);
  if (result.effects[0].id != c.id) return;
  for (const auto& [name, value] : c.truth) {
    const auto& p = parameter(result.effects[0], name);
    EXPECT_NEAR(p.value, value, 1.6 * (p.high - p.low) + 1e-9) << name;
    EXPECT_NEAR(p.value, value, 0.1 * std::abs(value)) << name;
  }
  EXPECT_NEAR(result.after.held_out_rms, 5.0, 0.25);
  EXPECT_NEAR(result.noise, 5.0, 0.25);
}

TEST(CloseLoop, NamesEveryEffectFromAnAlignedScan) {
  ScanOptions options;
  for (const NamedCase& c : named_cases())
    expect_found(c, close(spur(24), scan_of(spur(24), c.process, options), true));
}

/// What is chosen first beside a hollow can be a scale: when it goes, points lie where they lay before it.
TEST(CloseLoop, PlacesAHollowWhereItIs) {
  for (const auto& [teeth, middle] : {std::pair{24, 0.2}, {37, -0.2}}) {
    const loop::FlankGeometry geometry = geometry_of(spur(teeth));
    const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
    const Process worn = grown([middle = middle](auto&, const FlankSpot& s, auto&) {
      const double t = (s.u - middle) / 0.25;
      return -60.0 * std::exp(-t * t);
    });
    const auto result = close(spur(teeth), scan_of(spur(teeth), {worn}, {}), true);
    SCOPED_TRACE(list(result));
    ASSERT_EQ(result.effects.size(), 1u);
    const double roll = 0.5 * (low + high) + 0.5 * middle * (high - low);
    EXPECT_NEAR(parameter(result.effects[0], "centre_diameter_mm").value,
                2.0 * std::hypot(base_radius_mm(geometry.gear()), roll), 0.006);
  }
}

TEST(CloseLoop, TellsContourOffsetAndThicknessOnlyWithASizeOfTheTip) {
  const MadeGear made = spur(24);
  const Process thicker = grown([](auto&, auto&, auto&) { return 12.0; });
  loop::MeasuredData data;
  data.scans.push_back(scan_of(made, {thicker}, {}));
  const auto open = loop::close_loop(geometry_of(made), "gear", data, {.aligned = true})->result;
  ASSERT_EQ(open.effects.size(), 1u) << list(open);
  ASSERT_EQ(open.effects[0].confounded_with.size(), 1u) << list(open);
  EXPECT_FALSE(open.measure_next.empty());
  for (const bool walls : {true, false}) {
    loop::SizeData sizes;
    const double tip = 2.0 * made.tip_mm + (walls ? 0.024 : 0.0);
    sizes.rows.push_back({loop::SizeQuantity::kTipDiameter, tip, kNaN, 1.0});
    data.sizes = {sizes};
    const auto told = loop::close_loop(geometry_of(made), "gear", data, {.aligned = true})->result;
    ASSERT_EQ(told.effects.size(), 1u) << list(told);
    EXPECT_EQ(told.effects[0].id, walls ? "contour_offset" : "tooth_thickness") << list(told);
    EXPECT_TRUE(told.effects[0].confounded_with.empty()) << list(told);
  }
}

TEST(CloseLoop, FindsNothingInNoise) {
  const auto scan = close(spur(24), scan_of(spur(24), {}, {}), true);
  EXPECT_EQ(scan.verdict, Verdict::kNoEffect) << list(scan);
  EXPECT_NEAR(scan.noise, 5.0, 0.1);
  const auto traces = close(spur(24), inspection_of(spur(24), {}, {}));
  EXPECT_EQ(traces.verdict, Verdict::kNoEffect) << list(traces);
}

TEST(CloseLoop, DescribesWhatItHasNoNameFor) {
  const Process hidden = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
    return 12.0 * std::cos(5.0 * 2.0 * M_PI * (s.tooth - 1) / g.teeth - 1.0) * 0.25 * (s.v + 1.0) *
           (s.v + 1.0);
  });
  const auto result = close(spur(24), scan_of(spur(24), {hidden}, {}), true);
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "unnamed");
  EXPECT_TRUE(result.effects[0].cause.empty());
  EXPECT_NE(result.effects[0].description.find("5 times per turn"), std::string::npos);
  EXPECT_EQ(parameter(result.effects[0], "order").value, 5.0);
  EXPECT_LT(result.after.held_out_rms, 5.0 * 1.2);
}

TEST(CloseLoop, SaysThatAFreePoseHidesEccentricity) {
  ScanOptions options;
  options.any_pose = true;
  const auto result = close(spur(24), scan_of(spur(24), {off_centre(30, 10)}, options), false);
  EXPECT_EQ(result.verdict, Verdict::kNoEffect) << list(result);
  EXPECT_NE(std::find(result.not_observable.begin(), result.not_observable.end(), "eccentricity"),
            result.not_observable.end());
  EXPECT_FALSE(result.measure_next.empty());
}

TEST(CloseLoop, FindsScaleInAnyPoseWithOutliersAndMissingTeeth) {
  ScanOptions options;
  options.any_pose = true;
  options.outlier_share = 0.03;
  options.missing_teeth = {5, 6, 7, 8, 9};
  const auto result = close(spur(24), scan_of(spur(24), {scaled(0.25)}, options), false);
  ASSERT_EQ(result.effects.size(), 1u) << list(result);
  EXPECT_EQ(result.effects[0].id, "scale");
  EXPECT_NEAR(parameter(result.effects[0], "percent").value, 0.25, 0.02);
  EXPECT_GT(result.outliers, 100);
}

TEST(CloseLoop, GivesTheSameBytesForTheSameData) {
  const auto scan = scan_of(spur(17), {out_of_round(2, 10, 20)}, {});
  EXPECT_EQ(loop_json(close(spur(17), scan, true)), loop_json(close(spur(17), scan, true)));
}

}  // namespace
}  // namespace trueflank::test
