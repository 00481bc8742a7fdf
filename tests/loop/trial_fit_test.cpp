// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/trial_fit.h"

#include <gtest/gtest.h>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/point_fit.h"
#include "trueflank/loop/gear/shape_refinement.h"

// Trial fits against the fit that sums everything anew.
namespace trueflank::test {
namespace {

using loop::Effect;

const loop::EffectFamily* family(const std::string& id) {
  for (const auto& known : loop::effect_library())
    if (known.id == id) return &known;
  return nullptr;
}

class TrialFits : public ::testing::Test {
 protected:
  TrialFits() {
    const auto wavy = grown([](const MadeGear& gear, const FlankSpot& s, const Vec3&) {
      return 5.0 * std::cos(2.0 * M_PI * s.v * 0.5 * gear.face_mm / 3.1);
    });
    loop::MeasuredData data;
    data.scans.push_back(scan_of(gear_, {wavy}, {.points = 6000, .noise_um = 2.0}));
    table_ = *make_observations(geometry_, data, {.aligned = true});
    patches_ = make_patches(geometry_, table_);
  }
  static Effect wave(double length_mm) {
    return {family("unnamed_waviness"), loop::FlankChoice::kBoth, {1.0, length_mm}};
  }
  double square(const std::vector<Effect>& effects) const {
    return loop::PointFit(geometry_, table_, patches_, effects).residual_square();
  }

  MadeGear gear_ = spur(24);
  loop::FlankGeometry geometry_ = geometry_of(gear_);
  loop::Observations table_;
  loop::Patches patches_;
};

TEST_F(TrialFits, SquaresAndCoefficientsAreThoseOfTheWholeFit) {
  const std::vector<Effect> effects{{family("eccentricity"), loop::FlankChoice::kBoth, {}},
                                    wave(3.3), wave(1.7)};
  loop::TrialFit trial(geometry_, table_, patches_, effects);
  const loop::PointFit whole(geometry_, table_, patches_, effects);
  EXPECT_NEAR(trial.residual_square() / whole.residual_square(), 1.0, 1e-9);
  for (std::size_t e = 0; e < effects.size(); ++e)
    for (int k = 0; k < effects[e].columns(); ++k) {
      const int column = whole.first_column(static_cast<int>(e)) + k;
      EXPECT_NEAR(trial.coefficients(e)[k], whole.coefficients()[column], 1e-8);
      EXPECT_LE(trial.as_is(e).retained, whole.retained(column) * (1.0 + 1e-6));
    }
  std::vector<Effect> other = effects;
  other[1].shape[1] = 3.1;
  EXPECT_NEAR(trial.with_shapes(1, {other[1].shape}, 0.0).front().square / square(other), 1.0, 1e-9);
  trial.set_shapes(other);
  EXPECT_NEAR(trial.residual_square() / square(other), 1.0, 1e-9);
}

TEST_F(TrialFits, ColumnsThatWereTriedAreThoseOfTheirEffectAndNoOther) {
  loop::TriedColumns tried;
  const std::vector<Effect> effects{wave(3.3), wave(1.7)};
  loop::TrialFit knowing(geometry_, table_, patches_, effects, 1, &tried);
  const loop::TrialFit fresh(geometry_, table_, patches_, effects);
  const std::vector<loop::EffectShape> shapes{{1.0, 3.1}, {1.0, 3.2}};
  for (int turn = 0; turn < 2; ++turn) {  // the second time they are known
    const auto trials = knowing.with_shapes(0, shapes, 0.0), anew = fresh.with_shapes(0, shapes, 0.0);
    for (std::size_t i = 0; i < shapes.size(); ++i) EXPECT_EQ(trials[i].square, anew[i].square);
  }
  ASSERT_NE(tried.find(wave(3.1)), nullptr);
  EXPECT_EQ(*tried.find(wave(3.1)), fresh.columns_of(wave(3.1)));
  EXPECT_EQ(tried.find(wave(3.15)), nullptr);
  Effect on_one_flank = wave(3.1);
  on_one_flank.flank = loop::FlankChoice::kLeft;
  EXPECT_EQ(tried.find(on_one_flank), nullptr);
  knowing.set_shapes({wave(3.2), wave(1.7)});
  EXPECT_NEAR(knowing.residual_square() / square({wave(3.2), wave(1.7)}), 1.0, 1e-9);
}

TEST_F(TrialFits, OneFitKnowsTheSquareWithoutAnyOfItsEffects) {
  const std::vector<Effect> effects{{family("eccentricity"), loop::FlankChoice::kBoth, {}},
                                    wave(3.3), wave(1.7)};
  const loop::PointFit fit(geometry_, table_, patches_, effects);
  EXPECT_EQ(fit.residual_square({true, true, true}), fit.residual_square());
  EXPECT_NEAR(fit.residual_square({true, false, true}) / square({effects[0], effects[2]}), 1.0,
              1e-9);
  EXPECT_NEAR(fit.residual_square({false, false, false}) / square({}), 1.0, 1e-9);
}

TEST_F(TrialFits, TwoWavesDoNotMeetAtOneLength) {
  std::vector<Effect> effects{wave(3.0), wave(3.6)};
  EXPECT_TRUE(loop::refine_nearby(geometry_, table_, patches_, effects));
  const loop::TrialFit fit(geometry_, table_, patches_, effects);
  EXPECT_NEAR(std::min(effects[0].shape[1], effects[1].shape[1]), 3.1, 0.1);
  EXPECT_GE(fit.as_is(0).retained, loop::kToldApart);
  EXPECT_LT(fit.coefficients(0).norm(), 10.0);
  // The same two at nearly one length are told apart by nothing.
  effects[0].shape[1] = 3.1;
  effects[1].shape[1] = 3.11;
  EXPECT_LT(loop::TrialFit(geometry_, table_, patches_, effects).as_is(1).retained,
            loop::kToldApart);
}

TEST_F(TrialFits, WhatStandsBeforeTheFirstStaysAsItIs) {
  std::vector<Effect> effects{{family("elephant_foot"), loop::FlankChoice::kBoth, {0.6}},
                              {family("elephant_foot"), loop::FlankChoice::kBoth, {1.5}}};
  loop::refine_shapes(geometry_, table_, patches_, effects, 1);
  EXPECT_EQ(effects[0].shape[0], 0.6);
  EXPECT_NE(effects[1].shape[0], 1.5);
}

TEST(Patches, LeftOutForOneStepGetTheirWeightBackForAnother) {
  loop::Patches patches;
  for (const double z : {1.0, 2.0, 3.0}) {
    loop::Patches::Patch patch;
    patch.weight = 4.0;
    patch.z_low_mm = z - 0.4;
    patch.z_high_mm = z + 0.4;
    patches.patches.push_back(patch);
  }
  for (int round = 0; round < 3; ++round) patches.leave_out_across({1.1});
  EXPECT_DOUBLE_EQ(patches.patches[0].weight, 4e-6);
  patches.leave_out_across({2.1, 1.9});
  EXPECT_DOUBLE_EQ(patches.patches[0].weight, 4.0);
  EXPECT_DOUBLE_EQ(patches.patches[1].weight, 4e-6);
  EXPECT_DOUBLE_EQ(patches.patches[2].weight, 4.0);
  patches.leave_out_across({});
  EXPECT_DOUBLE_EQ(patches.patches[1].weight, 4.0);
}

}  // namespace
}  // namespace trueflank::test
