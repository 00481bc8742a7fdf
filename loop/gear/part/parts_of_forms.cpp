// SPDX-License-Identifier: GPL-3.0-or-later
// Names that are parts of one form: they are told as a form, without a cause.
#include "trueflank/loop/gear/part/parts_of_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/fit/flank_courses.h"
#include "trueflank/loop/gear/part/fields.h"
#include "trueflank/loop/gear/part/forms_of_teeth.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/names/names.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/odd_forms.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/sectors.h"
#include "trueflank/loop/gear/part/single_teeth.h"
#include "trueflank/loop/gear/part/tidying.h"
#include "trueflank/loop/gear/part/waves.h"

namespace trueflank::loop {
namespace {

/// True where an effect lifts all flanks by nearly one amount (a scale, too, on few teeth).
bool is_level(const FlankGeometry& geometry, const PointFit& fit, std::size_t effect) {
  constexpr double kFlat = 0.5;
  const Effect& one = fit.effects()[effect];
  if (one.columns() != 1 || one.order() != 0.0 || one.family->local) return false;
  for (const bool face : {false, true})
    if (course_of(geometry, fit, effect, face).norm() >
        kFlat * values_along(geometry, fit, effect, face).norm())
      return false;
  return true;
}

/// What the forms without a name do slowly along the flanks, over the profile and over the face.
std::array<Eigen::VectorXd, 2> slow_forms(const FlankGeometry& geometry, const PointFit& fit) {
  constexpr double kSlow = 0.6;
  std::array<Eigen::VectorXd, 2> forms{Eigen::VectorXd::Zero(2 * kPlaces),
                                       Eigen::VectorXd::Zero(2 * kPlaces)};
  for (std::size_t e = 0; e < fit.effects().size(); ++e)
    for (const bool face : {false, true}) {
      if (!is_common_form(fit.effects()[e]) || moves_teeth_aside(fit.effects()[e])) continue;
      const Eigen::VectorXd course = course_of(geometry, fit, e, face), slow = slow_part(course);
      if (slow.squaredNorm() > kSlow * course.squaredNorm()) forms[face ? 1 : 0] += slow;
    }
  return forms;
}

/// A course on one flank and the names it is made of; two slopes are one.
struct NamedPart {
  Eigen::VectorXd course;
  std::vector<std::size_t> effects;
};

void add_part(std::vector<NamedPart>& parts, std::size_t effect, const Eigen::VectorXd& course) {
  constexpr double kSame = 0.98;
  for (NamedPart& part : parts) {
    const double norms = part.course.norm() * course.norm();
    if (std::abs(part.course.dot(course)) <= kSame * norms) continue;
    part.course += course;
    part.effects.push_back(effect);
    return;
  }
  parts.push_back({course, {effect}});
}

/// Names that together only imitate one odd form: two or more beside a slow form without a name, or
/// three or more that largely undo each other.
std::set<std::size_t> imitations(std::vector<NamedPart> parts, const Eigen::VectorXd& form) {
  constexpr double kCounts = 0.15, kBeside = 0.1, kUndo = 1.5;
  Eigen::VectorXd total = form;
  for (const NamedPart& part : parts) total += part.course;
  std::erase_if(
      parts, [&](const NamedPart& part) { return part.course.norm() <= kCounts * total.norm(); });
  double squares = 0.0;
  std::set<std::size_t> effects;
  for (const NamedPart& part : parts) {
    squares += part.course.squaredNorm();
    effects.insert(part.effects.begin(), part.effects.end());
  }
  const bool beside = parts.size() >= 2 && form.norm() > kBeside * total.norm();
  const bool undo = parts.size() >= 3 && squares > kUndo * total.squaredNorm();
  return beside || undo ? effects : std::set<std::size_t>();
}

/// Height of lobes that are sharper than a sine, told as one wave beside its multiples (ribs,
/// jaws): these have a mean; 0: there are none.
double sharp_lobes_um(const PointFit& fit) {
  double most_um = 0.0;
  for (std::size_t one = 0; one < fit.effects().size(); ++one) {
    const Effect& lowest = fit.effects()[one];
    if (!lowest.family->named || !is_wave_around(lowest)) continue;
    double sum_um = 0.0;
    int count = 0;
    for (std::size_t e = 0; e < fit.effects().size(); ++e) {
      const Effect& wave = fit.effects()[e];
      if (wave.family != lowest.family || std::remainder(wave.order(), lowest.order()) != 0.0)
        continue;
      sum_um += std::sqrt(2.0) * fit.effect_size_um(static_cast<int>(e));
      ++count;
    }
    if (count > 1) most_um = std::max(most_um, sum_um);
  }
  return most_um;
}

/// Height of waves along the flanks that are sharper than a sine, told as one beside a half or a
/// third of its length (flats of a hob): these have a mean; 0: there are none.
double sharp_waves_um(const PointFit& fit) {
  constexpr double kSameLength = 0.05;
  const EffectFamily* family = find_family("unnamed_waviness");
  double most_um = 0.0;
  for (const Effect& longest : fit.effects()) {
    if (longest.family != family) continue;
    double sum_um = 0.0;
    int count = 0;
    for (std::size_t e = 0; e < fit.effects().size(); ++e) {
      const Effect& wave = fit.effects()[e];
      if (wave.family != family || wave.flank != longest.flank || wave.shape[0] != longest.shape[0])
        continue;
      const double ratio = longest.shape[1] / wave.shape[1];
      if (ratio < 1.0 || std::abs(ratio - std::round(ratio)) > kSameLength) continue;
      sum_um += std::sqrt(2.0) * fit.effect_size_um(static_cast<int>(e));
      ++count;
    }
    if (count > 1) most_um = std::max(most_um, sum_um);
  }
  return most_um;
}

/// Size of every other tooth that stands out alike on both flanks; 0: there is none.
double comb_um(const PointFit& fit) {
  const EffectFamily* family = find_family("unnamed_alternation");
  double sum_um = 0.0;
  for (std::size_t e = 0; e < fit.effects().size(); ++e)
    if (fit.effects()[e].family == family && fit.effects()[e].shape[2] == 0.0)
      sum_um += fit.effect_size_um(static_cast<int>(e));
  return sum_um;
}

/// A slope or a bow beside slow forms without a name on the same flanks; a single tooth whose size
/// hangs on a form that differs from tooth to tooth.
void tell_parts_beside_forms(PartModel& model) {
  constexpr double kShare = 0.3, kHangs = 0.25;
  const auto is_form = [](const Effect& e) { return e.is_term() && e.family->form_word.empty(); };
  const auto differs = [&](const Effect& e) {
    return is_form(e) && !(e.family->same_on_every_tooth && e.family->same_on_every_tooth(e.shape));
  };
  std::vector<Effect> alike;
  for (const Effect& effect : model.effects)
    if (!differs(effect)) alike.push_back(effect);
  if (alike.empty() || std::none_of(model.effects.begin(), model.effects.end(), is_form)) return;
  const auto kept = fit_of(model, model.effects), kept_without = fit_of(model, alike);
  const PointFit &fit = *kept, &without = *kept_without;
  const std::array<Eigen::VectorXd, 2> forms = slow_forms(model.geometry, fit);
  int own = 0;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    if (differs(model.effects[e])) continue;
    const int at = own++;
    if (is_form(model.effects[e])) continue;
    const EffectFamily* form = form_instead(model, e);
    if (form == nullptr || is_wave_around(model.effects[e]) || is_level(model.geometry, fit, e) ||
        stands_beside_forms(model, fit, e))
      continue;
    bool part = false;
    if (model.effects[e].family->local) {
      const double b = fit.coefficients()[fit.first_column(static_cast<int>(e))];
      const double b0 = without.coefficients()[without.first_column(at)];
      part = std::abs(b - b0) > kHangs * std::max(std::abs(b), std::abs(b0));
    } else {
      for (const bool face : {false, true}) {
        const Eigen::VectorXd course = course_of(model.geometry, fit, e, face);
        if (!(course.norm() > 0.0)) continue;
        const Eigen::VectorXd beside = part_of_kind(forms[face ? 1 : 0], kind_of(course));
        double there = 0.0;  // forms on the flanks that the name is of
        for (const int flank : {0, 1})
          if (course.segment(flank * kPlaces, kPlaces).norm() > 1e-6 * course.norm())
            there += beside.segment(flank * kPlaces, kPlaces).squaredNorm();
        part = part || (std::sqrt(there) > kShare * course.norm() &&
                        !stands_beside_one_form(model, fit, e, face));
      }
    }
    if (part) model.effects[e].family = form;
  }
}

/// Beside teeth that are made otherwise from one on (a tool that broke) a slope or bow of all teeth
/// in the direction in which these differ, smaller than what they differ by, is what the form of
/// the sector leaves.
void tell_parts_of_a_sector(PartModel& model) {
  constexpr double kShare = 0.5;
  const auto is_sector = [](const Effect& e) {
    const std::vector<std::string>& names = e.family->shape_names;
    return e.is_term() && names.size() > 3 && names[0] == "first_tooth" && names[1] == "teeth";
  };
  if (std::none_of(model.effects.begin(), model.effects.end(), is_sector)) return;
  const auto fit = fit_of(model, model.effects);
  // What differs around the gear along what a name does: equal slopes are no part of opposite ones.
  const auto around_um = [&](const Eigen::VectorXd& course, bool face) {
    double sum_um = 0.0;
    for (std::size_t e = 0; e < model.effects.size(); ++e) {
      const Effect& effect = model.effects[e];
      const bool sector = is_sector(effect);
      if (!effect.is_term() || !(sector || is_wave_around(effect))) continue;
      const NeedsToBeSeen needs = effect.needs();
      const bool runs = sector ? effect.shape[face ? 3 : 2] > 0.0
                               : (face ? needs.along_face : needs.along_profile);
      if (runs && changes_along(model.geometry, *fit, e, course, face))
        sum_um = std::hypot(sum_um, fit->effect_size_um(static_cast<int>(e)));
    }
    return sum_um;
  };
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const EffectFamily* form = form_instead(model, e);
    if (form == nullptr || model.effects[e].family->local || is_wave_around(model.effects[e]))
      continue;
    for (const bool face : {false, true}) {
      const Eigen::VectorXd course = course_of(model.geometry, *fit, e, face);
      if (course.norm() > 0.0 &&
          kShare * fit->effect_size_um(static_cast<int>(e)) < around_um(course, face) &&
          !flank_that_shows(model, *fit, e, face)) {
        model.effects[e].family = form;
        break;
      }
    }
  }
}

