// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/place_profile.h"

// Pieces over one quantity told as one form: where it begins, stands out or jumps.
namespace trueflank::loop {
namespace {

/// More than this chance seldom adds where so many figures are saved (chi-square, one in a
/// hundred). Pieces that were chosen among many take off more than any would.
double by_chance(int saved) { return std::max(4.5 + 2.2 * saved, 4.0 * saved); }

/// True of a description over this quantity alone.
bool is_piece_over(const DriveEffect& effect, double over) {
  const DriveFamily& family = *effect.family;
  if (family.named) return false;
  if (family.over) return family.over(effect.shape) == over;
  return family.piece_over && family.piece_over(effect.shape) == over;
}

/// What is there at times and at times not may follow something that was recorded, and a jump of
/// the run the temperature in it.
bool is_of_the_run(const DriveEffect& effect, double over) {
  const DriveFamily& family = *effect.family;
  return static_cast<bool>(family.shape_of_states) || (over == 2.0 && family.jumps_in_run);
}

/// Load times speed, beside load, speed and temperature.
constexpr double kOverPower = 3.0;

/// What load and speed make together may be pieces of one form over their product.
bool is_piece_over_power(const DriveEffect& effect) {
  const DriveFamily& family = *effect.family;
  if (family.named) return false;
  const double over = family.over         ? family.over(effect.shape)
                      : family.piece_over ? family.piece_over(effect.shape)
                                          : kOverNothing;
  return over == 0.0 || over == 1.0 || over == kOverSeveral || over == kOverPower ||
         (family.beside_load && family.beside_load(effect.shape) == 1.0);
}

/// True of a description in proportion to the load that has a course over this quantity.
bool is_beside_load(const DriveEffect& effect, double over) {
  const DriveFamily& family = *effect.family;
  return !family.named && over != 0.0 && family.beside_load &&
         family.beside_load(effect.shape) == over;
}

bool is_constant_piece(const DriveEffect& effect) {
  return !effect.family->named && effect.family->piece_over &&
         effect.family->piece_over(effect.shape) == kOverNothing;
}

/// What is the same everywhere, and the flanks' friction among losses over the load (`with_load`):
/// nearly every bench has it.
bool is_plain(const DriveEffect& effect, bool with_load) {
  const DriveFamily& family = *effect.family;
  return family.named && effect.columns() == 1 && family.shape_values.empty() &&
         (family.follows == "nothing" ||
          (with_load && family.preference == 0 && family.follows == "load"));
}

/// A sensor's zero or scale: beside what follows the temperature it may only be what this is at its
/// middle, beside pieces over the speed what these are at theirs.
bool is_zero(const DriveEffect& effect, double over) {
  const DriveFamily& family = *effect.family;
  return over != 0.0 && family.named && !family.is_loss && effect.columns() == 1 &&
         effect.shape.empty();
}

/// A friction of the flanks by another law than the plainest, or one that drifts as the drive
/// warms: beside forms in proportion to the load it may only have mended these.
bool is_named_beside_load(const DriveEffect& effect, double over) {
  const DriveFamily& family = *effect.family;
  return family.named && family.preference > 0 &&
         (family.follows == "load" || (over == 2.0 && family.drifts));
}

/// A name of the same course that has no shape to move: a loss that nearly every bench has.
bool is_companion(const DriveEffect& effect, double over);

/// A name of the same course: its figures may only have mended the pieces.
bool is_named_over(const DriveEffect& effect, double over) {
  const DriveFamily& family = *effect.family;
  if (over == kOverPower)
    return family.named && family.preference > 0 &&
           (family.follows == "load" || family.follows == "speed");
  return family.named && family.preference > 0 &&
         family.follows == (over == 0.0   ? "load"
                            : over == 1.0 ? "speed"
                                          : "warmth");
}

bool is_companion(const DriveEffect& effect, double over) {
  return over == 1.0 && is_named_over(effect, over) && effect.columns() == 1 &&
         effect.shape.empty();
}

}  // namespace

std::vector<DriveEffect> DriveSelection::likeliest_forms(const std::vector<DriveEffect>& base,
                                                         double over) const {
  const DriveContext here = context();
  const BesideEffects beside(here, value_, base, FitRows::kTraining);
  std::vector<DriveEffect> forms;
  for (const DriveFamily& family : drive_library()) {
    const bool jumps = over == 2.0 && family.jumps_in_run;
    if (!family.all_shapes || (!family.over && !jumps) || !may_be_there(family)) continue;
    std::map<int, std::pair<double, DriveShape>> likeliest;  // of every kind
    std::vector<DriveShape> shapes = family.all_shapes(here, nullptr);
    std::erase_if(shapes, [&](const DriveShape& shape) {
      return (!jumps && family.over(shape) != over) || (family.shows && !family.shows(here, shape));
    });
    const std::vector<BesideEffects::Alone> each = beside.with_each(family, shapes);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      if (!(each[k].gain > 0.0)) continue;
      auto& [most, best] = likeliest[family.kind ? family.kind(shapes[k]) : 0];
      if (each[k].gain <= most) continue;
      most = each[k].gain;
      best = shapes[k];
    }
    if (family.falls_in_steps)
      for (auto& [kind, best] : likeliest)
        best.second = nearest_best(here, beside, {&family, best.second}).shape;
    for (const auto& [kind, best] : likeliest)
      for (DriveShape& shape : family.kin_shapes ? family.kin_shapes(best.second)
                                                 : std::vector<DriveShape>{best.second})
        forms.push_back({&family, shape});
  }
  // A name that does the same goes before; warmth and the course of the run are asked elsewhere.
  if (over == 2.0 || over == kOverPower) return forms;
  std::map<const DriveFamily*, std::pair<double, DriveEffect>> names;
  for (std::size_t g = 0; g < candidates_.size(); ++g) {
    const DriveEffect& candidate = candidates_[g];
    if (banned_[g] || candidate.columns() != 1 || !is_named_over(candidate, over)) continue;
    const double gain = beside.with(candidate).gain;
    auto& [most, best] = names[candidate.family];
    if (best.family == nullptr || gain > most) {
      most = gain;
      best = candidate;
    }
  }
  for (const auto& [family, name] : names) forms.push_back(name.second);
  return forms;
}

