// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

/// Whole sections stand aside in waves over the height: to and fro towards one direction (`turns`
/// 0), or all around, with the height counter-clockwise (1) or clockwise (-1). Told in place of
/// eccentricities, tilts, steps and forms once per turn, which follow it piece by piece
/// (whole_forms.cpp), and no candidate of its own.
EffectFamily unnamed_wobble() {
  EffectFamily f = described("unnamed_wobble", {"wavelength_mm", "towards_deg", "turns"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double angle = kTwoPi * p.z_mm / shape[0], cosine = std::cos(angle),
                 sine = std::sin(angle);
    if (shape[2] == 0.0) {
      const double direction = rad_from_deg(shape[1]);
      const double part = normal_part(g, p, std::cos(direction), std::sin(direction));
      c[0] = part * cosine;
      c[1] = part * sine;
    } else {
      c[0] = normal_part(g, p, cosine, shape[2] * sine);
      c[1] = normal_part(g, p, -sine, shape[2] * cosine);
    }
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.faces_a_direction = true;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    for (const double times : {0.97, 0.99, 0.997, 0.999, 1.001, 1.003, 1.01, 1.03})
      shapes.push_back({times * shape[0], shape[1], shape[2]});
    if (shape[2] == 0.0)
      for (const double off : {-20.0, -7.0, -2.0, -0.7, 0.7, 2.0, 7.0, 20.0})
        shapes.push_back({shape[0], shape[1] + off, shape[2]});
    return shapes;
  };
  f.term_keys = {number("wavelength_mm"), number("towards_deg"), {"turns"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const std::string waves = printed("in waves over the height, %.3g mm long, ", shape[0]);
    return "whole sections stand aside " + waves +
           (shape[2] == 0.0
                ? gear_effects::towards(shape[1]) + " and back"
                : std::string("all around, ") +
                      (shape[2] > 0.0 ? "counter-clockwise" : "clockwise") + " with the height") +
           " (a lead screw that wobbles, a guide that is not straight)";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
