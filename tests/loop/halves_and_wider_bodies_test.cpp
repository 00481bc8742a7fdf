// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"

// What moves flanks, tips and roots of a scan: halves of a mould that do not meet, a body that is
// wider along a part of its height.
namespace trueflank::test {
namespace {

/// A displacement in the plane [um] of every point of the body.
using Moves = std::function<std::array<double, 2>(const Vec3& point)>;

Process moved_by(const Moves& moves) {
  return {.move_um = [moves](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
    const auto [x, y] = moves(p);
    return {x, y, 0.0};
  }};
}

/// Points of tips and roots, moved as the flanks are.
void add_lands(const MadeGear& gear, const Moves& moves, double noise_um, unsigned seed,
               loop::ScanData& scan) {
  std::mt19937_64 random(seed * 17u + 3u);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal(0.0, noise_um);
  const double pitch = 2.0 * M_PI / gear.teeth, root = geometry_of(gear).root_radius_mm();
  for (int tooth = 0; tooth < gear.teeth; ++tooth)
    for (const bool tip : {true, false})
      for (int i = 0; i < 12; ++i) {
        const double z = 0.5 * gear.face_mm * (1.0 + 0.97 * uniform(random)),
                     angle = pitch * (tooth + (tip ? 0.0 : 0.5) + 0.05 * uniform(random)) +
                             std::tan(gear.helix_rad) * z / gear.reference(),
                     radius = (tip ? gear.tip_mm : root) + 1e-3 * normal(random);
        Vec3 p{radius * std::cos(angle), radius * std::sin(angle), z};
        const auto [x, y] = moves(p);
        p[0] += 1e-3 * x;
        p[1] += 1e-3 * y;
        scan.points_mm.push_back(p);
      }
}

loop::ScanData scan_of_body(const MadeGear& gear, const Moves& moves, std::vector<Process> others,
                            double noise_um, unsigned seed) {
  others.push_back(moved_by(moves));
  loop::ScanData scan = scan_of(gear, others, scanned(5600, noise_um, seed));
  add_lands(gear, moves, noise_um, seed, scan);
  return scan;
}

/// Halves split across a direction, each moved by as much along another, opposite ways.
Moves halves(double across_deg, double um, double along_deg) {
  const double across = across_deg * M_PI / 180.0, along = along_deg * M_PI / 180.0;
  return [=](const Vec3& p) -> std::array<double, 2> {
    const double side = p[0] * std::cos(across) + p[1] * std::sin(across) >= 0.0 ? um : -um;
    return {side * std::cos(along), side * std::sin(along)};
  };
}

/// Moved outwards by what a course over the height says.
Moves outwards(const std::function<double(double z)>& um) {
  return [=](const Vec3& p) -> std::array<double, 2> {
    const double radius = std::hypot(p[0], p[1]), moved = um(p[2]);
    return {moved * p[0] / radius, moved * p[1] / radius};
  };
}

const loop::Term* only_term(const loop::LoopResult& result) {
  return result.effects.size() == 1 && result.effects.front().terms.size() == 1
             ? &result.effects.front().terms.front()
             : nullptr;
}

const loop::Term* term_of(const loop::LoopResult& result, const std::string& words) {
  for (const loop::FoundEffect& effect : result.effects)
    for (const loop::Term& term : effect.terms)
      if (term.text.find(words) != std::string::npos) return &term;
  return nullptr;
}

double value_of(const loop::Term& term, std::size_t k) { return term.shape.at(k); }

// A judge's mould was order 2, unequal axes, a tooth, a scale and two orders.
TEST(HalvesOfAMould, ThatStandOpenAreOneForm) {
  for (unsigned seed = 1; seed <= survey_size(2U, 10U); ++seed) {
    const MadeGear gear = seed % 2 == 0 ? spur(24) : spur(31);
    const double across = 17.0 + 61.0 * seed, um = 7.0 + 2.0 * seed;
    const auto result =
        close(gear, scan_of_body(gear, halves(across, um, across), {}, 3.0, seed), true);
    const loop::Term* term = only_term(result);
    ASSERT_NE(term, nullptr) << seed << ": " << list(result);
    EXPECT_NE(term->text.find("two halves"), std::string::npos) << list(result);
    EXPECT_NE(term->text.find("does not close"), std::string::npos) << list(result);
    EXPECT_NEAR(term->amplitude(), um, 0.05 * um + 0.3) << list(result);
    EXPECT_NEAR(std::remainder(value_of(*term, 0) - across, 180.0), 0.0, 8.0) << list(result);
  }
}

TEST(HalvesOfAMould, ThatAreShiftedAreOneFormBesideATaper) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(26);
    const double across = 200.0 + 40.0 * seed;
    const Process taper =
        grown([](const MadeGear&, const FlankSpot& s, const Vec3&) { return 12.0 * s.v; });
    const auto result = close(
        gear, scan_of_body(gear, halves(across, 14.0, across + 90.0), {taper}, 3.0, seed), true);
    EXPECT_NE(find(result, "taper"), nullptr) << seed << ": " << list(result);
    EXPECT_TRUE(tells(result, "halves are shifted")) << seed << ": " << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << seed << ": " << list(result);
  }
}

