// SPDX-License-Identifier: GPL-3.0-or-later
// What is taken out of the answer, or put together, once the effects are chosen.
#include "trueflank/loop/gear/part/tidying.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/fit/trial_fit.h"
#include "trueflank/loop/gear/paired_sums.h"
#include "trueflank/loop/gear/part/names/names.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/parts_of_forms.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/structure_left.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/random_error.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
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

/// A tooth on both flanks with one of its flanks beside it: as its two flanks, which say the same.
void tell_as_two_flanks(Effect& a, Effect& b) {
  const auto is_flank = [](const Effect& e) { return e.family == find_family("unnamed_flank"); };
  const Effect& one = is_flank(a) ? a : b;
  Effect& both = is_flank(a) ? b : a;
  if (!is_flank(one) || is_flank(both) || !both.family->local || both.columns() != 1 ||
      both.flank != FlankChoice::kBoth || both.shape[0] != one.shape[0])
    return;
  both = one;
  both.flank = one.flank == FlankChoice::kLeft ? FlankChoice::kRight : FlankChoice::kLeft;
}

/// Of what one tooth has, goes what the others say without it: it stood for them before they were
/// found.
void drop_idle_of_a_tooth(PartModel& model) {
  constexpr double kNothing = 9.0;  // chi-square
  const auto is_of_a_tooth = [](const Effect& e) { return e.family->local && e.columns() == 1; };
  for (std::size_t e = model.effects.size(); e-- > model.options.given.size();) {
    const Effect& idle = model.effects[e];
    if (!is_of_a_tooth(idle)) continue;
    const auto others =
        std::count_if(model.effects.begin(), model.effects.end(), [&](const Effect& other) {
          return is_of_a_tooth(other) && other.shape[0] == idle.shape[0];
        });
    if (others < 2) continue;
    std::vector<bool> with(model.effects.size(), true);
    with[e] = false;
    const auto fit = fit_of(model, model.effects);
    if (fit->residual_square(with) - fit->residual_square() < kNothing) remove_effect(model, e);
  }
}

/// Makes the whole choice again in another way. It is taken over where it has names alone, so many
/// values fewer, leaves no more, and nothing is left that a form would say, or far less than
/// before.
bool adopt_if_simpler(PartModel& model, PartOptions options, int least_spared) {
  // Chi-square: three standard errors, and what a column more takes out by chance; a thousandth of
  // the error is no loss.
  constexpr double kNothing = 9.0, kByChance = 4.0, kNoLoss = 1e-3;
  constexpr double kFarLess = 0.5;  // of the error's square
  options.given.resize(first_told_here(model));
  SharedTable measured = model.table;
  if (measured->is_displaced) undo_displacement(model.geometry, measured.own());
  PartModel names(model.geometry, std::move(measured), std::move(options));
  explain_part(names);
  const double teeth = model.geometry.teeth();
  if (names.effects.empty() ||
      std::any_of(names.effects.begin(), names.effects.end(), [&](const Effect& e) {
        return e.family->tells_order_along_profile && std::remainder(e.order(), teeth) == 0.0;
      }))
    return false;  // (what every tooth has alike is no machine's order)
  add_names(names, values_of(model.effects, true) - least_spared);
  tell_parts_of_a_form(names);
  // Forms may stand beside them where that says more with fewer values and has more names.
  const auto is_term = [](const Effect& e) { return e.is_term(); };
  const auto is_named = [](const Effect& e) { return e.family->named; };
  const bool with_forms = std::any_of(names.effects.begin(), names.effects.end(), is_term);
  if (with_forms && std::count_if(names.effects.begin(), names.effects.end(), is_named) <=
                        std::count_if(model.effects.begin(), model.effects.end(), is_named))
    return false;
  // A kink has a place; three names that follow it have one each, and a width.
  const bool beside_forms = std::any_of(model.effects.begin(), model.effects.end(),
                                        [](const Effect& e) { return e.is_term(); });
  const int spared =
      values_of(model.effects, beside_forms) - values_of(names.effects, beside_forms);
  if (spared < (with_forms ? std::max(1, least_spared) : least_spared)) return false;
  const auto own = fit_of(model, model.effects), other = fit_of(names, names.effects);
  const auto before = own->errors(std::vector<bool>(model.effects.size(), true)),
             after = other->errors(std::vector<bool>(names.effects.size(), true));
  const auto n = static_cast<double>(own->observations());
  const double loss = n * (std::pow(after.rms_um / before.rms_um, 2) - 1.0);
  if (loss > (with_forms ? 0.0 : kNothing + kByChance * spared + kNoLoss * n)) return false;
  names.remainder = remainder_of(names, names.effects, RemainderOf::kAll);
  if (structure_is_left(names) && !(loss < -kFarLess * n)) return false;
  take_over(model, names);
  return true;
}

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

