// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/stages.h"

#include <gtest/gtest.h>

#include "tests/support/train_members.h"
#include "tests/support/two_stage_designs.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/inertia.h"
#include "trueflank/train/strength.h"

namespace trueflank {
namespace {

using test::StageTeeth;

constexpr StageTeeth kFirst{.sun = 18, .planet = 36, .planets = 3, .module_mm = 0.8, .face_width_mm = 8.0};
constexpr StageTeeth kSecond{.sun = 20, .planet = 26, .planets = 4, .module_mm = 1.0, .face_width_mm = 14.0};

GearTrain laid(const GearboxDesign& design) {
  auto train = lay_out(design);
  EXPECT_TRUE(train) << (train ? "" : train.error().front().message);
  return std::move(*train);
}

/// Willis' rule of one simple stage with its ring held, by hand.
struct ByHand {
  explicit ByHand(const StageTeeth& stage)
      : carrier(static_cast<double>(stage.sun) / (stage.sun + stage.ring())),
        planet(carrier * (1.0 - static_cast<double>(stage.ring()) / stage.planet)) {}
  double carrier, planet;  // per speed of the sun
};

TEST(Stages, SpeedsAreThoseOfWillisByHand) {
  test::RandomStages stages(7);
  for (int i = 0; i < 200; ++i) {
    const StageTeeth first = stages.next(), second = stages.next();
    const GearboxDesign design = test::two_stage_design(first, second);
    const MemberSpeeds speeds = member_speeds(design.topology, signed_teeth(design));
    const ByHand one(first), two(second);
    const auto of = [&](const char* name) {
      return speeds.of[static_cast<std::size_t>(design.topology.find_member(name))];
    };
    EXPECT_EQ(of("sun1"), 1.0);
    EXPECT_EQ(of("ring1"), 0.0);
    EXPECT_EQ(of("ring2"), 0.0);
    EXPECT_NEAR(of("carrier1"), one.carrier, 1e-15);
    EXPECT_NEAR(of("planet1"), one.planet, 1e-14);
    EXPECT_NEAR(of("planet2"), one.carrier * two.planet, 1e-14);
    EXPECT_NEAR(of("carrier2"), one.carrier * two.carrier, 1e-15);
    EXPECT_NEAR(1.0 / speeds.output, (1.0 + static_cast<double>(first.ring()) / first.sun) *
                                         (1.0 + static_cast<double>(second.ring()) / second.sun), 1e-11);
  }
}

TEST(Stages, EfficiencyIsTheProductOfTheirsBothWays) {
  test::RandomStages stages(8);
  for (int i = 0; i < 12; ++i) {
    const StageTeeth first = stages.next(), second = stages.next();
    const auto train = lay_out(test::two_stage_design(first, second));
    ASSERT_TRUE(train);
    const EfficiencyResult whole = efficiency(*train);
    double forward = 1.0, backward = 1.0;
    for (std::size_t s = 0; s < 2; ++s) {
      const StageTeeth& stage = s == 0 ? first : second;
      const double i0 = static_cast<double>(stage.ring()) / stage.sun;
      const MeshEfficiency &sun = whole.meshes[2 * s], &ring = whole.meshes[2 * s + 1];
      // with the carrier held the power goes sun - planet - ring; turned, the carrier takes both torques
      forward *= (1.0 + i0 * sun.by_path_integral * ring.by_path_integral) / (1.0 + i0);
      backward *= (1.0 + i0) / (1.0 + i0 / (sun.by_path_integral_gear2_driving * ring.by_path_integral_gear2_driving));
    }
    EXPECT_NEAR(whole.forward, forward, 1e-12);
    EXPECT_NEAR(whole.backward, backward, 1e-12);
    EXPECT_GT(whole.forward, 0.9);
  }
}

TEST(Stages, EachIsTheSimpleTrainThatItWouldBeAlone) {
  const GearTrain whole = laid(test::two_stage_design(kFirst, kSecond));
  ASSERT_EQ(whole.stages.size(), 2U);
  for (std::size_t s = 0; s < 2; ++s) {
    const GearTrain alone = laid(test::simple_design(s == 0 ? kFirst : kSecond));
    EXPECT_EQ(whole.stages[s].centre_distance_mm, alone.centre_distance_mm);
    EXPECT_EQ(whole.stages[s].speeds.output, alone.speeds.output);
    EXPECT_EQ(whole.stages[s].phases.position_rad, alone.phases.position_rad);
    for (std::size_t g = 0; g < 3; ++g) {
      EXPECT_EQ(whole.gears[3 * s + g].profile.tip_radius_mm(), alone.gears[g].profile.tip_radius_mm());
      EXPECT_EQ(whole.gears[3 * s + g].profile.gear().thinning_mm, alone.gears[g].profile.gear().thinning_mm);
    }
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_EQ(whole.meshes[2 * s + k].backlash_mm, alone.meshes[k].backlash_mm);
  }
  EXPECT_TRUE(std::isnan(whole.centre_distance_mm));
}

/// How far gear 2 of a mesh is turned away from a gap facing a tooth, in teeth.
double out_of_mesh(const GearTrain& train, const AssemblyPhases& phases, const TrainMesh& mesh, std::size_t place) {
  const Topology& topology = train.topology();
  const int member1 = topology.gears[static_cast<std::size_t>(mesh.gear1)].member;
  const int member2 = topology.gears[static_cast<std::size_t>(mesh.gear2)].member;
  const double direction = phases.positions_rad(topology.is_planet(member1) ? member1 : member2)[place];
  const auto teeth_passed = [&](int gear, int member, double from) {
    const double turned = phases.rotation_rad(member, place) + phases.offset_rad(gear, place);
    return train.gear(gear).profile.gear().teeth * (turned - from) / kTwoPi;
  };
  const bool internal = train.pair(mesh).internal();
  const double one = teeth_passed(mesh.gear1, member1, direction);
  const double two = teeth_passed(mesh.gear2, member2, internal ? direction : direction + kPi);
  return centred_rad((internal ? one - two : one + two) * kTwoPi - kPi) / kTwoPi;
}

TEST(Stages, EveryPlanetOfBothKeepsItsMeshesAsTheTrainTurns) {
  test::RandomStages stages(9);
  for (int i = 0; i < 20; ++i) {
    const auto train = lay_out(stages.design());
    ASSERT_TRUE(train);
    EXPECT_TRUE(train->assembly.equal_spacing);
    for (const double turn : {0.0, 0.7, 40.0}) {
      const AssemblyPhases phases = turned(*train, turn);
      for (const TrainMesh& mesh : train->meshes)
        for (int place = 0; place < train->copies_of(train->topology().gears[mesh.gear1 % 3 == 0 ? mesh.gear2 : mesh.gear1].member); ++place)
          EXPECT_NEAR(out_of_mesh(*train, phases, mesh, static_cast<std::size_t>(place)), 0.0, 1e-9)
              << mesh.name << " of planet " << place + 1;
    }
  }
}

TEST(Stages, TheSecondStandsAboveTheFirstWithThePlatesOfItsCarrier) {
  GearboxDesign design = test::two_stage_design(kFirst, kSecond);
  design.layer_gap_mm = 1.5;
  const GearTrain bare = laid(design);
  EXPECT_EQ(bare.find("ring2")->z_lower_mm, 8.0 + 1.5);
  design.carrier = CarrierDesign{.plate_thickness_mm = 4.0, .axial_clearance_mm = 0.3};
  const GearTrain carried = laid(design);
  // planets of stage 1, clearance, plate, gap, plate, clearance
  EXPECT_NEAR(carried.find("sun2")->z_lower_mm, 8.0 + 0.3 + 4.0 + 1.5 + 4.0 + 0.3, 1e-12);
  EXPECT_NEAR(heights_of(carried).upper_mm - heights_of(carried).lower_mm, 4 * 4.3 + 8.0 + 14.0 + 1.5, 1e-12);
}

TEST(Stages, TorqueThatASecondStageCarriesIsThatOfItAlone) {
  const auto limits = [](const GearTrain& train) { return *strength(train, {}); };
  const StrengthResult whole = limits(laid(test::two_stage_design(kFirst, kSecond)));
  const GearTrain second = laid(test::simple_design(kSecond));
  const StrengthResult alone2 = limits(second), alone1 = limits(laid(test::simple_design(kFirst)));
  const double passed_on = efficiency(second).forward / second.speeds.output;  // torque out per torque in
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(whole.meshes[2 + k].bending_output_nm, alone2.meshes[k].bending_output_nm, 1e-9);
    EXPECT_NEAR(whole.meshes[2 + k].contact_output_nm, alone2.meshes[k].contact_output_nm, 1e-9);
    EXPECT_NEAR(whole.meshes[k].contact_output_nm, alone1.meshes[k].contact_output_nm * passed_on, 1e-9);
  }
}

TEST(Stages, InertiaOfASecondStageCountsWithTheSquareOfItsSpeed) {
  const GearTrain train = laid(test::two_stage_design(kFirst, kSecond));
  BodyInertias bodies;
  test::inertia_of(train, bodies, "planet2") = {.axial_kg_m2 = 2e-6, .mass_kg = 0.03};
  const ReflectedInertia inertia = reflected_inertia(train, efficiency(train), bodies, {});
  const ByHand one(kFirst), two(kSecond);
  const double spin = one.carrier * two.planet, orbit = one.carrier * two.carrier, a = 0.5e-3 * (20 + 26);
  EXPECT_NEAR(inertia.input_side_kg_m2, 4 * (2e-6 * spin * spin + 0.03 * a * a * orbit * orbit), 1e-15);
}

TEST(Stages, ErrorsNameTheKeysOfTheirStage) {
  GearboxDesign design = test::two_stage_design(kFirst, kSecond);
  design.later_stages[0].centre_distance_mm = 5.0;
  const auto wrong = lay_out(design);
  ASSERT_FALSE(wrong);
  bool found = false;
  for (const Error& error : wrong.error()) found = found || error.key == "stage2.centre_distance_mm";
  EXPECT_TRUE(found) << wrong.error().front().key << ": " << wrong.error().front().message;
  EXPECT_EQ(key_of_stage("gearbox.planets", 2), "stage2.planets");
  EXPECT_EQ(key_of_stage("gearbox.friction", 2), "gearbox.friction");
  EXPECT_EQ(key_of_stage("gearbox.planets", 1), "gearbox.planets");
}

TEST(Stages, AStageTakenOutAndPutBackIsTheSameDesign) {
  GearboxDesign design = test::two_stage_design(kFirst, kSecond);
  design.later_stages[0].module_mm.reset();
  for (const int stage : {1, 2}) {
    GearboxDesign again = design;
    set_stage(stage_design(design, stage), stage, again);
    EXPECT_EQ(again, design) << stage;
  }
}

}  // namespace
}  // namespace trueflank
