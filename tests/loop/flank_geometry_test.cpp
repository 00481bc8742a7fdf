// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"

namespace trueflank::test {
namespace {

using loop::FlankGeometry;
using loop::Surface;

/// Distances of points made by unwinding a thread and moved along a differenced normal.
void expect_exact_distance(const MadeGear& made) {
  const FlankGeometry geometry = geometry_of(made);
  for (const int tooth : {1, 2, made.teeth / 2, made.teeth})
    for (const int side : {1, -1})
      for (const double u : {-0.9, -0.2, 0.5, 0.9})
        for (const double distance : {-0.08, 0.0, 0.05}) {
          const FlankSpot spot{tooth, side, u, 0.3};
          Vec3 p = point_on(made, spot);
          const Vec3 n = normal_at(made, spot);
          for (int k = 0; k < 3; ++k) p[k] += distance * n[k];
          const auto placed = geometry.nearest_flank(p);
          EXPECT_EQ(placed.place.tooth, tooth);
          EXPECT_EQ(placed.place.side, side);
          // A helical flank is no parallel surface in its transverse section: second order there.
          const double bound = made.helix_rad == 0.0 ? 1e-8 : 2e-4 * std::abs(distance) + 1e-8;
          EXPECT_NEAR(placed.distance_mm, distance, bound);
          EXPECT_NEAR(geometry.profile_coordinate(placed.place.roll_mm), u, 1e-2);
          // The foot of the normal, not the point's own height.
          EXPECT_NEAR(placed.place.z_mm, 0.5 * 1.3 * made.face_mm, 1e-3 * std::abs(distance) + 1e-9);
          const double nt = std::cos(geometry.base_helix_rad());
          EXPECT_NEAR(nt * placed.place.normal_direction[0], n[0], 2e-3);
          EXPECT_NEAR(nt * placed.place.normal_direction[1], n[1], 2e-3);
          EXPECT_NEAR(geometry.normal_z(placed.place), n[2], 2e-3);
        }
}

TEST(FlankGeometry, DistanceOfASpurGearIsExactAtAnyDistance) { expect_exact_distance(spur(24)); }
TEST(FlankGeometry, DistanceOfASmallSunIsExact) { expect_exact_distance(spur(17)); }
TEST(FlankGeometry, DistanceOfARingIsExact) { expect_exact_distance(ring(60)); }
TEST(FlankGeometry, DistanceOfAHelicalGearIsAlongTheNormal) {
  expect_exact_distance(helical(30, 20.0));
  expect_exact_distance(helical(30, -25.0));
}

/// A measured point's directions come by series from its own, those of a place by cosine and sine.
TEST(FlankGeometry, DirectionsOfAPlacedPointAreThoseOfItsPlace) {
  for (const MadeGear& made : {spur(24), ring(60), helical(30, -25.0), helical(200, 35.0)}) {
    const FlankGeometry geometry = geometry_of(made);
    for (const int tooth : {1, made.teeth / 3, made.teeth / 2, made.teeth / 2 + 1, made.teeth})
      for (const int side : {1, -1})
        for (const double u : {-0.9, 0.0, 0.9})
          for (const double distance : {-0.3, -0.02, 0.0, 0.004, 0.2}) {
            Vec3 p = point_on(made, {tooth, side, u, 0.3});
            const Vec3 n = normal_at(made, {tooth, side, u, 0.3});
            for (std::size_t k = 0; k < 3; ++k) p[k] += distance * n[k];
            const loop::Place placed = geometry.nearest_flank(p).place;
            const loop::Place place =
                geometry.on_flank(placed.tooth, placed.side, placed.roll_mm, placed.z_mm);
            EXPECT_NEAR(placed.radius_mm, place.radius_mm, 1e-13 * place.radius_mm);
            for (std::size_t k = 0; k < 2; ++k) {
              EXPECT_NEAR(placed.polar_direction[k], place.polar_direction[k], 2e-14);
              EXPECT_NEAR(placed.normal_direction[k], place.normal_direction[k], 2e-14);
            }
          }
  }
}

TEST(FlankGeometry, TipAndRootPointsAreNoFlankPoints) {
  const MadeGear made = spur(24);
  const FlankGeometry geometry = geometry_of(made);
  EXPECT_EQ(geometry.nearest({made.tip_mm + 0.02, 0.0, 5.0}, 0.3).place.surface, Surface::kTip);
  EXPECT_NEAR(geometry.nearest({made.tip_mm + 0.02, 0.0, 5.0}, 0.3).distance_mm, 0.02, 1e-12);
  const double gap = M_PI / made.teeth, root = geometry.root_radius_mm() - 0.01;
  const auto placed = geometry.nearest({root * std::cos(gap), root * std::sin(gap), 5.0}, 0.3);
  EXPECT_EQ(placed.place.surface, Surface::kRoot);
  EXPECT_NEAR(placed.distance_mm, -0.01, 1e-12);
  EXPECT_EQ(geometry.nearest({5.0, 1.0, 5.0}, 0.3).place.surface, Surface::kNone);
}

TEST(FlankGeometry, ABallInTheGapTouchesBothFlanks) {
  for (const MadeGear& made : {spur(24), ring(60)}) {
    const FlankGeometry geometry = geometry_of(made);
    const double diameter = 1.8;
    const auto contact = geometry.ball_contact(diameter);
    const double centre = geometry.base_radius_mm() / std::cos(contact.centre_angle_rad);
    const double gap = M_PI / made.teeth;
    // The centre stands a ball radius off the flanks.
    const auto placed = geometry.nearest_flank({centre * std::cos(gap * 0.9999),
                                                centre * std::sin(gap * 0.9999), 5.0});
    EXPECT_NEAR(placed.distance_mm, 0.5 * diameter, 2e-4);
    EXPECT_NEAR(placed.place.roll_mm, contact.roll_mm, 2e-4);
  }
}

}  // namespace
}  // namespace trueflank::test
