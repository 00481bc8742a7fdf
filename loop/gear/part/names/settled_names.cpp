// SPDX-License-Identifier: GPL-3.0-or-later
// Names that the answer shows as it is in the end, though the forms beside them changed on the way.
#include "trueflank/loop/gear/part/names/settled_names.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/fit/flank_courses.h"
#include "trueflank/loop/gear/fit/flank_fields.h"
#include "trueflank/loop/gear/part/names/names.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/random_error.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

/// True of a form that follows others piece by piece: a polynomial of a higher degree or around the
/// gear, one of several oblique waves, what is longer than the flank.
bool is_a_piece(const FlankGeometry& geometry, const Effect& form) {
  constexpr double kMostDegree = 2.0;
  if (form.family == find_family("unnamed_marks")) return true;
  if (form.family == find_family("unnamed"))
    return form.order() > 0.0 || form.shape[0] + form.shape[1] > kMostDegree;
  return is_longer_than_the_flank(geometry, form, form.needs().along_face);
}

/// True where the forms beside a name of all teeth are few, each a thing of its own, and no more
/// than a part of it hangs on them.
bool stands_among_few_forms(const FlankGeometry& geometry, const PointFit& fit, std::size_t e,
                            bool shows_heights) {
  constexpr double kPart = 0.1, kUndone = 0.5, kSameCourse = 0.95;
  constexpr int kMostForms = 2;
  FlankField own = field_of(geometry, fit, e);
  const double all = own.norm();
  FlankField bent = own;
  take_off_heights(bent);
  const double most = shows_heights ? 0.5 : 1e-6;
  const bool level = bent.norm() < most * all;
  if (!level) own = bent;
  const Eigen::VectorXd name = own.col(0);
  FlankField forms = FlankField::Zero(own.rows(), own.cols());
  const Runs runs = runs_of(geometry, fit.effects()[e], Flanks::kOfEither);
  double undone = 0.0;
  int count = 0, waves = 0;
  for (std::size_t f = 0; f < fit.effects().size(); ++f) {
    const Effect& form = fit.effects()[f];
    if (f == e || !form.is_term()) continue;
    // All other teeth of a scan show the name without what one of them has.
    if (shows_heights && form.family->is_of_one_tooth) continue;
    // A bow without a name beside a slope: one curve may be both.
    if (form.family == find_family("unnamed") && form.order() == 0.0 &&
        form.shape[0] + form.shape[1] > 1.0 && runs_of(geometry, form, Flanks::kOfEither) == runs)
      return false;
    // Sharp waves, and combs, lift the flanks.
    waves += form.order() == 0.0 && form.columns() == 2 ? 1 : 0;
    if (level && (waves > 1 || form.family == find_family("unnamed_alternation"))) return false;
    FlankField field = field_of(geometry, fit, f);
    if (form.order() == 0.0 && form.columns() == 1) forms += field;
    if (!level) take_off_heights(field);
    const Eigen::VectorXd shares = field.transpose() * name / name.squaredNorm();
    undone -= shares.mean();
    if (shares.cwiseAbs().maxCoeff() < kPart) continue;
    if (is_a_piece(geometry, form) || ++count > kMostForms) return false;
    // Of a form that differs from tooth to tooth along the same course it may be the mean.
    if (shares.maxCoeff() - shares.minCoeff() < kPart) continue;
    for (Eigen::Index tooth = 0; tooth < field.cols(); ++tooth)
      if (std::abs(shares[tooth]) * name.norm() > kSameCourse * field.col(tooth).norm())
        return false;
  }
  return undone < kUndone &&
         !is_mean_across(mean_of_flanks(field_of(geometry, fit, e)), mean_of_flanks(forms));
}

/// True where an effect stands far above its error, the places and widths of the forms beside it
/// free, and takes out far more than is left.
bool is_beyond_doubt(const PartModel& model, const PointFit& fit, std::size_t e) {
  constexpr double kErrors = 6.0, kLeft = 0.1;
  const Effect& effect = fit.effects()[e];
  const Eigen::MatrixXd covariance =
      shape_uncertainty(model.geometry, model.table, model.patches, fit, FreeShapes::kAll)
          .covariance;
  const int first = fit.first_column(static_cast<int>(e));
  const double size = fit.coefficients().segment(first, effect.columns()).norm();
  for (int k = first; k < first + effect.columns(); ++k)
    if (size * size < kErrors * kErrors * covariance(k, k)) return false;
  std::vector<Effect> without = fit.effects();
  without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
  double taken = 0.0, left = 0.0;
  for (const auto& [kind, error] :
       errors_of_kinds(model.geometry, model.table, model.patches, *fit.residuals_um(), {})) {
    left += std::max(0.0, error.square - error.random_square);
    taken -= error.square;
  }
  for (const auto& [kind, error] : errors_of_kinds(model.geometry, model.table, model.patches,
                                                   *fit_of(model, without)->residuals_um(), {}))
    taken += error.square;
  return left < kLeft * taken;
}

