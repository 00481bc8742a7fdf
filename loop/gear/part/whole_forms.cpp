// SPDX-License-Identifier: GPL-3.0-or-later
// Whole sections that stand aside by an amount that changes with the height, feet of one side and
// play of an axis: what was chosen is in pieces, with names among them. The form is taken up, and
// all else is chosen anew beside it. So are forms of some teeth (forms_of_runs.cpp), and
// sectors with soft edges.
#include "trueflank/loop/gear/part/whole_forms.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/local/section_waves.h"
#include "trueflank/loop/gear/part/body/halves.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/fields.h"
#include "trueflank/loop/gear/part/forms_of_teeth.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/products.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/sectors.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/part/waves.h"

namespace trueflank::loop {
namespace {

/// Moves whole sections: all alike, or by their height.
bool moves_sections(const Effect& effect) {
  return effect.flank == FlankChoice::kBoth && effect.columns() == 2 && effect.order() == 0.0 &&
         static_cast<bool>(effect.family->displacement_mm);
}

/// A form without a name that comes once per turn.
bool is_once_per_turn(const Effect& effect) {
  return effect.family == find_family("unnamed") && effect.order() == 1.0;
}

/// Waves across the flanks that go on by one period a turn: what sections that move in waves leave
/// on the flanks of one side.
bool marches_once_per_turn(const Effect& effect) {
  return effect.family == find_family("unnamed_marks") && std::abs(effect.shape[2]) == 1.0;
}

bool is_curved_over_face(const Effect& effect) {
  return marches_once_per_turn(effect) || effect.family->shape_is_step ||
         effect.family == find_family("unnamed_bow") ||
         (is_once_per_turn(effect) && effect.shape[1] > 1.0);
}

/// The direction in which effects lift the teeth most at an end of the face, against its middle.
double direction_at_end_deg(const FlankGeometry& geometry, const PointFit& fit,
                            const std::vector<std::size_t>& these, double end) {
  const double roll = 0.5 * (geometry.root_form_roll_mm() + geometry.tip_form_roll_mm()),
               middle = 0.5 * geometry.face_width_mm(),
               at_end = end < 0.0 ? 0.0 : geometry.face_width_mm();
  double x = 0.0, y = 0.0;
  std::vector<double> columns;
  for (const std::size_t e : these) {
    const Effect& effect = fit.effects()[e];
    columns.resize(static_cast<std::size_t>(effect.columns()));
    const int first = fit.first_column(static_cast<int>(e));
    for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
      for (const int side : {1, -1})
        for (const double sign : {1.0, -1.0}) {
          effect.evaluate(geometry,
                          geometry.on_flank(tooth, side, roll, sign > 0.0 ? at_end : middle),
                          columns.data());
          double lifts = 0.0;
          for (int k = 0; k < effect.columns(); ++k)
            lifts += columns[static_cast<std::size_t>(k)] * fit.coefficients()[first + k];
          x += sign * lifts * std::cos(geometry.centre_rad(tooth));
          y += sign * lifts * std::sin(geometry.centre_rad(tooth));
        }
  }
  return deg_from_rad(std::atan2(y, x));
}

/// Sections that move in waves over the height, in two steps or softly, for what moves them and
/// comes once per turn. Lengths and heights are sought in what is left without these: the pieces do
/// not lead to them.
std::vector<Effect> with_sections_aside(const PartModel& model, std::vector<std::size_t>& these) {
  constexpr double kTurns = 0.5, kTwoWays = 0.1;  // of the half axes
  std::vector<std::size_t> all, forms_alone;
  std::vector<Effect> others;
  bool curved = false;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const bool piece =
        e >= first_told_here(model) &&
        (moves_sections(effect) || is_once_per_turn(effect) || marches_once_per_turn(effect) ||
         effect.family == find_family("unnamed_bow"));
    if (!piece) {
      others.push_back(effect);
      continue;
    }
    all.push_back(e);
    if (!effect.family->named) forms_alone.push_back(e);
    curved = curved || is_curved_over_face(effect);
  }
  if (!curved || all.size() < 2) return {};
  std::vector<std::vector<std::size_t>> sets{all};
  if (forms_alone.size() < all.size()) sets.push_back(forms_alone);
  for (const std::size_t kept : all)
    if (model.effects[kept].family->named && all.size() > 2) {
      sets.push_back(all);
      std::erase(sets.back(), kept);
    }
  const EffectFamily* family = find_family("unnamed_wobble");
  std::vector<Effect> best;
  double least = 1e300;
  const auto keep_best = [&](const std::vector<Effect>& forms, const std::vector<Effect>& beside) {
    std::vector<std::size_t> set;
    std::vector<Effect> with = cheapest_one_form(model, sets, forms, beside, set);
    const double cost = with.empty() ? 1e300 : cost_of(model, with);
    if (!(cost < least)) return;
    least = cost;
    best = std::move(with);
    these = std::move(set);
  };
  const SectionsAside aside = sections_aside(model.geometry, model.table, model.patches,
                                             *fit_of(model, others)->residuals_um());
  const Effect shift{find_family("layer_shift"), FlankChoice::kBoth, {aside.steps_mm[1]}};
  for (std::size_t c = 0; c < model.candidates.size(); ++c)
    if (model.candidates[c].family == shift.family && !model.unseen[c] && aside.steps_mm[0] > 0.0) {
      keep_best({shift}, {{shift.family, shift.flank, {aside.steps_mm[0]}}});
      break;
    }
  for (const SectionWave& wave : aside.waves) {
    const Effect along{family, FlankChoice::kBoth, {wave.wavelength_mm, wave.towards_deg, 0.0}};
    const double round = std::abs(wave.across_um) / wave.along_um;
    keep_best({along}, {});
    if (round > kTurns)
      keep_best({{family,
                  FlankChoice::kBoth,
                  {wave.wavelength_mm, 0.0, wave.across_um > 0.0 ? 1.0 : -1.0}}},
                {});
    if (round > kTwoWays)
      keep_best({along}, {{family,
                           FlankChoice::kBoth,
                           {wave.wavelength_mm, std::fmod(wave.towards_deg + 90.0, 180.0), 0.0}}});
  }
  keep_best(kinks_of_the_axis(model.geometry), {});
  keep_best(soft_shifts(model.geometry), {});
  if (best.empty()) return {};
  // A bent axis is told as that (tell_as_bow).
  std::vector<std::size_t> set;
  const std::vector<Effect> bent = cheapest_one_form(model, sets, bows_of_the_axis(), {}, set);
  if (!bent.empty() && cost_of(model, bent) < least) return {};
  return best;
}

/// What dies away from an end and is most towards one direction, for a foot and what comes once per
/// turn.
std::vector<Effect> with_one_side(const PartModel& model, std::vector<std::size_t>& these) {
  constexpr int kFewestValues = 4;
  std::vector<std::size_t> once, feet, names;
  std::vector<Effect> own;
  bool curved = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.flank != FlankChoice::kBoth) continue;
    const bool equal_once = is_once_per_turn(effect) && effect.shape[3] == 0.0;
    const bool over_face = runs_of(model.geometry, effect) == Runs::kOverFace;
    const bool foot = over_face && (effect.is_term() || effect.family->tells_its_end);
    const bool name = moves_sections(effect) || (over_face && !foot);
    if (!equal_once && !foot && !name) continue;
    (equal_once ? once : foot ? feet : names).push_back(e);
    own.push_back(effect);
    curved = curved || (equal_once && effect.shape[1] > 1.0) ||
             (moves_sections(effect) && effect.needs().several_heights && !feet.empty());
  }
  if (!curved || values_of(own, true) < kFewestValues) return {};
  std::vector<std::vector<std::size_t>> sets{once};
  const auto add = [&](std::vector<std::size_t> set, const std::vector<std::size_t>& more) {
    if (more.empty()) return;
    set.insert(set.end(), more.begin(), more.end());
    std::sort(set.begin(), set.end());
    sets.push_back(std::move(set));
  };
  add(once, feet);
  add(sets.back(), names);
  const auto fit = fit_of(model, model.effects);
  std::vector<Effect> forms;
  for (const double end : {-1.0, 1.0}) {
    const double towards_deg = direction_at_end_deg(model.geometry, *fit, sets.back(), end);
    // (what is missing is most on the other side)
    for (const auto& [turned_deg, opposite] :
         {std::pair(0.0, 0.0), std::pair(180.0, 0.0), std::pair(0.0, 1.0)})
      for (const double within : {0.04, 0.08, 0.14, 0.22})
        forms.push_back(
            {find_family("unnamed_one_side"),
             FlankChoice::kBoth,
             {end, within * model.geometry.face_width_mm(), towards_deg + turned_deg, opposite}});
  }
  return cheapest_one_form(model, sets, forms, {}, these);
}

