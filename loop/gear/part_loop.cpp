// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/found_effects.h"
#include "trueflank/loop/gear/plain_rms.h"
#include "trueflank/loop/gear/possible_effects.h"
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
  problem_ = {};
  forget_fits();
}

/// Where values, places or weights changed.
void PartLoop::forget_fits() {
  fits_.clear();
  plain_fit_.reset();
}

std::shared_ptr<const PointFit> PartLoop::fit_of(const std::vector<Effect>& effects) const {
  constexpr std::size_t kMost = 3;
  auto found = std::find_if(fits_.begin(), fits_.end(),
                            [&](const auto& fit) { return fit->effects() == effects; });
  if (found == fits_.end()) {
    if (fits_.size() == kMost) fits_.pop_back();
    found = fits_.insert(fits_.end(),
                         std::make_shared<const PointFit>(geometry_, table_, patches_, effects));
  }
  std::rotate(fits_.begin(), found, found + 1);
  return fits_.front();
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
  constexpr int kRounds = 4, kMostBans = 6;
  for (int round = 0; scan_for_more && round < kRounds && take_up_remainder(); ++round) explain();
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
  remainder_ = remainder_of(effects_, RemainderOf::kAll);
  if (!structure_is_left()) return;
  doubt_names_below_what_is_left();
  remainder_ = remainder_of(effects_, RemainderOf::kAll);
}

