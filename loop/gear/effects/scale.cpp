// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

EffectFamily scale() {
  EffectFamily f;
  f.id = "scale";
  f.description = "the whole part is too big or too small";
  f.form_word = "size_of_part";
  f.form_told = {"the whole part is too big",
                 "the whole part is too small"};
  f.causes = {{kPrinting, "shrinkage, or steps per millimetre of the printer"},
              {kInMould, "shrinkage"},
              {kContourCutting, "scale of the axes"},
              {kAnyMaking, "the part or the measuring device was not at 20 degrees"}};
  f.correction = "scale mould or print by 1/(1 + scale)";
  f.corrections = {{kPrinting, "scale the print by 1/(1 + scale)"},
                   {kInMould, "scale the mould by 1/(1 + scale)"},
                   {kMachining | kWireCutting | kBeamCutting,
                    "measure at 20 degrees; then correct the scale of the axes"}};
  f.parameters = {"percent"};
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape&, double* c) {
    constexpr double kUmPerPercent = 10.0;  // of a millimetre
    const PlanePoint x = point_of(p);
    c[0] = kUmPerPercent * (normal_part(g, p, x.x, x.y) + g.normal_z(p) * p.z_mm);
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const EffectShape&,
                         const double* b) -> Point3 {
    const double s = 1e-2 * b[0];
    return {s * p[0], s * p[1], s * p[2]};
  };
  f.shows_in_sizes = true;
  f.penalty_of_traces =
      1;  // traces show no size: a leaning profile is likelier than a part that has grown
  f.moves_whole_part = true;
  f.told_from = {
      {"pressure_angle_error", "tooth thickness (span or over pins) and a tip or bore diameter"},
      {"contour_offset", "tip, root or bore diameter, or profile traces with a common zero"},
      {"tooth_thickness", "profile traces over the whole flank, and the tip diameter"}};
  f.causes_told_by =
      "shrinkage of the part, heat and a scale error of the measuring device look alike; note "
      "the temperature, remeasure at 20 degrees, measure a gauge block in the same setup";
  f.sentence = [](const FlankGeometry& g, const FoundEffect& found) {
    const double percent = figure(found, "percent");
    return printed("The whole part is %.3g %% too ", std::abs(percent)) + (percent > 0.0 ? "big" : "small") +
           ": its tip diameter is off by " + um(20.0 * percent * g.tip_radius_mm());
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
