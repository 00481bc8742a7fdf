// SPDX-License-Identifier: GPL-3.0-or-later
// Forms over profile and face at once, the same on every tooth: corners, and what grows over the
// profile times over the face.
#include "trueflank/loop/gear/part/crossed_forms.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {

std::vector<std::vector<std::size_t>> crossed_sets(const PartModel& model, int fewest_values) {
  std::vector<std::size_t> all, names;
  std::vector<Effect> own;
  bool crossed = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Runs runs = runs_of(model.geometry, model.effects[e]);
    if (runs == Runs::kOtherwise) continue;
    all.push_back(e);
    own.push_back(model.effects[e]);
    if (model.effects[e].family->named) names.push_back(e);
    crossed = crossed || runs == Runs::kOverBoth;
  }
  if (!crossed || values_of(own, true) < fewest_values) return {};
  return with_and_without(all, names);
}

bool tell_as_corner(PartModel& model) {
  constexpr int kValuesOfCorner = 5;
  for (const std::vector<std::size_t>& these : crossed_sets(model, kValuesOfCorner + 1))
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
      if (put_one_form_for(model, these, corners(model.geometry, flank))) return true;
  return false;
}

bool tell_as_product(PartModel& model) {
  for (const std::vector<std::size_t>& these : crossed_sets(model, 2))
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
      if (these.size() > 1 && put_one_form_for(model, these, gear_effects::products(flank)))
        return true;
  return false;
}

}  // namespace trueflank::loop
