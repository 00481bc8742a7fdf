// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

/// Where the sections stand on the axis from which the others are moved.
constexpr double kLowerEnd = -1.0, kMiddle = 0.0, kUpperEnd = 1.0, kBothEnds = 2.0;

/// How far sections are moved along the height (-1 ... 1): 1 where it is most.
double moved(double v, double held) {
  if (held == kBothEnds) return 1.0 - v * v;
  if (held == kMiddle) return v * v;
  const double share = 0.5 * (held == kLowerEnd ? 1.0 + v : 1.0 - v);
  return share * share;
}

/// Which sections a soft shift moves: those above and those below in opposite ways, or one of them.
constexpr double kBothParts = 0.0, kUpperPart = 1.0, kLowerPart = -1.0;

const char* held_where(double held) {
  return held == kLowerEnd   ? "from the lower end on"
         : held == kUpperEnd ? "from the upper end on"
         : held == kMiddle   ? "to both sides of the middle"
                             : "between its ends";
}

}  // namespace

/// Told in place of eccentricities, tilts and steps that follow it (one_form.cpp), and no
/// candidate of its own.
EffectFamily unnamed_bow() {
  EffectFamily f = described("unnamed_bow", {"held_at"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    two_directions(g, p, moved(g.face_coordinate(p.z_mm), shape[0]), c);
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    for (const double held : {kLowerEnd, kMiddle, kUpperEnd, kBothEnds})
      if (held != shape[0]) shapes.push_back({held});
    return shapes;
  };
  f.term_keys = {{"held_at"}};
  f.words = [](const ToldForm& told) {
    return std::string("the axis of the teeth is bent ") + held_where(told.shape[0]) +
           in_direction(told.direction_rad());
  };
  return f;
}

/// Told in place of what moves sections piece by piece (whole_forms.cpp,
/// one_form.cpp), and no candidate of its own.
EffectFamily unnamed_axis_kink() {
  EffectFamily f = described("unnamed_axis_kink", {"height_mm", "towards"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const double end_mm = shape[1] > 0.0 ? g.face_width_mm() : 0.0;
    two_directions(g, p, std::max(0.0, (p.z_mm - shape[0]) / (end_mm - shape[0])), c);
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.faces_a_direction = true;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kEnds =
        0.06;  // of the face: nearer to one it is a lean of all of it, or nothing
    std::vector<EffectShape> shapes;
    const double face_mm = g.face_width_mm();
    for (const double off : {-0.05, -0.02, -0.007, -0.002, 0.002, 0.007, 0.02, 0.05})
      shapes.push_back(
          {std::clamp(shape[0] + off * face_mm, kEnds * face_mm, (1.0 - kEnds) * face_mm),
           shape[1]});
    return shapes;
  };
  f.term_keys = {number("height_mm"), {"towards"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool up = shape[1] > 0.0;
    return printed("the axis of the teeth has a kink at a height of %.3g mm: ", shape[0]) +
           (up ? "straight below it, from there to the upper end it leans away"
               : "straight above it, from there to the lower end it leans away") +
           in_direction(told.direction_rad()) + ", by that much at the end";
  };
  return f;
}

/// Told in place of what moves sections piece by piece (whole_forms.cpp), and no candidate of its
/// own: a sharp one is a layer shift.
EffectFamily unnamed_soft_shift() {
  EffectFamily f = described("unnamed_soft_shift", {"height_mm", "half_mm", "moves"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const double off = std::tanh((p.z_mm - shape[0]) / shape[1]);
    two_directions(g, p, shape[2] == 0.0 ? off : 0.5 * (1.0 + shape[2] * off), c);
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.faces_a_direction = true;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    // Of the face: nearer to an end, or softer, it is a lean; sharper than that no heights tell.
    constexpr double kEnds = 0.06, kSharpest = 0.01, kSoftest = 0.4;
    const double face_mm = g.face_width_mm();
    std::vector<EffectShape> shapes;
    for (const double off : {-0.05, -0.02, -0.007, -0.002, 0.002, 0.007, 0.02, 0.05})
      shapes.push_back(
          {std::clamp(shape[0] + off * face_mm, kEnds * face_mm, (1.0 - kEnds) * face_mm), shape[1],
           shape[2]});
    for (const double times : {0.7, 0.9, 0.97, 0.99, 1.01, 1.03, 1.1, 1.4})
      shapes.push_back({shape[0],
                        std::clamp(times * shape[1], kSharpest * face_mm, kSoftest * face_mm),
                        shape[2]});
    for (const double moves : {kBothParts, kUpperPart, kLowerPart})
      if (moves != shape[2]) shapes.push_back({shape[0], shape[1], moves});
    return shapes;
  };
  f.term_keys = {number("height_mm"), number("half_mm"), {"moves"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool both = shape[2] == kBothParts;
    return printed("whole sections slide aside softly about a height of %.3g mm, ", shape[0]) +
           printed("three quarters of it within %.3g mm to both sides: those ", shape[1]) +
           (shape[2] == kLowerPart ? "below" : "above") + " stand aside" +
           in_direction(told.direction_rad()) +
           (both ? ", those below by as much the other way" : ", the others do not") +
           " (a part that crept or was pushed while it was made)";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
