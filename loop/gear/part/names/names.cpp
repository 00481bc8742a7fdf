// SPDX-License-Identifier: GPL-3.0-or-later
// Names of all teeth: those that the choice passed over, and the usual ones of those that say the
// same.
#include "trueflank/loop/gear/part/names/names.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {

void tell_one_flank_as_two_names_of_all(PartModel& model) {
  constexpr double kCrumb = 0.02;
  const auto is_plain = [](const Effect& e) { return is_name_of_all_teeth(e) && e.shape.empty(); };
  std::vector<std::size_t> whole;  // candidates
  for (std::size_t c = 0; c < model.candidates.size(); ++c)
    if (!model.unseen[c] && is_plain(model.candidates[c]) &&
        model.candidates[c].flank == FlankChoice::kBoth)
      whole.push_back(c);
  const auto two_in_place_of = [&](std::size_t a, std::size_t b) {
    const Eigen::VectorXd of_a = over_a_tooth(model.geometry, model.effects[a]),
                          of_b = over_a_tooth(model.geometry, model.effects[b]);
    std::vector<Effect> pair;
    for (const std::size_t c : whole)
      if (pair.size() < 2 &&
          is_in_the_span(over_a_tooth(model.geometry, model.candidates[c]), of_a, of_b))
        pair.push_back(model.candidates[c]);
    if (pair.size() < 2) return;
    const auto now = fit_of(model, model.effects);
    const auto amount = [&](std::size_t e) {
      return now->coefficients()[now->first_column(static_cast<int>(e))];
    };
    const Eigen::VectorXd sum = amount(a) * of_a + amount(b) * of_b;
    const Eigen::Index flank = sum.size() / 2;
    const auto [small, large] = std::minmax({sum.head(flank).norm(), sum.tail(flank).norm()});
    if (small < kCrumb * large) return;
    std::vector<Effect> with = model.effects;
    with[a] = pair[0];
    with[b] = pair[1];
    const auto fit = fit_of(model, with);
    for (const std::size_t e : {a, b})
      if (!is_possible(model.geometry, *fit, static_cast<int>(e))) return;
    ChosenGroup record;
    record.group = -1;
    record.p_value = std::max(model.discovery.chosen[a].p_value, model.discovery.chosen[b].p_value);
    model.effects = std::move(with);
    model.discovery.chosen[a] = model.discovery.chosen[b] = record;
  };
  for (std::size_t a = first_told_here(model); a < model.effects.size(); ++a)
    for (std::size_t b = a + 1; b < model.effects.size(); ++b)
      if (is_plain(model.effects[a]) && is_plain(model.effects[b]) &&
          (model.effects[a].flank != FlankChoice::kBoth ||
           model.effects[b].flank != FlankChoice::kBoth))
        two_in_place_of(a, b);
}

void tell_names_in_two_parts(PartModel& model) {
  constexpr double kNothing = 9.0, kIdle = 25.0;  // chi-square
  const auto are_parts = [&](const Effect& a, const Effect& b) {
    constexpr double kBetween = 1.0;  // teeth that both have, or neither
    const std::vector<std::string>& names = a.family->shape_names;
    if (!a.is_term() || a.family != b.family || a.flank != b.flank || names.size() < 2 ||
        names[0] != "first_tooth" || names[1] != "teeth" ||
        !std::equal(a.shape.begin() + 2, a.shape.end(), b.shape.begin() + 2, b.shape.end()))
      return false;
    const double z = model.geometry.teeth();
    return std::abs(a.shape[1] + b.shape[1] - z) <= kBetween &&
           std::abs(std::remainder(a.shape[0] + a.shape[1] - b.shape[0], z)) <= kBetween;
  };
  const auto name_in_place_of = [&](std::size_t a, std::size_t b) {
    const double now = fit_of(model, model.effects)->residual_square();
    for (std::size_t c = 0; c < model.candidates.size(); ++c) {
      const Effect& name = model.candidates[c];
      if (model.unseen[c] || !name.family->named || name.family->local || !name.shape.empty() ||
          name.columns() != model.effects[a].columns() || name.flank != model.effects[a].flank ||
          std::find(model.effects.begin(), model.effects.end(), name) != model.effects.end())
        continue;
      std::vector<Effect> with = model.effects;
      with[a] = name;
      const auto fit = fit_of(model, with);
      if (fit->residual_square() > now + kNothing ||
          !(fit->retained(fit->first_column(static_cast<int>(a))) >= kToldApart) ||
          !is_possible(model.geometry, *fit, static_cast<int>(a)))
        continue;
      const double both = fit->residual_square();
      model.effects = std::move(with);
      std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
      model.discovery.chosen[a].group = -1;
      with = model.effects;
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(b));
      if (fit_of(model, with)->residual_square() < both + kIdle) remove_effect(model, b);
      return true;
    }
    return false;
  };
  for (std::size_t a = first_told_here(model); a < model.effects.size(); ++a)
    for (std::size_t b = first_told_here(model); b < model.effects.size(); ++b)
      if (a != b && are_parts(model.effects[a], model.effects[b]) &&
          model.effects[a].shape[1] >= model.effects[b].shape[1] && name_in_place_of(a, b))
        break;
}

