// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

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

const char* held_where(double held) {
  return held == kLowerEnd   ? "from the lower end on"
         : held == kUpperEnd ? "from the upper end on"
         : held == kMiddle   ? "to both sides of the middle"
                             : "between its ends";
}

}  // namespace

/// Told in place of eccentricities, tilts and steps that follow it (part_loop_one_form.cpp), and no
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

}  // namespace trueflank::loop::gear_effects
