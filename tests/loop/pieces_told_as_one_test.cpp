// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/part/drifts.h"
#include "trueflank/loop/gear/part/fields.h"
#include "trueflank/loop/gear/part/forms_of_teeth.h"
#include "trueflank/loop/gear/part/names.h"
#include "trueflank/loop/gear/part/odd_forms.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"

// An answer in pieces, as the choice may come to, and what is told instead: asked by itself, as no
// search needs to come to the pieces first.
namespace trueflank::test {
namespace {

using loop::Effect;
using loop::EffectShape;
using loop::FlankChoice;

Effect piece(const char* family, EffectShape shape, FlankChoice flank = FlankChoice::kBoth) {
  return {loop::find_family(family), flank, std::move(shape)};
}
Effect term(double profile, double face, double order = 0.0, double opposite = 0.0) {
  return piece("unnamed", {profile, face, order, opposite});
}

/// A scan of a gear that was made so, and pieces that are told of it.
class Pieces {
 public:
  Pieces(const MadeGear& gear, const Process& made, std::vector<Effect> pieces, int points = 3000)
      : geometry_(geometry_of(gear)) {
    loop::MeasuredData data;
    data.scans.push_back(scan_of(gear, {made}, scanned(points, 1.0, 1)));
    model_.emplace(geometry_, *make_observations(geometry_, data, {.aligned = true}),
                   loop::PartOptions());
    divide_into_patches(*model_);
    model_->unseen = model_->banned;
    model_->effects = std::move(pieces);
    model_->discovery.chosen.resize(model_->effects.size());
  }
  loop::PartModel& operator*() { return *model_; }
  [[nodiscard]] const std::vector<Effect>& told() const { return model_->effects; }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const Effect& effect : told()) {
      text += effect.family->id + (effect.flank == FlankChoice::kBoth ? "" : " of one flank");
      for (const double value : effect.shape) text += " " + std::to_string(value);
      text += "; ";
    }
    return text;
  }
  [[nodiscard]] bool has(const char* family) const {
    return std::any_of(told().begin(), told().end(), [&](const Effect& effect) {
      return effect.family == loop::find_family(family);
    });
  }

 private:
  loop::FlankGeometry geometry_;
  std::optional<loop::PartModel> model_;
};

/// Teeth gone from this one on: 0 ... z - 1.
double gone(const MadeGear& gear, int tooth, int first) {
  return (tooth - first + gear.teeth) % gear.teeth;
}

TEST(PiecesToldAsOne, WavesAroundTheGearThatAreADriftBesideACrowning) {
  const MadeGear gear = spur(20);
  for (const double lean : {0.0, 1.0}) {
    const auto made = [=](const MadeGear& g, const FlankSpot& s, auto&) {
      return (20.0 * gone(g, s.tooth, 6) / g.teeth - 10.0) * (lean > 0.0 ? s.u : 1.0) +
             8.0 * (1.0 - s.v * s.v);
    };
    Pieces pieces(
        gear, grown(made),
        {term(lean, 0.0, 1.0), piece("crowning", {}), term(lean, 0.0, 2.0), term(lean, 0.0, 3.0)});
    EXPECT_TRUE(tell_as_drift(*pieces));
    ASSERT_EQ(pieces.told().size(), 2U) << pieces.text();
    EXPECT_TRUE(pieces.has("crowning")) << pieces.text();
    EXPECT_TRUE(pieces.has("unnamed_ramp")) << pieces.text();
    EXPECT_EQ(pieces.told().back().shape[0], 6.0) << pieces.text();
  }
}

TEST(PiecesToldAsOne, ALevelAndADriftAboutItsMeanThatBeginWithNothing) {
  const MadeGear gear = spur(20);
  const auto made = [](const MadeGear& g, const FlankSpot& s, auto&) {
    return 20.0 * (1.0 - std::exp(-gone(g, s.tooth, 6) / 5.0));
  };
  const std::vector<Effect> level_and_drift{
      term(0.0, 0.0),
      piece("unnamed_levelling", {6.0, 0.0, 0.0, 0.0, 0.0, 5.0, loop::gear_effects::kMeanOfDrift})};
  for (const bool turned : {false, true}) {
    std::vector<Effect> both = level_and_drift;
    if (turned) std::swap(both[0], both[1]);
    Pieces pieces(gear, grown(made), both);
    EXPECT_TRUE(tell_as_drift(*pieces));
    ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
    EXPECT_EQ(pieces.told().front().shape[6], loop::gear_effects::kFirstOfDrift) << pieces.text();
  }
}

TEST(PiecesToldAsOne, EqualAndOppositeCoursesThatAreOneOfOneFlank) {
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return s.side < 0 ? 14.0 * std::exp(-(1.0 - s.v) / 0.35) : 0.0;
  };
  Pieces pieces(spur(20), grown(made),
                {term(0.0, 1.0), term(0.0, 1.0, 0.0, 1.0), term(0.0, 2.0), term(0.0, 2.0, 0.0, 1.0),
                 term(0.0, 0.0), term(0.0, 0.0, 0.0, 1.0)});
  tell_as_one_form(*pieces);
  ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
  EXPECT_EQ(pieces.told().front().flank, FlankChoice::kRight) << pieces.text();
}

