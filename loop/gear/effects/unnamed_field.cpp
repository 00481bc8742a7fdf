// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {
/// Points are shifted by the square of where they stand in the plane: along x by x^2 and along y by
/// y^2 (an axis whose scale changes), along x by y^2 and along y by x^2 (an axis that is bent), or
/// by x y (a keystone). Told in place of an eccentricity and waves of orders 1 and 3, which follow
/// it (fields.cpp), and no candidate of its own.
EffectFamily unnamed_field() {
  EffectFamily f = described("unnamed_field", {"own_power"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const PlanePoint point = point_of(p);
    const double r = g.reference_radius_mm(), x = point.x / r, y = point.y / r;
    const bool along = shape[0] == 2.0, across = shape[0] == 0.0;
    const double of_x = along ? x * x : across ? y * y : x * y;
    const double of_y = along ? y * y : across ? x * x : x * y;
    c[0] = normal_part(g, p, of_x, 0.0);
    c[1] = normal_part(g, p, 0.0, of_y);
  };
  f.term_keys = {{"own_power"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return std::string("places are shifted by the square of where they stand in the plane: ") +
           (shape[0] == 2.0   ? "along x by x^2, along y by y^2, an axis whose scale changes"
            : shape[0] == 0.0 ? "along x by y^2, along y by x^2, an axis that is bent"
                              : "along x and y by x y, a keystone") +
           (told.amounts.size() == 2
                ? printed("; at the reference radius by %+.3g um along x and %+.3g um along y",
                          told.amounts[0], told.amounts[1])
                : "") +
           ", as from the field of a laser, a projector or a camera, or a guide of a machine";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
