// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/drive_selection.h"

#include <cmath>
#include <tuple>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/place_profile.h"
#include "trueflank/loop/drive/scans/rest_scan.h"
#include "trueflank/loop/drive/scans/spell_scan.h"
#include "trueflank/loop/drive/scans/states_scan.h"
#include "trueflank/loop/drive/scans/wander_scan.h"

namespace trueflank::loop {
namespace {

constexpr double kFar = 2e-4;  // of a friction, a scale, a share of the load

bool far_of(const std::map<std::size_t, double>& one, const std::map<std::size_t, double>& other) {
  return !std::equal(one.begin(), one.end(), other.begin(), other.end(), [](auto& a, auto& b) {
    return a.first == b.first && std::abs(a.second - b.second) <= kFar;
  });
}

bool has_no_name(const DriveEffect& effect) { return !effect.family->named; }

}  // namespace

DriveSelection::DriveSelection(const DriveModel& model, BenchTable table,
                               const DriveLoopOptions& options)
    : model_(model),
      options_(options),
      table_(std::move(table)),
      curve_(model),
      mesh_curves_(mesh_curves(model)) {
  const DriveContext here = context();
  for (BenchPoint& p : table_.points) {
    p.known_speed_coordinate = here.speed_coordinate(p);
    p.known_speed_rpm = p.speed_rpm;
  }
}

DriveOutcome DriveSelection::run() {
  measure_residual();
  if (is_a_log()) return of_a_log();
  candidates_ = drive_candidates(context());
  DriveOutcome outcome = choose();
  if (gains_power() && table_.has(true) && table_.has(false))
    outcome = losses_beside_gains(std::move(outcome));
  return outcome;
}

int size_of(const std::vector<DriveEffect>& effects) {
  int size = 0;
  for (const DriveEffect& effect : effects) {
    size += effect.columns();
    for (const DriveShapeValue& value : effect.family->shape_values)
      size += value.continuous ? 1 : 0;
  }
  return size;
}

int size_with_changes(const std::vector<DriveEffect>& effects) {
  int size = size_of(effects);
  for (const DriveEffect& e : effects) {
    if (e.family->shape_of_states || e.family->shape_of_levels)
      size += static_cast<int>(e.shape.size()) - 1;
    if (e.family->shape_of_spell) size += 2;
  }
  return size;
}

DriveOutcome DriveSelection::choose() {
  banned_.assign(candidates_.size(), false);
  ban([&](const DriveEffect& e) { return !may_be_there(*e.family); });
  DriveOutcome outcome = settle();
  take_what_few_rows_show(outcome);
  for (int courses = 0; courses < 3; ++courses) {
    const bool spell = propose_spell(outcome), rest = propose_rest(outcome);
    if (!propose_wander(outcome) && !spell && !rest) break;
    outcome = settle();
  }
  for (int waves = 0; waves < 4 && propose_wave(outcome); ++waves) outcome = settle();
  if (propose_states(outcome)) outcome = settle();
  sharpen_courses(outcome);
  const DriveOutcome whole = outcome;
  if (!outcome.effects.empty()) outcome = simplest_that_is_enough(std::move(outcome));
  sharpen_courses(outcome);
  absorb_the_scale(outcome);
  tell_as_one_form(outcome);
  absorb_the_scale(outcome);
  tell_waves(outcome);
  tell_as_one_place_of_a_turn(outcome);
  follow_the_run(outcome);
  tell_as_whole_forms(outcome);
  tell_as_first_rows(outcome);
  tell_as_alike(outcome);
  let_held_out_rows_settle_kin(outcome);
  prefer_plainer_names(outcome);
  drop_what_is_nothing(outcome);
  veto(outcome);
  if (vetoed_) stand_by_the_whole(whole, outcome);
  if (vetoed_) drop_what_is_nothing(outcome);
  ask_what_is_left_again(outcome);
  return outcome;
}

void DriveSelection::absorb_the_scale(DriveOutcome& outcome) {
  constexpr double kAsWell = 9.0;  // chi-square
  const auto find = [&](const auto& is_it) {
    return static_cast<std::size_t>(
        std::find_if(outcome.effects.begin(), outcome.effects.end(), is_it) -
        outcome.effects.begin());
  };
  const std::size_t gain = find([](const DriveEffect&e) {
    const DriveFamily& f = *e.family;
    return !f.is_loss && f.holds_a_constant && f.beside_load;
  }),
                    scale = find([](const DriveEffect&e) {
                      const DriveFamily& f = *e.family;
                      return f.named && !f.is_loss && f.base && f.into_state;
                    });
  if (gain == outcome.effects.size() || scale == outcome.effects.size()) return;
  const DriveState state = state_;
  DriveOutcome now = outcome, with = outcome;
  settle_after_exchange(now);
  const DriveContext here = context();
  const DriveFit fit(here, value_, now.effects, FitRows::kTraining);
  const double more = fit.coefficients()[fit.first_column(static_cast<int>(scale))],
               slope = fit.coefficients()[fit.first_column(static_cast<int>(gain))];
  double& right = with.effects[gain].shape.front();
  right -= more / slope;
  const auto [least, most] = outcome.effects[gain].family->shape_values.front().limits(here);
  if (right < least || right > most) return;
  with.effects.erase(with.effects.begin() + static_cast<std::ptrdiff_t>(scale));
  with.discovery.chosen.erase(with.discovery.chosen.begin() + static_cast<std::ptrdiff_t>(scale));
  for (int round = 0; round < 2; ++round) {
    settle_state(with);
    refine_drive_shapes(context(), value_, FitRows::kTraining, with.effects);
  }
  settle_after_exchange(with);
  const double noise = now.square / std::max(1.0, now.rows - now.size());
  if (with.square - now.square < kAsWell * noise * now.shared && is_possible(with))
    outcome = std::move(with);
  else
    state_ = state;
}

void DriveSelection::ask_what_is_left_again(DriveOutcome& outcome) {
  constexpr double kSure = 6.6;  // chi-square
  DiscoveryResult& found = outcome.discovery;
  if (found.most_likely_left < 0 || outcome.effects.empty()) return;
  const DriveEffect& likeliest = candidates_[static_cast<std::size_t>(found.most_likely_left)];
  if (likeliest.columns() != 1) return;
  const DriveContext here = context();
  const BesideEffects beside(here, value_, outcome.effects, FitRows::kTraining);
  const double noise = beside.square() / std::max(1.0, outcome.rows - outcome.size());
  if (beside.with(likeliest).gain > kSure * noise * std::max(1.0, outcome.shared)) return;
  found.p_left = 1.0;
  found.most_likely_left = -1;
}

bool DriveSelection::may_be_there(const DriveFamily& family) const {
  if (!gains_power()) return true;
  if (!family.is_loss) return !(losses_beside_gains_ && family.in_place_of_losses);
  return losses_beside_gains_ && !family.differs_by_direction;
}

DriveOutcome DriveSelection::losses_beside_gains(DriveOutcome sensors) {
  const auto square_of = [&](const DriveOutcome& outcome) {
    const DriveContext here = context();
    return DriveFit(here, value_, outcome.effects, FitRows::kTraining).residual_square();
  };
  sensors.square = square_of(sensors);
  const auto kept = std::tuple(candidates_, banned_, exchangeable_, state_, vetoed_);
  losses_beside_gains_ = true;
  vetoed_ = false;
  DriveOutcome all = choose();
  all.square = square_of(all);
  // A reading that goes wrong without a name must be most of what sensors with names leave, and is
  // reason enough for a loss that has a name only where it is told as a form by itself.
  constexpr double kMostOfIt = 0.25;
  bool reads_wrong = false, reads_oddly = false, has_loss = false, as_a_form = false;
  for (const DriveEffect& e : all.effects) {
    if (e.family->is_loss)
      has_loss = has_loss || e.family->named;
    else
      (e.family->named ? reads_wrong : reads_oddly) = true;
    as_a_form = as_a_form || (!e.family->is_loss && e.family->stands_alone);
  }
  reads_wrong = reads_wrong || (reads_oddly && (!has_loss || as_a_form) &&
                                all.square < kMostOfIt * sensors.square);
  if (reads_wrong && earns_its_figures(all, sensors) && !leaves_structure(all)) return all;
  losses_beside_gains_ = false;
  std::tie(candidates_, banned_, exchangeable_, state_, vetoed_) = kept;
  return sensors;
}

DriveContext DriveSelection::context() const {
  return {model_, curve_, table_, mesh_curves_, state_};
}

void DriveSelection::measure_residual() {
  value_.resize(static_cast<Eigen::Index>(table_.points.size()));
  for (std::size_t i = 0; i < table_.points.size(); ++i)
    value_[static_cast<Eigen::Index>(i)] =
        table_.points[i].driven_nm - predicted_nm(model_, curve_, table_.points[i]);
}

Discovery DriveSelection::select() {
  DiscoveryOptions options;
  options.banned = banned_;
  options.first_level = share_of_level() * options_.level;
  options.next_level *= share_of_level();
  return Discovery(problem_.made_for(context(), value_, candidates_), options);
}

DriveOutcome DriveSelection::outcome_of(const DiscoveryResult& chosen) const {
  const DriveContext here = context();
  DriveOutcome outcome;
  outcome.discovery = chosen;
  for (const ChosenGroup& group : outcome.discovery.chosen)
    outcome.effects.push_back(candidates_[group.group]);
  refine_drive_shapes(here, value_, FitRows::kTraining, outcome.effects);
  const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
  outcome.fold_errors = fit.fold_errors();
  outcome.square = fit.residual_square();
  outcome.shared = shared_inside_units(fit);
  outcome.rows = rows_of_training();
  return outcome;
}

double DriveSelection::rows_of_training() const {
  return static_cast<double>(std::count_if(table_.points.begin(), table_.points.end(),
                                           [](const BenchPoint& p) { return p.fold != 0; }));
}

double DriveSelection::shared_inside_units(const DriveFit& fit) const {
  const Eigen::VectorXd left = value_ - fit.explained_nm();
  std::map<int, double> sum;
  double square = 0.0, of_units = 0.0;
  for (std::size_t i = 0; i < table_.points.size(); ++i) {
    const BenchPoint& p = table_.points[i];
    if (p.fold == 0) continue;
    const double size = left[static_cast<Eigen::Index>(i)] / p.sigma_nm;
    sum[p.unit] += size;
    square += size * size;
  }
  for (const auto& [unit, of_unit] : sum) of_units += of_unit * of_unit;
  return std::max(1.0, of_units / std::max(square, 1e-300));
}

DriveOutcome DriveSelection::settle() {
  constexpr int kMostRounds = 6;
  // A sign that is wrong beside these effects may be right beside others.
  const std::vector<bool> kept_banned = banned_;
  DriveOutcome outcome;
  for (int round = 1; round <= kMostRounds; ++round) {
    Discovery discovery = select();
    outcome = outcome_of(discovery.chosen());
    bool again = put_shapes_on_the_grid(outcome);
    again = ban_wrong_signs(outcome) || again;
    again = move_state(outcome) || again;
    if (again && round < kMostRounds) continue;
    // What is left, and what looks alike, is asked of the last choice alone.
    outcome.discovery = std::move(discovery).finished();
    break;
  }
  banned_ = kept_banned;
  return outcome;
}

bool DriveSelection::put_shapes_on_the_grid(const DriveOutcome& outcome) {
  bool moved = false;
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    auto& grid = candidates_[outcome.discovery.chosen[e].group].shape;
    moved = moved || grid.size() != outcome.effects[e].shape.size();
    for (std::size_t k = 0; k < std::min(grid.size(), outcome.effects[e].shape.size()); ++k)
      moved = moved || std::abs(grid[k] - outcome.effects[e].shape[k]) > 0.02 * std::abs(grid[k]);
    grid = outcome.effects[e].shape;
  }
  return moved;
}

