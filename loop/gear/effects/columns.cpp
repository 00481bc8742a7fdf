// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/columns.h"

#include <algorithm>

#include "trueflank/base/number_text.h"

namespace trueflank::loop::gear_effects {

void two_directions(const FlankGeometry& g, const Place& place, double factor, double* c) {
  const bool teeth = place.surface == Surface::kFlank;
  c[0] = teeth ? factor * normal_part(g, place, 1.0, 0.0) : 0.0;
  c[1] = teeth ? factor * normal_part(g, place, 0.0, 1.0) : 0.0;
}

std::vector<EffectShape> whole_numbers(int from, int to) {
  std::vector<EffectShape> shapes;
  for (int n = from; n <= to; ++n) shapes.push_back({static_cast<double>(n)});
  return shapes;
}

std::vector<EffectShape> heights(const FlankGeometry& g, double from_mm, double to_mm, int count,
                                 bool in_ratios) {
  std::vector<EffectShape> shapes;
  for (int i = 0; i < count; ++i) {
    const double f = static_cast<double>(i) / (count - 1);
    const double h =
        in_ratios ? from_mm * std::pow(to_mm / from_mm, f) : from_mm + f * (to_mm - from_mm);
    if (h < g.face_width_mm()) shapes.push_back({h});
  }
  return shapes;
}

std::pair<double, double> height_limits(const FlankGeometry& g) {
  constexpr double kInset = 0.02;  // nearer to an end it moves all of the face, or none
  return {kInset * g.face_width_mm(), (1.0 - kInset) * g.face_width_mm()};
}

std::pair<double, double> diameter_limits(const FlankGeometry& g) {
  const double root = 2.0 * std::hypot(g.base_radius_mm(), g.root_form_roll_mm());
  const double tip = 2.0 * std::hypot(g.base_radius_mm(), g.tip_form_roll_mm());
  const double inset = 0.02 * (tip - root);
  return {std::min(root + inset, tip - inset), std::max(root + inset, tip - inset)};
}

double diameter_at_roll_share(const FlankGeometry& g, double share) {
  const double roll =
      g.root_form_roll_mm() + share * (g.tip_form_roll_mm() - g.root_form_roll_mm());
  return 2.0 * std::hypot(g.base_radius_mm(), roll);
}

double figure(const FoundEffect& found, const std::string& parameter) {
  for (const Parameter& p : found.parameters)
    if (p.name == parameter) return p.value;
  return kNaN;
}

std::string um(double value) { return printed("%.3g um", std::abs(value)); }
std::string mm(double value) { return printed("%.3g mm", std::abs(value)); }

std::string towards(double deg) {
  const double turned = deg - 360.0 * std::floor(deg / 360.0);
  return printed("towards %.0f deg", std::round(turned) == 360.0 ? 0.0 : turned);
}

std::string on_which_flanks(const FoundEffect& found) {
  return found.flank == "both" ? "" : " on the " + found.flank + " flanks";
}

std::string times_per_turn(double order) {
  return order == 1.0   ? "once per turn"
         : order == 2.0 ? "twice per turn"
                        : printed("%.0f times per turn", order);
}

std::string with_shape(const std::string& form, const std::vector<std::string>& names,
                       const EffectShape& shape) {
  std::string values, order;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    if (names[k] == "order") {
      order = ", " + times_per_turn(shape[k]);
      continue;
    }
    const auto [name, unit] = name_and_unit(names[k]);
    values += (values.empty() ? " (" : ", ") + name + " " + printed("%.4g", shape[k]) +
              (unit.empty() ? "" : " " + unit);
  }
  return form + order + (values.empty() ? "" : values + ")");
}

int teeth_since(const FlankGeometry& geometry, int tooth, double from) {
  const int z = geometry.teeth();
  return ((tooth - static_cast<int>(from)) % z + z) % z;
}

double in_soft_run(const FlankGeometry& geometry, int tooth, double middle, double teeth,
                   double edge_teeth) {
  const double off = std::abs(std::remainder(tooth - middle, geometry.teeth()));
  return 1.0 / (1.0 + std::exp(4.0 * (off - 0.5 * teeth) / edge_teeth));
}

std::string over_edges(double edge_teeth, bool asked) {
  if (!asked) return "";
  const double teeth = std::round(edge_teeth);
  return "with soft edges" + (teeth > 1.0 ? printed(" over about %.0f teeth, ", teeth) : ", ");
}

std::vector<EffectShape> facings_beside(const EffectShape& shape) {
  std::vector<EffectShape> shapes{shape};
  shapes.back()[1] = 3.0 - shape[1];
  for (const double off : {-8.0, -3.0, -1.0, -0.3, 0.3, 1.0, 3.0, 8.0}) {
    shapes.push_back(shape);
    shapes.back()[0] += off;
  }
  return shapes;
}

std::vector<EffectShape> sectors_beside(const FlankGeometry& geometry, const EffectShape& shape,
                                        int most) {
  std::vector<EffectShape> shapes;
  for (int first = -most; first <= most; ++first)
    for (int last = -most; last <= most; ++last) {
      EffectShape beside = shape;
      beside[0] = std::fmod(shape[0] - 1.0 + first + geometry.teeth(), geometry.teeth()) + 1.0;
      beside[1] = shape[1] + last - first;
      if (beside != shape && beside[1] >= 2.0 && beside[1] < geometry.teeth())
        shapes.push_back(std::move(beside));
    }
  return shapes;
}

void set_columns(EffectFamily& family, EffectFamily::FormTimesTooth columns) {
  family.evaluate = [columns, count = family.columns](const FlankGeometry& g, const Place& p,
                                                      const EffectShape& shape, double* c) {
    const int n = count(shape);
    std::fill_n(c, n, 0.0);
    if (p.surface != Surface::kFlank) return;
    columns.tooth(g, p.tooth, shape, c);
    if (std::all_of(c, c + n, [](double factor) { return factor == 0.0; })) return;
    const double form = columns.form(g, p, shape);
    for (int k = 0; k < n; ++k) c[k] = c[k] != 0.0 ? c[k] * form : 0.0;
  };
  family.form_times_tooth = std::move(columns);
}

EffectFamily described(const std::string& id, std::vector<std::string> shape_names) {
  EffectFamily f;
  f.id = id;
  f.description = "structure that no named effect explains";
  f.parameters = {"cos_um", "sin_um"};
  f.shape_names = std::move(shape_names);
  f.named = false;
  f.preference = 3;
  f.correctable = Correctable::kNoCause;
  f.columns = [](const EffectShape&) { return 1; };
  f.shapes = [](const FlankGeometry&) { return std::vector<EffectShape>{}; };
  return f;
}

}  // namespace trueflank::loop::gear_effects
