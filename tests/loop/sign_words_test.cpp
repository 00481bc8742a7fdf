// SPDX-License-Identifier: GPL-3.0-or-later
// Forms without a name in words: where there is more material.
#include <gmock/gmock.h>

#include <set>

#include "tests/loop/words_of_forms.h"

namespace trueflank::test {
namespace {

using loop::EffectShape;
using loop::FlankChoice;
using testing::HasSubstr;
using testing::Not;

/// A form of one coefficient, what is said of it with a positive and a negative one, and a place
/// that this speaks of: tooth, side, profile and face coordinate.
struct Told {
  std::string family;
  EffectShape shape;
  std::string positive, negative;
  int tooth, side;
  double u, v;
  FlankChoice flank = FlankChoice::kBoth;
};

/// Of a spur gear of 24 teeth and 10 mm.
std::vector<Told> forms(const loop::FlankGeometry& g) {
  const double d = 2.0 * g.reference_radius_mm();
  return {
      {"unnamed", {0, 0, 0, 0}, "flanks stand out", "flanks lie back", 3, 1, 0, 0},
      {"unnamed",
       {1, 0, 0, 0},
       "more material at the tip",
       "less material at the tip",
       3,
       -1,
       1,
       0},
      {"unnamed", {0, 2, 0, 0}, "more material at both ends", "less material at both", 3, 1, 0, -1},
      {"unnamed",
       {0, 1, 0, 1},
       "upper end stands counter-clockwise",
       "upper end stands clockwise",
       3,
       1,
       0,
       1},
      {"unnamed",
       {1, 1, 0, 0},
       "more material at the tip's upper corner",
       "less material at the tip's upper corner",
       3,
       1,
       1,
       1},
      {"unnamed_flank",
       {5},
       "tooth 5 stands out",
       "tooth 5 lies back",
       5,
       1,
       0,
       0,
       FlankChoice::kLeft},
      {"unnamed_tooth_aside", {5, 1}, "aside, counter-clockwise", "aside, clockwise", 5, 1, 0, 0},
      {"unnamed_tooth_aside", {5, -1}, "aside, clockwise", "aside, counter-clockwise", 5, -1, 0, 0},
      {"unnamed_step",
       {1, 4, 0, 0},
       "above it the flanks stand out",
       "above it the flanks lie back",
       3,
       1,
       0,
       0.5},
      {"unnamed_step",
       {0, d, 1, 0.4},
       "at larger diameters the teeth stand counter-clockwise",
       "the teeth stand clockwise",
       3,
       1,
       0.9,
       0},
      {"unnamed_kink",
       {1, 4, 1, 0},
       "towards the upper end: there the flanks stand out",
       "there the flanks lie back",
       3,
       1,
       0,
       0.9},
      {"unnamed_bend",
       {1, 6, 1, 0},
       "towards the upper end: there the flanks stand out",
       "there the flanks lie back",
       3,
       1,
       0,
       0.9},
      {"unnamed_rise",
       {1, 1, -1, 1},
       "opposite on the two flanks: there the teeth stand counter-clockwise",
       "the teeth stand clockwise",
       3,
       1,
       0,
       -1},
      {"unnamed_sag",
       {1, 6},
       "a swelling over the face from end to end, most at a height of 6 mm",
       "a hollow over the face from end to end",
       3,
       1,
       0,
       0.2},
      {"unnamed_fading_jump",
       {1, 4, 1, 1, 0, 0},
       "that dies away towards the upper end, within 1 mm: behind it the flanks stand out",
       "behind it the flanks lie back",
       3,
       1,
       0,
       0},
      {"unnamed_fading_jump",
       {0, d, 1, -1, 0.2, 1},
       "over 0.2 mm of roll length, that dies away towards the root, within 1 mm of roll length, "
       "opposite on the two flanks: behind it the teeth stand counter-clockwise",
       "behind it the teeth stand clockwise",
       3,
       1,
       -0.2,
       0},
      {"unnamed_skewed_band",
       {1, 4, 0.5, 2, 0},
       "a ridge over the face at a height of 4 mm, 0.5 mm downwards and 2 mm upwards",
       "a groove over the face",
       3,
       1,
       0,
       -0.2},
      {"unnamed_sawtooth",
       {1, 4, 3, 0},
       "a sawtooth over the face, period 3 mm, one of its jumps at a height of 4 mm: right above a "
       "jump the flanks stand out",
       "right above a jump the flanks lie back",
       3,
       1,
       0,
       -0.15},
      {"unnamed_arches",
       {1, 4, 3, 0},
       "scallops over the face, each 3 mm long, one of their edges at a height of 4 mm: between "
       "the "
       "edges the flanks stand out",
       "facets over the face, each 3 mm long, one of their edges at a height of 4 mm: between the "
       "edges the flanks lie back, as of a model or a path whose curves are polygons",
       3,
       1,
       0,
       0},
      {"unnamed_dish",
       {d, 5, 1, 2},
       "a swelling of the flank",
       "a hollow of the flank",
       3,
       1,
       0,
       0},
      {"unnamed_band", {1, 5, 1, 0}, "a ridge over the face", "a groove over the face", 3, 1, 0, 0},
      {"unnamed_strip", {1, 3, 7, 0.2, 0}, "stands out", "lies back", 3, 1, 0, 0},
      {"unnamed_corner",
       {1, 0, 2, 4, 1},
       "the tip and the lower end stands out",
       "the tip and the lower end lies back",
       3,
       1,
       0.99,
       -0.99},
      {"unnamed_product",
       {1, 1, -1, 2, 0},
       "an excess of material grows",
       "a lack of material grows",
       3,
       1,
       1,
       -1},
      {"unnamed_product",
       {1, 1, -1, 2, 1},
       "a turn of the teeth counter-clockwise grows",
       "a turn of the teeth clockwise grows",
       3,
       1,
       1,
       -1},
      {"unnamed_sector",
       {4, 3, 0, 0, 0},
       "on stands out on both flanks",
       "on lies back on both flanks",
       5,
       1,
       0,
       0},
      {"unnamed_soft_sector",
       {5.2, 4, 1, 1},
       "a sector of about 4 teeth around tooth 5.2, with soft edges, stands aside, "
       "counter-clockwise",
       "stands aside, clockwise",
       5,
       1,
       0,
       0},
      {"unnamed_sector",
       {4, 3, 0, 0, 1},
       "stands aside, counter-clockwise",
       "stands aside, clockwise",
       5,
       1,
       0,
       0},
      {"unnamed_sector",
       {4, 3, 0, 1, 0},
       "leans over the face: more material at the upper end",
       "less material at the upper end",
       5,
       1,
       0,
       1,
       FlankChoice::kLeft},
      {"unnamed_sector",
       {4, 3, 1, 0, 1},
       "leans over the profile: the tip stands counter-clockwise",
       "the tip stands clockwise",
       5,
       1,
       1,
       0},
      {"unnamed_alternation",
       {0, 2, 0},
       "odd number is bowed over the face: more material at both ends",
       "less material at both ends",
       5,
       1,
       0,
       1},
      {"unnamed_ramp",
       {1, 0, 0, 0, 0},
       "the height drifts evenly, towards more material",
       "towards less material",
       24,
       1,
       0,
       0},
      {"unnamed_levelling",
       {1, 0, 0, 1, 1, 3, 0},
       "the place of the teeth drifts more and more, counter-clockwise",
       "drifts more and more, clockwise",
       24,
       1,
       0,
       0},
      {"unnamed_drift_of_some",
       {5, 8, 0, 0, 1, 0},
       "over teeth 5 to 12 alone the place of the teeth drifts evenly, counter-clockwise, and "
       "jumps",
       "drifts evenly, clockwise",
       12,
       1,
       0,
       0},
      {"unnamed_drift_of_some",
       {20, 9, 0, 1, 0, 1},
       "over teeth 20 to 4 alone the lean over the face jumps, towards more material at the upper "
       "end",
       "towards less material at the upper end",
       20,
       1,
       0,
       1},
      {"unnamed_saw",
       {6, 1, 0, 1, 0, 0},
       "the lean over the face drifts evenly, towards more material at the upper end",
       "towards less material at the upper end",
       6,
       1,
       0,
       1},
      {"unnamed_drift_of_traces",
       {1, 0, 1, 3, 4, 9, 20},
       "the height drifts evenly, towards more material, from tooth 3 to tooth 20, from nothing on "
       "the first trace, of each tooth the left flank first",
       "the height drifts evenly, towards less material",
       9,
       1,
       0,
       0},
      {"unnamed_cut_order",
       {5, 1, 1, 0},
       "drifts from cut to cut, counter-clockwise, where teeth are cut in steps of 5: tooth 1",
       "drifts from cut to cut, clockwise",
       20,
       1,
       0,
       0},
      {"unnamed_slanted_ridge",
       {5, 4, 0, 1, 0, 0},
       "a ridge in a line aslant over the flanks, from a height of 3 mm at the root",
       "a groove in a line aslant over the flanks",
       3,
       1,
       0,
       0},
      {"unnamed_comb",
       {4, 2, 0, 0, 0},
       "from tooth 2 on, stands out on both flanks",
       "from tooth 2 on, lies back",
       6,
       1,
       0,
       0},
      {"unnamed_tooth_form",
       {5, 0, 1, 1},
       "tooth 5 alone leans over the face: the upper end stands counter-clockwise",
       "the upper end stands clockwise",
       5,
       1,
       0,
       1},
      {"unnamed_bent_tooth",
       {5, 0, -1, 1, 1},
       "tooth 5 alone is bent counter-clockwise: nothing at the root, 3 um at the tip",
       "tooth 5 alone is bent clockwise: nothing at the root, 3 um at the tip",
       5,
       1,
       1,
       0},
      {"unnamed_bent_tooth",
       {5, 1, 1, 2, 0},
       "tooth 5 alone is thicker towards the lower end: nothing at the upper end, 3 um at the "
       "lower end",
       "is thinner towards the lower end",
       5,
       -1,
       0,
       -1},
      {"unnamed_bent_tooth",
       {5, 0, 0, 2, 0},
       "tooth 5 alone is swollen: nothing at the root and the tip, 3 um between them",
       "is hollow",
       5,
       -1,
       0,
       0},
      {"unnamed_bent_tooth",
       {5, 0, -1, 1, 0},
       "tooth 5 alone stands out more and more towards the tip",
       "tooth 5 alone lies back more and more towards the tip",
       5,
       1,
       1,
       0,
       FlankChoice::kLeft},
      {"unnamed_gap",
       {24, 0},
       "the gap between teeth 24 and 1 alone is too narrow",
       "the gap between teeth 24 and 1 alone is too wide",
       1,
       -1,
       0,
       0},
      {"unnamed_gap",
       {5, 1},
       "the gap between teeth 5 and 6 stands aside, counter-clockwise",
       "the gap between teeth 5 and 6 stands aside, clockwise",
       5,
       1,
       0,
       0},
      {"unnamed_swelling_over_teeth",
       {5, 1.6, d, 1, 5, 3},
       "a swelling over a few teeth about tooth 5.0, 1.6 teeth to either side",
       "a hollow over a few teeth about tooth 5.0",
       5,
       1,
       0,
       0},
      {"unnamed_one_side",
       {-1, 2, 0, 0},
       "there the flanks stand out",
       "there the flanks lie back",
       1,
       1,
       0,
       -1},
      {"unnamed_crossed",
       {1, 0, 0, 0, 2, 5, 1, 0, 0},
       "the profile leans above a height of 5 mm only: at the tip the flanks stand out",
       "at the tip the flanks lie back",
       1,
       1,
       1,
       1},
      {"unnamed_crossed",
       {6, 24, 0, 0.5, 1, 0, 0, 0, 1},
       "the flanks slope over the face about a diameter of 24 mm, 0.5 mm of roll length to either "
       "side, opposite on the two flanks: at the upper end the teeth stand counter-clockwise",
       "at the upper end the teeth stand clockwise",
       1,
       1,
       0,
       1},
      {"unnamed_scallops",
       {0.5, 4, 0, 0},
       "the same on every tooth, scallops with sharp grooves between them, waves across the "
       "flanks, "
       "0.5 over the profile",
       "scallops with sharp ridges between them",
       1,
       1,
       -1,
       -0.75},
      {"unnamed_crossed_around",
       {5, 1, -1, 0, 0, 0, 0, 0, 0, 0, 30, 0},
       "on the teeth towards 30 deg and less and less to either side, none on the other half, "
       "dying "
       "away from the root within 1 mm of roll length: there the flanks stand out",
       "there the flanks lie back",
       1,
       1,
       -1,
       0},
      {"unnamed_crossed_around",
       {3, 23, 1, 0, 4, 2, -1, 0, 0, 2, 30, 40},
       "on 5 teeth from tooth 1 on, more and more evenly from a diameter of 23 mm on towards the "
       "tip, "
       "and that more and more by the square from a height of 2 mm on towards the lower end: there "
       "the flanks stand out",
       "there the flanks lie back",
       2,
       1,
       1,
       -1},
      {"unnamed_facing_one_side",
       {90, 1},
       "flanks that face towards 90 deg stand out",
       "flanks that face towards 90 deg lie back",
       1,
       1,
       0,
       0},
      {"unnamed_swellings_at_end",
       {2, 0, 20, -1, 3},
       "2 swellings evenly spaced around the gear at the lower end",
       "2 hollows evenly spaced",
       1,
       1,
       0,
       -1},
      {"unnamed_body_place",
       {1, 0, 15, 20, 0, 0, 0, 0, 5, 2, -1, 0, 0},
       "a swelling of the body towards 15 deg, 20 deg to either side, dying away from the lower "
       "end "
       "within 2 mm: there the teeth stand out",
       "a hollow of the body",
       2,
       1,
       0,
       -1},
      {"unnamed_body_place",
       {3, 1, 15, 20, 0, 0, 0, 0, 0, 0, 0, 0, 1},
       "3 swellings of the body evenly spaced around the gear, one towards 15 deg, 20 deg to "
       "either "
       "side, by 3 um of radius",
       "3 hollows of the body",
       2,
       1,
       0,
       -1},
      {"unnamed_step_of_teeth",
       {5, 1, 0, 1, 5, 0, 0},
       "on tooth 5 alone, a step over the face at a height of 5 mm: above it the flanks stand out",
       "above it the flanks lie back",
       5,
       1,
       0,
       0.9},
      {"unnamed_band_of_teeth",
       {4, 3, 0, 1, 5, 1},
       "on 3 teeth from tooth 4 on, a ridge over the face",
       "a groove over the face",
       5,
       1,
       0,
       0},
      {"unnamed_rise_of_teeth",
       {5, 1, 0, 1, 1, 1},
       "on tooth 5 alone, more and more over the face towards the upper end",
       "there the flanks lie back",
       5,
       1,
       0,
       1},
      {"unnamed_dent",
       {5.4, 2, 0, 0},
       "a swelling over a few teeth about tooth 5",
       "a hollow over a few teeth",
       5,
       1,
       0,
       0},
      {"unnamed_swellings",
       {3, 5.4, 2},
       "3 swellings evenly spaced around the gear, one over a few teeth about tooth 5",
       "3 hollows evenly spaced",
       5,
       1,
       0,
       0},
      {"unnamed_spot",
       {5, d, 5, 0.5, 1, 0},
       "a lump on the left flank",
       "a pit on the left flank",
       5,
       1,
       0,
       0,
       FlankChoice::kLeft},
  };
}

double at(const loop::FlankGeometry& g, const loop::Effect& effect, const Told& form) {
  const double low = g.root_form_roll_mm(), high = g.tip_form_roll_mm();
  double value = 0.0;
  effect.evaluate(g,
                  g.on_flank(form.tooth, form.side, low + 0.5 * (form.u + 1.0) * (high - low),
                             0.5 * (form.v + 1.0) * g.face_width_mm()),
                  &value);
  return value;
}

TEST(SignWords, SayOfEveryFormWhereThereIsMoreMaterial) {
  const auto g = geometry_of(spur(24));
  for (const Told& form : forms(g)) {
    const loop::Effect effect = effect_of(form.family, form.shape, form.flank);
    EXPECT_THAT(said_of(g, effect, {3.0}), HasSubstr(form.positive));
    EXPECT_THAT(said_of(g, effect, {-3.0}), HasSubstr(form.negative));
    EXPECT_THAT(said_of(g, effect), Not(HasSubstr("clockwise"))) << "of an unknown sign";
    // What is true of the place that the words speak of.
    const bool more_on_this_side =
        form.positive.find("aside, clockwise") == std::string::npos
            ? form.side > 0 || form.positive.find("clockwise") == std::string::npos
            : form.side < 0;
    EXPECT_EQ(at(g, effect, form) > 0.0, more_on_this_side) << form.family << " " << form.positive;
  }
}

TEST(SignWords, AreSaidOfEveryFormOfOneCoefficient) {
  const auto g = geometry_of(spur(24));
  std::set<std::string> known;
  for (const Told& form : forms(g)) known.insert(form.family);
  for (const loop::EffectFamily& family : loop::effect_library()) {
    if (family.named) continue;
    // (a patch is a dish with an edge; the others have two coefficients)
    static const std::set<std::string> kOther{
        "unnamed_crossed_order", "unnamed_crossed_waves", "unnamed_body_wave", "unnamed_patch",
        "unnamed_waviness", "unnamed_marks", "unnamed_waves_from", "unnamed_waves_mirrored",
        "unnamed_waves_dying", "unnamed_waves_growing", "unnamed_walking_waves",
        "unnamed_waves_changing", "unnamed_bow", "unnamed_axis_kink", "unnamed_field",
        "unnamed_facing", "unnamed_moved_sector", "unnamed_drift_aside", "unnamed_broken_wave",
        "unnamed_stairs", "unnamed_wave_of_some", "unnamed_pattern", "unnamed_plane_wave",
        "unnamed_plane_saw", "unnamed_changing_wave",
        // (play is said by its axis; the words of those of some teeth are those of all)
        "unnamed_wobble", "unnamed_reversal", "unnamed_kink_of_teeth", "unnamed_bend_of_teeth",
        "unnamed_waviness_of_teeth", "unnamed_dish_of_teeth"};
    EXPECT_TRUE(known.contains(family.id) || kOther.contains(family.id)) << family.id;
  }
  for (const loop::EffectFamily& named : loop::effect_library()) {
    const loop::EffectFamily* form = loop::find_form(named.form_word);
    if (form == nullptr) continue;
    EffectShape shape;
    if (named.shapes) shape = named.shapes(g).front();
    const loop::Effect effect{form, FlankChoice::kBoth, shape};
    EXPECT_THAT(said_of(g, effect), Not(HasSubstr("_"))) << named.id;
    if (form->columns(shape) != 1) continue;
    EXPECT_NE(said_of(g, effect, {3.0}), said_of(g, effect, {-3.0})) << named.id;
    EXPECT_THAT(said_of(g, effect, {3.0}), Not(HasSubstr("where positive"))) << named.id;
  }
}

TEST(SignWords, SayWhereAWaveIsLargest) {
  const auto g = geometry_of(spur(24));
  EXPECT_THAT(said_of(g, effect_of("unnamed", {0, 0, 2, 0}), {0.0, 5.0}),
              HasSubstr("the flanks stand out, most at 45 deg first"));
  EXPECT_THAT(said_of(g, effect_of("unnamed", {0, 1, 1, 1}), {-5.0, 0.0}),
              HasSubstr("the upper end stands counter-clockwise, most at 180 deg"));
  EXPECT_THAT(
      said_of(g, effect_of("unnamed_crossed_order", {0, 0, 0, 0, 5, 2, -1, 0, 1, 3}), {0, 4}),
      HasSubstr("3 times per turn, dying away from the lower end within 2 mm, opposite on "
                "the two flanks: there the teeth stand counter-clockwise, most at 30 deg "
                "first"));
  EXPECT_THAT(said_of(g, effect_of("unnamed_body_wave", {3, 1, 4, 0, 1, 0}), {0, 4}),
              HasSubstr("the gear is out of round 3 times per turn, more and more by the square "
                        "from the lower end on towards the upper end, by 4 um of radius at most, "
                        "at 30 deg first"));
  EXPECT_THAT(said_of(g, effect_of("unnamed_moved_sector", {5, 7}), {0.0, -4.0}),
              HasSubstr("7 teeth from tooth 5 on stand aside as one body, towards 270 deg"));
  EXPECT_THAT(
      said_of(g, effect_of("unnamed_waviness", {1, 2.5}), {0.0, 4.0}),
      HasSubstr("4.0 waves over the face, 2.5 mm long, the first crest at a height of 0.625 mm"));
}

}  // namespace
}  // namespace trueflank::test
