// SPDX-License-Identifier: GPL-3.0-or-later
// From gears to a gearbox: keys, parts, findings, plates and bill of materials.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "trueflank/check/machine/bearing_life.h"
#include "trueflank/check/machine/check_machine.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/tools_file.h"
#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/measure/assembly_clearance.h"
#include "trueflank/solid/measure/assembly_order.h"
#include "trueflank/solid/measure/bill_of_materials.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/machine/print_plates.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "tests/check/machine_designs.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

/// A sun wider than the circle of the motor's screws, and small planets.
std::string large_sun() {
  return replaced(
      "format = 1\n[gearbox]\nkind = \"simple\"\nplanets = 3\nmodule_mm = 1\nbacklash_mm = 0.15\n"
      "[sun]\nteeth = 48\nface_width_mm = 14\n[planet]\nteeth = 24\nface_width_mm = 14\n"
      "[ring]\nteeth = 96\nface_width_mm = 14\n" +
          kMachine,
      "planet = \"625\"", "planet = \"624\"");
}

std::string type_two(const std::string& text) {
  return replaced(text, "output = \"ring2\"", "output = \"ring1\"");
}
std::string idle_sun(const std::string& text) {
  return replaced(text, "planets = 3", "planets = 3\ninput = \"carrier\"");
}
/// The hub is as long as the flat of the motor's shaft wants it.
std::string split_ring(const std::string& text) {
  return replaced(idle_sun(text), "[sun]\nteeth = 12\nface_width_mm = 10\n", "") +
         "[carrier]\nplate_thickness_mm = 10\npin_hole_clearance_mm = 0.1\n";
}
/// Simple and stepped sets whose ring drives out.
std::string held_carrier(const std::string& text) {
  return replaced(text, "planets = 3", "planets = 3\noutput = \"ring\"");
}

// ------------------------------------------------------------------------------------- keys

TEST(MachineKeys, AreReadAndWrittenBack) {
  const std::string text =
      replaced(k3k + kMachine, "name = \"nema17\"", "name = \"nema17\"\nshaft_length_mm = 20") +
      "bed = \"ender-3\"\n[output]\nspeed_rpm = 5\ntorque_nm = 3\n";
  const GearboxDesign design = design_of(text);
  ASSERT_TRUE(design.machine);
  EXPECT_EQ(design.machine->motor.shaft_length_mm, 20.0);
  EXPECT_EQ(design.machine->motor.pilot_diameter_mm, 22.0);
  EXPECT_EQ(design.machine->bearings.output.outer_mm, 42.0);
  EXPECT_EQ(design.machine->fasteners.carrier.insert_length_mm, 4.0);
  const GearboxDesign again = design_of(design_file_text(design, ""));
  EXPECT_EQ(again, design);
}

TEST(MachineKeys, TheSunGetsTheBoreOfTheMotorsShaft) {
  const GearboxDesign design = design_of(k3k + kMachine);
  EXPECT_EQ(design.gears[0].bore.kind, BoreKind::kDFlat);
  EXPECT_NEAR(design.gears[0].bore.diameter_mm, 5.1, 1e-12);
  EXPECT_NEAR(design.gears[0].bore.d_flat_mm, 4.6, 1e-12);
}

TEST(MachineKeys, WhatDoesNotAgreeIsTold) {
  const std::string whole = k3k + kMachine;
  EXPECT_EQ(first_key(whole), "");
  EXPECT_EQ(first_key(replaced(whole, "[housing]\n", "")), "motor");
  EXPECT_EQ(first_key(replaced(whole, "[motor]\nname = \"nema17\"\n", "")), "motor");
  EXPECT_EQ(first_key(replaced(whole, "nema17", "nema18")), "motor.name");
  EXPECT_EQ(first_key(replaced(whole, "name = \"nema17\"", "shaft_diameter_mm = 5")),
            "motor.shaft_length_mm");
  EXPECT_EQ(first_key(replaced(whole, "nema17\"", "nema17\"\nflat_mm = 2")), "motor.flat_mm");
  EXPECT_EQ(first_key(replaced(whole, "output = \"6806\"\n", "")), "bearings.output");
  EXPECT_EQ(first_key(replaced(whole, "\"625\"", "\"652\"")), "bearings.planet");
  EXPECT_EQ(first_key(replaced(whole, "M3-short", "M3.1")), "fasteners.carrier");
  EXPECT_EQ(first_key(replaced(whole, "teeth = 90", "teeth = 90\nouter_diameter_mm = 99")),
            "ring1.outer_diameter_mm");
  EXPECT_EQ(first_key(whole + "bed = \"10x10\"\n"), "made.bed");
  EXPECT_EQ(first_key("format = 1\n[gearbox]\nkind = \"gear\"\nmodule_mm = 1\n[gear]\nteeth = 20\n"
                      "face_width_mm = 5\n" +
                      kMachine),
            "housing");
}

