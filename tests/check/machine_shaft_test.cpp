// SPDX-License-Identifier: GPL-3.0-or-later
// What holds the gear on the motor's shaft. That such gearboxes are closed, free of collisions and go
// together: machine_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "tests/check/machine_designs.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/solid/measure/bill_of_materials.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank {
namespace {

TEST(SetScrew, TurnsInASquareNutThatLiesInAPocketOfTheBore) {
  const Made made(round_shaft(k3k + kMachine));
  const auto m = machine_layout(made.train);
  const auto& s = m->set_screw;
  ASSERT_TRUE(s.is_there()) << s.missing;
  const Slab& lowest = made.part("sun").slabs.front();
  // M3: a nut of 5.5 x 5.5 x 1.8 (DIN 562), its outer face 2.1 mm outside the bore of 5.1
  const auto* bore = std::get_if<BoreOutline>(&lowest.holes.front());
  ASSERT_TRUE(bore);
  EXPECT_EQ(bore->bore.kind, BoreKind::kKeyway);
  EXPECT_NEAR(bore->bore.keyway_width_mm, 5.7, 1e-12);
  EXPECT_NEAR(0.5 * bore->bore.diameter_mm + bore->bore.keyway_depth_mm, 2.55 + 0.1 + 2.0, 1e-12);
  EXPECT_GT(bore->bore.diameter_mm, bore->bore.keyway_width_mm);
  const auto* foot = std::get_if<BoreOutline>(&lowest.outer);
  ASSERT_TRUE(foot);
  const double flat = foot->bore.d_flat_mm - 0.5 * foot->bore.diameter_mm;
  EXPECT_NEAR(flat, std::hypot(4.65, 2.85) + m->wall_mm, 1e-12);
  EXPECT_NEAR(s.through_mm, flat - 4.65, 1e-12);
  // the pocket is open to the motor, and its screw is in the middle of it
  EXPECT_NEAR(lowest.z_upper_mm, 5.7, 1e-9);
  EXPECT_NEAR(s.axis_mm, m->hub.lower_mm + 2.85, 1e-9);
  EXPECT_LE(2.5 + s.length_mm, flat);
  EXPECT_EQ(bought_for_set_screw(s),
            (std::vector<std::string>{"set screw ISO 4029 M3x4", "square nut DIN 562 M3"}));
  EXPECT_NE(set_screw_operation(*m).find("3.4 mm"), std::string::npos);
}

TEST(SetScrew, IsTightenedBeforeTheHousingGoesOverTheGear) {
  for (const std::string& text : {k3k + kMachine, kPair + kBox}) {
    const Made made(round_shaft(text));
    const auto m = machine_layout(made.train);
    ASSERT_TRUE(m->set_screw.is_there());
    const std::string gear = made.train.topology().name_of(made.train.topology().input);
    const AssemblyOrder order = assembly_order(made.train, made.shapes);
    const auto place_of = [&](const std::string& name) {
      const auto& steps = order.units.back().steps;
      for (std::size_t i = 0; i < steps.size(); ++i)
        for (const std::size_t body : steps[i].bodies)
          if (made.shapes.assembly[body].name == name) return i;
      return steps.size();
    };
    EXPECT_LT(place_of(gear), place_of("housing"));
    // it goes through the hole of the floor, which the motor's heads leave its wall
    const double tip = made.train.gear(m->driven_gear).profile.tip_radius_mm();
    EXPECT_GE(m->floor_hole_radius_mm, std::max(tip, m->set_screw.foot_radius_mm) + m->clearance_mm - 1e-9);
    EXPECT_LE(m->set_screw.foot.upper_mm, m->floor.upper_mm + 1e-9);
  }
}

TEST(SetScrew, OfAMetalHubHasItsThreadThere) {
  const Made made(machined(round_shaft(kStepped + kMachine)));
  const auto m = machine_layout(made.train);
  ASSERT_TRUE(m->set_screw.is_there()) << m->set_screw.missing;
  EXPECT_FALSE(m->set_screw.nut);
  EXPECT_NEAR(m->set_screw.through_mm, 4.5, 1e-9);
  EXPECT_EQ(bought_for_set_screw(m->set_screw).size(), 1U);
  EXPECT_EQ(set_screw_operation(*m).rfind("Drill and tap M3", 0), 0U);
}

TEST(SetScrew, IsNotThereWhereTheShaftIsFlatOrTheGearCannotPass) {
  EXPECT_FALSE(machine_layout(Made(k3k + kMachine).train)->set_screw.is_there());
  // nothing that the housing could go over: the carrier is on the shaft
  const std::string carrier = replaced(
      replaced(k3k + kMachine, "planets = 3", "planets = 3\ninput = \"carrier\""),
      "[sun]\nteeth = 12\nface_width_mm = 10\n", "");
  const Made driven(round_shaft(carrier));
  const Finding& glued = driven.finding("shaft_grip", "carrier");
  EXPECT_EQ(glued.status, CheckStatus::kWarn);
  EXPECT_NE(glued.message.find("glue alone"), std::string::npos) << glued.message;
  EXPECT_NE(glued.message.find("the carrier is on the shaft"), std::string::npos) << glued.message;
  EXPECT_NE(glued.cure.find("flat_mm"), std::string::npos);
  // a sun wider than the hole for the collar of 22 mm
  const Made wide(round_shaft(kSimple + kMachine));
  const auto m = machine_layout(wide.train);
  const double tip = wide.train.gear(m->driven_gear).profile.tip_radius_mm();
  EXPECT_EQ(m->set_screw.is_there(), tip + m->clearance_mm <= 11.05);
  const Made wider(round_shaft(replaced(kSimple + kMachine, "teeth = 18", "teeth = 24")));
  const Finding& told = wider.finding("shaft_grip", "sun");
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  EXPECT_NE(told.message.find("a set screw wants a hole"), std::string::npos) << told.message;
}

TEST(SetScrew, ThatAMotorIsStrongerThanWarns) {
  // 30 MPa on 5.5^2 - pi 3.4^2 / 4 mm2, friction 0.15 on both sides of a shaft of 5 mm
  const double holds = 2.0 * 0.15 * 30.0 * (5.5 * 5.5 - 0.25 * kPi * 3.4 * 3.4) * 2.5e-3;
  const Made weak(round_shaft(k3k + kMachine));
  const auto m = machine_layout(weak.train);
  EXPECT_NEAR(held_torque_nm(m->set_screw, 5.0), holds, 1e-12);
  EXPECT_EQ(weak.finding("shaft_grip", "sun").status, CheckStatus::kPass);
  const Made strong(replaced(round_shaft(k3k + kMachine), "torque_nm = 0.4", "torque_nm = 0.6"));
  EXPECT_EQ(strong.finding("shaft_grip", "sun").status, CheckStatus::kWarn);
}

TEST(SetScrew, IsInTheBillInItsPlace) {
  BillOfMaterials bill{{.part = "sun", .count = 1},
                       {.designation = "ISO 4762 M3x8", .count = 4},
                       {.designation = "square nut DIN 562 M3", .count = 2}};
  add_bought(bill, "set screw ISO 4029 M3x4");
  add_bought(bill, "square nut DIN 562 M3");
  ASSERT_EQ(bill.size(), 4U);
  EXPECT_EQ(bill[2].designation, "set screw ISO 4029 M3x4");
  EXPECT_EQ(bill[3].count, 3);
}

TEST(SetScrew, BearsOnTheFlatOfAShaftThatHasOne) {
  const auto with = [](const std::string& text) {
    return text.find("[fasteners]") == std::string::npos
               ? text + "[fasteners]\nset_screw = \"always\"\n"
               : replaced(text, "[fasteners]", "[fasteners]\nset_screw = \"always\"");
  };
  for (const std::string& text : {k3k + kMachine, kPair + kBox, machined(kStepped + kMachine)}) {
    const Made made(with(text));
    const auto m = machine_layout(made.train);
    const auto& s = m->set_screw;
    ASSERT_TRUE(s.is_there()) << s.missing;
    EXPECT_TRUE(s.on_flat);
    // NEMA 17: a shaft of 5 mm, 4.5 over its flat, which begins 9 mm above the motor's face
    EXPECT_NEAR(s.bears_mm, 2.0, 1e-12);
    EXPECT_GE(s.axis_mm - 1.5, m->floor.lower_mm + 9.0);
    EXPECT_LE(s.bears_mm + s.length_mm, s.nut ? s.flat_mm : s.foot_radius_mm);
    const std::string gear = made.train.topology().name_of(made.train.topology().input);
    const Finding& grip = made.finding("shaft_grip", gear);
    EXPECT_EQ(grip.status, CheckStatus::kPass) << grip.message;
    EXPECT_NE(grip.message.find("bears on its flat"), std::string::npos) << grip.message;
    EXPECT_EQ(made.finding("collision", "train").status, CheckStatus::kPass);
    EXPECT_EQ(made.finding("assembly_order", "train").status, CheckStatus::kPass);
    // pocket and flat are on one side of the bore, +x, in every slab that has them
    bool flat = false;
    for (const Slab& slab : made.part(gear).slabs)
      for (const Outline& hole : slab.holes)
        if (const auto* bore = std::get_if<BoreOutline>(&hole))
          flat = flat || bore->bore.kind == BoreKind::kDFlat;
    EXPECT_TRUE(flat);
  }
}

TEST(SetScrew, OnAFlatThatTheHubDoesNotReachIsToldAndOneThatIsNotWantedIsNotThere) {
  const std::string always = replaced(k3k + kMachine, "[fasteners]", "[fasteners]\nset_screw = \"always\"");
  const Made wide(replaced(always, "name = \"nema17\"", "name = \"nema17\"\npilot_diameter_mm = 12"));
  const Finding& told = wide.finding("shaft_grip", "sun");
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  EXPECT_NE(told.message.find("no set screw on its flat"), std::string::npos) << told.message;
  EXPECT_NE(told.cure.find("set_screw"), std::string::npos);
  const Made none(replaced(round_shaft(k3k + kMachine), "[fasteners]", "[fasteners]\nset_screw = \"never\""));
  EXPECT_FALSE(machine_layout(none.train)->set_screw.is_there());
  EXPECT_EQ(none.finding("shaft_grip", "sun").status, CheckStatus::kWarn);
}

TEST(ShaftGrip, AFlatHoldsWhatItsWidthAndLengthInTheBoreBear) {
  const Made made(k3k + kMachine);
  const auto m = machine_layout(made.train);
  // a NEMA 17's shaft of 5 mm has a flat of 3 mm: half of it bears 60 MPa at a mean arm of 0.75 mm
  EXPECT_NEAR(held_by_flat_nm(made.train, 10.0), 60.0 * 10.0 * 1.5 * 0.75 / 1000.0, 1e-12);
  EXPECT_EQ(made.finding("shaft_grip", "sun").status, CheckStatus::kPass);
  // it begins 9 mm over the motor's face
  EXPECT_NEAR(flat_in_bore_mm(*m), m->gripped.upper_mm - (m->floor.lower_mm + 9.0), 1e-9);
  const Made strong(
      replaced(k3k + kMachine, "name = \"nema17\"", "name = \"nema17\"\ntorque_nm = 2"));
  const Finding told = strong.finding("shaft_grip", "sun");
  EXPECT_EQ(told.status, CheckStatus::kWarn);
  EXPECT_NE(told.message.find("the motor has 2 N m"), std::string::npos) << told.message;
}

TEST(ShaftGrip, TheShaftsFlatLiesOnThatOfTheBore) {
  for (const std::string& text : {kSimple + kMachine, kPair + kBox}) {
    const Made made(text);
    const auto turn_of = [&](const std::string& name) {
      for (const Placement& placement : made.shapes.assembly)
        if (placement.name.rfind(name, 0) == 0) return placement.rotation_rad;
      return kNaN;
    };
    EXPECT_NEAR(turn_of("motor_nema17"),
                turn_of(made.train.topology().name_of(made.train.topology().input)), 1e-12);
  }
}

TEST(ShaftGrip, AHubOnTheFlatsBeginningAloneIsTold) {
  const std::string carried =
      replaced(k3k, "output = \"ring2\"", "output = \"ring2\"\ninput = \"carrier\"");
  const Made thin(carried + kMachine);
  EXPECT_EQ(thin.finding("shaft_grip", "carrier").status, CheckStatus::kWarn);
  const Made thick(carried + "[carrier]\nplate_thickness_mm = 12\n" + kMachine);
  EXPECT_EQ(thick.finding("shaft_grip", "carrier").status, CheckStatus::kPass)
      << thick.finding("shaft_grip", "carrier").message;
}

}  // namespace
}  // namespace trueflank
