// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/part_loop.h"

#include <algorithm>
#include <cmath>

#include "trueflank/loop/discovery/kept_sums.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/found_effects.h"
#include "trueflank/loop/gear/plain_rms.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {

PartLoop::PartLoop(const FlankGeometry& geometry, SharedTable table, Options options)
    : geometry_(geometry),
      options_(std::move(options)),
      table_(std::move(table)),
      candidates_(candidate_effects(geometry, options_.declared, options_.makings)) {
  const bool scanned = !table_->points_mm.empty();
  std::erase_if(candidates_, [&](const Effect& effect) {
    const std::vector<const EffectFamily*>& without = options_.without;
    return (scanned && effect.family->of_traces_only) ||
           (options_.names_only && effect.is_term()) ||
           std::find(without.begin(), without.end(), effect.family) != without.end();
  });
  banned_.assign(candidates_.size(), false);
}

void PartLoop::divide_into_patches() {
  patches_ = make_patches(geometry_, table_);
  forget_roughness_of_forms();
  problem_ = {};
  forget_fits();
}

/// Where some teeth have a form along their flanks, neighbouring values of a scan differ by that.
void PartLoop::forget_roughness_of_forms() {
  if (std::any_of(options_.given.begin(), options_.given.end(), gear_effects::is_of_teeth))
    patches_.flank_scatters.clear();
}

/// Where values, places or weights changed.
void PartLoop::forget_fits() {
  fits_.clear();
  plain_fit_.reset();
  plain_um_.reset();
  sought_.clear();
  no_products_in_.clear();
  names_ = {};
}

std::shared_ptr<const PointFit> PartLoop::fit_of(const std::vector<Effect>& effects) const {
  if (effects.empty() && !table_->is_displaced) return plain_fit();
  // (of a scan they take memory for every unit)
  const std::size_t most = table_->points_mm.empty() ? 6 : 3;
  auto found = std::find_if(fits_.begin(), fits_.end(),
                            [&](const auto& fit) { return fit->effects() == effects; });
  if (found == fits_.end()) {
    if (fits_.size() == most) fits_.pop_back();
    auto fit = std::make_shared<const PointFit>(geometry_, table_, patches_, effects, 1,
                                                DeviationsOf::kTable, fits_);
    found = fits_.insert(fits_.end(), std::move(fit));
  }
  std::rotate(fits_.begin(), found, found + 1);
  return fits_.front();
}

std::vector<Effect> PartLoop::with_best_form(const std::vector<Effect>& rest,
                                             const std::vector<Effect>& forms,
                                             const MostLeft& most) const {
  constexpr std::size_t kMostKept = 64;
  const auto known = std::find_if(sought_.rbegin(), sought_.rend(), [&](const SoughtForm& one) {
    return one.most == most && one.rest == rest && one.forms == forms;
  });
  if (known != sought_.rend()) return known->found;
  std::vector<Effect> found = best_form_sought(rest, forms, most);
  if (sought_.size() == kMostKept) sought_.pop_front();
  sought_.push_back({rest, forms, most, found});
  return found;
}

std::shared_ptr<const PointFit> PartLoop::plain_fit() const {
  if (!plain_fit_)
    plain_fit_ = std::make_shared<const PointFit>(geometry_, table_, patches_,
                                                  std::vector<Effect>(), 1, DeviationsOf::kDesign);
  return plain_fit_;
}

void PartLoop::run() {
  divide_into_patches();
  ban_what_cannot_be_seen();
  unseen_ = banned_;
  ban_given();
  const bool scan_for_more = !options_.joined && !options_.names_only && !is_rounding();
  if (scan_for_more) nominate();
  explain();
  if (scan_for_more) explain_with_whole_forms();
  if (scan_for_more && begins_better()) return;
  constexpr int kRounds = 4, kMostBans = 6;
  if (scan_for_more) explain_what_is_left();
  if (scan_for_more) explain_with_whole_forms();
  if (scan_for_more && drop_idle_forms()) explain();
  for (int round = 0; scan_for_more && round < kRounds && drop_doubtful_orders(); ++round) explain();
  for (int round = 0; scan_for_more && round < kMostBans && ban_what_forms_explain(); ++round)
    explain();
  if (scan_for_more) hold_to_single_values();
  if (!is_rounding()) look_at_single_teeth();
  look_at_sizes();
  drop_impossible();
  drop_what_mends_a_shape();
  if (scan_for_more) drop_doubtful_names();
  join_flanks();
  if (scan_for_more) tell_parts_of_a_form();
  if (!is_rounding() && !options_.joined) look_at_neighbours();
  problem_ = {};  // all is chosen: its columns take a fifth of the memory of a large scan
  veto();
  if (!scan_for_more) return;
  prefer_names();
  prefer_one_name_to_two();
  take_other_start();
  take_form_around();
  name_what_is_settled();
  drop_names_that_may_be_nothing();
  remainder_ = remainder_of(effects_, RemainderOf::kAll);
  if (!structure_is_left()) return;
  if (remainder_.empty() && effects_ != left_beside_) ask_what_is_left();
  if (!structure_is_left()) return;
  doubt_names_below_what_is_left();
  remainder_ = remainder_of(effects_, RemainderOf::kAll);
}

