// SPDX-License-Identifier: GPL-3.0-or-later
// Hollows and swellings of every flank about a place of it.
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

/// A hollow or swelling about a place of the flank, a function of how far off it is over profile
/// and face, in half lengths.
template <class Function>
EffectFamily about_a_place(const std::string& id, Function function, const std::string& how) {
  EffectFamily f = described(id, {"diameter_mm", "height_mm", "half_profile_mm", "half_mm"});
  f.one_flank_too = true;
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.evaluate = [function](const FlankGeometry& g, const Place& p, const EffectShape& shape,
                          double* c) {
    c[0] = p.surface == Surface::kFlank
               ? function((p.roll_mm - stands_at(g, 0.0, shape[0])) / shape[2],
                          (p.z_mm - shape[1]) / shape[3])
               : 0.0;
  };
  f.needs = [](const EffectShape&) {
    return NeedsToBeSeen{.along_profile = true, .along_face = true};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    const auto add = [&](std::size_t k, double value) {
      shapes.push_back(shape);
      shapes.back()[k] = value;
    };
    const auto [low, high] = std::minmax({g.root_form_roll_mm(), g.tip_form_roll_mm()});
    for (const double share : {-0.3, -0.1, -0.03, 0.03, 0.1, 0.3}) {
      const double roll = stands_at(g, 0.0, shape[0]) + share * shape[2];
      add(0, 2.0 * g.on_flank(1, 1, std::clamp(roll, low, high), 0.0).radius_mm);
      add(1, std::clamp(shape[1] + share * shape[3], 0.0, g.face_width_mm()));
    }
    for (const std::size_t k : {2U, 3U})
      for (const double times : {0.7, 0.88, 0.96, 1.04, 1.14, 1.43}) add(k, times * shape[k]);
    return shapes;
  };
  f.term_keys = {number("diameter_mm"), number("height_mm"), number("half_profile_mm"),
                 number("half_mm")};
  f.words = [how](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const FlankGeometry& g = told.geometry;
    return "the same on every tooth, " + a_swelling(told.sign()) +
           printed(" of the flank at a diameter of %.5g mm and a height of %.3g mm, ", shape[0],
                   shape[1]) +
           within(g, 0.0, shape[2], "", " to either side") + " and " +
           within(g, 1.0, shape[3], "", " of the face to either side") + how;
  };
  return f;
}

}  // namespace

/// Ends over the profile and over the face by itself.
EffectFamily unnamed_dish() {
  return about_a_place(
      "unnamed_dish",
      [](double profile, double face) {
        return std::exp(-profile * profile) * std::exp(-face * face);
      },
      "");
}

/// A cap with an edge: what a ball or a drum lays open.
EffectFamily unnamed_patch() {
  return about_a_place(
      "unnamed_patch",
      [](double profile, double face) {
        return std::max(0.0, 1.0 - profile * profile - face * face);
      },
      ", with an edge there");
}

}  // namespace trueflank::loop::gear_effects
