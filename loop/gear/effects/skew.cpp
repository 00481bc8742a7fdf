// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily skew() {
  EffectFamily f;
  f.id = "skew";
  f.description = "x and y are not square to each other";
  f.form_word = "sheared_section";
  f.form_told = {"x and y are not square to each other: longer along their bisector",
                 "x and y are not square to each other: shorter along their bisector"};
  f.causes = {{kPrinting | kContourCutting, "the axes of the printer or machine are not square"},
              {kInMould, "the part was cooled or ejected one-sidedly"}};
  f.correction = "square the axes or enter the skew in the firmware; shear the model the other way";
  f.parameters = {"percent"};
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape&, double* c) {
    const PlanePoint x = point_of(p);
    c[0] = p.surface == Surface::kFlank ? 5.0 * normal_part(g, p, x.y, x.x) : 0.0;
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const EffectShape&,
                         const double* b) -> Point3 {
    const double s = 0.5 * 1e-2 * b[0];
    return {s * p[1], s * p[0], 0.0};
  };
  f.order = [](const EffectShape&) { return 2.0; };
  f.doubt_share = 0.3;
  f.sentence = [](const FlankGeometry& g, const FoundEffect& found) {
    const double percent = figure(found, "percent");
    return printed("The axes x and y are %.3g %% out of square", std::abs(percent)) + ": out of round by " +
           um(10.0 * percent * g.reference_radius_mm());
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
