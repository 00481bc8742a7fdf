// SPDX-License-Identifier: GPL-3.0-or-later
// Fits, overhangs, keys, walls, collisions and order by hand: bodies of a few discs in place of a
// gearbox's parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/check_access.h"
#include "trueflank/check/machine/check_fits.h"
#include "trueflank/check/machine/check_overhang.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/solid/measure/overhang.h"

namespace trueflank {
namespace {

const Finding* find(const Findings& findings, const std::string& id, const std::string& where) {
  for (const Finding& f : findings)
    if (f.id == id && f.where == where) return &f;
  return nullptr;
}
Finding one(const Findings& findings, const std::string& id, const std::string& where) {
  const Finding* found = find(findings, id, where);
  if (!found) throw std::runtime_error("no finding " + id + " of " + where);
  return *found;
}
CircleOutline round(double radius_mm, double x = 0.0, double y = 0.0) {
  return {.centre = {x, y}, .radius_mm = radius_mm};
}
PartShape disc(const std::string& name, double lower, double upper, CircleOutline outer,
               std::vector<Outline> holes = {}) {
  return {.name = name, .slabs = {{lower, upper, outer, std::move(holes)}}};
}
/// A body a part, where the part is.
PartShapes bodies(std::vector<PartShape> parts) {
  PartShapes shapes{.parts = std::move(parts)};
  for (std::size_t i = 0; i < shapes.parts.size(); ++i)
    shapes.assembly.push_back({.part = static_cast<int>(i), .name = shapes.parts[i].name});
  return shapes;
}

// ----------------------------------------------------------------------------------------- fits

const std::string kFitted = machined(k3k + kMachine);

TEST(FitFigures, ClearancesOfBearingsFollowFromIsoClassesAndRings) {
  GearTrain train = *lay_out(design_of(kFitted));
  struct Case {
    double size;
    const char* clearance;
  };
  // H7 is 0 to IT7, the ring up to so much below its size (ISO 492, class Normal)
  for (const Case& c : std::array<Case, 9>{{{16, "+0 to +26"},
                                            {18, "+0 to +26"},
                                            {30, "+0 to +30"},
                                            {50, "+0 to +36"},
                                            {80, "+0 to +43"},
                                            {120, "+0 to +50"},
                                            {150, "+0 to +58"},
                                            {180, "+0 to +65"},
                                            {250, "+0 to +76"}}}) {
    train.design.machine->bearings.output.outer_mm = c.size;
    EXPECT_TRUE(says(one(check_fits(train), "fits", "output").message,
                     std::string("clearance ") + c.clearance))
        << c.size << one(check_fits(train), "fits", "output").message;
  }
  train.design.machine->bearings.output.outer_mm = 260.0;
  const Finding large = one(check_fits(train), "fits", "output");
  EXPECT_EQ(large.status, CheckStatus::kWarn);
  EXPECT_EQ(large.margin, -1.0);
  EXPECT_TRUE(std::isnan(large.value));
  EXPECT_TRUE(says(large.message, "above 250 mm"));
  train.design.machine->bearings.output.outer_mm = 180.0;
  // g6
  for (const Case& c : std::array<Case, 6>{{{18, "-2 to +17"},
                                            {30, "-3 to +20"},
                                            {50, "-3 to +25"},
                                            {80, "-5 to +29"},
                                            {120, "-8 to +34"},
                                            {180, "-11 to +39"}}}) {
    train.design.machine->bearings.output.bore_mm = c.size;
    EXPECT_TRUE(says(one(check_fits(train), "fits", "output").message,
                     std::string("clearance ") + c.clearance))
        << c.size << one(check_fits(train), "fits", "output").message;
  }
}

TEST(FitFigures, TightJournalsLeaveOfEachBoresClearanceWhatTheRacewayDoesNotTake) {
  GearTrain train =
      *lay_out(design_of(replaced(kFitted, "[bearings]", "[bearings]\noutput_fit = \"H7/k6\"")));
  Bearing& bearing = train.design.machine->bearings.output;
  bearing.outer_mm = 180.0;
  struct Case {
    double bore, left_um;
  };
  // the middle of group N less 0.8 of k6's middle over that of the bore
  for (const Case& c : std::array<Case, 8>{{{10, -0.1},
                                            {18, 2.1},
                                            {30, 1.7},
                                            {40, 0.2},
                                            {50, 1.7},
                                            {65, 2.8},
                                            {80, 4.8},
                                            {100, 4.8}}}) {
    bearing.bore_mm = c.bore;
    const Finding told = one(check_fits(train), "fits", "output");
    EXPECT_EQ(told.status, c.left_um < 0.0 ? CheckStatus::kWarn : CheckStatus::kPass) << c.bore;
    const std::string left = c.left_um == -0.1 ? "-0.1" : std::to_string(c.left_um).substr(0, 3);
    EXPECT_TRUE(says(told.message, "they leave " + left + " um in the middle")) << told.message;
    if (c.left_um < 0.0) {
      EXPECT_NEAR(told.value, -0.0001, 1e-12);
      EXPECT_EQ(told.margin, told.value);
      EXPECT_EQ(told.limit, 0.0);
    }
  }
  bearing.bore_mm = 101.0;
  EXPECT_FALSE(says(one(check_fits(train), "fits", "output").message, "5753"));
  bearing.bore_mm = 30.0;
  bearing.kind = BearingKind::kCrossedRollers;
  EXPECT_FALSE(says(one(check_fits(train), "fits", "output").message, "5753"));
}

TEST(FitFigures, ATightSeatOfAPlanetSqueezesItsBallsToo) {
  // 16 N7 is -23 to -5, the ring -8 to 0: 10 um; a bore of 5 mm has 2 to 13
  GearTrain train =
      *lay_out(design_of(replaced(kFitted, "[bearings]", "[bearings]\nplanet_fit = \"N7\"")));
  const Finding told = one(check_fits(train), "fits", "planet");
  EXPECT_NEAR(told.value, (7.5 - 8.0) / 1000.0, 1e-12);
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  // plastic moves no ring
  train.design.made.process->layer_mm = 0.2;
  EXPECT_FALSE(says(one(check_fits(train), "fits", "planet").message, "5753"));
}

TEST(FitFigures, TheFirstLimitsAreTheValueAndPrintersDoNotHoldThem) {
  GearTrain train = *lay_out(design_of(kFitted));
  const Finding held = one(check_fits(train), "fits", "output");
  EXPECT_NEAR(held.value, 0.025, 1e-12);
  EXPECT_EQ(held.status, CheckStatus::kPass);
  train.design.made.process->layer_mm = 0.2;
  const Finding printed = one(check_fits(train), "fits", "output");
  EXPECT_EQ(printed.margin, -1.0);
  EXPECT_EQ(printed.status, CheckStatus::kWarn);
  EXPECT_TRUE(says(printed.message,
                   "6806: seat 42 H7 (+0 to +25 um), clearance +0 to +36 um; journal 30 g6"))
      << printed.message;
  EXPECT_TRUE(says(printed.message, "printers do not hold"));
  train.design.made.process.reset();
  EXPECT_EQ(one(check_fits(train), "fits", "output").status, CheckStatus::kPass);
}

TEST(FitFigures, OfRingLidShaftAndCollarAreThoseOfTheirSizes) {
  GearTrain train = *lay_out(design_of(kFitted));
  train.design.machine->motor.pilot_diameter_mm = 0.5;
  EXPECT_TRUE(says(one(check_fits(train), "fits", "motor_pilot").message, "0.5 H7 (+0 to +10 um)"));
  train.design.machine->motor.pilot_diameter_mm = 0.0;
  EXPECT_EQ(find(check_fits(train), "fits", "motor_pilot"), nullptr);
  EXPECT_TRUE(
      says(one(check_fits(train), "fits", "motor_shaft").message, "hole 5 H7 (+0 to +12 um)"));
  EXPECT_FALSE(says(one(check_fits(train), "fits", "motor_shaft").message, "clearance"));
  const double ring = 2.0 * machine_layout(train)->ring_radius_mm;
  EXPECT_TRUE(
      says(one(check_fits(train), "fits", "ring").message, "hole " + number_text(ring) + " H7"))
      << ring;
  const GearTrain pair = *lay_out(design_of(machined(kPair + kBox)));
  const double lid = 2.0 * machine_layout(pair)->cavity_radius_mm;
  const Finding rim = one(check_fits(pair), "fits", "lid");
  EXPECT_TRUE(says(rim.message, "hole " + number_text(lid) + " H7")) << rim.message << lid;
  EXPECT_EQ(find(check_fits(pair), "fits", "ring"), nullptr);
  EXPECT_EQ(find(check_fits(train), "fits", "lid"), nullptr);
  EXPECT_TRUE(says(one(check_fits(pair), "fits", "wheel").message, "journal 8"));
}

TEST(FitFigures, OfBothSidesAreComparedWithEachOther) {
  // 5 N7 is -16 to -4 in the pins' plates; ring H7/g6 of 80 to 120 mm: 0 to 35, -34 to -12
  const GearTrain train = *lay_out(design_of(
      replaced(kFitted, "[housing]", "[housing]\nring_fit = \"H7/g6\"\npin_fit = \"N7\"")));
  ASSERT_NEAR(2.0 * machine_layout(train)->ring_radius_mm, 100.0, 20.0);
  const Finding ring = one(check_fits(train), "fits", "ring");
  EXPECT_TRUE(says(ring.message, "H7 (+0 to +35 um), clearance +12 to +69 um")) << ring.message;
  EXPECT_TRUE(says(one(check_fits(train), "fits", "pins").message, "5 N7 (-16 to -4 um)"));
}

// ------------------------------------------------------------------------------------- overhangs

struct Printed {
  Printed() { process() = {.name = "mine", .ledge_mm = 1.0, .bridge_mm = 15.0}; }
  Process& process() { return *train.design.made.process; }
  [[nodiscard]] Finding of(const PartShape& part) const {
    return one(check_overhangs(train, {.parts = {part}}), "overhang", part.name);
  }
  GearTrain train = *lay_out(design_of(k3k + kMachine));
};
const PartShape kMushroom{.name = "mushroom",
                          .slabs = {{0, 4, round(9), {round(5)}}, {4, 6, round(11)}}};

TEST(OverhangFigures, TheWayInWhichAPartHangsMostOfItsLimitIsTold) {
  Printed made;
  const Finding ledge = made.of(kMushroom);
  EXPECT_NEAR(ledge.value, 2.0, 1e-12);
  EXPECT_EQ(ledge.limit, 1.0);
  EXPECT_NEAR(ledge.margin, -1.0, 1e-12);
  EXPECT_EQ(ledge.status, CheckStatus::kWarn);
  EXPECT_EQ(ledge.message,
            "mushroom: as it lies on the bed an underside stands out by 2 mm, 4 mm above the bed; "
            "mine prints 1 mm without "
            "support");
  // 10 of 4 is more than 2 of 1
  made.process().bridge_mm = 4.0;
  const Finding bridge = made.of(kMushroom);
  EXPECT_NEAR(bridge.value, 10.0, 1e-12);
  EXPECT_EQ(bridge.limit, 4.0);
  EXPECT_TRUE(says(bridge.message, "bridges 10 mm, 4 mm above the bed"));
  EXPECT_TRUE(says(bridge.cure, "in the hole under it"));
  // equal shares: the ledge
  made.process().bridge_mm = 5.0;
  EXPECT_NEAR(made.of(kMushroom).value, 2.0, 1e-12);
  PartShape turned = kMushroom;
  turned.upside_down = true;
  EXPECT_EQ(made.of(turned).status, CheckStatus::kPass);
  EXPECT_TRUE(says(made.of(turned).message, "on the bed, turned over, an"));
}

TEST(OverhangFigures, AnyOfTheLimitsAloneIsJudgedAndNoneIsNot) {
  Printed made;
  const auto judged_by = [&](double ledge, double bridge, double lean) {
    made.process() = {.name = "mine", .ledge_mm = ledge, .bridge_mm = bridge, .overhang_rad = lean};
    return check_overhangs(made.train, {.parts = {kMushroom}});
  };
  EXPECT_TRUE(judged_by(0, 0, 0).empty());
  EXPECT_EQ(judged_by(0.5, 0, 0).front().limit, 0.5);
  EXPECT_EQ(judged_by(0, 0.5, 0).front().limit, 0.5);
  ASSERT_EQ(judged_by(0, 0, 0.5).size(), 1U);
  EXPECT_EQ(judged_by(2.0, 0, 0).front().status, CheckStatus::kPass);
  PartShape bearing = kMushroom;
  bearing.bought = "6806";
  EXPECT_TRUE(check_overhangs(made.train, {.parts = {bearing}}).empty());
  made.train.design.made.process.reset();
  EXPECT_TRUE(check_overhangs(made.train, {.parts = {kMushroom}}).empty());
}

TEST(OverhangFigures, LeaningFlanksAreToldInDegrees) {
  const Made made(replaced(kSimple, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 43") +
                  kMachine);
  const double lean =
      deg_from_rad(overhang(made.part("sun"), made.part("sun").upside_down).lean_rad);
  const Finding& told = made.finding("overhang", "sun");
  EXPECT_NEAR(told.value, lean, 1e-9);
  EXPECT_NEAR(told.limit, deg_from_rad(made.train.design.made.process->overhang_rad), 1e-9);
  EXPECT_EQ(told.unit, "deg");
}

TEST(OverhangFigures, StackedTeethAndSetScrewsHaveCuresOfTheirOwn) {
  Printed made;
  const int planet = made.train.topology().first_planet(), sun = made.train.topology().input;
  PartShape part = kMushroom;
  part.member = planet;
  EXPECT_TRUE(says(made.of(part).cure, "planet1 and planet2"));
  made.process().bridge_mm = 4.0;  // a bridge is none of the teeth
  EXPECT_FALSE(says(made.of(part).cure, "planet1"));
  made.process().bridge_mm = 15.0;
  part.member = sun;
  EXPECT_EQ(made.of(part).cure, "supports in the slicer under it, to be cut away");
  Printed screwed;
  screwed.train = *lay_out(design_of(round_shaft(k3k + kMachine)));
  screwed.process() = made.process();
  EXPECT_TRUE(says(screwed.of(part).cure, "set_screw = \"never\""));
  part.member = planet;
  EXPECT_FALSE(says(screwed.of(part).cure, "set_screw"));
  part.member = sun;
  screwed.process().ledge_mm = 2.0;
  EXPECT_EQ(screwed.of(part).cure, "");
  const GearTrain simple = *lay_out(design_of(kSimple + kMachine));
  part.member = simple.topology().first_planet();
  EXPECT_FALSE(says(one(check_overhangs(simple, {.parts = {part}}), "overhang", "mushroom").cure,
                    "planet1"));
}

// ------------------------------------------------------------------------------------------ keys

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
    return one(check_access(train, m, shapes, order), "tool_access", "housing");
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

TEST(KeyFigures, ScrewsOfAUnitAreTightenedWhenThatIsMade) {
  Keys keys;
  keys.hole().radius_mm = 2.0;
  AssemblyOrder order{
      .units = {{.name = "lid", .steps = {{.bodies = {0}}, {.bodies = {2}}}},
                {.name = "gearbox", .steps = {{.bodies = {1}}, {.bodies = {0, 2}, .unit = 0}}}}};
  EXPECT_EQ(
      one(check_access(keys.train, keys.m, keys.shapes, order), "tool_access", "housing").status,
      CheckStatus::kPass);
  order.units[1].steps[1].unit = -1;
  EXPECT_EQ(
      one(check_access(keys.train, keys.m, keys.shapes, order), "tool_access", "housing").status,
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
    return one(check_access(keys.train, keys.m, keys.shapes, order), "tool_access", "set screw");
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

// --------------------------------------------------------- housing, walls, screws, collisions,
// order

/// What is said of bodies that are put into a gearbox in place of its own.
struct Judged {
  explicit Judged(const std::string& text = k3k + kMachine) : train(*lay_out(design_of(text))) {}
  [[nodiscard]] Finding of(const std::vector<PartShape>& parts, const std::string& id,
                           const std::string& where = "train") const {
    return one(check_machine(train, bodies(parts)), id, where);
  }
  GearTrain train;
};

TEST(HousingFigures, TheDiameterThatIsNeededIsToldToTheNextTenth) {
  const auto with = [](const std::string& d) {
    return Judged(replaced(k3k + kMachine, "[housing]\n",
                           "[housing]\nouter_diameter_mm = " + d + "\n"))
        .of({}, "housing_size", "housing");
  };
  const Finding small = with("84");
  EXPECT_EQ(small.value, 84.0);
  EXPECT_NEAR(small.margin, 84.0 - small.limit, 1e-9);
  const double needed = std::ceil(10.0 * small.limit) / 10.0;
  EXPECT_TRUE(says(small.cure, "of " + number_text(needed) + " mm at least")) << small.cure;
  EXPECT_EQ(with(number_text(needed)).status, CheckStatus::kPass);
  EXPECT_NE(with(number_text(needed - 0.1)).status, CheckStatus::kPass);
}

TEST(WallFigures, AreWhatIsLeftBesideAHole) {
  Judged made;
  const auto plate = [](double x) {
    return PartShape{.name = "plate",
                     .slabs = {{0, 2, round(10)}, {2, 4, round(10), {round(3, x)}}}};
  };
  // 10 - 3 - 6.3 = 0.7 of 0.8
  const Finding thin = made.of({plate(6.3)}, "wall", "plate");
  EXPECT_NEAR(thin.value, 0.7, 1e-9);
  EXPECT_EQ(thin.limit, 0.8);
  EXPECT_EQ(thin.status, CheckStatus::kWarn);
  EXPECT_EQ(thin.message, "plate: the thinnest wall is 0.7 mm, 2 mm above its lower face");
  EXPECT_EQ(made.of({plate(6.2)}, "wall", "plate").status, CheckStatus::kPass);
  const Finding crossed = made.of({plate(7.5)}, "wall", "plate");
  EXPECT_EQ(crossed.status, CheckStatus::kFail);
  EXPECT_EQ(crossed.message,
            "plate: two surfaces run into each other by 0.5 mm, 2 mm above its lower face");
  PartShape bought = plate(7.5);
  bought.bought = "6806";
  EXPECT_EQ(find(check_machine(made.train, bodies({bought})), "wall", "plate"), nullptr);
  EXPECT_EQ(
      find(check_machine(made.train, bodies({disc("plate", 0, 2, round(10))})), "wall", "plate"),
      nullptr);
  // an own process is none: half of the housing's walls
  Judged own(replaced(replaced(k3k + kMachine, "[made]\nprocess = \"fdm-0.4\"\n", ""), "[housing]",
                      "[housing]\nwall_mm = 3"));
  EXPECT_EQ(own.of({plate(6.3)}, "wall", "plate").limit, 1.5);
}

TEST(WallFigures, OfASunThatIdlesHaveACureOfTheirOwn) {
  Judged idle(idle_sun(k3k + kMachine));
  const auto cure = [&](const std::string& name, double x) {
    return idle.of({disc(name, 0, 2, round(10), {round(3, x)})}, "wall", name).cure;
  };
  EXPECT_TRUE(says(cure("sun", 6.3), "no [sun]: it idles"));
  EXPECT_TRUE(says(cure("plate", 6.3), "a larger outer_diameter_mm"));
  EXPECT_EQ(cure("sun", 6.0), "");
  Judged driven;
  EXPECT_FALSE(says(driven.of({disc("sun", 0, 2, round(10), {round(3, 6.3)})}, "wall", "sun").cure,
                    "idles"));
}

TEST(ScrewFigures, AreToldWithTheLengthsThatWouldDo) {
  Judged made;
  const auto m = machine_layout(made.train);
  const ScrewGroup& g = m->housing_screws;
  const Finding told = made.of({}, "screws", "housing");
  EXPECT_EQ(told.value, g.length_mm);
  EXPECT_EQ(told.limit, g.shortest_mm);
  EXPECT_NEAR(told.margin, g.length_mm - g.shortest_mm, 1e-12);
  EXPECT_EQ(told.message, "6 screws " + g.screw.name + " of " + number_text(g.length_mm) +
                              " mm hold; " + number_text(g.shortest_mm) + " mm to " +
                              number_text(g.longest_mm) + " mm would");
  Judged thin(replaced(replaced(k3k + kMachine, "\"6806\"", "\"6806\"\noutputs = 4"),
                       "carrier =", "output = \"M2\"\ncarrier ="));
  const Finding none = thin.of({}, "screws", "output");
  EXPECT_EQ(none.margin, -1.0);
  EXPECT_TRUE(says(none.cure, "another screw in [fasteners], or longer")) << none.cure;
}

TEST(ScrewFigures, HeadsOfTheMotorsScrewsStandClearOfTheWall) {
  for (const std::string& text : {k3k + kMachine, kPair + kBox}) {
    Judged made(text);
    const auto m = machine_layout(made.train);
    // M3: 5.5 mm; corners of a square of 31 mm, whose nearest to the wall counts
    double farthest = 0.0;
    for (const double x : {-15.5, 15.5})
      for (const double y : {-15.5, 15.5})
        farthest = std::max(farthest, (Point2(x, y) - m->housing_axis).norm());
    const Finding told = made.of({}, "screw_access", "motor");
    EXPECT_NEAR(told.value, m->cavity_radius_mm - farthest - 2.75, 0.03);
    EXPECT_TRUE(says(told.message, "clear the housing's wall by " + mm_text(told.value)))
        << told.message;
  }
  Judged wide(replaced(k3k + kMachine, "\"nema17\"", "\"nema17\"\nbolt_circle_diameter_mm = 76"));
  const Finding told = wide.of({}, "screw_access", "motor");
  EXPECT_NEAR(told.value, machine_layout(wide.train)->cavity_radius_mm - 38.0 - 2.75, 1e-9);
  EXPECT_TRUE(says(told.message, "run into the housing's wall by " + mm_text(-told.value)))
      << told.message;
}

TEST(CollisionFigures, WhatTurnsPassesAtHalfOfTheClearance) {
  Judged made;
  const auto gap = [&](double gap_mm, const std::string& name) {
    PartShape turning = disc(name, 0, 5, round(5));
    turning.member = made.train.topology().input;
    return made.of({disc("wall", 0, 5, round(20), {round(5.0 + gap_mm)}), turning}, "collision");
  };
  EXPECT_EQ(gap(0.6, "sun").message,
            "nothing runs into anything through a whole turn; wall and sun come nearest, 0.6 mm");
  EXPECT_NEAR(gap(0.6, "sun").margin, 0.6, 1e-9);
  EXPECT_EQ(gap(0.25, "sun").status, CheckStatus::kPass);
  const Finding near = gap(0.2, "sun");
  EXPECT_EQ(near.status, CheckStatus::kWarn);
  EXPECT_NEAR(near.limit, 0.25, 1e-12);
  EXPECT_NEAR(near.margin, -0.05, 1e-9);
  EXPECT_TRUE(says(near.message, "they may rub"));
  EXPECT_EQ(near.cure, "a gap of 0.25 mm: other sizes of the two");
  EXPECT_TRUE(says(gap(0.2, "planet 1").cure, "a ring's cup"));
}

TEST(CollisionFigures, TheFirstFourAreNamedAndTheDeepestIsTheValue) {
  Judged made;
  const auto pins = [&](std::size_t count) {
    // a plate of 20 mm, and pins of 2 mm around it, each 0.1 mm deeper in it than the one before
    std::vector<PartShape> parts{disc("plate", 0, 9, round(20))};
    for (std::size_t i = 0; i < count; ++i) {
      const double at = 22.0 - 0.1 * static_cast<double>(i + 1), turn = static_cast<double>(i);
      parts.push_back(disc("pin " + std::to_string(i + 1), 0, 9,
                           round(2, at * std::cos(turn), at * std::sin(turn))));
    }
    return made.of(parts, "collision");
  };
  const Finding two = pins(2);
  EXPECT_EQ(two.status, CheckStatus::kFail);
  EXPECT_EQ(two.message, "plate runs into pin 1 by 0.1 mm; plate runs into pin 2 by 0.2 mm");
  EXPECT_NEAR(two.value, -0.2, 1e-9);
  EXPECT_NEAR(two.margin, -0.2, 1e-9);
  EXPECT_FALSE(says(pins(4).message, "more"));
  EXPECT_TRUE(says(pins(4).message, "pin 4"));
  EXPECT_TRUE(says(pins(6).message, "; plate runs into pin 4 by 0.4 mm; and 2 more"));
  EXPECT_FALSE(says(pins(6).message, "pin 5"));
}

TEST(OrderFigures, BodiesThatHoldEachOtherAreCountedAndTwoAreNamedGearsFirst) {
  Judged made;
  // a spool with rings around its neck
  const PartShape spool{.name = "spool",
                        .slabs = {{0, 2, round(9)}, {2, 12, round(2)}, {12, 14, round(9)}}};
  const auto ring = [](const std::string& name, double at, PartRole role) {
    PartShape part = disc(name, at, at + 1, round(12), {round(3)});
    part.role = role;
    return part;
  };
  const Finding plain = made.of({spool, ring("hoop", 3, PartRole::kOther)}, "assembly_order");
  EXPECT_EQ(plain.status, CheckStatus::kFail);
  EXPECT_EQ(plain.value, 2.0);
  EXPECT_EQ(plain.margin, -2.0);
  EXPECT_TRUE(says(plain.message, "2 bodies hold each other")) << plain.message;
  EXPECT_TRUE(says(plain.message, "spool and hoop among them")) << plain.message;
  EXPECT_EQ(plain.cure, "other sizes of the two: see their tables");
  // one gear says no more than the others, two do
  const auto three = [&](PartRole first, PartRole second) {
    return made.of({spool, ring("a", 3, first), ring("b", 6, second)}, "assembly_order").message;
  };
  EXPECT_TRUE(says(three(PartRole::kOther, PartRole::kSun), "spool and a among them"));
  for (const PartRole role :
       {PartRole::kSun, PartRole::kPlanet, PartRole::kRing, PartRole::kUpperRing})
    EXPECT_TRUE(says(three(role, PartRole::kSun), "a and b among them"));
  // what also runs into each other says so
  const Finding through =
      made.of({spool, disc("hoop", 3, 4, round(12), {round(1.5)})}, "assembly_order");
  EXPECT_TRUE(says(through.cure, "see collision")) << through.cure;
  const Finding apart =
      made.of({disc("a", 0, 1, round(5)), disc("b", 2, 3, round(5))}, "assembly_order");
  EXPECT_EQ(apart.margin, 0.0);
  EXPECT_TRUE(says(apart.message, "all 2 bodies go in along the axis"));
}

}  // namespace
}  // namespace trueflank