/// Takes up what is left and chooses anew, some rounds. Beside many forms a choice may come to
/// less than one before it, and the next to more: the best is kept (of traces: scans may have
/// moved).
void PartLoop::explain_what_is_left() {
  struct Chosen {
    std::vector<Effect> effects, candidates, given;
    std::vector<double> given_p_values;
    DiscoveryResult discovery;
    std::vector<bool> banned, unseen;
  };
  constexpr int kRounds = 5;
  const bool keep = table_->points_mm.empty();
  Chosen best;
  double least = kNaN;
  const auto keep_if_best = [&] {
    const double cost = cost_of(effects_);
    if (cost > least) return;
    least = cost;
    best = {effects_, candidates_, options_.given, given_p_values_, discovery_, banned_, unseen_};
  };
  if (keep) keep_if_best();
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Effect> before = effects_;
    if (!take_up_remainder()) break;
    explain();
    if (take_up_again(before)) explain();
    if (keep) keep_if_best();
  }
  if (!keep || cost_of(effects_) <= least) return;
  effects_ = std::move(best.effects);
  candidates_ = std::move(best.candidates);
  options_.given = std::move(best.given);
  given_p_values_ = std::move(best.given_p_values);
  discovery_ = std::move(best.discovery);
  banned_ = std::move(best.banned);
  unseen_ = std::move(best.unseen);
  leave_out_across_steps();
}

void PartLoop::explain() {
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    select();

    // Of a scan the sums that are kept for the rest take memory; after the last round they go with the patches.
    if (!table_->points_mm.empty() || round + 1 == kRounds) finish_choice();
    // Off the grid: the choice is made again with the shapes that fit, so that what a coarse
    // shape leaves is not taken for another effect.
    bool again = put_refined_shapes_on_the_grid();
    again = ban_misnamed() || again;
    again = settle_poses_of_scans() || linearise() || again;
    if (!again) break;
  }
  finish_choice();
}

/// What is smaller than the rounding of 32-bit mesh files is no finding, however regular it is.
bool PartLoop::is_rounding() const {
  constexpr double kFileRounding_um = 0.01, kClearly = 1.1;
  if (least_plain_rms_um(geometry_, table_, patches_) > kClearly * kFileRounding_um) return false;
  const auto plain = plain_fit();
  return plain->observations() > 0 && plain->errors({}).rms_um < kFileRounding_um;
}

void add_nuisance(DiscoveryProblem& problem, const DiscoveryProblem& fitted) {
  const auto before = problem.nuisance.cols();
  problem.nuisance.conservativeResize(Eigen::NoChange, before + fitted.candidates.cols());
  problem.nuisance.rightCols(fitted.candidates.cols()) = fitted.candidates.cast<double>();
}

/// Columns of candidates that stayed as they were are kept.
DiscoveryProblem& PartLoop::candidates_problem() {
  if (problem_.groups.empty()) {
    const KnownColumns known{names_of_, names_};
    problem_ = make_problem(geometry_, table_, patches_, candidates_,
                            names_.groups.empty() ? nullptr : &known);
    // (Of large scans, chosen for in a few rounds, what a point takes of memory counts.)
    constexpr std::size_t kMostPoints = 100'000;
    if (table_->points_mm.size() <= kMostPoints) problem_.kept = std::make_shared<KeptSums>();
  } else {
    set_candidates(geometry_, patches_, problem_of_, candidates_, problem_);
    for (std::size_t i = 0; i < patches_.patches.size(); ++i)
      problem_.weight[static_cast<Eigen::Index>(i)] = patches_.patches[i].weight;
  }
  names_ = {};
  problem_of_ = candidates_;
  return problem_;
}

