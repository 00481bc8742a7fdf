// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines of a part that cross bound no solid: they are told, and the layout keeps clear of them.
#include <gtest/gtest.h>

#include "tests/check/machine_designs.h"
#include "trueflank/solid/measure/assembly_clearance.h"
#include "trueflank/solid/shape/crossing_outlines.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

PartShape plate_on_neck(double neck_radius_mm, double hole_at_mm) {
  return {.name = "plate",
          .slabs = {{.z_lower_mm = 0.0, .z_upper_mm = 5.0, .outer = CircleOutline{{0.0, 0.0}, neck_radius_mm}},
                    {.z_lower_mm = 5.0,
                     .z_upper_mm = 8.0,
                     .outer = CircleOutline{{0.0, 0.0}, 20.0},
                     .holes = {CircleOutline{{hole_at_mm, 0.0}, 2.0}}}}};
}

TEST(OutlineCrossings, AreOfHolesThatRunOutOfTheLayerBelow) {
  EXPECT_TRUE(outline_crossings(plate_on_neck(6.0, 9.0)).empty());
  EXPECT_TRUE(outline_crossings(plate_on_neck(6.0, 2.0)).empty());
  const auto found = outline_crossings(plate_on_neck(6.0, 7.5));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].depth_mm, 0.5);  // of 5.5 to 9.5 mm from the axis
  const ThinnestWall wall = thinnest_wall(plate_on_neck(6.0, 7.5));
  EXPECT_DOUBLE_EQ(wall.width_mm, -0.5);
  EXPECT_DOUBLE_EQ(wall.height_mm, 5.0);
}

TEST(OutlineCrossings, OfOneLayerAreHolesThatMeetOrLeaveIt) {
  EXPECT_EQ(outline_crossings(plate_on_neck(6.0, 19.0)).size(), 1u);
  PartShape two = plate_on_neck(6.0, 10.0);
  two.slabs[1].holes.push_back(CircleOutline{{10.0, 3.0}, 2.0});
  EXPECT_EQ(outline_crossings(two).size(), 1u);
  const Errors errors = crossing_outlines({.parts = {two}});
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].key, "plate");
}

/// The inserts of an output that the carrier is are pressed in through the face that its stop stands on.
TEST(Stop, StandsInsideTheInsertsOfTheOutput) {
  for (const double circle_mm : {16.0, 20.0, 26.0}) {
    const std::string output = "[output]\nbolt_circle_diameter_mm = " + std::to_string(circle_mm) + "\n[housing]";
    const Made made(replaced(kStepped + kMachine, "[housing]", output));
    const auto layout = machine_layout(made.train);
    if (layout->stop.upper_mm > layout->stop.lower_mm) {
      EXPECT_LT(layout->stop_radius_mm, 0.5 * (circle_mm - layout->output_screws.screw.insert_hole_mm));
    }
    EXPECT_TRUE(outline_crossings(made.part("carrier_top")).empty()) << circle_mm;
  }
}

}  // namespace
}  // namespace trueflank
