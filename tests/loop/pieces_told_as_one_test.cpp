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
#include "trueflank/loop/gear/part/forms_around.h"
#include "trueflank/loop/gear/part/forms_of_teeth.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/names/names.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/names/settled_names.h"
#include "trueflank/loop/gear/part/odd_forms.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/single_teeth.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/part/tidying.h"
#include "trueflank/loop/gear/part/waves.h"

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
      : Pieces(gear, std::vector<Process>{made}, std::move(pieces), points) {}
  Pieces(const MadeGear& gear, const std::vector<Process>& made, std::vector<Effect> pieces,
         int points = 3000)
      : geometry_(geometry_of(gear)) {
    loop::MeasuredData data;
    data.scans.push_back(scan_of(gear, made, scanned(points, 1.0, 1)));
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

/// Of what levels off from a tooth on.
double levelled_um(const MadeGear& gear, int tooth) {
  return 20.0 * (1.0 - std::exp(-gone(gear, tooth, 6) / 5.0));
}
Effect levelling(double zero) {
  return piece("unnamed_levelling", {6.0, 0.0, 0.0, 0.0, 0.0, 5.0, zero});
}

TEST(PiecesToldAsOne, ALevelAndADriftAboutItsMeanThatBeginWithNothing) {
  const MadeGear gear = spur(20);
  const auto made = [](const MadeGear& g, const FlankSpot& s, auto&) {
    return levelled_um(g, s.tooth) + 5.0 * s.v;
  };
  for (const bool turned : {false, true}) {
    std::vector<Effect> both{term(0.0, 0.0), piece("taper", {}),
                             levelling(loop::gear_effects::kMeanOfDrift)};
    if (turned) std::swap(both[0], both[2]);
    Pieces pieces(gear, grown(made), both);
    EXPECT_TRUE(tell_as_drift(*pieces));
    ASSERT_EQ(pieces.told().size(), 2U) << pieces.text();
    EXPECT_TRUE(pieces.has("taper")) << pieces.text();
    EXPECT_EQ(pieces.told().back().shape[6], loop::gear_effects::kFirstOfDrift) << pieces.text();
  }
}

// A taper is no level beside it; a level that neither end explains makes it one about its mean.
TEST(PiecesToldAsOne, ADriftBeginsWithNothingUntilALevelSaysOtherwise) {
  for (const bool level : {false, true}) {
    const auto made = [=](const MadeGear& g, const FlankSpot& s, auto&) {
      return levelled_um(g, s.tooth) + (level ? 40.0 : 5.0 * s.v);
    };
    Pieces pieces(spur(20), grown(made),
                  {level ? term(0.0, 0.0) : piece("taper", {}),
                   levelling(loop::gear_effects::kFirstOfDrift)});
    EXPECT_EQ(tell_as_drift(*pieces), level) << pieces.text();
    ASSERT_EQ(pieces.told().size(), 2U) << pieces.text();
    EXPECT_EQ(pieces.told().back().shape[6],
              level ? loop::gear_effects::kMeanOfDrift : loop::gear_effects::kFirstOfDrift)
        << pieces.text();
  }
}

// What leads drift by is opposite on the flanks; a taper is alike on them, and no mean of that.
TEST(PiecesToldAsOne, ADriftOfLeadsLeavesATaperAsItIs) {
  const auto made = [](const MadeGear& g, const FlankSpot& s, auto&) {
    return (s.side * levelled_um(g, s.tooth) + 6.0) * s.v;
  };
  const auto drift = [](double zero) {
    return piece("unnamed_levelling", {6.0, 0.0, 1.0, 1.0, 0.0, 5.0, zero});
  };
  const auto wave = [](double order) { return term(0.0, 1.0, order, 1.0); };
  Pieces whole(spur(20), grown(made),
               {piece("taper", {}), drift(loop::gear_effects::kFirstOfDrift)});
  EXPECT_FALSE(tell_as_drift(*whole)) << whole.text();
  EXPECT_EQ(whole.told().back().shape[6], loop::gear_effects::kFirstOfDrift) << whole.text();
  // one that grows to nothing at its last tooth
  const auto ends = [](const MadeGear& g, const FlankSpot& s, auto&) {
    const double left = g.teeth - 1.0 - gone(g, s.tooth, 10);
    return (25.0 * s.side * (std::exp(-left / 8.0) - 1.0) + 6.0) * s.v;
  };
  Pieces waves(spur(16), grown(ends),
               {wave(0.0), wave(1.0), piece("taper", {}), wave(2.0), wave(3.0)});
  tell_as_one_form(*waves);
  EXPECT_EQ(waves.told().size(), 2U) << waves.text();
  EXPECT_TRUE(waves.has("taper")) << waves.text();
  EXPECT_TRUE(waves.has("unnamed_levelling")) << waves.text();
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
    return s.tooth >= 9 && s.tooth <= 13 ? -14.0 * std::exp(-std::pow((s.u - 0.2) / 0.25, 2)) : 0.0;
  };
  std::vector<Effect> bows;
  for (const double tooth : {9.0, 10.0, 11.0, 12.0, 13.0})
    for (const double degree : {0.0, 2.0})
      bows.push_back(piece("unnamed_tooth_form", {tooth, degree, 0.0, 0.0}));
  Pieces pieces(spur(20), grown(made), bows, 6000);
  tell_forms_of_some_teeth(*pieces);
  ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
  EXPECT_EQ(pieces.told().front().shape[0], 9.0) << pieces.text();
  EXPECT_EQ(pieces.told().front().shape[1], 5.0) << pieces.text();
}