/// Beside waves without a name that are ten times as large, a wave or a move of their order is what
/// these leave.
void tell_what_waves_leave(PartModel& model) {
  constexpr double kSmall = 0.1, kHighest = 2.0;
  if (model.effects.empty()) return;
  const auto fit = fit_of(model, model.effects);
  const auto order_of = [](const Effect& e) {
    return e.family->displacement_mm && e.columns() == 2 ? std::max(1.0, e.order()) : e.order();
  };
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const EffectFamily* form = form_instead(model, e);
    const double order = order_of(model.effects[e]);
    if (form == nullptr || !(order > 0.0) || order > kHighest) continue;
    double beside_um = 0.0;
    for (std::size_t other = 0; other < model.effects.size(); ++other)
      if (is_form_without_name(model.effects[other]) && model.effects[other].order() == order)
        beside_um = std::hypot(beside_um, fit->effect_size_um(static_cast<int>(other)));
    if (fit->effect_size_um(static_cast<int>(e)) < kSmall * beside_um)
      model.effects[e].family = form;
  }
}

void tell_imitations(PartModel& model) {
  if (model.effects.empty()) return;
  const auto fit = fit_of(model, model.effects);
  std::array<Eigen::VectorXd, 2> forms = slow_forms(model.geometry, *fit);
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (model.effects[e].family == find_form(model.effects[e].family->form_word) &&
        model.effects[e].order() == 0.0 &&
        model.effects[e].columns() == 1)  // told as a form already
      for (const bool face : {false, true})
        forms[face ? 1 : 0] += course_of(model.geometry, *fit, e, face);
  std::set<std::size_t> told;
  for (const bool face : {false, true}) {
    std::vector<std::pair<std::size_t, Eigen::VectorXd>> names;
    std::vector<std::optional<int>> shown_by;  // the flank to ask, where one shows it alone
    Eigen::VectorXd total = forms[face ? 1 : 0];
    for (std::size_t e = 0; e < model.effects.size(); ++e) {
      const Effect& effect = model.effects[e];
      if (form_instead(model, e) == nullptr || effect.family->local || effect.columns() != 1 ||
          stands_on_every_flank(model, *fit, e))
        continue;
      names.emplace_back(e, course_of(model.geometry, *fit, e, face));
      shown_by.push_back(flank_that_shows(model, *fit, e, face));
      total += names.back().second;
    }
    // What is equal on both flanks and what is opposite on them are two things, unless together
    // they leave one flank as it was designed.
    const std::vector<Kind> kinds = is_of_one_flank(total)
                                        ? std::vector<Kind>{Kind::kNeither}
                                        : std::vector<Kind>{Kind::kEqual, Kind::kOpposite};
    for (const Kind kind : kinds)
      for (const int flank : {0, 1}) {
        std::vector<NamedPart> parts;
        Eigen::VectorXd form = part_of_kind(forms[face ? 1 : 0], kind);
        for (std::size_t i = 0; i < names.size(); ++i) {
          const auto& [e, course] = names[i];
          if (shown_by[i] && *shown_by[i] != flank) continue;
          if (shown_by[i]) form.segment(flank * kPlaces, kPlaces).setZero();
          if (kind == Kind::kNeither || kind_of(course) == kind ||
              kind_of(course) == Kind::kNeither)
            add_part(parts, e, course.segment(flank * kPlaces, kPlaces));
        }
        told.merge(imitations(std::move(parts), form.segment(flank * kPlaces, kPlaces)));
      }
  }
  for (const std::size_t e : told) model.effects[e].family = form_instead(model, e);
}

