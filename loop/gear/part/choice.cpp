// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/choice.h"

#include <algorithm>
#include <cmath>

#include "trueflank/loop/discovery/kept_sums.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/fit/plain_rms.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/forms_of_teeth.h"
#include "trueflank/loop/gear/part/single_teeth.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

void select(PartModel& model) {
  model.choice.reset();
  DiscoveryProblem& problem = candidates_problem(model);
  const Eigen::Index of_pose = problem.nuisance.cols();
  if (!model.options.given.empty())
    add_nuisance(problem,
                 make_problem(model.geometry, model.table, model.patches, model.options.given));
  DiscoveryOptions options;
  options.banned = model.banned;
  // What no flip reaches is as sure as flips can say.
  options.next_level = std::max(kNextLevel / model.options.tables, 1.01 / (options.flips + 1.0));
  // With effects given, something was found already.
  options.first_level =
      model.options.given.empty() ? options.first_level / model.options.tables : options.next_level;
  options.local_level = level_of_tooth(model) / model.options.tables;
  model.choice.emplace(problem, options);
  model.discovery = model.choice->chosen();
  problem.nuisance.conservativeResize(Eigen::NoChange, of_pose);
  if (is_rounding(model)) {
    model.choice.reset();
    model.discovery.chosen.clear();
    model.discovery.first_p_value = model.discovery.first_common_p_value = model.discovery.p_left =
        1.0;
  }
  model.effects = model.options.given;
  for (const ChosenGroup& chosen : model.discovery.chosen)
    model.effects.push_back(model.candidates[chosen.group]);
  ChosenGroup record;
  record.group = -1;
  model.discovery.chosen.insert(model.discovery.chosen.begin(), model.options.given.size(), record);
  const std::size_t told = first_told_here(model);
  for (std::size_t i = 0; i < model.given_p_values.size(); ++i)
    model.discovery.chosen[told + i].p_value = model.given_p_values[i];
}

/// Means of patches know a form with a free shape by its mean there: of a narrow hollow, or of a
/// relief that begins late, patches leave what the single values do not. What looks like another
/// shape of something found, and takes nothing out of the single values, is not left.
void ask_single_values(PartModel& model) {
  constexpr double kNothing = 16.0;  // chi-square a column
  const int group = model.discovery.most_likely_left;
  if (group < 0 || model.discovery.p_left > kNextLevel) return;
  const Effect& left = model.candidates[static_cast<std::size_t>(group)];
  if (!left.family->shape_is_continuous ||
      std::none_of(model.effects.begin(), model.effects.end(),
                   [](const Effect& effect) { return effect.family->shape_is_continuous; }))
    return;
  std::vector<Effect> with = model.effects;
  with.push_back(left);
  const double gain =
      fit_of(model, model.effects)->residual_square() - fit_of(model, with)->residual_square();
  if (gain > kNothing * left.columns()) return;
  model.discovery.p_left = 1.0;
  model.discovery.most_likely_left = -1;
}

/// What the choice leaves and what it is confounded with, which the rounds before the last are not
/// asked.
void finish_choice(PartModel& model) {
  if (!model.choice) return;
  const DiscoveryResult told = std::move(*model.choice).finished();
  model.choice.reset();
  model.discovery.p_left = told.p_left;
  model.discovery.most_likely_left = told.most_likely_left;
  ask_single_values(model);
  model.left_beside = model.effects;
  for (std::size_t i = 0; i < told.chosen.size(); ++i) {
    ChosenGroup& record = model.discovery.chosen[model.options.given.size() + i];
    record.bic_gain = told.chosen[i].bic_gain;
    record.confounded = told.chosen[i].confounded;
  }
}

/// True where a shape moved noticeably.
bool put_refined_shapes_on_the_grid(PartModel& model) {
  const std::vector<Effect> chosen = model.effects;
  // What one moves to another makes room for: both in turn until neither moves.
  constexpr int kMostTurns = 8;
  if (can_be_refined(model.effects, model.options.given.size())) {
    TrialFit fit = fit_to_refine(model.geometry, model.table, model.patches, model.effects);
    for (int turn = 0; turn < kMostTurns; ++turn) {
      refine_shapes(model.geometry, model.options.given.size(), fit);
      if (!refine_nearby(model.geometry, fit)) break;
    }
    model.effects = fit.effects();
  }
  std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
  leave_out_across_steps(model);
  bool moved = false;
  for (std::size_t i = model.options.given.size(); i < model.effects.size(); ++i) {
    for (std::size_t k = 0; k < model.effects[i].shape.size(); ++k)
      moved = moved || std::abs(model.effects[i].shape[k] - chosen[i].shape[k]) >
                           3e-3 * std::abs(chosen[i].shape[k]);
    model.candidates[model.discovery.chosen[i].group].shape = model.effects[i].shape;
  }
  return moved;
}

