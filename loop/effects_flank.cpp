// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/loop/effect.h"

// Effects that give every flank the same shape.
namespace trueflank::loop {
namespace {

using Shape = std::vector<double>;

/// A family whose one column is a function of profile coordinate u (-1 root form ... +1 tip), face
/// coordinate v (-1 ... +1 from bottom to top) and side, on flanks only.
template <class Function>
EffectFamily on_flanks(Function function) {
  EffectFamily f;
  f.evaluate = [function](const FlankGeometry& g, const Place& p, const Shape&, double* c) {
    c[0] = p.surface == Surface::kFlank
               ? function(g, g.profile_coordinate(p.roll_mm), g.face_coordinate(p.z_mm), p.side)
               : 0.0;
  };
  return f;
}

EffectFamily tooth_thickness() {
  auto f = on_flanks([](const FlankGeometry& g, double, double, int) {
    return 0.5 * std::cos(g.pressure_angle_rad()) * std::cos(g.base_helix_rad());
  });
  f.id = "tooth_thickness";
  f.description = "the teeth are too thick or too thin, the tips as designed";
  f.cause = "infeed of the tool (profile shift error), tool thickness";
  f.correction = "infeed; profile shift or thinning of the model";
  f.parameters = {"amount_um"};
  return f;
}

EffectFamily pressure_angle_error() {
  auto f = on_flanks([](const FlankGeometry&, double u, double, int) { return 0.5 * u; });
  f.id = "pressure_angle_error";
  f.description = "the profile leans: more material towards the tip where positive";
  f.cause = "pressure angle of tool or dresser, base circle (both flanks alike); tool tilted or off "
            "centre (flanks opposite)";
  f.correction = "tool angle or dressing; pressure angle of the model";
  f.parameters = {"slope_um"};
  f.one_flank_too = true;
  return f;
}

EffectFamily profile_crowning() {
  auto f = on_flanks([](const FlankGeometry&, double u, double, int) { return -u * u; });
  f.id = "profile_crowning";
  f.description = "material is missing towards root and tip";
  f.cause = "form of tool or dresser, elastic tool, wear";
  f.correction = "dress or design the profile accordingly";
  f.parameters = {"amount_um"};
  f.one_flank_too = true;
  return f;
}

EffectFamily helix_error() {
  auto f = on_flanks([](const FlankGeometry&, double, double v, int side) {
    return 0.5 * v * side;
  });
  f.id = "helix_error";
  f.description = "the section turns with height: counter-clockwise where positive";
  f.cause = "lead of the machine, differential, twist of the print";
  f.correction = "lead correction; twist the model the other way";
  f.parameters = {"slope_um"};
  f.one_flank_too = true;
  return f;
}

EffectFamily taper() {
  auto f = on_flanks([](const FlankGeometry&, double, double v, int) { return 0.5 * v; });
  f.id = "taper";
  f.description = "the teeth grow thicker with height where positive";
  f.cause = "draft, cooling of layers, deflection of the machine, infeed over the stroke";
  f.correction = "tailstock or axis slope, draft of the mould; taper the model the other way";
  f.parameters = {"slope_um"};
  return f;
}

EffectFamily crowning() {
  auto f = on_flanks([](const FlankGeometry&, double, double v, int) { return -v * v; });
  f.id = "crowning";
  f.description = "material is missing towards both ends of the face";
  f.cause = "crowning motion, deflection, edges polished or worn";
  f.correction = "crowning setting; design it, or take it out of the model";
  f.parameters = {"amount_um"};
  f.one_flank_too = true;
  return f;
}

EffectFamily flank_twist() {
  auto f = on_flanks([](const FlankGeometry&, double u, double v, int) { return u * v; });
  f.id = "flank_twist";
  f.description = "the profile slope changes over the face (bias)";
  f.cause = "crowning of a helical gear by radial motion, diagonal grinding";
  f.correction = "twist-free dressing or shift strategy";
  f.parameters = {"amount_um"};
  f.one_flank_too = true;
  f.preference = 1;
  return f;
}

EffectFamily tip_relief() {
  EffectFamily f;
  f.id = "tip_relief";
  f.description = "material is missing at the tip, from a diameter on";
  f.cause = "relief by tool or dresser, wear of the tip, rounding of the print";
  f.correction = "tool relief; design it, or take it out of the model";
  f.only_positive = true;
  f.parameters = {"amount_um"};
  f.shape_names = {"start_diameter_mm"};
  f.shape_is_continuous = true;
  f.one_flank_too = true;
  f.shapes = [](const FlankGeometry& g) {
    std::vector<Shape> shapes;
    for (const double part : {0.25, 0.4, 0.5, 0.6, 0.7, 0.8, 0.88}) {
      const double roll = g.root_form_roll_mm() + part * (g.tip_form_roll_mm() - g.root_form_roll_mm());
      shapes.push_back({2.0 * std::hypot(g.base_radius_mm(), roll)});
    }
    return shapes;
  };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double start = g.roll_at_radius_mm(0.5 * shape[0]);
    const double past = (p.roll_mm - start) / (g.tip_form_roll_mm() - start);
    if (past > 0.0) c[0] = -past * past;
  };
  return f;
}

EffectFamily flank_wear() {
  EffectFamily f;
  f.id = "flank_wear";
  f.description = "a hollow across the flank, around a diameter";
  f.cause = "sliding under load on the loaded flank";
  f.correction = "lubrication, material, load; nothing the geometry of a new part should cancel";
  f.parameters = {"depth_um"};
  f.shape_names = {"centre_diameter_mm", "width_mm"};
  f.shape_is_continuous = true;
  f.one_flank_too = true;
  f.preference = 1;
  f.correctable = Correctable::kNoCause;
  f.only_positive = true;
  f.shapes = [](const FlankGeometry& g) {
    std::vector<Shape> shapes;
    const double length = g.tip_form_roll_mm() - g.root_form_roll_mm();
    for (const double part : {0.15, 0.3, 0.45, 0.6, 0.75, 0.9})
      for (const double width : {0.1, 0.2})
        shapes.push_back({2.0 * std::hypot(g.base_radius_mm(), g.root_form_roll_mm() + part * length),
                          width * std::abs(length)});
    return shapes;
  };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double t = (p.roll_mm - g.roll_at_radius_mm(0.5 * shape[0])) / shape[1];
    c[0] = -std::exp(-t * t);
  };
  return f;
}

}  // namespace

std::vector<EffectFamily> flank_effects() {
  return {tooth_thickness(), pressure_angle_error(), profile_crowning(), tip_relief(),
          helix_error(),     taper(),                crowning(),         flank_twist(),
          flank_wear()};
}

}  // namespace trueflank::loop