/// So is what all flanks stand out by where its size hangs on forms along them: an odd form has a
/// mean of its own.
void tell_level_of_forms(PartModel& model) {
  constexpr double kHangs = 0.25, kOfLobes = 0.5;
  constexpr double kOfWaves = 1.5;  // arcs of a circle: 1.2
  constexpr double kOfComb = 1.3;   // every other tooth as designed: 1
  if (model.effects.empty()) return;
  const auto kept = fit_of(model, model.effects);
  const PointFit& fit = *kept;
  // A drift or another odd form around the gear, from its lowest tooth to its highest.
  bool drifts = false;
  double drift_um = 0.0;
  std::vector<Effect> named;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (!effect.is_term() || effect.order() != 0.0) named.push_back(effect);
    if (!effect.is_term()) continue;
    drifts = drifts || effect.family->is_drift ||
             (is_wave_around(effect) && !effect.family->form_word.empty());
    drift_um = std::hypot(drift_um, 2.0 * std::sqrt(3.0) * fit.effect_size_um(static_cast<int>(e)));
  }
  const double sharp_um = sharp_lobes_um(fit), waves_um = sharp_waves_um(fit);
  if (named.empty() || (!drifts && !(sharp_um > 0.0) && named.size() == model.effects.size()))
    return;
  const auto kept_without = fit_of(model, named);
  const PointFit& without = *kept_without;
  int own = 0;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    Effect& effect = model.effects[e];
    if (effect.is_term() && effect.order() == 0.0) continue;
    const int at = own++;
    const EffectFamily* form =
        effect.family->named && !effect.family->local ? form_of_level(model, e) : nullptr;
    if (form == nullptr || e < first_told_here(model)) continue;
    if (!is_level(model.geometry, fit, e)) continue;
    const double b = fit.coefficients()[fit.first_column(static_cast<int>(e))];
    const double b0 = without.coefficients()[without.first_column(at)];
    const auto is_shown = [&] { return is_shown_beside(model, e, {{0.0, 0.0, 0.0, 0.0}}); };
    const bool hangs = std::abs(b - b0) > kHangs * std::max(std::abs(b), std::abs(b0));
    const bool below = drifts && fit.effect_size_um(static_cast<int>(e)) < drift_um;
    if (((hangs || below) && !is_shown()) ||
        fit.effect_size_um(static_cast<int>(e)) <
            std::max({kOfLobes * sharp_um, kOfWaves * waves_um, kOfComb * comb_um(fit)}))
      effect.family = form;
  }
}

