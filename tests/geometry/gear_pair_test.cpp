// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/gear_pair.h"

#include <gtest/gtest.h>

#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/tooth_span.h"

namespace trueflank {
namespace {

MeshTeeth teeth(int z1, int z2, bool internal, double helix_deg = 0.0, double module = 1.0) {
  return {.teeth1 = z1, .teeth2 = z2, .internal = internal, .normal_module_mm = module,
          .helix_angle_rad = rad_from_deg(helix_deg), .pressure_angle_rad = rad_from_deg(20.0)};
}

// Worked examples of the KHK gear calculation tables ("Gear technical reference", spur, internal and
// helical gears with profile shift), printed digits.
TEST(GearPair, ReproducesTheKhkSpurExample) {
  // m 3, z 12/24, x 0.6/0.36: alpha_w 26.0886 deg, y 0.83329, a 56.4999
  const MeshTeeth mesh = teeth(12, 24, false, 0.0, 3.0);
  const double a = zero_backlash_centre_distance_mm(mesh, 0.96).value();
  EXPECT_NEAR(a, 56.4999, 5e-5);
  EXPECT_NEAR(deg_from_rad(working_pressure_angle_rad(mesh, a).value()), 26.0886, 5e-5);
  EXPECT_NEAR(shift_sum(mesh, working_pressure_angle_rad(mesh, 56.4999).value()), 0.96, 5e-5);
}

TEST(GearPair, ReproducesTheKhkInternalExample) {
  // m 3, z 16/24, x 0/0.5: alpha_w 31.0937 deg, y 0.38943, a 13.1683
  const MeshTeeth mesh = teeth(16, 24, true, 0.0, 3.0);
  const double a = zero_backlash_centre_distance_mm(mesh, 0.5).value();
  EXPECT_NEAR(a, 13.1683, 5e-4);
  EXPECT_NEAR(deg_from_rad(working_pressure_angle_rad(mesh, a).value()), 31.0937, 5e-4);
}

TEST(GearPair, ContactRatioOfTheTextbookPair) {
  // m 3, z 12/24 without shift, a 54: KHK 1.4 by tip circles; here by the paths drawn numerically
  Gear g1{.teeth = 12, .normal_module_mm = 3.0}, g2{.teeth = 24, .normal_module_mm = 3.0};
  g1.tip_radius_mm = 21.0;
  g2.tip_radius_mm = 39.0;
  const auto p1 = ToothProfile::make(g1), p2 = ToothProfile::make(g2);
  const GearPair pair{&*p1, &*p2, 54.0};
  const ContactRatios ratios = contact_ratios(pair);
  // sqrt(21^2 - (18 cos 20)^2) + sqrt(39^2 - (36 cos 20)^2) - 54 sin 20 over 3 pi cos 20
  const double c = std::cos(rad_from_deg(20.0)), s = std::sin(rad_from_deg(20.0));
  const double path = std::sqrt(21.0 * 21.0 - 324.0 * c * c) +
                      std::sqrt(39.0 * 39.0 - 1296.0 * c * c) - 54.0 * s;
  EXPECT_NEAR(ratios.total, path / (3.0 * kPi * c), 1e-12);
  EXPECT_LT(ratios.effective, ratios.total);  // 12 teeth are undercut
  EXPECT_NEAR(circumferential_backlash_mm(pair), 0.0, 1e-12);
}

TEST(GearPair, BacklashIsThePlayFoundByTurning) {
  // thinned internal pair: the angle by which the pinion turns free, on the polar flanks themselves
  Gear g1{.teeth = 32, .shift = 0.6, .thinning_mm = 0.03};
  Gear g2{.kind = GearKind::kInternal, .teeth = 81, .shift = 2.0, .thinning_mm = 0.02};
  g1.tip_radius_mm = nominal_tip_radius_mm(g1);
  g2.tip_radius_mm = nominal_tip_radius_mm(g2);
  const auto p1 = ToothProfile::make(g1), p2 = ToothProfile::make(g2);
  const GearPair pair{&*p1, &*p2, 25.7};
  const double r1 = pitch_radius1_mm(pair), r2 = pitch_radius2_mm(pair);
  EXPECT_NEAR(r2 - r1, 25.7, 1e-12);
  // tooth of the pinion and space of the ring at the pitch circles
  const double tooth = tooth_thickness_mm(g1, r1);
  const double space = kTwoPi * r2 / 81 - tooth_thickness_mm(g2, r2);
  EXPECT_NEAR(circumferential_backlash_mm(pair), space - tooth, 1e-12);
}

TEST(ToothSpan, SpanIsTheDistanceOfParallelPlanesOnTheTeeth) {
  // brute force: the widest separation of the k-tooth bundle across a direction is between tangent
  // planes; for involutes it does not depend on the direction
  Gear gear{.teeth = 39, .shift = 0.3351, .thinning_mm = 0.025};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  const int k = recommended_span_teeth(gear);
  const double expected = base_tangent_length_mm(gear, k);
  const double r_b = base_radius_mm(gear), psi = base_half_angle_rad(gear);
  const double outermost = psi + kPi * (k - 1) / gear.teeth;  // half the bundle's base angle
  // support of the involute point in direction y, bundle symmetric about x
  double widest = 0.0;
  for (int i = 0; i <= 200000; ++i) {
    const double xi = 1.2 * i / 200000.0, tau = outermost - xi;
    widest = std::max(widest, r_b * (std::sin(tau) + xi * std::cos(tau)));
  }
  EXPECT_NEAR(2.0 * widest, expected, 1e-9);
  EXPECT_EQ(k, 5);
}

/// A pin centred in the gap touches the flank: numerical distance of its centre to the flank.
TEST(ToothSpan, PinTouchesBothFlanks) {
  for (const GearKind kind : {GearKind::kExternal, GearKind::kInternal}) {
    for (const int z : {31, 40}) {
      Gear gear{.kind = kind, .teeth = z, .shift = 0.4, .thinning_mm = 0.04};
      gear.tip_radius_mm = nominal_tip_radius_mm(gear);
      const auto profile = ToothProfile::make(gear);
      ASSERT_TRUE(profile);
      const double d = recommended_pin_diameter_mm(gear);
      const double over = over_pins_mm(gear, d);
      const double sign = kind == GearKind::kExternal ? 1.0 : -1.0;
      const double across = over - sign * d;
      const double r_c = 0.5 * (z % 2 == 0 ? across : across / std::cos(0.5 * kPi / z));
      const Point2 centre = r_c * unit_vector(kPi / z);
      double nearest = 1e300;
      for (const ProfilePiece& piece : profile->pieces()) {
        if (piece.kind != PieceKind::kInvolute) continue;
        for (int i = 0; i <= 100000; ++i)
          nearest = std::min(nearest, (point_at(piece.curve, piece.curve.begin +
              (piece.curve.end - piece.curve.begin) * i / 100000.0) - centre).norm());
      }
      EXPECT_NEAR(nearest, 0.5 * d, 1e-8) << z << (sign > 0 ? " external" : " ring");
    }
  }
}

TEST(Involute, InverseUndoesTheFunction) {
  for (double a = 1e-7; a < 1.5; a = a * 1.07) {
    const double back = inverse_involute_rad(involute_function(a));
    EXPECT_NEAR(back, a, 1e-13 * (1.0 + 1.0 / (a * a) * 1e-3 * a * a)) << a;
  }
  EXPECT_EQ(inverse_involute_rad(0.0), 0.0);
  // printed in every gear table: inv 20 deg = 0.014904
  EXPECT_NEAR(involute_function(rad_from_deg(20.0)), 0.014904, 5e-7);
}

}  // namespace
}  // namespace trueflank