void drop_impossible(PartModel& model) {
  for (bool again = true; again;) {
    again = false;
    const auto fit = fit_of(model, model.effects);
    for (std::size_t e = model.options.given.size(); e < model.effects.size() && !again; ++e) {
      if (is_possible(model.geometry, *fit, static_cast<int>(e))) continue;
      model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(e));
      model.discovery.chosen.erase(model.discovery.chosen.begin() + static_cast<std::ptrdiff_t>(e));
      again = true;
    }
  }
}

void drop_what_mends_a_shape(PartModel& model) {
  constexpr double kStandsOut =
      3.5;  // standard errors: less is never found alone among so many candidates
  constexpr double kMissed = 36.0;  // chi-square
  const auto shaped = [](const Effect& e) {
    return e.family->shape_is_continuous && !e.family->shape_is_step;
  };
  while (model.effects.size() > 1 &&
         std::any_of(model.effects.begin(), model.effects.end(), shaped)) {
    const auto kept = fit_of(model, model.effects);
    const PointFit& fit = *kept;
    const Eigen::MatrixXd covariance =
        shape_uncertainty(model.geometry, model.table, model.patches, fit).covariance;
    std::size_t least = model.effects.size();
    double least_square = kStandsOut * kStandsOut;
    for (std::size_t e = model.options.given.size(); e < model.effects.size(); ++e) {
      if (model.effects[e].family->local) continue;
      const int first = fit.first_column(static_cast<int>(e)), columns = model.effects[e].columns();
      const Eigen::VectorXd b = fit.coefficients().segment(first, columns);
      const Eigen::MatrixXd spread = covariance.block(first, first, columns, columns);
      const double square = b.dot(symmetric_solution(spread, b)) / columns;
      if (square >= least_square) continue;
      least_square = square;
      least = e;
    }
    if (least == model.effects.size()) return;
    const std::vector<Effect> with = model.effects;
    const ChosenGroup record = model.discovery.chosen[least];
    remove_effect(model, least);
    refine_shapes(model.geometry, model.table, model.patches, model.effects,
                  model.options.given.size());
    // Beside another shape its error is large though the two together say what neither says alone.
    if (fit_of(model, model.effects)->residual_square() - fit.residual_square() < kMissed) continue;
    model.effects = with;
    model.discovery.chosen.insert(
        model.discovery.chosen.begin() + static_cast<std::ptrdiff_t>(least), record);
    return;
  }
}

void drop_doubtful_names(PartModel& model) {
  constexpr double kSure = 0.002, kFar = 36.0;  // chi-square a column: six standard errors
  const auto drop = [&](std::size_t e) {
    model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(e));
    model.discovery.chosen.erase(model.discovery.chosen.begin() + static_cast<std::ptrdiff_t>(e));
  };
  if (std::none_of(model.effects.begin(), model.effects.end(), [](const Effect& e) {
        return e.is_term() && e.family->shapes && e.family->form_word.empty();
      }))
    return;
  for (std::size_t e = model.effects.size(); e-- > model.options.given.size();) {
    if (!model.effects[e].family->named || model.effects[e].family->local ||
        !(model.discovery.chosen[e].p_value > kSure / model.options.tables))
      continue;
    std::vector<Effect> without = model.effects;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
    const double loss =
        TrialFit(model.geometry, model.table, model.patches, without).residual_square() -
        TrialFit(model.geometry, model.table, model.patches, model.effects).residual_square();
    if (loss < kFar * model.effects[e].columns()) drop(e);
  }
}