void PartLoop::explain() {
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    select();
    // Of a scan the sums that are kept for the rest take memory; after the last round they go with the patches.
    if (!table_->points_mm.empty() || round + 1 == kRounds) finish_choice();
    // Off the grid: the choice is made again with the shapes that fit, lest what a coarse shape
    // leaves is taken for another effect.
    bool again = put_refined_shapes_on_the_grid();
    again = ban_misnamed() || again;
    again = linearise() || again;
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

/// What the data cannot show is not looked for under another name: shapes over the profile where
/// nothing was measured along it, over the face likewise. A wave over the generating rotation shows
/// along the profile only; in values one a tooth every order looks like a lower one.
void PartLoop::ban_what_cannot_be_seen() {
  bool along_profile = false, along_face = false;
  // A product of both shows where flanks were scanned, or traced at several heights or diameters.
  constexpr double kSeveral = 0.2;
  double lowest_mm = std::numeric_limits<double>::infinity(), highest_mm = -lowest_mm;
  double least_u = 1.0, most_u = -1.0, least_v = 1.0, most_v = -1.0;
  bool scanned = false, whole_ring = false;
  std::set<int> traced_teeth;
  for (const Observation& row : table_->rows) {
    whole_ring =
        whole_ring || row.kind == ObservationKind::kIndex || row.kind == ObservationKind::kRadial;
    const bool scan = row.kind == ObservationKind::kScanFlank;
    scanned = scanned || scan;
    const Place& place = table_->place(row);
    lowest_mm = std::min(lowest_mm, place.z_mm);
    highest_mm = std::max(highest_mm, place.z_mm);
    if (row.kind == ObservationKind::kHelix) {
      const double u = geometry_.profile_coordinate(place.roll_mm);
      least_u = std::min(least_u, u);
      most_u = std::max(most_u, u);
    }
    if (row.kind == ObservationKind::kProfile) {
      const double v = geometry_.face_coordinate(place.z_mm);
      least_v = std::min(least_v, v);
      most_v = std::max(most_v, v);
    }
    along_profile = along_profile || scan || row.kind == ObservationKind::kProfile;
    along_face = along_face || scan || row.kind == ObservationKind::kHelix;
  }
  const double lowest = std::min(1.0, geometry_.face_coordinate(lowest_mm));
  const double highest = std::max(-1.0, geometry_.face_coordinate(highest_mm));
  // Between few teeth a wave of a higher order looks like one of a lower, or like what all share,
  // with a name or without; those that are held out tell nothing.
  for (const Patches::Patch& patch : patches_.patches)
    if (patch.fold != 0 &&
        (patch.kind == ObservationKind::kHelix || patch.kind == ObservationKind::kProfile))
      traced_teeth.insert(patch.places.front().place.tooth);
  const int traced = static_cast<int>(traced_teeth.size());
  const auto aliases = [&](const Effect& effect) {
    const NeedsToBeSeen needs = effect.needs();
    const bool in_traces_only = needs.along_profile || needs.along_face || !whole_ring;
    // A wave over the generating rotation differs along the profile.
    return !scanned && !effect.family->tells_order_along_profile && in_traces_only && traced > 0 &&
           2.0 * effect.order() >= traced;
  };
  // Waves that stand alike on every tooth looked at are a form of the flank, and no machine's
  // order.
  const auto is_alike_on_all = [&](const Effect& effect) {
    if (!effect.family->tells_order_along_profile) return false;
    const double z = geometry_.teeth();
    if (scanned || traced == 0) return std::fmod(effect.order(), z) == 0.0;
    return std::all_of(traced_teeth.begin(), traced_teeth.end(), [&](int tooth) {
      return std::fmod(effect.order() * (tooth - *traced_teeth.begin()), z) == 0.0;
    });
  };
  // Less than half a wave over the profile is a slope of it, and so is a whole one where the teeth
  // between were not traced: on traces with zeros of their own no machine's order can be read from
  // that.
  const double fewest = gear_effects::lowest_order_with(
      traced < geometry_.teeth() ? 1.0 : 0.5, geometry_);
  const auto is_a_slope = [&](const Effect& effect) {
    return effect.family->tells_order_along_profile && !scanned &&
           (!whole_ring || traced < geometry_.teeth()) && effect.order() < fewest;
  };
  const bool crossed = scanned || most_u > least_u + kSeveral || most_v > least_v + kSeveral;
  for (std::size_t g = 0; g < candidates_.size(); ++g) {
    const NeedsToBeSeen needs = candidates_[g].needs();
    if ((needs.along_profile && !along_profile) || (needs.along_face && !along_face) ||
        (needs.several_heights && !(highest > lowest + kSeveral)) || (needs.crossed && !crossed) ||
        aliases(candidates_[g]) || is_alike_on_all(candidates_[g]) || is_a_slope(candidates_[g]))
      banned_[g] = true;
  }
}

/// What is given does not enter again, nor at a neighbouring shape.
void PartLoop::ban_given() {
  for (const Effect& given : options_.given)
    for (std::size_t g = 0; g < candidates_.size(); ++g) {
      const Effect& candidate = candidates_[g];
      if (candidate.family == given.family && candidate.flank == given.flank &&
          (candidate.shape == given.shape || given.family->shape_is_continuous))
        banned_[g] = true;
    }
}

void add_nuisance(DiscoveryProblem& problem, const DiscoveryProblem& fitted) {
  const auto before = problem.nuisance.cols();
  problem.nuisance.conservativeResize(Eigen::NoChange, before + fitted.candidates.cols());
  problem.nuisance.rightCols(fitted.candidates.cols()) = fitted.candidates.cast<double>();
}

/// Columns of candidates that stayed as they were are kept.
DiscoveryProblem& PartLoop::candidates_problem() {
  if (problem_.groups.empty()) {
    problem_ = make_problem(geometry_, table_, patches_, candidates_);
  } else {
    set_candidates(geometry_, patches_, problem_of_, candidates_, problem_);
    for (std::size_t i = 0; i < patches_.patches.size(); ++i)
      problem_.weight[static_cast<Eigen::Index>(i)] = patches_.patches[i].weight;
  }
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
  const std::size_t told = options_.given.size() - given_p_values_.size();
  for (std::size_t i = 0; i < given_p_values_.size(); ++i)
    discovery_.chosen[told + i].p_value = given_p_values_[i];
}

/// What the choice leaves and what it is confounded with, which the rounds before the last are not asked.
void PartLoop::finish_choice() {
  if (!choice_) return;
  const DiscoveryResult told = std::move(*choice_).finished();
  choice_.reset();
  discovery_.p_left = told.p_left;
  discovery_.likest_left = told.likest_left;
  for (std::size_t i = 0; i < told.chosen.size(); ++i) {
    ChosenGroup& record = discovery_.chosen[options_.given.size() + i];
    record.bic_gain = told.chosen[i].bic_gain;
    record.confounded = told.chosen[i].confounded;
  }
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
  for (int turn = 0; turn < kMostTurns; ++turn) {
    refine_shapes(geometry_, table_, patches_, effects_, options_.given.size());
    if (!refine_nearby(geometry_, table_, patches_, effects_)) break;
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

std::vector<std::string> PartLoop::not_observable() const {
  std::vector<std::string> seen, hidden;
  for (std::size_t g = 0; g < candidates_.size(); ++g)
    if (g < discovery_.observable.size() && discovery_.observable[g] && !unseen_[g])
      seen.push_back(candidates_[g].family->id);
  for (const Effect& given : options_.given) seen.push_back(given.family->id);
  const auto look = [&](const EffectFamily& family) {
    if (family.named && !family.local &&
        std::find(seen.begin(), seen.end(), family.id) == seen.end())
      hidden.push_back(family.id);
  };
  if (options_.declared)
    for (const EffectFamily& family : *options_.declared) look(family);
  for (const EffectFamily& family : effect_library())
    if (can_have(options_.makings, family)) look(family);
  return hidden;
}

/// Bans named effects that cannot be meant: an amount of the wrong sign; a wave whose kin of the
/// same order remain unexplained, which is not that wave and is better described. True where any
/// was.
bool PartLoop::ban_misnamed() {
  bool any = ban_impossible();
  any = ban_waves_of_a_drift() || any;
  const auto ban = [&](std::size_t group) {
    any = any || !banned_[group];
    banned_[group] = true;
  };
  for (const ChosenGroup& named : discovery_.chosen) {
    if (named.group < 0) continue;
    const Effect& effect = candidates_[named.group];
    const double order = effect.order(), share = effect.family->doubt_share;
    if (!(share > 0.0) || order < 2.0) continue;
    for (const ChosenGroup& other : discovery_.chosen) {
      if (other.group < 0) continue;
      const Effect& term = candidates_[other.group];
      if (!term.is_term() || other.gain < share * named.gain) continue;
      if (effect.family->doubted_by_any_order ? term.order() == 0.0 : term.order() != order)
        continue;
      for (std::size_t g = 0; g < candidates_.size(); ++g)
        if (candidates_[g].family->named && candidates_[g].shape == effect.shape &&
            candidates_[g].family->shape_names == effect.family->shape_names)
          ban(g);
    }
  }
  return any;
}

/// Beside a drift around the gear that is larger, waves are what its even course leaves: no cause
/// of their own. True where any was banned.
bool PartLoop::ban_waves_of_a_drift() {
  if (std::none_of(effects_.begin(), effects_.end(),
                   [](const Effect& e) { return e.family->is_drift; }))
    return false;
  const PointFit fit(geometry_, table_, patches_, effects_);
  double drift_um = 0.0;
  for (std::size_t e = 0; e < effects_.size(); ++e)
    if (effects_[e].family->is_drift)
      drift_um = std::max(drift_um, fit.effect_size_um(static_cast<int>(e)));
  bool any = false;
  for (std::size_t e = options_.given.size(); e < effects_.size(); ++e)
    if (effects_[e].family->named && effects_[e].family->doubt_share > 0.0 &&
        fit.effect_size_um(static_cast<int>(e)) < drift_um)
      any = ban_alike(effects_[e]) || any;
  return any;
}

/// Effects that no gear can have (possible_effects.h) are not chosen again, at no shape.
bool PartLoop::ban_impossible() {
  if (effects_.empty()) return false;
  const auto fit = fit_of(effects_);
  bool any = false;
  for (std::size_t e = options_.given.size(); e < effects_.size(); ++e) {
    const Effect& effect = effects_[e];
    if (is_possible(geometry_, *fit, static_cast<int>(e))) continue;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (candidates_[g].family == effect.family && candidates_[g].flank == effect.flank)
        banned_[g] = any = true;
  }
  return any;
}

/// Single teeth once more with the hold-out: what stands in one tooth cannot be learnt from others.
void PartLoop::look_at_single_teeth() {
  std::vector<Effect> local;
  for (const Effect& effect : candidates_) {
    if (!effect.family->local) continue;
    const bool chosen = std::any_of(effects_.begin(), effects_.end(), [&](const Effect& e) {
      return e.family == effect.family && e.shape == effect.shape && e.flank == effect.flank;
    });
    if (!chosen) local.push_back(effect);
  }
  DiscoveryProblem problem = make_problem(geometry_, table_, patches_, local);
  add_nuisance(problem, make_problem(geometry_, table_, patches_, effects_));
  for (int& fold : problem.fold)
    if (fold == 0) fold = 1;
  DiscoveryOptions options;
  options.first_level = options.next_level = 0.0;
  options.local_level /= options_.tables;
  options.flips = 1;
  options.most_effects = 3;
  for (const ChosenGroup& chosen : discover(problem, options).chosen) {
    effects_.push_back(local[chosen.group]);
    ChosenGroup record = chosen;
    record.group = -1;
    discovery_.chosen.push_back(record);
  }
  drop_teeth_within_the_tails();
}

/// Sizes are few and know their own error: what they say of thickness, which traces with zeros of
/// their own cannot show, is judged by chi-square.
void PartLoop::look_at_sizes() {
  constexpr double kSure = 1e-3, kTie = 4.0;
  const auto sizes =
      std::count_if(table_->rows.begin(), table_->rows.end(),
                    [](const Observation& row) { return row.kind == ObservationKind::kSize; });
  for (int round = 0; round < 2 && sizes > 0; ++round) {
    const double before = fit_of(effects_)->residual_square();
    int best = -1;
    std::vector<std::pair<int, double>> tried;
    for (int g = 0; g < static_cast<int>(candidates_.size()); ++g) {
      const Effect& effect = candidates_[g];
      if (!effect.family->shows_in_sizes || banned_[g] ||
          std::any_of(effects_.begin(), effects_.end(),
                      [&](const Effect& e) { return e.family == effect.family; }))
        continue;
      std::vector<Effect> with = effects_;
      with.push_back(effect);
      const PointFit fit(geometry_, table_, patches_, with);
      if (fit.retained(fit.first_column(static_cast<int>(effects_.size()))) < 2e-3) continue;
      tried.emplace_back(g, before - fit.residual_square());
      if (best < 0 || tried.back().second > tried[best].second)
        best = static_cast<int>(tried.size()) - 1;
    }
    if (best < 0) return;
    const double tests = static_cast<double>(tried.size()) * options_.tables;
    const double p =
        std::min(1.0, tests * std::exp(-minus_log_chi_square_tail(tried[best].second, 1)));
    if (p > kSure) return;
    ChosenGroup record;
    record.group = tried[best].first;
    record.p_value = p;
    for (const auto& [group, gain] : tried)
      if (group != record.group && tried[best].second - gain < kTie)
        record.confounded.push_back(group);
    effects_.push_back(candidates_[record.group]);
    discovery_.chosen.push_back(record);
  }
}

/// What stands over a few teeth is no wave: many small terms, none of which is found by itself. Nor
/// is it a single tooth where the teeth beside it share it.
void PartLoop::look_at_neighbours() {
  std::vector<Effect> common;
  for (const Effect& effect : effects_)
    if (!effect.family->local) common.push_back(effect);
  const auto shared_without = [&](const std::vector<Effect>& effects) {
    return shared_by_neighbours(geometry_, patches_, *fit_of(effects)->residuals_um());
  };
  neighbours_ = shared_without(common);
  if (common.size() == effects_.size()) return;
  if (!neighbours_share()) {
    neighbours_ = shared_without(effects_);
    return;
  }
  const int z = geometry_.teeth();
  for (std::size_t e = effects_.size(); e-- > options_.given.size();) {
    if (!effects_[e].family->local) continue;
    const int off = std::abs(static_cast<int>(effects_[e].shape[0]) - neighbours_.tooth);
    if (std::min(off, z - off) > 1) continue;
    effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(e));
    discovery_.chosen.erase(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(e));
  }
}

bool PartLoop::neighbours_share() const { return neighbours_.p_value <= 0.002 / options_.tables; }

bool PartLoop::structure_is_left() const {
  constexpr double kLeft = 0.01, kLeftOfNothing = 0.01, kSureThoughDenied = 0.0015;
  if (neighbours_share() || !remainder_.empty() || denied_spot_) return true;
  // What the hold-out denied must be surer than what it was not asked about.
  const double sure = vetoed_ ? kSureThoughDenied : kLeftOfNothing;
  if (effects_.empty()) {
    // Single teeth have a level of their own, at which they were chosen: they are asked again only
    // where the hold-out denied one, and never one of single values, whose tails may be long.
    const bool single = std::none_of(
        table_->rows.begin(), table_->rows.end(), [](const Observation& row) {
          return row.kind != ObservationKind::kIndex && row.kind != ObservationKind::kRadial &&
                 row.kind != ObservationKind::kSize;
        });
    const double p = vetoed_ && !single ? discovery_.first_p_value : discovery_.first_common_p_value;
    return p <= sure / options_.tables;
  }
  return discovery_.p_left <= kLeft / options_.tables && discovery_.likest_left >= 0;
}

double PartLoop::structure_left_p_value() const {
  return remainder_.empty() ? discovery_.p_left
                            : std::min(discovery_.p_left, remainder_.front().p_value);
}

std::string PartLoop::structure_left() const {
  if (neighbours_share())
    return words_for(neighbours_) + (remainder_.empty() ? "" : "; and " + remainder_.front().text);
  if (!remainder_.empty()) return remainder_.front().text;
  if (denied_spot_) return words_for(*denied_spot_) + ", which the values held out do not bear out";
  if (!structure_is_left() || discovery_.likest_left < 0)
    return "nothing beyond the measurement's own noise was found";
  return "what is left looks most like " + words_for(candidates_[discovery_.likest_left]);
}

}  // namespace trueflank::loop
