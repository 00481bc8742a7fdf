// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/solid/shape/bed_chamfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/solid/random_toothing.h"
#include "tests/support/sample_gears.h"
#include "tests/support/sample_parts.h"
#include "tests/train/prototype_design.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/solid/measure/mesh_accuracy.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/measure/outline_distance.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// Every place of the profile, moved, lies the depth inside the material: no nearer to any wall, no
/// farther from all.
double largest_error_mm(const ToothProfile& profile, const InsetProfile& inset, double depth_mm) {
  const OutlineDistance outline(ToothedOutline{&profile});
  const double inside = profile.gear().kind == GearKind::kExternal ? -1.0 : 1.0;
  double error = 0.0;
  for (std::size_t k = 0; k < profile.pieces().size(); ++k)
    for (int i = 0; i <= 60; ++i) {
      const Curve& curve = profile.pieces()[k].curve;
      const Point2 p = inset.point(k, std::lerp(curve.begin, curve.end, i / 60.0), depth_mm);
      error = std::max(error, std::abs(outline.foot(p).distance_mm - inside * depth_mm));
    }
  return error;
}

TEST(InsetProfile, WallsLieTheDepthInsideTheMaterialAndMeet) {
  int deep = 0;
  for (const test::SampleGear& sample : test::sample_gears()) {
    SCOPED_TRACE(sample.name);
    const auto profile = ToothProfile::make(sample.gear);
    ASSERT_TRUE(profile);
    const double m = sample.gear.normal_module_mm, asked = 0.2 * m;
    const InsetProfile inset(*profile, asked);
    if (sample.name == "ring with sharp roots") {
      EXPECT_EQ(inset.deepest_mm(), 0.0);
      continue;
    }
    EXPECT_GT(inset.deepest_mm(), 0.02 * m);
    deep += inset.deepest_mm() == asked ? 1 : 0;
    for (const double share : {1.0, 0.7, 0.333, 0.01}) {
      const double depth = share * inset.deepest_mm();
      EXPECT_LT(largest_error_mm(*profile, inset, depth), 1e-6 * m) << "at " << depth;
      const auto& pieces = profile->pieces();
      for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
        EXPECT_LT((inset.point(k, pieces[k].curve.end, depth) -
                   inset.point(k + 1, pieces[k + 1].curve.begin, depth)).norm(), 1e-4 * m)
            << "joint " << k << " at " << depth;
    }
  }
  EXPECT_GE(deep, 14);
}

GearTrain plain_gear(double helix_deg, bool ring) {
  GearboxDesign design{.name = "gear", .topology = train_topology("gear")};
  design.helix_angle_rad = rad_from_deg(helix_deg);
  GearDesign gear{.name = "gear", .teeth = ring ? 40 : 13, .face_width_mm = 6.0};
  if (ring) {
    gear.kind = GearKind::kInternal;
    gear.bolt_circle = {.count = 4, .circle_diameter_mm = 56.0, .hole_diameter_mm = 2.5};
  } else {
    gear.bore = {.diameter_mm = 5.0, .kind = BoreKind::kKeyway, .keyway_width_mm = 1.5,
                 .keyway_depth_mm = 0.7};
  }
  design.gears = {gear};
  return *lay_out(design);
}

void expect_sound(const PartShape& part, double tolerance_mm) {
  const PartMesh made = part_mesh(part, {.tolerance_mm = tolerance_mm});
  EXPECT_TRUE(mesh_validity(made.mesh).valid());
  EXPECT_LE(made.chord_error_mm, tolerance_mm);
  const Accuracy accuracy = measure_accuracy(made.mesh, part);
  EXPECT_LE(accuracy.largest_mm(), tolerance_mm);
  EXPECT_GE(accuracy.largest_mm(), 0.2 * tolerance_mm);
}

TEST(BedChamfer, MeshesAreClosedAndWithinTheToleranceOfTheChamferedSurface) {
  for (const double helix : {0.0, 25.0})
    for (const bool ring : {false, true}) {
      const GearTrain train = plain_gear(helix, ring);
      auto shapes = part_shapes(train);
      ASSERT_TRUE(shapes);
      std::deque<InsetProfile> profiles;
      EXPECT_FALSE(add_bed_chamfer(shapes->parts[0], 0.15, 0.4, profiles));
      for (const double tolerance : {1e-3, 1e-2}) {
        SCOPED_TRACE(std::to_string(helix) + (ring ? " ring " : " gear ") + std::to_string(tolerance));
        expect_sound(shapes->parts[0], tolerance);
      }
    }
}

TEST(BedChamfer, OfACompoundPlanetChamfersItsLowerFaceAndTheBoreThere) {
  GearboxDesign design = test::prototype(0.5225, 1.9967, 25.6826);
  design.gears[1].bore = {.diameter_mm = 8.0, .kind = BoreKind::kHex};
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  std::deque<InsetProfile> profiles;
  for (PartShape& part : shapes->parts) {
    SCOPED_TRACE(part.name);
    const PartMesh before = part_mesh(part, {.tolerance_mm = 5e-3});
    EXPECT_EQ(add_bed_chamfer(part, 0.1, 0.3, profiles), std::nullopt);
    expect_sound(part, 5e-3);
    // the unchamfered mesh has too much material, by the depth square to the chamfer's slope
    const Accuracy off = measure_accuracy(before.mesh, part);
    EXPECT_GT(off.most_excess_mm, 0.99 * 0.1 / std::hypot(1.0, 0.1 / 0.3));
    EXPECT_LT(off.most_excess_mm, 0.1 * std::sqrt(2.0));  // at corners
    EXPECT_GT(off.most_deficit_mm, -6e-3);
  }
}

