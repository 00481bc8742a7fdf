// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/part_model.h"

#include <algorithm>
#include <utility>

#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/finite_displacement.h"

namespace trueflank::loop {

PartModel::PartModel(const FlankGeometry& of_geometry, SharedTable of_table, PartOptions with)
    : geometry(of_geometry),
      options(std::move(with)),
      table(std::move(of_table)),
      candidates(candidate_effects(geometry, options.declared, options.makings)) {
  const bool scanned = !table->points_mm.empty();
  std::erase_if(candidates, [&](const Effect& effect) {
    const std::vector<const EffectFamily*>& without = options.without;
    return (scanned && effect.family->of_traces_only) || (options.names_only && effect.is_term()) ||
           std::find(without.begin(), without.end(), effect.family) != without.end();
  });
  banned.assign(candidates.size(), false);
}

void divide_into_patches(PartModel& model) {
  model.patches = make_patches(model.geometry, model.table);
  forget_roughness_of_forms(model);
  model.problem = {};
  forget_fits(model);
}

void forget_roughness_of_forms(PartModel& model) {
  if (std::any_of(model.options.given.begin(), model.options.given.end(),
                  gear_effects::is_of_teeth))
    model.patches.flank_scatters.clear();
}

void forget_fits(PartModel& model) {
  model.fits.clear();
  model.plain_fit.reset();
  model.plain_um.reset();
  model.sought.clear();
  model.no_products_in.clear();
  model.names = {};
}

std::shared_ptr<const PointFit> fit_of(const PartModel& model, const std::vector<Effect>& effects) {
  if (effects.empty() && !model.table->is_displaced) return plain_fit(model);
  // (of a scan they take memory for every unit)
  const std::size_t most = model.table->points_mm.empty() ? 6 : 3;
  auto found = std::find_if(model.fits.begin(), model.fits.end(),
                            [&](const auto& fit) { return fit->effects() == effects; });
  if (found == model.fits.end()) {
    if (model.fits.size() == most) model.fits.pop_back();
    auto fit = std::make_shared<const PointFit>(model.geometry, model.table, model.patches, effects,
                                                1, DeviationsOf::kTable, model.fits);
    found = model.fits.insert(model.fits.end(), std::move(fit));
  }
  std::rotate(model.fits.begin(), found, found + 1);
  // (what a fit leaves is asked several times while it is asked for, and takes memory for every
  // row)
  constexpr std::size_t kMostKept = 500'000;
  if (model.table->rows.size() > kMostKept)
    for (std::size_t k = 1; k < model.fits.size(); ++k) model.fits[k]->forget_residuals();
  return model.fits.front();
}

std::shared_ptr<const PointFit> plain_fit(const PartModel& model) {
  if (!model.plain_fit)
    model.plain_fit =
        std::make_shared<const PointFit>(model.geometry, model.table, model.patches,
                                         std::vector<Effect>(), 1, DeviationsOf::kDesign);
  return model.plain_fit;
}

void leave_out_across_steps(PartModel& model) {
  model.kept = {};
  std::vector<double> heights_mm;
  for (const Effect& effect : model.effects)
    if (effect.family->shape_is_step) heights_mm.push_back(effect.shape[0]);
  const bool some_were = !model.patches.left_out.empty();
  model.patches.leave_out_across(heights_mm);
  if (some_were || !model.patches.left_out.empty()) forget_fits(model);
}

bool moves_points(const PartModel& model) {
  return std::any_of(model.effects.begin(), model.effects.end(), [](const Effect& effect) {
    return static_cast<bool>(effect.family->displacement_mm);
  });
}

bool put_points_back(PartModel& model) {
  if (!model.table->is_displaced) return false;
  undo_displacement(model.geometry, model.table.own());
  forget_fits(model);
  divide_into_patches(model);
  leave_out_across_steps(model);
  return true;
}

void put_in_place_of(PartModel& model, const std::vector<std::size_t>& these,
                     const std::vector<Effect>& with) {
  ChosenGroup record;
  record.group = -1;
  for (const std::size_t e : these)
    record.p_value = std::min(record.p_value, model.discovery.chosen[e].p_value);
  for (std::size_t i = these.size(); i-- > 0;) remove_effect(model, these[i]);
  // What else has a place beside its own moved with it.
  std::copy_n(with.begin(), model.effects.size(), model.effects.begin());
  std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
  for (std::size_t e = model.effects.size(); e < with.size(); ++e) {
    model.effects.push_back(with[e]);
    model.discovery.chosen.push_back(record);
  }
}

void remove_effect(PartModel& model, std::size_t e) {
  const std::size_t told = first_told_here(model);
  const auto at = static_cast<std::ptrdiff_t>(e);
  model.effects.erase(model.effects.begin() + at);
  model.discovery.chosen.erase(model.discovery.chosen.begin() + at);
  if (e >= model.options.given.size()) return;
  model.options.given.erase(model.options.given.begin() + at);
  model.given_p_values.erase(model.given_p_values.begin() + static_cast<std::ptrdiff_t>(e - told));
}

void take_over_choice(PartModel& model, const PartModel& other) {
  model.effects = other.effects;
  model.discovery = other.discovery;
  model.candidates = other.candidates;
  model.banned = other.banned;
  model.unseen = other.unseen;
  model.options.given = other.options.given;
  model.given_p_values = other.given_p_values;
  model.neighbours = other.neighbours;
  model.vetoed = other.vetoed;
  model.denied_spot = other.denied_spot;
}

void take_over(PartModel& model, PartModel& other) {
  take_over_choice(model, other);
  model.left_beside = std::move(other.left_beside);
  model.table = other.table;
  model.patches = std::move(other.patches);
  model.problem = {};
  model.kept.valid = false;
  forget_fits(model);
}

void add_candidate(PartModel& model, Effect effect) {
  model.candidates.push_back(std::move(effect));
  model.banned.push_back(false);
  model.unseen.push_back(false);
}

bool has_single_values_only(const PartModel& model) {
  return std::none_of(
      model.table->rows.begin(), model.table->rows.end(), [](const Observation& row) {
        return row.kind != ObservationKind::kIndex && row.kind != ObservationKind::kRadial &&
               row.kind != ObservationKind::kSize;
      });
}

double cost_of(const PartModel& model, const std::vector<Effect>& effects) {
  return fit_of(model, effects)->residual_square() + kChiSquareOfValue * values_of(effects, true);
}

int values_of(const std::vector<Effect>& effects, bool places_too) {
  int values = 0;
  for (const Effect& effect : effects) {
    const EffectFamily& family = *effect.family;
    values += effect.columns();
    if (!places_too) continue;
    if (family.values_sought)
      values += family.values_sought(effect.shape);
    else if (family.named || !family.form_word.empty())
      values += family.shape_is_continuous ? static_cast<int>(effect.shape.size()) : 0;
    else
      values += static_cast<int>(
          std::count_if(family.term_keys.begin(), family.term_keys.end(),
                        [](const TermKey& key) { return key.kind == TermKey::Kind::kNumber; }));
  }
  return values;
}

}  // namespace trueflank::loop
