// SPDX-License-Identifier: GPL-3.0-or-later
// What holds the gear on the motor's shaft, and the fits of seats. That such gearboxes are closed, free
// of collisions and go together: machine_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "tests/check/machine_designs.h"
#include "trueflank/export/part_dimensions.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/solid/measure/bill_of_materials.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/train/machine/fit_class.h"
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

TEST(Fits, SeatsAndJournalsAreMadeToTheMiddleOfTheirClass) {
  const Made made(machined(k3k + kMachine));
  // 6806: 42 H7 is 0 to +25 um, 30 g6 is -7 to -20 um; 625: 16 H7 is 0 to +18 um
  const auto radius_in = [&](const std::string& part, double near_mm, bool hole) {
    for (const Slab& slab : made.part(part).slabs) {
      std::vector<Outline> outlines = slab.holes;
      if (!hole) outlines = {slab.outer};
      for (const Outline& outline : outlines)
        if (const auto* circle = std::get_if<CircleOutline>(&outline);
            circle && std::abs(2.0 * circle->radius_mm - near_mm) < 0.05)
          return 2.0 * circle->radius_mm;
    }
    return kNaN;
  };
  EXPECT_NEAR(radius_in("lid", 42.0, true), 42.0125, 1e-9);
  EXPECT_NEAR(radius_in("journal", 30.0, false), 29.9865, 1e-9);
  EXPECT_NEAR(radius_in("planet", 16.0, true), 16.009, 1e-9);
  const Finding& told = made.finding("fits", "output");
  EXPECT_EQ(told.status, CheckStatus::kPass);
  EXPECT_NE(told.message.find("42 H7 (+0 to +25 um), clearance +0 to +36 um"), std::string::npos)
      << told.message;
  EXPECT_NE(told.message.find("30 g6 (-20 to -7 um), clearance -3 to +20 um"), std::string::npos)
      << told.message;
}

TEST(Fits, OfDrawingsAreNominalSizesWithTheirClass) {
  const Made made(machined(k3k + kMachine));
  const io::PartDimensions lid = io::part_dimensions(made.train, made.part("lid"));
  const auto fitted = [](const io::PartDimensions& dimensions, double size_mm) {
    for (const io::PartDiameter& d : dimensions.diameters)
      if (d.diameter_mm == size_mm) return d.limits.fit;
    return std::string("none");
  };
  EXPECT_EQ(fitted(lid, 42.0), "H7");
  EXPECT_EQ(fitted(io::part_dimensions(made.train, made.part("journal")), 30.0), "g6");
  const Made printed(k3k + kMachine);
  EXPECT_EQ(fitted(io::part_dimensions(printed.train, printed.part("lid")), 42.1), "");
}

TEST(Fits, ThatAPrinterDoesNotHoldAreTold) {
  const Made made(replaced(k3k + kMachine, "[housing]", "[housing]\nfit_mm = 0"));
  EXPECT_EQ(made.finding("fits", "output").status, CheckStatus::kWarn);
  const Made usual(k3k + kMachine);
  EXPECT_THROW((void)usual.finding("fits", "output"), std::runtime_error);
}

}  // namespace
}  // namespace trueflank
