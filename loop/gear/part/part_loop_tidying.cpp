// SPDX-License-Identifier: GPL-3.0-or-later
// What is taken out of the answer, or put together, once the effects are chosen.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/fit/trial_fit.h"
#include "trueflank/loop/gear/paired_sums.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/random_error.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {

/// What is still impossible in the end is not told.
void PartLoop::drop_impossible() {
  for (bool again = true; again;) {
    again = false;
    const auto fit = fit_of(effects_);
    for (std::size_t e = options_.given.size(); e < effects_.size() && !again; ++e) {
      if (is_possible(geometry_, *fit, static_cast<int>(e))) continue;
      effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(e));
      discovery_.chosen.erase(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(e));
      again = true;
    }
  }
}

/// Beside an effect with a shape (where a relief starts, how wide a hollow is) a small one may have
/// been chosen for what the shape's first value left. With the shape free it is nothing, and is not
/// told.
void PartLoop::drop_what_mends_a_shape() {
  constexpr double kStandsOut =
      3.5;  // standard errors: less is never found alone among so many candidates
  constexpr double kMissed = 36.0;  // chi-square
  const auto shaped = [](const Effect& e) {
    return e.family->shape_is_continuous && !e.family->shape_is_step;
  };
  while (effects_.size() > 1 && std::any_of(effects_.begin(), effects_.end(), shaped)) {
    const auto kept = fit_of(effects_);
    const PointFit& fit = *kept;
    const Eigen::MatrixXd covariance =
        shape_uncertainty(geometry_, table_, patches_, fit).covariance;
    std::size_t least = effects_.size();
    double least_square = kStandsOut * kStandsOut;
    for (std::size_t e = options_.given.size(); e < effects_.size(); ++e) {
      if (effects_[e].family->local) continue;
      const int first = fit.first_column(static_cast<int>(e)), columns = effects_[e].columns();
      const Eigen::VectorXd b = fit.coefficients().segment(first, columns);
      const Eigen::MatrixXd spread = covariance.block(first, first, columns, columns);
      const double square = b.dot(symmetric_solution(spread, b)) / columns;
      if (square >= least_square) continue;
      least_square = square;
      least = e;
    }
    if (least == effects_.size()) return;
    const std::vector<Effect> with = effects_;
    const ChosenGroup record = discovery_.chosen[least];
    remove_effect(least);
    refine_shapes(geometry_, table_, patches_, effects_, options_.given.size());
    // Beside another shape its error is large though the two together say what neither says alone.
    if (fit_of(effects_)->residual_square() - fit.residual_square() < kMissed) continue;
    effects_ = with;
    discovery_.chosen.insert(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(least),
                             record);
    return;
  }
}

/// What a form without a name leaves looks a little like many things: beside one, a name must be as
/// sure as flips can say, or stand far above its error.
void PartLoop::drop_doubtful_names() {
  constexpr double kSure = 0.002, kFar = 36.0;  // chi-square a column: six standard errors
  const auto drop = [&](std::size_t e) {
    effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(e));
    discovery_.chosen.erase(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(e));
  };
  if (std::none_of(effects_.begin(), effects_.end(), [](const Effect& e) {
        return e.is_term() && e.family->shapes && e.family->form_word.empty();
      }))
    return;
  for (std::size_t e = effects_.size(); e-- > options_.given.size();) {
    if (!effects_[e].family->named || effects_[e].family->local ||
        !(discovery_.chosen[e].p_value > kSure / options_.tables))
      continue;
    std::vector<Effect> without = effects_;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
    const double loss = TrialFit(geometry_, table_, patches_, without).residual_square() -
                        TrialFit(geometry_, table_, patches_, effects_).residual_square();
    if (loss < kFar * effects_[e].columns()) drop(e);
  }
}