bool DriveSelection::ban_wrong_signs(const DriveOutcome& outcome) {
  const DriveContext here = context();
  const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
  bool any = false;
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    const DriveFamily* family = outcome.effects[e].family;
    if (!fit.can_be(static_cast<int>(e)))
      any = ban([&](const DriveEffect& c) { return c.family == family; }) || any;
  }
  // Flanks give no power in either direction: a difference that asks for that is a sensor's.
  if (!rubs_both_ways(state_of(fit)))
    any = ban([](const DriveEffect& c) {
            return c.family->differs_by_direction && c.family->into_state;
          }) || any;
  if (!every_mesh_rubs(state_of(fit)))
    any = ban([](const DriveEffect& c) { return c.family->of_one_mesh; }) || any;
  // Of two readings of which one takes back what the other does the one that came later goes.
  for (std::size_t e = 0; e < outcome.effects.size(); ++e)
    for (std::size_t other = 0; other < e; ++other)
      if (readings_cancel(fit, other, e)) {
        const DriveFamily* family = outcome.effects[e].family;
        any = ban([&](const DriveEffect& c) { return c.family == family; }) || any;
      }
  return any;
}

bool DriveSelection::readings_cancel(const DriveFit& fit, std::size_t one, std::size_t other) {
  constexpr double kLittle = 0.05;  // of their squares
  const std::vector<DriveEffect>& effects = fit.effects();
  for (const std::size_t e : {one, other})
    if (!effects[e].family->named || effects[e].family->is_loss) return false;
  const Eigen::VectorXd a = fit.explained_nm(static_cast<int>(one)),
                        b = fit.explained_nm(static_cast<int>(other));
  return (a + b).squaredNorm() < kLittle * (a.squaredNorm() + b.squaredNorm());
}

