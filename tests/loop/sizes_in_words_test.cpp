// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes and places in words: those that the flank and the gear have, and of many flanks once.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/words_of_forms.h"
#include "trueflank/loop/gear/local/loud_places.h"

namespace trueflank::test {
namespace {

using loop::FlankChoice;
using testing::HasSubstr;

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
  EXPECT_THAT(
      said_of(g, effect_of("unnamed_marks", {1.5, -4.0, 3.0})),
      testing::AllOf(HasSubstr("1.5 over the profile"), HasSubstr("4.0 over the face, 2.5 mm each"),
                     HasSubstr("rising towards the tip"),
                     HasSubstr("3 periods a turn, towards the upper end")));
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
