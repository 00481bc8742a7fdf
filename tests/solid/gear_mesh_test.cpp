// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/gear_mesh.h"

#include <gtest/gtest.h>

#include "tests/train/prototype_design.h"
#include "trueflank/solid/mesh_validity.h"

namespace trueflank {
namespace {

TEST(GearMesh, EveryPartOfThePrototypeIsOneClosedOutwardShell) {
  GearboxDesign design = test::prototype(0.5225, 1.9967, 25.6826);
  design.gears[0].bore = {.diameter_mm = 5.0};
  design.gears[2].bolt_circle = {.count = 6, .circle_diameter_mm = 99.0, .hole_diameter_mm = 3.2};
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  ASSERT_EQ(shapes->parts.size(), 4U);  // the planet is one body
  for (const PartShape& part : shapes->parts) {
    const PartMesh made = part_mesh(part);
    const MeshValidity validity = mesh_validity(made.mesh);
    EXPECT_TRUE(validity.valid()) << part.name;
    EXPECT_EQ(validity.components, 1U) << part.name;
    EXPECT_EQ(validity.unused_vertices, 0U) << part.name;
    EXPECT_LE(made.chord_error_mm, 1e-3) << part.name;
    EXPECT_GT(made.chord_error_mm, 0.5e-3) << part.name;
  }
}

}  // namespace
}  // namespace trueflank
