// SPDX-License-Identifier: GPL-3.0-or-later
// Names of all teeth: those that the choice passed over, and the usual ones of those that say the
// same.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {

/// A slope of one flank beside another slope of either: where the smaller of the two flanks' is no
/// crumb, both kinds of slope of all flanks, a lean and a taper, are told. That is as many values
/// and the same sum, and causes that act on all flanks are the usual ones.
void PartLoop::tell_one_flank_as_two_names_of_all() {
  constexpr double kCrumb = 0.02;
  const auto is_plain = [](const Effect& e) { return is_name_of_all_teeth(e) && e.shape.empty(); };
  std::vector<std::size_t> whole;  // candidates
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (!unseen_[c] && is_plain(candidates_[c]) && candidates_[c].flank == FlankChoice::kBoth)
      whole.push_back(c);
  const auto two_in_place_of = [&](std::size_t a, std::size_t b) {
    const Eigen::VectorXd of_a = over_a_tooth(geometry_, effects_[a]),
                          of_b = over_a_tooth(geometry_, effects_[b]);
    std::vector<Effect> pair;
    for (const std::size_t c : whole)
      if (pair.size() < 2 && is_in_the_span(over_a_tooth(geometry_, candidates_[c]), of_a, of_b))
        pair.push_back(candidates_[c]);
    if (pair.size() < 2) return;
    const auto now = fit_of(effects_);
    const auto amount = [&](std::size_t e) {
      return now->coefficients()[now->first_column(static_cast<int>(e))];
    };
    const Eigen::VectorXd sum = amount(a) * of_a + amount(b) * of_b;
    const Eigen::Index flank = sum.size() / 2;
    const auto [small, large] = std::minmax({sum.head(flank).norm(), sum.tail(flank).norm()});
    if (small < kCrumb * large) return;
    std::vector<Effect> with = effects_;
    with[a] = pair[0];
    with[b] = pair[1];
    const auto fit = fit_of(with);
    for (const std::size_t e : {a, b})
      if (!is_possible(geometry_, *fit, static_cast<int>(e))) return;
    ChosenGroup record;
    record.group = -1;
    record.p_value = std::max(discovery_.chosen[a].p_value, discovery_.chosen[b].p_value);
    effects_ = std::move(with);
    discovery_.chosen[a] = discovery_.chosen[b] = record;
  };
  for (std::size_t a = first_told_here(); a < effects_.size(); ++a)
    for (std::size_t b = a + 1; b < effects_.size(); ++b)
      if (is_plain(effects_[a]) && is_plain(effects_[b]) &&
          (effects_[a].flank != FlankChoice::kBoth || effects_[b].flank != FlankChoice::kBoth))
        two_in_place_of(a, b);
}

/// Two forms without a name, each of teeth that the other leaves alone, and together as good as a
/// name: they are that name and one of them, the smaller, if that is anything beside it.
void PartLoop::tell_names_in_two_parts() {
  constexpr double kNothing = 9.0, kIdle = 25.0;  // chi-square
  const auto are_parts = [&](const Effect& a, const Effect& b) {
    constexpr double kBetween = 1.0;  // teeth that both have, or neither
    const std::vector<std::string>& names = a.family->shape_names;
    if (!a.is_term() || a.family != b.family || a.flank != b.flank || names.size() < 2 ||
        names[0] != "first_tooth" || names[1] != "teeth" ||
        !std::equal(a.shape.begin() + 2, a.shape.end(), b.shape.begin() + 2, b.shape.end()))
      return false;
    const double z = geometry_.teeth();
    return std::abs(a.shape[1] + b.shape[1] - z) <= kBetween &&
           std::abs(std::remainder(a.shape[0] + a.shape[1] - b.shape[0], z)) <= kBetween;
  };
  const auto name_in_place_of = [&](std::size_t a, std::size_t b) {
    const double now = fit_of(effects_)->residual_square();
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const Effect& name = candidates_[c];
      if (unseen_[c] || !name.family->named || name.family->local || !name.shape.empty() ||
          name.columns() != effects_[a].columns() || name.flank != effects_[a].flank ||
          std::find(effects_.begin(), effects_.end(), name) != effects_.end())
        continue;
      std::vector<Effect> with = effects_;
      with[a] = name;
      const auto fit = fit_of(with);
      if (fit->residual_square() > now + kNothing ||
          !(fit->retained(fit->first_column(static_cast<int>(a))) >= kToldApart) ||
          !is_possible(geometry_, *fit, static_cast<int>(a)))
        continue;
      const double both = fit->residual_square();
      effects_ = std::move(with);
      std::copy_n(effects_.begin(), options_.given.size(), options_.given.begin());
      discovery_.chosen[a].group = -1;
      with = effects_;
      with.erase(with.begin() + static_cast<std::ptrdiff_t>(b));
      if (fit_of(with)->residual_square() < both + kIdle) remove_effect(b);
      return true;
    }
    return false;
  };
  for (std::size_t a = first_told_here(); a < effects_.size(); ++a)
    for (std::size_t b = first_told_here(); b < effects_.size(); ++b)
      if (a != b && are_parts(effects_[a], effects_[b]) &&
          effects_[a].shape[1] >= effects_[b].shape[1] && name_in_place_of(a, b))
        break;
}

/// Names of all teeth that the choice passed over, as small beside the others as they are, where
/// each takes out clearly more than chance: up to so many values.
void PartLoop::add_names(int most_values) {
  constexpr double kClearly = 20.0;  // chi-square
  while (values_of(effects_, true) < most_values) {
    const double now = fit_of(effects_)->residual_square();
    std::vector<Effect> best;
    double least = now - kClearly;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const Effect& name = candidates_[c];
      if (unseen_[c] || !is_name_of_all_teeth(name) || !name.shape.empty() ||
          name.flank != FlankChoice::kBoth ||
          std::find(effects_.begin(), effects_.end(), name) != effects_.end())
        continue;
      std::vector<Effect> with = effects_;
      with.push_back(name);
      const auto fit = fit_of(with);
      if (!(fit->residual_square() < least) ||
          !(fit->retained(fit->first_column(static_cast<int>(with.size()) - 1)) >= kToldApart) ||
          !is_possible(geometry_, *fit, static_cast<int>(with.size()) - 1))
        continue;
      least = fit->residual_square();
      best = std::move(with);
    }
    if (best.empty()) return;
    ChosenGroup record;
    record.group = -1;
    record.p_value = std::exp(-minus_log_chi_square_tail(now - least, 1));
    effects_ = std::move(best);
    discovery_.chosen.push_back(record);
  }
}

}  // namespace trueflank::loop
