// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/ends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/taken_up.h"

namespace trueflank::loop {
namespace {

constexpr std::array kEndFamilies{"unnamed_kink", "unnamed_bend", "unnamed_rise"};

}  // namespace

std::optional<FormAtAnEnd> form_at_an_end(const FlankGeometry& geometry, const Effect& effect) {
  constexpr std::ptrdiff_t kTeeth = 3, kOwn = 3;
  FormAtAnEnd form;
  form.of_teeth = gear_effects::is_of_teeth(effect);
  const auto is_of = [&](const char* family) {
    const EffectFamily* own = find_family(family);
    return own != nullptr &&
           effect.family == (form.of_teeth ? find_family(own->id + "_of_teeth") : own);
  };
  const auto own = effect.shape.begin() + (form.of_teeth ? kTeeth : 0);
  form.before.assign(effect.shape.begin(), own);
  if (std::any_of(kEndFamilies.begin(), kEndFamilies.end(), is_of)) {
    form.face = own[0];
    form.end = own[2];
    form.behind.assign(own + kOwn, effect.shape.end());
    if (std::abs(form.end) != 1.0) return {};
    return form;
  }
  // (a ridge along an end of the face, of which one side alone is on the flank)
  if (!form.of_teeth || !is_of("unnamed_slanted_ridge")) return {};
  constexpr double kNear = 0.06;
  const double low = std::min(own[0], own[1]) / geometry.face_width_mm(),
               high = std::max(own[0], own[1]) / geometry.face_width_mm();
  form.face = 1.0;
  form.end = high < kNear ? -1.0 : low > 1.0 - kNear ? 1.0 : 0.0;
  if (form.end == 0.0) return {};
  return form;
}

namespace {

std::vector<Effect> forms_at_end(const FlankGeometry& geometry, const Effect& effect,
                                 const FormAtAnEnd& at, const char* family) {
  const EffectFamily* own = find_family(family);
  if (at.of_teeth) own = find_family(own->id + "_of_teeth");
  const bool dies = std::string(family) == kEndFamilies.back();
  const double range_mm = std::abs(gear_effects::range_mm(geometry, at.face));
  std::vector<Effect> forms;
  for (const double part : {0.04, 0.08, 0.15, 0.25, 0.4, 0.6, 0.8}) {
    if (dies && part > 0.5) continue;
    EffectShape shape = at.before;
    shape.push_back(at.face);
    shape.push_back(
        dies ? part * range_mm
             : gear_effects::place_at(geometry, at.face, at.end > 0.0 ? 1.0 - part : part));
    shape.push_back(at.end);
    shape.insert(shape.end(), at.behind.begin(), at.behind.end());
    forms.push_back({own, effect.flank, std::move(shape)});
  }
  return forms;
}

/// Dying away from both ends alike, or curved towards both.
std::vector<Effect> forms_at_both_ends(const FlankGeometry& geometry, double face,
                                       FlankChoice flank) {
  const double range_mm = std::abs(gear_effects::range_mm(geometry, face));
  std::vector<Effect> forms;
  for (const double part : {0.03, 0.06, 0.1, 0.15, 0.19})
    forms.push_back({find_family("unnamed_rise"), flank, {face, part * range_mm, 0.0}});
  for (const double part : {0.7, 0.8, 0.9})
    forms.push_back({find_family("unnamed_bend"),
                     flank,
                     {face, gear_effects::place_at(geometry, face, part), 0.0}});
  return forms;
}

}  // namespace

void tell_both_ends_as_one(PartModel& model) {
  constexpr double kValue = 6.0, kClearly = 9.0;  // chi-square: of each value spared; of none
  if (model.options.joined) return;
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  for (const double face : {1.0, 0.0})
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
      std::vector<std::size_t> all;
      std::vector<Effect> own;
      for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
        const Effect& effect = model.effects[e];
        if (effect.flank != flank ||
            runs_of(model.geometry, effect) != (face != 0.0 ? Runs::kOverFace : Runs::kOverProfile))
          continue;
        all.push_back(e);
        own.push_back(effect);
      }
      if (all.size() < 2) continue;
      // (what all flanks stand out by may hang on these)
      std::vector<Effect> best;
      double least = 0.0;
      for (const bool with_level : {false, true}) {
        std::vector<Effect> rest = without(model.effects, all);
        if (with_level && !is_told_apart(model, level, rest)) break;
        if (with_level) rest.push_back(level);
        std::vector<Effect> with =
            with_best_form(model, rest, forms_at_both_ends(model.geometry, face, flank), {});
        if (with.empty()) continue;
        const int spared =
            values_of(own, true) - values_of({with.back()}, true) - (with_level ? 1 : 0);
        const double more = fit_of(model, with)->residual_square() -
                            fit_of(model, model.effects)->residual_square() - kValue * spared;
        if (spared < 0 || more > (spared > 0 ? 0.0 : -kClearly) || (!best.empty() && more >= least))
          continue;
        least = more;
        best = std::move(with);
      }
      if (best.empty()) continue;
      put_in_place_of(model, all, best);
    }
}

void tell_ends_as_they_fit(PartModel& model) {
  constexpr double kClearly = 4.0;  // chi-square: of as many values
  if (model.options.joined) return;
  std::size_t left = model.effects.size() - std::min(model.effects.size(), first_told_here(model));
  for (std::size_t e = first_told_here(model); left > 0 && e < model.effects.size(); --left) {
    const std::optional<FormAtAnEnd> at = form_at_an_end(model.geometry, model.effects[e]);
    if (!at) {
      ++e;
      continue;
    }
    const std::vector<Effect> others = without(model.effects, {e});
    double least = fit_of(model, model.effects)->residual_square() - kClearly;
    std::vector<Effect> best;
    for (const char* family : kEndFamilies) {
      std::vector<Effect> with = with_best_form(
          model, others, forms_at_end(model.geometry, model.effects[e], *at, family), {});
      if (with.empty() || !form_at_an_end(model.geometry, with.back())) continue;
      const double square = fit_of(model, with)->residual_square();
      if (!(square < least)) continue;
      least = square;
      best = std::move(with);
    }
    // (it stands last then)
    if (best.empty())
      ++e;
    else
      put_in_place_of(model, {e}, best);
  }
}

}  // namespace trueflank::loop
