// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/check/check_designs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/clearance/clearance_field.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/mesh_clearance.h"

// What small clearances are made of, by formulas and by turning the teeth.
namespace trueflank::test {
namespace {

TEST(ModifiedClearanceFigures, ACrownedWheelBesideAPlainPinionIsNearestInTheMiddle) {
  GearboxDesign design = pair_design(23, 37, false, 0.1);
  gear(design, "wheel").modifications.crowning_um = 20.0;
  const GearTrain train = laid_out(design);
  const double cosine = std::cos(working_pressure_angle_rad(train.pair(train.meshes[0])));
  const MeshState state = mesh_states(train)[0];
  EXPECT_NEAR(state.centred.clearance_mm, 0.05 * cosine, 1e-6);
  EXPECT_NEAR(state.centred.z_mm, 5.0, 1e-9);
}

TEST(OverlapFigures, TeethThatModificationsMakePenetrateAskForTheBacklashTheyLack) {
  GearboxDesign design = pair_design(23, 37, false, 0.0);
  gear(design, "pinion").modifications.profile_slope_um = 20.0;
  const GearTrain train = laid_out(design);
  const Finding overlap = only(check_gearbox(train), "overlap");
  ASSERT_EQ(overlap.status, CheckStatus::kFail);
  EXPECT_LT(overlap.value, -5.0);
  const std::string start =
      "without their modifications these teeth clear each other: smaller slopes, or backlash_mm "
      "larger by ";
  ASSERT_EQ(overlap.cure.substr(0, start.size()), start);
  const double larger_mm = std::stod(overlap.cure.substr(start.size()));
  const double cosine = std::cos(working_pressure_angle_rad(train.pair(train.meshes[0])));
  EXPECT_NEAR(larger_mm, -2e-3 * overlap.value / cosine, 1e-5);
  design.backlash_mm = larger_mm + 1e-5;
  EXPECT_NE(only(check_gearbox(laid_out(design)), "overlap").status, CheckStatus::kFail);
}

TEST(OverlapFigures, SayWhetherThereIsClearanceOrTheFlanksTouch) {
  const auto message = [](double backlash_mm) {
    const Finding overlap =
        only(check_gearbox(laid_out(pair_design(25, 40, false, backlash_mm))), "overlap");
    EXPECT_EQ(overlap.status, CheckStatus::kPass);
    return overlap.message;
  };
  EXPECT_EQ(message(0.1).find("smallest clearance 46.98"), 0u)
      << message(0.1);  // 50 cos 20 degrees
  EXPECT_EQ(message(0.0).find("the flanks touch over a mesh cycle"), 0u) << message(0.0);
}

/// The clearance of a mesh with both gears thicker by so much and the axes farther apart.
double turned_clearance_mm(const GearTrain& train, const TrainMesh& mesh, double distance_mm,
                           double thickness_mm) {
  const GearPair pair = train.pair(mesh);
  Gear gear1 = pair.gear1(), gear2 = pair.gear2();
  gear1.thinning_mm -= thickness_mm;
  gear2.thinning_mm -= thickness_mm;
  const auto profile1 = ToothProfile::make(gear1), profile2 = ToothProfile::make(gear2);
  return sweep_clearance_mm({&*profile1, &*profile2, pair.centre_distance_mm + distance_mm});
}

TEST(ClearanceField, OfDistanceAndThicknessIsThatOfTheTurnedTeethWhereSetsBeginToJam) {
  const GearTrain train = laid_out(paper_design(0.05));
  constexpr double kWidth_mm = 0.15, kThickness_mm = 0.03;
  const GearSpread spread{.thickness_mm = kThickness_mm};
  double worst_um = 0.0;
  int near = 0;
  for (const TrainMesh& mesh : train.meshes) {
    auto field = ClearanceField::make(train, mesh, spread, spread, kWidth_mm);
    ASSERT_TRUE(field);
    for (const double v : {-0.65, 0.35, 0.85})
      for (int i = -10; i <= 10; ++i) {
        const double off_mm = kWidth_mm * i / 10.0;
        const double turned_um = 1e3 * turned_clearance_mm(train, mesh, off_mm, v * kThickness_mm);
        if (std::abs(turned_um) > 5.0) continue;
        ++near;
        const double told_um = 1e3 * field->clearance_mm(off_mm, 2.0 * v * kThickness_mm);
        worst_um = std::max(worst_um, std::abs(told_um - turned_um));
      }
  }
  EXPECT_GT(near, 5);
  EXPECT_LT(worst_um, 0.4);
}

}  // namespace
}  // namespace trueflank::test
