// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a process can just make, by formulas and by circles through points of the root.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/check/check_designs.h"
#include "tests/support/sample_gears.h"
#include "trueflank/check/manufacturability.h"

namespace trueflank::test {
namespace {

TEST(ManufacturabilityFigures, WhatIsAsLargeAsTheProcessWantsIsLargeEnough) {
  GearboxDesign d = pair_design(20, 41, false, 0.1);
  gear(d, "pinion").bore.diameter_mm = 8.0;
  const auto judged = [&](const Process& process) {
    d.made.process = process;
    return check_manufacturability(laid_out(d));
  };
  const GearTrain train = laid_out(d);
  const TrainGear& pinion = train.gears[0];
  const double tip = pinion.profile.tip_thickness_mm(), gap = least_gap_mm(pinion.profile),
               root = least_root_radius_mm(pinion.profile),
               wall = pinion.profile.root_radius_mm() - 4.0;
  // with rounding on either side
  for (const double more : {0.0, 1e-7, -1e-7, 1e-3, -1e-3}) {
    const bool warns = more > 1e-5;
    const Process at_limits[] = {{.name = "p", .least_wall_mm = wall + more},
                                 {.name = "p", .least_tip_mm = tip + more},
                                 {.name = "p", .least_gap_mm = gap + more},
                                 {.name = "p", .least_root_radius_mm = root + more}};
    const double values[] = {wall, tip, gap, root};
    for (std::size_t i = 0; i < 4; ++i) {
      const Finding f = only(judged(at_limits[i]), "manufacturability", "pinion");
      EXPECT_EQ(f.status == CheckStatus::kWarn, warns) << f.message;
      EXPECT_EQ(f.cure.empty(), !warns);
      EXPECT_NEAR(f.value, values[i], 1e-9);
      EXPECT_NEAR(f.limit, values[i] + more, 1e-9);
      EXPECT_NEAR(f.margin, std::abs(more) < 1e-6 ? 0.0 : -more, 1e-9);
    }
    const Finding mesh =
        only(judged({.name = "p", .backlash_mm = 0.1 + more}), "manufacturability", "pinion-wheel");
    EXPECT_EQ(mesh.status == CheckStatus::kWarn, warns) << mesh.message;
    EXPECT_NEAR(mesh.margin, std::abs(more) < 1e-6 ? 0.0 : -more, 1e-9);
    EXPECT_EQ(mesh.cure.empty(), !warns);
  }
  // the least of all counts, and all are told
  const Finding two =
      only(judged({.name = "p", .least_tip_mm = tip + 0.02, .least_gap_mm = gap + 0.03}),
           "manufacturability", "pinion");
  EXPECT_NEAR(two.margin, -0.03, 1e-9);
  EXPECT_NEAR(told(two.message, "tooth tip "), tip, 1e-4) << two.message;
  EXPECT_NEAR(told(two.message, "root form circle "), gap, 1e-4) << two.message;
}

TEST(ManufacturabilityFigures, TheRimOfARingIsFromItsRootsOutwards) {
  GearboxDesign d = pair_design(20, 60, true, 0.1);
  const double root = laid_out(d).gears[1].profile.root_radius_mm();
  for (const double less : {-0.2, 0.2}) {
    d.made.process = Process{.name = "p", .least_wall_mm = 3.0 + less};
    gear(d, "wheel").outer_diameter_mm = 2.0 * (root + 3.0);
    const Finding f = only(check_manufacturability(laid_out(d)), "manufacturability", "wheel");
    EXPECT_EQ(f.status, less > 0.0 ? CheckStatus::kWarn : CheckStatus::kPass) << f.message;
    EXPECT_NEAR(f.value, 3.0, 1e-9);
    EXPECT_NEAR(f.margin, -less, 1e-9);
    EXPECT_EQ(f.cure, less > 0.0 ? "a larger outer_diameter_mm" : "");
    gear(d, "wheel").outer_diameter_mm.reset();  // a rim that is not said is as thick as it must be
    EXPECT_EQ(only(check_manufacturability(laid_out(d)), "manufacturability", "wheel").status,
              CheckStatus::kPass);
  }
}

TEST(ManufacturabilityFigures, RootRadiusOfARackIsTheStandards) {
  // ISO 6336-3 at the bottom of the trochoid: rho + 2 G^2 / (z - 2 G), G = rho - h_fP + x
  for (const int teeth : {20, 33, 60, 120})
    for (const double shift : {0.0, 0.3}) {
      Gear gear{.teeth = teeth, .shift = shift};
      gear.tip_radius_mm = nominal_tip_radius_mm(gear);
      const double g = 0.38 - 1.25 + shift;
      EXPECT_NEAR(least_root_radius_mm(*ToothProfile::make(gear)),
                  0.38 + 2.0 * g * g / (teeth - 2.0 * g), 2e-3)
          << teeth;
    }
}

TEST(ManufacturabilityFigures, RootRadiusIsTheLeastOfAllCirclesThroughThreePoints) {
  int rounded = 0;
  for (const SampleGear& sample : sample_gears()) {
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile);
    const double found = least_root_radius_mm(*profile);
    if (std::isnan(found) || found == 0.0) continue;  // no fillet, or a sharp corner
    double least = 1e300;
    for (const ProfilePiece& piece : profile->pieces()) {
      if (piece.kind != PieceKind::kFillet || std::holds_alternative<Involute>(piece.curve.shape))
        continue;
      const auto at = [&](int i) {
        return point_at(piece.curve, std::lerp(piece.curve.begin, piece.curve.end, i / 400.0));
      };
      for (int i = 1; i < 400; ++i) {
        const Point2 a = at(i) - at(i - 1), b = at(i + 1) - at(i), c = at(i + 1) - at(i - 1);
        least = std::min(least, a.norm() * b.norm() * c.norm() / (2.0 * std::abs(cross(a, b))));
      }
    }
    EXPECT_NEAR(found, least, 0.01 * least) << sample.name;
    ++rounded;
  }
  EXPECT_GT(rounded, 8);
}

}  // namespace
}  // namespace trueflank::test
