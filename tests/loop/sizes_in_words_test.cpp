// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes and places in words: those that the flank and the gear have, and of many flanks once.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>

#include "tests/loop/words_of_forms.h"
#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/local/loud_places.h"

namespace trueflank::test {
namespace {

using loop::FlankChoice;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Slopes with a name are from end to end: so is what is said of those without.
TEST(SizesInWords, SayWhatALeanOrABowComesToFromEndToEnd) {
  const auto g = geometry_of(spur(24));
  std::mt19937_64 random(7);
  const auto column = [&](const loop::Effect& effect, double u, double v) {
    double c[2] = {0.0, 0.0};
    const double low = g.root_form_roll_mm(), high = g.tip_form_roll_mm();
    effect.evaluate(g,
                    g.on_flank(5, 1, 0.5 * (low + high) + 0.5 * u * (high - low),
                               0.5 * (1.0 + v) * g.face_width_mm()),
                    c);
    return c[0];
  };
  for (int draw = 0; draw < 6; ++draw) {
    const double um = std::uniform_real_distribution<double>(-20.0, 20.0)(random);
    for (const double opposite : {0.0, 1.0})
      for (const bool of_tooth : {false, true})
        for (const auto& [profile, face, words] :
             {std::tuple{1.0, 0.0, " um from root to tip"},
              std::tuple{0.0, 1.0, " um over the face"},
              std::tuple{2.0, 0.0, " um from the middle to root and tip"},
              std::tuple{0.0, 2.0, " um from the middle to the ends"}}) {
          const loop::Effect form =
              of_tooth ? effect_of("unnamed_tooth_form", {5, profile, face, opposite})
                       : effect_of("unnamed", {profile, face, 0, opposite});
          const bool bow = profile + face == 2.0;
          const double end = column(form, profile > 0.0 ? 1.0 : 0.0, face > 0.0 ? 1.0 : 0.0),
                       begin =
                           bow ? column(form, 0.0, 0.0)
                               : column(form, profile > 0.0 ? -1.0 : 0.0, face > 0.0 ? -1.0 : 0.0);
          EXPECT_THAT(said_of(g, form, {um}),
                      HasSubstr(printed(", by %.3g", std::abs(um * (end - begin))) + words));
          EXPECT_THAT(said_of(g, form), Not(HasSubstr(words)));
        }
  }
  EXPECT_THAT(said_of(g, effect_of("unnamed", {0, 1, 2, 0}), {3.0, 4.0}),
              HasSubstr("by 10 um over the face"));
}

TEST(SizesInWords, AreBoundedByTheFlankAndTheGear) {
  const auto g = geometry_of(spur(24));
  const double d = 2.0 * g.reference_radius_mm();
  ASSERT_NEAR(g.face_width_mm(), 10.0, 1e-9);
  const auto spot = [&](double height, double wide) {
    return said_of(
        g, effect_of("unnamed_spot", {5, d, height, 0.0, wide, 0.0}, FlankChoice::kRight), {4.0});
  };
  EXPECT_THAT(spot(4.0, 190.0),
              HasSubstr("part of the right flank of tooth 5, over the whole face"));
  EXPECT_THAT(spot(9.0, 8.0), HasSubstr("over the upper 5 mm of the face"));
  EXPECT_THAT(
      spot(4.0, 1.0),
      HasSubstr("a lump on the right flank of tooth 5, at a height of 4 mm, 1 mm over the face"));
  EXPECT_THAT(
      said_of(g, effect_of("unnamed_spot", {5, d, 4.0, 50.0, 190.0, 0.0}, FlankChoice::kLeft),
              {-4.0}),
      testing::StrEq("the left flank of tooth 5 lies back"));
  EXPECT_THAT(said_of(g, effect_of("unnamed_band", {1, -0.06, 1.7, 0}), {4.0}),
              HasSubstr("a ridge over the face at the lower end"));
  const auto dent = [&](double tooth, double half) {
    return said_of(g, effect_of("unnamed_dent", {tooth, half, 0.0, 0.0}), {4.0});
  };
  EXPECT_THAT(dent(25.2, 0.7), HasSubstr("a swelling at tooth 1, hardly at those beside it"));
  EXPECT_THAT(dent(0.3, 2.8), HasSubstr("about tooth 24, 3 teeth to either side"));
  EXPECT_THAT(dent(5.0, 40.0), HasSubstr("around the gear, most about tooth 5"));
}

TEST(SizesInWords, AreSaidOfWavesAlongOneDirectionByThatAlone) {
  const auto g = geometry_of(spur(24));
  EXPECT_THAT(said_of(g, effect_of("unnamed_marks", {0.016, -4.0, 0.0})),
              testing::StartsWith("4.0 waves over the face, 2.5 mm long, the same on every tooth"));
  EXPECT_THAT(said_of(g, effect_of("unnamed_marks", {1.5, -4.0, 3.0})),
              AllOf(HasSubstr("1.5 over the profile"), HasSubstr("4.0 over the face, 2.5 mm each"),
                    HasSubstr("rising towards the tip"),
                    HasSubstr("3 periods a turn, towards the upper end")));
}

TEST(SizesInWords, SayWhatEveryToothOfAPatternHas) {
  const auto g = geometry_of(spur(24));
  EXPECT_THAT(said_of(g, effect_of("unnamed_pattern", {4, 22, 1, 0.5, -1.5, 0.5, 0.5}), {2.0}),
              AllOf(HasSubstr("the teeth stand aside in a pattern that repeats every 4 teeth, "
                              "from tooth 22 on, most at tooth 23 and every 4 teeth after it: 3 um "
                              "clockwise; its teeth, one after the other: 1, -3, 1 and 1 um, + is "
                              "counter-clockwise"),
                    HasSubstr("as from a cutter of so many teeth")));
  EXPECT_THAT(said_of(g, effect_of("unnamed_pattern", {3, 24, 0, -1, 2, -1}), {2.0}),
              HasSubstr("most at tooth 1 and every 3 teeth after it: 4 um out"));
  double column = 7.0;
  const auto pattern = effect_of("unnamed_pattern", {4, 22, 1, 0.5, -1.5, 0.25, 0.75});
  const double middle = 0.5 * (g.root_form_roll_mm() + g.tip_form_roll_mm());
  for (const auto& [tooth, value] :
       {std::pair{22, 0.5}, {23, -1.5}, {24, 0.25}, {1, 0.75}, {2, 0.5}})
    for (const int side : {1, -1}) {
      pattern.evaluate(g, g.on_flank(tooth, side, middle, 5.0), &column);
      EXPECT_EQ(column, side * value) << tooth;
    }
}

TEST(SizesInWords, SayHowHighEveryStepIs) {
  const auto g = geometry_of(spur(24));
  EXPECT_THAT(
      said_of(g, effect_of("unnamed_stairs", {20, 3, 12, 0}), {3.0, -1.5}),
      HasSubstr("the height goes in steps: against teeth 20 to 2, teeth 3 to 11 stand out by 3 "
                "um and teeth 12 to 19 lie back by 1.5 um"));
  EXPECT_THAT(said_of(g, effect_of("unnamed_stairs", {1, 9, 17, 1}), {-3.0, 1.0}),
              HasSubstr("teeth 9 to 16 stand clockwise by 3 um and teeth 17 to 24 stand "
                        "counter-clockwise by 1 um"));
  EXPECT_THAT(said_of(g, effect_of("unnamed_stairs", {1, 9, 17, 1})),
              HasSubstr("teeth 9 to 16 and teeth 17 to 24 differ from teeth 1 to 8"));
  double columns[2] = {7.0, 7.0};
  const auto stairs = effect_of("unnamed_stairs", {20, 3, 12, 0});
  const double middle = 0.5 * (g.root_form_roll_mm() + g.tip_form_roll_mm());
  for (const auto& [tooth, first, second] :
       {std::tuple{19, 0.0, 1.0}, {20, 0.0, 0.0}, {2, 0.0, 0.0}, {3, 1.0, 0.0}, {12, 0.0, 1.0}}) {
    stairs.evaluate(g, g.on_flank(tooth, 1, middle, 5.0), columns);
    EXPECT_EQ(columns[0], first) << tooth;
    EXPECT_EQ(columns[1], second) << tooth;
  }
}

TEST(LinesOfWavesThatRunBackwards, AreSaidOnlyWhereAllDo) {
  const MadeGear gear = spur(67);
  const auto ghost = [](double order, double way) {
    return grown([order, way](const MadeGear& g, const FlankSpot& s, auto&) {
      const double from = roll_of_radius(g, g.root_form_mm), to = roll_of_radius(g, g.tip_mm);
      const double turned = (from + 0.5 * (s.u + 1.0) * (to - from)) / g.base();
      return 5.0 * std::cos(order * (2.0 * M_PI * (s.tooth - 1) / g.teeth + way * s.side * turned));
    });
  };
  InspectionOptions options = traced({1, 14, 27, 41, 54}, 0.4, 7);
  const auto count = [](const loop::LoopResult& result) {
    return std::count_if(result.effects.begin(), result.effects.end(), [](const auto& effect) {
      return effect.description.find("counted clockwise") != std::string::npos;
    });
  };
  const auto alone = close(gear, inspection_of(gear, {ghost(174.0, 1.0)}, options));
  EXPECT_EQ(count(alone), 1) << list(alone);
  const auto beside =
      close(gear, inspection_of(gear, {ghost(174.0, 1.0), ghost(120.0, -1.0)}, options));
  EXPECT_GE(beside.effects.size(), 2U) << list(beside);
  EXPECT_EQ(count(beside), 0) << list(beside);
}

TEST(NotesOnLouderFlanks, AreOneForManyTeeth) {
  std::vector<loop::LouderPlace> places;
  for (int tooth = 3; tooth <= 9; ++tooth)
    places.push_back({.flank = FlankChoice::kLeft, .tooth = tooth, .times = 2.0 + 0.3 * tooth});
  places.push_back({.flank = FlankChoice::kRight,
                    .over_face = true,
                    .low_mm = 1.0,
                    .high_mm = 2.0,
                    .times = 3.0});
  const auto notes = loop::notes_on(places);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_THAT(notes[0], HasSubstr("on all right flanks between heights of 1 and 2 mm"));
  EXPECT_THAT(
      notes[1],
      HasSubstr("on teeth 3 to 9 (left flanks), points of the scan scatter 2.9 to 4.7 times"));
  places.resize(2);
  EXPECT_EQ(loop::notes_on(places).size(), 2U);
}

}  // namespace
}  // namespace trueflank::test
