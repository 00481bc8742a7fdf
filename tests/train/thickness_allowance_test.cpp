// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/thickness_allowance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/tooth_span.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {
namespace {

void expect_um(const char* series, double diameter_mm, double upper_um, double lower_um) {
  const auto allowance = din3967_allowance(series, diameter_mm);
  ASSERT_TRUE(allowance) << series;
  EXPECT_NEAR(um_from_mm(allowance->upper_mm), upper_um, 1e-9) << series << " at " << diameter_mm;
  EXPECT_NEAR(um_from_mm(allowance->lower_mm), lower_um, 1e-9) << series << " at " << diameter_mm;
}

TEST(ThicknessAllowance, IsThatOfDin3967) {
  // the standard's own example, clause 3.1: 27cd at d = 100 mm
  expect_um("27cd", 100.0, -70.0, -170.0);
  expect_um("cd27", 100.0, -70.0, -170.0);
  expect_um("cd25", 40.0, -54.0, -84.0);
  expect_um("h21", 5.0, 0.0, -3.0);
  expect_um("a30", 10000.0, -2000.0, -4400.0);
}

TEST(ThicknessAllowance, UpperEndsOfTheRangesBelongToThem) {
  expect_um("a21", 10.0, -100.0, -103.0);
  expect_um("a21", 10.001, -135.0, -140.0);
  expect_um("cd24", 50.0, -54.0, -74.0);
  expect_um("cd24", 50.001, -70.0, -95.0);
}

TEST(ThicknessAllowance, GrowsWithTheDiameterAndFallsFromAToH) {
  const char* letters[] = {"a", "ab", "b", "bc", "c", "cd", "d", "e", "f", "g", "h"};
  const double diameters[] = {5, 20, 100, 200, 400, 800, 1300, 2000, 3000, 5000, 8000};
  for (int number = 21; number <= 30; ++number)
    for (int i = 0; i < 11; ++i)
      for (int k = 0; k < 11; ++k) {
        const auto at = [&](int letter, int range, int tolerance) {
          return *din3967_allowance(letters[letter] + std::to_string(tolerance), diameters[range]);
        };
        const ThicknessAllowance here = at(i, k, number);
        EXPECT_LT(here.lower_mm, here.upper_mm);
        if (i > 0) {
          EXPECT_GT(here.upper_mm, at(i - 1, k, number).upper_mm);
        }
        if (k > 0) {
          EXPECT_LE(here.upper_mm, at(i, k - 1, number).upper_mm);
        }
        if (number > 21) {
          const ThicknessAllowance finer = at(i, k, number - 1);
          EXPECT_GT(here.upper_mm - here.lower_mm, finer.upper_mm - finer.lower_mm);
        }
      }
}

TEST(ThicknessAllowance, UnknownSeriesAndLargeGearsAreRefused) {
  for (const char* series : {"", "cd", "25", "x25", "cd20", "cd31", "cd2", "cd255", "c d25"})
    EXPECT_FALSE(din3967_allowance(series, 40.0)) << series;
  EXPECT_FALSE(din3967_allowance("cd25", 10000.1));
}

GearboxDesign pair_design(double helix_deg = 0.0) {
  GearboxDesign design{.name = "pair", .topology = train_topology("pair")};
  design.module_mm = 2.0;
  design.helix_angle_rad = rad_from_deg(helix_deg);
  design.gears = {GearDesign{.name = "pinion", .teeth = 20, .shift = 0.3},
                  GearDesign{.name = "wheel", .teeth = 41, .shift = 0.1}};
  for (GearDesign& gear : design.gears) gear.thickness = ThicknessAllowance{.series = "cd25"};
  return design;
}

TEST(ThicknessAllowance, MakesTheTeethInTheMiddleOfTheirTolerance) {
  for (const double helix : {0.0, 25.0}) {
    const auto train = lay_out(pair_design(helix));
    ASSERT_TRUE(train);
    const double stretch = 1.0 / std::cos(rad_from_deg(helix));
    // d = 40 mm: -54, -84 um; d = 82 mm (90.5 with the helix): -70, -110 um
    EXPECT_NEAR(train->gears[0].profile.gear().thinning_mm, 0.069 * stretch, 1e-12);
    EXPECT_NEAR(train->gears[1].profile.gear().thinning_mm, 0.090 * stretch, 1e-12);
  }
}

TEST(ThicknessAllowance, BacklashIsBetweenThatOfThickestAndThinnestTeeth) {
  const auto train = lay_out(pair_design());
  ASSERT_TRUE(train);
  // at zero-backlash centre distance: normal backlash is the sum of the allowances times cos 20
  const TrainMesh& mesh = train->meshes[0];
  const double working = working_pressure_angle_rad(train->pair(mesh));
  EXPECT_NEAR(mesh.smallest_backlash_mm * std::cos(working),
              (0.054 + 0.070) * std::cos(rad_from_deg(20.0)), 1e-9);
  EXPECT_NEAR(mesh.largest_backlash_mm * std::cos(working),
              (0.084 + 0.110) * std::cos(rad_from_deg(20.0)), 1e-9);
  // and by gears made at those ends, gap less tooth on the working pitch circles
  for (const bool thick : {true, false}) {
    GearboxDesign design = pair_design();
    for (std::size_t i = 0; i < 2; ++i) {
      const ThinningLimits& limits = *train->gears[i].thinning_limits;
      design.gears[i].thickness.reset();
      design.gears[i].thinning_mm = thick ? limits.least_mm : limits.most_mm;
    }
    const auto end = lay_out(design);
    ASSERT_TRUE(end);
    EXPECT_NEAR(end->meshes[0].backlash_mm,
                thick ? mesh.smallest_backlash_mm : mesh.largest_backlash_mm, 1e-12);
    EXPECT_TRUE(std::isnan(end->meshes[0].smallest_backlash_mm));
  }
}

TEST(ThicknessAllowance, SpanChangesByTheAllowanceTimesTheCosineOfThePressureAngle) {
  // A_W = A_s cos alpha_n, in the normal section (DIN 3967, conversion of allowances)
  for (const double helix : {0.0, 25.0}) {
    const auto train = lay_out(pair_design(helix));
    ASSERT_TRUE(train);
    const TrainGear& gear = train->gears[0];
    const Gear& g = gear.profile.gear();
    const double nominal = base_tangent_length_mm(thinned(g, 0.0), 3);
    const double cosine = std::cos(rad_from_deg(20.0));
    EXPECT_NEAR(base_tangent_length_mm(thinned(g, gear.thinning_limits->least_mm), 3) - nominal,
                -0.054 * cosine, 1e-12);
    EXPECT_NEAR(base_tangent_length_mm(thinned(g, gear.thinning_limits->most_mm), 3) - nominal,
                -0.084 * cosine, 1e-12);
  }
}

TEST(ThicknessAllowance, MateWithoutOneTakesTheRestOfTheBacklash) {
  GearboxDesign design = pair_design();
  design.gears[1].thickness.reset();
  design.backlash_mm = 0.2;
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const TrainMesh& mesh = train->meshes[0];
  EXPECT_NEAR(mesh.backlash_mm, 0.2, 1e-12);
  EXPECT_LT(mesh.smallest_backlash_mm, mesh.backlash_mm);
  EXPECT_GT(mesh.largest_backlash_mm, mesh.backlash_mm);
}

TEST(ThicknessAllowance, ErrorsNameTheGearsKey) {
  GearboxDesign design = pair_design();
  design.gears[1].thickness->series = "zz99";
  const auto train = lay_out(design);
  ASSERT_FALSE(train);
  EXPECT_EQ(train.error().front().key, "wheel.thickness_allowance");
}

}  // namespace
}  // namespace trueflank