bool DriveSelection::rubs_both_ways(const DriveState& state) const {
  // The same flanks rub one way at most three times as much as the other: more is a sensor's scale.
  return model_.friction + state.shift > std::abs(state.difference) || state.difference == 0.0;
}

bool DriveSelection::every_mesh_rubs(const DriveState& state) const {
  constexpr double kLeast = 0.2;  // of the design's
  return std::all_of(state.mesh_value.begin(), state.mesh_value.end(), [&](const auto& mesh) {
    return model_.friction + state.shift + mesh.second > kLeast * model_.friction;
  });
}

DriveState DriveSelection::state_of(const DriveFit& fit) {
  return fit.state_at(fit.coefficients());
}

bool DriveSelection::move_state(const DriveOutcome& outcome) {
  const DriveContext here = context();
  const DriveState next = state_of(DriveFit(here, value_, outcome.effects, FitRows::kTraining));
  const auto far = [&](double DriveState::*value, double size = 1.0) {
    return std::abs(next.*value - state_.*value) > kFar * size;
  };
  const double output_nm = table_.most_load_nm * model_.ratio;
  const bool moved =
      far(&DriveState::shift) || far(&DriveState::difference) || far(&DriveState::load_value) ||
      far(&DriveState::mixed_value) || far(&DriveState::mixed_exponent) ||
      far(&DriveState::speed_share) || far(&DriveState::speed_bend) ||
      far(&DriveState::scale) || far(&DriveState::input_zero_nm, table_.most_load_nm) ||
      far(&DriveState::input_drift_nm, table_.most_load_nm) ||
      far(&DriveState::output_zero_nm, output_nm) || far(&DriveState::output_drift_nm, output_nm) ||
      far_of(next.mesh_value, state_.mesh_value);
  state_ = next;
  return moved;
}

