// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/manufacturability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

GearTrain pair_train(double module_mm, const char* process, double backlash_mm = 0.3) {
  GearboxDesign design{.name = "pair", .topology = train_topology("pair")};
  design.module_mm = module_mm;
  design.backlash_mm = backlash_mm;
  design.gears = {GearDesign{.name = "pinion", .teeth = 20, .bore = {.diameter_mm = 5.0}},
                  GearDesign{.name = "wheel", .teeth = 40}};
  if (process) design.made.process = *ProcessTable().find(process);
  auto train = lay_out(design);
  EXPECT_TRUE(train);
  return std::move(*train);
}

const Finding* find(const Findings& findings, const std::string& where) {
  for (const Finding& finding : findings)
    if (finding.where == where) return &finding;
  return nullptr;
}

TEST(Manufacturability, SaysNothingWithoutAProcess) {
  EXPECT_TRUE(check_manufacturability(pair_train(1.0, nullptr)).empty());
}

TEST(Manufacturability, WarnsOfTeethSmallerThanTheNozzleCanLay) {
  const Findings small = check_manufacturability(pair_train(0.5, "fdm-0.4"));
  ASSERT_EQ(small.size(), 3u);
  const Finding* pinion = find(small, "pinion");
  ASSERT_NE(pinion, nullptr);
  EXPECT_EQ(pinion->status, CheckStatus::kWarn);
  EXPECT_LT(pinion->margin, 0.0);
  EXPECT_NE(pinion->message.find("tooth tip"), std::string::npos);
  EXPECT_FALSE(pinion->cure.empty());
  for (const Finding& finding : check_manufacturability(pair_train(2.0, "fdm-0.4")))
    EXPECT_EQ(finding.status, CheckStatus::kPass) << finding.message;
}

TEST(Manufacturability, TheWallIsLeastOverTheFarthestPlaceOfTheBore) {
  GearboxDesign design{.name = "gear", .topology = train_topology("gear"), .module_mm = 2.0};
  design.gears = {GearDesign{.name = "gear", .teeth = 30}};
  design.made.process = *ProcessTable().find("fdm-0.4");
  const double root_mm = lay_out(design)->gears[0].profile.root_radius_mm();
  const double corner_mm = root_mm - 0.3;  // less than the process makes
  const double flat_mm = corner_mm * std::sqrt(0.75),
               key_mm = std::sqrt(corner_mm * corner_mm - 16.0);
  for (const BoreDesign& bore : {BoreDesign{.diameter_mm = 2.0 * corner_mm},
                                 BoreDesign{.diameter_mm = 2.0 * flat_mm, .kind = BoreKind::kHex},
                                 BoreDesign{.diameter_mm = 2.0 * (key_mm - 3.0),
                                 .kind = BoreKind::kKeyway,
                                 .keyway_width_mm = 8.0,
                                 .keyway_depth_mm = 3.0}}) {
    design.gears[0].bore = bore;
    const Findings found = check_manufacturability(*lay_out(design));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].value, 0.3, 1e-9);
    EXPECT_NE(found[0].message.find("wall between bore and root circle"), std::string::npos);
  }
}

TEST(Manufacturability, WarnsOfLessBacklashThanTheProcessWants) {
  const Findings tight = check_manufacturability(pair_train(2.0, "fdm-0.4", 0.1));
  const Finding* mesh = find(tight, "pinion-wheel");
  ASSERT_NE(mesh, nullptr);
  EXPECT_EQ(mesh->status, CheckStatus::kWarn);
  EXPECT_NEAR(mesh->value, 0.1, 1e-12);
  EXPECT_NEAR(mesh->limit, 0.15, 1e-12);
}

TEST(Manufacturability, IsAmongTheChecksAndNeverFails) {
  for (const Finding& finding : check_gearbox(pair_train(0.5, "fdm-0.6", 0.0)))
    if (finding.id == "manufacturability") {
      EXPECT_NE(finding.status, CheckStatus::kFail);
    }
}

TEST(Manufacturability, RootRadiusOfAManyToothedGearIsNearTheRacks) {
  // a rack's own gap (infinitely many teeth) has the tip rounding of the tool
  Gear gear{.teeth = 100000};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  const auto profile = ToothProfile::make(gear);
  ASSERT_TRUE(profile);
  EXPECT_NEAR(least_root_radius_mm(*profile), 0.38, 0.004);
}

TEST(Manufacturability, RootRadiusOfARingIsThatOfItsFillet) {
  Gear gear{.kind = GearKind::kInternal, .teeth = 60};
  gear.rack.root_radius = 0.2;
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  EXPECT_NEAR(least_root_radius_mm(*ToothProfile::make(gear)), 0.2, 0.002);
  gear.rack.root_radius = 0.0;
  EXPECT_EQ(least_root_radius_mm(*ToothProfile::make(gear)), 0.0);
}

TEST(Manufacturability, GapIsThePitchLessTheTooth) {
  Gear gear{.teeth = 30};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  const auto profile = ToothProfile::make(gear);
  ASSERT_TRUE(profile);
  const double r = profile->root_form_radius_mm();
  const double arc = kTwoPi * r / 30 - tooth_thickness_mm(gear, r);
  // a chord is shorter than its arc by arc^3 / (24 r^2)
  EXPECT_NEAR(least_gap_mm(*profile), arc - std::pow(arc, 3) / (24.0 * r * r), 1e-6);
}

}  // namespace
}  // namespace trueflank