void PartLoop::select() {
  choice_.reset();
  DiscoveryProblem& problem = candidates_problem();
  const Eigen::Index of_pose = problem.nuisance.cols();
  if (!options_.given.empty())
    add_nuisance(problem, make_problem(geometry_, table_, patches_, options_.given));
  DiscoveryOptions options;
  options.banned = banned_;
  // What no flip reaches is as sure as flips can say.
  options.next_level = std::max(kNextLevel / options_.tables, 1.01 / (options.flips + 1.0));
  // With effects given, something was found already.
  options.first_level =
      options_.given.empty() ? options.first_level / options_.tables : options.next_level;
  options.local_level /= options_.tables;
  choice_.emplace(problem, options);
  discovery_ = choice_->chosen();
  problem.nuisance.conservativeResize(Eigen::NoChange, of_pose);
  if (is_rounding()) {
    choice_.reset();
    discovery_.chosen.clear();
    discovery_.first_p_value = discovery_.first_common_p_value = discovery_.p_left = 1.0;
  }
  effects_ = options_.given;
  for (const ChosenGroup& chosen : discovery_.chosen) effects_.push_back(candidates_[chosen.group]);
  ChosenGroup record;
  record.group = -1;
  discovery_.chosen.insert(discovery_.chosen.begin(), options_.given.size(), record);
  const std::size_t told = first_told_here();
  for (std::size_t i = 0; i < given_p_values_.size(); ++i)
    discovery_.chosen[told + i].p_value = given_p_values_[i];
}

/// What the choice leaves and what it is confounded with, which the rounds before the last are not asked.
void PartLoop::finish_choice() {
  if (!choice_) return;
  const DiscoveryResult told = std::move(*choice_).finished();
  choice_.reset();
  discovery_.p_left = told.p_left;
  discovery_.most_likely_left = told.most_likely_left;
  left_beside_ = effects_;
  for (std::size_t i = 0; i < told.chosen.size(); ++i) {
    ChosenGroup& record = discovery_.chosen[options_.given.size() + i];
    record.bic_gain = told.chosen[i].bic_gain;
    record.confounded = told.chosen[i].confounded;
  }
}

/// What the choice left may be gone since other effects stand in its place: the test is made again
/// beside these.
void PartLoop::ask_what_is_left() {
  if (effects_.empty()) return;
  DiscoveryProblem& problem = candidates_problem();
  const Eigen::Index of_pose = problem.nuisance.cols();
  add_nuisance(problem, make_problem(geometry_, table_, patches_, effects_));
  DiscoveryOptions options;
  options.most_effects = 0;
  options.banned = banned_;
  const DiscoveryResult asked = discover(problem, options);
  problem.nuisance.conservativeResize(Eigen::NoChange, of_pose);
  problem_ = {};
  discovery_.p_left = asked.p_left;
  discovery_.most_likely_left = asked.most_likely_left;
  left_beside_ = effects_;
}

void PartLoop::leave_out_across_steps() {
  kept_ = {};
  std::vector<double> heights_mm;
  for (const Effect& effect : effects_)
    if (effect.family->shape_is_step) heights_mm.push_back(effect.shape[0]);
  const bool some_were = !patches_.left_out.empty();
  patches_.leave_out_across(heights_mm);
  if (some_were || !patches_.left_out.empty()) forget_fits();
}

/// True where a shape moved noticeably.
bool PartLoop::put_refined_shapes_on_the_grid() {
  const std::vector<Effect> chosen = effects_;
  // What one moves to another makes room for: both in turn until neither moves.
  constexpr int kMostTurns = 8;
  if (can_be_refined(effects_, options_.given.size())) {
    TrialFit fit = fit_to_refine(geometry_, table_, patches_, effects_);
    for (int turn = 0; turn < kMostTurns; ++turn) {
      refine_shapes(geometry_, options_.given.size(), fit);
      if (!refine_nearby(geometry_, fit)) break;
    }
    effects_ = fit.effects();
  }
  std::copy_n(effects_.begin(), options_.given.size(), options_.given.begin());
  leave_out_across_steps();
  bool moved = false;
  for (std::size_t i = options_.given.size(); i < effects_.size(); ++i) {
    for (std::size_t k = 0; k < effects_[i].shape.size(); ++k)
      moved = moved || std::abs(effects_[i].shape[k] - chosen[i].shape[k]) >
                           3e-3 * std::abs(chosen[i].shape[k]);
    candidates_[discovery_.chosen[i].group].shape = effects_[i].shape;
  }
  return moved;
}

bool PartLoop::moves_points() const {
  return std::any_of(effects_.begin(), effects_.end(), [](const Effect& effect) {
    return static_cast<bool>(effect.family->displacement_mm);
  });
}

/// Points that an effect moved which is no longer there. True where there are some.
bool PartLoop::put_points_back() {
  if (!table_->is_displaced) return false;
  undo_displacement(geometry_, table_.own());
  forget_fits();
  divide_into_patches();
  leave_out_across_steps();
  return true;
}