void DriveSelection::tell_as_one_form(DriveOutcome& outcome) {
  for (const double over : {0.0, 1.0, 2.0, kOverPower}) {
    // (what has one course over load or speed was told so)
    if (over == kOverPower &&
        std::count_if(outcome.effects.begin(), outcome.effects.end(), is_piece_over_power) < 1)
      continue;
    const bool with_load =
        over == 0.0 || over == kOverPower ||
        std::any_of(outcome.effects.begin(), outcome.effects.end(),
                    [&](const DriveEffect& e) { return is_beside_load(e, over); });
    const auto piece = [&](const DriveEffect& e) {
      if (over == kOverPower) return is_piece_over_power(e);
      // Flanks that rub more from a speed on look much like a loss that begins at a power.
      if (over == 1.0 && !e.family->named && e.family->over &&
          e.family->over(e.shape) == kOverPower)
        return true;
      return is_piece_over(e, over) || is_beside_load(e, over) || is_of_the_run(e, over);
    };
    const bool pieces = std::any_of(outcome.effects.begin(), outcome.effects.end(), piece);
    // Names that make up a form together: of several that do what one form does each mends what the
    // others do where nothing changes.
    const auto names = std::count_if(outcome.effects.begin(), outcome.effects.end(),
                                     [&](const DriveEffect& e) { return is_named_over(e, over); });
    if (!pieces && (over == 2.0 || names < 2)) continue;
    OneForm now{.effects = outcome.effects, .from = {}, .size = size_with_changes(outcome.effects)};
    const DriveContext here = context();
    now.square = DriveFit(here, value_, now.effects, FitRows::kTraining).residual_square();
    std::vector<OneForm> sets;
    for (const bool with_names : {false, true}) {
      if (!with_names && !pieces) continue;
      OneForm base;
      bool any_name = false;
      for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
        const DriveEffect& effect = outcome.effects[e];
        const bool name =
            with_names && (is_named_over(effect, over) ||
                           (with_load && over != 0.0 && is_named_beside_load(effect, over)));
        any_name = any_name || name;
        // What is plain may have mended the pieces too: it is asked anew.
        if (piece(effect) || is_constant_piece(effect) || name ||
            is_plain(effect, with_load || over == 1.0) || is_zero(effect, over))
          continue;
        base.effects.push_back(effect);
        base.from.push_back(static_cast<int>(e));
      }
      if (with_names && !any_name) continue;
      add_sets_with_one_form(outcome, base, over, with_load, sets);
    }
    double noise = now.square / std::max(1.0, outcome.rows - now.size);
    for (const OneForm& set : sets)
      noise = std::min(noise, set.square / std::max(1.0, outcome.rows - set.size));
    const OneForm *best = nullptr, *nowhere = nullptr;  // with a place or none, begins nowhere
    for (const OneForm& set : sets) {
      const int saved = now.size - set.size;
      const double more = set.square - now.square;
      constexpr double kAsWell = 4.0;  // chi-square, of one effect in place of several
      const bool fewer = set.effects.size() < outcome.effects.size();
      double room = saved > 0    ? by_chance(saved) * outcome.shared
                    : saved == 0 ? (fewer ? kAsWell * outcome.shared : 0.0)
                                 : 9.0 * saved;
      // A form over load or speed alone says as much of one effect: load times speed must say more.
      constexpr double kMoreThanOneCourse = 25.0;
      if (over == kOverPower && !fewer) room = std::min(room, -kMoreThanOneCourse * outcome.shared);
      // What has a place stays where it leaves clearly less.
      if (saved >= 0 && now.has_a_place() && set.begins_nowhere()) room += OneForm::kAPlace;
      if (more > noise * room) continue;
      OneForm const*& of_kind = set.begins_nowhere() ? nowhere : best;
      if (of_kind == nullptr || set.figure(noise) < of_kind->figure(noise) - OneForm::kTheSame)
        of_kind = &set;
      else if (set.figure(noise) < of_kind->figure(noise) + OneForm::kTheSame &&
               square_of_all(set) < square_of_all(*of_kind))
        of_kind = &set;
    }
    if (nowhere != nullptr &&
        (best == nullptr ||
         nowhere->figure(noise) <
             best->figure(noise) + (best->has_a_place() ? OneForm::kAPlace : 0.0)))
      best = nowhere;
    if (best == nullptr) continue;
    const double gain = now.figure(noise) - best->figure(noise);
    if (!pieces) {
      constexpr double kSurely = 6.0, kAsWell = -4.0;  // with more figures, with no more
      const bool has_form = std::any_of(best->effects.begin(), best->effects.end(), piece);
      if (!has_form || gain < (best->size <= now.size ? kAsWell : kSurely)) continue;
    }
    constexpr double kOpen = 10.0;
    OneForm refined = *best;
    refine_drive_shapes(context(), value_, FitRows::kTraining, refined.effects);
    exchange_effects(outcome, refined, gain < kOpen);
  }
}