/// Play of an axis, for what differs from tooth to tooth and does not run along the flanks.
std::vector<Effect> with_reversal(const PartModel& model, std::vector<std::size_t>& these) {
  constexpr std::size_t kFewest = 3;
  std::vector<std::size_t> around, with_moves;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const bool moves = moves_sections(effect);
    if (!moves && runs_of(model.geometry, effect) != Runs::kOtherwise) continue;
    with_moves.push_back(e);
    if (!moves) around.push_back(e);
  }
  if (around.size() < kFewest) return {};
  std::vector<std::vector<std::size_t>> sets{around};
  if (with_moves.size() > around.size()) sets.push_back(with_moves);
  const EffectFamily* family = find_family("unnamed_reversal");
  const Effect x{family, FlankChoice::kBoth, {0.0}}, y{family, FlankChoice::kBoth, {1.0}};
  std::vector<Effect> one = cheapest_one_form(model, sets, {x, y}, {}, these);
  std::vector<std::size_t> of_both;
  std::vector<Effect> both = cheapest_one_form(model, sets, {x}, {y}, of_both);
  if (both.empty() || (!one.empty() && cost_of(model, one) <= cost_of(model, both))) return one;
  these = std::move(of_both);
  return both;
}

/// True where one of these forms stands for what was chosen: it is taken up in place of that.
bool take_up_whole_forms(PartModel& model) {
  std::vector<std::size_t> these;
  RemainderFinding finding;
  std::vector<Effect> with = with_form_on_teeth(model, these, finding.p_value);
  if (with.empty()) with = with_wave_of_the_tool(model, these);
  if (with.empty()) with = with_walls_of_one_side(model, these);
  if (with.empty()) with = with_sections_aside(model, these);
  if (with.empty()) with = with_one_side(model, these);
  if (with.empty()) with = with_halves(model, these);
  if (with.empty()) with = with_reversal(model, these);
  if (with.empty()) with = with_products(model, these);
  if (with.empty()) with = with_form_growing_across(model, these);
  if (with.empty()) with = with_comb(model, these);
  if (with.empty()) with = with_growing_wave(model, these);
  if (with.empty()) with = with_phase_of_each_flank(model, these);
  if (with.empty()) {
    with = with_sector(model, these);
    if (with.empty() || with.back().family != find_family("unnamed_soft_sector") ||
        fit_of(model, with)->residual_square() > fit_of(model, model.effects)->residual_square())
      return false;
  }
  for (const std::size_t e : these)
    finding.p_value = std::min(finding.p_value, model.discovery.chosen[e].p_value);
  // Forms that were taken up before and are pieces of it go.
  const std::size_t told = first_told_here(model);
  for (std::size_t i = these.size(); i-- > 0;)
    if (these[i] < model.options.given.size()) {
      model.options.given.erase(model.options.given.begin() +
                                static_cast<std::ptrdiff_t>(these[i]));
      model.given_p_values.erase(model.given_p_values.begin() +
                                 static_cast<std::ptrdiff_t>(these[i] - told));
    }
  // What was denied beside the pieces is asked again.
  model.banned = model.unseen;
  for (std::size_t e = model.effects.size() - these.size(); e < with.size(); ++e) {
    finding.effect = with[e];
    take_up(model, finding);
  }
  forget_roughness_of_forms(model);
  return true;
}

}  // namespace

std::vector<Effect> cheapest_one_form(const PartModel& model,
                                      const std::vector<std::vector<std::size_t>>& sets,
                                      const std::vector<Effect>& forms,
                                      const std::vector<Effect>& beside,
                                      std::vector<std::size_t>& these) {
  constexpr double kMostOfIt = 0.8;  // of chi-square
  CheapestAnswer best;
  for (const std::vector<std::size_t>& set : sets) {
    if (set.empty()) continue;
    std::vector<Effect> with = one_form_for(model, set, forms, beside);
    if (with.empty()) continue;
    const double none = fit_of(model, without(model.effects, set))->residual_square();
    if (none - fit_of(model, with)->residual_square() <
        kMostOfIt * (none - fit_of(model, model.effects)->residual_square()))
      continue;
    best.ask(model, std::move(with), set);
  }
  if (!best.effects.empty()) these = std::move(best.these);
  return std::move(best.effects);
}

void explain_with_whole_forms(PartModel& model) {
  constexpr int kMost = 3;
  if (model.options.joined || model.table->rows.empty()) return;
  for (int round = 0; round < kMost && take_up_whole_forms(model); ++round) explain(model);
}

}  // namespace trueflank::loop