/// Ways to move that differ only where points went far: the one that leaves least beside the
/// effects that move none. (Others that move the teeth, a scale, make up for what the wrong way
/// leaves.)
void choose_motions(PartModel& model) {
  constexpr double kClearly = 9.0;  // chi-square
  for (std::size_t e = model.options.given.size(); e < model.effects.size(); ++e) {
    const EffectFamily& family = *model.effects[e].family;
    if (!family.other_motions) continue;
    const auto left_with = [&](const EffectShape& shape) {
      std::vector<Effect> all = model.effects, alone;
      all[e].shape = shape;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (i == e || !all[i].family->displacement_mm) alone.push_back(all[i]);
      Observations moved = model.table;
      linearise_at(model.geometry, PointFit(model.geometry, model.table, model.patches, all),
                   moved);
      return PointFit(model.geometry, moved, model.patches, alone).residual_square();
    };
    double least = kNaN;
    for (const EffectShape& other : family.other_motions(model.geometry, model.effects[e].shape)) {
      if (std::isnan(least)) least = left_with(model.effects[e].shape) - kClearly;
      const double left = left_with(other);
      if (!(left < least)) continue;
      least = left;
      model.candidates[model.discovery.chosen[e].group].shape = model.effects[e].shape = other;
    }
  }
}

/// True where scans lie otherwise beside the effects than without them.
bool settle_poses_of_scans(PartModel& model) {
  const std::vector<bool>& free = model.table->pose_is_free;
  if (model.effects.empty() || std::find(free.begin(), free.end(), true) == free.end())
    return false;
  const std::vector<Pose> by =
      poses_beside(model.geometry, *fit_of(model, model.effects), model.table);
  if (by.empty()) return false;
  move_scans(model.geometry, by, model.table.own());
  forget_fits(model);
  divide_into_patches(model);
  leave_out_across_steps(model);
  return true;
}

/// What finite displacements may change of a deviation before all is chosen anew.
double noticed_um(const PointFit& fit) { return 0.02 * fit.noise_um(); }

/// True where finite displacements changed the deviations by more than the noise can hide, or are
/// taken back.
bool linearise(PartModel& model) {
  if (!moves_points(model)) return put_points_back(model);
  if (model.table->points_mm.empty()) return false;
  choose_motions(model);
  const auto fit = fit_of(model, model.effects);
  // Displacements are smooth: where a sample moves by less than half of that, no point moves by
  // more.
  if (model.table->is_displaced &&
      change_of_sample_um(model.geometry, *fit, model.table) < 0.5 * noticed_um(*fit))
    return false;
  const double change = linearise_at(model.geometry, *fit, model.table.own());
  forget_fits(model);
  if (!(change > noticed_um(*fit))) return false;
  divide_into_patches(model);
  leave_out_across_steps(model);
  return true;
}

}  // namespace

void move_back_what_is_off_centre(PartModel& model) {
  constexpr std::size_t kSample = 16384;
  constexpr double kClearly = 100.0;  // chi-square
  if (model.table->points_mm.empty() || model.table->is_displaced || !model.options.given.empty())
    return;
  const EffectFamily* family = find_family("eccentricity");
  for (std::size_t c = 0; c < model.candidates.size(); ++c)
    if (model.candidates[c].family == family && model.banned[c]) return;
  const std::size_t stride = std::max<std::size_t>(1, model.table->rows.size() / kSample);
  const PointFit fit(model.geometry, model.table, model.patches, {{family}}, stride);
  const double gain = fit.residual_square({false}) - fit.residual_square();
  if (!(static_cast<double>(stride) * gain > kClearly) ||
      change_of_sample_um(model.geometry, fit, model.table) < noticed_um(fit))
    return;
  linearise_at(model.geometry, fit, model.table.own());
  forget_fits(model);
  divide_into_patches(model);
}

void explain(PartModel& model) {
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    select(model);

    // Of a scan the sums that are kept for the rest take memory; after the last round they go with
    // the patches.
    if (!model.table->points_mm.empty() || round + 1 == kRounds) finish_choice(model);
    // Off the grid: the choice is made again with the shapes that fit, so that what a coarse
    // shape leaves is not taken for another effect.
    bool again = put_refined_shapes_on_the_grid(model);
    again = ban_misnamed(model) || again;
    again = settle_poses_of_scans(model) || linearise(model) || again;
    if (!again) break;
  }
  finish_choice(model);
}

