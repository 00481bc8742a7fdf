// SPDX-License-Identifier: GPL-3.0-or-later
// Forms along the flanks that some neighbouring teeth have, or one alone.
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {
namespace {

constexpr std::size_t kOwnValues = 2;  // first tooth and number of teeth, then those of the form

/// The form's own shape values; they stand until the next are asked for.
const EffectShape& form_shape(const EffectShape& shape) {
  thread_local EffectShape own;
  own.assign(shape.begin() + kOwnValues, shape.end());
  return own;
}

std::string words_of_sector(const EffectShape& shape) {
  if (shape[1] == 1.0) return printed("on tooth %.0f alone, ", shape[0]);
  return printed("on %.0f teeth from tooth %.0f on, ", shape[1], shape[0]);
}

/// A form that is the same on every tooth, on some neighbouring teeth only.
EffectFamily of_teeth(EffectFamily form) {
  EffectFamily f = form;
  f.id = form.id + "_of_teeth";
  f.shape_names.insert(f.shape_names.begin(), {"from_tooth", "teeth"});
  f.term_keys.insert(f.term_keys.begin(), {{"from_tooth"}, {"teeth"}});
  f.same_on_every_tooth = {};
  f.evaluate = [form](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    if (p.surface == Surface::kFlank &&
        teeth_since(g, p.tooth, shape[0]) < static_cast<int>(shape[1])) {
      const EffectShape& own = form_shape(shape);
      form.evaluate(g, p, own, c);
      return;
    }
    const int columns = form.columns(shape);
    for (int k = 0; k < columns; ++k) c[k] = 0.0;
  };
  f.needs = [needs = form.needs](const EffectShape& shape) {
    return needs(EffectShape(shape.begin() + kOwnValues, shape.end()));
  };
  f.nearby = [nearby = form.nearby](const FlankGeometry& g, const EffectShape& shape) {
    const EffectShape own(shape.begin() + kOwnValues, shape.end());
    std::vector<EffectShape> shapes;
    for (EffectShape& beside : nearby(g, own)) {
      beside.insert(beside.begin(), {shape[0], shape[1]});
      shapes.push_back(std::move(beside));
    }
    if (shape[1] == 1.0) return shapes;
    for (EffectShape& beside : sectors_beside(g, shape, 1)) shapes.push_back(std::move(beside));
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
  for (EffectFamily form : {unnamed_step(), unnamed_kink(), unnamed_bend(), unnamed_rise(),
                            unnamed_band(), unnamed_waviness()})
    families.push_back(of_teeth(std::move(form)));
  return families;
}

const EffectFamily* of_teeth(const Effect& form) {
  return find_family(form.family->id + "_of_teeth");
}

}  // namespace trueflank::loop::gear_effects