TEST(MachineKeys, AUsersElementsReplaceAndAdd) {
  const auto tools = read_tools_text(
      "[bearing.6806]\ndynamic_n = 1\n[motor.mine]\nshaft_diameter_mm = 4\n"
      "[screw.M7]\ndiameter_mm = 7\n[bearing.XR20]\nbore_mm = 20\nkind = \"crossed-rollers\"\n",
      "tools.toml");
  ASSERT_TRUE(tools);
  const Bearing* bearing = find_element(tools->elements.bearings, "6806");
  EXPECT_EQ(bearing->dynamic_n, 1.0);
  EXPECT_EQ(bearing->outer_mm, 42.0);
  EXPECT_EQ(find_element(tools->elements.motors, "mine")->shaft_diameter_mm, 4.0);
  EXPECT_NE(find_element(tools->elements.screws, "M7"), nullptr);
  EXPECT_EQ(find_element(tools->elements.bearings, "XR20")->kind, BearingKind::kCrossedRollers);
  EXPECT_EQ(bearing->kind, BearingKind::kBalls);
  EXPECT_FALSE(read_tools_text("[bearing.XR20]\nkind = \"rollers\"\n", "tools.toml"));
  EXPECT_FALSE(read_tools_text("[motor.mine]\nshaft_mm = 4\n", "tools.toml"));
}

TEST(MachineKeys, EveryElementAndToolKeyIsInTheDocumentation) {
  std::ostringstream page;
  page << std::ifstream(std::string(TRUEFLANK_SOURCE_DIR) + "/docs/gearbox.md").rdbuf();
  const std::string text = page.str();
  const auto names = [&](const std::string& name) {
    return text.find("`" + name + "`") != std::string::npos;
  };
  const MachineElements& elements = standard_elements();
  for (const Motor& motor : elements.motors) EXPECT_TRUE(names(motor.name)) << motor.name;
  for (const Bearing& bearing : elements.bearings) EXPECT_TRUE(names(bearing.name)) << bearing.name;
  for (const Screw& screw : elements.screws) EXPECT_TRUE(names(screw.name)) << screw.name;
  for (const Bed& bed : standard_beds()) EXPECT_TRUE(names(bed.name)) << bed.name;
  for (const char* kind : {"bearing", "screw"})
    for (const KeyRule& rule : tool_key_rules(kind))
      EXPECT_NE(text.find(rule.name), std::string::npos) << rule.name;
}

// ------------------------------------------------------------------------------------- parts

TEST(MachineParts, ADesignWithoutHousingHasNone) {
  const auto train = lay_out(design_of(k3k));
  const auto shapes = part_shapes(*train);
  ASSERT_TRUE(shapes);
  std::vector<std::string> names;
  for (const PartShape& part : shapes->parts) names.push_back(part.name);
  EXPECT_EQ(names, (std::vector<std::string>{"sun", "planet", "ring1", "ring2"}));
  EXPECT_TRUE(check_machine(*train, *shapes).empty());
}

class EveryKind : public testing::TestWithParam<std::string> {};

TEST_P(EveryKind, HasNoFindingThatFails) {
  const Made made(GetParam());
  // the foot of a set screw stands out over a hub that is long and narrow between planets (type II)
  const auto layout = machine_layout(made.train);
  const bool foot_hangs = layout->set_screw.is_there() && layout->hub_room_mm < 1e9;
  for (const Finding& f : made.findings)
    EXPECT_TRUE(f.status == CheckStatus::kPass || (foot_hangs && f.id == "overhang" && f.where == "sun"))
        << f.id << " " << f.where << ": " << f.message;
}

TEST_P(EveryKind, HasClosedPartsOfTheVolumeOfTheirSlabs) {
  const Made made(GetParam());
  for (const PartShape& part : made.shapes.parts) {
    const PartMesh mesh = part_mesh(part, {.tolerance_mm = 0.001});
    const MeshValidity validity = mesh_validity(mesh.mesh);
    EXPECT_TRUE(validity.valid()) << part.name;
    EXPECT_EQ(validity.components, 1U) << part.name;
    const double volume = mass_properties(part, 1.0).volume_mm3;
    EXPECT_NEAR(volume_mm3(mesh.mesh), volume, 2e-3 * volume) << part.name;
    const auto solid = brep_of(part);
    EXPECT_TRUE(solid) << part.name << ": " << (solid ? "" : solid.error().message);
  }
}

