// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/clear_tips.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/train_members.h"
#include "tests/train/prototype_design.h"

namespace trueflank {
namespace {

using test::laid_out;

TEST(ClearTips, EndContactAMarginShortOfTheMatesRootForm) {
  GearboxDesign design = test::unshifted("pair", "wheel", {12, 60});
  design.tips = TipCircles::kClear;
  const GearTrain train = laid_out(design);
  const GearPair pair = train.pair(train.meshes[0]);
  EXPECT_GT(train.gears[1].tip_shortened_mm, 0.0);
  EXPECT_NEAR(line_of_action(pair).start_mm - pair.profile1->root_form_roll_length_mm(), kTipMargin, 1e-9);
  EXPECT_EQ(train.gears[0].tip_shortened_mm, 0.0);
}

TEST(ClearTips, CostNothingButTheMargin) {
  for (const auto& [z1, z2] : {std::pair{10, 40}, {12, 60}, {14, 100}}) {
    GearboxDesign design = test::unshifted("pair", "wheel", {z1, z2});
    const GearTrain standard = laid_out(design);
    design.tips = TipCircles::kClear;
    const GearTrain clear = laid_out(design);
    const double before = contact_ratios(standard.pair(standard.meshes[0])).effective;
    const double after = contact_ratios(clear.pair(clear.meshes[0])).effective;
    EXPECT_NEAR(before - after, kTipMargin / (kPi * std::cos(rad_from_deg(20.0))), 1e-9) << z1;
  }
}

TEST(ClearTips, RingsEndFartherOutAndPlanetsAsTheTighterOfTheirMeshesAsks) {
  GearboxDesign design = test::unshifted("simple", "carrier", {24, 24, 72});
  design.tips = TipCircles::kClear;
  const GearTrain train = laid_out(design);
  const TrainGear& ring = *train.find("ring");
  EXPECT_GT(ring.tip_shortened_mm, 0.0);
  EXPECT_NEAR(ring.profile.tip_radius_mm(), 35.0 + ring.tip_shortened_mm, 1e-12);
}

TEST(ClearTips, KeepAPlanetsTipThatItsRingLivesOn) {
  // whatever a sun asks of its planets: no mesh is left with less contact than it can do with
  for (int sun = 7; sun <= 24; ++sun)
    for (int planet = 15; planet <= 45; planet += 3) {
      GearboxDesign design =
          test::unshifted("simple", "carrier", {sun, planet, sun + 2 * planet});
      const auto standard = lay_out(design);
      design.tips = TipCircles::kClear;
      const auto clear = lay_out(design);
      ASSERT_EQ(standard.has_value(), clear.has_value());
      if (!clear) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        const double before = contact_ratios(standard->pair(standard->meshes[k])).effective;
        const double after = contact_ratios(clear->pair(clear->meshes[k])).effective;
        EXPECT_TRUE(after >= 1.15 || before - after < 0.03) << sun << " " << planet << " " << before << " " << after;
      }
    }
}

TEST(ClearTips, KeepAWrittenDiameterAndTheStandardWhereAsked) {
  GearboxDesign design = test::unshifted("pair", "wheel", {12, 60});
  EXPECT_EQ(laid_out(design).gears[1].profile.tip_radius_mm(), 31.0);
  design.tips = TipCircles::kClear;
  design.gears[1].tip_diameter_mm = 61.9;
  const GearTrain train = laid_out(design);
  EXPECT_EQ(train.gears[1].profile.tip_radius_mm(), 30.95);
  EXPECT_EQ(train.gears[1].tip_shortened_mm, 0.0);
}

TEST(ClearTips, LeaveStandardTeethThatClearAlone) {
  GearboxDesign design = test::unshifted("pair", "wheel", {30, 60});
  design.tips = TipCircles::kClear;
  for (const TrainGear& gear : laid_out(design).gears) EXPECT_EQ(gear.tip_shortened_mm, 0.0);
}

}  // namespace
}  // namespace trueflank
