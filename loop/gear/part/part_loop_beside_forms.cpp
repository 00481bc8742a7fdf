// SPDX-License-Identifier: GPL-3.0-or-later
// Names that stand beside forms without one: what shows them by themselves.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/part/flank_courses.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/possible_effects.h"

namespace trueflank::loop {

/// The flank (0: left, 1: right) that shows a name of both flanks by itself, beyond doubt: the
/// forms without a name leave it alone, and the other flank, which they change, does not deny the
/// name.
std::optional<int> PartLoop::flank_that_shows(const PointFit& fit, std::size_t e, bool face) const {
  constexpr double kNearlyNothing = 0.1;
  constexpr double kBeyondDoubt = 25.0, kDenied = 25.0;  // chi-square
  const Effect& name = fit.effects()[e];
  if (name.flank != FlankChoice::kBoth || name.columns() != 1 || name.order() != 0.0) return {};
  const Eigen::VectorXd course = course_of(geometry_, fit, e, face);
  if (!(course.norm() > 0.0) || kind_of(course) == Kind::kNeither) return {};
  const std::array<double, 2> forms = forms_over_name(geometry_, fit, course, face);
  const int flank = forms[0] < forms[1] ? 0 : 1;
  if (!(forms[static_cast<std::size_t>(flank)] < kNearlyNothing)) return {};
  std::vector<Effect> split = fit.effects();
  split[e].flank = FlankChoice::kLeft;
  split.push_back(name);
  split.back().flank = FlankChoice::kRight;
  const auto kept = fit_of(split);
  const PointFit& by_flank = *kept;
  const int column =
      by_flank.first_column(flank == 0 ? static_cast<int>(e) : static_cast<int>(split.size()) - 1);
  const double size = by_flank.coefficients()[column];
  if (size * size < kBeyondDoubt * by_flank.covariance()(column, column) ||
      fit.residual_square() - by_flank.residual_square() > kDenied)
    return {};
  return flank;
}

/// Along most of every flank that a name runs over, the forms without a name are flat (a step, a
/// kink or a bulge stands elsewhere): there the name stands by itself. So it does beside rises and
/// bulges that have no part of its course: a bell mouth at both ends has no slope.
bool PartLoop::stands_on_every_flank(const PointFit& fit, std::size_t e) const {
  constexpr double kFlat = 0.1, kMost = 0.5, kMostOfIt = 0.8, kNoPart = 0.2;
  bool runs = false;
  for (const bool face : {false, true}) {
    const Eigen::VectorXd course = course_of(geometry_, fit, e, face);
    if (!(course.norm() > 0.0)) continue;
    const Eigen::VectorXd forms =
        part_of_kind(mean_of_forms(geometry_, fit, face), kind_of(course));
    const bool rises_alone = std::all_of(effects_.begin(), effects_.end(), [&](const Effect& form) {
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

/// So it does where one flank shows it alone, beside forms of the other.
bool PartLoop::stands_beside_forms(const PointFit& fit, std::size_t e) const {
  if (stands_on_every_flank(fit, e)) return true;
  bool runs = false;
  for (const bool face : {false, true}) {
    if (!(course_of(geometry_, fit, e, face).norm() > 0.0)) continue;
    runs = true;
    if (!flank_that_shows(fit, e, face)) return false;
  }
  return runs;
}

/// A slope or a bow stands by itself beside the one form that there is along its flanks where that
/// has no part of its course, as an S or a bow has no slope, and no form that bends, steps, rises
/// or comes in waves says both.
bool PartLoop::stands_beside_one_form(const PointFit& fit, std::size_t e, bool face) const {
  constexpr double kDenied = 25.0;                    // chi-square
  constexpr double kOnTheGrid = 0.5, kInPlace = 0.1;  // of what both take out
  constexpr double kNoPart = 0.2;
  const Effect& name = effects_[e];
  if (name.columns() != 1 || !name.shape.empty()) return false;
  const Eigen::VectorXd course = course_of(geometry_, fit, e, face);
  const Kind kind = kind_of(course);
  std::vector<Effect> rest;
  int count = 0;
  for (std::size_t f = 0; f < effects_.size(); ++f) {
    if (f == e) continue;
    const Eigen::VectorXd form = is_common_form(effects_[f]) && !differs_by_tooth(effects_[f])
                                     ? part_of_kind(course_of(geometry_, fit, f, face), kind)
                                     : Eigen::VectorXd::Zero(course.size());
    if (!(form.norm() > 0.0)) {
      rest.push_back(effects_[f]);
      continue;
    }
    if (++count > 1 || effects_[f].columns() != 1 || effects_[f].flank != name.flank ||
        std::abs(form.dot(course)) > kNoPart * form.norm() * course.norm())
      return false;
  }
  if (count != 1 || (kind == Kind::kNeither && name.flank == FlankChoice::kBoth)) return false;
  const double now = fit.residual_square(), none = fit_of(rest)->residual_square() - now;
  const MostLeft most{now + kOnTheGrid * none, now + kInPlace * none + kDenied};
  const auto says_both = [&](const std::vector<Effect>& beside, const std::vector<Effect>& forms) {
    const std::vector<Effect> with = with_best_form(beside, forms, most);
    return !with.empty() && !is_longer_than_the_flank(geometry_, with.back(), face) &&
           PointFit(geometry_, table_, patches_, with).residual_square() < now + kDenied;
  };
  const int along = face ? 1 : 0;
  std::vector<Effect> forms = forms_along(geometry_, along, name.flank, true);
  if (kind == Kind::kOpposite)
    for (Effect& form : forms) form.shape.push_back(1.0);
  for (Effect& step : steps_along(geometry_, along, name.flank)) {
    step.shape.back() = kind == Kind::kOpposite ? 1.0 : 0.0;
    forms.push_back(std::move(step));
  }
  std::stable_sort(forms.begin(), forms.end(),
                   [](const Effect& a, const Effect& b) { return a.family->id < b.family->id; });
  if (says_both(rest, forms)) return false;
  if (kind != Kind::kOpposite) return !says_both(rest, long_waves(geometry_, along, name.flank));
  const std::vector<Effect> waves = long_waves(geometry_, along, FlankChoice::kRight);
  return std::none_of(waves.begin(), waves.end(), [&](const Effect& wave) {
    std::vector<Effect> beside = rest;
    beside.push_back(wave);
    return says_both(beside, {{wave.family, FlankChoice::kLeft, wave.shape}});
  });
}

/// Names without a place that run along the profile (0) or the face (1), of either flank or alike
/// on both, or opposite on them, too; of those that run alike the one first that such data are told
/// by.
std::vector<Effect> PartLoop::names_along(int face, bool opposite_too) const {
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  std::vector<Effect> names;
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (candidates_[c].family->named && !unseen_[c] && candidates_[c].shape.empty() &&
        candidates_[c].columns() == 1 &&
        runs_of(geometry_, candidates_[c], opposite_too ? Flanks::kOfEither : Flanks::kAlike) ==
            runs)
      names.push_back(candidates_[c]);
  std::stable_sort(names.begin(), names.end(), [this](const Effect& a, const Effect& b) {
    return preference_of(a) < preference_of(b);
  });
  return names;
}

/// Of names that run alike, the one with the lowest is what such data are told by.
int PartLoop::preference_of(const Effect& name) const {
  return name.family->preference + (table_->points_mm.empty() ? name.family->penalty_of_traces : 0);
}

/// A kink beside a slope says the same bent to either side: it runs over the part that is clearly
/// the shorter one, so that the slope is that of the longer one.
void PartLoop::turn_kinks_beside_slopes() {
  constexpr double kClearly = 0.1;
  const EffectFamily* kinks = find_family("unnamed_kink");
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    Effect& kink = effects_[e];
    if (kink.family != kinks || kink.shape[2] == 0.0) continue;
    const Runs runs = kink.shape[0] != 0.0 ? Runs::kOverFace : Runs::kOverProfile;
    const bool beside_slope =
        std::any_of(effects_.begin(), effects_.end(), [&](const Effect& other) {
          return &other != &kink &&
                 (other.flank == kink.flank || other.flank == FlankChoice::kBoth) &&
                 is_straight(geometry_, other) && runs_of(geometry_, other) == runs;
        });
    if (!beside_slope) continue;
    const double low = kink.shape[0] != 0.0 ? 0.0 : geometry_.root_form_roll_mm(),
                 high = kink.shape[0] != 0.0 ? geometry_.face_width_mm()
                                             : geometry_.tip_form_roll_mm(),
                 at = kink.shape[0] != 0.0 ? kink.shape[1]
                                           : geometry_.roll_at_radius_mm(0.5 * kink.shape[1]);
    const double share = (at - low) / (high - low);
    if (std::abs(share - 0.5) > kClearly) kink.shape[2] = share < 0.5 ? -1.0 : 1.0;
  }
}

/// A form with a place whose whole course a name follows as well: a step that was all that could be
/// seen of a slope beside a wave not yet understood, or a curve towards the tip beside a slope,
/// which is a relief.
void PartLoop::name_forms_beside_names() {
  constexpr double kNoWorse = 1.0;  // chi-square
  bool named = false;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    const Effect form = effects_[e];
    const bool is_step = form.family == find_family("unnamed_step");
    if (!form.is_term() || form.columns() != 1 || !(form.family->is_like_many || is_step)) continue;
    const double as_form = fit_of(effects_)->residual_square();
    const Runs runs = runs_of(geometry_, form, Flanks::kOfEither);
    std::vector<Effect> without_place, with_place;
    for (const int face : {0, 1})
      if (runs == (face == 0 ? Runs::kOverProfile : Runs::kOverFace))
        without_place = names_along(face, true);
    std::erase_if(without_place, [&](const Effect& name) { return name.flank != form.flank; });
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const EffectFamily& family = *candidates_[c].family;
      if (!is_step && family.named && family.shape_is_continuous && !family.shape_is_step &&
          !unseen_[c] && candidates_[c].shape.size() == 1 && candidates_[c].flank == form.flank &&
          runs_of(geometry_, candidates_[c]) == runs_of(geometry_, form))
        with_place.push_back(candidates_[c]);
    }
    std::vector<Effect> rest = effects_;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(e));
    for (const std::vector<Effect>& names : {without_place, with_place}) {
      if (names.empty()) continue;
      std::vector<Effect> with = with_best_form(rest, names, {});
      if (with.empty()) continue;
      // Where it stood: what was given stays in front.
      std::rotate(with.begin() + static_cast<std::ptrdiff_t>(e), with.end() - 1, with.end());
      const auto fit = fit_of(with);
      if (fit->residual_square() > as_form + kNoWorse ||
          !is_possible(geometry_, *fit, static_cast<int>(e)))
        continue;
      std::swap(effects_, with);
      if (stands_beside_forms(*fit, e)) {
        named = true;
        break;
      }
      std::swap(effects_, with);
    }
  }
  if (named) join_flanks();
}

/// A slope or a bow that stands beside forms which leave most of the flank alone, or run the other
/// way, gets its name where the data do not deny it.
void PartLoop::name_terms_beside_forms() {
  constexpr double kDenied = 9.0;  // chi-square
  turn_kinks_beside_slopes();
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    const Effect term = effects_[e];
    if (term.family->named || !term.family->form_word.empty() || term.columns() != 1) continue;
    const Effect* likeliest = nullptr;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const Effect& name = candidates_[c];
      if (name.family->named && !unseen_[c] && name.flank == term.flank && name.shape.empty() &&
          run_alike(geometry_, name, term) &&
          (likeliest == nullptr || preference_of(name) < preference_of(*likeliest)))
        likeliest = &name;
    }
    if (likeliest == nullptr) continue;
    const double as_term = fit_of(effects_)->residual_square();
    effects_[e] = *likeliest;
    const auto fit = fit_of(effects_);
    if (fit->residual_square() > as_term + kDenied || !stands_beside_forms(*fit, e) ||
        !is_possible(geometry_, *fit, static_cast<int>(e)))
      effects_[e] = term;
  }
}

}  // namespace trueflank::loop