namespace {

/// The family that says on both flanks what this one says on one; nullptr: none does.
const EffectFamily* on_both_flanks(const EffectFamily& family) {
  if (!family.flank_only) return &family;
  for (const EffectFamily& other : effect_library())
    if (other.local && !other.flank_only && other.shape_names == family.shape_names) return &other;
  return nullptr;
}

bool are_two_flanks_of_one(const Effect& a, const Effect& b) {
  if (a.family != b.family || a.flank == b.flank || a.flank == FlankChoice::kBoth ||
      b.flank == FlankChoice::kBoth)
    return false;
  constexpr double kSameShape = 0.03;
  for (std::size_t k = 0; k < a.shape.size(); ++k)
    if (a.family->shape_is_continuous
            ? std::abs(a.shape[k] - b.shape[k]) > kSameShape * std::abs(a.shape[k])
            : a.shape[k] != b.shape[k])
      return false;
  return true;
}

}  // namespace

/// An effect found on the left flanks and on the right ones, of one size, is one effect: of a
/// tooth, too, and if it stands out on one flank by as much as it lies back on the other, it
/// stands aside.
void PartLoop::join_flanks() {
  constexpr double kErrors = 3.0, kSameSize = 0.1;
  const auto same_size = [&](const PointFit& fit, std::size_t a, std::size_t b, double sign) {
    for (int k = 0; k < effects_[a].columns(); ++k) {
      const int at_a = fit.first_column(static_cast<int>(a)) + k,
                at_b = fit.first_column(static_cast<int>(b)) + k;
      const double left = fit.coefficients()[at_a], right = sign * fit.coefficients()[at_b];
      const double spread = std::sqrt(fit.covariance()(at_a, at_a) + fit.covariance()(at_b, at_b));
      if (std::abs(left - right) >
          std::max(kErrors * spread, 0.5 * kSameSize * std::abs(left + right)))
        return false;
    }
    return true;
  };
  for (std::size_t a = options_.given.size(); a < effects_.size(); ++a)
    for (std::size_t b = a + 1; b < effects_.size(); ++b) {
      const EffectFamily* both = on_both_flanks(*effects_[a].family);
      if (both == nullptr || !are_two_flanks_of_one(effects_[a], effects_[b])) continue;
      const auto fit = fit_of(effects_);
      const bool aside = effects_[a].family->flank_only && effects_[a].family->local &&
                         effects_[a].shape.size() == 1 && same_size(*fit, a, b, -1.0);
      const bool turned = effects_[a].family == find_family("unnamed_step") &&
                          effects_[a].shape[2] == 0.0 && same_size(*fit, a, b, -1.0);
      if (!aside && !turned && !same_size(*fit, a, b, 1.0)) continue;
      for (std::size_t k = 0; k < effects_[a].shape.size(); ++k)
        effects_[a].shape[k] = 0.5 * (effects_[a].shape[k] + effects_[b].shape[k]);
      effects_[a].family = both;
      if (turned) effects_[a].shape[2] = 1.0;
      if (aside)
        effects_[a] = {find_family("unnamed_tooth_aside"), {}, {effects_[a].shape[0], 1.0}};
      effects_[a].flank = FlankChoice::kBoth;
      discovery_.chosen[a].p_value =
          std::min(discovery_.chosen[a].p_value, discovery_.chosen[b].p_value);
      discovery_.chosen[a].group = -1;
      effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(b));
      discovery_.chosen.erase(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(b));
      b = a;
    }
}

