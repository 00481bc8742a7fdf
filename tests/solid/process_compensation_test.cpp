// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/solid/shape/process_compensation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/sample_gears.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/measure/outline_distance.h"
#include "trueflank/solid/mesh/gear_mesh.h"

namespace trueflank {
namespace {

/// Largest and smallest distance of the moved profile's points from the original outline.
struct Range {
  double low = 1e9, high = -1e9;
};
Range distances(const Gear& gear, double inwards_mm, bool flanks_only) {
  const auto original = ToothProfile::make(gear);
  const auto moved = ToothProfile::make(offset_gear(gear, inwards_mm));
  EXPECT_TRUE(original && moved);
  Range range;
  if (!original || !moved) return range;
  const OutlineDistance distance(ToothedOutline{&*original});
  for (const ProfilePiece& piece : moved->pieces()) {
    if (flanks_only && piece.kind == PieceKind::kFillet) continue;
    for (int i = 1; i < 40; ++i) {
      const Curve& c = piece.curve;
      const Point2 p = point_at(c, c.begin + (c.end - c.begin) * i / 40.0);
      const double d = std::abs(distance.foot(p).distance_mm);
      range.low = std::min(range.low, d);
      range.high = std::max(range.high, d);
    }
  }
  return range;
}

TEST(ProcessCompensation, OffsetGearLiesThatFarInsideTheMaterial) {
  struct Sample {
    Gear gear;
    const char* what;
  };
  Gear protuberance = test::external_gear(30, 0.1);
  protuberance.rack.dedendum = 1.4;
  protuberance.rack.root_radius = 0.25;
  protuberance.rack.protuberance = 0.05;
  for (const Sample& sample :
       {Sample{test::external_gear(39, 0.3), "planet"}, Sample{test::external_gear(8, 0.0), "undercut"},
        Sample{test::external_gear(24, 0.1, 2.5), "module 2.5"},
        Sample{test::with_root_radius(test::external_gear(20, 0.0), 0.0), "sharp rack"},
        Sample{protuberance, "protuberance"}, Sample{test::ring_gear(81, 0.5), "ring"}}) {
    const Range range = distances(sample.gear, 0.05, false);
    EXPECT_NEAR(range.low, 0.05, 1e-8) << sample.what;
    EXPECT_NEAR(range.high, 0.05, 1e-8) << sample.what;
  }
}

TEST(ProcessCompensation, ShapedRingIsExactButForItsFillet) {
  const Gear ring = test::shaped_ring(90, 0.5, {25, 0.0, 0.2});
  const Range flanks = distances(ring, 0.05, true);
  EXPECT_NEAR(flanks.low, 0.05, 1e-8);
  EXPECT_NEAR(flanks.high, 0.05, 1e-8);
  const Range all = distances(ring, 0.05, false);
  EXPECT_NEAR(all.low, 0.05, 0.005);
  EXPECT_NEAR(all.high, 0.05, 0.005);
}

GearTrain gear_train(double helix_deg = 0.0) {
  GearboxDesign design{.name = "gear", .topology = train_topology("gear")};
  design.helix_angle_rad = rad_from_deg(helix_deg);
  design.gears = {GearDesign{.name = "gear", .teeth = 24, .face_width_mm = 6.0,
                             .bore = {.diameter_mm = 6.0, .kind = BoreKind::kKeyway,
                                      .keyway_width_mm = 2.0, .keyway_depth_mm = 1.0}}};
  return *lay_out(design);
}

TEST(ProcessCompensation, VolumeShrinksByTheWallsTimesTheExpansion) {
  const GearTrain train = gear_train();
  const auto shapes = part_shapes(train);
  ASSERT_TRUE(shapes);
  const auto volume = [&](double expansion_mm) {
    const Process process{.name = "p", .horizontal_expansion_mm = expansion_mm};
    const auto moved = compensated(*shapes, process);
    EXPECT_TRUE(moved);
    const PartMesh mesh = part_mesh(moved->shapes.parts[0]);
    EXPECT_TRUE(mesh_validity(mesh.mesh).valid());
    return volume_mm3(mesh.mesh);
  };
  // by Steiner's formula the area falls by perimeter d, less second order; and grows likewise
  const double nominal = volume(0.0), less = volume(0.02), more = volume(-0.02);
  const double wall = (more - less) / 0.04;
  EXPECT_GT(wall, 6.0 * kTwoPi * (12.0 + 3.0));  // more than two plain cylinders
  EXPECT_NEAR((more + less) / 2.0, nominal, 0.02 * 0.02 * 6.0 * 24 * 4);
}

TEST(ProcessCompensation, HelicalTeethAreOffsetInTheirSections) {
  const GearTrain train = gear_train(20.0);
  const auto shapes = part_shapes(train);
  ASSERT_TRUE(shapes);
  const Process process{.name = "p", .horizontal_expansion_mm = 0.03};
  EXPECT_TRUE(compensated(*shapes, process));
  // a layer is a transverse section: its flanks are offset there
  const Gear before = train.gears[0].profile.gear(), after = offset_gear(before, 0.03);
  EXPECT_NEAR(base_radius_mm(after) * (base_half_angle_rad(before) - base_half_angle_rad(after)),
              0.03, 1e-12);
}

TEST(ProcessCompensation, WallsThatVanishAreAnError) {
  const GearTrain train = gear_train();
  const auto shapes = part_shapes(train);
  ASSERT_TRUE(shapes);
  const auto moved = compensated(*shapes, {.name = "p", .horizontal_expansion_mm = 0.9});
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().key, "made.process");
}

}  // namespace
}  // namespace trueflank
