// SPDX-License-Identifier: GPL-3.0-or-later
// Names that stand beside forms without one: what shows them by themselves.
#include "trueflank/loop/gear/part/names/names_beside_forms.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/fit/flank_courses.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/tidying.h"
#include "trueflank/loop/gear/possible_effects.h"

namespace trueflank::loop {
namespace {

/// A kink beside a slope says the same bent to either side: it runs over the part that is clearly
/// the shorter one, so that the slope is that of the longer one.
void turn_kinks_beside_slopes(PartModel& model) {
  constexpr double kClearly = 0.1;
  const EffectFamily* kinks = find_family("unnamed_kink");
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    Effect& kink = model.effects[e];
    if (kink.family != kinks || std::abs(kink.shape[2]) != 1.0) continue;
    const Runs runs = kink.shape[0] != 0.0 ? Runs::kOverFace : Runs::kOverProfile;
    const bool beside_slope =
        std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& other) {
          return &other != &kink &&
                 (other.flank == kink.flank || other.flank == FlankChoice::kBoth) &&
                 is_straight(model.geometry, other) && runs_of(model.geometry, other) == runs;
        });
    if (!beside_slope) continue;
    const double low = kink.shape[0] != 0.0 ? 0.0 : model.geometry.root_form_roll_mm(),
                 high = kink.shape[0] != 0.0 ? model.geometry.face_width_mm()
                                             : model.geometry.tip_form_roll_mm(),
                 at = kink.shape[0] != 0.0 ? kink.shape[1]
                                           : model.geometry.roll_at_radius_mm(0.5 * kink.shape[1]);
    const double share = (at - low) / (high - low);
    if (std::abs(share - 0.5) > kClearly) kink.shape[2] = share < 0.5 ? -1.0 : 1.0;
  }
}

}  // namespace

std::optional<int> flank_that_shows(const PartModel& model, const PointFit& fit, std::size_t e,
                                    bool face) {
  constexpr double kNearlyNothing = 0.1;
  constexpr double kBeyondDoubt = 25.0, kDenied = 25.0;  // chi-square
  const Effect& name = fit.effects()[e];
  if (name.flank != FlankChoice::kBoth || name.columns() != 1 || name.order() != 0.0) return {};
  const Eigen::VectorXd course = course_of(model.geometry, fit, e, face);
  if (!(course.norm() > 0.0) || kind_of(course) == Kind::kNeither) return {};
  const std::array<double, 2> forms = forms_over_name(model.geometry, fit, course, face);
  const int flank = forms[0] < forms[1] ? 0 : 1;
  if (!(forms[static_cast<std::size_t>(flank)] < kNearlyNothing)) return {};
  std::vector<Effect> split = fit.effects();
  split[e].flank = FlankChoice::kLeft;
  split.push_back(name);
  split.back().flank = FlankChoice::kRight;
  const auto kept = fit_of(model, split);
  const PointFit& by_flank = *kept;
  const int column =
      by_flank.first_column(flank == 0 ? static_cast<int>(e) : static_cast<int>(split.size()) - 1);
  const double size = by_flank.coefficients()[column];
  if (size * size < kBeyondDoubt * by_flank.covariance()(column, column) ||
      fit.residual_square() - by_flank.residual_square() > kDenied)
    return {};
  return flank;
}

bool stands_on_every_flank(const PartModel& model, const PointFit& fit, std::size_t e) {
  constexpr double kFlat = 0.1, kMost = 0.5, kMostOfIt = 0.8, kNoPart = 0.2;
  bool runs = false;
  for (const bool face : {false, true}) {
    const Eigen::VectorXd course = course_of(model.geometry, fit, e, face);
    if (!(course.norm() > 0.0)) continue;
    const Eigen::VectorXd forms =
        part_of_kind(mean_of_forms(model.geometry, fit, face), kind_of(course));
    const bool rises_alone =
        std::all_of(model.effects.begin(), model.effects.end(), [&](const Effect& form) {
          const NeedsToBeSeen needs = form.needs();
          return !is_common_form(form) || !(face ? needs.along_face : needs.along_profile) ||
                 form.family == find_family("unnamed_rise") ||
                 form.family == find_family("unnamed_band");
        });
    for (const int flank : {0, 1}) {
      const auto own = course.segment(flank * kPlaces, kPlaces);
      if (!(own.norm() > 1e-6 * course.norm())) continue;
      runs = true;
      const double step = (own.maxCoeff() - own.minCoeff()) / (kPlaces - 1);
      int flat = 0;
      double there = 0.0, all = 0.0;  // squares of the name's own steps
      for (int i = flank * kPlaces; i + 1 < (flank + 1) * kPlaces; ++i) {
        const double own_step = course[i + 1] - course[i];
        const bool is_flat = std::abs(forms[i + 1] - forms[i]) < kFlat * step;
        flat += is_flat ? 1 : 0;
        there += is_flat ? own_step * own_step : 0.0;
        all += own_step * own_step;
      }
      if (flat >= kMost * (kPlaces - 1) || there > kMostOfIt * all) continue;
      const auto beside = forms.segment(flank * kPlaces, kPlaces);
      const double both = (beside.array() - beside.mean()).matrix().dot(own);
      const double norms = (beside.array() - beside.mean()).matrix().norm() * own.norm();
      if (!rises_alone || std::abs(both) > kNoPart * norms) return false;
    }
  }
  return runs;
}