TEST_P(EveryKind, StandsOnItsLowestFaceAndItsSlabsTouch) {
  const Made made(GetParam());
  for (const PartShape& part : made.shapes.parts) {
    EXPECT_NEAR(part.slabs.front().z_lower_mm, 0.0, 1e-9) << part.name;
    for (std::size_t i = 1; i < part.slabs.size(); ++i)
      EXPECT_EQ(part.slabs[i].z_lower_mm, part.slabs[i - 1].z_upper_mm) << part.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Machine, EveryKind,
                         testing::Values(k3k + kMachine, type_two(k3k + kMachine),
                                         kSimple + kMachine, split_ring(k3k + kMachine),
                                         kStepped + kMachine, held_carrier(kSimple + kMachine),
                                         held_carrier(kStepped + kMachine), kPair + kBox,
                                         kRingPair + kRingBox,
                                         round_shaft(replaced(kRingPair, "teeth = 20", "teeth = 18") + kRingBox),
                                         machined(kRingPair + kRingBox),
                                         round_shaft(k3k + kMachine),
                                         round_shaft(type_two(k3k + kMachine)),
                                         round_shaft(held_carrier(kStepped + kMachine)),
                                         round_shaft(kPair + kBox), machined(k3k + kMachine),
                                         machined(round_shaft(kStepped + kMachine)),
                                         machined(round_shaft(kPair + kBox))));

TEST(MachineParts, TheMotorsShaftEndsFreeInASunThatIdles) {
  const Made made(idle_sun(k3k + kMachine));
  EXPECT_EQ(made.finding("collision", "train").status, CheckStatus::kPass);
  EXPECT_EQ(made.finding("assembly_order", "train").status, CheckStatus::kPass);
  // 5 mm of shaft and 0.5 mm round it leave 0.4 mm under the roots of 12 teeth: that is told
  const Finding& wall = made.finding("wall", "sun");
  EXPECT_EQ(wall.status, CheckStatus::kWarn);
  EXPECT_NE(wall.cure.find("no [sun]"), std::string::npos) << wall.cure;
  // a bore that is wide enough stays
  const Made wide(replaced(idle_sun(k3k + kMachine), "teeth = 12", "teeth = 12\nbore_mm = 6.4"));
  EXPECT_EQ(wide.finding("collision", "train").status, CheckStatus::kPass);
  EXPECT_EQ(wide.part("sun").slabs.front().holes.size(), 1U);
  // a D that is narrower gives way as far as the shaft goes
  const Made flat(replaced(idle_sun(k3k + kMachine), "teeth = 12",
                           "teeth = 12\nbore_mm = 6.2\nbore_d_flat_mm = 5"));
  EXPECT_EQ(flat.finding("collision", "train").status, CheckStatus::kPass);
  EXPECT_TRUE(mesh_validity(part_mesh(flat.part("sun")).mesh).valid());
}

TEST(MachineParts, AHeldCarrierStandsBetweenHousingAndLid) {
  const Made made(held_carrier(kSimple + kMachine));
  const auto layout = machine_layout(made.train);
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->fixed_gear, -1);
  const Slab& plate = made.part("carrier").slabs.front();
  EXPECT_NEAR(extent(plate.outer).outer_radius_mm, layout->ring_radius_mm, 1e-9);
  EXPECT_GT(layout->ring_radius_mm, layout->cup_radius_mm + layout->clearance_mm);
  // the housing's screws go through it
  const auto through =
      std::count_if(plate.holes.begin(), plate.holes.end(), [&](const Outline& hole) {
        return std::abs(extent(hole).centre.norm() - layout->housing_screws.at.front().norm()) <
               1e-9;
      });
  EXPECT_EQ(through, 6);
  EXPECT_EQ(made.finding("screws", "housing").status, CheckStatus::kPass);
}

TEST(MachineParts, PillarsStandClearOfALargeSun) {
  for (const std::string& text : {large_sun(), held_carrier(large_sun())}) {
    const Made made(text);
    const Finding& collision = made.finding("collision", "train");
    EXPECT_EQ(collision.status, CheckStatus::kPass) << collision.message;
  }
}

TEST(MachineParts, CompoundPlanetsHaveAMarkOutsideTheirBearings) {
  const auto marks = [](const PartShape& planet) {
    const auto& holes = planet.slabs.back().holes;
    return std::count_if(holes.begin(), holes.end(),
                         [](const Outline& hole) { return extent(hole).centre.norm() > 1e-6; });
  };
  const Made compound(k3k + kMachine), single(kSimple + kMachine);
  EXPECT_EQ(marks(compound.part("planet")), 1);
  EXPECT_EQ(marks(single.part("planet")), 0);
  EXPECT_EQ(compound.finding("wall", "planet").status, CheckStatus::kPass);
  EXPECT_TRUE(mesh_validity(part_mesh(compound.part("planet")).mesh).valid());
}

