// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/place_profile.h"

// Which of all forms that may be all that a bench holds are the likeliest beside others.
namespace trueflank::loop {

void DriveSelection::fill_whole_columns() {
  const DriveContext here = context();
  const bool both = table_.has(true) && table_.has(false);
  if (!whole_.effects.empty() && whole_.state == state_) return;
  whole_ = {.effects = {}, .columns = {}, .state = state_};
  for (const DriveFamily& family : drive_library()) {
    // (in one direction a loss says it, unless power is gained)
    if (!family.whole_shapes ||
        (!family.is_loss && !both && !gains_power() && !family.asked_of_one_direction))
      continue;
    for (DriveShape& shape : family.whole_shapes(here))
      whole_.effects.push_back({&family, std::move(shape)});
  }
  const BesideEffects beside(here, value_, {}, FitRows::kTraining);
  whole_.columns = beside.columns_of(whole_.effects);
}

std::vector<DriveSelection::WholeForm> DriveSelection::likeliest_whole_forms(
    const AskedBeside& asked, const BesideEffects& beside) const {
  constexpr std::size_t kMostForms = 10;
  constexpr double kLeastGain = 0.1;  // of what the base leaves
  const std::vector<DriveEffect>& base = asked.base;
  std::vector<WholeForm> forms;
  const auto is_taken = [&](const DriveEffect& form) {
    const auto kind = [](const DriveEffect& e) {
      return e.family->kind ? e.family->kind(e.shape) : 0;
    };
    return std::any_of(base.begin(), base.end(), [&](const DriveEffect& e) {
      return e.family == form.family && kind(e) == kind(form);
    });
  };
  const Eigen::VectorXf gains = beside.gains(whole_.columns);
  // Of every family and kind the likeliest.
  struct Likeliest {
    double most = 0.0;
    std::size_t looks = 0, at = 0;
  };
  std::map<std::pair<const DriveFamily*, int>, Likeliest> likeliest;
  for (std::size_t k = 0; k < whole_.effects.size(); ++k) {
    const DriveEffect& effect = whole_.effects[k];
    if (!may_be_there(*effect.family)) continue;
    Likeliest& best =
        likeliest[{effect.family, effect.family->kind ? effect.family->kind(effect.shape) : 0}];
    ++best.looks;
    const double gain = gains[static_cast<Eigen::Index>(k)];
    if (gain <= best.most) continue;
    best.most = gain;
    best.at = k;
  }
  for (const auto& [kind, best] : likeliest) {
    if (best.most < kLeastGain * beside.square()) continue;
    forms.push_back(
        {whole_.effects[best.at], best.most, cost_of_looks(best.looks) + kind.first->dearer});
  }
  if (asked.with_places && (!gains_power() || losses_beside_gains_))
    for (const double over : {0.0, 1.0, 2.0})
      for (const DriveEffect& form : likeliest_forms(base, over))
        if (!form.family->named && !is_taken(form) && form.columns() == 1)
          forms.push_back({form, beside.with(form).gain, cost_of_looks(100)});
  add_waves_over_the_angle(base, forms);
  std::erase_if(forms, [&](const WholeForm& f) { return f.gain < kLeastGain * beside.square(); });
  std::stable_sort(forms.begin(), forms.end(),
                   [](const WholeForm& a, const WholeForm& b) { return a.gain > b.gain; });
  // (what follows the rows before is asked beside these, not in the place of one)
  constexpr double kMuchOfMost = 0.5;
  const double most = forms.empty() ? 0.0 : forms.front().gain;
  std::size_t kept = 0;
  std::erase_if(forms, [&](const WholeForm& f) {
    return f.effect.family->follows_rows_before ? f.gain < kMuchOfMost * most : ++kept > kMostForms;
  });
  return forms;
}

std::vector<std::vector<DriveSelection::WholeForm>> DriveSelection::whole_forms(
    const std::vector<AskedBeside>& asked) const {
  const DriveContext here = context();
  std::vector<BesideEffects> beside;
  beside.reserve(asked.size());
  for (const AskedBeside& one : asked)
    beside.emplace_back(here, value_, one.base, FitRows::kTraining);
  std::vector<std::vector<WholeForm>> found(asked.size());
  std::vector<AskedForm> near;
  std::vector<std::pair<std::size_t, std::size_t>> of_near;  // which of whose forms
  for (std::size_t a = 0; a < asked.size(); ++a)
    for (const WholeForm& form : likeliest_whole_forms(asked[a], beside[a])) {
      const DriveFamily& family = *form.effect.family;
      const bool in_steps = family.falls_in_steps && family.whole_shapes;
      std::vector<DriveEffect> effects = asked[a].base;
      effects.push_back(form.effect);
      if (!in_steps) refine_drive_shapes(here, value_, FitRows::kTraining, effects);
      const DriveShape shape = effects.back().shape;
      for (const DriveShape& kin : family.kin_shapes&& family.whole_shapes
                                       ? family.kin_shapes(shape)
                                       : std::vector<DriveShape>{shape}) {
        found[a].push_back({{&family, kin}, form.gain, form.looks});
        if (!in_steps) continue;
        near.push_back({&beside[a], {&family, kin}});
        of_near.emplace_back(a, found[a].size() - 1);
      }
    }
  move_to_nearest_best(here, near);
  for (std::size_t k = 0; k < near.size(); ++k)
    found[of_near[k].first][of_near[k].second].effect = near[k].form;
  return found;
}

}  // namespace trueflank::loop
