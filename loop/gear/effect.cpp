// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effect.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/loop/gear/effects/columns.h"

namespace trueflank::loop {

namespace {

/// Effects have one column or two: written out, as calls that fill or copy memory take longer.
void put(const double* values, int count, double* to) {
  to[0] = values[0];
  if (count > 1) to[1] = values[1];
  for (int k = 2; k < count; ++k) to[k] = values[k];
}
constexpr std::array<double, 8> kNoColumns{};

}  // namespace

FlankChoice flank_of(const FlankGeometry& geometry, const Place& place) {
  if (place.surface != Surface::kFlank) return FlankChoice::kBoth;
  return place.side == flank_side(Flank::kLeft, geometry.gear().kind) ? FlankChoice::kLeft
                                                                      : FlankChoice::kRight;
}

int ToldForm::sign() const {
  if (amounts.size() != 1) return 0;
  return amounts[0] > 0.0 ? 1 : amounts[0] < 0.0 ? -1 : 0;
}

double ToldForm::direction_rad() const {
  return amounts.size() == 2 ? std::atan2(amounts[1], amounts[0]) : kNaN;
}

bool Effect::acts_on_flank_of(const FlankGeometry& geometry, const Place& place) const {
  return flank == FlankChoice::kBoth || flank == flank_of(geometry, place);
}

void Effect::evaluate(const FlankGeometry& geometry, const Place& place, double* values) const {
  if (acts_on_flank_of(geometry, place))
    family->evaluate(geometry, place, shape, values);
  else
    std::fill_n(values, columns(), 0.0);
}

PreparedEffect::PreparedEffect(const FlankGeometry& geometry, Effect effect)
    : geometry_(geometry), effect_(std::move(effect)), columns_(effect_.columns()) {
  if (!effect_.family->form_times_tooth) return;
  const auto columns = static_cast<std::size_t>(columns_);
  factors_.resize(static_cast<std::size_t>(geometry.teeth()) * columns);
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth) {
    double* const factors = factors_.data() + static_cast<std::size_t>(tooth - 1) * columns;
    effect_.family->form_times_tooth->tooth(geometry, tooth, effect_.shape, factors);
    is_on_tooth_.push_back(
        std::any_of(factors, factors + columns, [](double f) { return f != 0.0; }) ? 1 : 0);
  }
}

void PreparedEffect::evaluate(const Place& place, double* values) const {
  if (factors_.empty()) {
    if (effect_.acts_on_flank_of(geometry_, place))
      effect_.family->evaluate(geometry_, place, effect_.shape, values);
    else
      put(kNoColumns.data(), columns_, values);
    return;
  }
  const auto tooth = static_cast<std::size_t>(place.tooth - 1);
  if (place.surface != Surface::kFlank || is_on_tooth_[tooth] == 0 ||
      !effect_.acts_on_flank_of(geometry_, place)) {
    put(kNoColumns.data(), columns_, values);
    return;
  }
  put_form_times_tooth(place, values);
}

void PreparedEffect::put_form_times_tooth(const Place& place, double* values) const {
  const auto tooth = static_cast<std::size_t>(place.tooth - 1);
  const double* const factors = factors_.data() + tooth * static_cast<std::size_t>(columns_);
  const double form = effect_.family->form_times_tooth->form(geometry_, place, effect_.shape);
  for (int k = 0; k < columns_; ++k) values[k] = factors[k] != 0.0 ? factors[k] * form : 0.0;
}

EffectsTogether::EffectsTogether(std::span<const Effect> effects) : effects_(effects) {
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const Effect& effect = effects[e];
    ones_.push_back({columns_, effect.columns(), effect.flank,
                     e > 0 && effects[e - 1].shape == effect.shape});
    columns_ += ones_.back().columns;
    any_on_one_flank_ = any_on_one_flank_ || effect.flank != FlankChoice::kBoth;
  }
}