void drop_what_mends_another_way(PartModel& model) {
  constexpr double kNothing = 9.0;  // chi-square
  const auto is_wave = [](const Effect& e) {
    return e.family->named && !e.family->local && e.order() > 0.0;
  };
  const auto mends = [&](std::size_t lean, std::size_t wave) {
    for (const EffectShape& way : model.effects[lean].family->shapes(model.geometry)) {
      std::vector<Effect> with = model.effects;
      with[lean].shape = way;
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(wave));
      if (fit_of(model, with)->residual_square() >
          fit_of(model, model.effects)->residual_square() + kNothing)
        continue;
      model.effects[lean].shape = way;
      std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
      remove_effect(model, wave);
      return true;
    }
    return false;
  };
  for (std::size_t lean = first_told_here(model); lean < model.effects.size(); ++lean) {
    if (!model.effects[lean].family->is_one_of_its_shapes) continue;
    for (std::size_t wave = first_told_here(model); wave < model.effects.size(); ++wave)
      if (wave != lean && is_wave(model.effects[wave]) && mends(lean, wave)) {
        lean -= wave < lean ? 1 : 0;
        wave = model.effects.size();
      }
  }
}

void tell_the_usual_of_equals(PartModel& model) {
  constexpr double kEqual = 1.0;  // chi-square
  const auto is_usual_in_place_of = [&](int group, std::size_t e) {
    const Effect &name = model.candidates[static_cast<std::size_t>(group)],
                 &told = model.effects[e];
    if (model.unseen[static_cast<std::size_t>(group)] || !is_name_of_all_teeth(name) ||
        !name.shape.empty() || name.flank != told.flank || name.columns() != told.columns() ||
        preference_of(model, name) >= preference_of(model, told) ||
        std::find(model.effects.begin(), model.effects.end(), name) != model.effects.end())
      return false;
    std::vector<Effect> with = model.effects;
    with[e] = name;
    const auto fit = fit_of(model, with);
    return fit->residual_square() <= fit_of(model, model.effects)->residual_square() + kEqual &&
           fit->retained(fit->first_column(static_cast<int>(e))) >= kToldApart &&
           is_possible(model.geometry, *fit, static_cast<int>(e));
  };
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const int told = model.discovery.chosen[e].group;
    if (!model.effects[e].family->named || told < 0) continue;
    const std::vector<int>& like = model.discovery.chosen[e].confounded;
    const auto usual = std::find_if(like.begin(), like.end(),
                                    [&](int group) { return is_usual_in_place_of(group, e); });
    if (usual == like.end()) continue;
    const int name = *usual;
    model.effects[e] = model.candidates[static_cast<std::size_t>(name)];
    std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
    model.discovery.chosen[e].group = name;
    for (ChosenGroup& record : model.discovery.chosen)
      std::replace(record.confounded.begin(), record.confounded.end(), name, told);
  }
}

std::vector<Effect> with_best_name(const PartModel& model, double below, Names which) {
  constexpr double kTie = 0.01;  // chi-square: of names that say the same the usual one
  std::vector<Effect> names, best;
  for (std::size_t c = 0; c < model.candidates.size(); ++c) {
    const Effect& name = model.candidates[c];
    if (!model.unseen[c] && is_name_of_all_teeth(name) && name.shape.empty() &&
        (which == Names::kOfEitherToo || name.flank == FlankChoice::kBoth) &&
        std::find(model.effects.begin(), model.effects.end(), name) == model.effects.end())
      names.push_back(name);
  }
  std::stable_sort(names.begin(), names.end(), [&](const Effect& a, const Effect& b) {
    return preference_of(model, a) < preference_of(model, b);
  });
  for (const Effect& name : names) {
    std::vector<Effect> with = model.effects;
    with.push_back(name);
    const auto fit = fit_of(model, with);
    if (!(fit->residual_square() < below) ||
        !(fit->retained(fit->first_column(static_cast<int>(with.size()) - 1)) >= kToldApart) ||
        !is_possible(model.geometry, *fit, static_cast<int>(with.size()) - 1))
      continue;
    below = fit->residual_square() - kTie;
    best = std::move(with);
  }
  return best;
}

void add_name(PartModel& model, std::vector<Effect> with) {
  ChosenGroup record;
  record.group = -1;
  record.p_value = std::exp(-minus_log_chi_square_tail(
      fit_of(model, model.effects)->residual_square() - fit_of(model, with)->residual_square(), 1));
  model.effects = std::move(with);
  model.discovery.chosen.push_back(record);
}

void add_names(PartModel& model, int most_values) {
  constexpr double kClearly = 20.0;  // chi-square
  while (values_of(model.effects, true) < most_values) {
    const double now = fit_of(model, model.effects)->residual_square();
    std::vector<Effect> with = with_best_name(model, now - kClearly, Names::kOfBothFlanks);
    if (with.empty()) return;
    add_name(model, std::move(with));
  }
}

}  // namespace trueflank::loop
