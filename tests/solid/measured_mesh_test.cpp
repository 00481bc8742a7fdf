// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/measured_mesh.h"

#include <gtest/gtest.h>

#include "tests/solid/kept_tolerance.h"
#include "tests/support/sampled_deviation.h"
#include "tests/support/survey_size.h"
#include "trueflank/design/design_file.h"
#include "trueflank/solid/measure/mesh_accuracy.h"
#include "trueflank/solid/measure/mesh_validity.h"

namespace trueflank {
namespace {

/// A ring with crowning both ways and chamfers: places along a facet's edges alone told 20 um
/// of 24.
constexpr const char* kCrownedRing = R"(format = 1
name = "s"
[gearbox]
kind = "gear"
module_mm = 1.0
[rack]
root_radius = 0.1
[gear]
internal = true
teeth = 34
shift = 0.557
face_width_mm = 13.68
outer_diameter_mm = 48.114
[gear.modifications]
crowning_um = 10.61
profile_crowning_um = 7.54
edge_chamfer_mm = 0.1104
)";
/// A relief of a tenth of the module.
constexpr const char* kMuchRelief = R"(format = 1
name = "s"
[gearbox]
kind = "simple"
planets = 3
module_mm = 0.2
backlash_mm = 0.0034
[rack]
pressure_angle_deg = 14.5
[sun]
teeth = 26
shift = 0.1
face_width_mm = 0.8
[sun.modifications]
tip_relief_um = 23.14
tip_relief_start_diameter_mm = 5.42
[planet]
teeth = 25
shift = 0.0
face_width_mm = 0.8
[ring]
teeth = 76
shift = 0.1
face_width_mm = 0.8
outer_diameter_mm = 21.04
[ring.modifications]
edge_chamfer_mm = 0.0194
)";
constexpr const char* kHelicalWheel = R"(format = 1
name = "s"
[gearbox]
kind = "gear"
module_mm = 1.5
helix_angle_deg = -20.0
[gear]
teeth = 80
shift = 0.297
face_width_mm = 7.23
[gear.modifications]
profile_crowning_um = 8.3
edge_chamfer_mm = 0.2237
tip_rounding_mm = 0.0658
)";

/// A tip of the tool that is nearly sharp: chords over the fillet's bend are farthest off an eighth from their ends.
constexpr const char* kSharpFillet = R"(format = 1
name = "random"

[gearbox]
kind = "pair"
module_mm = 2.63778
backlash_mm = 0.0089
helix_angle_deg = 30.69801

[rack]
pressure_angle_deg = 24.15766
addendum = 0.94276
dedendum = 1.36917
root_radius = 0.02981

[pinion]
teeth = 16
face_width_mm = 5.25427
[pinion.modifications]
tip_relief_um = 15.05875
tip_relief_start_diameter_mm = 50.49368
tip_relief_shape = "linear"
profile_crowning_um = 37.21415
profile_slope_um = 13.73751
crowning_um = 32.51786
helix_slope_um = -31.60316
edge_chamfer_mm = 0.41943

[wheel]
teeth = 8
face_width_mm = 1.96833
thinning_um = 230.69939
bore_mm = 9.23316
)";

TEST(MeasuredMesh, KeepsTheToleranceBesideTheMiddlesOfChordsToo) {
  const auto design = read_design_text(kSharpFillet, "design.toml");
  ASSERT_TRUE(design);
  const GearTrain train = lay_out(*design).value();
  const PartShapes shapes = part_shapes(train).value();
  const PartShape& pinion = shapes.parts.front();
  constexpr double kTolerance_mm = 0.005188;
  const PartMesh once = part_mesh(pinion, {.tolerance_mm = kTolerance_mm});
  const double measured_mm = measure_accuracy(once.mesh, pinion).largest_mm();
  const auto seen_once = test::sampled_deviation(once.mesh, pinion, 400, 7, 0.5 * kTolerance_mm);
  ASSERT_TRUE(seen_once);
  EXPECT_LE(seen_once->largest_mm(), 1.02 * measured_mm);
  const MeasuredMesh made = measured_part_mesh(pinion, {.tolerance_mm = kTolerance_mm});
  const auto seen = test::sampled_deviation(made.part.mesh, pinion, 400, 7, kTolerance_mm);
  ASSERT_TRUE(seen);
  EXPECT_LE(seen->largest_mm(), kTolerance_mm);
}

TEST(MeasuredMesh, KeepsTheToleranceWhereTheMesherAloneMissedIt) {
  const struct {
    const char* design;
    double tolerance_um;
  } cases[] = {{kCrownedRing, 20.0}, {kCrownedRing, 10.0}, {kCrownedRing, 1.0},
               {kMuchRelief, 1.0},   {kMuchRelief, 0.3},   {kHelicalWheel, 3.0}};
  for (const auto& [text, tolerance_um] : cases) {
    const auto design = read_design_text(text, "design.toml");
    ASSERT_TRUE(design);
    const GearTrain train = lay_out(*design).value();
    const PartShapes shapes = part_shapes(train).value();
    for (const PartShape& part : shapes.parts) {
      const MeasuredMesh made =
          measured_part_mesh(part, {.tolerance_mm = mm_from_um(tolerance_um)});
      EXPECT_LE(um_from_mm(made.accuracy_mm), tolerance_um) << text << part.name;
      EXPECT_EQ(made.accuracy_mm, measure_accuracy(made.part.mesh, part).largest_mm());
      EXPECT_TRUE(mesh_validity(made.part.mesh).valid()) << text << part.name;
    }
  }
}

TEST(MeasuredMesh, IsThePartsMeshWhereThatKeepsTheTolerance) {
  const auto design = read_design_text(kHelicalWheel, "design.toml");
  const GearTrain train = lay_out(*design).value();
  const PartShapes shapes = part_shapes(train).value();
  const PartShape& part = shapes.parts.front();
  const PartMesh once = part_mesh(part, {.tolerance_mm = 0.02});
  ASSERT_LE(measure_accuracy(once.mesh, part).largest_mm(), 0.02);
  EXPECT_EQ(measured_part_mesh(part, {.tolerance_mm = 0.02}).part.mesh.vertices,
            once.mesh.vertices);
}

TEST(MeasuredMesh, RandomDesignsOfEveryKindKeepTheTolerance) {
  test::expect_tolerance_kept(20261122, test::survey_size(7, 20));
}

}  // namespace
}  // namespace trueflank
