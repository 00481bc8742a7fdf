// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/train/prototype_design.h"
#include "trueflank/check/axial.h"

namespace trueflank {
namespace {

/// The finding on the carrier of the prototype with a face width of ring2 and a plate diameter.
Finding carrier_finding(double ring2_width_mm, double plate_diameter_mm) {
  GearboxDesign design = test::prototype(0.5225, 1.9967, 25.6826);
  design.gears[1].bore.diameter_mm = 10.0;
  design.gears[4].face_width_mm = ring2_width_mm;
  design.carrier = CarrierDesign{.outer_diameter_mm = plate_diameter_mm};
  const auto train = lay_out(design);
  const Findings findings = check_axial(*train);
  for (const Finding& finding : findings)
    if (finding.where == "carrier") return finding;
  return {};
}

TEST(CarrierClearance, PlatesClearThePlanetsByTheirGap) {
  const Finding finding = carrier_finding(10.0, 70.0);
  EXPECT_EQ(finding.status, CheckStatus::kPass);
  EXPECT_NEAR(finding.value, 0.3, 1e-12);
  EXPECT_EQ(finding.margin, finding.value);
  EXPECT_EQ(finding.message, "carrier and sun clear each other by 0.3 mm");
  EXPECT_TRUE(finding.cure.empty());
}

TEST(CarrierClearance, AWiderRingPassesAroundASmallerPlate) {
  // the ring's tip circle has 82.99 mm
  EXPECT_EQ(carrier_finding(14.0, 82.0).status, CheckStatus::kPass);
}

TEST(CarrierClearance, AWiderRingRunsIntoALargerPlate) {
  const Finding finding = carrier_finding(14.0, 84.0);
  EXPECT_EQ(finding.status, CheckStatus::kFail);
  EXPECT_NEAR(finding.value, 0.5 * (82.9934 - 84.0), 1e-3);
  EXPECT_EQ(finding.message, "carrier_top and ring2 run into each other by 0.5033 mm");
  EXPECT_NE(finding.cure.find("larger by more than 0.5033 mm"), std::string::npos) << finding.cure;
}

TEST(CarrierClearance, WithoutACarrierNothingIsSaid) {
  const auto train = lay_out(test::prototype(0.5225, 1.9967, 25.6826));
  EXPECT_EQ(check_axial(*train).size(), 1U);
}

}  // namespace
}  // namespace trueflank