void join_flanks(PartModel& model) {
  drop_idle_of_a_tooth(model);
  constexpr double kErrors = 3.0, kSameSize = 0.1;
  const auto same_size = [&](const PointFit& fit, std::size_t a, std::size_t b, double sign) {
    for (int k = 0; k < model.effects[a].columns(); ++k) {
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
  for (std::size_t a = model.options.given.size(); a < model.effects.size(); ++a)
    for (std::size_t b = a + 1; b < model.effects.size(); ++b) {
      const std::array<Effect, 2> before{model.effects[a], model.effects[b]};
      tell_as_two_flanks(model.effects[a], model.effects[b]);
      const EffectFamily* both = on_both_flanks(*model.effects[a].family);
      if (both == nullptr || !are_two_flanks_of_one(model.effects[a], model.effects[b])) continue;
      const auto fit = fit_of(model, model.effects);
      const bool aside = model.effects[a].family->flank_only && model.effects[a].family->local &&
                         model.effects[a].shape.size() == 1 && same_size(*fit, a, b, -1.0);
      const bool turned = model.effects[a].family == find_family("unnamed_step") &&
                          model.effects[a].shape[2] == 0.0 && same_size(*fit, a, b, -1.0);
      if (!aside && !turned && !same_size(*fit, a, b, 1.0)) {
        model.effects[a] = before[0];
        model.effects[b] = before[1];
        continue;
      }
      for (std::size_t k = 0; k < model.effects[a].shape.size(); ++k)
        model.effects[a].shape[k] = 0.5 * (model.effects[a].shape[k] + model.effects[b].shape[k]);
      model.effects[a].family = both;
      if (turned) model.effects[a].shape[2] = 1.0;
      if (aside)
        model.effects[a] = {
            find_family("unnamed_tooth_aside"), {}, {model.effects[a].shape[0], 1.0}};
      model.effects[a].flank = FlankChoice::kBoth;
      model.discovery.chosen[a].p_value =
          std::min(model.discovery.chosen[a].p_value, model.discovery.chosen[b].p_value);
      model.discovery.chosen[a].group = -1;
      model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(b));
      model.discovery.chosen.erase(model.discovery.chosen.begin() + static_cast<std::ptrdiff_t>(b));
      b = a;
    }
}

void tell_two_names_as_one(PartModel& model) {
  constexpr double kNothing = 9.0;  // chi-square
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  const bool shows_heights = is_told_apart(model, level, {});
  const auto over = [&](const Effect& effect) {
    Eigen::VectorXd field = over_a_tooth(model.geometry, effect);
    const Eigen::Index flank = field.size() / 2;
    for (const Eigen::Index first : {Eigen::Index{0}, flank})
      if (!shows_heights) field.segment(first, flank).array() -= field.segment(first, flank).mean();
    return field;
  };
  const auto one_in_place_of = [&](std::size_t a, std::size_t b) {
    const Eigen::VectorXd of_a = over(model.effects[a]), of_b = over(model.effects[b]);
    for (std::size_t c = 0; c < model.candidates.size(); ++c) {
      const Effect& third = model.candidates[c];
      if (model.unseen[c] || !is_name_of_all_teeth(third) || !third.shape.empty() ||
          !is_in_the_span(over(third), of_a, of_b))
        continue;
      std::vector<Effect> with = model.effects;
      with[a] = third;
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(b));
      const auto fit = fit_of(model, with);
      if (fit->residual_square() > fit_of(model, model.effects)->residual_square() + kNothing ||
          !is_possible(model.geometry, *fit, static_cast<int>(a)))
        continue;
      ChosenGroup record;
      record.group = -1;
      record.p_value =
          std::min(model.discovery.chosen[a].p_value, model.discovery.chosen[b].p_value);
      remove_effect(model, b);
      model.effects[a] = third;
      model.discovery.chosen[a] = record;
      std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
      return true;
    }
    return false;
  };
  for (std::size_t a = first_told_here(model); a < model.effects.size(); ++a)
    for (std::size_t b = a + 1; b < model.effects.size(); ++b)
      if (is_name_of_all_teeth(model.effects[a]) && is_name_of_all_teeth(model.effects[b]) &&
          model.effects[a].shape.empty() && model.effects[b].shape.empty() && one_in_place_of(a, b))
        b = a;
}

