// SPDX-License-Identifier: GPL-3.0-or-later
// Forms over profile and face at once, the same on every tooth: corners, and what grows over the
// profile times over the face.
#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {

/// All that is the same on every tooth, and that less each name, and less all names; empty where
/// nothing of it runs over profile and face at once, or it has fewer values.
std::vector<std::vector<std::size_t>> PartLoop::crossed_sets(int fewest_values) const {
  std::vector<std::size_t> all, names;
  std::vector<Effect> own;
  bool crossed = false;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    const Runs runs = runs_of(geometry_, effects_[e]);
    if (runs == Runs::kOtherwise) continue;
    all.push_back(e);
    own.push_back(effects_[e]);
    if (effects_[e].family->named) names.push_back(e);
    crossed = crossed || runs == Runs::kOverBoth;
  }
  if (!crossed || values_of(own, true) < fewest_values) return {};
  std::vector<std::vector<std::size_t>> sets{all};
  for (const std::size_t kept : names) {
    sets.push_back(all);
    std::erase(sets.back(), kept);
  }
  if (names.size() > 1) {
    sets.push_back(all);
    for (const std::size_t kept : names) std::erase(sets.back(), kept);
  }
  std::erase_if(sets, [](const auto& set) { return set.empty(); });
  return sets;
}

/// A corner of the flanks of one side, or of both, for all that is the same on every tooth: slopes
/// of both flanks, alike and opposite, are one of one side. A name may stand beside it.
bool PartLoop::tell_as_corner() {
  constexpr int kValuesOfCorner = 5;
  for (const std::vector<std::size_t>& these : crossed_sets(kValuesOfCorner + 1))
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
      if (put_one_form_for(these, corners(geometry_, flank))) return true;
  return false;
}

/// What grows over the profile times over the face, for two or more that are the same on every
/// tooth: a taper, a twist and a bow of a cure that reaches less far down.
bool PartLoop::tell_as_product() {
  for (const std::vector<std::size_t>& these : crossed_sets(2))
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
      if (these.size() > 1 && put_one_form_for(these, gear_effects::products(flank))) return true;
  return false;
}

}  // namespace trueflank::loop
