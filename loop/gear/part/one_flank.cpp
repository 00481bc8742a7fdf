// SPDX-License-Identifier: GPL-3.0-or-later
// One flank that is off by itself, told as both; what is opposite on the flanks, told in pieces.
#include "trueflank/loop/gear/part/one_flank.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

/// Puts a form in place of some where all fits as well with it, but for what each value less may
/// take. True where it stands.
bool stands_in_place_of(PartModel& model, const std::vector<std::size_t>& these,
                        const Effect& form) {
  constexpr double kNothing = 4.0, kValue = 6.0;  // chi-square
  std::vector<Effect> with = model.effects, gone;
  for (std::size_t k = these.size(); k-- > 0;) {
    gone.push_back(with[these[k]]);
    with.erase(with.begin() + static_cast<std::ptrdiff_t>(these[k]));
  }
  with.push_back(form);
  const int spared = std::max(0, values_of(gone, false) - form.columns());
  if (fit_of(model, with)->residual_square() >
      fit_of(model, model.effects)->residual_square() + kNothing + kValue * spared)
    return false;
  put_in_place_of(model, these, with);
  return true;
}

/// A form of both flanks, and the same opposite on them.
bool tell_pair_of_one_flank(PartModel& model) {
  for (std::size_t a = first_told_here(model); a < model.effects.size(); ++a)
    for (std::size_t b = first_told_here(model); b < model.effects.size(); ++b) {
      const Effect &equal = model.effects[a], &opposite = model.effects[b];
      const auto& names = equal.family->shape_names;
      if (equal.family != opposite.family || equal.family->named || names.empty() ||
          names.back() != "opposite_flanks" || equal.shape.size() != names.size() ||
          equal.flank != FlankChoice::kBoth || opposite.flank != FlankChoice::kBoth ||
          equal.shape.back() != 0.0 || opposite.shape.back() == 0.0 ||
          !std::equal(equal.shape.begin(), equal.shape.end() - 1, opposite.shape.begin()))
        continue;
      Effect form = equal;
      for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
        form.flank = flank;
        if (stands_in_place_of(model, {std::min(a, b), std::max(a, b)}, form)) return true;
      }
    }
  return false;
}

/// A form of both flanks that one of them has alone: with half of it, or all, on the other one it
/// was found first.
bool tell_form_of_one_flank_alone(PartModel& model) {
  constexpr double kClearly = 25.0;  // chi-square
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& own = model.effects[e];
    const std::vector<std::string>& names = own.family->shape_names;
    if (own.family->named || own.flank != FlankChoice::kBoth || own.columns() != 1 ||
        names.empty() || names.back() != "opposite_flanks" || own.shape.size() != names.size())
      continue;
    double least = fit_of(model, model.effects)->residual_square() - kClearly;
    std::vector<Effect> with;
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
      std::vector<Effect> effects = model.effects;
      effects[e].flank = flank;
      effects[e].shape.back() = 0.0;
      const double square = fit_of(model, effects)->residual_square();
      if (square >= least) continue;
      least = square;
      with = std::move(effects);
    }
    if (with.empty()) continue;
    std::rotate(with.begin() + static_cast<std::ptrdiff_t>(e),
                with.begin() + static_cast<std::ptrdiff_t>(e) + 1, with.end());
    put_in_place_of(model, {e}, with);
    return true;
  }
  return false;
}

/// What a wave around the gear is along the flanks, as degrees over profile and face; none of other
/// effects.
std::optional<CourseOverFlanks> course_of_wave(const Effect& effect) {
  const NeedsToBeSeen needs = effect.needs();
  if (!is_wave_around(effect) || effect.columns() != 2) return {};
  if (effect.family == find_family("unnamed"))
    return CourseOverFlanks{.profile = effect.shape[0], .face = effect.shape[1]};
  if (!effect.family->named || effect.family->local || needs.along_profile || needs.along_face)
    return {};
  return CourseOverFlanks{};
}

