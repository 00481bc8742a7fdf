// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"

namespace trueflank::test {
namespace {

using loop::FlankGeometry;

void expect_the_same_place(const loop::PlacedPoint& many, const loop::PlacedPoint& one) {
  EXPECT_EQ(many.place.surface, one.place.surface);
  EXPECT_EQ(many.place.side, one.place.side);
  EXPECT_EQ(many.place.tooth, one.place.tooth);
  EXPECT_EQ(many.place.roll_mm, one.place.roll_mm);
  EXPECT_EQ(many.place.z_mm, one.place.z_mm);
  EXPECT_EQ(many.place.radius_mm, one.place.radius_mm);
  EXPECT_EQ(many.place.polar_rad, one.place.polar_rad);
  EXPECT_EQ(many.place.polar_direction, one.place.polar_direction);
  EXPECT_EQ(many.place.normal_direction, one.place.normal_direction);
  EXPECT_EQ(many.distance_mm, one.distance_mm);
}

/// Points in the ring of the teeth, within the base circle and far outside, on the axes, on the
/// borders between teeth and above the face; one count that is no multiple of four.
TEST(NearestOfMany, HasTheDigitsOfOnePoint) {
  std::mt19937 random(20261126);
  const std::vector<std::pair<MadeGear, bool>> gears{{spur(24), false},
                                                     {ring(60), false},
                                                     {helical(30, -25.0), false},
                                                     {helical(200, 35.0), false},
                                                     {helical(30, 25.0), true}};
  for (const auto& [made, herringbone] : gears) {
    const FlankGeometry geometry(*ToothProfile::make(design_of(made)), made.face_mm,
                                 0.6 * made.reference(), herringbone);
    const double tip = std::max(geometry.tip_radius_mm(), geometry.root_radius_mm()),
                 b = geometry.face_width_mm();
    std::vector<std::array<double, 3>> points{{tip, 0.0, 0.0}, {-tip, 0.0, 1.0}, {-tip, -0.0, 1.0},
                                              {0.0, tip, 1.0}, {0.0, -tip, 1.0}, {0.0, 0.0, 1.0}};
    for (int tooth = 0; tooth < made.teeth; ++tooth)
      for (const double half : {0.0, 0.5}) {
        const double angle = kTwoPi * (tooth + half) / made.teeth;
        points.push_back({tip * std::cos(angle), tip * std::sin(angle), 0.0});
      }
    std::uniform_real_distribution<double> share(0.0, 1.0);
    while (points.size() < 3001) {
      const double radius =
          tip * (points.size() % 3 == 0 ? 1.3 * share(random) : 1.02 - 0.25 * share(random));
      const double angle = kTwoPi * share(random);
      points.push_back(
          {radius * std::cos(angle), radius * std::sin(angle), b * (1.2 * share(random) - 0.1)});
    }
    std::vector<loop::PlacedPoint> flanks(points.size()), surfaces(points.size());
    std::vector<double> distances(points.size());
    geometry.nearest_flanks(points, loop::kFlankMargin, flanks.data());
    geometry.nearest(points, 0.3, surfaces.data());
    geometry.nearest_distances_mm(points, 0.3, distances.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
      SCOPED_TRACE(i);
      expect_the_same_place(flanks[i], geometry.nearest_flank(points[i], loop::kFlankMargin));
      expect_the_same_place(surfaces[i], geometry.nearest(points[i], 0.3));
      const double alone = geometry.nearest_distance_mm(points[i], 0.3);
      EXPECT_TRUE(distances[i] == alone || (std::isnan(distances[i]) && std::isnan(alone)));
    }
  }
}

}  // namespace
}  // namespace trueflank::test