TEST(PiecesToldAsOne, FormsOncePerTurnThatAreABentAxis) {
  const auto made = [](const MadeGear& g, const FlankSpot& s, auto&) {
    const Vec3 n = normal_at(g, s);
    return 16.0 * (1.0 - s.v * s.v) * (n[0] * std::cos(0.7) + n[1] * std::sin(0.7));
  };
  Pieces pieces(spur(20), grown(made),
                {term(0.0, 0.0, 1.0), term(0.0, 2.0, 1.0), term(0.0, 0.0, 1.0, 1.0),
                 term(0.0, 2.0, 1.0, 1.0)});
  tell_as_one_form(*pieces);
  ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
  EXPECT_TRUE(pieces.has("unnamed_bow")) << pieces.text();
}

TEST(PiecesToldAsOne, FormsOfAToothThatAreALeanOfEitherFlank) {
  for (const int side : {1, -1}) {
    const auto made = [=](auto&, const FlankSpot& s, auto&) {
      return s.tooth == 5 && s.side == side ? 9.0 * s.u : 0.0;
    };
    const FlankChoice flank = side > 0 ? FlankChoice::kLeft : FlankChoice::kRight;
    Pieces pieces(spur(16), grown(made),
                  {piece("unnamed_tooth_form", {5.0, 0.0, 0.0, 0.0}, flank),
                   piece("unnamed_tooth_form", {5.0, 1.0, 0.0, 0.0}, flank),
                   piece("unnamed_tooth_form", {5.0, 2.0, 0.0, 0.0}, flank)},
                  6000);
    tell_forms_of_teeth(*pieces);
    ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
    EXPECT_EQ(pieces.told().front().shape, (EffectShape{5.0, 1.0, 0.0, 0.0})) << pieces.text();
  }
}

TEST(PiecesToldAsOne, BowsOfNeighbouringTeethThatAreAGroove) {
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return s.tooth >= 9 && s.tooth <= 11 ? -14.0 * std::exp(-std::pow((s.u - 0.2) / 0.25, 2)) : 0.0;
  };
  std::vector<Effect> bows;
  for (const double tooth : {9.0, 10.0, 11.0})
    for (const double degree : {0.0, 2.0})
      bows.push_back(piece("unnamed_tooth_form", {tooth, degree, 0.0, 0.0}));
  Pieces pieces(spur(20), grown(made), bows, 6000);
  tell_forms_of_some_teeth(*pieces);
  ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
  EXPECT_EQ(pieces.told().front().shape[0], 9.0) << pieces.text();
  EXPECT_EQ(pieces.told().front().shape[1], 3.0) << pieces.text();
}

TEST(PiecesToldAsOne, TwoPartsOfTheGearThatLeanAlike) {
  const auto made = [](auto&, const FlankSpot& s, auto&) { return 8.0 * s.v; };
  Pieces pieces(spur(20), grown(made),
                {piece("unnamed_sector", {4.0, 12.0, 0.0, 1.0, 0.0}),
                 piece("unnamed_sector", {16.0, 8.0, 0.0, 1.0, 0.0})});
  tell_names_in_two_parts(*pieces);
  ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
  EXPECT_TRUE(pieces.has("taper")) << pieces.text();
}

TEST(PiecesToldAsOne, WavesThatAreTheSideTowardsOneDirectionBesideACrowning) {
  const auto made = [](const MadeGear& g, const FlankSpot& s, auto&) {
    const Vec3 n = normal_at(g, s);
    const double facing = n[0] * std::cos(2.0) + n[1] * std::sin(2.0);
    return (facing > 0.0 ? 20.0 * facing : 0.0) + 8.0 * (1.0 - s.v * s.v);
  };
  std::vector<Effect> waves{term(0.0, 0.0), piece("crowning", {})};
  for (const double order : {1.0, 2.0})
    for (const double opposite : {0.0, 1.0}) waves.push_back(term(0.0, 0.0, order, opposite));
  Pieces pieces(spur(20), grown(made), waves);
  EXPECT_TRUE(tell_as_facing(*pieces));
  EXPECT_TRUE(pieces.has("crowning")) << pieces.text();
  EXPECT_TRUE(pieces.has("unnamed_facing_one_side")) << pieces.text();
  EXPECT_TRUE(std::none_of(pieces.told().begin(), pieces.told().end(), [](const Effect& effect) {
    return effect.order() > 0.0;
  })) << pieces.text();
}

// A slope that the teeth do not share, or that is the mean of a drift, is no cause; a larger one
// beside the same is.
TEST(PiecesToldAsOne, ASlopeIsNoCauseWhereItIsAMean) {
  for (const double slope : {4.0, 24.0}) {
    const auto in_turn = [=](auto&, const FlankSpot& s, auto&) {
      return (slope + (s.tooth % 3 == 1 ? 24.0 : -12.0)) * s.v;
    };
    Pieces turns(spur(21), grown(in_turn), {piece("taper", {})});
    tell_what_teeth_do_not_share(*turns);
    EXPECT_EQ(turns.told().front().family->named, slope > 20.0) << turns.text();
    const auto drifts = [=](const MadeGear& g, const FlankSpot& s, auto&) {
      return (slope + 16.0 * gone(g, s.tooth, 1) / g.teeth - 8.0) * s.v;
    };
    Pieces drift(spur(20), grown(drifts),
                 {piece("taper", {}), piece("unnamed_ramp", {1.0, 0.0, 1.0, 0.0})});
    tell_means_of_odd_forms(*drift);
    EXPECT_EQ(drift.told().front().family->named, slope > 20.0) << drift.text();
  }
}

}  // namespace
}  // namespace trueflank::test