bool stands_beside_forms(const PartModel& model, const PointFit& fit, std::size_t e) {
  if (stands_on_every_flank(model, fit, e)) return true;
  bool runs = false;
  for (const bool face : {false, true}) {
    if (!(course_of(model.geometry, fit, e, face).norm() > 0.0)) continue;
    runs = true;
    if (!flank_that_shows(model, fit, e, face)) return false;
  }
  return runs;
}

bool stands_beside_one_form(const PartModel& model, const PointFit& fit, std::size_t e, bool face) {
  constexpr double kDenied = 25.0;                    // chi-square
  constexpr double kOnTheGrid = 0.5, kInPlace = 0.1;  // of what both take out
  constexpr double kNoPart = 0.2;
  const Effect& name = model.effects[e];
  if (name.columns() != 1 || !name.shape.empty()) return false;
  const Eigen::VectorXd course = course_of(model.geometry, fit, e, face);
  const Kind kind = kind_of(course);
  std::vector<Effect> rest;
  int count = 0;
  for (std::size_t f = 0; f < model.effects.size(); ++f) {
    if (f == e) continue;
    const Eigen::VectorXd form =
        is_common_form(model.effects[f]) && !differs_by_tooth(model.effects[f])
            ? part_of_kind(course_of(model.geometry, fit, f, face), kind)
            : Eigen::VectorXd::Zero(course.size());
    if (!(form.norm() > 0.0)) {
      rest.push_back(model.effects[f]);
      continue;
    }
    if (++count > 1 || model.effects[f].columns() != 1 || model.effects[f].flank != name.flank ||
        std::abs(form.dot(course)) > kNoPart * form.norm() * course.norm())
      return false;
  }
  if (count != 1 || (kind == Kind::kNeither && name.flank == FlankChoice::kBoth)) return false;
  const double now = fit.residual_square(), none = fit_of(model, rest)->residual_square() - now;
  const MostLeft most{now + kOnTheGrid * none, now + kInPlace * none + kDenied};
  const auto says_both = [&](const std::vector<Effect>& beside, const std::vector<Effect>& forms) {
    const std::vector<Effect> with = with_best_form(model, beside, forms, most);
    return !with.empty() && !is_longer_than_the_flank(model.geometry, with.back(), face) &&
           PointFit(model.geometry, model.table, model.patches, with).residual_square() <
               now + kDenied;
  };
  const int along = face ? 1 : 0;
  std::vector<Effect> forms = forms_along(model.geometry, along, name.flank, true);
  if (kind == Kind::kOpposite)
    for (Effect& form : forms) form.shape.push_back(1.0);
  for (Effect& step : steps_along(model.geometry, along, name.flank)) {
    step.shape.back() = kind == Kind::kOpposite ? 1.0 : 0.0;
    forms.push_back(std::move(step));
  }
  std::stable_sort(forms.begin(), forms.end(),
                   [](const Effect& a, const Effect& b) { return a.family->id < b.family->id; });
  if (says_both(rest, forms)) return false;
  if (kind != Kind::kOpposite)
    return !says_both(rest, long_waves(model.geometry, along, name.flank));
  const std::vector<Effect> waves = long_waves(model.geometry, along, FlankChoice::kRight);
  return std::none_of(waves.begin(), waves.end(), [&](const Effect& wave) {
    std::vector<Effect> beside = rest;
    beside.push_back(wave);
    return says_both(beside, {{wave.family, FlankChoice::kLeft, wave.shape}});
  });
}

std::vector<Effect> names_along(const PartModel& model, int face, bool opposite_too) {
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  std::vector<Effect> names;
  for (std::size_t c = 0; c < model.candidates.size(); ++c)
    if (model.candidates[c].family->named && !model.unseen[c] &&
        model.candidates[c].shape.empty() && model.candidates[c].columns() == 1 &&
        runs_of(model.geometry, model.candidates[c],
                opposite_too ? Flanks::kOfEither : Flanks::kAlike) == runs)
      names.push_back(model.candidates[c]);
  std::stable_sort(names.begin(), names.end(), [&model](const Effect& a, const Effect& b) {
    return preference_of(model, a) < preference_of(model, b);
  });
  return names;
}

int preference_of(const PartModel& model, const Effect& name) {
  return name.family->preference +
         (model.table->points_mm.empty() ? name.family->penalty_of_traces : 0);
}

