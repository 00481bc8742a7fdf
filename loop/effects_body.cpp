// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/loop/effect.h"

// Effects that move the tooth system, or all walls. One displacement field u(x, y, z) a family: the
// deviation is its part along the normal, for gears and rings, spur and helical alike.
namespace trueflank::loop {
namespace {

using Shape = std::vector<double>;
using Point3 = std::array<double, 3>;
constexpr double kMmPerUm = 1e-3, kPerPercent = 1e-2;

struct Field {
  double x, y;
};

Field point_of(const Place& place) {
  return {place.radius_mm * std::cos(place.polar_rad), place.radius_mm * std::sin(place.polar_rad)};
}
bool is_tooth_system(const Place& place) { return place.surface == Surface::kFlank; }

/// Displacement by (1, 0) and (0, 1), times a factor that may depend on height.
void two_directions(const FlankGeometry& g, const Place& place, double factor, double* c) {
  c[0] = is_tooth_system(place) ? factor * normal_part(g, place, 1.0, 0.0) : 0.0;
  c[1] = is_tooth_system(place) ? factor * normal_part(g, place, 0.0, 1.0) : 0.0;
}

std::vector<Shape> heights(const FlankGeometry& g, double from, double to, int count, bool log) {
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    const double f = static_cast<double>(i) / (count - 1);
    const double h = log ? from * std::pow(to / from, f) : from + f * (to - from);
    if (h < g.face_width_mm()) shapes.push_back({h});
  }
  return shapes;
}

EffectFamily eccentricity() {
  EffectFamily f;
  f.id = "eccentricity";
  f.description = "the teeth stand off the axis";
  f.cause = "bore and teeth were made in different clampings, or the part sat off centre";
  f.correction = "true the part on its pitch circle or re-bore; move the toothing against the bore "
                 "where it repeats";
  f.parameters = {"amplitude_um", "phase_deg"};
  f.form = ParameterForm::kWave;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape&, double* c) {
    two_directions(g, p, 1.0, c);
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3&, const Shape&, const double* b) -> Point3 {
    return {kMmPerUm * b[0], kMmPerUm * b[1], 0.0};
  };
  return f;
}

EffectFamily axis_tilt() {
  EffectFamily f;
  f.id = "axis_tilt";
  f.description = "the axis of the teeth leans against the datum axis";
  f.cause = "face runout at clamping, a chip under the part, a table or spindle out of square";
  f.correction = "true the clamping face; tilt the toothing against the bore where it repeats";
  f.parameters = {"slope_um_per_mm", "phase_deg"};
  f.form = ParameterForm::kWave;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape&, double* c) {
    two_directions(g, p, p.z_mm - 0.5 * g.face_width_mm(), c);
  };
  f.displacement_mm = [](const FlankGeometry& g, const Point3& p, const Shape&,
                         const double* b) -> Point3 {
    const double z = kMmPerUm * (p[2] - 0.5 * g.face_width_mm());
    return {z * b[0], z * b[1], 0.0};
  };
  return f;
}

EffectFamily layer_shift() {
  EffectFamily f;
  f.id = "layer_shift";
  f.description = "everything above a height is moved sideways";
  f.cause = "the printer skipped steps, or the part was struck";
  f.correction = "printer: belts, current, speed, collisions; geometry cannot cancel it";
  f.parameters = {"dx_um", "dy_um"};
  f.shape_names = {"height_mm"};
  f.shape_is_continuous = true;
  f.correctable = Correctable::kNoCause;
  f.shapes = [](const FlankGeometry& g) {
    const double b = g.face_width_mm();
    return heights(g, 0.06 * b, 0.94 * b, 15, false);
  };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape& shape, double* c) {
    two_directions(g, p, p.z_mm > shape[0] ? 1.0 : 0.0, c);
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const Shape& shape,
                         const double* b) -> Point3 {
    const double on = p[2] > shape[0] ? kMmPerUm : 0.0;
    return {on * b[0], on * b[1], 0.0};
  };
  return f;
}