/// Two waves of one order, alike and opposite on the flanks, or of both flanks and of one, that
/// cancel on one flank: the other alone has a wave.
bool tell_waves_that_cancel(PartModel& model) {
  constexpr double kOfErrors = 10.0;  // chi-square: in 1 of 150 errors make more of two values
  for (std::size_t a = first_told_here(model); a < model.effects.size(); ++a)
    for (std::size_t b = a + 1; b < model.effects.size(); ++b) {
      const Effect &one = model.effects[a], &other = model.effects[b];
      const auto course = course_of_wave(one), other_course = course_of_wave(other);
      if (!course || !other_course || one.order() != other.order() ||
          course->profile != other_course->profile || course->face != other_course->face ||
          (one.flank != FlankChoice::kBoth && other.flank != FlankChoice::kBoth) ||
          (model.table->is_displaced &&
           (one.family->displacement_mm || other.family->displacement_mm)))
        continue;
      for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
        std::vector<Effect> with = without(model.effects, {a, b});
        with.push_back(
            {find_family("unnamed"), flank, {course->profile, course->face, one.order(), 0.0}});
        if (fit_of(model, with)->residual_square() >
            fit_of(model, model.effects)->residual_square() + kOfErrors)
          continue;
        put_in_place_of(model, {a, b}, with);
        return true;
      }
    }
  return false;
}

/// Swellings of one flank that overlap so far that they are a wave of so many periods.
bool tell_swellings_that_are_a_wave(PartModel& model) {
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& swellings = model.effects[e];
    if (swellings.family != find_family("unnamed_swellings") ||
        swellings.flank == FlankChoice::kBoth)
      continue;
    std::vector<Effect> with = without(model.effects, {e});
    with.push_back(
        {find_family("unnamed"), swellings.flank, {0.0, 0.0, swellings.shape.front(), 0.0}});
    if (cost_of(model, with) > cost_of(model, model.effects)) continue;
    put_in_place_of(model, {e}, with);
    return true;
  }
  return false;
}

bool is_level_of_both(const PartModel& model, std::size_t e) {
  const Effect& effect = model.effects[e];
  return e >= first_told_here(model) && effect.columns() == 1 &&
         effect.flank == FlankChoice::kBoth && !effect.family->local &&
         runs_of(model.geometry, effect) == Runs::kNowhere;
}

/// Waves that come again with every so many teeth, with a level or none, are perhaps a comb.
bool tell_comb_of_one_flank(PartModel& model) {
  std::vector<std::size_t> levels;
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (is_level_of_both(model, e)) levels.push_back(e);
  const int z = model.geometry.teeth();
  for (int every = 3; every <= 8; ++every) {
    std::vector<std::size_t> waves;
    for (std::size_t e = first_told_here(model); z % every == 0 && e < model.effects.size(); ++e)
      if (const double order = model.effects[e].order();
          order > 0.0 && std::fmod(order, z / every) == 0.0 && is_wave_around(model.effects[e]))
        waves.push_back(e);
    if (waves.empty()) continue;
    std::vector<std::size_t> all = waves;
    all.insert(all.end(), levels.begin(), levels.end());
    std::sort(all.begin(), all.end());
    for (const std::vector<std::size_t>& these : {all, waves})
      for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight})
        for (const Effect& comb : combs_of(every, flank, 0.0))
          if (stands_in_place_of(model, these, comb)) return true;
  }
  return false;
}

