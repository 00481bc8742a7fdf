// SPDX-License-Identifier: GPL-3.0-or-later
// Places and widths of a form are as plain in twenty thousand points as in a million, and a search
// takes the longer the more points there are.
#include "trueflank/loop/gear/part/scans/some_points.h"

#include <algorithm>
#include <utility>

#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/names/settled_names.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/structure_left.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/table/thinned_rows.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kMany = 60'000, kSome = 20'000;  // points

/// Some of the points of its scans, and all that was measured otherwise.
Observations thinned(const Observations& table) {
  Observations some;
  const ThinnedRows kept(table.points_mm.size(), kSome);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (i < table.points_mm.size()) {
      if (!kept.has(i)) continue;
      some.points_mm.push_back(table.points_mm[i]);
    }
    Observation row = table.rows[i];
    const auto first = table.places.begin() + static_cast<std::ptrdiff_t>(row.first_place);
    row.first_place = static_cast<decltype(row.first_place)>(some.places.size());
    some.places.insert(some.places.end(), first, first + static_cast<std::ptrdiff_t>(row.places));
    if (!table.sigmas_um.empty()) {
      some.sigmas_um.resize(some.places.size(), kNaN);
      some.sigmas_um[row.first_place] = table.sigma_um(table.rows[i]);
    }
    some.rows.push_back(row);
  }
  some.size_degrees = table.size_degrees;
  some.traces = table.traces;
  some.is_displaced = table.is_displaced;
  some.poses = table.poses;
  some.pose_is_free = table.pose_is_free;
  some.files = table.files;
  return some;
}

/// A form without a name, or several teeth: names alone are chosen as fast from all points.
bool needs_a_search(const std::vector<Effect>& effects) {
  constexpr int kSeveral = 3;
  const auto is_local = [](const Effect& effect) { return effect.family->local; };
  return std::count_if(effects.begin(), effects.end(), is_local) >= kSeveral ||
         std::any_of(effects.begin(), effects.end(),
                     [](const Effect& effect) { return effect.is_term(); });
}

}  // namespace

bool explain_by_some_points(PartModel& model) {
  PartOptions options = model.options;
  if (model.table->points_mm.size() < kMany || options.joined || options.names_only ||
      !options.start.empty() || !needs_a_search(model.effects))
    return false;
  options.given.resize(first_told_here(model));
  SharedTable measured = model.table;
  if (measured->is_displaced) undo_displacement(model.geometry, measured.own());
  model.problem = {};  // (it takes memory for every point)
  PartModel some(model.geometry, thinned(measured), options);
  explain_part(some);
  PartModel whole(model.geometry, std::move(measured), std::move(options));
  divide_into_patches(whole);
  take_over_choice(whole, some);
  settle_as_chosen(whole);
  name_what_is_settled(whole);
  whole.remainder = remainder_of(whole, whole.effects, RemainderOf::kAll);
  ask_what_is_left(whole);
  if (structure_is_left(whole)) return false;
  model.alone = std::move(some.alone);
  model.remainder.clear();
  take_over(model, whole);
  return true;
}

}  // namespace trueflank::loop
