// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/taken_up.h"

// Figures that the choice of effects rests on, by their definitions.
namespace trueflank::test {
namespace {

using loop::Effect;
using loop::FlankChoice;

/// A scan of a gear that leans and is crowned, and three effects that say so.
class PartFigures : public ::testing::Test {
 protected:
  PartFigures() {
    loop::MeasuredData data;
    const auto made = [](auto&, const FlankSpot& s, auto&) {
      return 5.0 * s.v + 1.0 * (1.0 - s.v * s.v) + 3.0 * s.u;
    };
    data.scans.push_back(scan_of(gear_, {grown(made)}, scanned(2000, 2.0, 1)));
    model_.emplace(geometry_, *make_observations(geometry_, data, {.aligned = true}),
                   loop::PartOptions());
    divide_into_patches(*model_);
    for (const char* id : {"taper", "crowning", "pressure_angle_error"})
      model_->effects.push_back({loop::find_family(id), FlankChoice::kBoth, {}});
  }
  [[nodiscard]] loop::PointFit fit(const std::vector<Effect>& effects) const {
    return {geometry_, model_->table, model_->patches, effects};
  }

  MadeGear gear_ = spur(20);
  loop::FlankGeometry geometry_ = geometry_of(gear_);
  std::optional<loop::PartModel> model_;
};

TEST_F(PartFigures, LeastMissedIsTheEffectWithoutWhichTheSquaresGrowLeast) {
  const std::vector<Effect>& effects = model_->effects;
  const auto loss_without = [&](std::size_t e) {
    std::vector<Effect> others = effects;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
    return fit(others).residual_square() - fit(effects).residual_square();
  };
  const loop::LeastMissed of_all =
      least_missed(*model_, 0, effects.size(), [](const Effect&) { return true; });
  EXPECT_EQ(of_all.effect, 1U);
  EXPECT_NEAR(of_all.loss, loss_without(1), 1e-6 * loss_without(0));
  const loop::LeastMissed of_slopes =
      least_missed(*model_, 0, effects.size(),
                   [](const Effect& effect) { return effect.family->id != "crowning"; });
  EXPECT_EQ(of_slopes.effect, 2U);
  EXPECT_NEAR(of_slopes.loss, loss_without(2), 1e-6 * loss_without(0));
}

TEST_F(PartFigures, TheHoldOutBesideNoSingleToothIsTheHoldOut) {
  const loop::PointFit all = fit(model_->effects);
  const loop::PointFit::HeldOutBesideLocal beside = all.held_out_beside_local();
  EXPECT_TRUE(beside.fitted_there.empty());
  EXPECT_NEAR(beside.rms_um, all.errors({true, true, true}).held_out_rms_um, 1e-9);
  EXPECT_NEAR(beside.rms_um, 2.0, 0.4);  // the noise
}

/// Made so, told as a pressure angle beside waves over the profile of a length in lengths of it:
/// whether the name is banned, as its size hangs on these.
bool is_banned_beside_waves(double lengths, const Process& made) {
  const MadeGear gear = spur(20);
  const loop::FlankGeometry geometry = geometry_of(gear);
  loop::MeasuredData data;
  data.scans.push_back(scan_of(gear, {made}, scanned(2000, 1.0, 1)));
  loop::PartModel model(geometry, *make_observations(geometry, data, {.aligned = true}), {});
  divide_into_patches(model);
  const double profile_mm = std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
  model.effects = {
      {loop::find_family("pressure_angle_error"), FlankChoice::kBoth, {}},
      {loop::find_family("unnamed_waviness"), FlankChoice::kBoth, {0.0, lengths * profile_mm}}};
  model.discovery.chosen.resize(2);
  return ban_what_forms_explain(model);
}

// A long wave leans by itself: a name beside it that is nothing without it is a part of the wave.
TEST(NamesBesideWaves, AreBannedWhereTheirSizesHangOnThese) {
  constexpr double kLong = 1.3, kShort = 0.25;
  const auto wave =
      grown([](auto&, const FlankSpot& s, auto&) { return 12.0 * std::sin(M_PI / kLong * s.u); });
  const auto slope_and_wave = grown([](auto&, const FlankSpot& s, auto&) {
    return 6.0 * s.u + 3.0 * std::cos(M_PI / kShort * s.u);
  });
  EXPECT_TRUE(is_banned_beside_waves(kLong, wave));
  EXPECT_FALSE(is_banned_beside_waves(kShort, slope_and_wave));
}

}  // namespace
}  // namespace trueflank::test