/// What effects add up to on a flank [um], from place to place on all teeth.
std::vector<double> on_flank_um(const PartModel& model, const PointFit& fit, int side) {
  constexpr int kOverProfile = 41, kOverFace = 7;
  const FlankGeometry& geometry = model.geometry;
  std::vector<std::size_t> own;
  bool differ = false;
  for (std::size_t e = 0; e < fit.effects().size(); ++e) {
    const Effect& effect = fit.effects()[e];
    if (effect.flank == FlankChoice::kBoth || effect.family->local || effect.order() > 0.0)
      continue;
    own.push_back(e);
    differ = differ || !effect.family->same_on_every_tooth ||
             !effect.family->same_on_every_tooth(effect.shape);
  }
  std::vector<double> values;
  std::array<double, 8> columns{};
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  for (int tooth = 1; tooth <= (differ ? geometry.teeth() : 1); ++tooth)
    for (int i = 0; i < kOverProfile; ++i)
      for (int k = 0; k < kOverFace; ++k) {
        const Place place =
            geometry.on_flank(tooth, side, low + (i + 0.5) / kOverProfile * (high - low),
                              (k + 0.5) / kOverFace * geometry.face_width_mm());
        double& sum = values.emplace_back(0.0);
        for (const std::size_t e : own) {
          const Effect& effect = fit.effects()[e];
          effect.evaluate(geometry, place, columns.data());
          for (int c = 0; c < effect.columns(); ++c)
            sum += columns[static_cast<std::size_t>(c)] *
                   fit.coefficients()[fit.first_column(static_cast<int>(e)) + c];
        }
      }
  return values;
}

/// The level of one flank as half of it on both: a turned part.
bool tell_level_of_one_flank(PartModel& model) {
  constexpr double kAsDesigned = 0.25;  // of the most that the flank is off
  std::array<bool, 2> has{};
  for (const Effect& effect : model.effects)
    if (effect.flank != FlankChoice::kBoth && !effect.family->local && effect.order() == 0.0)
      has[effect.flank == FlankChoice::kLeft ? 0 : 1] = true;
  if (has[0] == has[1]) return false;
  const FlankChoice flank = has[0] ? FlankChoice::kLeft : FlankChoice::kRight;
  const int side = flank_side(has[0] ? Flank::kLeft : Flank::kRight, model.geometry.gear().kind);
  const Effect level{find_family("unnamed"), flank, {0.0, 0.0, 0.0, 0.0}};
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    if (!is_level_of_both(model, e)) continue;
    std::vector<Effect> with = model.effects;
    with[e] = level;
    std::vector<double> off = on_flank_um(model, *fit_of(model, with), side);
    const auto [low, high] = std::minmax_element(off.begin(), off.end());
    const double most = std::max(*high, -*low), least = *high > -*low ? *low : -*high;
    if (std::abs(least) < kAsDesigned * most && stands_in_place_of(model, {e}, level)) return true;
  }
  return false;
}

/// A level of both flanks, and a form of one of them that takes it out there again, as a wide
/// groove does: the other flank alone stands out.
bool tell_level_in_two_pieces(PartModel& model) {
  for (std::size_t a = 0; a < model.effects.size(); ++a)
    for (std::size_t b = first_told_here(model); b < model.effects.size(); ++b) {
      const Effect& form = model.effects[b];
      if (!is_level_of_both(model, a) || form.flank == FlankChoice::kBoth || form.columns() != 1 ||
          form.family->local || form.order() > 0.0)
        continue;
      const FlankChoice other =
          form.flank == FlankChoice::kLeft ? FlankChoice::kRight : FlankChoice::kLeft;
      for (const FlankChoice flank : {other, form.flank})
        if (stands_in_place_of(model, {std::min(a, b), std::max(a, b)},
                               {find_family("unnamed"), flank, {0.0, 0.0, 0.0, 0.0}}))
          return true;
    }
  return false;
}

/// Forms along the profile (0) or the face (1), opposite on the flanks, those of a family together;
/// long waves stand last. (A strip with soft sides is too like one band.)
std::vector<std::vector<Effect>> opposite_forms(const FlankGeometry& geometry, int face,
                                                bool strips) {
  std::vector<Effect> all = forms_along(geometry, face, FlankChoice::kBoth, true);
  if (!strips)
    std::erase_if(all, [strip = find_family("unnamed_strip")](const Effect& form) {
      return form.family == strip;
    });
  std::stable_sort(all.begin(), all.end(),
                   [](const Effect& a, const Effect& b) { return a.family->id < b.family->id; });
  for (Effect& wave : long_waves(geometry, face, FlankChoice::kBoth))
    all.push_back(std::move(wave));
  std::vector<std::vector<Effect>> families;
  for (Effect& form : all) {
    form.shape.push_back(1.0);
    if (families.empty() || families.back().front().family != form.family) families.emplace_back();
    families.back().push_back(std::move(form));
  }
  return families;
}