bool DriveSelection::propose_wave(const DriveOutcome& outcome) {
  if (gains_power() && !losses_beside_gains_) return false;
  const DriveContext here = context();
  const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
  const LikeliestOrder line = spectra_.likeliest_order(table_, value_ - fit.explained_nm());
  constexpr double kLevel = 0.002;  // searched beside the engine's own test
  if (!(line.p_value < kLevel)) return false;
  for (const DriveEffect& candidate : candidates_)
    if (const double order = candidate.order();
        order > 0.0 && std::abs(order - line.order) < 0.5 / std::max(1.0, table_.turns))
      return false;
  const DriveFamily* host = family_with(&DriveFamily::shape_of_wave);
  const DriveEffect wave{host, host->shape_of_wave(line.order, line.opposite)};
  const std::vector<DriveEffect> named = names_of_wave(outcome.effects, wave);
  for (const DriveEffect& name : named) add_candidate(name);
  if (named.empty()) add_candidate(wave);
  return true;
}

std::vector<DriveEffect> DriveSelection::names_of_wave(const std::vector<DriveEffect>& beside,
                                                       const DriveEffect& wave) const {
  constexpr double kAsWell = 6.6;  // chi-square
  const DriveContext here = context();
  const auto square_with = [&](const DriveEffect& effect) {
    std::vector<DriveEffect> effects = beside;
    effects.push_back(effect);
    return DriveFit(here, value_, effects, FitRows::kTraining).residual_square();
  };
  const double square = square_with(wave);
  const double rows = static_cast<double>(table_.points.size());
  const double noise = square / std::max(1.0, rows - size_of(beside) - 2.0);
  std::vector<DriveEffect> names;
  for (const DriveFamily& family : drive_library()) {
    if (!family.shapes_at_order || !may_be_there(family)) continue;
    const std::vector<DriveShape> shapes = family.shapes_at_order(here, wave.order());
    if (std::any_of(shapes.begin(), shapes.end(), [&](const DriveShape& shape) {
          return square_with({&family, shape}) < square + kAsWell * noise;
        }))
      for (const DriveShape& shape : shapes) names.push_back({&family, shape});
  }
  return names;
}

