// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/planet_phase.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/gear_train.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "trueflank/base/tolerance.h"
#include "tests/support/train_members.h"

namespace trueflank {
namespace {

GearboxDesign design_3k(std::array<int, 5> teeth, int planets = 3) {
  GearboxDesign design{.name = "3k", .topology = train_topology("3k", "ring2"),
                       .planets = planets};
  const auto& places = design.topology.gears;
  for (std::size_t i = 0; i < 5; ++i) {
    GearDesign gear{.name = places[i].name, .teeth = teeth[i]};
    if (places[i].form == GearForm::kRing) gear.kind = GearKind::kInternal;
    design.gears.push_back(gear);
  }
  return design;
}

GearboxDesign paper_design() {
  GearboxDesign design = design_3k({12, 39, 90, 32, 81});
  design.centre_distance_mm = 25.6826;
  design.backlash_mm = 0.05;
  design.tips = TipCircles::kStandard;
  design.gears[2].shift = 0.5225;
  design.gears[4].shift = 1.9967;
  return design;
}

GearboxDesign pair_design(int z1, int z2, bool internal) {
  GearboxDesign design{.name = "pair", .topology = train_topology("pair")};
  design.gears = {GearDesign{.name = "pinion", .teeth = z1},
                  GearDesign{.name = "wheel",
                             .kind = internal ? GearKind::kInternal : GearKind::kExternal,
                             .teeth = z2}};
  return design;
}

TEST(GearTrain, PaperPrototypeHasItsRatioAndShifts) {
  const auto train = lay_out(paper_design());
  ASSERT_TRUE(train);
  // paper page: ratio 1/96.242, same direction
  EXPECT_NEAR(1.0 / train->speeds.output, 96.2419, 5e-5);
  // the paper's relations: x_s + x_p1 and x_r - x_p from inv a_w, written out here
  const double cos_20 = std::cos(rad_from_deg(20.0));
  const auto inv = [](double a) { return std::tan(a) - a; };
  const double f = 1.0 / (2.0 * std::tan(rad_from_deg(20.0)));
  const double aw1 = std::acos(25.5 * cos_20 / 25.6826), aw2 = std::acos(24.5 * cos_20 / 25.6826);
  const double i20 = inv(rad_from_deg(20.0));
  const double x_p1 = 0.5225 - 51.0 * f * (inv(aw1) - i20);
  EXPECT_NEAR(train->find("planet1")->shift, x_p1, 1e-12);
  EXPECT_NEAR(train->find("sun")->shift, 51.0 * f * (inv(aw1) - i20) - x_p1, 1e-12);
  EXPECT_NEAR(train->find("planet2")->shift, 1.9967 - 49.0 * f * (inv(aw2) - i20), 1e-12);
  // tip diameters of the paper's efficiency figures (m = 1)
  const double y_a = 25.5 * (cos_20 / std::cos(aw1) - 1.0);
  const double x_s = train->find("sun")->shift;
  EXPECT_NEAR(2.0 * train->find("sun")->profile.tip_radius_mm(), 12 + 2 * (1 + y_a - x_p1), 1e-9);
  EXPECT_NEAR(2.0 * train->find("planet1")->profile.tip_radius_mm(),
              39 + 2 * (1 + std::min(y_a - x_s, x_p1)), 1e-9);
  EXPECT_NEAR(2.0 * train->find("ring1")->profile.tip_radius_mm(), 90 - 2 * (1 - 0.5225), 1e-9);
  EXPECT_NEAR(2.0 * train->find("ring2")->profile.tip_radius_mm(), 81 - 2 * (1 - 1.9967), 1e-9);
}

TEST(GearTrain, EveryMeshEndsUpWithTheBacklashAskedFor) {
  const auto train = lay_out(paper_design());
  ASSERT_TRUE(train);
  ASSERT_EQ(train->meshes.size(), 3u);
  for (const TrainMesh& mesh : train->meshes) {
    EXPECT_NEAR(mesh.backlash_mm, 0.05, 1e-12) << mesh.name;
    EXPECT_EQ(mesh.implied_backlash_mm, 0.0) << mesh.name;
  }
  // shared evenly where nothing else decides
  EXPECT_NEAR(train->find("sun")->profile.gear().thinning_mm,
              train->find("planet1")->profile.gear().thinning_mm, 1e-15);
}

TEST(GearTrain, GivenShiftsAndCentreDistanceImplyABacklashThatIsReported) {
  GearboxDesign design = pair_design(17, 40, false);
  design.centre_distance_mm = 28.55;  // 0.05 mm further apart than the unshifted pair
  design.gears[0].shift = 0.0;
  design.gears[1].shift = 0.0;
  const auto wide = lay_out(design);
  ASSERT_TRUE(wide);
  EXPECT_NEAR(wide->meshes[0].implied_backlash_mm, 2.0 * 0.05 * std::tan(rad_from_deg(20.0)), 5e-4);
  EXPECT_NEAR(wide->meshes[0].backlash_mm, wide->meshes[0].implied_backlash_mm, 1e-12);
  design.centre_distance_mm = 28.45;
  EXPECT_LT(lay_out(design)->meshes[0].implied_backlash_mm, 0.0);
  design.gears[1].kind = GearKind::kInternal;
  design.centre_distance_mm = 11.45;  // an internal pair gains play when the axes come closer
  const auto ring = lay_out(design);
  ASSERT_TRUE(ring);
  EXPECT_GT(ring->meshes[0].implied_backlash_mm, 0.0);
  EXPECT_NEAR(ring->meshes[0].backlash_mm, ring->meshes[0].implied_backlash_mm, 1e-12);
}

TEST(GearTrain, ThinningGivenForOneGearReplacesItsShare) {
  GearboxDesign design = pair_design(17, 40, false);
  design.backlash_mm = 0.1;
  design.gears[0].thinning_mm = 0.03;
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  EXPECT_NEAR(train->meshes[0].backlash_mm, 0.1, 1e-12);
  EXPECT_NEAR(train->gears[0].profile.gear().thinning_mm, 0.03, 1e-15);
  EXPECT_NEAR(train->gears[1].profile.gear().thinning_mm, 0.07, 1e-12);
}

TEST(GearTrain, OmittedValuesAreSolved) {
  const auto plain = lay_out(pair_design(17, 40, false));
  ASSERT_TRUE(plain);
  EXPECT_NEAR(plain->centre_distance_mm, 28.5, 1e-12);
  GearboxDesign spread = pair_design(17, 40, false);
  spread.centre_distance_mm = 29.0;
  const auto shared = lay_out(spread);
  ASSERT_TRUE(shared);
  EXPECT_NEAR(shared->gears[0].shift, shared->gears[1].shift, 1e-12);
  EXPECT_NEAR(shared->meshes[0].backlash_mm, 0.0, 1e-12);
  const auto untouched = lay_out(design_3k({12, 39, 90, 32, 81}));
  ASSERT_TRUE(untouched);
  EXPECT_NEAR(untouched->centre_distance_mm, 25.5, 1e-12);
  // paper page: uncorrected layer 1, x_r2 - x_p2 = 1.1360 brings layer 2 to 25.5
  EXPECT_NEAR(untouched->gears[4].shift - untouched->gears[3].shift, 1.1360, 5e-5);
}

TEST(GearTrain, RefusesWhatCannotMesh) {
  GearboxDesign design = paper_design();
  design.centre_distance_mm = 23.0;
  const auto close = lay_out(design);
  ASSERT_FALSE(close);
  EXPECT_EQ(close.error().front().key, "gearbox.centre_distance_mm");
  GearboxDesign ring = pair_design(40, 40, true);
  EXPECT_FALSE(lay_out(ring));
  GearboxDesign modules = pair_design(17, 40, false);
  modules.gears[1].module_mm = 2.0;
  EXPECT_EQ(lay_out(modules).error().front().key, "wheel.module_mm");
}

// ---------------------------------------------------------------- assembly

/// Depth in teeth by which two gears are out of mesh, from plain angles of tooth 1: 0 in mesh.
double out_of_mesh(double z1, double angle1, double z2, double angle2, double contact, bool internal) {
  const double a = z1 * (angle1 - contact);
  const double b = z2 * (angle2 - (internal ? contact : contact + kPi));
  const double phase = internal ? a - b : a + b;
  return std::abs(centred_rad(phase - kPi)) / kTwoPi;
}

void expect_in_mesh(const GearTrain& train, const AssemblyPhases& p, double tolerance) {
  for (std::size_t i = 0; i < p.positions_rad(train.topology().first_planet()).size(); ++i)
    for (const TrainMesh& mesh : train.meshes) {
      const auto turned = [&](int gear) {
        const int member = train.topology().gears[static_cast<std::size_t>(gear)].member;
        return p.rotation_rad(member, i) + p.offset_rad(gear, i);
      };
      const Gear &g1 = train.pair(mesh).gear1(), &g2 = train.pair(mesh).gear2();
      EXPECT_LT(out_of_mesh(g1.teeth, turned(mesh.gear1), g2.teeth, turned(mesh.gear2),
                            p.positions_rad(train.topology().first_planet())[i], g2.kind == GearKind::kInternal),
                tolerance)
          << mesh.name << " of planet " << i + 1;
    }
}

TEST(Assembly, PaperPrototypeTakesThreeIdenticalPlanetsAtEqualSpacing) {
  const auto train = lay_out(paper_design());
  ASSERT_TRUE(train);
  EXPECT_TRUE(train->assembly.equal_spacing);
  EXPECT_TRUE(train->assembly.identical_planets);
  for (double offset : test::offsets_of(*train, "planet2")) EXPECT_EQ(offset, 0.0);
  expect_in_mesh(*train, train->phases, 1e-9);
}

/// By trial: are there whole-tooth turns k of P1 and j of P2 that make body i like body 1?
bool identical_by_trial(const std::array<int, 5>& z, int planets) {
  for (int i = 1; i < planets; ++i) {
    const double phi = kTwoPi * i / planets;
    const double psi1 = kPi / z[1], rho2 = (z[3] * psi1 - kPi) / z[4];
    bool found = false;
    for (int k = 0; k < z[1] && !found; ++k) {
      const double psi = phi + (kPi - z[2] * phi) / z[1] + kTwoPi * k / z[1];
      found = out_of_mesh(z[3], psi, z[4], rho2, phi, true) < 1e-9;
    }
    if (!found) return false;
  }
  return true;
}

TEST(Assembly, ClosedFormAgreesWithTrialForRandomTeeth) {
  std::mt19937 random(11);
  const auto between = [&](int a, int b) { return std::uniform_int_distribution<int>(a, b)(random); };
  int equal = 0, identical = 0, seen = 0;
  while (seen < 300) {
    const int z_s = between(9, 30), z_p1 = between(12, 40), z_r1 = z_s + 2 * z_p1 + between(-1, 1);
    const int z_p2 = between(12, 40), z_r2 = z_r1 - z_p1 + z_p2 + between(-2, 2);
    const int planets = between(2, 5);
    if (z_r2 <= z_p2 + 5) continue;
    const std::array<int, 5> z{z_s, z_p1, z_r1, z_p2, z_r2};
    const auto train = lay_out(design_3k(z, planets));
    if (!train) continue;
    ++seen;
    const bool at_equal = (z_s + z_r1) % planets == 0;
    EXPECT_EQ(train->assembly.equal_spacing, at_equal);
    if (!at_equal) continue;
    ++equal;
    const bool trial = identical_by_trial(z, planets);
    identical += trial;
    EXPECT_EQ(train->assembly.identical_planets, trial)
        << z_s << "/" << z_p1 << "/" << z_r1 << "/" << z_p2 << "/" << z_r2 << " N " << planets;
    expect_in_mesh(*train, train->phases, 1e-9);
    for (std::size_t i = 0; i < test::offsets_of(*train, "planet2").size(); ++i)
      EXPECT_NEAR(std::abs(test::offsets_of(*train, "planet2")[i]),
                  std::abs(train->assembly.planet_offsets_rad[i]), 1e-9);
  }
  EXPECT_GT(equal, 40);
  EXPECT_GT(identical, 10);
  EXPECT_LT(identical, equal);
}

TEST(Assembly, NearestAnglesAssembleIdenticalBodies) {
  GearboxDesign design = design_3k({13, 39, 91, 32, 81}, 3);  // 104 is no multiple of 3
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  EXPECT_FALSE(train->assembly.equal_spacing);
  ASSERT_EQ(train->assembly.nearest_angles_rad.size(), 3u);
  expect_in_mesh(*train, train->phases, 1e-9);
  for (double offset : test::offsets_of(*train, "planet2")) EXPECT_EQ(offset, 0.0);
}

TEST(Assembly, IndexedBodiesStandNearEqualSpacingWhereIdenticalOnesWouldCollide) {
  const auto train = lay_out(design_3k({12, 39, 91, 31, 80}, 2));  // 103 places, one of them for identical bodies
  ASSERT_TRUE(train);
  EXPECT_FALSE(train->assembly.equal_spacing);
  EXPECT_FALSE(planet_bodies_alike(train->assembly));
  ASSERT_EQ(train->assembly.nearest_angles_rad.size(), 2u);
  EXPECT_NEAR(deg_from_rad(train->assembly.nearest_angles_rad[1]), 360.0 * 52 / 103, 1e-9);
  EXPECT_NE(train->assembly.planet_offsets_rad[1], 0.0);
  expect_in_mesh(*train, train->phases, 1e-9);
  const IndexedPlanets indexed = indexed_planets(*train);
  EXPECT_EQ(indexed.angles_rad, train->assembly.nearest_angles_rad);
  EXPECT_EQ(indexed.offsets_rad, train->assembly.planet_offsets_rad);
}

TEST(Assembly, NoAnglesAreLeftOnlyWhereNeighboursWouldCollide) {
  std::mt19937 random(5);
  const auto between = [&](int a, int b) { return std::uniform_int_distribution<int>(a, b)(random); };
  int left = 0, none = 0, indexed = 0, seen = 0;
  while (seen < 300) {
    const int z_s = between(9, 30), z_p1 = between(12, 40), z_r1 = z_s + 2 * z_p1 + between(-1, 1);
    const int z_p2 = between(12, 40), z_r2 = z_r1 - z_p1 + z_p2 + between(-2, 2), planets = between(2, 6);
    if (z_r2 <= z_p2 + 5 || (z_s + z_r1) % planets == 0) continue;
    const auto train = lay_out(design_3k({z_s, z_p1, z_r1, z_p2, z_r2}, planets));
    if (!train) continue;
    ++seen;
    SCOPED_TRACE(std::to_string(z_s) + "/" + std::to_string(z_p1) + "/" + std::to_string(z_r1) + "/" +
                 std::to_string(z_p2) + "/" + std::to_string(z_r2) + " N " + std::to_string(planets));
    // of N gaps of whole places the smallest is at most the mean, rounded down
    const int places = z_s + z_r1, narrowest = places / planets;
    const double tip = std::max(train->gears[1].profile.tip_radius_mm(), train->gears[3].profile.tip_radius_mm());
    const bool collide =
        train->centre_distance_mm * std::sin(std::min(kPi * narrowest / places, 0.5 * kPi)) <= tip;
    EXPECT_EQ(train->assembly.nearest_angles_rad.empty(), collide);
    if (collide) {
      ++none;
      continue;
    }
    ++left;
    indexed += !planet_bodies_alike(train->assembly);
    expect_in_mesh(*train, train->phases, 1e-9);
    for (std::size_t i = 0; i < train->assembly.planet_offsets_rad.size(); ++i)
      EXPECT_NEAR(std::abs(test::offsets_of(*train, "planet2")[i]), std::abs(train->assembly.planet_offsets_rad[i]),
                  1e-9);
  }
  EXPECT_GT(left, 50);
  EXPECT_GT(none, 10);
  EXPECT_GT(indexed, 20);
}

TEST(Kinematics, TurnedTrainStaysInMesh) {
  for (const char* output : {"ring2", "ring1"}) {
    GearboxDesign design = paper_design();
    design.topology = train_topology("3k", output);
    const auto train = lay_out(design);
    ASSERT_TRUE(train);
    for (double turn : {0.1, 1.7, 25.0, -3.0}) expect_in_mesh(*train, turned(*train, turn), 1e-8);
  }
}

TEST(Kinematics, TypeTwoTurnsTheOtherRing) {
  GearboxDesign design = paper_design();
  design.topology = train_topology("3k", "ring1");
  const auto train = lay_out(design);
  ASSERT_TRUE(train);
  const auto w = [&](const char* member) { return test::speed_of(*train, member); };
  EXPECT_EQ(w("ring2"), 0.0);
  // paper page's velocity relations with the pitch radii of one centre distance
  const double r_s = 12.0 / 51.0, r_p11 = 39.0 / 51.0, r_ca = 1.0;
  EXPECT_NEAR(r_s * w("sun") + r_p11 * w("planet"), (r_s + r_p11) * w("carrier"), 1e-12);
  const double r_p12 = 39.0 / 51.0, r_r1 = 90.0 / 51.0;
  EXPECT_NEAR(r_r1 * w("ring1"), (r_r1 - r_p12) * w("carrier") + r_p12 * w("planet"), 1e-12);
  const double r_p2 = r_ca * 32.0 / 49.0, r_r2 = r_ca * 81.0 / 49.0;
  EXPECT_NEAR(r_r2 * w("ring2"), (r_r2 - r_p2) * w("carrier") + r_p2 * w("planet"), 1e-12);
}

// ---------------------------------------------------------------- compound planets with a gear each

GearboxDesign design_of(Topology topology, const std::vector<int>& teeth, int planets) {
  GearboxDesign design{.name = "any", .topology = std::move(topology), .planets = planets};
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    const TopologyGear& place = design.topology.gears[i];
    design.gears.push_back({.name = place.name,
                            .kind = place.form == GearForm::kRing ? GearKind::kInternal : GearKind::kExternal,
                            .teeth = teeth[i]});
  }
  return design;
}

/// By trial: the body at an angle meshes with everything without an offset of its gears of its own, in one of
/// the positions in which its first gear meshes.
bool alike_by_trial(const GearTrain& train, double phi) {
  const TrainMesh &mesh1 = train.meshes.front(), &mesh2 = train.meshes.back();
  const Topology& topology = train.topology();
  const auto central = [&](const TrainMesh& mesh) {
    return topology.is_planet_gear(static_cast<std::size_t>(mesh.gear1)) ? mesh.gear2 : mesh.gear1;
  };
  const auto teeth = [&](int gear) { return train.gear(gear).profile.gear().teeth; };
  const auto internal = [&](int gear) { return train.gear(gear).profile.gear().kind == GearKind::kInternal; };
  const auto out = [&](const TrainMesh& mesh, int planet, double psi) {
    const int c = central(mesh);
    const double rotation = train.phases.rotation_rad(topology.gears[static_cast<std::size_t>(c)].member, 0);
    return internal(c) ? out_of_mesh(teeth(planet), psi, teeth(c), rotation, phi, true)
                       : out_of_mesh(teeth(c), rotation, teeth(planet), psi, phi, false);
  };
  const int planet1 = mesh1.gear1 == central(mesh1) ? mesh1.gear2 : mesh1.gear1;
  const int planet2 = mesh2.gear1 == central(mesh2) ? mesh2.gear2 : mesh2.gear1;
  // a rotation in which planet1 meshes, found by its phase, then tooth by tooth
  const double z1 = teeth(planet1);
  double psi = 0.0, best = 1.0;
  for (int k = 0; k < 4000; ++k)
    if (const double o = out(mesh1, planet1, kTwoPi / z1 * k / 4000); o < best) best = o, psi = kTwoPi / z1 * k / 4000;
  for (double step = kTwoPi / z1 / 4000; step > 1e-13; step *= 0.5)
    for (const double side : {psi - step, psi + step})
      if (const double o = out(mesh1, planet1, side); o < best) best = o, psi = side;
  for (int k = 0; k < teeth(planet1); ++k)
    if (out(mesh2, planet2, psi + kTwoPi * k / z1) < 1e-6) return true;
  return false;
}

TEST(Assembly, SteppedAndSplitRingSetsAssembleAndStayInMeshForRandomTeeth) {
  std::mt19937 random(5);
  const auto between = [&](int a, int b) { return std::uniform_int_distribution<int>(a, b)(random); };
  int seen = 0, identical = 0;
  while (seen < 60) {
    const int planets = between(2, 4), z_p1 = between(18, 40), z_p2 = between(18, 40);
    const bool stepped = between(0, 1) == 1;
    const int z_s = between(12, 30);
    GearboxDesign design =
        stepped ? design_of(train_topology("stepped"), {z_s, z_p1, z_p2, z_s + z_p1 + z_p2}, planets)
                : design_of(without_gear(train_topology("3k", "ring2", "carrier"), 0),
                            {z_p1, z_p1 + 40, z_p2, z_p2 + 40}, planets);
    const auto train = lay_out(design);
    if (!train) continue;
    ++seen;
    SCOPED_TRACE(std::to_string(z_s) + " " + std::to_string(z_p1) + " " + std::to_string(z_p2) + " N " +
                 std::to_string(planets) + (stepped ? " stepped" : " split ring"));
    EXPECT_TRUE(train->assembly.equal_spacing);  // bodies may differ
    bool trial = true;
    for (int i = 1; i < planets; ++i) trial = trial && alike_by_trial(*train, kTwoPi * i / planets);
    EXPECT_EQ(train->assembly.identical_planets, trial);
    identical += trial;
    for (const double angle : train->assembly.nearest_angles_rad)
      EXPECT_TRUE(alike_by_trial(*train, angle)) << deg_from_rad(angle);
    expect_in_mesh(*train, train->phases, 1e-9);
    for (const double turn : {0.3, -11.0}) expect_in_mesh(*train, turned(*train, turn), 1e-8);
  }
  EXPECT_GT(identical, 8);
  EXPECT_LT(identical, 55);
}

TEST(GearTrain, GearsThatAreNotTheTopologysAreAnError) {
  GearboxDesign design = pair_design(17, 43, false);
  std::swap(design.gears[0].name, design.gears[1].name);
  EXPECT_EQ(lay_out(design).error().front().key, "gearbox.kind");
  design.gears.clear();
  EXPECT_EQ(lay_out(design).error().front().key, "gearbox.kind");
}

}  // namespace
}  // namespace trueflank