namespace {

/// The same effects with their places and widths where least is left.
std::vector<Effect> refined(const PartModel& model, const std::vector<Effect>& effects) {
  if (!can_be_refined(effects, first_told_here(model))) return effects;
  TrialFit fit = fit_to_refine(model.geometry, model.table, model.patches, effects);
  refine_shapes(model.geometry, first_told_here(model), fit);
  (void)refine_between_steps(model.geometry, fit);
  return fit.effects();
}

/// Small forms beside a large one of their kind may be what its place and width had left.
void drop_what_mends_a_form(PartModel& model) {
  constexpr double kSmall = 0.5, kLittle = 25.0;  // chi-square: five errors
  for (std::size_t e = model.effects.size(); e-- > first_told_here(model);) {
    const Effect small = model.effects[e];
    const auto fit = fit_of(model, model.effects);
    const auto size_um = [&](std::size_t of) { return fit->effect_size_um(static_cast<int>(of)); };
    bool beside_a_large_one = false;
    for (std::size_t f = 0; f < model.effects.size(); ++f)
      beside_a_large_one =
          beside_a_large_one ||
          (small.is_term() && small.family->nearby && model.effects[f].family == small.family &&
           model.effects[f].flank == small.flank && size_um(e) < kSmall * size_um(f));
    if (!beside_a_large_one) continue;
    std::vector<Effect> without = model.effects;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
    without = refined(model, without);
    if (fit_of(model, without)->residual_square() > fit->residual_square() + kLittle) continue;
    remove_effect(model, e);
    model.effects = std::move(without);
  }
}

}  // namespace

void settle_as_chosen(PartModel& model) {
  constexpr int kRounds = 5;
  leave_out_across_steps(model);
  for (int round = 0; round < kRounds; ++round) {
    model.effects = refined(model, model.effects);
    std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
    leave_out_across_steps(model);
    bool again = settle_poses_of_scans(model);
    again = linearise(model) || again;
    if (!again) break;
  }
}

bool weigh_beside_forms(PartModel& model) {
  constexpr int kMostTurns = 2;
  if (model.effects.empty() || model.table->points_mm.empty() || is_rounding(model)) return false;
  bool any = false;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const auto left_um = fit_of(model, model.effects)->residuals_um();
    if (!weigh_again(model.geometry, model.table, *left_um, model.patches)) break;
    any = true;
    forget_roughness_of_forms(model);
    forget_fits(model);
    leave_out_across_steps(model);
    model.effects = refined(model, model.effects);
    drop_what_mends_a_form(model);
    std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
    leave_out_across_steps(model);
  }
  return any;
}

bool is_rounding(const PartModel& model) {
  constexpr double kFileRounding_um = 0.01, kClearly = 1.1;
  if (least_plain_rms_um(model.geometry, model.table, model.patches) > kClearly * kFileRounding_um)
    return false;
  const auto plain = plain_fit(model);
  return plain->observations() > 0 && plain->errors({}).rms_um < kFileRounding_um;
}

void add_nuisance(DiscoveryProblem& problem, const DiscoveryProblem& fitted) {
  const auto before = problem.nuisance.cols();
  problem.nuisance.conservativeResize(Eigen::NoChange, before + fitted.candidates.cols());
  problem.nuisance.rightCols(fitted.candidates.cols()) = fitted.candidates.cast<double>();
}

DiscoveryProblem& candidates_problem(PartModel& model) {
  if (model.problem.groups.empty()) {
    const KnownColumns known{model.names_of, model.names};
    model.problem = make_problem(model.geometry, model.table, model.patches, model.candidates,
                                 model.names.groups.empty() ? nullptr : &known);
    // (Of large scans, chosen for in a few rounds, what a point takes of memory counts.)
    constexpr std::size_t kMostPoints = 100'000;
    if (model.table->points_mm.size() <= kMostPoints)
      model.problem.kept = std::make_shared<KeptSums>();
  } else {
    set_candidates(model.geometry, model.patches, model.problem_of, model.candidates,
                   model.problem);
    for (std::size_t i = 0; i < model.patches.patches.size(); ++i)
      model.problem.weight[static_cast<Eigen::Index>(i)] = model.patches.patches[i].weight;
  }
  model.names = {};
  model.problem_of = model.candidates;
  return model.problem;
}

void ask_what_is_left(PartModel& model) {
  if (model.effects.empty()) return;
  DiscoveryProblem& problem = candidates_problem(model);
  const Eigen::Index of_pose = problem.nuisance.cols();
  add_nuisance(problem, make_problem(model.geometry, model.table, model.patches, model.effects));
  DiscoveryOptions options;
  options.most_effects = 0;
  options.banned = model.banned;
  const DiscoveryResult asked = discover(problem, options);
  problem.nuisance.conservativeResize(Eigen::NoChange, of_pose);
  model.problem = {};
  model.discovery.p_left = asked.p_left;
  model.discovery.most_likely_left = asked.most_likely_left;
  ask_single_values(model);
  model.left_beside = model.effects;
}

}  // namespace trueflank::loop