/// Heights and leans over the profile of both flanks of a tooth.
std::vector<Effect> heights_and_leans(double tooth) {
  std::vector<Effect> pieces;
  for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
    pieces.push_back(piece("unnamed_flank", {tooth}, flank));
    pieces.push_back(piece("unnamed_tooth_form", {tooth, 1.0, 0.0, 0.0}, flank));
  }
  return pieces;
}

TEST(PiecesToldAsOne, HeightsAndLeansOfBothFlanksThatAreOneBentTooth) {
  struct Made {
    double nothing_at, opposite;
  };
  for (const Made& of : {Made{-1.0, 1.0}, Made{-1.0, 0.0}, Made{1.0, 0.0}}) {
    const auto made = [=](auto&, const FlankSpot& s, auto&) {
      return s.tooth != 5
                 ? 0.0
                 : 15.0 * (1.0 - of.nothing_at * s.u) * (of.opposite != 0.0 ? s.side : 1.0);
    };
    Pieces pieces(spur(16), grown(made), heights_and_leans(5.0), 6000);
    tell_one_tooth_or_gap(*pieces);
    ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
    EXPECT_TRUE(pieces.has("unnamed_bent_tooth")) << pieces.text();
    EXPECT_EQ(pieces.told().front().shape, (EffectShape{5.0, 0.0, of.nothing_at, 1.0, of.opposite}))
        << pieces.text();
  }
}

TEST(PiecesToldAsOne, AToothThatStandsAsideAndLeansByAnotherAmountIsNoBentTooth) {
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return s.tooth == 5 ? s.side * (24.0 + 8.0 * s.u) : 0.0;
  };
  Pieces pieces(
      spur(16), grown(made),
      {piece("unnamed_tooth_aside", {5.0, 1.0}), piece("unnamed_tooth_form", {5.0, 1.0, 0.0, 1.0})},
      6000);
  tell_one_tooth_or_gap(*pieces);
  EXPECT_EQ(pieces.told().size(), 2U) << pieces.text();
}