void DriveSelection::add_sets_with_one_form(const DriveOutcome& outcome, const OneForm& base,
                                            double over, bool with_load,
                                            std::vector<OneForm>& sets) {
  const auto is_taken = [&](const DriveFamily* family) {
    return std::any_of(base.effects.begin(), base.effects.end(),
                       [&](const DriveEffect& e) { return e.family == family; });
  };
  // A course holds what is the same everywhere too: that has names.
  std::vector<DriveEffect> plain;
  // A form over the speed may stand beside a loss that grows with it: a course holds both.
  std::vector<std::vector<DriveEffect>> companions{{}};
  for (std::size_t g = 0; g < candidates_.size(); ++g) {
    const DriveEffect& candidate = candidates_[g];
    if (is_taken(candidate.family) || !may_be_there(*candidate.family)) continue;
    if (is_plain(candidate, with_load || over == 1.0) ||
        (is_zero(candidate, over) && outcome.has(candidate.family)))
      plain.push_back(candidate);
    if (!banned_[g] && is_companion(candidate, over)) companions.push_back({candidate});
  }
  for (const std::vector<DriveEffect>& beside : companions) {
    std::vector<DriveEffect> full = base.effects;
    full.insert(full.end(), plain.begin(), plain.end());
    full.insert(full.end(), beside.begin(), beside.end());
    std::vector<DriveEffect> forms = likeliest_forms(full, over);
    if (!beside.empty())
      std::erase_if(forms, [&](const DriveEffect& form) { return form.family->named; });
    // Beside all that is plain a place is found, and moves little where some of it is left out.
    for (DriveEffect& form : forms) {
      // (one that holds a constant is free to go anywhere beside another one)
      if (form.family->holds_a_constant) continue;
      std::vector<DriveEffect> effects = full;
      effects.push_back(form);
      refine_drive_shapes(context(), value_, FitRows::kTraining, effects);
      form = effects.back();
    }
    if (beside.empty()) forms.emplace_back();  // none at all
    for (std::size_t which = 0; which < (std::size_t{1} << plain.size()); ++which)
      for (const DriveEffect& form : forms) {
        OneForm set = base;
        const auto add = [&](const DriveEffect& effect) {
          set.effects.push_back(effect);
          set.from.push_back(-1);
        };
        for (std::size_t k = 0; k < plain.size(); ++k)
          if ((which >> k) & 1U) add(plain[k]);
        for (const DriveEffect& effect : beside) add(effect);
        if (form.family != nullptr) add(form);
        if (form.family != nullptr && form.family->holds_a_constant)
          refine_drive_shapes(context(), value_, FitRows::kTraining, set.effects);
        if (!set.effects.empty() && !set.is_at_an_end() && fits(set))
          sets.push_back(std::move(set));
      }
  }
}

