// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/toothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

Gear gear_of(GearKind kind, double helix_deg) {
  Gear gear{.kind = kind, .teeth = kind == GearKind::kExternal ? 23 : 61,
            .normal_module_mm = 2.0, .helix_angle_rad = rad_from_deg(helix_deg), .shift = 0.2};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

std::size_t flank_piece(const ToothProfile& profile) {
  for (std::size_t i = 0; i < profile.pieces().size(); ++i)
    if (profile.pieces()[i].kind == PieceKind::kInvolute) return i;
  return 0;
}

/// Independent of the turning: the design flank's point moved along its normal.
class OffsetFlank : public ::testing::TestWithParam<std::pair<GearKind, double>> {};

TEST_P(OffsetFlank, EveryPointLiesTheDeviationAwayFromTheDesign) {
  const auto profile = ToothProfile::make(gear_of(GetParam().first, GetParam().second));
  ASSERT_TRUE(profile);
  const auto field = [](int, Flank flank, double roll_mm, double) {
    return (flank == Flank::kLeft ? 0.02 : -0.03) + 0.01 * roll_mm * roll_mm / 50.0;
  };
  FlankDeviation deviation{.deviation_mm = field};
  const Toothing toothing{.profile = &*profile, .twist = {.face_width_mm = 10.0},
                          .deviation = &deviation};
  const std::size_t piece = flank_piece(*profile);
  const Curve& curve = profile->pieces()[piece].curve;
  const double r_b = base_radius_mm(profile->gear());
  const double cos_b = std::cos(base_helix_angle_rad(profile->gear()));
  for (int side : {1, -1})
    for (double share : {0.1, 0.5, 0.9}) {
      const double at = curve.begin + share * (curve.end - curve.begin);
      const Point2 p =
          section_point(toothing, {.tooth = 0, .side = side, .piece = piece, .parameter = at}, 5.0);
      const Point2 q(p.x(), side * p.y());
      // nearest point of the design flank, by Newton on the distance
      double xi = at;
      for (int i = 0; i < 60; ++i) {
        const Point2 tangent = tangent_at(curve, xi);
        const double step = 1e-7 * (curve.end - curve.begin);
        const double speed =
            (point_at(curve, xi + step) - point_at(curve, xi - step)).dot(tangent) / (2 * step);
        xi += (q - point_at(curve, xi)).dot(tangent) / speed;
      }
      const Point2 out = perpendicular(tangent_at(curve, xi));
      const double sign = out.y() > 0.0 ? 1.0 : -1.0;  // the counter-clockwise flank faces +y
      const Flank flank =
          flank_side(Flank::kLeft, profile->gear().kind) == side ? Flank::kLeft : Flank::kRight;
      EXPECT_NEAR(sign * (q - point_at(curve, xi)).dot(out) * cos_b,
                  field(0, flank, r_b * xi, 0.0), 1e-9)
          << "side " << side << " share " << share;
    }
}
INSTANTIATE_TEST_SUITE_P(Gears, OffsetFlank,
                         ::testing::Values(std::pair{GearKind::kExternal, 0.0},
                                           std::pair{GearKind::kInternal, 0.0},
                                           std::pair{GearKind::kExternal, 25.0},
                                           std::pair{GearKind::kInternal, -15.0}));

TEST(Toothing, RightHandTurnsCounterClockwiseWithHeightAndHerringboneComesBack) {
  const Gear gear = gear_of(GearKind::kExternal, 20.0);
  const FaceTwist helical = face_twist(gear, 12.0, false);
  EXPECT_GT(section_turn_rad(helical, 12.0), 0.0);
  // on the reference cylinder the trace leans by the helix angle
  EXPECT_NEAR(section_turn_rad(helical, 12.0) * reference_radius_mm(gear) / 12.0,
              std::tan(gear.helix_angle_rad), 1e-15);
  const FaceTwist herringbone = face_twist(gear, 12.0, true);
  EXPECT_NEAR(section_turn_rad(herringbone, 12.0), 0.0, 1e-15);
  EXPECT_EQ(section_turn_rad(herringbone, 4.0), section_turn_rad(herringbone, 8.0));
}

TEST(Toothing, SurfaceIsContinuousFromTipToGapWithDeviationAndChamfer) {
  for (const GearKind kind : {GearKind::kExternal, GearKind::kInternal}) {
    const auto profile = ToothProfile::make(gear_of(kind, 10.0));
    ASSERT_TRUE(profile);
    FlankDeviation deviation{
        .deviation_mm = [](int, Flank, double roll, double z) { return 0.01 - 0.001 * roll * z; }};
    const Toothing toothing{.profile = &*profile, .twist = face_twist(profile->gear(), 9.0, true),
                            .deviation = &deviation, .edge_chamfer_mm = 0.3};
    const auto& pieces = profile->pieces();
    for (double z : {0.0, 0.1, 0.3, 5.0, 9.0}) {
      for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
        const auto a = surface_point(toothing, {0, 1, i, pieces[i].curve.end}, z);
        const auto b = surface_point(toothing, {0, 1, i + 1, pieces[i + 1].curve.begin}, z);
        EXPECT_NEAR(std::hypot(a[0] - b[0], a[1] - b[1]), 0.0, 1e-11) << "piece " << i << " z " << z;
      }
      const std::size_t last = pieces.size() - 1;
      const auto a = surface_point(toothing, {0, 1, last, pieces[last].curve.end}, z);
      const auto b = surface_point(toothing, {1, -1, last, pieces[last].curve.end}, z);
      EXPECT_NEAR(std::hypot(a[0] - b[0], a[1] - b[1]), 0.0, 1e-11);
    }
  }
}

TEST(Toothing, ChamferLowersTheTipByItsDepthAtTheEndFace) {
  const auto profile = ToothProfile::make(gear_of(GearKind::kExternal, 0.0));
  ASSERT_TRUE(profile);
  const Toothing toothing{.profile = &*profile, .twist = {.face_width_mm = 9.0},
                          .edge_chamfer_mm = 0.25};
  const ProfilePiece& tip = profile->pieces().front();
  ASSERT_EQ(tip.kind, PieceKind::kTip);
  EXPECT_NEAR(section_point(toothing, {0, 1, 0, tip.curve.end}, 0.0).norm(),
              profile->tip_radius_mm() - 0.25, 1e-12);
  EXPECT_NEAR(section_point(toothing, {0, 1, 0, tip.curve.end}, 0.25).norm(),
              profile->tip_radius_mm(), 1e-12);
}

}  // namespace
}  // namespace trueflank