void tell_bows_with_a_level(PartModel& model) {
  constexpr double kNothing = 1.0, kAnything = 1e-3;  // chi-square; of the column
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect term = model.effects[e];
    if (term.family != level.family || term.columns() != 1 || term.shape[3] != 0.0 ||
        term.shape[0] + term.shape[1] != 2.0 || term.shape[0] == 1.0)
      continue;
    const bool named =
        std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& name) {
          return is_name_of_all_teeth(name) && name.shape.empty() && name.flank == term.flank &&
                 run_alike(model.geometry, name, term);
        });
    if (!named ||
        std::find(model.effects.begin(), model.effects.end(), level) != model.effects.end())
      continue;
    std::vector<Effect> with = model.effects;
    with[e] = level;
    const auto fit = fit_of(model, with);
    if (!(fit->retained(fit->first_column(static_cast<int>(e))) > kAnything) ||
        fit->residual_square() > fit_of(model, model.effects)->residual_square() + kNothing)
      continue;
    std::swap(model.effects, with);
    std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
  }
}

void drop_echoes_of_forms(PartModel& model) {
  constexpr double kSmall = 0.1, kNear = 0.01, kLittle = 49.0;  // chi-square: seven errors
  const auto place = [&](const Effect& e) {
    return e.shape[0] != 0.0 ? e.shape[1] / model.geometry.face_width_mm()
                             : model.geometry.roll_at_radius_mm(0.5 * e.shape[1]) /
                                   std::abs(model.geometry.tip_form_roll_mm() -
                                            model.geometry.root_form_roll_mm());
  };
  for (std::size_t e = model.effects.size(); e-- > first_told_here(model);) {
    const Effect& small = model.effects[e];
    const std::vector<std::string>& names = small.family->shape_names;
    if (!small.is_term() || names.size() < 2 || names[0] != "along" || names[1] != "place_mm")
      continue;
    const auto fit = fit_of(model, model.effects);
    for (std::size_t f = 0; f < model.effects.size(); ++f) {
      const Effect& large = model.effects[f];
      if (f == e || large.family != small.family || large.shape[0] != small.shape[0] ||
          std::abs(place(large) - place(small)) > kNear ||
          fit->effect_size_um(static_cast<int>(e)) >
              kSmall * fit->effect_size_um(static_cast<int>(f)))
        continue;
      std::vector<bool> with(model.effects.size(), true);
      with[e] = false;
      if (fit->residual_square(with) - fit->residual_square() > kLittle) continue;
      remove_effect(model, e);
      break;
    }
  }
}