TEST(PiecesToldAsOne, FlanksOfTwoTeethThatAreTheWallsOfOneGap) {
  const std::vector<Effect> walls{piece("unnamed_flank", {16.0}, FlankChoice::kLeft),
                                  piece("unnamed_flank", {1.0}, FlankChoice::kRight)};
  for (const double right : {20.0, -20.0, 8.0}) {
    const auto made = [=](auto&, const FlankSpot& s, auto&) {
      return s.tooth == 16 && s.side > 0 ? 20.0 : s.tooth == 1 && s.side < 0 ? right : 0.0;
    };
    Pieces pieces(spur(16), grown(made), walls, 6000);
    tell_one_tooth_or_gap(*pieces);
    if (right == 8.0) {  // (walls of two sizes are no one cause)
      EXPECT_EQ(pieces.told().size(), 2U) << pieces.text();
      continue;
    }
    ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
    EXPECT_TRUE(pieces.has("unnamed_gap")) << pieces.text();
    EXPECT_EQ(pieces.told().front().shape, (EffectShape{16.0, right < 0.0 ? 1.0 : 0.0}));
  }
}

TEST(PiecesToldAsOne, FlanksThatAreOfTwoGapsStayTwo) {
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return (s.tooth == 5 && s.side > 0) || (s.tooth == 9 && s.side < 0) ? 20.0 : 0.0;
  };
  Pieces pieces(spur(16), grown(made),
                {piece("unnamed_flank", {5.0}, FlankChoice::kLeft),
                 piece("unnamed_flank", {9.0}, FlankChoice::kRight)},
                6000);
  tell_one_tooth_or_gap(*pieces);
  EXPECT_EQ(pieces.told().size(), 2U) << pieces.text();
}

TEST(PiecesToldAsOne, SpotsOfNeighbouringTeethThatAreOneSwelling) {
  const MadeGear gear = spur(24);
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    const auto bell = [](double off) { return std::exp(-off * off); };
    return s.side > 0 ? 30.0 * bell((s.tooth - 9.3) / 1.6) * bell((s.u - 0.2) / 0.45) *
                            bell((s.v + 0.1) / 0.5)
                      : 0.0;
  };
  const double diameter = 2.0 * gear.reference(), height = 0.45 * gear.face_mm;
  std::vector<Effect> spots;
  for (const double tooth : {8.0, 9.0, 10.0, 11.0})
    spots.push_back(piece("unnamed_spot",
                          {tooth, diameter, height, 0.8 * gear.module_mm, 0.5 * gear.face_mm, 1.0},
                          FlankChoice::kLeft));
  Pieces pieces(gear, grown(made), spots, 20000);
  tell_one_tooth_or_gap(*pieces);
  ASSERT_EQ(pieces.told().size(), 1U) << pieces.text();
  EXPECT_TRUE(pieces.has("unnamed_swelling_over_teeth")) << pieces.text();
  EXPECT_NEAR(pieces.told().front().shape[0], 9.3, 0.2) << pieces.text();
  EXPECT_NEAR(pieces.told().front().shape[1], 1.6, 0.3) << pieces.text();
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
                 {piece("taper", {}), piece("unnamed_ramp", {1.0, 0.0, 1.0, 0.0, 0.0})});
    tell_means_of_odd_forms(*drift);
    EXPECT_EQ(drift.told().front().family->named, slope > 20.0) << drift.text();
  }
}

TEST(PiecesToldAsOne, WavesAndALevelThatAreACombBesideATaper) {
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return (s.tooth % 4 == 3 ? 12.0 : 0.0) + 5.0 * s.v;
  };
  Pieces pieces(spur(20), grown(made),
                {piece("taper", {}), term(0.0, 0.0), term(0.0, 0.0, 5.0), term(0.0, 0.0, 10.0)});
  EXPECT_TRUE(tell_as_repeating(*pieces));
  EXPECT_TRUE(pieces.has("taper")) << pieces.text();
  EXPECT_TRUE(pieces.has("unnamed_comb")) << pieces.text();
  EXPECT_EQ(pieces.told().size(), 2U) << pieces.text();
}