TEST(MachineParts, TheScrewsOfTheHousingAreHeldByTheirInserts) {
  const Made made(k3k + kMachine);
  const auto layout = machine_layout(made.train);
  for (const ScrewGroup* group : {&layout->housing_screws, &layout->carrier_screws,
                                  &layout->output_screws, &layout->retainer_screws}) {
    const double held = group->way * (group->tip_mm() - group->insert_mm);
    EXPECT_GE(held, group->screw.diameter_mm - 1e-9) << group->what;
    EXPECT_GE(group->way * (group->far_mm - group->tip_mm()), -1e-9) << group->what;
  }
  // into the motor's threads
  const double deep = layout->floor.lower_mm - layout->motor_screws.tip_mm();
  EXPECT_GE(deep, 3.0);
  EXPECT_LE(deep, 4.5);
}

// ------------------------------------------------------------------------------------- findings

TEST(MachineChecks, AShaftThatIsTooShortIsToldWithItsCure) {
  const std::string text =
      replaced(k3k + kMachine, "\"nema17\"", "\"nema17\"\nshaft_length_mm = 6");
  const Made made(text);
  const Finding& f = made.finding("shaft_grip", "sun");
  EXPECT_EQ(f.status, CheckStatus::kFail);
  const double missing = f.limit - f.value;
  const std::string longer = std::to_string(6.0 + missing + 0.001);
  const Made cured(replaced(text, "shaft_length_mm = 6", "shaft_length_mm = " + longer));
  EXPECT_EQ(cured.finding("shaft_grip", "sun").status, CheckStatus::kPass);
}

TEST(MachineChecks, AHousingThatIsTooSmallFails) {
  const Made made(replaced(k3k + kMachine, "[housing]\n", "[housing]\nouter_diameter_mm = 84\n"));
  EXPECT_EQ(made.finding("housing_size", "housing").status, CheckStatus::kFail);
  const Made large(replaced(k3k + kMachine, "[housing]\n", "[housing]\nouter_diameter_mm = 95\n"));
  EXPECT_EQ(large.finding("housing_size", "housing").status, CheckStatus::kPass);
  EXPECT_NEAR(extent(large.part("lid").slabs.back().outer).outer_radius_mm, 47.5, 1e-9);
}

TEST(MachineChecks, ScrewsThatNobodySellsAreTold) {
  const Made made(replaced(k3k + kMachine, "\"6806\"", "\"6806\"\noutputs = 4"));
  EXPECT_EQ(made.finding("screws", "output").status, CheckStatus::kPass);
  const Made thin(replaced(replaced(k3k + kMachine, "\"6806\"", "\"6806\"\noutputs = 4"),
                           "carrier =", "output = \"M2\"\ncarrier ="));
  EXPECT_EQ(thin.finding("screws", "output").status, CheckStatus::kFail);
}

TEST(MachineChecks, AMotorTooLargeForTheGearsRunsItsHeadsIntoTheWall) {
  const Made made(
      replaced(k3k + kMachine, "\"nema17\"", "\"nema17\"\nbolt_circle_diameter_mm = 76"));
  EXPECT_EQ(made.finding("screw_access", "motor").status, CheckStatus::kFail);
}

TEST(MachineChecks, ABearingTooLargeForThePlanetIsAWallThatIsMissing) {
  const Made made(replaced(k3k + kMachine, "\"625\"", "\"6803\""));
  EXPECT_EQ(made.finding("wall", "planet").status, CheckStatus::kFail);
}

TEST(MachineChecks, ABearingWiderThanThePlanetIsTold) {
  const Made made(replaced(kSimple + kMachine, "\"625\"", "\"626\""));
  EXPECT_EQ(made.finding("bearing_seat", "planet").status, CheckStatus::kFail);
}

TEST(MachineChecks, ACarrierThatReachesIntoTheRingCollides) {
  const Made made(k3k + kMachine +
                  "[carrier]\nplate_thickness_mm = 7\npin_hole_clearance_mm = 0.1\n"
                  "axial_clearance_mm = 0.3\nouter_diameter_mm = 64\n");
  EXPECT_NE(made.finding("collision", "train").status, CheckStatus::kFail);
  PartShapes moved = made.shapes;
  for (Placement& body : moved.assembly)
    if (body.name == "carrier_top") body.translation_mm[2] += 1.0;  // into the cup's floor
  EXPECT_FALSE(assembly_clearance(made.train, moved).collisions.empty());
}