/// A name of all teeth that stands by itself beside the forms of an answer that leaves little.
bool is_settled(const PartModel& model, const PointFit& fit, std::size_t e) {
  const Effect& name = fit.effects()[e];
  const Runs runs = runs_of(model.geometry, name, Flanks::kOfEither);
  return is_name_of_all_teeth(name) && name.shape.size() <= 1 && runs != Runs::kOverBoth &&
         runs != Runs::kOtherwise && is_possible(model.geometry, fit, static_cast<int>(e)) &&
         stands_among_few_forms(model.geometry, fit, e, !model.table->points_mm.empty()) &&
         is_beyond_doubt(model, fit, e);
}

/// A wave of both flanks beside nothing around the gear but drifts of one flank: the other shows
/// it.
bool is_settled_wave(const PartModel& model, const PointFit& fit, std::size_t e) {
  const Effect& wave = fit.effects()[e];
  if (!is_wave_around(wave) || wave.flank != FlankChoice::kBoth || wave.columns() != 2)
    return false;
  bool drifts = false;
  for (std::size_t f = 0; f < fit.effects().size(); ++f) {
    const Effect& other = fit.effects()[f];
    if (f == e || !other.is_term()) continue;
    const bool drift = other.family->is_drift && other.flank != FlankChoice::kBoth;
    if (!drift && (other.order() > 0.0 || differs_by_tooth(other))) return false;
    drifts = drifts || drift;
  }
  return drifts && is_possible(model.geometry, fit, static_cast<int>(e)) &&
         is_beyond_doubt(model, fit, e);
}

/// Names that do what a term does, or that a form once had, in the order in which such data are
/// told by them.
std::vector<Effect> names_of_term(const PartModel& model, const Effect& term) {
  const Runs runs = runs_of(model.geometry, term, Flanks::kOfEither);
  std::vector<Effect> names;
  for (std::size_t c = 0; c < model.candidates.size(); ++c) {
    Effect name = model.candidates[c];
    const EffectFamily& family = *name.family;
    if (!family.named || family.local || model.unseen[c] || name.flank != term.flank ||
        name.columns() != term.columns())
      continue;
    if (!term.family->form_word.empty()) {
      if (family.form_word != term.family->form_word || name.shape.size() != term.shape.size())
        continue;
      if (family.shape_is_continuous) name.shape = term.shape;
      if (name.shape != term.shape) continue;
    } else if (term.family != find_family("unnamed") || name.order() != term.order() ||
               (term.order() == 0.0 &&
                (!name.shape.empty() || term.columns() > 1 ||
                 runs_of(model.geometry, name, Flanks::kOfEither) != runs))) {
      continue;
    }
    for (const std::vector<Effect>& known : {names, model.effects})
      if (std::find(known.begin(), known.end(), name) != known.end()) name.family = nullptr;
    if (name.family != nullptr) names.push_back(std::move(name));
  }
  std::stable_sort(names.begin(), names.end(), [&model](const Effect& a, const Effect& b) {
    return preference_of(model, a) < preference_of(model, b);
  });
  return names;
}

/// Forms of all flanks that names may imitate, and they names: waves of the tool of few periods,
/// and what swells from end to end.
bool is_imitated_by_names(const FlankGeometry& geometry, const Effect& effect) {
  constexpr double kFewPeriods = 1.6;
  return effect.family == find_family("unnamed_sag") ||
         (effect.family == find_family("unnamed_waves_mirrored") &&
          std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm()) <
              kFewPeriods * effect.shape[0]);
}

