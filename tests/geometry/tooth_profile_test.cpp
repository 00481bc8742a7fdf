// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/tooth_profile.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/rolling_tool.h"
#include "tests/support/sample_gears.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {
namespace {

using test::described;

using testing::PinionTool;
using testing::RackTool;

Gear external_gear(int teeth, double shift, double root_radius = 0.38) {
  Gear gear{.teeth = teeth, .shift = shift};
  gear.rack.root_radius = root_radius;
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

Gear ring_gear(int teeth, double shift) {
  Gear gear{.kind = GearKind::kInternal, .teeth = teeth, .shift = shift};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

void expect_pieces_join(const ToothProfile& profile, const std::string& what) {
  const auto& pieces = profile.pieces();
  ASSERT_FALSE(pieces.empty()) << what;
  EXPECT_NEAR(pieces.front().curve.start_point().y(), 0.0, 1e-9) << what;
  EXPECT_NEAR(polar_angle_rad(pieces.back().curve.end_point()), kPi / profile.gear().teeth, 1e-9)
      << what;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    EXPECT_LT((pieces[i].curve.start_point() - pieces[i - 1].curve.end_point()).norm(), 1e-9)
        << what << " at piece " << i;
}

/// Every point of flank, fillet and root is touched by the rolling rack, and none is cut.
void expect_rack_generates(const ToothProfile& profile) {
  const Gear& g = profile.gear();
  const double m = g.normal_module_mm, alpha = g.rack.pressure_angle_rad;
  const RackTool rack{.alpha = alpha,
                      .half_width = 0.25 * kPi * m + 0.5 * g.thinning_mm,
                      .depth = g.rack.dedendum * m,
                      .rho = profile.root_radius_coefficient() * m};
  for (const ProfilePiece& piece : profile.pieces()) {
    if (piece.kind == PieceKind::kTip) continue;
    for (double u : {0.02, 0.3, 0.55, 0.8, 0.98}) {
      const Curve& c = piece.curve;
      const Point2 p = rotated(point_at(c, c.begin + u * (c.end - c.begin)), -kPi / g.teeth);
      const double miss = testing::rack_miss(rack, 0.5 * m * g.teeth, g.shift * m, p,
                                             0.6 + 8.0 / g.teeth);
      EXPECT_NEAR(miss, 0.0, tolerance::kCurve_mm * std::max(1.0, m))
          << described(g) << " piece " << static_cast<int>(piece.kind) << " u " << u;
    }
  }
}

TEST(ToothProfile, IsWhatTheRollingRackCuts) {
  for (const Gear& gear :
       {external_gear(12, -0.147668), external_gear(39, 0.335), external_gear(8, 0.0),
        external_gear(5, 0.6), external_gear(17, 0.0), external_gear(32, 2.0),
        external_gear(500, 0.0), external_gear(12, 0.3, 0.0), external_gear(9, 0.0, 0.0),
        external_gear(25, 0.0, 0.6)}) {
    const auto profile = ToothProfile::make(gear);
    ASSERT_TRUE(profile) << described(gear) << profile.error().message;
    expect_pieces_join(*profile, described(gear));
    expect_rack_generates(*profile);
  }
}

TEST(ToothProfile, IsWhatTheRollingRackCutsForRandomGears) {
  std::mt19937 random(20260101);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int made = 0, undercut = 0;
  for (int i = 0; i < 150; ++i) {
    Gear gear{.teeth = static_cast<int>(std::exp(uniform(std::log(5.0), std::log(300.0)))),
              .normal_module_mm = std::exp(uniform(-1.5, 1.5)),
              .shift = uniform(-1.0, 2.0)};
    gear.rack.pressure_angle_rad = rad_from_deg(uniform(14.5, 30.0));
    gear.rack.addendum = uniform(0.7, 1.2);
    gear.rack.dedendum = uniform(1.0, 1.5);
    gear.rack.root_radius = i % 4 == 0 ? 0.0 : uniform(0.0, 0.6);
    gear.thinning_mm = i % 3 == 0 ? 0.0 : uniform(0.0, 0.1) * gear.normal_module_mm;
    gear.tip_radius_mm = nominal_tip_radius_mm(gear);
    if (gear.tip_radius_mm <= 0.0) continue;
    const auto profile = ToothProfile::make(gear);
    if (!profile) {
      EXPECT_FALSE(profile.error().message.empty());
      EXPECT_FALSE(profile.error().remedy.empty());
      continue;
    }
    ++made;
    undercut += profile->notes().undercut;
    expect_pieces_join(*profile, described(gear));
    expect_rack_generates(*profile);
    if (HasFailure()) return;
  }
  EXPECT_GT(made, 90);
  EXPECT_GT(undercut, 10);
}

TEST(ToothProfile, UndercutLeavesNoMaterialTheRackWouldTake) {
  // 8 teeth: above the crossing of trochoid and involute the flank is the involute, below the
  // trochoid; the known limit for undercut-free generation is z >= 2 (hf - rho (1 - sin a)) / sin^2 a.
  const auto eight = ToothProfile::make(external_gear(8, 0.0));
  ASSERT_TRUE(eight);
  EXPECT_TRUE(eight->notes().undercut);
  EXPECT_GT(eight->root_form_radius_mm(), base_radius_mm(eight->gear()));
  const double sine = std::sin(rad_from_deg(20.0));
  const double limit = 2.0 * (1.25 - 0.38 * (1.0 - sine)) / (sine * sine);
  EXPECT_NEAR(limit, 17.1, 0.05);
  EXPECT_TRUE(ToothProfile::make(external_gear(17, 0.0))->notes().undercut);
  EXPECT_FALSE(ToothProfile::make(external_gear(18, 0.0))->notes().undercut);
}

// ---------------------------------------------------------------- rings

TEST(ToothProfile, RingFilletTouchesFlankAndRootCircle) {
  for (const Gear& gear : {ring_gear(90, 0.5225), ring_gear(81, 1.9967), ring_gear(40, 0.0),
                           ring_gear(200, -0.5)}) {
    const auto profile = ToothProfile::make(gear);
    ASSERT_TRUE(profile) << described(gear);
    expect_pieces_join(*profile, described(gear));
    const auto& pieces = profile->pieces();
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      if (pieces[i].kind != PieceKind::kFillet) continue;
      const Curve &flank = pieces[i - 1].curve, &fillet = pieces[i].curve;
      EXPECT_NEAR(cross(tangent_at(flank, flank.end), tangent_at(fillet, fillet.begin)), 0.0, 1e-9)
          << described(gear);
      EXPECT_NEAR(fillet.end_point().norm(), nominal_root_radius_mm(gear), 1e-9);
      EXPECT_NEAR(tangent_at(fillet, fillet.end).dot(unit_vector(
                      polar_angle_rad(fillet.end_point()))), 0.0, 1e-9);
    }
  }
}

/// As expect_rack_generates with a rolling pinion cutter; the cutter's place is found by plain
/// bisection on its backlash, not by the library's involute relations.
void expect_cutter_generates(const ToothProfile& profile) {
  const Gear& g = profile.gear();
  const ShaperCutter& c = *g.cutter;
  const double m = g.normal_module_mm, alpha = g.rack.pressure_angle_rad;
  const double inv = std::tan(alpha) - alpha;
  const double r_c = 0.5 * m * c.teeth, r_r = 0.5 * m * g.teeth;
  const double base_c = r_c * std::cos(alpha), base_r = r_r * std::cos(alpha);
  const double psi_c = 0.5 * kPi / c.teeth + 2.0 * c.shift * std::tan(alpha) / c.teeth + inv +
                       0.5 * g.thinning_mm / r_c;
  const double psi_r = 0.5 * kPi / g.teeth - 2.0 * g.shift * std::tan(alpha) / g.teeth - inv -
                       0.5 * g.thinning_mm / r_r;
  const double centre_distance =
      testing::shaping_distance(base_c, psi_c, base_r, psi_r, g.teeth);
  const double root = r_r + m * (g.rack.dedendum + g.shift);
  const PinionTool tool{base_c, psi_c, root - centre_distance,
                        profile.root_radius_coefficient() * m};
  for (const ProfilePiece& piece : profile.pieces()) {
    if (piece.kind == PieceKind::kTip) continue;
    for (double u : {0.02, 0.3, 0.55, 0.8, 0.98}) {
      const Curve& k = piece.curve;
      const Point2 p = rotated(point_at(k, k.begin + u * (k.end - k.begin)), -kPi / g.teeth);
      const double miss = testing::pinion_miss(tool, centre_distance,
                                               static_cast<double>(c.teeth) / g.teeth, p, kPi);
      EXPECT_NEAR(miss, 0.0, tolerance::kCurve_mm * std::max(1.0, m))
          << described(g) << " piece " << static_cast<int>(piece.kind) << " u " << u;
    }
  }
}

TEST(ToothProfile, ShapedRingIsWhatTheRollingCutterCuts) {
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int made = 0, trimmed = 0;
  for (int i = 0; i < 120; ++i) {
    const double shift = uniform(-0.3, 1.5);  // not drawn within the call: there each compiler has its own order
    Gear gear = ring_gear(static_cast<int>(uniform(30, 130)), shift);
    gear.ring_root = RingRoot::kShaper;
    const int fewest = std::min(12, gear.teeth - 3);
    gear.cutter = ShaperCutter{.teeth = i % 3 == 0 ? gear.teeth - static_cast<int>(uniform(4, 12))
                                                   : static_cast<int>(uniform(fewest, 30)),
                               .shift = uniform(-0.1, 0.3),
                               .tip_radius = i % 4 == 0 ? 0.0 : uniform(0.0, 0.35)};
    gear.thinning_mm = i % 2 == 0 ? 0.0 : uniform(0.0, 0.1);
    const auto profile = ToothProfile::make(gear);
    if (!profile) {
      EXPECT_FALSE(profile.error().remedy.empty());
      continue;
    }
    ++made;
    trimmed += profile->notes().tip_trimmed;
    expect_pieces_join(*profile, described(gear));
    expect_cutter_generates(*profile);
    if (HasFailure()) return;
  }
  EXPECT_GT(made, 60);
  EXPECT_GT(trimmed, 2);
}

/// The cutter of nearly as many teeth turns far while it passes one place.
TEST(ToothProfile, RingShapedByACutterOfNearlyItsTeethIsWhatItCuts) {
  Gear gear = ring_gear(78, 0.267054);
  gear.ring_root = RingRoot::kShaper;
  gear.cutter = ShaperCutter{.teeth = 74, .shift = 0.12758, .tip_radius = 0.345017};
  gear.thinning_mm = 0.037323;
  const auto profile = ToothProfile::make(gear);
  ASSERT_TRUE(profile);
  EXPECT_TRUE(profile->notes().tip_trimmed);
  expect_cutter_generates(*profile);
}

// ---------------------------------------------------------------- ends

TEST(ToothProfile, PointedToothEndsWhereItsFlanksMeet) {
  Gear gear = external_gear(8, 0.9);
  const auto profile = ToothProfile::make(gear);
  ASSERT_TRUE(profile);
  EXPECT_TRUE(profile->notes().pointed);
  EXPECT_LT(profile->tip_radius_mm(), gear.tip_radius_mm);
  EXPECT_NEAR(tooth_thickness_mm(gear, profile->tip_radius_mm()), 0.0, 1e-12);
  EXPECT_EQ(profile->tip_thickness_mm(), 0.0);
  expect_pieces_join(*profile, "pointed");
}

TEST(ToothProfile, RingTipInsideTheBaseCircleIsRadial) {
  const auto profile = ToothProfile::make(ring_gear(24, 0.0));
  ASSERT_TRUE(profile);
  EXPECT_TRUE(profile->notes().tip_inside_base);
  expect_pieces_join(*profile, "z 24");
  EXPECT_NEAR(profile->tip_form_radius_mm(), base_radius_mm(profile->gear()), 1e-12);
}

TEST(ToothProfile, RingWithoutSpacesIsRefused) {
  Gear gear = ring_gear(500, -10.0);
  gear.rack.pressure_angle_rad = rad_from_deg(14.5);
  gear.rack.dedendum = 3.0;
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  const auto profile = ToothProfile::make(gear);
  ASSERT_FALSE(profile);
  EXPECT_EQ(profile.error().key, "shift");
}

TEST(ToothProfile, RefusesWhatCannotBeMade) {
  const auto error_of = [](const Gear& gear) {
    const auto profile = ToothProfile::make(gear);
    EXPECT_FALSE(profile) << described(gear);
    return profile ? Error{} : profile.error();
  };
  Gear pointed_rack = external_gear(30, 0.0);
  pointed_rack.rack.dedendum = 2.3;
  EXPECT_EQ(error_of(pointed_rack).key, "rack.dedendum");
  EXPECT_EQ(error_of(external_gear(5, -1.0)).code, ErrorCode::kInfeasible);
  Gear no_cutter = ring_gear(60, 0.0);
  no_cutter.ring_root = RingRoot::kShaper;
  EXPECT_EQ(error_of(no_cutter).code, ErrorCode::kMissingKey);
  no_cutter.cutter = ShaperCutter{.teeth = 60};
  EXPECT_EQ(error_of(no_cutter).key, "cutter.teeth");
  EXPECT_EQ(error_of(external_gear(2, 0.0)).key, "teeth");
  Gear nan_shift = external_gear(20, kNaN);
  EXPECT_EQ(error_of(nan_shift).code, ErrorCode::kOutOfRange);
}

/// The rounding by what it must be: tangent to tip circle and flank, its radius from both.
void expect_rounding(Gear gear, double rho) {
  const auto sharp = ToothProfile::make(gear);
  gear.tip_rounding_mm = rho;
  const auto profile = ToothProfile::make(gear);
  const std::string what = described(gear) + " rounding " + std::to_string(rho);
  ASSERT_TRUE(sharp && profile) << what;
  expect_pieces_join(*profile, what);
  const auto& pieces = profile->pieces();
  const auto found = std::find_if(pieces.begin(), pieces.end(), [](const ProfilePiece& p) {
    return p.kind == PieceKind::kTipRounding;
  });
  ASSERT_NE(found, pieces.end()) << what;
  const auto& arc = std::get<CircularArc>(found->curve.shape);
  EXPECT_EQ(arc.radius_mm, rho);
  const double sense = gear.kind == GearKind::kExternal ? 1.0 : -1.0;
  EXPECT_NEAR(sense * (profile->tip_radius_mm() - arc.centre.norm()), rho, 1e-12) << what;
  // the sharp tooth's flank, searched for its point nearest to the centre
  const Curve* flank = nullptr;
  for (const ProfilePiece& piece : sharp->pieces())
    if (piece.kind == PieceKind::kInvolute) flank = &piece.curve;
  const double nearest = testing::smallest(
      [&](double xi) { return (point_at(*flank, xi) - arc.centre).norm(); },
      std::min(flank->begin, flank->end), std::max(flank->begin, flank->end));
  EXPECT_NEAR(nearest, rho, 1e-9) << what;
  // the involute ends where the arc touches it, without a corner
  const Point2 joint = found->curve.end_point();
  EXPECT_NEAR(joint.norm(), profile->tip_form_radius_mm(), 1e-12) << what;
  const Curve& rest = std::next(found)->curve;
  EXPECT_NEAR(cross(tangent_at(found->curve, found->curve.end), tangent_at(rest, rest.begin)), 0.0,
              1e-12)
      << what;
  EXPECT_LT(profile->tip_thickness_mm(), sharp->tip_thickness_mm()) << what;
}

TEST(ToothProfile, TipRoundingIsTangentToTipCircleAndFlank) {
  expect_rounding(external_gear(24, 0.1), 0.15);
  expect_rounding(external_gear(13, 0.3), 0.1);
  expect_rounding(ring_gear(60, 0.2), 0.12);
  Gear helical = external_gear(31, -0.1);
  helical.helix_angle_rad = rad_from_deg(-27.0);
  helical.tip_radius_mm = nominal_tip_radius_mm(helical);
  expect_rounding(helical, 0.2);
}

TEST(ToothProfile, TipRoundingFillsTheLandAtMostAndSaysHowMuchFits) {
  Gear gear = external_gear(24, 0.1);
  gear.tip_rounding_mm = 0.7;
  const auto refused = ToothProfile::make(gear);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().key, "modifications.tip_rounding_mm");
  ASSERT_EQ(refused.error().remedy.rfind("at most ", 0), 0u) << refused.error().remedy;
  const double most = std::stod(refused.error().remedy.substr(8));
  gear.tip_rounding_mm = most - 1e-6;
  const auto largest = ToothProfile::make(gear);
  ASSERT_TRUE(largest);
  EXPECT_NEAR(largest->tip_thickness_mm(), 0.0, 1e-4);
  gear.tip_rounding_mm = most + 1e-5;
  EXPECT_FALSE(ToothProfile::make(gear));
  gear = external_gear(9, 1.0);  // pointed
  gear.tip_rounding_mm = 0.05;
  EXPECT_FALSE(ToothProfile::make(gear));
  gear = ring_gear(20, 0.0);  // tip inside the base circle
  gear.tip_rounding_mm = 0.05;
  EXPECT_FALSE(ToothProfile::make(gear));
}

}  // namespace
}  // namespace trueflank