/// Points inside the material of two bodies at once, at random, with the carrier and the output
/// turned: another way to the same answer.
void expect_no_point_in_two_bodies(const Made& made, const Point2& middle, double width_mm) {
  struct Body {
    const Placement* placement;
    const PartShape* part;
  };
  std::vector<Body> bodies;
  for (const Placement& p : made.shapes.assembly)
    bodies.push_back({&p, &made.shapes.parts[static_cast<std::size_t>(p.part)]});
  const auto in_material = [](const Body& body, const Point2& at, double z) {
    const Point2 p =
        rotated(at - Point2(body.placement->translation_mm[0], body.placement->translation_mm[1]),
                -body.placement->rotation_rad);
    const double height = z - body.placement->translation_mm[2];
    for (const Slab& slab : body.part->slabs) {
      if (height <= slab.z_lower_mm || height >= slab.z_upper_mm) continue;
      const auto inside = [&](const Outline& outline, bool outer) {
        const OutlineExtent e = extent(outline);
        // teeth: what surely is material
        const double radius = outer ? e.inner_radius_mm : e.outer_radius_mm;
        return (p - e.centre).norm() < radius - (outer ? 1e-6 : -1e-6);
      };
      if (!inside(slab.outer, true)) return false;
      return std::none_of(slab.holes.begin(), slab.holes.end(),
                          [&](const Outline& hole) { return inside(hole, false); });
    }
    return false;
  };
  unsigned state = 12345;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 16777216.0;
  };
  int hits = 0;
  for (int i = 0; i < 200000; ++i) {
    const Point2 at =
        middle + width_mm * Point2(random() - 0.5, random() - 0.5);
    const double z = -20.0 + 80.0 * random();
    std::vector<std::string> here;
    for (const Body& body : bodies)
      if (in_material(body, at, z)) here.push_back(body.placement->name);
    hits += !here.empty();
    EXPECT_LE(here.size(), 1U) << here.front() << " and " << here.back();
  }
  EXPECT_GT(hits, 50000);
}

TEST(MachineChecks, NoPointIsInTwoBodies) {
  expect_no_point_in_two_bodies(Made(k3k + kMachine), Point2::Zero(), 90.0);
  expect_no_point_in_two_bodies(Made(kPair + kBox), Point2(22.0, 0.0), 112.0);
  expect_no_point_in_two_bodies(Made(kRingPair + kRingBox), Point2(-20.0, 0.0), 100.0);
}

/// SKF's rolling bearings catalogue, the example of bearing 6309: C = 55.3 kN, 8 kN, 3000 rpm: 330
/// million turns, 1 830 h.
TEST(BearingLife, IsThatOfTheCataloguesExample) {
  const Bearing bearing{.name = "6309", .dynamic_n = 55300, .static_n = 31500};
  const BearingLife life = bearing_life(bearing, {.radial_n = 8000, .speed_rpm = 3000});
  EXPECT_NEAR(life.life_h, 1830.0, 10.0);
  EXPECT_NEAR(life.static_safety, 31500.0 / 8000.0, 1e-12);
}

TEST(BearingLife, AnAxialLoadCountsBeyondItsLimit) {
  const Bearing bearing{.name = "x", .dynamic_n = 10000, .static_n = 10000};
  // Fa / C0 = 0.056: e = 0.26, Y = 1.71
  EXPECT_NEAR(
      bearing_life(bearing, {.radial_n = 3000, .axial_n = 560, .speed_rpm = 1}).equivalent_n, 3000,
      1e-9);
  EXPECT_NEAR(
      bearing_life(bearing, {.radial_n = 1000, .axial_n = 560, .speed_rpm = 1}).equivalent_n,
      0.56 * 1000 + 1.71 * 560, 1e-9);
}

TEST(BearingLife, OneCrossedRollerBearingHoldsATiltingMoment) {
  const Bearing bearing{
      .name = "own",
      .bore_mm = 40,
      .outer_mm = 60,
      .dynamic_n = 10000,
      .static_n = 10000,
      .kind = BearingKind::kCrossedRollers};
  // d_pw = 50 mm: 1000 Nmm count as 40 N across
  const BearingLife across =
      bearing_life(bearing, {.radial_n = 100, .axial_n = 210, .tilting_nmm = 1000, .speed_rpm = 1});
  EXPECT_NEAR(across.equivalent_n, 140 + 0.45 * 210, 1e-9);
  EXPECT_NEAR(across.static_equivalent_n, 140 + 0.44 * 210, 1e-9);
  EXPECT_NEAR(across.life_h, 1e6 / 60 * std::pow(10000 / across.equivalent_n, 10.0 / 3.0), 1.0);
  const BearingLife along =
      bearing_life(bearing, {.radial_n = 100, .axial_n = 211, .tilting_nmm = 1000, .speed_rpm = 1});
  EXPECT_NEAR(along.equivalent_n, 0.67 * (140 + 211), 1e-9);
}