TEST(HalvesOfAMould, AnOvalAndASizeAreNone) {
  for (unsigned seed = 1; seed <= survey_size(1U, 8U); ++seed) {
    const MadeGear gear = spur(28);
    const Process oval = stretched(0.12, 30.0 * seed), lobes = out_of_round(4, 9.0, 50.0 * seed);
    const auto result = close(gear, scan_of(gear, {oval, lobes}, scanned(5000, 3.0, seed)), true);
    EXPECT_FALSE(tells(result, "two halves")) << seed << ": " << list(result);
  }
}

// A judge's press fit was a step of the flanks, a level, a scale and a twist.
TEST(WiderBody, BelowOrAboveAHeightIsOneForm) {
  for (unsigned seed = 1; seed <= survey_size(2U, 10U); ++seed) {
    const MadeGear gear = seed % 2 == 0 ? helical(22, 15.0) : spur(30);
    const double at = (0.3 + 0.06 * (seed % 8)) * gear.face_mm, half = seed % 3 == 0 ? 0.02 : 0.8;
    const double sign = seed % 2 == 0 ? 1.0 : -1.0, um = 14.0 + seed;
    const auto result =
        close(gear,
              scan_of_body(gear, outwards([=](double z) {
                             return 0.5 * um * (1.0 + sign * std::tanh((z - at) / half));
                           }),
                           {}, 3.0, seed),
              true);
    // (values on both sides of a sharp edge share patches: a little may be left there)
    const loop::Term* term = term_of(result, "tips and roots alike");
    ASSERT_NE(term, nullptr) << seed << ": " << list(result);
    EXPECT_FALSE(has_name(result)) << seed << ": " << list(result);
    for (const loop::FoundEffect& effect : result.effects)
      for (const loop::Term& other : effect.terms)
        EXPECT_TRUE(&other == term || other.amplitude() < 2.0) << list(result);
    EXPECT_NEAR(term->cos, um, 0.06 * um) << seed << ": " << list(result);
    EXPECT_NEAR(value_of(*term, 3), at, 0.04 * gear.face_mm) << seed << ": " << list(result);
  }
}

TEST(WiderBody, StandsBesideAnEccentricity) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(25);
    const auto result =
        close(gear,
              scan_of_body(gear, outwards([&](double z) {
                             return 18.0 * (1.0 - std::tanh((z - 0.4 * gear.face_mm) / 0.7)) / 2.0;
                           }),
                           {off_centre(15.0, 70.0 * seed)}, 3.0, seed),
              true);
    EXPECT_NE(find(result, "eccentricity"), nullptr) << seed << ": " << list(result);
    EXPECT_TRUE(tells(result, "tips and roots alike")) << seed << ": " << list(result);
    EXPECT_EQ(result.effects.size(), 2U) << seed << ": " << list(result);
  }
}

TEST(WiderBody, AStepOfTheFlanksAloneIsNone) {
  for (unsigned seed = 1; seed <= survey_size(1U, 6U); ++seed) {
    const MadeGear gear = spur(25);
    const Process step = grown(
        [](const MadeGear&, const FlankSpot& s, const Vec3&) { return s.v < -0.1 ? 14.0 : 0.0; });
    const auto result = close(
        gear, scan_of_body(gear, outwards([](double) { return 0.0; }), {step}, 3.0, seed), true);
    EXPECT_FALSE(tells(result, "tips and roots alike")) << seed << ": " << list(result);
    EXPECT_FALSE(has_name(result)) << seed << ": " << list(result);
  }
}

// A thin ring in a chuck: the radius follows arches with cusps at the jaws.
TEST(ArchesBetweenJaws, AreOneFormWithTheirHeight) {
  for (const int jaws : {3, 4}) {
    const MadeGear gear = spur(40);
    const Process arched{
        .move_um = [jaws](const MadeGear&, const FlankSpot&, const Vec3& p) -> Vec3 {
          const double um = 9.0 * std::abs(std::sin(0.5 * jaws * (std::atan2(p[1], p[0]) - 0.4)));
          const double radius = std::hypot(p[0], p[1]);
          return {um * p[0] / radius, um * p[1] / radius, 0.0};
        }};
    const auto result = close(gear, scan_of(gear, {arched}, scanned(20000, 0.9, 11)), true);
    EXPECT_EQ(result.verdict, loop::Verdict::kExplained) << list(result);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_TRUE(tells(result, "arches between the jaws")) << list(result);
    EXPECT_NEAR(result.effects.front().terms.front().amplitude(), 9.0, 0.15) << list(result);
  }
}

}  // namespace
}  // namespace trueflank::test
