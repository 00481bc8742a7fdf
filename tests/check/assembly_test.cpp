// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/assembly.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/check/check_designs.h"
#include "tests/check/mesh_simulation.h"
#include "trueflank/check/train_turning.h"
#include "tests/support/train_members.h"

namespace trueflank::test {
namespace {

Finding assembly_of(const GearboxDesign& design) {
  const GearTrain train = laid_out(design);
  return check_assembly(train, mesh_states(train))[0];
}

GearboxDesign compound(int sun, int planet1, int ring1, int planet2, int ring2, int planets) {
  GearboxDesign d = paper_design(0.05);
  d.planets = planets;
  d.centre_distance_mm = 0.5 * (sun + planet1) + 0.1;
  const int teeth[] = {sun, planet1, ring1, planet2, ring2};
  for (std::size_t i = 0; i < 5; ++i) d.gears[i].teeth = teeth[i];
  d.gears[2].shift = d.gears[4].shift = 0.3;
  return d;
}

TEST(Assembly, SaysWhichPlanetsAreAlike) {
  EXPECT_EQ(assembly_of(simple_design(12, 30, 72, 3)).status, CheckStatus::kPass);
  const Finding unequal = assembly_of(simple_design(13, 30, 73, 3));
  EXPECT_EQ(unequal.status, CheckStatus::kFail);
  EXPECT_GT(unequal.value, 0.0);
  EXPECT_EQ(assembly_of(paper_design()).status, CheckStatus::kPass);
}

TEST(Assembly, SaysWhetherTheNearestAnglesAreOfIdenticalOrOfIndexedBodies) {
  const Finding indexed = assembly_of(compound(12, 39, 91, 31, 80, 2));
  EXPECT_EQ(indexed.status, CheckStatus::kFail);
  EXPECT_NEAR(indexed.value, 360.0 * 52 / 103 - 180.0, 1e-9);
  EXPECT_NE(indexed.message.find("bodies that differ mesh at 0, 181.7476 deg"), std::string::npos) << indexed.message;
  const Finding identical = assembly_of(simple_design(13, 30, 73, 3));
  EXPECT_NE(identical.message.find("Identical ones do at"), std::string::npos) << identical.message;
  const Finding none = assembly_of(simple_design(13, 60, 133, 7));
  EXPECT_NE(none.message.find("neighbours would collide"), std::string::npos) << none.message;
  EXPECT_TRUE(std::isnan(none.value));
}

TEST(Assembly, DifferentCompoundBodiesWarnWithTheirOffsets) {
  const Finding f = assembly_of(compound(11, 40, 91, 33, 83, 3));
  EXPECT_EQ(f.status, CheckStatus::kWarn);
  EXPECT_NE(f.message.find("by 0,"), std::string::npos) << f.message;
}

TEST(Assembly, TurningTheTrainKeepsEveryPhase) {
  for (const GearboxDesign& d : {paper_design(), compound(11, 40, 91, 33, 83, 3),
                                 simple_design(12, 30, 72, 3), simple_design(14, 31, 76, 5)}) {
    const GearTrain train = laid_out(d);
    const TrainTurning turning = turn_train(train, mesh_states(train));
    EXPECT_LT(turning.phase_error_mm, 1e-9) << turning.mesh;
  }
}

TEST(Assembly, ABodyInTheWrongPlaceIsFoundByTurning) {
  GearTrain train = laid_out(compound(11, 40, 91, 33, 83, 3));
  const auto states = mesh_states(train);
  auto& offsets = train.phases.gear_offset_rad[3];  // of planet2
  std::swap(offsets[1], offsets[2]);
  const TrainTurning turning = turn_train(train, states);
  EXPECT_GT(turning.phase_error_mm, 0.05);
  EXPECT_LT(turning.clearance_mm, -0.01);
  EXPECT_EQ(check_assembly(train, states)[0].status, CheckStatus::kFail);
}

/// By brute force: does a body, P2 fixed to P1 by an offset, mesh with sun and rings at an angle?
bool body_fits(const GearTrain& train, double position_rad, double offset_rad, double sun_rad, double ring2_rad) {
  const GearPair sun = train.pair(train.meshes[0]), ring = train.pair(train.meshes[1]);
  const bool two = train.meshes.size() > 2;
  const int teeth = ring.gear1().teeth;
  // from the mesh with ring1, standing: tooth 1 of the planet in some gap of the ring
  const double first =
      position_rad + (kPi - ring.gear2().teeth * position_rad) / static_cast<double>(teeth);
  const auto turn_back = [&](double angle) { return angle - position_rad; };
  if (simulate_position_mm(ring, turn_back(first), turn_back(0.0),
                           {-train.centre_distance_mm, 0.0}) < 0.0)
    return false;
  if (simulate_position_mm(sun, turn_back(sun_rad), turn_back(first),
                           {train.centre_distance_mm, 0.0}) < 0.0)
    return false;
  if (!two) return true;
  const GearPair outer = train.pair(train.meshes[2]);
  for (int k = 0; k < teeth; ++k) {
    const double rotation = first + kTwoPi * k / teeth;
    if (simulate_position_mm(outer, turn_back(rotation + offset_rad),
                             turn_back(ring2_rad), {-train.centre_distance_mm, 0.0}) >= 0.0)
      return true;
  }
  return false;
}

TEST(Assembly, TheClosedFormIsWhatBruteForceFinds) {
  for (const GearboxDesign& wanted :
       {compound(12, 39, 90, 32, 81, 3), compound(11, 40, 91, 33, 83, 3),
        compound(13, 35, 84, 31, 80, 3), compound(14, 31, 76, 28, 73, 3),
        compound(15, 30, 75, 27, 72, 3)}) {
    GearboxDesign d = wanted;
    d.backlash_mm = 0.03;  // less than the phase errors that tooth counts make
    const GearTrain train = laid_out(d);
    const double sun_rad = test::rotation_of(train, train.phases, "sun");
    const double ring2_rad = test::rotation_of(train, train.phases, "ring2");
    const std::vector<double> offsets = test::offsets_of(train, "planet2");
    bool all = true;
    for (int i = 0; i < 3; ++i) all = all && body_fits(train, kTwoPi * i / 3.0, offsets[0], sun_rad, ring2_rad);
    EXPECT_EQ(all, train.assembly.equal_spacing && train.assembly.identical_planets)
        << d.gears[0].teeth << ' ' << d.gears[3].teeth;
    const std::vector<double>& angles = train.assembly.nearest_angles_rad;
    // bodies as they are made for these angles: all like the first, or indexed
    for (std::size_t i = 0; i < angles.size(); ++i)
      EXPECT_TRUE(body_fits(train, angles[i], train.assembly.equal_spacing ? offsets[0] : offsets[i], sun_rad, ring2_rad))
          << d.gears[0].teeth << " at " << deg_from_rad(angles[i]);
  }
}

}  // namespace
}  // namespace trueflank::test
