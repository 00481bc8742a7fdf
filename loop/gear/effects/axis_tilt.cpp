// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {
namespace {

/// 1: the teeth lean as a body, end faces and all; 0: their sections are shifted, each in its plane.
/// On helical flanks what moves along the axis is a deviation, too.
bool leans_as_a_body(const EffectShape& shape) { return shape[0] != 0.0; }
constexpr double kAsABody = 1.0, kBySections = 0.0;

}  // namespace

EffectFamily axis_tilt() {
  EffectFamily f;
  f.id = "axis_tilt";
  f.description = "the axis of the teeth leans against the datum axis";
  f.causes = {{kMachining,
               "face runout at clamping, a chip under the part, a table or spindle out of square"},
              {kPrinting, "a plate or axis out of square, warping off the plate"},
              {kWireCutting | kBeamCutting, "the blank or the wire stood out of square"},
              {kInMould, "the core stands askew, or the part bent while it was ejected"}};
  f.correction = "true the clamping face; tilt the toothing against the bore where it repeats";
  f.parameters = {"slope_um_per_mm", "phase_deg"};
  f.form = ParameterForm::kWave;
  f.shape_names = {"faces_lean"};
  f.shape_where_absent = {kBySections};
  f.is_one_of_its_shapes = true;
  f.shapes = [](const FlankGeometry& g) {
    return g.gear().helix_angle_rad == 0.0
               ? std::vector<EffectShape>{{kAsABody}}
               : std::vector<EffectShape>{{kAsABody}, {kBySections}};
  };
  f.complexity = [](const EffectShape& shape) { return leans_as_a_body(shape) ? 0.0 : 1.0; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    two_directions(g, p, p.z_mm - 0.5 * g.face_width_mm(), c);
    if (!leans_as_a_body(shape)) return;
    const auto [x, y] = point_of(p);
    const double along_axis = g.normal_z(p);
    c[0] -= along_axis * x;
    c[1] -= along_axis * y;
  };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.several_heights = true}; };
  f.displacement_mm = [](const FlankGeometry& g, const Point3& p, const EffectShape& shape,
                         const double* b) -> Point3 {
    const double z = 1e-3 * (p[2] - 0.5 * g.face_width_mm());
    const double down = leans_as_a_body(shape) ? 1e-3 * (b[0] * p[0] + b[1] * p[1]) : 0.0;
    return {z * b[0], z * b[1], -down};
  };
  f.other_motions = [](const FlankGeometry& g, const EffectShape& shape) {
    return g.gear().helix_angle_rad != 0.0
               ? std::vector<EffectShape>{}
               : std::vector<EffectShape>{{leans_as_a_body(shape) ? kBySections : kAsABody}};
  };
  f.told_from = {{"layer_shift", "sections at more heights"},
                 {"eccentricity", "sections at more heights, or helix traces"}};
  f.sentence = [](const FlankGeometry& g, const FoundEffect& found) {
    const double slope = figure(found, "slope_um_per_mm");
    return "The axis of the teeth leans by " + um(slope) + " per mm " + towards(figure(found, "phase_deg")) +
           ": the helix slopes by up to " + um(slope * g.face_width_mm()) + ", once per turn";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