// What stands before it in the answer says nothing of it.
TEST(PiecesNamed, ABendThatIsATipReliefBesideATaper) {
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return 5.0 * s.v - 12.0 * std::pow(std::max(0.5 * (s.u + 1.0) - 0.5, 0.0) / 0.5, 2);
  };
  const loop::FlankGeometry geometry = geometry_of(spur(20));
  for (const Effect& bend : loop::forms_along(geometry, 0.0, FlankChoice::kBoth, false)) {
    if (bend.family != loop::find_family("unnamed_bend") || bend.shape[2] != 1.0) continue;
    Pieces pieces(spur(20), grown(made), {piece("taper", {}), bend});
    name_forms_beside_names(*pieces);
    EXPECT_TRUE(pieces.has("tip_relief")) << pieces.text();
    EXPECT_TRUE(pieces.has("taper")) << pieces.text();
    break;
  }
}

TEST(PiecesNamed, AWaveOfThePitchBesideADriftOfOneFlank) {
  const auto made = [](const MadeGear& g, const FlankSpot& s, auto&) {
    return s.side * 6.0 * std::cos(4.0 * M_PI * s.tooth / g.teeth) +
           (s.side > 0 ? levelled_um(g, s.tooth) : 0.0);
  };
  Effect drift = levelling(loop::gear_effects::kFirstOfDrift);
  drift.flank = FlankChoice::kLeft;
  Pieces pieces(spur(20), grown(made), {drift, term(0.0, 0.0, 2.0, 1.0)});
  name_what_is_settled(*pieces);
  EXPECT_TRUE(pieces.has("pitch_wave")) << pieces.text();
}

TEST(PiecesNamed, ASagThatIsASlopeAndABow) {
  const auto made = [](auto&, const FlankSpot& s, auto&) {
    return 6.0 * s.u + 9.0 * (1.0 - s.u * s.u);
  };
  Pieces pieces(
      spur(20), grown(made),
      {loop::sags_along(geometry_of(spur(20)), 0.0, FlankChoice::kBoth).back(), term(0.0, 0.0)});
  name_what_is_settled(*pieces);
  // (a scale beside a level slopes over the profile, too)
  EXPECT_TRUE(pieces.has("profile_crowning")) << pieces.text();
  EXPECT_FALSE(pieces.has("unnamed_sag")) << pieces.text();
}

// It moves the whole gear: folds that hold a few odd teeth predict it badly. One that is not there
// is not taken up.
TEST(PiecesNamed, AnEccentricityThatWentIsTakenUpAgainWhereItIsThere) {
  for (const bool off_axis : {true, false}) {
    const auto crowned = [](auto&, const FlankSpot& s, auto&) { return 8.0 * (1.0 - s.v * s.v); };
    std::vector<Process> made{grown(crowned)};
    if (off_axis) made.push_back(off_centre(12.0, 40.0));
    Pieces pieces(spur(20), made, {piece("crowning", {})});
    EXPECT_EQ(take_up_again(*pieces, {piece("eccentricity", {})}), off_axis);
  }
}

// Equal slopes of all flanks and one of the flanks of one side are opposite slopes, and the other
// way round.
TEST(PiecesNamed, ANameAndThatOfOneSideThatAreAThirdName) {
  for (const bool turned : {false, true})
    for (const FlankChoice side : {FlankChoice::kLeft, FlankChoice::kRight})
      for (const bool equal : {true, false}) {
        const auto made = [=](auto&, const FlankSpot& s, auto&) {
          return 6.0 * s.v * (equal ? s.side : 1.0) + 3.0 * s.u;
        };
        std::vector<Effect> names{piece(equal ? "taper" : "helix_error", {}),
                                  piece(equal ? "taper" : "helix_error", {}, side),
                                  piece("pressure_angle_error", {})};
        if (turned) std::reverse(names.begin(), names.end());
        Pieces pieces(spur(20), grown(made), names);
        tell_two_names_as_one(*pieces);
        EXPECT_EQ(pieces.told().size(), 2U) << pieces.text();
        EXPECT_TRUE(pieces.has(equal ? "helix_error" : "taper")) << pieces.text();
        EXPECT_TRUE(pieces.has("pressure_angle_error")) << pieces.text();
        for (const Effect& effect : pieces.told())
          EXPECT_EQ(effect.flank, FlankChoice::kBoth) << pieces.text();
      }
}