/// A groove or ridge whose middle lies at an end is what the flanks do towards that end.
void tell_bands_at_an_end(PartModel& model) {
  constexpr double kNothing = 9.0;  // chi-square
  constexpr double kNear = 1.0;     // of its half width
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& band = model.effects[e];
    if (band.family != find_family("unnamed_band")) continue;
    const double face = band.shape[0],
                 range_mm = std::abs(gear_effects::range_mm(model.geometry, face)),
                 share = gear_effects::share_at(model.geometry, face, band.shape[1]);
    if (std::min(share, 1.0 - share) * range_mm > kNear * band.shape[2]) continue;
    std::vector<Effect> forms = forms_along(model.geometry, face, band.flank, false);
    constexpr std::size_t kOpposite = 3;
    if (band.shape.size() > kOpposite)
      for (Effect& form : forms) form.shape.push_back(band.shape[kOpposite]);
    const std::vector<Effect> with = with_best_form(model, without(model.effects, {e}), forms, {});
    if (with.empty() || fit_of(model, with)->residual_square() >
                            fit_of(model, model.effects)->residual_square() + kNothing)
      continue;
    put_in_place_of(model, {e}, with);
    return tell_bands_at_an_end(model);
  }
}

}  // namespace

void tell_parts_of_a_form(PartModel& model) {
  drop_echoes_of_forms(model);
  tell_names_in_two_parts(model);
  tell_bows_with_a_level(model);
  tell_forms_of_some_teeth(model);
  tell_forms_of_teeth(model);
  tell_forms_of_sectors(model);
  tell_as_one_form(model);
  tell_bands_at_an_end(model);
  join_flanks(model);
  tell_parts_beside_forms(model);
  tell_parts_of_a_sector(model);
  tell_means_of_odd_forms(model);
  tell_means_of_one_wave(model);
  tell_parts_in_the_mean_of_waves(model);
  tell_imitations(model);
  tell_waves_of_a_form(model);
  tell_levels_of_bowed_waves(model);
  tell_ghosts_of_teeth(model);
  tell_what_waves_leave(model);
  tell_level_of_forms(model);
  tell_means_across_flanks(model);
  tell_teeth_side_by_side(model);
  tell_what_teeth_do_not_share(model);
  name_terms_beside_forms(model);
  name_forms_beside_names(model);
  tell_two_names_as_one(model);
  tell_one_flank_as_two_names_of_all(model);
  tell_teeth_of_one_flank(model);
  tell_one_tooth_or_gap(model);
}

