// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/body/wider_body.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/part/body/body_forms.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/whole_forms.h"

namespace trueflank::loop {

using gear_effects::FlankCourse;

bool has_lands(const Observations& table) {
  constexpr std::ptrdiff_t kFewest = 20;  // points
  return !table.points_mm.empty() &&
         std::count_if(table.rows.begin(), table.rows.end(), [](const Observation& row) {
           return row.kind == ObservationKind::kScanTip || row.kind == ObservationKind::kScanRoot;
         }) >= kFewest;
}

bool tell_as_wider_body(PartModel& model) {
  constexpr std::size_t kFewest = 2;
  if (!has_lands(model.table)) return false;
  std::vector<std::size_t> all, names;
  bool along_face = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.flank != FlankChoice::kBoth || effect.columns() != 1) continue;
    const Runs runs = runs_of(model.geometry, effect);
    if (runs == Runs::kOtherwise && !effect.family->displacement_mm) continue;
    all.push_back(e);
    if (effect.family->named) names.push_back(e);
    along_face = along_face || (runs == Runs::kOverFace && !effect.family->named);
  }
  if (!along_face || all.size() < kFewest) return false;
  std::vector<FlankCourse> courses = courses_of_a_width(model.geometry);
  // A sharp edge is where the flanks have theirs: from beside it a band may come nearer.
  const double face_mm = model.geometry.face_width_mm();
  for (const std::size_t e : all) {
    const Effect& step = model.effects[e];
    if (step.family != find_family("unnamed_step") || step.shape[0] != 1.0) continue;
    for (const double towards : {-1.0, 1.0})
      for (const double half_mm : {0.0, 0.04 * face_mm, 0.12 * face_mm})
        courses.push_back({FlankCourse::kStep, step.shape[1], towards, half_mm});
  }
  std::vector<std::vector<std::size_t>> sets{all};
  for (const std::size_t kept : names) {
    sets.push_back(all);
    std::erase(sets.back(), kept);
  }
  std::erase_if(sets, [](const std::vector<std::size_t>& set) { return set.size() < kFewest; });
  std::vector<std::size_t> these;
  const std::vector<Effect> with = cheapest_one_form(model, sets, wider_bodies(courses), {}, these);
  if (with.empty()) return false;
  put_in_place_of(model, these, with);
  return true;
}

}  // namespace trueflank::loop