/// Two names that together do what a third one does alone: equal slopes of all flanks and one of
/// the left flanks are opposite slopes.
void PartLoop::tell_two_names_as_one() {
  constexpr double kNothing = 9.0;  // chi-square
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  const bool shows_heights = is_told_apart(level, {});
  const auto over = [&](const Effect& effect) {
    Eigen::VectorXd field = over_a_tooth(geometry_, effect);
    const Eigen::Index flank = field.size() / 2;
    for (const Eigen::Index first : {Eigen::Index{0}, flank})
      if (!shows_heights) field.segment(first, flank).array() -= field.segment(first, flank).mean();
    return field;
  };
  const auto one_in_place_of = [&](std::size_t a, std::size_t b) {
    const Eigen::VectorXd of_a = over(effects_[a]), of_b = over(effects_[b]);
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const Effect& third = candidates_[c];
      if (unseen_[c] || !is_name_of_all_teeth(third) || !third.shape.empty() ||
          !is_in_the_span(over(third), of_a, of_b))
        continue;
      std::vector<Effect> with = effects_;
      with[a] = third;
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(b));
      const auto fit = fit_of(with);
      if (fit->residual_square() > fit_of(effects_)->residual_square() + kNothing ||
          !is_possible(geometry_, *fit, static_cast<int>(a)))
        continue;
      ChosenGroup record;
      record.group = -1;
      record.p_value = std::min(discovery_.chosen[a].p_value, discovery_.chosen[b].p_value);
      remove_effect(b);
      effects_[a] = third;
      discovery_.chosen[a] = record;
      std::copy_n(effects_.begin(), options_.given.size(), options_.given.begin());
      return true;
    }
    return false;
  };
  for (std::size_t a = first_told_here(); a < effects_.size(); ++a)
    for (std::size_t b = a + 1; b < effects_.size(); ++b)
      if (is_name_of_all_teeth(effects_[a]) && is_name_of_all_teeth(effects_[b]) &&
          effects_[a].shape.empty() && effects_[b].shape.empty() && one_in_place_of(a, b))
        b = a;
}

/// A bow without a height of its own beside a bow with a name, which has one, are that bow and a
/// height. (Both pairs say the same: how well a height is told apart from a scale is the bow's,
/// too.)
void PartLoop::tell_bows_with_a_level() {
  constexpr double kNothing = 1.0, kAnything = 1e-3;  // chi-square; of the column
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    const Effect term = effects_[e];
    if (term.family != level.family || term.columns() != 1 || term.shape[3] != 0.0 ||
        term.shape[0] + term.shape[1] != 2.0 || term.shape[0] == 1.0)
      continue;
    const bool named = std::any_of(effects_.begin(), effects_.end(), [&](const Effect& name) {
      return is_name_of_all_teeth(name) && name.shape.empty() && name.flank == term.flank &&
             run_alike(geometry_, name, term);
    });
    if (!named || std::find(effects_.begin(), effects_.end(), level) != effects_.end()) continue;
    std::vector<Effect> with = effects_;
    with[e] = level;
    const auto fit = fit_of(with);
    if (!(fit->retained(fit->first_column(static_cast<int>(e))) > kAnything) ||
        fit->residual_square() > fit_of(effects_)->residual_square() + kNothing)
      continue;
    std::swap(effects_, with);
    std::copy_n(effects_.begin(), options_.given.size(), options_.given.begin());
  }
}

/// A form at the place of a far larger one of its kind is what the place of that leaves.
void PartLoop::drop_echoes_of_forms() {
  constexpr double kSmall = 0.1, kNear = 0.01, kLittle = 49.0;  // chi-square: seven errors
  const auto place = [&](const Effect& e) {
    return e.shape[0] != 0.0
               ? e.shape[1] / geometry_.face_width_mm()
               : geometry_.roll_at_radius_mm(0.5 * e.shape[1]) /
                     std::abs(geometry_.tip_form_roll_mm() - geometry_.root_form_roll_mm());
  };
  for (std::size_t e = effects_.size(); e-- > first_told_here();) {
    const Effect& small = effects_[e];
    const std::vector<std::string>& names = small.family->shape_names;
    if (!small.is_term() || names.size() < 2 || names[0] != "along" || names[1] != "place_mm")
      continue;
    const auto fit = fit_of(effects_);
    for (std::size_t f = 0; f < effects_.size(); ++f) {
      const Effect& large = effects_[f];
      if (f == e || large.family != small.family || large.shape[0] != small.shape[0] ||
          std::abs(place(large) - place(small)) > kNear ||
          fit->effect_size_um(static_cast<int>(e)) >
              kSmall * fit->effect_size_um(static_cast<int>(f)))
        continue;
      std::vector<bool> with(effects_.size(), true);
      with[e] = false;
      if (fit->residual_square(with) - fit->residual_square() > kLittle) continue;
      remove_effect(e);
      break;
    }
  }
}

