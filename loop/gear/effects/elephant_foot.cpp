// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {
namespace {
constexpr double kMostOfFace = 0.3;
}

EffectFamily elephant_foot() {
  EffectFamily f;
  f.id = "elephant_foot";
  f.description = "the teeth bulge out towards the lower face";
  f.tells_its_end = true;
  f.form_word = "bulge_at_lower_face";
  f.form_told = {"the teeth bulge out towards the lower face",
                 "the teeth fall back towards the lower face"};
  f.causes = {{kOnPlate, "first layers pressed against the plate or overheated"}};
  f.correction = "set first layer height and temperature or elephant foot compensation; draw in the foot";
  f.parameters = {"amount_um"};
  f.shape_names = {"height_mm"};
  f.shape_is_continuous = true;
  f.only_positive = true;
  f.shapes = [](const FlankGeometry& g) {
    return heights(g, 0.1, std::max(0.3, kMostOfFace * g.face_width_mm()), 8, true);
  };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank ? std::exp(-std::max(0.0, p.z_mm) / shape[0]) : 0.0;
  };
  // Beyond it is no foot: a taper, or a curve over the face.
  f.shape_limits = [](const FlankGeometry& g, std::size_t) {
    return std::pair(0.02, std::max(0.3, kMostOfFace * g.face_width_mm()));
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.told_from = {{"crowning", "sections at several heights near the lower face"}};
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    return "The teeth bulge out by " + um(figure(found, "amount_um")) + " at the lower face, over about " +
           mm(figure(found, "height_mm")) + ": they bind there first";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
