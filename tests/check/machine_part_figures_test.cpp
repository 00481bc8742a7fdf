// SPDX-License-Identifier: GPL-3.0-or-later
// Overhangs, walls, screws, collisions and order by hand: bodies of a few discs in place of a
// gearbox's parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/check/machine_bodies.h"
#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/check_overhang.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/solid/measure/overhang.h"

namespace trueflank {
namespace {

// ------------------------------------------------------------------------------------- overhangs

struct Printed {
  Printed() { process() = {.name = "mine", .ledge_mm = 1.0, .bridge_mm = 15.0}; }
  Process& process() { return *train.design.made.process; }
  [[nodiscard]] Finding of(const PartShape& part) const {
    return only(check_overhangs(train, {.parts = {part}}), "overhang", part.name);
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

TEST(OverhangFigures, AWayWithoutLimitIsNoneWhateverHangsThatWay) {
  Printed made;
  const PartShape cap{.name = "cap", .slabs = {{0, 4, round(9)}, {4, 6, round(11)}}};
  made.process() = {.name = "mine", .bridge_mm = 15.0};
  const Finding told = made.of(cap);
  EXPECT_EQ(told.status, CheckStatus::kPass) << told.message;
  EXPECT_EQ(told.limit, 15.0);
  EXPECT_EQ(told.cure, "");
  made.process() = {.name = "mine", .overhang_rad = 0.5};
  EXPECT_EQ(made.of(kMushroom).status, CheckStatus::kPass);
  EXPECT_EQ(made.of(kMushroom).unit, "deg");
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
  EXPECT_FALSE(
      says(only(check_overhangs(simple, {.parts = {part}}), "overhang", "mushroom").cure,
           "planet1"));
}

// --------------------------------------------------------- housing, walls, screws, collisions,
// order

/// What is said of bodies that are put into a gearbox in place of its own.
struct Judged {
  explicit Judged(const std::string& text = k3k + kMachine) : train(*lay_out(design_of(text))) {}
  [[nodiscard]] Finding of(const std::vector<PartShape>& parts, const std::string& id,
                           const std::string& where = "train") const {
    return only(check_machine(train, bodies(parts)), id, where);
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
  EXPECT_EQ(find_finding(check_machine(made.train, bodies({bought})), "wall", "plate"), nullptr);
  EXPECT_EQ(find_finding(check_machine(made.train, bodies({disc("plate", 0, 2, round(10))})),
                         "wall", "plate"),
            nullptr);
  // an own process is none: half of the housing's walls
  Judged own(replaced(replaced(k3k + kMachine, "[made]\nprocess = \"fdm-0.4\"\n", ""), "[housing]",
                      "[housing]\nwall_mm = 3"));
  EXPECT_EQ(own.of({plate(6.3)}, "wall", "plate").limit, 1.5);
}

TEST(WallFigures, AreThoseOfEveryPartThatIsMadeAndHasSome) {
  Judged made;
  PartShape bought = disc("6806", 0, 2, round(10), {round(5)});
  bought.bought = "6806";
  const std::vector<PartShape> parts{bought, disc("full", 0, 2, round(10)),
                                     disc("plate", 0, 2, round(10), {round(5)})};
  EXPECT_NEAR(made.of(parts, "wall", "plate").value, 5.0, 1e-9);
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
