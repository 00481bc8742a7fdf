// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/corner_contact.h"

#include <gtest/gtest.h>

#include <optional>
#include <tuple>

#include "tests/check/check_designs.h"
#include "tests/check/mesh_simulation.h"
#include "tests/check/random_pairs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/cure/interference_cure.h"

namespace trueflank {
namespace {

using test::gear;
using test::laid_out;
using test::only;
using test::pair_design;

Finding corner_of(const GearTrain& train, const std::string& where = "") {
  return only(check_corner_contact(train, mesh_states(train)), "corner_contact", where);
}

constexpr double kWindow_um = 80.0;  // of the simulation, at module 1

/// A ring whose standard tips dig into the pinion's fillets.
GearTrain digging(std::optional<double> limit_mm = {}) {
  GearboxDesign design = pair_design(25, 60, true, 0.1);
  design.corner_contact_limit_mm = limit_mm;
  return laid_out(design);
}

/// Deepest penetration with the play taken up on either side, by brute force [um].
double simulated_um(const GearTrain& train) {
  const GearPair pair = train.pair(train.meshes.front());
  const double play = 0.5 * circumferential_backlash_mm(pair) / pitch_radius2_mm(pair);
  return -1e3 * std::min(test::simulate_mesh(pair, play).clearance_mm,
                         test::simulate_mesh(pair, -play).clearance_mm);
}

/// How far gear 2 stays behind its conjugate angle, as arc on its base circle: gear 1 stands at 60 angles of a
/// pitch, gear 2 is turned back by bisection until the polygons part.
double lag_um(const GearTrain& train) {
  const GearPair pair = train.pair(train.meshes.front());
  const double r_b2 = base_radius_mm(pair.gear2());
  const double play = 0.5 * circumferential_backlash_mm(pair) / pitch_radius2_mm(pair);
  const double side = pair.internal() ? -1.0 : 1.0;  // towards gear 1's counter-clockwise flanks
  double free = -play, touching = play;
  while (touching - free > 1e-4 / r_b2) {
    const double middle = 0.5 * (free + touching);
    (test::simulate_mesh(pair, side * middle).clearance_mm > 0.0 ? free : touching) = middle;
  }
  return 1e3 * (play - free) * r_b2;
}

TEST(CornerContact, IsWhatTurningTheTeethWithTheirPlayTakenUpShows) {
  int touching = 0, clear = 0;
  for (std::uint64_t seed = 1; touching + clear < 8; ++seed) {
    auto train = lay_out(test::random_design(seed));
    if (!train || train->meshes.size() != 1 || !(train->meshes[0].backlash_mm > 1e-3)) continue;
    const Finding finding = corner_of(*train);
    const double simulated = simulated_um(*train);
    // the simulation sees up to 0.4 um less, and nothing deeper than its window
    EXPECT_NEAR(std::max(0.0, simulated), std::min(finding.value, kWindow_um), 0.6) << seed;
    ++(finding.value > 1.0 ? touching : clear);
  }
  EXPECT_GE(touching, 2);
  EXPECT_GE(clear, 2);
}

TEST(CornerContact, HoldsTheMateBackByAsMuchOrMore) {
  // the depth is measured normal to the surfaces, the lag along the path of contact
  const GearTrain train = digging();
  const Finding finding = corner_of(train);
  EXPECT_GT(finding.value, 5.0);
  EXPECT_GT(lag_um(train), finding.value - 1.0);
}

TEST(CornerContact, WarnsAboveZeroAndFailsAboveItsLimit) {
  const Finding by_default = corner_of(digging());
  EXPECT_EQ(by_default.status, CheckStatus::kFail) << by_default.message;
  EXPECT_NEAR(by_default.limit, 5.0, 1e-12);
  EXPECT_EQ(corner_of(digging(1e-3 * by_default.value + 1e-6)).status, CheckStatus::kWarn);
  EXPECT_EQ(corner_of(digging(1e-3 * by_default.value - 1e-6)).status, CheckStatus::kFail);
}

TEST(CornerContact, TipsAloneAreNeverNearerThanAllPlaces) {
  int meshes = 0, touching = 0;
  for (std::uint64_t seed = 1; meshes < 60; ++seed) {
    const auto train = lay_out(test::random_design(seed));
    if (!train || train->meshes.size() != 1) continue;
    const GearPair pair = train->pair(train->meshes.front());
    const double centred = sweep_clearance_mm(pair), driving = driving_clearance(pair).clearance_mm;
    EXPECT_TRUE(tips_clear(pair, centred - 1e-8)) << seed;
    EXPECT_TRUE(tips_clear_driving(pair, (std::isnan(driving) ? centred : driving) - 1e-8)) << seed;
    ++meshes;
    if (driving < -1e-6) ++touching;
  }
  EXPECT_GT(touching, 5);
}

TEST(CornerContact, ClearsWhatTheDrivingClearanceIsAtLeast) {
  int meshes = 0, touching = 0;
  for (std::uint64_t seed = 300; meshes < 30; ++seed) {
    const auto train = lay_out(test::random_design(seed));
    if (!train || train->meshes.size() != 1) continue;
    const GearPair pair = train->pair(train->meshes.front());
    const double driving = driving_clearance(pair).clearance_mm;
    const double clearance = std::isnan(driving) ? sweep_clearance_mm(pair) : driving;
    for (const double less_mm : {1e-2, 1e-5, 1e-7}) {
      EXPECT_TRUE(clears_driving(pair, clearance - less_mm)) << seed << ", " << less_mm;
      EXPECT_FALSE(clears_driving(pair, clearance + less_mm)) << seed << ", " << less_mm;
    }
    ++meshes;
    if (driving < -1e-6) ++touching;
  }
  EXPECT_GT(touching, 2);
}

TEST(CornerContact, SeekingWithTheTipsAloneFindsTheSameCure) {
  const auto exact = [](const GearPair& pair) { return driving_clearance(pair).clearance_mm + 1e-6; };
  const CureMargin all{exact};
  const CureMargin tips{exact, [](const GearPair& pair) { return tips_clear_driving(pair, -1e-6); }};
  int tip_cures = 0, shift_cures = 0;
  const GearTrain paper = laid_out(test::paper_design());
  for (const GearTrain& train : {digging(), paper})
    for (const TrainMesh& mesh : train.meshes) {
      for (const bool of_gear1 : {true, false}) {
        const auto radius = tip_radius_cure_mm(train.pair(mesh), of_gear1, tips);
        EXPECT_EQ(radius, tip_radius_cure_mm(train.pair(mesh), of_gear1, all)) << mesh.name;
        if (radius) ++tip_cures;
      }
      const auto sought = shift_cure(train, mesh, tips), exactly = shift_cure(train, mesh, all);
      ASSERT_EQ(sought.has_value(), exactly.has_value()) << mesh.name;
      if (!sought) continue;
      EXPECT_EQ(sought->change, exactly->change);
      ++shift_cures;
    }
  EXPECT_GT(tip_cures, 0);
  EXPECT_GT(shift_cures, 0);
}

TEST(CornerContact, ClearTipsTouchWithTheirFlanksFirst) {
  for (const auto& [z1, z2, internal] :
       {std::tuple{12, 60, false}, {10, 90, false}, {25, 60, true}, {39, 90, true}, {17, 120, true}}) {
    GearboxDesign design = pair_design(z1, z2, internal, 0.1);
    design.gears[0].shift = design.gears[1].shift = 0.0;
    design.tips = TipCircles::kClear;
    const GearTrain train = laid_out(design);
    EXPECT_EQ(corner_of(train).status, CheckStatus::kPass) << z1 << " " << z2 << corner_of(train).message;
    const Findings all = check_gearbox(train);
    EXPECT_EQ(only(all, "fillet_interference").status, CheckStatus::kPass) << z1 << " " << z2;
    EXPECT_GT(train.gears[1].tip_shortened_mm, 0.0);
  }
}

}  // namespace
}  // namespace trueflank
