// SPDX-License-Identifier: GPL-3.0-or-later
// The room of keys by hand: a screw, its insert and a cover in place of a gearbox.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/check/machine_bodies.h"
#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/check_access.h"

namespace trueflank {
namespace {

/// Screws of the housing alone: heads of 5.5 mm on 10 mm, 3 mm high, at (20, 0); their keys come
/// from above.
struct Keys {
  Keys() : m(*machine_layout(train)) {
    for (ScrewGroup* group :
         {&m.motor_screws, &m.carrier_screws, &m.output_screws, &m.retainer_screws})
      group->at.clear();
    ScrewGroup& g = m.housing_screws;
    g = {.what = "housing",
         .screw = g.screw,
         .length_mm = 8,
         .at = {Point2(20, 0)},
         .head_mm = 10,
         .way = -1,
         .insert_mm = 4};
    m.way = 1.0;
    shapes = bodies({disc("insert_m3_housing", 2, 4, round(2)),
                     disc("cover", 0, 20, round(30), {round(4, 20)}),
                     disc("screw_m3_housing", 2, 13, round(2.75))});
    for (const std::size_t body : {0U, 2U}) shapes.assembly[body].translation_mm = {20, 0, 0};
  }
  [[nodiscard]] Finding told() const {
    AssemblyOrder order{.units = {{.name = "gearbox"}}};
    for (std::size_t i = 0; i < shapes.assembly.size(); ++i)
      if (std::find(later.begin(), later.end(), i) == later.end())
        order.units[0].steps.push_back({.bodies = {i}});
    for (const std::size_t i : later) order.units[0].steps.push_back({.bodies = {i}});
    return only(check_access(train, m, shapes, order), "tool_access", "housing");
  }
  CircleOutline& hole() { return std::get<CircleOutline>(shapes.parts[1].slabs[0].holes[0]); }
  Slab& cover() { return shapes.parts[1].slabs[0]; }
  GearTrain train = *lay_out(design_of(k3k + kMachine));
  MachineLayout m;
  PartShapes shapes;
  std::vector<std::size_t> later;  ///< bodies that come last
};

TEST(KeyFigures, AKeyHasTheRoomBetweenItsHeadAndTheHoleOverIt) {
  Keys keys;
  EXPECT_NEAR(keys.told().value, 1.25, 1e-12);
  EXPECT_EQ(keys.told().status, CheckStatus::kPass);
  EXPECT_EQ(
      keys.told().message,
      "a key of 2.5 mm reaches every screw from above when it is put in, 1.25 mm beside cover");
  keys.hole().radius_mm = 2.0;
  EXPECT_NEAR(keys.told().value, -0.75, 1e-12);
  EXPECT_EQ(keys.told().status, CheckStatus::kFail);
  EXPECT_EQ(
      keys.told().message,
      "a key of 2.5 mm does not get to the screws from above: cover stands 0.75 mm in its way");
  keys.hole().radius_mm = 2.75;  // none at all is none
  EXPECT_EQ(keys.told().status, CheckStatus::kFail);
}

TEST(KeyFigures, WhatEndsBelowTheHeadOrComesLaterIsNotInTheWay) {
  Keys keys;
  const std::string free = "a key of 2.5 mm reaches every screw from above when it is put in";
  keys.hole().radius_mm = 2.0;
  keys.cover().z_upper_mm = 13.0;
  EXPECT_EQ(keys.told().message, free);
  keys.cover().z_upper_mm = 13.1;
  EXPECT_EQ(keys.told().status, CheckStatus::kFail);
  keys.later = {1};
  EXPECT_EQ(keys.told().message, free);
  // from below: the head is turned over, its top at 7
  Keys below;
  below.m.housing_screws.way = 1.0;
  below.shapes.parts[0].slabs[0] = {16, 18, round(2), {}};
  below.hole().radius_mm = 2.0;
  below.cover() = {6.9, 20, below.cover().outer, below.cover().holes};
  EXPECT_TRUE(says(below.told().message, "from below: cover stands 0.75 mm"))
      << below.told().message;
  below.cover().z_lower_mm = 7.0;
  EXPECT_TRUE(says(below.told().message, "reaches every screw from below"));
  // type II: heights are the other way round, the head's top at -13 and its key below that
  Keys mirrored;
  mirrored.m.way = -1.0;
  mirrored.hole().radius_mm = 2.0;
  mirrored.cover() = {-13.1, -5, mirrored.cover().outer, mirrored.cover().holes};
  EXPECT_TRUE(says(mirrored.told().message, "from below: cover"));
  mirrored.cover().z_lower_mm = -13.0;
  EXPECT_TRUE(says(mirrored.told().message, "reaches every screw from below"));
}

TEST(KeyFigures, AScrewTurnsIntoAnInsertOnItsAxisOrIntoTheMotor) {
  Keys keys;
  keys.later = {0};
  EXPECT_EQ(keys.told().status, CheckStatus::kFail);
  EXPECT_EQ(keys.told().value, -1.0);
  EXPECT_TRUE(says(keys.told().message, "turn into is not there yet")) << keys.told().message;
  keys.later.clear();
  keys.shapes.assembly[0].translation_mm[1] = 0.0009;
  EXPECT_EQ(keys.told().status, CheckStatus::kPass);
  keys.shapes.assembly[0].translation_mm[1] = 0.0011;
  EXPECT_EQ(keys.told().status, CheckStatus::kFail);
  keys.m.housing_screws.insert_mm = kNaN;  // the motor's own thread
  EXPECT_EQ(keys.told().status, CheckStatus::kFail);
  keys.shapes.parts[0].name = "motor_nema17";
  EXPECT_EQ(keys.told().status, CheckStatus::kPass);
  // an insert of other screws is none of these
  keys.m.housing_screws.insert_mm = 4.0;
  keys.shapes.assembly[0].translation_mm[1] = 0.0;
  keys.shapes.parts[0].name = "insert_m3_lid";
  EXPECT_EQ(keys.told().status, CheckStatus::kFail);
}

TEST(KeyFigures, TheWorstOfSeveralScrewsIsTold) {
  Keys keys;
  keys.cover().holes.push_back(round(3, -20));
  for (const std::size_t body : {0U, 2U}) {
    keys.shapes.assembly.push_back(keys.shapes.assembly[body]);
    keys.shapes.assembly.back().translation_mm[0] = -20.0;
  }
  EXPECT_NEAR(keys.told().value, 0.25, 1e-12);
  keys.shapes.assembly[3].translation_mm[0] = 20.0;  // the second has no insert
  EXPECT_EQ(keys.told().value, -1.0);
}

TEST(KeyFigures, EveryScrewOfAStepIsLookedAtAndOfEqualGapsTheFirstIsNamed) {
  // screws at 20, -20 and (0, 20), put in together; a cover each, the last with a body like it
  Keys keys;
  keys.m.housing_screws.insert_mm = kNaN;
  const auto cover = [](const char* name, double x, double y, double hole) {
    return disc(name, 14, 20, round(9, x, y), {round(hole, x, y)});
  };
  keys.shapes = bodies({disc("motor_nema17", -40, -30, round(20)), cover("one", 20, 0, 4),
                        cover("two", -20, 0, 5), cover("three", 0, 20, 3.5),
                        cover("like three", 0, 20, 3.5)});
  for (const Point2& at : {Point2(20, 0), Point2(-20, 0), Point2(0, 20)}) {
    keys.shapes.parts.push_back(disc("screw_m3_housing", 2, 13, round(2.75)));
    keys.shapes.assembly.push_back({.part = static_cast<int>(keys.shapes.parts.size()) - 1,
                                    .name = "screw",
                                    .translation_mm = {at.x(), at.y(), 0}});
  }
  AssemblyOrder order{.units = {{.name = "gearbox"}}};
  for (const std::size_t body : {0U, 1U, 2U, 3U, 4U})
    order.units[0].steps.push_back({.bodies = {body}});
  order.units[0].steps.push_back({.bodies = {5, 6, 7}});
  const auto told = [&] {
    return only(check_access(keys.train, keys.m, keys.shapes, order), "tool_access",
                       "housing")
        .message;
  };
  EXPECT_TRUE(says(told(), "0.75 mm beside three")) << told();
  for (const std::size_t body : {1U, 3U})
    std::get<CircleOutline>(keys.shapes.parts[body].slabs[0].holes[0]).radius_mm = 3.0;
  EXPECT_TRUE(says(told(), "0.25 mm beside one")) << told();
  // what comes with a screw counts, before it and after it
  order.units[0].steps = {{.bodies = {0}}, {.bodies = {7, 3}}};
  EXPECT_TRUE(says(told(), "0.25 mm beside three")) << told();
}

TEST(KeyFigures, ScrewsOfAUnitAreTightenedWhenThatIsMade) {
  Keys keys;
  keys.hole().radius_mm = 2.0;
  AssemblyOrder order{
      .units = {{.name = "lid", .steps = {{.bodies = {0}}, {.bodies = {2}}}},
                {.name = "gearbox", .steps = {{.bodies = {1}}, {.bodies = {0, 2}, .unit = 0}}}}};
  EXPECT_EQ(
      only(check_access(keys.train, keys.m, keys.shapes, order), "tool_access", "housing")
          .status,
      CheckStatus::kPass);
  order.units[1].steps[1].unit = -1;
  EXPECT_EQ(
      only(check_access(keys.train, keys.m, keys.shapes, order), "tool_access", "housing")
          .status,
      CheckStatus::kFail);
  order.stuck = {0, 1};
  EXPECT_TRUE(check_access(keys.train, keys.m, keys.shapes, order).empty());
}

TEST(KeyFigures, GroupsWithoutScrewsOrLengthHaveNoFinding) {
  Keys keys;
  const AssemblyOrder order{.units = {{.name = "gearbox", .steps = {{.bodies = {0}}}}}};
  EXPECT_EQ(check_access(keys.train, keys.m, keys.shapes, order).size(), 1U);
  keys.m.housing_screws.length_mm = 0.0;
  EXPECT_TRUE(check_access(keys.train, keys.m, keys.shapes, order).empty());
  keys.m.housing_screws.length_mm = 8.0;
  keys.m.housing_screws.at.clear();
  EXPECT_TRUE(check_access(keys.train, keys.m, keys.shapes, order).empty());
}

TEST(KeyFigures, ASetScrewIsReachedUnlessWhatIsThereStandsAtItsHeight) {
  Keys keys;
  keys.m.housing_screws.at.clear();
  keys.m.set_screw.screw = Screw{.name = "M3"};
  keys.m.set_screw.axis_mm = 7.0;
  keys.shapes = bodies({disc("motor_nema17", -40, 30, round(20)), disc("plate", 0, 5.5, round(30)),
                        disc("sun", 0, 20, round(5)), disc("housing", 0, 30, round(40))});
  AssemblyOrder order{
      .units = {{.name = "lid", .steps = {{.bodies = {3}}, {.bodies = {2}}}}, {.name = "gearbox"}}};
  for (const std::size_t i : {0U, 1U, 2U, 3U}) order.units[1].steps.push_back({.bodies = {i}});
  const auto told = [&] {
    return only(check_access(keys.train, keys.m, keys.shapes, order), "tool_access",
                       "set screw");
  };
  Slab& plate = keys.shapes.parts[1].slabs[0];
  EXPECT_EQ(told().status, CheckStatus::kPass) << told().message;  // M3 at 7: from 5.5 to 8.5
  EXPECT_EQ(told().margin, 0.0);
  EXPECT_TRUE(says(told().message, "a key of 1.5 mm reaches"));
  plate.z_upper_mm = 5.6;
  EXPECT_EQ(told().status, CheckStatus::kFail);
  EXPECT_EQ(told().margin, -1.0);
  EXPECT_TRUE(says(told().message, "plate is in its way when the sun goes")) << told().message;
  plate = {8.4, 30, plate.outer, {}};
  EXPECT_EQ(told().status, CheckStatus::kFail);
  plate.z_lower_mm = 8.5;
  EXPECT_EQ(told().status, CheckStatus::kPass);
  keys.m.way = -1.0;
  plate = {-5.6, -5.5, plate.outer, {}};
  EXPECT_EQ(told().status, CheckStatus::kFail);
  // the first of those in its way is named
  keys.m.way = 1.0;
  plate = {6, 7, plate.outer, {}};
  std::swap(order.units[1].steps[2], order.units[1].steps[3]);
  EXPECT_TRUE(says(told().message, "plate is in its way"));
  plate.z_upper_mm = plate.z_lower_mm = 0.0;
  EXPECT_TRUE(says(told().message, "housing is in its way"));
  // a gear that is never put on
  order.units[1].steps.erase(order.units[1].steps.end() - 1);
  EXPECT_TRUE(says(told().message, "nothing that it could be reached past is in its way"));
}

}  // namespace
}  // namespace trueflank