double DriveSelection::square_of_all(const OneForm& set) const {
  const DriveContext here = context();
  const Eigen::VectorXd left =
      value_ - DriveFit(here, value_, set.effects, FitRows::kTraining).explained_nm();
  double square = 0.0;
  for (std::size_t i = 0; i < table_.points.size(); ++i) {
    const double off = left[static_cast<Eigen::Index>(i)] / table_.points[i].sigma_nm;
    square += off * off;
  }
  return square;
}

bool DriveSelection::fits(OneForm& set) const {
  const DriveContext here = context();
  const DriveFit fit(here, value_, set.effects, FitRows::kTraining);
  if (!fit.can_be()) return false;
  for (const DriveEffect& e : set.effects)
    if (e.family->shows && !e.family->shows(here, e.shape)) return false;
  set.square = fit.residual_square();
  set.size = size_with_changes(set.effects);
  const DriveState state = state_of(fit);
  return rubs_both_ways(state) && every_mesh_rubs(state);
}

void DriveSelection::exchange_effects(DriveOutcome& outcome, const OneForm& set,
                                      bool name_is_open) {
  std::vector<ChosenGroup> chosen;
  // What is new is as sure as the surest of what it stands for.
  ChosenGroup surest;
  std::vector<int> names;
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    const bool kept =
        std::find(set.from.begin(), set.from.end(), static_cast<int>(e)) != set.from.end();
    if (kept) continue;
    if (outcome.discovery.chosen[e].p_value <= surest.p_value) surest = outcome.discovery.chosen[e];
    const DriveFamily* family = outcome.effects[e].family;
    const bool told_again =
        std::any_of(set.effects.begin(), set.effects.end(),
                    [&](const DriveEffect& other) { return other.family == family; });
    if (family->named && name_is_open && !told_again)
      names.push_back(outcome.discovery.chosen[e].group);
  }
  for (std::size_t e = 0; e < set.effects.size(); ++e) {
    if (set.from[e] >= 0) {
      chosen.push_back(outcome.discovery.chosen[static_cast<std::size_t>(set.from[e])]);
      continue;
    }
    add_candidate(set.effects[e]);
    ChosenGroup group = surest;
    group.confounded = set.effects[e].family->named ? std::vector<int>{} : names;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (candidates_[g].family == set.effects[e].family &&
          candidates_[g].shape == set.effects[e].shape)
        group.group = static_cast<int>(g);
    chosen.push_back(group);
  }
  outcome.effects = set.effects;
  outcome.discovery.chosen = std::move(chosen);
  settle_after_exchange(outcome);
}

}  // namespace trueflank::loop