TEST(MachineChecks, ACrossedRollerBearingSitsInTheLidAndHoldsTheLoadAlone) {
  const std::string load = "[output]\nradial_load_n = 40\nspeed_rpm = 6\n";
  const Made balls(k3k + kMachine + load);
  EXPECT_EQ(balls.finding("bearing_load", "output").status, CheckStatus::kWarn);
  EXPECT_NE(balls.finding("bearing_load", "output").cure.find("crossed"), std::string::npos);
  const Made rollers(replaced(k3k + kMachine + load, "\"6806\"", "\"RB3010\""));
  for (const Finding& f : rollers.findings)
    EXPECT_EQ(f.status, CheckStatus::kPass) << f.id << " " << f.where << ": " << f.message;
  EXPECT_EQ(rollers.part("bearing_rb3010").bought, "crossed-roller bearing RB3010 (30x55x10)");
}

TEST(MachineChecks, TheForceOnAPlanetsPinIsThatOfItsMeshes) {
  // simple, ring held: both meshes push alike; the pin carries the carrier's torque over its radius
  const Made made(kSimple + kMachine + "[output]\ntorque_nm = 6\n");
  const MachineLoads loads = machine_loads(made.train);
  EXPECT_EQ(loads.output_torque_nm, 6.0);
  const double tangential = 6000.0 / 3.0 / made.train.centre_distance_mm;
  EXPECT_NEAR(loads.pin_force_n, tangential, 1e-6 * tangential);
}

TEST(MachineChecks, ALoadThatCrushesTheBearingFails) {
  const Made made(k3k + kMachine + "[output]\nradial_load_n = 20000\n");
  EXPECT_EQ(made.finding("bearing_load", "output").status, CheckStatus::kFail);
}

// ------------------------------------------------------------------------------------- bill,
// plates

TEST(BillOfMaterials, CountsEveryBodyOnce) {
  const Made made(k3k + kMachine);
  const BillOfMaterials bill = bill_of_materials(made.shapes, [](const PartShape&) {
    return PartMaterial{"pla", 1000.0};
  });
  int count = 0;
  double mass_g = 0.0;
  for (const BillLine& line : bill) {
    count += line.count;
    if (!std::isnan(line.mass_g)) mass_g += line.mass_g * line.count;
  }
  EXPECT_EQ(count, static_cast<int>(made.shapes.assembly.size()));
  double volume = 0.0;
  for (const Placement& body : made.shapes.assembly)
    if (const PartShape& part = made.shapes.parts[static_cast<std::size_t>(body.part)];
        part.bought.empty())
      volume += mass_properties(part, 1.0).volume_mm3;
  EXPECT_NEAR(mass_g, 1e-3 * volume, 1e-6 * volume);
  const std::string csv = bill_csv(bill);
  EXPECT_NE(csv.find(",\"ISO 4762 M3x30\",3,,,\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",\"ball bearing 625 (5x16x5)\",6,,,\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nplanet,,3,pla,"), std::string::npos) << csv;
}

TEST(PrintPlates, HoldEveryPartThatIsMadeWithoutOverlap) {
  const Made made(k3k + kMachine);
  for (const Bed& bed : standard_beds()) {
    const auto plates = print_plates(made.shapes, bed);
    ASSERT_TRUE(plates) << bed.name;
    std::size_t count = 0;
    for (const PrintPlate& plate : *plates) {
      count += plate.size();
      const auto reach = [&](const PrintedPart& p) {
        double r = 0.0;
        for (const Slab& slab : made.shapes.parts[static_cast<std::size_t>(p.part)].slabs)
          r = std::max(r, extent(slab.outer).outer_radius_mm);
        return r;
      };
      for (std::size_t i = 0; i < plate.size(); ++i) {
        const double r = reach(plate[i]);
        EXPECT_GE(plate[i].at_mm.x() - r, -1e-9);
        EXPECT_LE(plate[i].at_mm.x() + r, bed.width_mm + 1e-9);
        EXPECT_GE(plate[i].at_mm.y() - r, -1e-9);
        EXPECT_LE(plate[i].at_mm.y() + r, bed.depth_mm + 1e-9);
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_GE((plate[i].at_mm - plate[j].at_mm).norm(), r + reach(plate[j]) + 4.999);
      }
    }
    const auto is_made = [&](const Placement& p) {
      return made.shapes.parts[static_cast<std::size_t>(p.part)].bought.empty();
    };
    EXPECT_EQ(count, static_cast<std::size_t>(std::count_if(made.shapes.assembly.begin(),
                                                            made.shapes.assembly.end(), is_made)));
  }
  const auto small = print_plates(made.shapes, *find_bed("60x60"));
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().key, "made.bed");
}

