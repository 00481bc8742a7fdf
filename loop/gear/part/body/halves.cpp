// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/body/halves.h"

#include <algorithm>

#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/whole_forms.h"

namespace trueflank::loop {

std::vector<Effect> with_halves(const PartModel& model, std::vector<std::size_t>& these) {
  constexpr std::size_t kFewest = 2;
  constexpr int kFewestValues = 4;
  std::vector<std::size_t> around, names, sizes;
  std::vector<Effect> pieces;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const Runs runs = runs_of(model.geometry, effect);
    const NeedsToBeSeen needs = effect.needs();
    // (the split runs through teeth)
    const bool of_a_tooth = effect.family->local || gear_effects::is_of_teeth(effect);
    const bool size = effect.columns() == 1 && effect.order() == 0.0 && !of_a_tooth &&
                      (effect.family->displacement_mm || effect.family->walls_outside_um ||
                       runs == Runs::kNowhere);
    const bool goes_around =
        of_a_tooth ||
        (!size && runs == Runs::kOtherwise && !effect.family->tells_order_along_profile &&
         !needs.along_profile && !needs.along_face && !needs.several_heights);
    if (!goes_around && !size) continue;
    (size ? sizes : around).push_back(e);
    if (!size && effect.family->named) names.push_back(e);
    if (!size) pieces.push_back(effect);
  }
  if (around.size() < kFewest || values_of(pieces, true) < kFewestValues) return {};
  std::vector<std::vector<std::size_t>> sets = with_and_without(around, names);
  if (!sizes.empty())
    for (std::size_t k = 0, count = sets.size(); k < count; ++k) {
      std::vector<std::size_t> set = sets[k];
      set.insert(set.end(), sizes.begin(), sizes.end());
      std::sort(set.begin(), set.end());
      sets.push_back(std::move(set));
    }
  std::erase_if(sets, [](const std::vector<std::size_t>& set) { return set.size() < kFewest; });
  // (between two teeth nothing changes as the split is moved)
  const double apart_deg = 60.0 / model.geometry.teeth();
  std::vector<Effect> forms;
  for (double towards = 0.0; towards < 180.0; towards += apart_deg)
    forms.push_back({find_family("unnamed_halves"), FlankChoice::kBoth, {towards}});
  return cheapest_one_form(model, sets, forms, {}, these);
}

}  // namespace trueflank::loop