/// A tooth that stands out on both flanks, and aside by as much, stands out on one.
void PartLoop::tell_teeth_of_one_flank() {
  constexpr double kNothing = 9.0;  // chi-square
  const auto one_flank_of = [&](std::size_t aside, std::size_t out) {
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
      std::vector<Effect> with = effects_;
      with[aside] = {find_family("unnamed_flank"), flank, {effects_[aside].shape[0]}};
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(out));
      if (fit_of(with)->residual_square() > fit_of(effects_)->residual_square() + kNothing)
        continue;
      effects_[aside] = with[aside < out ? aside : aside - 1];
      std::copy_n(effects_.begin(), options_.given.size(), options_.given.begin());
      remove_effect(out);
      return true;
    }
    return false;
  };
  for (std::size_t a = first_told_here(); a < effects_.size(); ++a) {
    if (effects_[a].family != find_family("unnamed_tooth_aside")) continue;
    for (std::size_t b = first_told_here(); b < effects_.size(); ++b)
      if (effects_[b].family->local && !effects_[b].family->flank_only &&
          effects_[b].shape.size() == 1 && effects_[b].shape[0] == effects_[a].shape[0] &&
          one_flank_of(a, b)) {
        a = b < a ? a - 1 : a;
        break;
      }
  }
}

/// Forms that were found first may stand where fewer names say the same, or where the hold-out took
/// all of them back: all is chosen once more from names alone.
void PartLoop::prefer_names() {
  constexpr int kAnyNumber = -1000;
  const bool all_taken_back = vetoed_ && effects_.size() == first_told_here();
  if (!all_taken_back &&
      std::none_of(effects_.begin(), effects_.end(), [](const Effect& e) { return e.is_term(); }))
    return;
  Options options = options_;
  options.names_only = true;
  (void)adopt_if_simpler(std::move(options), all_taken_back ? kAnyNumber : 0);
}

/// Two that these data cannot tell from one and the same third are perhaps that: without the first
/// of them all is chosen once more.
void PartLoop::prefer_one_name_to_two() {
  for (std::size_t a = 0; a < effects_.size(); ++a)
    for (std::size_t b = a + 1; b < effects_.size(); ++b) {
      if (!effects_[a].family->named || !effects_[b].family->named) continue;
      const std::vector<int>&of_a = discovery_.chosen[a].confounded,
            &of_b = discovery_.chosen[b].confounded;
      const bool third = std::any_of(of_a.begin(), of_a.end(), [&](int group) {
        return candidates_[static_cast<std::size_t>(group)].family->named &&
               std::find(of_b.begin(), of_b.end(), group) != of_b.end();
      });
      if (!third) continue;
      Options options = options_;
      options.names_only = true;
      options.without.push_back(effects_[a].family);
      if (adopt_if_simpler(std::move(options), 1)) return;
    }
}

/// A name whose own interval holds zero, now that all else stands beside it, is no finding.
void PartLoop::drop_names_that_may_be_nothing() {
  for (bool again = true; again;) {
    again = false;
    const auto fit = fit_of(effects_);
    double least = 1.0;  // of the half width
    std::size_t weakest = 0;
    for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
      if (!effects_[e].family->named || effects_[e].family->local || effects_[e].columns() != 1)
        continue;
      const int column = fit->first_column(static_cast<int>(e));
      const double half =
          student_95(fit->degrees(column)) * std::sqrt(fit->covariance()(column, column));
      const double ratio = std::abs(fit->coefficients()[column]) / half;
      if (!(ratio < least)) continue;
      least = ratio;
      weakest = e;
      again = true;
    }
    if (again) remove_effect(weakest);
  }
}

