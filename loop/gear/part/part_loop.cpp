// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/part_loop.h"

#include <optional>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/body/lone_place.h"
#include "trueflank/loop/gear/part/body/walls_by_direction.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/clampings/clampings.h"
#include "trueflank/loop/gear/part/ends.h"
#include "trueflank/loop/gear/part/few_index_values.h"
#include "trueflank/loop/gear/part/forms_around.h"
#include "trueflank/loop/gear/part/names/equal_names.h"
#include "trueflank/loop/gear/part/names/names.h"
#include "trueflank/loop/gear/part/names/settled_names.h"
#include "trueflank/loop/gear/part/names/slopes_beside_waves.h"
#include "trueflank/loop/gear/part/one_flank.h"
#include "trueflank/loop/gear/part/other_starts.h"
#include "trueflank/loop/gear/part/parts_of_forms.h"
#include "trueflank/loop/gear/part/points_aside.h"
#include "trueflank/loop/gear/part/records.h"
#include "trueflank/loop/gear/part/scans/pits.h"
#include "trueflank/loop/gear/part/scans/pixels.h"
#include "trueflank/loop/gear/part/scans/some_points.h"
#include "trueflank/loop/gear/part/single_teeth.h"
#include "trueflank/loop/gear/part/structure_left.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/part/tidying.h"
#include "trueflank/loop/gear/part/waves.h"
#include "trueflank/loop/gear/part/whole_forms.h"

namespace trueflank::loop {
namespace {

/// Takes up what is left and chooses anew, some rounds. Beside many forms a choice may come to
/// less than one before it, and the next to more: the best is kept (of traces: scans may have
/// moved).
void explain_what_is_left(PartModel& model) {
  struct Chosen {
    std::vector<Effect> effects, candidates, given;
    std::vector<double> given_p_values;
    DiscoveryResult discovery;
    std::vector<bool> banned, unseen;
  };
  constexpr int kRounds = 5;
  const bool keep = model.table->points_mm.empty();
  Chosen best;
  double least = kNaN;
  const auto keep_if_best = [&] {
    const double cost = cost_of(model, model.effects);
    if (cost > least) return;
    least = cost;
    best = {model.effects,   model.candidates, model.options.given, model.given_p_values,
            model.discovery, model.banned,     model.unseen};
  };
  if (keep) keep_if_best();
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Effect> before = model.effects;
    if (!take_up_remainder(model)) break;
    explain(model);
    if (take_up_again(model, before)) explain(model);
    if (keep) keep_if_best();
  }
  if (!keep || cost_of(model, model.effects) <= least) return;
  model.effects = std::move(best.effects);
  model.candidates = std::move(best.candidates);
  model.options.given = std::move(best.given);
  model.given_p_values = std::move(best.given_p_values);
  model.discovery = std::move(best.discovery);
  model.banned = std::move(best.banned);
  model.unseen = std::move(best.unseen);
  leave_out_across_steps(model);
}

void tell_what_is_left(PartModel& model) {
  model.remainder = remainder_of(model, model.effects, RemainderOf::kAll);
  while (structure_is_left(model) && name_what_is_left(model))
    model.remainder = remainder_of(model, model.effects, RemainderOf::kAll);
  while (structure_is_left(model) && add_form_that_is_left(model)) {
    tell_what_one_flank_has(model);
    model.remainder = remainder_of(model, model.effects, RemainderOf::kAll);
  }
  if (!structure_is_left(model)) {
    tell_pattern_alike_over_height(model);
    return;
  }
  if (model.remainder.empty() && model.effects != model.left_beside) ask_what_is_left(model);
  if (!structure_is_left(model)) return;
  doubt_names_below_what_is_left(model);
  model.remainder = remainder_of(model, model.effects, RemainderOf::kAll);
}

}  // namespace

void explain_part(PartModel& model) {
  divide_into_patches(model);
  ban_what_cannot_be_seen(model);
  model.unseen = model.banned;
  ban_pitch_in_runouts(model);
  ban_given(model);
  // (what so few values leave says nothing more)
  const std::optional<RemainderFinding> of_few =
      model.options.names_only ? std::nullopt : eccentricity_of_few_values(model);
  if (of_few) take_up(model, *of_few);
  const bool scan_for_more =
      !of_few && !model.options.joined && !model.options.names_only && !is_rounding(model);
  if (scan_for_more) nominate(model);
  move_back_what_is_off_centre(model);
  explain(model);
  if (scan_for_more && explain_by_some_points(model)) return;
  if (scan_for_more) explain_with_whole_forms(model);
  if (scan_for_more && begins_better(model)) return;
  constexpr int kRounds = 4, kMostBans = 6;
  if (scan_for_more) explain_what_is_left(model);
  if (scan_for_more) explain_with_whole_forms(model);
  if (scan_for_more && drop_idle_forms(model)) explain(model);
  for (int round = 0; scan_for_more && round < kRounds && drop_doubtful_orders(model); ++round)
    explain(model);
  for (int round = 0; scan_for_more && round < kMostBans && ban_what_forms_explain(model); ++round)
    explain(model);
  if (scan_for_more) hold_to_single_values(model);
  if (!is_rounding(model)) look_at_single_teeth(model);
  look_at_sizes(model);
  drop_impossible(model);
  drop_what_mends_a_shape(model);
  drop_what_mends_another_way(model);
  if (scan_for_more) drop_doubtful_names(model);
  join_flanks(model);
  if (scan_for_more) tell_parts_of_a_form(model);
  if (!is_rounding(model) && !model.options.joined) look_at_neighbours(model);
  model.problem = {};  // all is chosen: its columns take a fifth of the memory of a large scan
  veto(model);
  if (of_few) tell_names_that_one_side_leaves_open(model);
  if (!scan_for_more) return;
  prefer_names(model);
  prefer_one_name_to_two(model);
  tell_the_usual_of_equals(model);
  tell_clampings_of_flanks(model);
  take_other_start(model);
  doubt_size_of_flanks(model);
  tell_waves_of_one_flank(model);
  take_form_around(model);
  tell_what_one_flank_has(model);
  tell_opposite_forms(model);
  tell_waves_as_pattern(model);
  name_what_is_settled(model);
  tell_slopes_beside_waves(model);
  tell_likeliest_names(model);
  tell_the_usual_of_equals(model);
  drop_names_that_may_be_nothing(model);
  tell_both_ends_as_one(model);
  tell_ends_as_they_fit(model);
  tell_walls_by_direction(model);
  tell_names_that_one_side_leaves_open(model);
  tell_what_is_left(model);
  if (tell_lone_places(model)) tell_what_is_left(model);
}

void explain_measured_part(PartModel& model) {
  begin_with_pits(model);
  explain_part(model);
  const std::optional<RemainderFinding> aside = explain_without_points_aside(model);
  if (weigh_beside_forms(model)) {
    look_at_neighbours(model);
    tell_what_is_left(model);
  }
  if (aside) model.remainder.insert(model.remainder.begin(), *aside);
  say_how_sure_pits_are(model);
}

}  // namespace trueflank::loop
