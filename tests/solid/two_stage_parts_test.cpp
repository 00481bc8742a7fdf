// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/two_stage_designs.h"
#include "trueflank/solid/measure/assembly_clearance.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {
namespace {

std::set<std::string> names_of(const PartShapes& shapes) {
  std::set<std::string> names;
  for (const PartShape& part : shapes.parts) names.insert(part.name);
  return names;
}

const PartShape& part_named(const PartShapes& shapes, const std::string& name) {
  return *std::find_if(shapes.parts.begin(), shapes.parts.end(), [&](const PartShape& p) { return p.name == name; });
}

double height_of(const PartShapes& shapes, const std::string& body) {
  const auto it = std::find_if(shapes.assembly.begin(), shapes.assembly.end(),
                               [&](const Placement& placement) { return placement.name == body; });
  return it == shapes.assembly.end() ? kNaN : it->translation_mm[2];
}

GearboxDesign carried_stages() {
  GearboxDesign design = test::two_stage_design({.sun = 18, .planet = 36, .planets = 3, .module_mm = 0.8, .face_width_mm = 8.0},
                                                {.sun = 20, .planet = 26, .planets = 4, .module_mm = 1.0, .face_width_mm = 14.0});
  design.carrier = CarrierDesign{.plate_thickness_mm = 4.0};
  return design;
}

TEST(TwoStageParts, AreTheGearsOfBothWithTheirCarriers) {
  GearboxDesign design = carried_stages();
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  // the upper plate of carrier1 is one with sun2
  EXPECT_EQ(names_of(*shapes), (std::set<std::string>{"sun1", "planet1", "ring1", "sun2", "planet2", "ring2", "carrier1",
                                                      "carrier1_pin", "carrier2", "carrier2_pin", "carrier2_top"}));
  EXPECT_EQ(shapes->assembly.size(), 1U + 3U + 1U + 1U + 4U + 1U + (1U + 3U) + (2U + 4U));
  EXPECT_EQ(part_named(*shapes, "sun2").role, PartRole::kSun);
  EXPECT_NEAR(height_of(*shapes, "sun2"), 8.3, 1e-12);  // its plate, 0.3 above the planets of stage 1
  EXPECT_NEAR(height_of(*shapes, "planet2 4"), 8.3 + 4.0 + 1.0 + 4.3, 1e-12);
  design.carrier.reset();
  const auto bare = lay_out(design);
  const auto gears = part_shapes(*bare);
  ASSERT_TRUE(gears);
  EXPECT_EQ(names_of(*gears), (std::set<std::string>{"sun1", "planet1", "ring1", "sun2", "planet2", "ring2"}));
}

TEST(TwoStageParts, TheSunOfTheSecondIsPlateNeckAndTeeth) {
  GearboxDesign design = carried_stages();
  design.gears[3].bore.diameter_mm = 4.0;
  const auto train = lay_out(design);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  const PartMesh made = part_mesh(part_named(*shapes, "sun2"));
  const MeshValidity validity = mesh_validity(made.mesh);
  EXPECT_TRUE(validity.valid());
  EXPECT_EQ(validity.components, 1U);
  // planets' bore 0.35 * 0.8 * 36, pins 0.1 less, holes 0.02 more; plate to 1.25 pins beyond the pins' circle
  const double pin = 0.35 * 0.8 * 36 - 0.1, a1 = 0.4 * 54.0, neck = train->find("sun2")->profile.root_radius_mm() - 0.25;
  const double plate = 4.0 * kPi * (std::pow(a1 + 1.25 * pin, 2) - 3.0 * std::pow(0.5 * (pin + 0.02), 2));
  double teeth = 0.0;
  {
    GearboxDesign alone = test::simple_design({.sun = 20, .planet = 26, .planets = 4, .module_mm = 1.0, .face_width_mm = 14.0});
    const auto simple = lay_out(alone);
    const auto parts = part_shapes(*simple);
    teeth = volume_mm3(part_mesh(part(*parts, "sun")).mesh);
  }
  const double expected = plate + (1.0 + 4.3) * kPi * neck * neck + teeth - kPi * 4.0 * (4.0 + 5.3 + 14.0);
  EXPECT_NEAR(volume_mm3(made.mesh), expected, 5e-4 * expected);
}

TEST(TwoStageParts, ALargeSunHasANeckThatKeepsClearOfThePinsBelowIt) {
  GearboxDesign design = test::two_stage_design({.sun = 18, .planet = 36, .planets = 3, .module_mm = 0.4, .face_width_mm = 6.0},
                                                {.sun = 40, .planet = 40, .planets = 3, .module_mm = 1.5, .face_width_mm = 10.0});
  design.carrier = CarrierDesign{};
  const auto train = lay_out(design);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes) << shapes.error().front().message;
  EXPECT_TRUE(mesh_validity(part_mesh(part_named(*shapes, "sun2")).mesh).valid());
  design.gears[3].bore.diameter_mm = 17.0;  // within the teeth, not within the pins of stage 1
  const auto bored = lay_out(design);
  const auto refused = part_shapes(*bored);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().key, "sun2.bore_mm") << refused.error().front().message;
}

TEST(TwoStageParts, AnOpeningTooSmallForTheNeckIsRefused) {
  GearboxDesign design = carried_stages();
  design.carrier->opening_diameter_mm = 17.2;  // the neck has 2 (10 - 1.25 - 0.25) = 17 mm
  const auto train = lay_out(design);
  const auto refused = part_shapes(*train);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().key, "carrier.opening_diameter_mm");
  design.carrier->opening_diameter_mm = 18.0;
  const auto wider = lay_out(design);
  EXPECT_TRUE(part_shapes(*wider));
}

TEST(TwoStageParts, OfRandomStagesAreClosedAndRunIntoNothing) {
  test::RandomStages stages(20);
  int made = 0;
  for (int i = 0; i < 8; ++i) {
    GearboxDesign design = stages.design();
    if (i % 2 == 0) design.carrier = CarrierDesign{.plate_thickness_mm = 3.0};
    if (i % 3 == 0) design.helix_angle_rad = 0.2;
    const auto train = lay_out(design);
    ASSERT_TRUE(train) << train.error().front().message;
    const auto shapes = part_shapes(*train);
    ASSERT_TRUE(shapes) << shapes.error().front().message;
    for (const PartShape& shape : shapes->parts) {
      const MeshValidity validity = mesh_validity(part_mesh(shape, {.tolerance_mm = 0.05}).mesh);
      EXPECT_TRUE(validity.valid()) << i << " " << shape.name;
      EXPECT_EQ(validity.components, 1U) << i << " " << shape.name;
      ++made;
    }
    const AssemblyClearance clearance = assembly_clearance(*train, *shapes);
    for (const Collision& c : clearance.collisions) ADD_FAILURE() << i << ": " << c.body1 << " and " << c.body2;
  }
  EXPECT_GE(made, 8 * 6);
}

}  // namespace
}  // namespace trueflank
