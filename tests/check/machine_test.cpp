// SPDX-License-Identifier: GPL-3.0-or-later
// From gears to a gearbox: parts and findings.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/check/machine_designs.h"
#include "trueflank/check/machine/bearing_life.h"
#include "trueflank/check/machine/check_machine.h"
#include "trueflank/solid/brep/brep.h"
#include "trueflank/solid/measure/assembly_clearance.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/solid/measure/mesh_validity.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

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
    EXPECT_TRUE(f.status == CheckStatus::kPass ||
                (foot_hangs && f.id == "overhang" && f.where == "sun"))
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

INSTANTIATE_TEST_SUITE_P(
    Machine, EveryKind,
    testing::Values(k3k + kMachine, type_two(k3k + kMachine), kSimple + kMachine,
                    split_ring(k3k + kMachine), kStepped + kMachine,
                    held_carrier(kSimple + kMachine), held_carrier(kStepped + kMachine),
                    kPair + kBox, kRingPair + kRingBox,
                    round_shaft(replaced(kRingPair, "teeth = 20", "teeth = 18") + kRingBox),
                    machined(kRingPair + kRingBox), round_shaft(k3k + kMachine),
                    round_shaft(type_two(k3k + kMachine)),
                    round_shaft(held_carrier(kStepped + kMachine)), round_shaft(kPair + kBox),
                    machined(k3k + kMachine), machined(round_shaft(kStepped + kMachine)),
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
    const Point2 at = middle + width_mm * Point2(random() - 0.5, random() - 0.5);
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
  const Bearing bearing{.name = "own",
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

}  // namespace
}  // namespace trueflank
