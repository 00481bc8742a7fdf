// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

/// 1 at the corner, 0 from the line on between where it ends along profile and face; in between a
/// plane (power 1), a parabola (2) or another power.
double of_corner(const FlankGeometry& g, const Place& p, const EffectShape& shape) {
  const double corner_mm = shape[0] != 0.0 ? g.tip_form_roll_mm() : g.root_form_roll_mm();
  const double end_mm = shape[1] != 0.0 ? g.face_width_mm() : 0.0;
  const double rest =
      1.0 - std::abs(p.roll_mm - corner_mm) / shape[2] - std::abs(p.z_mm - end_mm) / shape[3];
  return rest > 0.0 ? std::pow(std::min(rest, 1.0), shape[4]) : 0.0;
}

}  // namespace

/// Teeth that carry at one corner wear there. Told in place of slopes, twists and waves that follow
/// it (products.cpp), and no candidate of its own.
EffectFamily unnamed_corner() {
  EffectFamily f =
      described("unnamed_corner", {"at_tip", "at_upper_end", "profile_mm", "face_mm", "power"});
  f.one_flank_too = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank ? of_corner(g, p, shape) : 0.0;
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = [](const EffectShape&) {
    return NeedsToBeSeen{.along_profile = true, .along_face = true};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kShortest = 0.1, kLongest = 2.0;  // of profile and face
    std::vector<EffectShape> shapes;
    const std::array<double, 2> whole{std::abs(g.tip_form_roll_mm() - g.root_form_roll_mm()),
                                      g.face_width_mm()};
    for (const double first : {0.8, 0.93, 0.98, 1.0, 1.02, 1.08, 1.25})
      for (const double second : {0.8, 0.93, 0.98, 1.0, 1.02, 1.08, 1.25}) {
        EffectShape beside = shape;
        beside[2] = std::clamp(first * shape[2], kShortest * whole[0], kLongest * whole[0]);
        beside[3] = std::clamp(second * shape[3], kShortest * whole[1], kLongest * whole[1]);
        if (beside != shape) shapes.push_back(std::move(beside));
      }
    // (a plane that ends nearer is nearly a parabola that ends farther off)
    for (const double times : {0.8, 0.93, 1.07, 1.25})
      for (const double reach : {1.0, times}) {
        EffectShape beside = shape;
        beside[4] = std::clamp(times * shape[4], 1.0, 3.0);
        beside[2] = std::clamp(reach * shape[2], kShortest * whole[0], kLongest * whole[0]);
        beside[3] = std::clamp(reach * shape[3], kShortest * whole[1], kLongest * whole[1]);
        if (beside != shape) shapes.push_back(std::move(beside));
      }
    return shapes;
  };
  f.term_keys = {{"corner", TermKey::Kind::kWord, {"root", "tip"}},
                 {"end", TermKey::Kind::kWord, {"lower", "upper"}},
                 {"profile_mm", TermKey::Kind::kNumber},
                 {"face_mm", TermKey::Kind::kNumber},
                 {"power", TermKey::Kind::kNumber}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return "the same on every tooth, the corner at the " +
           std::string(shape[0] != 0.0 ? "tip" : "root") + " and the " +
           (shape[1] != 0.0 ? "upper" : "lower") +
           printed(" end %s, over %.2g mm of roll length and %.2g mm of the face",
                   stands(told.sign()).c_str(),
                   std::min(shape[2], std::abs(range_mm(told.geometry, 0.0))),
                   std::min(shape[3], told.geometry.face_width_mm()));
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