/// Ways to move that differ only where points went far: the one that leaves least beside the effects
/// that move none. (Others that move the teeth, a scale, make up for what the wrong way leaves.)
void PartLoop::choose_motions() {
  constexpr double kClearly = 9.0;  // chi-square
  for (std::size_t e = options_.given.size(); e < effects_.size(); ++e) {
    const EffectFamily& family = *effects_[e].family;
    if (!family.other_motions) continue;
    const auto left_with = [&](const EffectShape& shape) {
      std::vector<Effect> all = effects_, alone;
      all[e].shape = shape;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (i == e || !all[i].family->displacement_mm) alone.push_back(all[i]);
      Observations moved = table_;
      linearise_at(geometry_, PointFit(geometry_, table_, patches_, all), moved);
      return PointFit(geometry_, moved, patches_, alone).residual_square();
    };
    double least = kNaN;
    for (const EffectShape& other : family.other_motions(geometry_, effects_[e].shape)) {
      if (std::isnan(least)) least = left_with(effects_[e].shape) - kClearly;
      const double left = left_with(other);
      if (!(left < least)) continue;
      least = left;
      candidates_[discovery_.chosen[e].group].shape = effects_[e].shape = other;
    }
  }
}

/// True where scans lie otherwise beside the effects than without them.
bool PartLoop::settle_poses_of_scans() {
  const std::vector<bool>& free = table_->pose_is_free;
  if (effects_.empty() || std::find(free.begin(), free.end(), true) == free.end()) return false;
  const std::vector<Pose> by = poses_beside(geometry_, *fit_of(effects_), table_);
  if (by.empty()) return false;
  move_scans(geometry_, by, table_.own());
  forget_fits();
  divide_into_patches();
  leave_out_across_steps();
  return true;
}

/// True where finite displacements changed the deviations by more than the noise can hide, or are taken back.
bool PartLoop::linearise() {
  if (!moves_points()) return put_points_back();
  if (table_->points_mm.empty()) return false;
  choose_motions();
  const auto fit = fit_of(effects_);
  const double noticed_um = 0.02 * fit->noise_um();
  // Displacements are smooth: where a sample moves by less than half of that, no point moves by more.
  if (table_->is_displaced && change_of_sample_um(geometry_, *fit, table_) < 0.5 * noticed_um)
    return false;
  const double change = linearise_at(geometry_, *fit, table_.own());
  forget_fits();
  if (!(change > noticed_um)) return false;
  divide_into_patches();
  leave_out_across_steps();
  return true;
}

bool PartLoop::structure_is_left() const {
  constexpr double kLeft = 0.01, kLeftOfNothing = 0.01, kSureThoughDenied = 0.0015;
  if (neighbours_share() || !remainder_.empty() || denied_spot_) return true;
  // What the hold-out denied must be surer than what it was not asked about.
  const double sure = vetoed_ ? kSureThoughDenied : kLeftOfNothing;
  if (effects_.empty()) {
    // Single teeth have a level of their own, at which they were chosen: they are asked again only
    // where the hold-out denied one, and never one of single values, whose tails may be long.
    const double p = vetoed_ && !has_single_values_only() ? discovery_.first_p_value
                                                          : discovery_.first_common_p_value;
    return p <= sure / options_.tables;
  }
  return discovery_.p_left <= kLeft / options_.tables && discovery_.most_likely_left >= 0;
}

WhatIsLeft PartLoop::what_is_left() const {
  WhatIsLeft left{.nothing = !structure_is_left()};
  for (const RemainderFinding& finding : remainder_) {
    left.own_profiles = left.own_profiles || finding.own == OwnCourse::kProfile;
    left.own_leads = left.own_leads || finding.own == OwnCourse::kLead;
  }
  return left;
}

double PartLoop::structure_left_p_value() const {
  return remainder_.empty() ? discovery_.p_left
                            : std::min(discovery_.p_left, remainder_.front().p_value);
}

std::string PartLoop::structure_left() const {
  if (neighbours_share())
    return words_for(neighbours_) + (remainder_.empty() ? "" : "; and " + remainder_.front().text);
  if (!remainder_.empty()) return remainder_.front().text;
  if (denied_spot_)
    return words_for(geometry_, *denied_spot_) + ", which the values held out do not bear out";
  if (!structure_is_left() || discovery_.most_likely_left < 0)
    return "nothing beyond the measurement's own noise was found";
  return "what is left looks most like " +
         words_for(geometry_, candidates_[discovery_.most_likely_left]);
}

}  // namespace trueflank::loop