/// What hangs over at the bed's side: a part the right way up widens nowhere by more than a ledge.
TEST(PrintPlates, PartsLieTheRightWayUp) {
  for (const std::string& text :
       {k3k + kMachine, large_sun(), held_carrier(large_sun()), kPair + kBox, kRingPair + kRingBox}) {
    const Made made(text);
    for (const PartShape& part : made.shapes.parts) {
      if (!part.bought.empty()) continue;
      std::vector<Slab> slabs = part.slabs;
      if (part.upside_down) std::reverse(slabs.begin(), slabs.end());
      for (std::size_t i = 1; i < slabs.size(); ++i) {
        const double widened =
            extent(slabs[i].outer).inner_radius_mm - extent(slabs[i - 1].outer).outer_radius_mm;
        EXPECT_LE(widened, 0.5) << part.name << " slab " << i;
      }
    }
  }
}

// ------------------------------------------------------------------------------------- order

/// Whether body a, moved along the axis by any of many steps, runs into b: circles of the slabs.
bool meets_on_its_way(const PartShapes& shapes, std::size_t a, std::size_t b, double way) {
  const auto discs_clear = [](const OutlineExtent& one, const Point2& at,
                              const OutlineExtent& other, const Point2& there,
                              const std::vector<std::pair<Point2, double>>& holes) {
    if ((at - there).norm() > one.outer_radius_mm + other.outer_radius_mm - 1e-4) return true;
    return std::any_of(holes.begin(), holes.end(), [&](const auto& hole) {
      return (at - hole.first).norm() + one.outer_radius_mm < hole.second + 1e-4;
    });
  };
  const auto part = [&](std::size_t body) -> const PartShape& {
    return shapes.parts[static_cast<std::size_t>(shapes.assembly[body].part)];
  };
  const auto place = [&](std::size_t body, const Point2& p) {
    const Placement& where = shapes.assembly[body];
    return Point2(rotated(p, where.rotation_rad) +
                  Point2(where.translation_mm[0], where.translation_mm[1]));
  };
  const auto holes_of = [&](std::size_t body, const Slab& slab) {
    std::vector<std::pair<Point2, double>> holes;
    for (const Outline& hole : slab.holes) {
      const auto* bore = std::get_if<BoreOutline>(&hole);  // a shaft's flat finds the bore's
      holes.emplace_back(place(body, extent(hole).centre),
                         bore ? 0.5 * bore->bore.diameter_mm : extent(hole).inner_radius_mm);
    }
    return holes;
  };
  const auto toothed = [](const Slab& slab) {
    return std::holds_alternative<ToothedOutline>(slab.outer) ||
           (!slab.holes.empty() && std::holds_alternative<ToothedOutline>(slab.holes.front()));
  };
  for (double step = 0.0; step < 200.0; step += 0.5)
    for (const Slab& s : part(a).slabs)
      for (const Slab& t : part(b).slabs) {
        const double z = shapes.assembly[a].translation_mm[2] + way * step,
                     w = shapes.assembly[b].translation_mm[2];
        if (z + s.z_upper_mm < w + t.z_lower_mm + 1e-3 ||
            w + t.z_upper_mm < z + s.z_lower_mm + 1e-3)
          continue;
        if (toothed(s) && toothed(t)) continue;  // gears in mesh slide along each other
        const OutlineExtent one = extent(s.outer), other = extent(t.outer);
        const Point2 at = place(a, one.centre), there = place(b, other.centre);
        if (!discs_clear(one, at, other, there, holes_of(b, t)) &&
            !discs_clear(other, there, one, at, holes_of(a, s)))
          return true;
      }
  return false;
}

/// Every body once, every step free, by moving the bodies in small steps.
void expect_proved(const Made& made, const char* name) {
  const AssemblyOrder order = assembly_order(made.train, made.shapes);
  ASSERT_TRUE(order.exists()) << name;
  ASSERT_FALSE(order.units.empty());
  for (const AssemblyUnit& unit : order.units) {
    std::vector<std::size_t> there;
    for (const AssemblyStep& step : unit.steps) {
      for (const std::size_t body : step.bodies)
        for (const std::size_t other : there)
          EXPECT_FALSE(meets_on_its_way(made.shapes, body, other, step.from))
              << name << ", " << unit.name << ": " << made.shapes.assembly[body].name << " meets "
              << made.shapes.assembly[other].name;
      there.insert(there.end(), step.bodies.begin(), step.bodies.end());
      if (step.unit >= 0) {
        std::size_t count = 0;
        for (const AssemblyStep& s : order.units[static_cast<std::size_t>(step.unit)].steps)
          count += s.bodies.size();
        EXPECT_EQ(count, step.bodies.size());
      }
    }
    if (&unit == &order.units.back()) {
      std::sort(there.begin(), there.end());
      EXPECT_EQ(std::unique(there.begin(), there.end()), there.end()) << name;
      EXPECT_EQ(there.size(), made.shapes.assembly.size()) << name;
    }
  }
}

