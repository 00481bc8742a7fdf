// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily layer_shift() {
  EffectFamily f;
  f.id = "layer_shift";
  f.description = "everything above a height is moved sideways";
  f.form_word = "sideways_step_over_height";
  f.causes = {{kPrinting, "the printer skipped steps, or the part was struck"}};
  f.correction = "look at belts, current, speed and collisions of the printer; geometry cannot cancel it";
  f.parameters = {"dx_um", "dy_um"};
  f.shape_names = {"height_mm"};
  f.shape_is_continuous = true;
  f.correctable = Correctable::kNoCause;
  f.shapes = [](const FlankGeometry& g) {
    const double b = g.face_width_mm();
    return heights(g, 0.06 * b, 0.94 * b, 15, false);
  };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    two_directions(g, p, p.z_mm > shape[0] ? 1.0 : 0.0, c);
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const EffectShape& shape,
                         const double* b) -> Point3 {
    const double on = p[2] > shape[0] ? 1e-3 : 0.0;
    return {on * b[0], on * b[1], 0.0};
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.shape_is_step = true;
  f.shape_limits = [](const FlankGeometry& g, std::size_t) { return height_limits(g); };
  f.sentence = [](const FlankGeometry&, const FoundEffect& found) {
    const double dx = figure(found, "dx_um"), dy = figure(found, "dy_um");
    return "Everything above " + mm(figure(found, "height_mm")) + " stands " + um(std::hypot(dx, dy)) + " aside " +
           towards(deg_from_rad(std::atan2(dy, dx))) + ": the teeth carry on one half of the face";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