const EffectFamily* form_instead(const PartModel& model, std::size_t e) {
  const EffectFamily& family = *model.effects[e].family;
  const bool free = e >= first_told_here(model);
  return free && family.named ? find_form(family.form_word) : nullptr;
}

const EffectFamily* form_of_level(const PartModel& model, std::size_t e) {
  const EffectFamily* own = find_form(model.effects[e].family->form_word);
  return own != nullptr || !model.effects[e].shape.empty() ? own : find_form("thickness");
}

bool is_shown_beside(const PartModel& model, std::size_t e, const std::vector<EffectShape>& terms) {
  constexpr double kHangs = 0.25, kAnything = 1e-4, kBeyondDoubt = 25.0;  // chi-square
  const auto now = fit_of(model, model.effects);
  if (!is_level(model.geometry, *now, e)) return false;
  std::vector<Effect> with;
  std::size_t at = 0;
  for (std::size_t other = 0; other < model.effects.size(); ++other) {
    if (other != e && model.effects[other].is_term() && model.effects[other].order() == 0.0)
      continue;
    if (other == e) at = with.size();
    with.push_back(model.effects[other]);
  }
  for (const EffectShape& shape : terms)
    with.push_back({find_family("unnamed"), FlankChoice::kBoth, shape});
  const auto beside = fit_of(model, with);
  const int column = beside->first_column(static_cast<int>(at));
  const double size = now->coefficients()[now->first_column(static_cast<int>(e))],
               kept = beside->coefficients()[column];
  return beside->retained(column) > kAnything &&
         kept * kept > kBeyondDoubt * beside->covariance()(column, column) &&
         std::abs(kept - size) <= kHangs * std::max(std::abs(kept), std::abs(size));
}

}  // namespace trueflank::loop
