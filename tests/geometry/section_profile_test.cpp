// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/section_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/sample_gears.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/polyline.h"

namespace trueflank {
namespace {

/// Relief with a kink, crowning over the face, a slope that turns the teeth.
FlankDeviation field_of(const ToothProfile& profile, double slope_mm) {
  const double tip = profile.tip_form_roll_length_mm(), root = profile.root_form_roll_length_mm();
  const double bend = root + 0.6 * (tip - root);
  const GearKind kind = profile.gear().kind;
  return {.deviation_mm =
              [=](int, Flank flank, double roll, double z) {
                const double past = (roll - bend) / (tip - bend);
                return -0.01 * std::max(0.0, past) - 0.0001 * (z - 5.0) * (z - 5.0) +
                       slope_mm * (z / 10.0 - 0.5) * flank_side(flank, kind);
              },
          .varies_along_face = true,
          .roll_breaks_mm = {bend}};
}

/// Distance of a point from a half tooth: dense samples, then Newton-free refinement by thirds.
double distance_to(const std::vector<ProfilePiece>& pieces, const Point2& p) {
  double best = 1e300;
  for (const ProfilePiece& piece : pieces) {
    double low = 0.0, high = 1.0;
    constexpr int kPlaces = 400;
    int nearest = 0;
    double least = 1e300;
    const auto at = [&](double u) {
      return (point_at(piece.curve, piece.curve.begin + u * (piece.curve.end - piece.curve.begin)) - p)
          .norm();
    };
    for (int i = 0; i <= kPlaces; ++i)
      if (const double d = at(1.0 * i / kPlaces); d < least) least = d, nearest = i;
    low = std::max(0.0, (nearest - 1.0) / kPlaces), high = std::min(1.0, (nearest + 1.0) / kPlaces);
    for (int k = 0; k < 100; ++k) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
    }
    best = std::min(best, at(0.5 * (low + high)));
  }
  return best;
}

/// Two pieces of fillet: the involute of the protuberance's side and the trochoid.
Gear protuberant_gear() {
  Gear gear = test::external_gear(24, 0.1);
  gear.rack.dedendum = 1.4;
  gear.rack.protuberance = 0.05;
  gear.rack.protuberance_angle_rad = rad_from_deg(10.0);
  return gear;
}

class Sections : public ::testing::TestWithParam<test::SampleGear> {};

TEST_P(Sections, LieOnTheToothSurfaceAtTheirHeightOnEitherSide) {
  const auto profile = ToothProfile::make(GetParam().gear);
  ASSERT_TRUE(profile);
  for (double slope : {0.0, 0.004, -0.02}) {
    const FlankDeviation field = field_of(*profile, slope);
    const Toothing toothing{.profile = &*profile, .twist = {.face_width_mm = 10.0},
                            .deviation = &field};
    for (double z : {0.0, 5.0, 8.0}) {
      const ToothSection section = section_profile(toothing, z);
      EXPECT_FALSE(section.as_designed);
      EXPECT_EQ(section.profile.symmetric(), slope == 0.0 || z == 5.0);
      for (const auto* half : {&section.profile.pieces(), &section.profile.clockwise_pieces()})
        for (std::size_t i = 1; i < half->size(); ++i)
          EXPECT_LT(((*half)[i].curve.start_point() - (*half)[i - 1].curve.end_point()).norm(), 1e-9)
              << "piece " << i;
      for (std::size_t i = 0; i < profile->pieces().size(); ++i) {
        const ProfilePiece& piece = profile->pieces()[i];
        for (int side : {1, -1})
          for (double share : {0.02, 0.3, 0.61, 0.97}) {
            const double at = piece.curve.begin + share * (piece.curve.end - piece.curve.begin);
            const Point2 p = section_point(toothing, {0, side, i, at}, z);
            EXPECT_LT(side > 0 ? distance_to(section.profile.pieces(), p)
                               : distance_to(section.profile.clockwise_pieces(), mirrored(p)),
                      1e-10)
                << "z " << z << " piece " << i << " side " << side << " share " << share;
          }
      }
    }
  }
}

TEST_P(Sections, PolygonsAndMirrorImagesKeepTheirHalves) {
  const auto profile = ToothProfile::make(GetParam().gear);
  ASSERT_TRUE(profile);
  const FlankDeviation field = field_of(*profile, 0.03);
  const ToothProfile section =
      section_profile({.profile = &*profile, .twist = {.face_width_mm = 10.0}, .deviation = &field},
                      8.0)
          .profile;
  const ToothProfile image = section.mirror_image();
  const SectionPolygon polygon = section_polygon(section, 2e-4);
  const SectionPolygon mirror = section_polygon(image, 2e-4);
  ASSERT_EQ(polygon.points_per_tooth, mirror.points_per_tooth);
  const double pitch = kTwoPi / polygon.teeth;
  // points of the first two teeth on the half they belong to, folded into tooth 1
  for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(polygon.points_per_tooth); ++i) {
    const double angle = polar_angle_rad(polygon.points[i]);
    const Point2 folded = rotated(polygon.points[i], -pitch * std::round(angle / pitch));
    const double off = std::min(distance_to(section.pieces(), folded),
                                distance_to(section.clockwise_pieces(), mirrored(folded)));
    ASSERT_LT(off, 1e-8) << i;
  }
  double sum = 0.0, image_sum = 0.0;
  for (std::size_t i = 0; i < polygon.points.size(); ++i) {
    const auto next = (i + 1) % polygon.points.size();
    sum += 0.5 * cross(polygon.points[i], polygon.points[next]);
    image_sum += 0.5 * cross(mirror.points[i], mirror.points[next]);
  }
  EXPECT_NEAR(sum, image_sum, 1e-9 * sum);
}
INSTANTIATE_TEST_SUITE_P(
    Of, Sections,
    ::testing::Values(test::SampleGear{"external", test::external_gear(24, 0.1, 2.0)},
                      test::SampleGear{"ring", test::ring_gear(60, 0.2)},
                      test::SampleGear{"protuberant", protuberant_gear()},
                      test::SampleGear{"rounded", test::with_tip_rounding(test::external_gear(24, 0.1), 0.15)},
                      test::SampleGear{"trimmed", test::shaped_ring(36, 0.0, {30, 0.0, 0.2})}),
    [](const auto& tested) { return tested.param.name; });