EffectFamily scale() {
  EffectFamily f;
  f.id = "scale";
  f.description = "the whole part is too big or too small";
  f.cause = "shrinkage of moulding, sintering or curing, heat, steps per millimetre";
  f.correction = "scale of mould or print by 1/(1 + scale)";
  f.parameters = {"percent"};
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape&, double* c) {
    constexpr double kUmPerPercent = 10.0;  // of a millimetre
    const Field x = point_of(p);
    c[0] = kUmPerPercent * (normal_part(g, p, x.x, x.y) + g.normal_z(p) * p.z_mm);
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const Shape&, const double* b) -> Point3 {
    const double s = kPerPercent * b[0];
    return {s * p[0], s * p[1], s * p[2]};
  };
  return f;
}

EffectFamily scale_xy() {
  EffectFamily f;
  f.id = "scale_xy";
  f.description = "one axis in the plane is longer than the other";
  f.cause = "steps per millimetre of x and y differ, or the part was cooled or squeezed one-sidedly";
  f.correction = "calibrate the axes; stretch the model the other way";
  f.parameters = {"percent", "phase_deg"};
  f.form = ParameterForm::kWave;
  f.phase_divisor = 2.0;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape&, double* c) {
    const Field x = point_of(p);
    // The larger axis takes half of the difference, the smaller gives half.
    c[0] = is_tooth_system(p) ? 5.0 * normal_part(g, p, x.x, -x.y) : 0.0;
    c[1] = is_tooth_system(p) ? 5.0 * normal_part(g, p, x.y, x.x) : 0.0;
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const Shape&, const double* b) -> Point3 {
    const double c = 0.5 * kPerPercent * b[0], s = 0.5 * kPerPercent * b[1];
    return {c * p[0] + s * p[1], s * p[0] - c * p[1], 0.0};
  };
  return f;
}

EffectFamily skew() {
  EffectFamily f;
  f.id = "skew";
  f.description = "x and y are not square to each other";
  f.cause = "the axes of the printer or machine are not square";
  f.correction = "square the axes or enter the skew in the firmware; shear the model the other way";
  f.parameters = {"percent"};
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape&, double* c) {
    const Field x = point_of(p);
    c[0] = is_tooth_system(p) ? 5.0 * normal_part(g, p, x.y, x.x) : 0.0;
  };
  f.displacement_mm = [](const FlankGeometry&, const Point3& p, const Shape&, const double* b) -> Point3 {
    const double s = 0.5 * kPerPercent * b[0];
    return {s * p[1], s * p[0], 0.0};
  };
  return f;
}

EffectFamily contour_offset() {
  EffectFamily f;
  f.id = "contour_offset";
  f.description = "every wall stands too far out or in";
  f.cause = "width of the extruded line, bleeding of light, laser kerf, spark gap, cutter "
            "compensation, plating";
  f.correction = "contour (XY) compensation or kerf; offset all walls the other way";
  f.parameters = {"offset_um"};
  f.evaluate = [](const FlankGeometry&, const Place&, const Shape&, double* c) { c[0] = 1.0; };
  return f;
}

EffectFamily elephant_foot() {
  EffectFamily f;
  f.id = "elephant_foot";
  f.description = "the first layers bulge out";
  f.cause = "first layers pressed against the plate or overheated";
  f.correction = "first layer height and temperature, elephant foot compensation; draw in the foot";
  f.parameters = {"amount_um"};
  f.shape_names = {"height_mm"};
  f.shape_is_continuous = true;
  f.only_positive = true;
  f.shapes = [](const FlankGeometry& g) {
    return heights(g, 0.1, std::max(0.3, 0.3 * g.face_width_mm()), 8, true);
  };
  f.evaluate = [](const FlankGeometry&, const Place& p, const Shape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank ? std::exp(-std::max(0.0, p.z_mm) / shape[0]) : 0.0;
  };
  return f;
}

}  // namespace

std::vector<EffectFamily> body_effects() {
  return {eccentricity(), axis_tilt(), scale(),          scale_xy(),
          skew(),         contour_offset(), elephant_foot(), layer_shift()};
}

}  // namespace trueflank::loop