TEST(AssemblyOrder, EveryKindGoesTogetherBodyByBody) {
  expect_proved(Made(k3k + kMachine), "type I");
  expect_proved(Made(type_two(k3k) + kMachine), "type II");
  expect_proved(Made(split_ring(k3k) + kMachine), "split ring");
  expect_proved(Made(kSimple + kMachine), "simple");
  expect_proved(Made(kStepped + kMachine), "stepped");
  expect_proved(Made(held_carrier(kSimple) + kMachine), "simple, held carrier");
  expect_proved(Made(held_carrier(kStepped) + kMachine), "stepped, held carrier");
  expect_proved(Made(kPair + kBox), "pair");
  expect_proved(Made(kRingPair + kRingBox), "pair with a ring");
  expect_proved(Made(round_shaft(k3k + kMachine)), "type I, round shaft");
  expect_proved(Made(round_shaft(kPair + kBox)), "pair, round shaft");
}

TEST(AssemblyOrder, UnitsAreMadeByThemselves) {
  const Made made(k3k + kMachine);
  const AssemblyOrder order = assembly_order(made.train, made.shapes);
  std::vector<std::string> names;
  for (const AssemblyUnit& unit : order.units) names.push_back(unit.name);
  for (const char* name : {"housing", "lid", "planet", "carrier", "gearbox"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  EXPECT_EQ(names.back(), "gearbox");
  EXPECT_EQ(made.finding("assembly_order", "train").status, CheckStatus::kPass);
}

TEST(AssemblyOrder, HerringboneTeethHoldEachOtherUnlessRingsAreInHalves) {
  const std::string herringbone = replaced(
      kSimple, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 20\nherringbone = true");
  const Made whole(replaced(herringbone, "[ring]", "[ring]\nhalves = false") + kMachine);
  const Finding& finding = whole.finding("assembly_order", "train");
  EXPECT_EQ(finding.status, CheckStatus::kFail);
  EXPECT_GE(finding.value, 4.0);  // the ring and three planets
  EXPECT_NE(finding.cure.find("halves"), std::string::npos);
  const Made halves(herringbone + kMachine);
  EXPECT_EQ(halves.finding("assembly_order", "train").status, CheckStatus::kPass)
      << halves.finding("assembly_order", "train").message;
  // sun and planets first, from the side; then one half of the ring from either side
  const AssemblyOrder order = assembly_order(halves.train, halves.shapes);
  const auto core = std::find_if(order.units.begin(), order.units.end(), [](const AssemblyUnit& unit) {
    return unit.name == "sun_and_planets";
  });
  ASSERT_NE(core, order.units.end());
  ASSERT_EQ(core->steps.size(), 4U);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(core->steps[i].from, 0.0);
  std::map<std::string, int> times;
  int now = 0;
  for (const AssemblyStep& step : order.units.back().steps) {
    ++now;
    for (const std::size_t body : step.bodies) times[halves.shapes.assembly[body].name] = now;
  }
  EXPECT_LT(times["ring_lower"], times["sun"]);
  EXPECT_LT(times["sun"], times["ring_upper"]);
  // what runs into each other as it stands is told as what it is
  const Made pierced(replaced(k3k + kMachine, "nema17\"", "nema17\"\nshaft_length_mm = 60"));
  EXPECT_EQ(pierced.finding("collision", "train").status, CheckStatus::kFail);
  EXPECT_NE(pierced.finding("assembly_order", "train").cure.find("collision"), std::string::npos);
  const Made helical(replaced(kSimple, "module_mm = 1", "module_mm = 1\nhelix_angle_deg = 20") +
                     kMachine);
  EXPECT_EQ(helical.finding("assembly_order", "train").status, CheckStatus::kPass);
}

TEST(AssemblyOrder, APlateThatNoRingPassesIsTold) {
  const Made made(k3k + kMachine + "[carrier]\nplate_thickness_mm = 8\nouter_diameter_mm = 74\n");
  const Finding& finding = made.finding("assembly_order", "train");
  EXPECT_EQ(finding.status, CheckStatus::kFail);
  EXPECT_NE(finding.cure.find("outer_diameter_mm"), std::string::npos);
}

}  // namespace
}  // namespace trueflank