void name_forms_beside_names(PartModel& model) {
  constexpr double kNoWorse = 1.0;  // chi-square
  bool named = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect form = model.effects[e];
    const bool is_step = form.family == find_family("unnamed_step");
    if (!form.is_term() || form.columns() != 1 || !(form.family->is_like_many || is_step)) continue;
    const double as_form = fit_of(model, model.effects)->residual_square();
    const Runs runs = runs_of(model.geometry, form, Flanks::kOfEither);
    std::vector<Effect> without_place, with_place;
    for (const int face : {0, 1})
      if (runs == (face == 0 ? Runs::kOverProfile : Runs::kOverFace))
        without_place = names_along(model, face, true);
    std::erase_if(without_place, [&](const Effect& name) { return name.flank != form.flank; });
    for (std::size_t c = 0; c < model.candidates.size(); ++c) {
      const EffectFamily& family = *model.candidates[c].family;
      if (!is_step && family.named && family.shape_is_continuous && !family.shape_is_step &&
          !model.unseen[c] && model.candidates[c].shape.size() == 1 &&
          model.candidates[c].flank == form.flank &&
          runs_of(model.geometry, model.candidates[c]) == runs_of(model.geometry, form))
        with_place.push_back(model.candidates[c]);
    }
    std::vector<Effect> rest = model.effects;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(e));
    for (const std::vector<Effect>& names : {without_place, with_place}) {
      if (names.empty()) continue;
      std::vector<Effect> with = with_best_form(model, rest, names, {});
      if (with.empty()) continue;
      // Where it stood: what was given stays in front.
      std::rotate(with.begin() + static_cast<std::ptrdiff_t>(e), with.end() - 1, with.end());
      const auto fit = fit_of(model, with);
      if (fit->residual_square() > as_form + kNoWorse ||
          !is_possible(model.geometry, *fit, static_cast<int>(e)))
        continue;
      std::swap(model.effects, with);
      if (stands_beside_forms(model, *fit, e)) {
        named = true;
        break;
      }
      std::swap(model.effects, with);
    }
  }
  if (named) join_flanks(model);
}

void name_terms_beside_forms(PartModel& model) {
  constexpr double kDenied = 9.0;  // chi-square
  turn_kinks_beside_slopes(model);
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect term = model.effects[e];
    if (term.family->named || !term.family->form_word.empty() || term.columns() != 1) continue;
    const Effect* likeliest = nullptr;
    for (std::size_t c = 0; c < model.candidates.size(); ++c) {
      const Effect& name = model.candidates[c];
      if (name.family->named && !model.unseen[c] && name.flank == term.flank &&
          name.shape.empty() && run_alike(model.geometry, name, term) &&
          (likeliest == nullptr || preference_of(model, name) < preference_of(model, *likeliest)))
        likeliest = &name;
    }
    if (likeliest == nullptr) continue;
    const double as_term = fit_of(model, model.effects)->residual_square();
    model.effects[e] = *likeliest;
    const auto fit = fit_of(model, model.effects);
    if (fit->residual_square() > as_term + kDenied || !stands_beside_forms(model, *fit, e) ||
        !is_possible(model.geometry, *fit, static_cast<int>(e)))
      model.effects[e] = term;
  }
}

std::vector<std::vector<std::vector<Effect>>> names_with_a_place(
    const PartModel& model, const std::vector<Effect>& straight) {
  std::vector<std::vector<std::vector<Effect>>> kinds;
  std::vector<Effect> slopes = straight;
  std::erase_if(slopes, [&](const Effect& name) { return !is_straight(model.geometry, name); });
  std::vector<const EffectFamily*> known;
  for (std::size_t c = 0; c < model.candidates.size(); ++c) {
    const Effect& name = model.candidates[c];
    const EffectFamily& family = *name.family;
    if (!family.named || !family.shape_is_continuous || name.flank != FlankChoice::kBoth ||
        model.unseen[c] || std::find(known.begin(), known.end(), &family) != known.end() ||
        runs_of(model.geometry, name) != Runs::kOverProfile)
      continue;
    known.push_back(&family);
    std::vector<std::vector<Effect>> alone, with_slope;
    for (const EffectShape& shape : family.shapes(model.geometry)) {
      alone.push_back({{&family, name.flank, shape}});
      with_slope.push_back(slopes);
      with_slope.back().push_back(alone.back().front());
    }
    kinds.push_back(std::move(alone));
    if (!slopes.empty()) kinds.push_back(std::move(with_slope));
  }
  return kinds;
}

bool tell_as_form_for_a_name(PartModel& model) {
  constexpr double kClearly = 18.0;  // chi-square, of one value more
  constexpr double kShare = 0.02;    // of what the name takes out: it is another form
  constexpr int kMore = 1;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect name = model.effects[e];
    if (!name.family->named || values_of({name}, true) != 1) continue;
    const Runs runs = runs_of(model.geometry, name);
    if (runs != Runs::kOverProfile && runs != Runs::kOverFace) continue;
    const double face = runs == Runs::kOverFace ? 1.0 : 0.0;
    const std::vector<Effect> with =
        one_form_for(model, {e}, forms_along(model.geometry, face, name.flank, false), {}, kMore);
    if (with.empty()) continue;
    std::vector<Effect> without = model.effects;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
    const double now = fit_of(model, model.effects)->residual_square();
    const double gain = now - fit_of(model, with)->residual_square();
    const double of_name = fit_of(model, without)->residual_square() - now;
    if (gain < std::max(kClearly, kShare * of_name)) continue;
    put_in_place_of(model, {e}, with);
    return true;
  }
  return false;
}

}  // namespace trueflank::loop