int values_of(const std::vector<Effect>& effects, bool places_too) {
  int values = 0;
  for (const Effect& effect : effects) {
    const EffectFamily& family = *effect.family;
    values += effect.columns();
    if (!places_too) continue;
    if (family.values_sought)
      values += family.values_sought(effect.shape);
    else if (family.named || !family.form_word.empty())
      values += family.shape_is_continuous ? static_cast<int>(effect.shape.size()) : 0;
    else
      values += static_cast<int>(
          std::count_if(family.term_keys.begin(), family.term_keys.end(),
                        [](const TermKey& key) { return key.kind == TermKey::Kind::kNumber; }));
  }
  return values;
}

/// Makes the whole choice again in another way. It is taken over where it has names alone, so many
/// values fewer, leaves no more, and nothing is left that a form would say, or far less than
/// before.
bool PartLoop::adopt_if_simpler(Options options, int least_spared) {
  // Chi-square: three standard errors, and what a column more takes out by chance; a thousandth of
  // the error is no loss.
  constexpr double kNothing = 9.0, kByChance = 4.0, kNoLoss = 1e-3;
  constexpr double kFarLess = 0.5;  // of the error's square
  options.given.resize(first_told_here());
  SharedTable measured = table_;
  if (measured->is_displaced) undo_displacement(geometry_, measured.own());
  PartLoop names(geometry_, std::move(measured), std::move(options));
  names.run();
  if (names.effects_.empty()) return false;
  names.add_names(values_of(effects_, true) - least_spared);
  names.tell_parts_of_a_form();
  // Forms may stand beside them where that says more with fewer values and has more names.
  const auto is_term = [](const Effect& e) { return e.is_term(); };
  const auto is_named = [](const Effect& e) { return e.family->named; };
  const bool with_forms = std::any_of(names.effects_.begin(), names.effects_.end(), is_term);
  if (with_forms && std::count_if(names.effects_.begin(), names.effects_.end(), is_named) <=
                        std::count_if(effects_.begin(), effects_.end(), is_named))
    return false;
  // A kink has a place; three names that follow it have one each, and a width.
  const bool beside_forms =
      std::any_of(effects_.begin(), effects_.end(), [](const Effect& e) { return e.is_term(); });
  const int spared = values_of(effects_, beside_forms) - values_of(names.effects_, beside_forms);
  if (spared < (with_forms ? std::max(1, least_spared) : least_spared)) return false;
  const auto own = fit_of(effects_), other = names.fit_of(names.effects_);
  const auto before = own->errors(std::vector<bool>(effects_.size(), true)),
             after = other->errors(std::vector<bool>(names.effects_.size(), true));
  const auto n = static_cast<double>(own->observations());
  const double loss = n * (std::pow(after.rms_um / before.rms_um, 2) - 1.0);
  if (loss > (with_forms ? 0.0 : kNothing + kByChance * spared + kNoLoss * n)) return false;
  names.remainder_ = names.remainder_of(names.effects_, RemainderOf::kAll);
  if (names.structure_is_left() && !(loss < -kFarLess * n)) return false;
  take_over(names);
  return true;
}

void PartLoop::take_over(PartLoop& other) {
  effects_ = std::move(other.effects_);
  left_beside_ = std::move(other.left_beside_);
  discovery_ = std::move(other.discovery_);
  candidates_ = std::move(other.candidates_);
  banned_ = std::move(other.banned_);
  unseen_ = std::move(other.unseen_);
  table_ = other.table_;
  patches_ = std::move(other.patches_);
  options_.given = std::move(other.options_.given);
  neighbours_ = std::move(other.neighbours_);
  vetoed_ = other.vetoed_;
  denied_spot_ = other.denied_spot_;
  given_p_values_ = std::move(other.given_p_values_);
  problem_ = {};
  kept_.valid = false;
  forget_fits();
}

namespace {

/// Squares of profile traces [um^2]: of values beside each trace's mean, and beside its straight
/// line.
struct TraceSquares {
  double whole = 0.0, bent = 0.0;
};

TraceSquares squares_of_profiles(const FlankGeometry& geometry, const Observations& table,
                                 const std::vector<float>& row_um) {
  std::map<int, PairedSums> of_trace;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kProfile || row.trace < 0 || !std::isfinite(row_um[i]))
      continue;
    of_trace[row.trace].add(geometry.profile_coordinate(table.place(row).roll_mm), row_um[i]);
  }
  TraceSquares squares;
  for (const auto& [trace, sums] : of_trace) {
    const double xx = sums.square_of_x(), xy = sums.product(), yy = sums.square_of_y();
    squares.whole += yy;
    squares.bent += xx > 0.0 ? yy - xy * xy / xx : yy;
  }
  return squares;
}