/// One form in place of these, which are opposite on the flanks. A name among them was told for its
/// mean: that is beyond doubt, or it stays. What has fewer values than several forms says as much
/// where nothing is lost; waves may take a value more.
bool tell_as_opposite_form(PartModel& model, const std::vector<std::size_t>& these, int face) {
  constexpr double kBeyondDoubt = 25.0, kNothing = 4.0;  // chi-square
  const bool named = std::any_of(these.begin(), these.end(),
                                 [&](std::size_t e) { return model.effects[e].family->named; });
  const double now = fit_of(model, model.effects)->residual_square();
  const std::vector<Effect> others = without(model.effects, these);
  std::vector<Effect> own;
  for (const std::size_t e : these) own.push_back(model.effects[e]);
  const int values = values_of(own, true);
  CheapestAnswer best;
  for (const std::vector<Effect>& forms : opposite_forms(model.geometry, face, these.size() > 1)) {
    const int more_values = forms.front().columns() - 1;
    std::vector<Effect> with = one_form_for(model, these, forms, {}, more_values);
    if (with.empty() && !named && values_of({forms.front()}, true) < values) {
      with = with_best_form(model, others, forms, {});
      if (!with.empty() && fit_of(model, with)->residual_square() > now + kNothing) with.clear();
    }
    if (with.empty() || (named && fit_of(model, with)->residual_square() > now - kBeyondDoubt))
      continue;
    best.ask(model, std::move(with), these);
  }
  if (best.effects.empty()) return false;
  put_in_place_of(model, these, best.effects);
  return true;
}

/// A kind of form that both flanks have, each its own.
std::vector<std::size_t> form_of_either_flank(const PartModel& model, int face) {
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  for (std::size_t a = first_told_here(model); a < model.effects.size(); ++a)
    for (std::size_t b = a + 1; b < model.effects.size(); ++b) {
      const Effect &one = model.effects[a], &other = model.effects[b];
      if (one.family == other.family && !one.family->named && one.flank != other.flank &&
          one.flank != FlankChoice::kBoth && other.flank != FlankChoice::kBoth &&
          runs_of(model.geometry, one) == runs && runs_of(model.geometry, other) == runs)
        return {a, b};
    }
  return {};
}

/// Waves around the gear that followed what these effects left, and are little beside one form.
void drop_waves_of_what_was_left(PartModel& model, const std::vector<Effect>& before) {
  constexpr double kLittle = 49.0, kShare = 0.3;  // chi-square: seven errors; of what they were
  const auto then = fit_of(model, before);
  const std::size_t told = model.effects.size();
  while (model.effects.size() > 1) {
    const auto now = fit_of(model, model.effects);
    const auto has_shrunk = [&](const Effect& effect) {
      if (!(effect.order() > 0.0) || effect.columns() != 2) return false;
      const auto was = std::find(before.begin(), before.end(), effect);
      const auto is = std::find(model.effects.begin(), model.effects.end(), effect);
      return was != before.end() &&
             now->effect_size_um(static_cast<int>(is - model.effects.begin())) <
                 kShare * then->effect_size_um(static_cast<int>(was - before.begin()));
    };
    const auto [idle, loss] =
        least_missed(model, first_told_here(model), model.effects.size(), has_shrunk);
    if (!(loss < kLittle)) break;
    remove_effect(model, idle);
  }
  if (model.effects.size() < told)
    refine_nearby(model.geometry, model.table, model.patches, model.effects);
}

}  // namespace