void tell_teeth_of_one_flank(PartModel& model) {
  constexpr double kNothing = 9.0;  // chi-square
  const auto one_flank_of = [&](std::size_t aside, std::size_t out) {
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
      std::vector<Effect> with = model.effects;
      with[aside] = {find_family("unnamed_flank"), flank, {model.effects[aside].shape[0]}};
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(out));
      if (fit_of(model, with)->residual_square() >
          fit_of(model, model.effects)->residual_square() + kNothing)
        continue;
      model.effects[aside] = with[aside < out ? aside : aside - 1];
      std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
      remove_effect(model, out);
      return true;
    }
    return false;
  };
  for (std::size_t a = first_told_here(model); a < model.effects.size(); ++a) {
    if (model.effects[a].family != find_family("unnamed_tooth_aside")) continue;
    for (std::size_t b = first_told_here(model); b < model.effects.size(); ++b)
      if (model.effects[b].family->local && !model.effects[b].family->flank_only &&
          model.effects[b].shape.size() == 1 &&
          model.effects[b].shape[0] == model.effects[a].shape[0] && one_flank_of(a, b)) {
        a = b < a ? a - 1 : a;
        break;
      }
  }
}

void prefer_names(PartModel& model) {
  constexpr int kAnyNumber = -1000;
  const bool all_taken_back = model.vetoed && model.effects.size() == first_told_here(model);
  if (!all_taken_back && std::none_of(model.effects.begin(), model.effects.end(),
                                      [](const Effect& e) { return e.is_term(); }))
    return;
  PartOptions options = model.options;
  options.names_only = true;
  (void)adopt_if_simpler(model, std::move(options), all_taken_back ? kAnyNumber : 0);
}

void prefer_one_name_to_two(PartModel& model) {
  for (std::size_t a = 0; a < model.effects.size(); ++a)
    for (std::size_t b = a + 1; b < model.effects.size(); ++b) {
      if (!model.effects[a].family->named || !model.effects[b].family->named) continue;
      const std::vector<int>&of_a = model.discovery.chosen[a].confounded,
            &of_b = model.discovery.chosen[b].confounded;
      const bool third = std::any_of(of_a.begin(), of_a.end(), [&](int group) {
        return model.candidates[static_cast<std::size_t>(group)].family->named &&
               std::find(of_b.begin(), of_b.end(), group) != of_b.end();
      });
      if (!third) continue;
      PartOptions options = model.options;
      options.names_only = true;
      options.without.push_back(model.effects[a].family);
      if (adopt_if_simpler(model, std::move(options), 1)) return;
    }
}

void drop_names_that_may_be_nothing(PartModel& model) {
  constexpr double kChance = 0.05;
  for (bool again = true; again;) {
    again = false;
    const auto fit = fit_of(model, model.effects);
    double largest = kChance;
    std::size_t weakest = 0;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      const int first = fit->first_column(static_cast<int>(e)),
                columns = model.effects[e].columns();
      if (!model.effects[e].family->named || model.effects[e].family->local) continue;
      const Eigen::VectorXd b = fit->coefficients().segment(first, columns);
      const double square =
          b.dot(symmetric_solution(fit->covariance().block(first, first, columns, columns), b));
      const double p = f_tail(square / columns, columns, fit->degrees(first));
      if (!(p > largest)) continue;
      largest = p;
      weakest = e;
      again = true;
    }
    if (again) remove_effect(model, weakest);
  }
}

namespace {

/// Of an index alone, where every tooth is left with a place of its own: whether chance makes a
/// wave as large of so few teeth. (Once per turn is asked by itself, of other orders the largest.)
bool is_as_of_places_by_chance(const PartModel& model, std::size_t e,
                               const std::vector<float>& with_um,
                               const std::vector<float>& without_um, const WhatIsLeft& known) {
  constexpr double kLevel = 0.003;
  const Effect& wave = model.effects[e];
  if (!known.places.any || known.places.of_gaps ||
      !std::all_of(model.table->rows.begin(), model.table->rows.end(),
                   [](const Observation& row) { return row.kind == ObservationKind::kIndex; }))
    return false;
  double with = 0.0, without = 0.0;
  std::set<int> teeth;
  for (std::size_t i = 0; i < with_um.size(); ++i) {
    if (model.patches.patch_of_row[i] < 0) continue;
    with += std::pow(static_cast<double>(with_um[i]), 2);
    without += std::pow(static_cast<double>(without_um[i]), 2);
    teeth.insert(model.table->place(model.table->rows[i]).tooth);
  }
  double free = static_cast<double>(teeth.size()) - 1.0;
  for (const Effect& effect : model.effects) free -= effect.columns();
  if (!(free > 0.0)) return true;
  const bool once = wave.columns() == 2 && wave.order() <= 1.0;
  const double orders = once ? 1.0 : 0.5 * model.geometry.teeth(), columns = wave.columns();
  return orders * f_tail((without - with) / columns / (with / free), columns, free) > kLevel;
}

}  // namespace