TEST(SectionProfile, WithoutDeviationIsTheDesignItself) {
  const auto profile = ToothProfile::make(test::external_gear(24, 0.1));
  ASSERT_TRUE(profile);
  const ToothSection section =
      section_profile({.profile = &*profile, .twist = {.face_width_mm = 10.0}}, 3.0);
  EXPECT_TRUE(section.as_designed);
  EXPECT_TRUE(section.profile.symmetric());
  // crowning alone is zero at mid face
  const FlankDeviation crowned{.deviation_mm = [](int, Flank, double, double z) {
                                 return -0.001 * (z - 5.0) * (z - 5.0);
                               },
                               .varies_along_face = true};
  const Toothing toothing{.profile = &*profile, .twist = {.face_width_mm = 10.0},
                          .deviation = &crowned};
  EXPECT_TRUE(section_profile(toothing, 5.0).as_designed);
  // off it the flank stays an involute, turned
  const ToothSection end = section_profile(toothing, 0.0);
  const auto involute = [](const ToothProfile& p) {
    for (const ProfilePiece& piece : p.pieces())
      if (const auto* shape = std::get_if<Involute>(&piece.curve.shape))
        return shape->base_half_angle_rad;
    return 1e300;
  };
  EXPECT_NEAR(involute(end.profile) - involute(*profile),
              -0.025 / base_radius_mm(profile->gear()), 1e-15);
}

}  // namespace
}  // namespace trueflank
