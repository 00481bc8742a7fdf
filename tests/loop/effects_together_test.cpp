// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/effect.h"

namespace trueflank::test {
namespace {

/// Places on flanks of all heights, on tips and in the bore.
std::vector<loop::Place> places_of(const loop::FlankGeometry& geometry, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::uniform_int_distribution<int> tooth(1, geometry.teeth());
  std::vector<loop::Place> places;
  for (int i = 0; i < 40; ++i)
    places.push_back(geometry.on_flank(
        tooth(random), i % 2 == 0 ? 1 : -1,
        geometry.root_form_roll_mm() +
            share(random) * (geometry.tip_form_roll_mm() - geometry.root_form_roll_mm()),
        share(random) * geometry.face_width_mm()));
  for (const loop::Surface surface : {loop::Surface::kTip, loop::Surface::kBore})
    places.push_back(geometry.on_circle(surface, tooth(random), 6.0 * share(random),
                                        geometry.tip_radius_mm(), 1.0));
  return places;
}

/// All candidates of a family, the effect of a shape beside each of its neighbours.
void expect_the_same_together(const loop::FlankGeometry& geometry,
                              const std::vector<loop::Effect>& effects,
                              const std::vector<loop::Place>& places) {
  for (std::size_t first = 0, end = 0; first < effects.size(); first = end) {
    for (end = first; end < effects.size() && effects[end].family == effects[first].family;) ++end;
    const auto run = std::span(effects).subspan(first, end - first);
    const loop::EffectsTogether together(run);
    std::vector<double> columns(static_cast<std::size_t>(together.columns()), kNaN);
    for (const loop::Place& place : places) {
      together.evaluate(geometry, place, columns.data());
      std::size_t at = 0;
      for (const loop::Effect& effect : run) {
        double alone[8];
        effect.evaluate(geometry, place, alone);
        for (int k = 0; k < effect.columns(); ++k, ++at)
          ASSERT_NEAR(columns[at], alone[k], 1e-13 * (1.0 + std::abs(alone[k])) * 400.0)
              << effect.family->id << " column " << k;
      }
      ASSERT_EQ(at, columns.size());
    }
  }
}

TEST(EffectsTogether, ColumnsAreThoseOfEachEffectByItself) {
  std::mt19937 random(20260160);
  for (const MadeGear& made : {spur(24), ring(60), helical(131, -25.0)}) {
    const loop::FlankGeometry geometry = geometry_of(made);
    expect_the_same_together(geometry, loop::candidate_effects(geometry),
                             places_of(geometry, random));
  }
}

TEST(EffectsTogether, ColumnsAreTheSameWhereOrdersAreMissing) {
  std::mt19937 random(20260161);
  const loop::FlankGeometry geometry = geometry_of(spur(31));
  std::vector<loop::Effect> effects = loop::candidate_effects(geometry);
  std::erase_if(effects, [&](const loop::Effect&) { return random() % 3 == 0; });
  // terms of what is left may be of any order
  effects.push_back({loop::find_family("unnamed"), loop::FlankChoice::kLeft, {1.0, 0.0, 77.0, 1.0}});
  expect_the_same_together(geometry, effects, places_of(geometry, random));
}

// Every candidate, and forms of the kinds that are a form times a factor of the tooth.
TEST(PreparedEffects, AreTheSameBits) {
  std::mt19937 random(20260162);
  for (const MadeGear& made : {spur(24), ring(60), helical(131, -25.0)}) {
    const loop::FlankGeometry geometry = geometry_of(made);
    std::vector<loop::Effect> effects = loop::candidate_effects(geometry);
    for (const auto flank :
         {loop::FlankChoice::kBoth, loop::FlankChoice::kLeft, loop::FlankChoice::kRight}) {
      effects.push_back({loop::find_family("unnamed_sector"), flank, {4, 6, 0, 1, 0}});
      effects.push_back({loop::find_family("unnamed_drift_of_some"), flank, {4, 9, 0, 1, 0, 1}});
      effects.push_back({loop::find_family("unnamed_wave_of_some"), flank, {3, 11, 4.4, 1}});
      effects.push_back({loop::find_family("unnamed"), flank, {2, 1, 5, 1}});
      effects.push_back({loop::find_family("unnamed"), flank, {1, 2, 0, 1}});
    }
    const std::vector<loop::Place> places = places_of(geometry, random);
    for (const loop::Effect& effect : effects) {
      const loop::PreparedEffect prepared(geometry, effect);
      ASSERT_EQ(prepared.columns(), effect.columns());
      for (const loop::Place& place : places) {
        double once[8], alone[8];
        prepared.evaluate(place, once);
        effect.evaluate(geometry, place, alone);
        for (int k = 0; k < effect.columns(); ++k)
          ASSERT_EQ(once[k], alone[k]) << effect.family->id << " column " << k;
      }
    }
  }
}

}  // namespace
}  // namespace trueflank::test
