// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/flank_modifications.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trueflank/train/gear_train.h"

namespace trueflank {
namespace {

GearboxDesign single(GearKind kind, const ModificationsDesign& modifications,
                     double helix_deg = 0.0, bool herringbone = false, double groove_mm = 0.0) {
  GearboxDesign design{.name = "gear", .topology = train_topology("gear"), .module_mm = 2.0,
                       .helix_angle_rad = rad_from_deg(helix_deg), .herringbone = herringbone,
                       .relief_groove_mm = groove_mm};
  design.gears = {GearDesign{.name = "gear", .kind = kind,
                             .teeth = kind == GearKind::kExternal ? 24 : 60, .shift = 0.1,
                             .face_width_mm = 20.0, .modifications = modifications}};
  return design;
}

struct Made {
  TrainGear gear;
  double root, tip, r_b;
  [[nodiscard]] double at(double share, double z, Flank flank = Flank::kLeft) const {
    return gear.deviation.deviation_mm(3, flank, root + share * (tip - root), z);
  }
};

Made made(const GearboxDesign& design) {
  const auto train = lay_out(design);
  EXPECT_TRUE(train) << (train ? "" : train.error().front().message);
  if (!train) throw std::runtime_error("the design does not lay out");
  const TrainGear& gear = train->gears.front();
  return {gear, gear.profile.root_form_roll_length_mm(), gear.profile.tip_form_roll_length_mm(),
          base_radius_mm(gear.profile.gear())};
}

class Kinds : public ::testing::TestWithParam<GearKind> {};

TEST_P(Kinds, TipReliefIsAParabolaInRollLengthFromItsStart) {
  const bool ring = GetParam() == GearKind::kInternal;
  const double start_diameter = ring ? 119.0 : 50.0;
  const Made gear = made(single(GetParam(), {.tip_relief_um = 12.0,
                                             .tip_relief_start_diameter_mm = start_diameter}));
  const double start = std::sqrt(0.25 * start_diameter * start_diameter - gear.r_b * gear.r_b);
  const auto at_roll = [&](double roll) {
    return gear.gear.deviation.deviation_mm(0, Flank::kRight, roll, 7.0);
  };
  EXPECT_DOUBLE_EQ(at_roll(gear.tip), -0.012);
  EXPECT_NEAR(at_roll(0.5 * (start + gear.tip)), -0.003, 1e-12);
  EXPECT_EQ(at_roll(start), 0.0);
  EXPECT_EQ(at_roll(0.5 * (start + gear.root)), 0.0);
  ASSERT_EQ(gear.gear.deviation.roll_breaks_mm.size(), 1u);
  EXPECT_NEAR(gear.gear.deviation.roll_breaks_mm[0], start, 1e-12);
  EXPECT_FALSE(gear.gear.deviation.varies_along_face);
  const Made line = made(single(GetParam(), {.tip_relief_um = 12.0,
                                             .tip_relief_start_diameter_mm = start_diameter,
                                             .tip_relief_shape = ReliefShape::kLinear}));
  EXPECT_NEAR(line.gear.deviation.deviation_mm(0, Flank::kLeft, 0.5 * (start + line.tip), 0.0),
              -0.006, 1e-12);
}

TEST_P(Kinds, TheTermsAdd) {
  const bool ring = GetParam() == GearKind::kInternal;
  const ModificationsDesign all{.tip_relief_um = 8.0,
                                .tip_relief_start_diameter_mm = ring ? 123.0 : 52.0,
                                .root_relief_um = 5.0,
                                .root_relief_start_diameter_mm = ring ? 126.0 : 49.0,
                                .profile_crowning_um = 3.0,
                                .profile_slope_um = -4.0,
                                .crowning_um = 6.0,
                                .end_relief_um = 7.0,
                                .end_relief_length_mm = 3.0,
                                .helix_slope_um = 10.0};
  const Made gear = made(single(GetParam(), all, 15.0));
  // counter-clockwise flank: left of an external gear, right of a ring
  const Flank ccw = ring ? Flank::kRight : Flank::kLeft, cw = ring ? Flank::kLeft : Flank::kRight;
  EXPECT_NEAR(gear.at(1.0, 20.0, ccw) * 1e3, -8.0 - 3.0 - 2.0 - 6.0 - 7.0 + 5.0, 1e-9);
  EXPECT_NEAR(gear.at(1.0, 20.0, cw) * 1e3, -8.0 - 3.0 - 2.0 - 6.0 - 7.0 - 5.0, 1e-9);
  EXPECT_NEAR(gear.at(0.0, 0.0, ccw) * 1e3, -5.0 - 3.0 + 2.0 - 6.0 - 7.0 - 5.0, 1e-9);
  EXPECT_NEAR(gear.at(0.0, 10.0, ccw) * 1e3, -5.0 - 3.0 + 2.0, 1e-9);
  EXPECT_NEAR(gear.at(0.0, 18.5, ccw) * 1e3, -5.0 - 3.0 + 2.0 - 6.0 * 0.7225 - 7.0 / 4 + 4.25, 1e-9);
  EXPECT_EQ(gear.gear.deviation.roll_breaks_mm.size(), 2u);
  EXPECT_EQ(gear.gear.deviation.z_breaks_mm, (std::vector<double>{3.0, 17.0}));
  EXPECT_TRUE(gear.gear.deviation.varies_along_face);
}
INSTANTIATE_TEST_SUITE_P(Of, Kinds, ::testing::Values(GearKind::kExternal, GearKind::kInternal));

TEST(FlankModifications, HalvesOfAHerringboneAreFacesOfTheirOwn) {
  const Made gear = made(single(GearKind::kExternal, {.crowning_um = 4.0, .helix_slope_um = 10.0},
                                20.0, true, 4.0));  // halves 0..8 and 12..20
  for (double z : {0.0, 8.0}) EXPECT_NEAR(gear.at(0.5, z) * 1e3, -4.0 + (z == 0.0 ? -5.0 : 5.0), 1e-9);
  EXPECT_NEAR(gear.at(0.5, 4.0), 0.0, 1e-15);
  for (double z : {0.0, 1.5, 7.0, 9.5}) EXPECT_EQ(gear.at(0.3, z), gear.at(0.3, 20.0 - z));
  EXPECT_EQ(gear.gear.deviation.z_breaks_mm, std::vector<double>{10.0});
  EXPECT_EQ(gear.gear.twist.relief_groove_mm, 4.0);
}

TEST(FlankModifications, NoneIsNone) {
  const Made gear = made(single(GearKind::kExternal, {.edge_chamfer_mm = 0.3}));
  EXPECT_TRUE(gear.gear.deviation.empty());
  EXPECT_EQ(gear.gear.edge_chamfer_mm, 0.3);
}

Errors errors_of(GearKind kind, const ModificationsDesign& modifications) {
  const auto train = lay_out(single(kind, modifications));
  return train ? Errors{} : train.error();
}

TEST(FlankModifications, WhatCannotBeIsRefusedWithNumbers) {
  const auto expect = [](const Errors& errors, const std::string& key, const std::string& word) {
    ASSERT_EQ(errors.size(), 1u) << key;
    EXPECT_EQ(errors[0].key, "gear.modifications" + key);
    EXPECT_NE((errors[0].message + " " + errors[0].remedy).find(word), std::string::npos)
        << errors[0].message << " " << errors[0].remedy;
    EXPECT_EQ(errors[0].message.rfind("gear: ", 0), 0u);
  };
  const auto external = [](const ModificationsDesign& m) {
    return errors_of(GearKind::kExternal, m);
  };
  // tip circle 52.4, root form about 45.5
  expect(external({.tip_relief_um = 5.0, .tip_relief_start_diameter_mm = 53.0}),
         ".tip_relief_start_diameter_mm", "less than 52.4 mm");
  expect(external({.root_relief_um = 5.0, .root_relief_start_diameter_mm = 45.0}),
         ".root_relief_start_diameter_mm", "not on the involute");
  expect(external({.end_relief_um = 300.0, .end_relief_length_mm = 1.0}), "", "lean");
  expect(external({.tip_relief_um = 200.0, .tip_relief_start_diameter_mm = 51.5}), "", "lean");
  expect(external({.tip_relief_um = 100.0, .tip_relief_start_diameter_mm = 48.0,
                   .edge_chamfer_mm = 1.7}),
         ".edge_chamfer_mm", "half the tip land has");
  expect(external({.end_relief_um = 5.0, .end_relief_length_mm = 11.0}), ".end_relief_length_mm",
         "at most 10 mm");
  expect(external({.tip_rounding_mm = 1.5}), ".tip_rounding_mm", "at most");
  expect(errors_of(GearKind::kInternal,
                   {.tip_relief_um = 5.0, .tip_relief_start_diameter_mm = 116.0}),
         ".tip_relief_start_diameter_mm", "not on the involute");
  EXPECT_EQ(external({.tip_relief_um = 5.0, .tip_relief_start_diameter_mm = 53.0,
                      .root_relief_um = 5.0, .root_relief_start_diameter_mm = 40.0})
                .size(),
            2u);
}

TEST(FlankModifications, AReliefShorterThanItsDepthIsRefusedHoweverSmallItIs) {
  // 1 um of relief that starts 0.1 um before the flank's end
  const Made plain = made(single(GearKind::kInternal, {}));
  const double tip_form = 2.0 * plain.gear.profile.tip_form_radius_mm();
  const auto train = lay_out(single(GearKind::kInternal, {.tip_relief_um = 1.0,
                                                          .tip_relief_start_diameter_mm = tip_form + 1e-4}));
  ASSERT_FALSE(train);
  EXPECT_NE(train.error().front().message.find("would lean"), std::string::npos) << train.error().front().message;
}

TEST(FlankModifications, AChamferEndsOnTheFlank) {
  // so undercut that the involute begins just below the tip: the section would cross itself
  GearboxDesign design = single(GearKind::kExternal, {});
  design.gears[0].teeth = 10;
  design.gears[0].shift = -0.7057;
  design.rack = {.pressure_angle_rad = rad_from_deg(17.3), .addendum = 0.767, .dedendum = 1.167, .root_radius = 0.179};
  const auto bare = lay_out(design);
  ASSERT_TRUE(bare);
  const ToothProfile& profile = bare->gears[0].profile;
  const double flank = profile.tip_form_radius_mm() - profile.root_form_radius_mm();
  ASSERT_GT(flank, 0.0);
  design.gears[0].modifications.edge_chamfer_mm = 0.9 * flank;
  EXPECT_TRUE(lay_out(design));
  design.gears[0].modifications.edge_chamfer_mm = 1.01 * flank;
  const auto refused = lay_out(design);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().key, "gear.modifications.edge_chamfer_mm");
}

TEST(FlankModifications, AChamferLeavesTheWaistOfAnUndercutTooth) {
  // six teeth, so undercut that they are thinnest below the flank; with crowning the chamfers met there
  GearboxDesign design = single(GearKind::kExternal, {.crowning_um = 95.0});
  design.gears[0].teeth = 6;
  design.gears[0].shift = -0.4278;
  design.module_mm = 5.37;
  design.rack = {.pressure_angle_rad = rad_from_deg(15.74), .addendum = 1.084, .dedendum = 1.212, .root_radius = 0.028};
  double most = 0.0;
  for (const double chamfer : {0.3, 0.6, 0.7, 0.75, 0.8, 0.9, 1.0}) {
    design.gears[0].modifications.edge_chamfer_mm = chamfer;
    if (lay_out(design)) most = chamfer;
    else break;
  }
  EXPECT_GE(most, 0.7);
  EXPECT_LT(most, 0.9);
  const auto refused = lay_out(design);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().key, "gear.modifications.edge_chamfer_mm");
  EXPECT_NE(refused.error().front().message.find("thinnest"), std::string::npos);
}