/// What curves towards a place on all flanks, or is longer than they are, and what else is smooth
/// along the profile (0) or the face (1), may be one or two names: where these need fewer values
/// and leave little more for them, or leave clearly less with as many or one more.
bool tell_as_names(PartModel& model, int face) {
  constexpr double kClearly = 9.0, kValue = 6.0, kBetter = 1.0;  // chi-square
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  std::vector<std::size_t> these;
  std::vector<Effect> own, rest;
  bool curved = false;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const EffectFamily& family = *effect.family;
    const bool imitated = is_imitated_by_names(model.geometry, effect);
    const bool long_form =
        imitated || (effect.is_term() && family.form_word.empty() &&
                     is_longer_than_the_flank(model.geometry, effect, face == 1));
    const bool smooth =
        effect.columns() == 1 && (family.is_like_many || family.named ||
                                  !family.form_word.empty() || &family == find_family("unnamed"));
    if (e < first_told_here(model) || effect.flank != FlankChoice::kBoth ||
        !(smooth || long_form) || family.shape_is_step ||
        runs_of(model.geometry, effect, imitated ? Flanks::kOfEither : Flanks::kAlike) != runs) {
      rest.push_back(effect);
      continue;
    }
    these.push_back(e);
    own.push_back(effect);
    curved = curved || family.is_like_many || long_form;
  }
  if (!curved) return false;
  std::vector<Effect> best;
  double least = kNaN;
  const double now = fit_of(model, model.effects)->residual_square();
  const auto ask = [&](std::vector<Effect> with) {
    if (with.size() == rest.size()) return;
    const std::vector<Effect> names(with.begin() + static_cast<std::ptrdiff_t>(rest.size()),
                                    with.end());
    const int spared = values_of(own, true) - values_of(names, true);
    const double cost = fit_of(model, with)->residual_square() - kValue * spared;
    // One form that runs as one name does is that name.
    const bool same = own.size() == 1 && names.size() == 1 &&
                      run_alike(model.geometry, own.front(), names.front());
    const double most = same ? now + kValue : now - (spared <= 0 ? kClearly : 0.0);
    if (spared < -1 || cost > least - kBetter || cost > most) return;
    const auto fit = fit_of(model, with);
    for (std::size_t e = rest.size(); e < with.size(); ++e) {
      // A hollow bow beside a slope is what swells towards an end.
      const bool hollow = fit->coefficients()[fit->first_column(static_cast<int>(e))] < 0.0;
      if ((hollow && !is_straight(model.geometry, with[e])) || !is_settled(model, *fit, e)) return;
    }
    least = cost;
    best = std::move(with);
  };
  std::vector<Effect> plain = names_along(model, face), with_place;
  std::erase_if(plain, [](const Effect& name) { return name.flank != FlankChoice::kBoth; });
  for (std::size_t c = 0; c < model.candidates.size(); ++c)
    if (const Effect& name = model.candidates[c];
        name.family->named && name.family->shape_is_continuous && !name.family->shape_is_step &&
        !model.unseen[c] && name.shape.size() == 1 && name.flank == FlankChoice::kBoth &&
        runs_of(model.geometry, name) == runs)
      with_place.push_back(name);
  const auto and_one = [&](const std::vector<Effect>& beside) {
    if (with_place.empty()) return;
    const std::vector<Effect> with = with_best_form(model, beside, with_place, {});
    if (!with.empty()) ask(with);
  };
  and_one(rest);
  for (std::size_t a = 0; a < plain.size(); ++a) {
    std::vector<Effect> with = rest;
    with.push_back(plain[a]);
    ask(with);
    and_one(with);
    for (std::size_t b = a + 1; b < plain.size(); ++b) {
      with.resize(rest.size() + 1);
      with.push_back(plain[b]);
      ask(with);
    }
  }
  if (best.empty()) return false;
  put_in_place_of(model, these, best);
  return true;
}

}  // namespace

void name_what_is_settled(PartModel& model) {
  constexpr double kDenied = 9.0;  // chi-square
  for (const int face : {0, 1}) (void)tell_as_names(model, face);
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect term = model.effects[e];
    if (!term.is_term()) continue;
    const double as_term = fit_of(model, model.effects)->residual_square();
    for (const Effect& name : names_of_term(model, term)) {
      model.effects[e] = name;
      const auto fit = fit_of(model, model.effects);
      if (fit->residual_square() < as_term + kDenied &&
          (is_settled(model, *fit, e) || is_settled_wave(model, *fit, e)))
        break;
      model.effects[e] = term;
    }
  }
  std::copy_n(model.effects.begin(), model.options.given.size(), model.options.given.begin());
}

bool name_what_is_left(PartModel& model) {
  constexpr double kBeyondDoubt = 36.0;  // chi-square
  const auto held_out_um = [&](const std::vector<Effect>& effects) {
    return fit_of(model, effects)->errors(std::vector<bool>(effects.size(), true)).held_out_rms_um;
  };
  const double now = fit_of(model, model.effects)->residual_square();
  std::vector<Effect> best = with_best_name(model, now - kBeyondDoubt, Names::kOfEitherToo);
  if (best.empty() || !is_settled(model, *fit_of(model, best), best.size() - 1) ||
      held_out_um(best) > held_out_um(model.effects))
    return false;
  add_name(model, std::move(best));
  return true;
}

}  // namespace trueflank::loop