void doubt_names_below_what_is_left(PartModel& model) {
  constexpr double kLess = 0.25, kShows = 0.01;  // of squares
  const std::size_t told = first_told_here(model);
  if (model.effects.size() == told) return;
  const PointFit fit(model.geometry, model.table, model.patches, model.effects);
  const auto after_um = fit.residuals_um();
  const WhatIsLeft known = what_is_left(model);
  std::map<ObservationKind, double> left, with;
  for (const auto& [kind, error] :
       errors_of_kinds(model.geometry, model.table, model.patches, *after_um, known)) {
    with[kind] = error.square / error.count;
    left[kind] = std::max(0.0, error.square - error.random_square) / error.count;
  }
  const bool sizes =
      std::any_of(model.table->rows.begin(), model.table->rows.end(),
                  [](const Observation& row) { return row.kind == ObservationKind::kSize; });
  for (std::size_t e = model.effects.size(); e-- > told;) {
    const EffectFamily& family = *model.effects[e].family;
    if (!family.named || family.local || (sizes && family.shows_in_sizes)) continue;
    std::vector<Effect> without = model.effects;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
    const auto bare_um =
        PointFit(model.geometry, model.table, model.patches, without).residuals_um();
    // What it takes out beside the others: two that undo each other take out nothing.
    std::map<ObservationKind, double> taken;
    double most = 0.0;
    for (const auto& [kind, error] :
         errors_of_kinds(model.geometry, model.table, model.patches, *bare_um, known)) {
      taken[kind] = error.square / error.count - with[kind];
      most = std::max(most, taken[kind]);
    }
    const bool stands = std::any_of(taken.begin(), taken.end(), [&](const auto& of_kind) {
      return of_kind.second > kShows * most && of_kind.second >= kLess * left[of_kind.first];
    });
    const bool slopes =
        family.tells_order_along_profile && model.table->points_mm.empty() &&
        is_wave_of_straight_traces(model.geometry, model.table, *bare_um, *after_um);
    const bool chance = is_as_of_places_by_chance(model, e, *after_um, *bare_um, known);
    if (stands && !slopes && !chance) continue;
    if (const EffectFamily* form = find_form(model.effects[e].family->form_word);
        form != nullptr && !slopes && !chance) {
      model.effects[e].family = form;
      continue;
    }
    model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(e));
    model.discovery.chosen.erase(model.discovery.chosen.begin() + static_cast<std::ptrdiff_t>(e));
    if (e < model.options.given.size()) {
      model.options.given.erase(model.options.given.begin() + static_cast<std::ptrdiff_t>(e));
      model.given_p_values.erase(model.given_p_values.begin() +
                                 static_cast<std::ptrdiff_t>(e - told));
    }
  }
}

bool drop_idle_forms(PartModel& model) {
  constexpr double kIdle = 25.0;  // chi-square: five standard errors
  bool any = false;
  while (!model.given_p_values.empty()) {
    const std::size_t first = first_told_here(model);
    const auto [idle, loss] =
        least_missed(model, first, model.options.given.size(), [](const Effect&) { return true; });
    if (loss > kIdle) return any;
    model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(idle));
    model.options.given.erase(model.options.given.begin() + static_cast<std::ptrdiff_t>(idle));
    model.given_p_values.erase(model.given_p_values.begin() +
                               static_cast<std::ptrdiff_t>(idle - first));
    any = true;
  }
  return any;
}

}  // namespace trueflank::loop