TEST(FlankModifications, FlanksThatMeetInTheGapStayThere) {
  // a ring whose spaces close before its root circle has no root that could take up a difference
  GearboxDesign design = single(GearKind::kInternal, {});
  design.gears[0].teeth = 12;
  design.gears[0].shift = 0.684;
  design.rack.pressure_angle_rad = rad_from_deg(17.5);
  ASSERT_TRUE(lay_out(design)->gears[0].profile.notes().space_closed);
  const auto error_with = [&](const ModificationsDesign& m) {
    design.gears[0].modifications = m;
    const auto train = lay_out(design);
    return train ? std::string() : train.error().front().key;
  };
  const double root = 2.0 * lay_out(design)->gears[0].profile.root_radius_mm();
  EXPECT_EQ(error_with({.edge_chamfer_mm = 0.1}), "gear.modifications.edge_chamfer_mm");
  EXPECT_EQ(error_with({.crowning_um = 3.0}), "gear.modifications.crowning_um");
  EXPECT_EQ(error_with({.root_relief_um = 3.0, .root_relief_start_diameter_mm = root - 1.0}),
            "gear.modifications.root_relief_um");
  EXPECT_EQ(error_with({}), "");
}

TEST(FlankModifications, FlanksThatMeetInAPointedTipStayThere) {
  GearboxDesign design = single(GearKind::kExternal, {});
  design.gears[0].teeth = 9;
  design.gears[0].shift = 1.0;
  ASSERT_TRUE(lay_out(design)->gears[0].profile.notes().pointed);
  for (const double slope_um : {2.0, -2.0}) {  // crosses them, parts them
    design.gears[0].modifications = {.profile_slope_um = slope_um};
    const auto train = lay_out(design);
    ASSERT_FALSE(train) << slope_um;
    EXPECT_EQ(train.error().front().key, "gear.modifications.profile_slope_um");
  }
  design.gears[0].modifications = {.root_relief_um = 2.0, .root_relief_start_diameter_mm = 19.5};
  EXPECT_TRUE(lay_out(design)) << lay_out(design).error().front().message;
}

TEST(FlankModifications, TheTipLandIsJudgedOnTheSection) {
  // half the land of 24 teeth, x 0.1, m 2 at the tip: from the involute, written out
  const double r_b = 24.0 * std::cos(rad_from_deg(20.0)), r_a = 26.2;
  const double a = std::acos(r_b / r_a), alpha = rad_from_deg(20.0);
  const double half = kPi / 48 + 0.2 * std::tan(alpha) / 24 + std::tan(alpha) - alpha -
                      (std::tan(a) - a);
  const Made gear = made(single(GearKind::kExternal, {.crowning_um = 30.0}));
  EXPECT_NEAR(tip_land_half_angle_rad(gear.gear.toothing(), 10.0), half, 1e-12);
  EXPECT_NEAR(tip_land_half_angle_rad(gear.gear.toothing(), 0.0), half - 0.030 / r_b, 1e-12);
}

}  // namespace
}  // namespace trueflank
