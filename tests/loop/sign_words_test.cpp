// SPDX-License-Identifier: GPL-3.0-or-later
// Forms without a name in words: where there is more material.
#include <gmock/gmock.h>

#include <set>

#include "tests/loop/forms_in_words.h"

namespace trueflank::test {
namespace {

using loop::EffectShape;
using loop::FlankChoice;
using testing::HasSubstr;
using testing::Not;

double at(const loop::FlankGeometry& g, const loop::Effect& effect, const FormInWords& form) {
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
  for (const FormInWords& form : forms_in_words(g)) {
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
  for (const FormInWords& form : forms_in_words(g)) known.insert(form.family);
  for (const loop::EffectFamily& family : loop::effect_library()) {
    if (family.named) continue;
    // (a patch is a dish with an edge; the others have two coefficients)
    static const std::set<std::string> kOther{
        "unnamed_crossed_order", "unnamed_crossed_waves", "unnamed_body_wave", "unnamed_patch",
        "unnamed_waviness", "unnamed_marks", "unnamed_waves_from", "unnamed_waves_mirrored",
        "unnamed_waves_dying", "unnamed_waves_growing", "unnamed_walking_waves",
        "unnamed_waves_changing", "unnamed_waves_burst", "unnamed_bow", "unnamed_axis_kink",
        "unnamed_field", "unnamed_facing", "unnamed_moved_sector", "unnamed_drift_aside",
        "unnamed_broken_wave", "unnamed_stairs", "unnamed_wave_of_some", "unnamed_pattern",
        "unnamed_plane_wave", "unnamed_plane_saw", "unnamed_plane_stripes", "unnamed_changing_wave",
        // (play is said by its axis; the words of those of some teeth are those of all)
        "unnamed_wobble", "unnamed_reversal", "unnamed_kink_of_teeth", "unnamed_bend_of_teeth",
        "unnamed_waviness_of_teeth", "unnamed_dish_of_teeth", "unnamed_slanted_ridge_of_teeth",
        "unnamed_corner_of_teeth", "unnamed_moved_part", "unnamed_soft_shift",
        "unnamed_stretching_wave", "unnamed_clamping", "unnamed_halves"};
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
  EXPECT_THAT(said_of(g, effect_of("unnamed_body_wave", {3, 1, 4, 0, 1, 0, 0}), {0, 4}),
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