TEST(BedChamfer, SectionsOfTheMeshAreThoseOfTheDesignMovedIntoTheMaterial) {
  const GearTrain train = plain_gear(0.0, false);
  auto shapes = part_shapes(train);
  ASSERT_TRUE(shapes);
  const PartShape design = shapes->parts[0];
  std::deque<InsetProfile> profiles;
  ASSERT_FALSE(add_bed_chamfer(shapes->parts[0], 0.2, 0.5, profiles));
  const OutlineDistance teeth(design.slabs[0].outer);
  const double root = train.gears[0].profile.root_radius_mm();
  const PartMesh made = part_mesh(shapes->parts[0], {.tolerance_mm = 1e-3});
  int at_bed = 0, above = 0;
  for (const auto& v : made.mesh.vertices) {
    if (std::hypot(v[0], v[1]) < root - 0.2 - 1e-6) continue;  // the bore's and the plane faces' own
    if (v[2] == 0.0) {
      EXPECT_NEAR(teeth.foot({v[0], v[1]}).distance_mm, -0.2, 1e-6);
      ++at_bed;
    } else if (v[2] > 0.499 && v[2] < 5.9) {
      EXPECT_NEAR(teeth.foot({v[0], v[1]}).distance_mm, 0.0, 1e-9);
      ++above;
    }
  }
  EXPECT_GT(at_bed, 13 * 20);
  EXPECT_GT(above, 13 * 20);
}

TEST(BedChamfer, MassFallsByTheWallsTimesHalfTheDepthTimesTheHeight) {
  const GearTrain train = plain_gear(0.0, true);
  auto shapes = part_shapes(train);
  ASSERT_TRUE(shapes);
  PartShape& part = shapes->parts[0];
  const double before = mass_properties(part, 1.0).volume_mm3;
  std::deque<InsetProfile> profiles;
  ASSERT_FALSE(add_bed_chamfer(part, 0.1, 0.3, profiles));
  const double after = mass_properties(part, 1.0).volume_mm3;
  const PartMesh made = part_mesh(part, {.tolerance_mm = 5e-4});
  EXPECT_NEAR(volume_mm3(made.mesh) / after, 1.0, 3e-5);
  EXPECT_GT(before - after, 0.5 * 0.1 * 0.3 * kTwoPi * 45.0);  // more than two plain cylinders
}

TEST(BedChamfer, IsLessDeepWhereTeethOrWallsDoNotStandIt) {
  std::deque<InsetProfile> profiles;
  const auto rounded = ToothProfile::make(test::with_tip_rounding(test::external_gear(24, 0.1), 0.15));
  ASSERT_TRUE(rounded);
  PartShape tips = test::gear_part("tips", *rounded, 5.0);
  const auto note = add_bed_chamfer(tips, 0.3, 0.5, profiles);
  ASSERT_TRUE(note);
  EXPECT_NE(note->find("its teeth do not stand more"), std::string::npos) << *note;
  EXPECT_NEAR(bed_depth_mm(tips), 0.9 * 0.15, 1e-6);  // a tenth of the rounding is left
  expect_sound(tips, 2e-3);

  const auto profile = ToothProfile::make(test::external_gear(20, 0.0));
  ASSERT_TRUE(profile);
  PartShape wall = test::gear_part("wall", *profile, 5.0,
                                   {BoreOutline{{.diameter_mm = 2.0 * profile->root_radius_mm() - 0.6}}});
  const auto thin = add_bed_chamfer(wall, 0.2, 0.5, profiles);
  ASSERT_TRUE(thin);
  EXPECT_NE(thin->find("its walls do not stand more"), std::string::npos) << *thin;
  EXPECT_NEAR(bed_depth_mm(wall), 0.25 * 0.3, 1e-9);
  expect_sound(wall, 2e-3);

  const auto sharp = ToothProfile::make(test::with_root_radius(test::ring_gear(60, 0.0), 0.0));
  ASSERT_TRUE(sharp);
  PartShape ring = test::ring_part("ring", *sharp, 5.0);
  const auto none = add_bed_chamfer(ring, 0.2, 0.5, profiles);
  ASSERT_TRUE(none);
  EXPECT_NE(none->find("no chamfer at the bed"), std::string::npos) << *none;
  EXPECT_EQ(bed_depth_mm(ring), 0.0);
}

TEST(BedChamfer, OfModifiedTeethFollowsTheModifications) {
  int made = 0;
  for (std::uint64_t seed = 500; made < 4; ++seed) {
    auto random = test::random_toothing(seed, {.deviation = true});
    if (!random || random->train->gears[0].profile.gear().teeth > 40) continue;
    std::deque<InsetProfile> profiles;
    const double m = random->train->gears[0].profile.gear().normal_module_mm;
    (void)add_bed_chamfer(random->part, 0.1 * m, 0.3 * m, profiles);
    if (bed_depth_mm(random->part) == 0.0) continue;
    SCOPED_TRACE(random->text);
    expect_sound(random->part, 2e-3 * m);
    ++made;
  }
}

}  // namespace
}  // namespace trueflank