void EffectsTogether::evaluate(const FlankGeometry& geometry, const Place& place,
                               double* columns) const {
  const EffectFamily& family = *effects_.front().family;
  const FlankChoice here = flank_of(geometry, place);
  if (family.evaluate_together) {
    family.evaluate_together(geometry, place, effects_, columns);
    if (!any_on_one_flank_) return;
    for (const One& one : ones_)
      if (one.flank != FlankChoice::kBoth && one.flank != here)
        put(kNoColumns.data(), one.columns, columns + one.column);
    return;
  }
  double last[8];
  bool known = false;
  for (std::size_t e = 0; e < ones_.size(); ++e) {
    const One& one = ones_[e];
    known = known && one.same_shape;
    const bool acts = one.flank == FlankChoice::kBoth || one.flank == here;
    if (acts && !known) family.evaluate(geometry, place, effects_[e].shape, last);
    known = known || acts;
    put(acts ? last : kNoColumns.data(), one.columns, columns + one.column);
  }
}

const EffectFamily* find_family(const std::string& id) {
  for (const EffectFamily& family : effect_library())
    if (family.id == id) return &family;
  return nullptr;
}

namespace {

/// What is left of a named effect without its cause: a form, described in terms.
EffectFamily without_cause(const EffectFamily& named) {
  EffectFamily form = named;
  form.id = "unnamed_form";
  form.named = false;
  form.correction.clear();
  form.causes.clear();
  form.cause.clear();
  form.told_from.clear();
  form.causes_told_by.clear();
  form.shown_by.clear();
  form.preference = 3;
  form.form = ParameterForm::kPlain;
  form.parameters = {"cos_um", "sin_um"};
  form.parameters.resize(named.parameters.size());
  for (const std::string& name : named.shape_names)
    form.term_keys.push_back({name, TermKey::Kind::kNumber});
  form.words = [told = named.form_told, description = named.description,
                names = named.shape_names](const ToldForm& of) {
    const std::string& of_sign = told[of.sign() < 0 ? 1 : 0];
    return gear_effects::with_shape(of.sign() == 0 || of_sign.empty() ? description : of_sign,
                                    names, of.shape);
  };
  return form;
}

const std::vector<EffectFamily>& forms_without_cause() {
  static const std::vector<EffectFamily> forms = [] {
    std::vector<EffectFamily> all;
    for (const EffectFamily& family : effect_library())
      if (family.named && !family.form_word.empty()) all.push_back(without_cause(family));
    return all;
  }();
  return forms;
}

}  // namespace

const EffectFamily* find_form(const std::string& form_word) {
  for (const EffectFamily& form : forms_without_cause())
    if (form.form_word == form_word) return &form;
  return nullptr;
}

bool can_have(Makings makings, const EffectFamily& family) {
  return family.causes.empty() ||
         std::any_of(family.causes.begin(), family.causes.end(),
                     [&](const CauseOfMaking& cause) { return (cause.makings & makings) != 0; });
}

std::vector<Effect> candidate_effects(const FlankGeometry& geometry,
                                      const DeclaredFamilies& declared, Makings makings) {
  std::vector<Effect> effects;
  const auto add = [&](const EffectFamily& family) {
    std::vector<std::vector<double>> shapes{{}};
    if (family.shapes) shapes = family.shapes(geometry);
    for (const auto& shape : shapes) {
      if (!family.flank_only) effects.push_back({&family, FlankChoice::kBoth, shape});
      if (!family.one_flank_too && !family.flank_only) continue;
      effects.push_back({&family, FlankChoice::kLeft, shape});
      effects.push_back({&family, FlankChoice::kRight, shape});
    }
  };
  if (declared)
    for (const EffectFamily& family : *declared) add(family);
  for (const EffectFamily& family : effect_library()) {
    if (can_have(makings, family)) add(family);
    else if (const EffectFamily* form = find_form(family.form_word)) add(*form);
  }
  return effects;
}

double normal_part(const FlankGeometry& geometry, const Place& place, double ux, double uy) {
  const double nt = place.surface == Surface::kFlank ? geometry.cos_base_helix() : 1.0;
  const auto& [nx, ny] = place.normal_direction;
  return nt * (ux * nx + uy * ny);
}

}  // namespace trueflank::loop
