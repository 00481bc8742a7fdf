// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {

/// What dies away from an end of the teeth (-1: the lower one, 1: the upper one) and is most on the
/// teeth towards one direction: nothing on those opposite (`opposite` 0), or as much of the other
/// sign there (1). Told in place of a foot of all teeth and forms once per turn, which follow it
/// (whole_forms.cpp), and no candidate of its own.
EffectFamily unnamed_one_side() {
  EffectFamily f =
      described("unnamed_one_side", {"end", "dies_within_mm", "towards_deg", "opposite"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double around = std::cos(g.centre_rad(p.tooth) - rad_from_deg(shape[2]));
    c[0] = std::exp(-std::abs(p.z_mm - end_mm(g, 1.0, shape[0])) / shape[1]) *
           (shape[3] != 0.0 ? around : 0.5 * (1.0 + around));
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.faces_a_direction = true;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    // Longer ones are nearly a slope or a bow, which come once per turn as well.
    constexpr double kMostOfFace = 0.3;
    std::vector<EffectShape> shapes;
    for (const double times : {0.7, 0.85, 0.95, 0.98, 1.02, 1.05, 1.18, 1.43})
      if (times * shape[1] <= kMostOfFace * g.face_width_mm())
        shapes.push_back({shape[0], times * shape[1], shape[2], shape[3]});
    for (const double off : {-20.0, -7.0, -2.0, -0.7, 0.7, 2.0, 7.0, 20.0})
      shapes.push_back({shape[0], shape[1], shape[2] + off, shape[3]});
    return shapes;
  };
  f.term_keys = {{"end"}, number("dies_within_mm"), number("towards_deg"), {"opposite"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return std::string("dies away from the ") + (shape[0] < 0.0 ? "lower" : "upper") + " end " +
           printed("within %.2g mm, most on the teeth ", shape[1]) +
           gear_effects::towards(shape[2]) +
           (shape[3] != 0.0 ? ", of the other sign opposite" : ", none opposite") +
           there("there", told.sign(), false) +
           (shape[0] < 0.0 ? " (a foot of one side: the plate is not level)" : "");
  };
  return f;
}

/// Swellings evenly spaced around the gear, or one, that die away from an end of the teeth: corners
/// that lift from the plate, marks of ejectors or bolts. By the direction in which a place lies.
/// Told in place of waves around the gear over the face and a foot of all teeth, which follow them
/// (forms_around.cpp), and no candidate of its own.
EffectFamily unnamed_swellings_at_end() {
  EffectFamily f = described("unnamed_swellings_at_end",
                             {"number", "at_deg", "half_deg", "end", "dies_within_mm"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    constexpr double kNothing = 6.0;  // half widths
    const double apart = kTwoPi / shape[0], half = rad_from_deg(shape[2]);
    const double from = p.polar_rad - rad_from_deg(shape[1]);
    const double off = from - apart * std::round(from / apart);
    for (const double next : {-apart, 0.0, apart})
      if (const double times = (off + next) / half; std::abs(times) < kNothing)
        c[0] += std::exp(-times * times);
    if (c[0] == 0.0) return;
    c[0] *= std::exp(-std::abs(p.z_mm - end_mm(g, 1.0, shape[3])) / shape[4]);
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.faces_a_direction = true;
  f.is_followed_nearly = true;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kMostOfFace = 0.5;  // of the face
    std::vector<EffectShape> shapes;
    const double apart_deg = 360.0 / shape[0];
    for (const double off : {-0.5, -0.15, -0.04, 0.0, 0.04, 0.15, 0.5})
      for (const double times : {0.8, 0.93, 0.98, 1.0, 1.02, 1.07, 1.25}) {
        EffectShape beside = shape;
        beside[1] = std::fmod(shape[1] + off * shape[2] + apart_deg, apart_deg);
        beside[2] = std::min(times * shape[2], 0.4 * apart_deg);
        if (beside != shape) shapes.push_back(std::move(beside));
      }
    for (const double times : {0.7, 0.85, 0.95, 0.98, 1.02, 1.05, 1.18, 1.43})
      if (times * shape[4] <= kMostOfFace * g.face_width_mm()) {
        shapes.push_back(shape);
        shapes.back()[4] *= times;
      }
    return shapes;
  };
  f.term_keys = {
      {"number"}, number("at_deg"), number("half_deg"), {"end"}, number("dies_within_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const int sign = told.sign();
    const char* end = shape[3] < 0.0 ? "lower" : "upper";
    std::string text = shape[0] == 1.0 ? a_swelling(sign)
                                       : printed("%.0f ", shape[0]) +
                                             (sign > 0   ? "swellings"
                                              : sign < 0 ? "hollows"
                                                         : "swellings or hollows") +
                                             " evenly spaced around the gear";
    return text + printed(
                      " at the %s end, dying away within %.2g mm of height, %s%.0f deg, "
                      "%.2g deg to either side, as from corners that warp, ejectors or bolts",
                      end, shape[4], shape[0] == 1.0 ? "at " : "one at ", shape[1], shape[2]);
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
