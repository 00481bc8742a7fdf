// SPDX-License-Identifier: GPL-3.0-or-later
// Forms along the flanks that some neighbouring teeth have, or one alone.
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/simple_courses.h"

namespace trueflank::loop::gear_effects {
namespace {

// First tooth, number of teeth, and over how many they begin and end; then those of the form.
constexpr std::size_t kOwnValues = 3;

/// The form's own shape values; they stand until the next are asked for.
const EffectShape& form_shape(const EffectShape& shape) {
  thread_local EffectShape own;
  own.assign(shape.begin() + kOwnValues, shape.end());
  return own;
}

/// 1 on the teeth of the run, 0 beside them; where it begins and ends over some teeth, in between.
double on_run(const FlankGeometry& g, int tooth, const EffectShape& shape) {
  if (shape[2] > 0.0)
    return in_soft_run(g, tooth, shape[0] + 0.5 * (shape[1] - 1.0), shape[1], shape[2]);
  return teeth_since(g, tooth, shape[0]) < static_cast<int>(shape[1]) ? 1.0 : 0.0;
}

std::string words_of_sector(const EffectShape& shape) {
  if (shape[1] == 1.0) return printed("on tooth %.0f alone, ", shape[0]);
  return printed("on %.0f teeth from tooth %.0f on, ", shape[1], shape[0]) +
         over_edges(shape[2], shape[2] > 0.0);
}

/// A form that is the same on every tooth, on some neighbouring teeth only.
EffectFamily of_teeth(EffectFamily form) {
  EffectFamily f = form;
  f.id = form.id + "_of_teeth";
  f.shape_names.insert(f.shape_names.begin(), {"from_tooth", "teeth", "edge_teeth"});
  f.term_keys.insert(f.term_keys.begin(), {{"from_tooth"}, {"teeth"}, {"edge_teeth"}});
  f.same_on_every_tooth = {};
  f.evaluate = [form](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const double here = p.surface == Surface::kFlank ? on_run(g, p.tooth, shape) : 0.0;
    const int columns = form.columns(shape);
    if (here > 0.0) form.evaluate(g, p, form_shape(shape), c);
    for (int k = 0; k < columns; ++k) c[k] = here > 0.0 ? here * c[k] : 0.0;
  };
  f.needs = [needs = form.needs](const EffectShape& shape) {
    return needs(EffectShape(shape.begin() + kOwnValues, shape.end()));
  };
  if (form.values_sought)
    f.values_sought = [sought = form.values_sought](const EffectShape& shape) {
      return sought(form_shape(shape));
    };
  f.nearby = [nearby = form.nearby](const FlankGeometry& g, const EffectShape& shape) {
    const EffectShape own(shape.begin() + kOwnValues, shape.end());
    std::vector<EffectShape> shapes;
    for (EffectShape& beside : nearby(g, own)) {
      beside.insert(beside.begin(), shape.begin(), shape.begin() + kOwnValues);
      shapes.push_back(std::move(beside));
    }
    if (shape[1] == 1.0) return shapes;
    for (EffectShape& beside : sectors_beside(g, shape, 1)) shapes.push_back(std::move(beside));
    // (where few teeth are traced the next one lies farther off)
    constexpr double kFarthest = 0.15;  // of the gear
    for (double far = 2.0; far <= kFarthest * g.teeth(); far *= 2.0)
      for (const double off : {-far, far})
        for (const bool first : {true, false}) {
          EffectShape beside = shape;
          if (first) beside[0] = std::fmod(shape[0] - 1.0 - off + g.teeth(), g.teeth()) + 1.0;
          beside[1] += off;
          if (beside[1] >= 2.0 && beside[1] < g.teeth()) shapes.push_back(std::move(beside));
        }
    if (shape[2] > 0.0)
      for (const double longer : {-1.0, 1.0}) {
        const double edge = shape[2] + longer;
        if (edge < 1.0 || edge > shape[1]) continue;
        shapes.push_back(shape);
        shapes.back()[2] = edge;
      }
    return shapes;
  };
  f.words = [words = form.words](const ToldForm& told) {
    const std::string every = "the same on every tooth, ";
    const EffectShape shape(told.shape.begin() + kOwnValues, told.shape.end());
    std::string own = words({told.geometry, shape, told.flank, told.amounts});
    if (own.rfind(every, 0) == 0) own.erase(0, every.size());
    return words_of_sector(told.shape) + own;
  };
  return f;
}

}  // namespace

std::vector<EffectFamily> forms_of_teeth() {
  std::vector<EffectFamily> families;
  for (EffectFamily form :
       {unnamed_step(), unnamed_kink(), unnamed_bend(), unnamed_rise(), unnamed_band(),
        unnamed_dish(), unnamed_waviness(), unnamed_slanted_ridge(), unnamed_corner()})
    families.push_back(of_teeth(std::move(form)));
  return families;
}

bool is_of_teeth(const Effect& form) {
  const std::vector<std::string>& names = form.family->shape_names;
  return !names.empty() && names.front() == "from_tooth";
}

const EffectFamily* of_teeth(const Effect& form) {
  return find_family(form.family->id + "_of_teeth");
}

std::optional<Effect> on_the_other_teeth(const FlankGeometry& geometry, const Effect& form) {
  constexpr std::size_t kAround = 2 * FlankCourse::kValues + 1;  // of unnamed_crossed_around
  const double z = geometry.teeth();
  const auto on_a_tooth = [z](double tooth) { return std::fmod(tooth - 1.0 + z, z) + 1.0; };
  Effect other = form;
  EffectShape& shape = other.shape;
  if (form.family == find_family("unnamed_sector") || is_of_teeth(form)) {
    shape[0] = on_a_tooth(form.shape[0] + form.shape[1]);
    shape[1] = z - form.shape[1];
  } else if (form.family == find_family("unnamed_soft_sector")) {
    shape[0] = on_a_tooth(form.shape[0] + 0.5 * z);
    shape[1] = z - form.shape[1];
  } else if (form.family == find_family("unnamed_crossed_around") &&
             AroundCourse::at(form.shape, kAround).kind == AroundCourse::kSector) {
    shape[kAround + 1] = std::remainder(form.shape[kAround + 1] + 180.0, 360.0);
    shape[kAround + 2] = 180.0 - form.shape[kAround + 2];
    if (shape[kAround + 2] * z < 2.0 * 180.0) return {};
    return other;
  } else {
    return {};
  }
  if (!(shape[1] >= 2.0)) return {};
  return other;
}

}  // namespace trueflank::loop::gear_effects