/// True where the traces would bend as the wave does that takes `bare_um` to `after_um`, and do
/// not: slopes that differ from tooth to tooth are told as a wave over the profile.
bool is_wave_of_straight_traces(const FlankGeometry& geometry, const Observations& table,
                                const std::vector<float>& bare_um,
                                const std::vector<float>& after_um) {
  constexpr double kBends = 0.5;
  std::vector<float> wave_um(bare_um.size());
  for (std::size_t i = 0; i < wave_um.size(); ++i) wave_um[i] = bare_um[i] - after_um[i];
  const TraceSquares bare = squares_of_profiles(geometry, table, bare_um),
                     after = squares_of_profiles(geometry, table, after_um),
                     wave = squares_of_profiles(geometry, table, wave_um);
  if (!(wave.whole > 0.0)) return false;
  const double taken = bare.whole - after.whole, taken_bent = bare.bent - after.bent;
  return taken_bent < kBends * taken * wave.bent / wave.whole;
}

}  // namespace

/// While structure is left, a name that does less than what is left, in every kind of record that
/// shows it, is as likely a part of that: it is told as a form, or not at all. So is a machine's
/// order that straight traces look like.
void PartLoop::doubt_names_below_what_is_left() {
  constexpr double kLess = 0.25, kShows = 0.01;  // of squares
  const std::size_t told = first_told_here();
  if (effects_.size() == told) return;
  const PointFit fit(geometry_, table_, patches_, effects_);
  const auto after_um = fit.residuals_um();
  const WhatIsLeft known = what_is_left();
  std::map<ObservationKind, double> left, with;
  for (const auto& [kind, error] : errors_of_kinds(geometry_, table_, patches_, *after_um, known)) {
    with[kind] = error.square / error.count;
    left[kind] = std::max(0.0, error.square - error.random_square) / error.count;
  }
  const bool sizes =
      std::any_of(table_->rows.begin(), table_->rows.end(),
                  [](const Observation& row) { return row.kind == ObservationKind::kSize; });
  for (std::size_t e = effects_.size(); e-- > told;) {
    const EffectFamily& family = *effects_[e].family;
    if (!family.named || family.local || (sizes && family.shows_in_sizes)) continue;
    std::vector<Effect> without = effects_;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
    const auto bare_um = PointFit(geometry_, table_, patches_, without).residuals_um();
    // What it takes out beside the others: two that undo each other take out nothing.
    std::map<ObservationKind, double> taken;
    double most = 0.0;
    for (const auto& [kind, error] :
         errors_of_kinds(geometry_, table_, patches_, *bare_um, known)) {
      taken[kind] = error.square / error.count - with[kind];
      most = std::max(most, taken[kind]);
    }
    const bool stands = std::any_of(taken.begin(), taken.end(), [&](const auto& of_kind) {
      return of_kind.second > kShows * most && of_kind.second >= kLess * left[of_kind.first];
    });
    const bool slopes = family.tells_order_along_profile && table_->points_mm.empty() &&
                        is_wave_of_straight_traces(geometry_, table_, *bare_um, *after_um);
    if (stands && !slopes) continue;
    if (const EffectFamily* form = find_form(effects_[e].family->form_word);
        form != nullptr && !slopes) {
      effects_[e].family = form;
      continue;
    }
    effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(e));
    discovery_.chosen.erase(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(e));
    if (e < options_.given.size()) {
      options_.given.erase(options_.given.begin() + static_cast<std::ptrdiff_t>(e));
      given_p_values_.erase(given_p_values_.begin() + static_cast<std::ptrdiff_t>(e - told));
    }
  }
}

}  // namespace trueflank::loop