void tell_opposite_forms(PartModel& model) {
  if (model.options.joined || model.table->rows.empty()) return;
  const std::vector<Effect> before = model.effects;
  bool told = false;
  for (const int face : {0, 1}) {
    const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
    std::vector<std::size_t> all, nameless;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      const Effect& effect = model.effects[e];
      if (effect.flank != FlankChoice::kBoth ||
          runs_of(model.geometry, effect, Flanks::kOfEither) != runs ||
          runs_of(model.geometry, effect) != Runs::kOtherwise)
        continue;
      all.push_back(e);
      if (!effect.family->named) nameless.push_back(e);
    }
    const std::vector<std::size_t> either = form_of_either_flank(model, face);
    if (!either.empty() && tell_as_opposite_form(model, either, face)) {
      told = true;
      continue;
    }
    if (nameless.empty()) continue;
    told = tell_as_opposite_form(model, all, face) ||
           (nameless.size() < all.size() && tell_as_opposite_form(model, nameless, face)) || told;
  }
  if (!told) return;
  drop_idle_beside_one_form(model);
  drop_waves_of_what_was_left(model, before);
}

void tell_waves_of_one_flank(PartModel& model) {
  while (tell_waves_that_cancel(model) || tell_swellings_that_are_a_wave(model)) {
  }
}

void tell_what_one_flank_has(PartModel& model) {
  tell_waves_of_one_flank(model);
  while (tell_form_of_one_flank_alone(model)) {
  }
  while (tell_pair_of_one_flank(model)) {
  }
  (void)tell_comb_of_one_flank(model);
  (void)tell_level_of_one_flank(model);
  (void)tell_level_in_two_pieces(model);
}

bool tell_as_form_of_other_flanks(PartModel& model, int face) {
  constexpr int kFewestValues = 3, kValuesOfWaves = 6;
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  std::vector<std::size_t> all, levels;
  bool one_flank = false, both = false, equal = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Runs own = runs_of(model.geometry, model.effects[e], Flanks::kOfEither);
    const bool on_one = model.effects[e].flank != FlankChoice::kBoth;
    if (own == Runs::kNowhere) levels.push_back(e);
    if (own != runs) continue;
    all.push_back(e);
    one_flank = one_flank || on_one;
    const bool opposite = !on_one && runs_of(model.geometry, model.effects[e]) == Runs::kOtherwise;
    both = both || opposite;
    equal = equal || !(on_one || opposite);
  }
  // What is equal on both flanks and what is opposite on them may leave one of them alone.
  one_flank = one_flank || (both && equal);
  std::vector<Effect> own;
  for (const std::size_t e : all) own.push_back(model.effects[e]);
  if (all.size() < 2 || !(one_flank || both) || values_of(own, true) < kFewestValues) return false;
  std::vector<std::vector<std::size_t>> sets{all};
  if (!levels.empty()) {
    sets.insert(sets.begin(), all);
    sets.front().insert(sets.front().end(), levels.begin(), levels.end());
    std::sort(sets.front().begin(), sets.front().end());
  }
  // (beside a form of one flank the others may be one of the other)
  for (const std::size_t e : all)
    if ((model.effects[e].family->named || model.effects[e].flank != FlankChoice::kBoth) &&
        all.size() > 2) {
      sets.push_back(all);
      std::erase(sets.back(), e);
    }
  std::vector<Effect> opposite;
  for (Effect form : forms_along(model.geometry, face, FlankChoice::kBoth, true)) {
    form.shape.push_back(1.0);
    opposite.push_back(std::move(form));
  }
  for (const std::vector<std::size_t>& these : sets) {
    if (put_one_form_for(model, these, opposite)) return true;
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight})
      if (one_flank &&
          put_one_form_for(model, these, forms_and_s_along(model.geometry, face, flank)))
        return true;
  }
  // Beside a name that these pieces have taken up.
  for (const Effect& name : names_along(model, face, true)) {
    if (name.flank != FlankChoice::kBoth || std::find(own.begin(), own.end(), name) != own.end())
      continue;
    for (const std::vector<std::size_t>& these : sets)
      for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight})
        if (one_flank &&
            put_one_form_for(model, these, forms_and_s_along(model.geometry, face, flank), {name}))
          return true;
  }
  if (values_of(own, true) <= kValuesOfWaves) return false;
  for (const Effect& right : long_waves(model.geometry, face, FlankChoice::kRight))
    if (put_one_form_for(model, all, {{right.family, FlankChoice::kLeft, right.shape}}, {right}))
      return true;
  return false;
}

}  // namespace trueflank::loop