// Two slopes of sizes that no third name has stay two, of all flanks.
TEST(PiecesNamed, ANameAndThatOfOneSideThatAreTwoNamesOfAllFlanks) {
  for (const bool turned : {false, true})
    for (const FlankChoice side : {FlankChoice::kLeft, FlankChoice::kRight}) {
      const double of_side = side == FlankChoice::kLeft ? 1.0 : -1.0;
      const auto made = [=](auto&, const FlankSpot& s, auto&) {
        return (8.0 + (s.side == of_side ? 5.0 : 0.0)) * s.v;
      };
      std::vector<Effect> names{piece("taper", {}), piece("taper", {}, side)};
      if (turned) std::reverse(names.begin(), names.end());
      Pieces pieces(spur(20), grown(made), names);
      tell_two_names_as_one(*pieces);
      ASSERT_EQ(pieces.told().size(), 2U) << pieces.text();
      tell_one_flank_as_two_names_of_all(*pieces);
      ASSERT_EQ(pieces.told().size(), 2U) << pieces.text();
      EXPECT_TRUE(pieces.has("taper")) << pieces.text();
      EXPECT_TRUE(pieces.has("helix_error")) << pieces.text();
      for (const Effect& effect : pieces.told())
        EXPECT_EQ(effect.flank, FlankChoice::kBoth) << pieces.text();
    }
}

// Three waves of like size, none a multiple of the lowest, are one odd form; one by itself, one far
// larger than the others, and the multiples of jaws are waves.
TEST(PiecesToldAsOne, WavesOfThePitchThatAreOneOddForm) {
  struct Case {
    std::vector<double> orders, sizes_um;
    bool odd;
  };
  for (const Case& each : {Case{{2.0, 3.0, 5.0}, {6.0, 5.0, 5.0}, true}, Case{{2.0}, {6.0}, false},
                           Case{{2.0, 3.0, 5.0}, {20.0, 1.0, 1.0}, false},
                           Case{{3.0, 6.0, 9.0}, {8.0, 5.0, 4.0}, false}}) {
    const auto made = [&](const MadeGear& g, const FlankSpot& s, auto&) {
      double sum = 0.0;
      for (std::size_t k = 0; k < each.orders.size(); ++k)
        sum += each.sizes_um[k] * std::cos(2.0 * M_PI * each.orders[k] * s.tooth / g.teeth);
      return s.side * sum;
    };
    std::vector<Effect> waves{piece("taper", {})};
    for (const double order : each.orders) waves.push_back(piece("pitch_wave", {order}));
    Pieces pieces(spur(24), grown(made), waves);
    tell_waves_of_a_form(*pieces);
    EXPECT_TRUE(pieces.has("taper")) << pieces.text();
    // (the largest of them)
    EXPECT_EQ(pieces.told()[1].family->named, !each.odd) << pieces.text();
  }
}

// The false alarm rate is that of all tables together.
TEST(PiecesToldAsOne, NeighboursShareWhereChanceDoesNotAmongAllTables) {
  Pieces pieces(spur(20), grown([](auto&, auto&, auto&) { return 0.0; }), {piece("taper", {})},
                500);
  for (const int tables : {1, 2, 5})
    for (const double share : {0.1, 0.9, 1.1, 1.9, 6.0}) {
      (*pieces).options.tables = tables;
      loop::SharedByNeighbours shared;
      shared.p_value = share * 0.002 / tables;
      EXPECT_EQ(is_shared(*pieces, shared), share < 1.0) << tables << " " << share;
      (*pieces).neighbours = shared;
      EXPECT_EQ(neighbours_share(*pieces), share < 1.0) << tables << " " << share;
    }
}

}  // namespace
}  // namespace trueflank::test