bool DriveSelection::propose_spell(const DriveOutcome& outcome) {
  if (gains_power() && !losses_beside_gains_) return false;
  constexpr double kLevel = 0.001;  // searched beside the engine's own test
  const DriveContext here = context();
  // (a wave may be a part of what comes once in a turn)
  const Eigen::VectorXd left = left_without(outcome, [](const DriveEffect& effect) {
    return !effect.family->shape_of_spell && (!effect.family->named || effect.order() > 0.0);
  });
  const LikeliestSpell of_turns = likeliest_spell_of_turns(here, left),
                       of_run = likeliest_spell_of_run(here, left);
  const LikeliestSpell& spell = of_turns.p_value <= of_run.p_value ? of_turns : of_run;
  if (!(spell.p_value < kLevel)) return false;
  const DriveFamily* host = family_with(&DriveFamily::shape_of_spell);
  return add_candidate(
      {host, host->shape_of_spell(spell.what, spell.order, spell.begin, spell.length)});
}

Eigen::VectorXd DriveSelection::left_without(
    const DriveOutcome& outcome, const std::function<bool(const DriveEffect&)>& is_left_out) const {
  const DriveFit fit(context(), value_, outcome.effects, FitRows::kTraining);
  std::vector<bool> left_out;
  for (const DriveEffect& effect : outcome.effects) left_out.push_back(is_left_out(effect));
  return value_ - fit.columns() * fit.without(left_out);
}

bool DriveSelection::propose_rest(const DriveOutcome& outcome) {
  if (gains_power() && !losses_beside_gains_) return false;
  constexpr double kLevel = 0.001;  // searched beside the engine's own test
  const DriveContext here = context();
  const LikeliestRest rest = likeliest_rest(here, left_without(outcome, has_no_name));
  if (!(rest.p_value < kLevel)) return false;
  const DriveFamily* host = family_with(&DriveFamily::shape_of_rest);
  bool any = false;
  for (const double what : {drive_effects::kDrag, drive_effects::kFlanks})
    any =
        add_candidate({host, host->shape_of_rest(what, rest.period, rest.phase, rest.rows)}) || any;
  return any;
}

bool DriveSelection::propose_wander(const DriveOutcome& outcome) {
  if (gains_power() && !losses_beside_gains_) return false;
  constexpr double kLevel = 0.001;  // searched beside the engine's own test
  const DriveContext here = context();
  const LikeliestWander wander = likeliest_wander(here, left_without(outcome, has_no_name));
  if (!(wander.p_value < kLevel)) return false;
  const DriveFamily* host = family_with(&DriveFamily::shape_of_wander);
  return add_candidate({host, host->shape_of_wander(wander.what, wander.degree)});
}

bool DriveSelection::propose_states(const DriveOutcome& outcome) {
  if (gains_power() && !losses_beside_gains_) return false;
  constexpr double kLevel = 0.001;     // searched beside the engine's own test
  constexpr double kEachChange = 9.0;  // chi-square
  const DriveContext here = context();
  const DriveFamily* host = family_with(&DriveFamily::shape_of_states);
  // (what grows over the run may only imitate it)
  std::vector<DriveEffect> beside;
  for (const DriveEffect& effect : outcome.effects)
    if (!has_no_name(effect) && !effect.family->drifts && !effect.family->follows_the_run)
      beside.push_back(effect);
  // Names may have taken a part of it: both are fitted together.
  LikeliestStates states =
      likeliest_states(here, left_without(outcome, [&](const DriveEffect& e) {
                         return has_no_name(e) || e.family->drifts || e.family->follows_the_run;
                       }));
  for (int round = 0; round < 3 && !states.changes.empty(); ++round) {
    std::vector<DriveEffect> together = beside;
    together.push_back({host, host->shape_of_states(states.what, states.changes)});
    const DriveFit fit(here, value_, together, FitRows::kTraining);
    states = likeliest_states(
        here, value_ - fit.explained_nm() + fit.explained_nm(static_cast<int>(beside.size())));
  }
  if (!(states.p_value < kLevel)) return false;
  // What follows something that was recorded needs no list of times.
  const double each = kEachChange * states.square / outcome.rows;
  if (outcome.square - states.square < each * static_cast<double>(states.changes.size() + 1))
    return false;
  return add_candidate({host, host->shape_of_states(states.what, states.changes)});
}

bool DriveSelection::add_candidate(const DriveEffect& effect) {
  for (const DriveEffect& candidate : candidates_)
    if (candidate.family == effect.family && candidate.shape == effect.shape) return false;
  candidates_.push_back(effect);
  banned_.push_back(false);
  return true;
}

}  // namespace trueflank::loop
