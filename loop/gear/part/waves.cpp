// SPDX-License-Identifier: GPL-3.0-or-later
// Waves that grow towards an end, or begin at a place: waves of several lengths, and forms that
// bend them, are told as these. Waves around the gear that one odd form is made of.
#include "trueflank/loop/gear/part/waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/local/odd_waves.h"
#include "trueflank/loop/gear/local/products/likeliest_products.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/parts_of_forms.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/remainder_around.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

/// The length of the largest wave without a name among some effects; empty: there is none.
std::optional<double> largest_wavelength_mm(const PartModel& model,
                                            const std::vector<std::size_t>& of) {
  std::optional<double> wavelength_mm;
  double most_um = 0.0;
  for (const std::size_t e : of) {
    if (model.effects[e].family != find_family("unnamed_waviness")) continue;
    const double um = fit_of(model, model.effects)->effect_size_um(static_cast<int>(e));
    if (um < most_um) continue;
    most_um = um;
    wavelength_mm = model.effects[e].shape[1];
  }
  return wavelength_mm;
}

/// A wave of a family on either flank, last, in place of some: of the order near theirs that leaves
/// least.
std::vector<Effect> with_pair_for(const PartModel& model, const std::vector<std::size_t>& these,
                                  const EffectFamily& family) {
  const Effect& wave = model.effects[these.front()];
  std::vector<EffectShape> shapes{wave.shape};
  if (family.nearby)
    for (EffectShape& shape : family.nearby(model.geometry, wave.shape))
      shapes.push_back(std::move(shape));
  std::vector<Effect> with;
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (std::find(these.begin(), these.end(), e) == these.end()) with.push_back(model.effects[e]);
  const std::size_t at = with.size();
  for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight})
    with.push_back({&family, flank, wave.shape});
  // (the values of one flank hang on the other's by what both have in common alone)
  const TrialFit fit = fit_to_refine(model.geometry, model.table, model.patches, with);
  const std::vector<TrialFit::Trial> left = fit.with_shapes(at, shapes, 0.0),
                                     right = fit.with_shapes(at + 1, shapes, 0.0);
  double least = kNaN;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (left[i].square + right[i].square >= least) continue;
    least = left[i].square + right[i].square;
    with[at].shape = with[at + 1].shape = shapes[i];
  }
  return with;
}

/// What may be pieces of one wave over the profile (0) or the face (1) that changes from tooth to
/// tooth: each wave that has no name, all of them, with orders of a machine, and all that has no
/// name, or a place, and runs there; and the lengths of these waves, if any.
struct SetsOfAWave {
  std::vector<std::vector<std::size_t>> sets;
  std::vector<double> lengths_mm;
};
SetsOfAWave sets_of_a_wave(const PartModel& model, int face) {
  SetsOfAWave found;
  std::vector<std::size_t> waves, with_orders, all;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const NeedsToBeSeen needs = effect.needs();
    const bool order = effect.order() > 0.0 && (needs.along_profile || needs.along_face);
    const bool wave = (effect.family == find_family("unnamed_waviness") ||
                       effect.family == find_family("unnamed_crossed_waves")) &&
                      effect.shape[0] == face;
    const bool runs_there = (!effect.family->named || effect.family->shape_is_continuous) &&
                            needs.along_profile == (face == 0) && needs.along_face == (face == 1);
    if (wave) {
      waves.push_back(e);
      found.lengths_mm.push_back(effect.shape[1]);
      found.sets.push_back({e});
    }
    if (wave || order) with_orders.push_back(e);
    if (wave || order || runs_there) all.push_back(e);
  }
  // (crests and hollows may stand for a wave)
  if (waves.empty() && all.size() < 2) return found;
  if (waves.empty()) return {.sets = {all}, .lengths_mm = {}};
  for (const std::vector<std::size_t>* set : {&waves, &with_orders, &all})
    if (std::find(found.sets.begin(), found.sets.end(), *set) == found.sets.end())
      found.sets.push_back(*set);
  return found;
}

/// Waves of one shape on either flank that have one phase are one of both.
void join_waves_of_flanks(const PartModel& model, std::vector<RemainderFinding>& waves) {
  constexpr double kNothing = 9.0;  // chi-square
  for (std::size_t i = 0; i + 1 < waves.size(); ++i) {
    const Effect &one = *waves[i].effect, &other = *waves[i + 1].effect;
    if (one.family != other.family || one.shape != other.shape || one.flank == other.flank)
      continue;
    std::vector<Effect> apart = model.options.given, together = apart;
    apart.push_back(one);
    apart.push_back(other);
    together.push_back({one.family, FlankChoice::kBoth, one.shape});
    if (fit_of(model, together)->residual_square() >
        fit_of(model, apart)->residual_square() + kNothing)
      continue;
    waves[i].effect->flank = FlankChoice::kBoth;
    waves.erase(waves.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
}

}  // namespace

WaveAcross wave_across(const FlankGeometry& geometry, const Effect& effect, int side) {
  constexpr int kSteps = 512;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const auto phase = [&](int tooth, double u, double v) {
    double c[2];
    effect.evaluate(
        geometry,
        geometry.on_flank(tooth, side, low + u * (high - low), v * geometry.face_width_mm()), c);
    return std::atan2(c[1], c[0]);
  };
  const auto waves_along = [&](double profile, double face) {
    double turned = 0.0, before = phase(1, 0.0, 0.0);
    for (int i = 1; i <= kSteps; ++i) {
      const double share = static_cast<double>(i) / kSteps;
      const double now = phase(1, profile * share, face * share);
      turned += std::remainder(now - before, kTwoPi);
      before = now;
    }
    return turned / kTwoPi;
  };
  return {.profile = waves_along(1.0, 0.0),
          .face = waves_along(0.0, 1.0),
          .order = std::remainder(phase(2, 0.0, 0.0) - phase(1, 0.0, 0.0), kTwoPi) / kTwoPi *
                   geometry.teeth()};
}

std::vector<RemainderFinding> marching_waves(PartModel& model) {
  std::vector<RemainderFinding> found;
  if (!model.table->points_mm.empty()) return found;
  for (const RemainderFinding& finding :
       remainder_of(model, model.options.given, RemainderOf::kTraining))
    if (finding.effect && finding.effect->family == find_family("unnamed_marks") &&
        is_told_apart(model, *finding.effect, model.options.given))
      found.push_back(finding);
  join_waves_of_flanks(model, found);
  return found;
}

std::vector<RemainderFinding> waves_of_odd_course(const PartModel& model) {
  std::vector<RemainderFinding> found;
  if (!model.table->points_mm.empty()) return found;
  for (OddWave& wave : odd_waves(model.geometry, model.table, model.patches,
                                 *fit_of(model, model.options.given)->residuals_um())) {
    found.emplace_back();
    found.back().p_value = wave.p_value;
    found.back().effect = std::move(wave.form);
  }
  join_waves_of_flanks(model, found);
  for (RemainderFinding& finding : found) {
    std::vector<Effect> with = model.options.given;
    with.push_back(*finding.effect);
    refine_nearby(model.geometry, model.table, model.patches, with);
    finding.effect = with.back();
  }
  return found;
}

bool tell_as_part_of_a_wave(PartModel& model, const std::vector<std::size_t>& all, int face,
                            FlankChoice flank) {
  std::vector<std::size_t> forms, bent;
  for (const std::size_t e : all) {
    if (!model.effects[e].is_term() || !model.effects[e].family->form_word.empty()) continue;
    forms.push_back(e);
    if (!is_straight(model.geometry, model.effects[e])) bent.push_back(e);
  }
  const std::optional<double> wavelength_mm = largest_wavelength_mm(model, forms);
  if (!wavelength_mm) return false;
  // (families stand in one vector, so their order here is that of the library)
  std::map<const EffectFamily*, std::vector<Effect>> parts;
  for (Effect& part : gear_effects::parts_of_waves(model.geometry, face, flank, *wavelength_mm))
    parts[part.family].push_back(std::move(part));
  // Which kind of waves fits best is seen when each is moved to where it fits best.
  const auto best_part_for = [&](const std::vector<std::size_t>& these) {
    std::vector<Effect> best;
    double least = kNaN;
    for (const auto& [family, forms_of_it] : parts) {
      std::vector<Effect> with = one_form_for(model, these, forms_of_it, {}, 0);
      if (with.empty()) continue;
      const double left = fit_of(model, with)->residual_square();
      if (left >= least) continue;
      least = left;
      best = std::move(with);
    }
    if (!best.empty()) put_in_place_of(model, these, best);
    return !best.empty();
  };
  return (forms.size() > 1 && best_part_for(forms)) ||
         (bent.size() > 1 && bent.size() < forms.size() && best_part_for(bent));
}

std::optional<RemainderFinding> wave_of_pieces(const PartModel& model, int face,
                                               FlankChoice flank) {
  std::vector<std::size_t> along;
  std::vector<Effect> others{
      {find_family("unnamed"), flank, {face == 0 ? 1.0 : 0.0, face == 0 ? 0.0 : 1.0, 0.0, 0.0}}};
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Runs runs = runs_of(model.geometry, model.effects[e]);
    if (runs == (face == 0 ? Runs::kOverProfile : Runs::kOverFace) &&
        model.effects[e].flank == flank)
      along.push_back(e);
    else if (!model.effects[e].family->local)
      others.push_back(model.effects[e]);
  }
  const std::optional<double> wavelength_mm = largest_wavelength_mm(model, along);
  if (along.size() < 3 || !wavelength_mm) return {};
  const std::vector<Effect> with =
      with_best_form(model, std::move(others),
                     gear_effects::parts_of_waves(model.geometry, face, flank, *wavelength_mm), {});
  if (with.empty()) return {};
  RemainderFinding wave;
  wave.effect = with.back();
  for (const std::size_t e : along)
    wave.p_value = std::min(wave.p_value, model.discovery.chosen[e].p_value);
  return wave;
}

std::vector<Effect> with_phase_of_each_flank(const PartModel& model,
                                             std::vector<std::size_t>& these) {
  constexpr double kClearly = 25.0;  // chi-square
  constexpr double kAlike = 2.0;     // sizes on both flanks
  if (!is_traced(model.table))
    return {};  // scans show all teeth: waves of one flank are found in them
  std::vector<std::vector<std::size_t>> sets;
  std::vector<std::size_t> of_both;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    if (!model.effects[e].family->tells_order_along_profile) continue;
    if (model.effects[e].flank == FlankChoice::kBoth) {
      of_both.push_back(e);
      sets.push_back({e});
      continue;
    }
    // Both have it already: beside what was found since, another order may fit better.
    for (std::size_t f = e + 1; f < model.effects.size(); ++f)
      if (model.effects[f].family == model.effects[e].family &&
          model.effects[f].shape == model.effects[e].shape)
        sets.push_back({e, f});
  }
  if (of_both.size() > 1) sets.insert(sets.begin(), of_both);
  std::vector<Effect> best;
  double least = cost_of(model, model.effects) - kClearly;
  // (the library has the way the teeth are counted first, then the other one)
  for (const EffectFamily& family : effect_library()) {
    if (!family.tells_order_along_profile) continue;
    for (const std::vector<std::size_t>& set : sets) {
      std::vector<Effect> with = with_pair_for(model, set, family);
      const double cost = cost_of(model, with);
      if (!(cost < least)) continue;
      const auto fitted = fit_of(model, with);
      const auto size_um = [&](std::size_t before_last) {
        return fitted->effect_size_um(static_cast<int>(with.size() - 1 - before_last));
      };
      const double ratio = size_um(0) / size_um(1);
      if (!(ratio < kAlike && ratio > 1.0 / kAlike)) continue;
      least = cost;
      these = set;
      best = std::move(with);
    }
    // The other way must say clearly more than this one.
    if (!best.empty()) least -= kClearly;
  }
  return best;
}

std::vector<Effect> with_wave_of_the_tool(const PartModel& model, std::vector<std::size_t>& these) {
  constexpr double kNothing = 1.0, kWave = 24.0;  // chi-square, of a wave over the face that goes
  std::vector<std::size_t> over_face;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if (model.effects[e].family == find_family("unnamed_waviness") &&
        model.effects[e].shape[0] != 0.0)
      over_face.push_back(e);
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& wave = model.effects[e];
    if (!wave.family->tells_order_along_profile ||
        std::remainder(wave.order(), model.geometry.teeth()) != 0.0)
      continue;
    const double length_mm = kTwoPi * model.geometry.base_radius_mm() / wave.order();
    const Effect form = wave.flank == FlankChoice::kBoth
                            ? Effect{find_family("unnamed_waves_mirrored"), wave.flank, {length_mm}}
                            : Effect{find_family("unnamed_waviness"), wave.flank, {0.0, length_mm}};
    std::vector<std::vector<std::size_t>> sets{{e}};
    if (!over_face.empty()) {
      sets.push_back(over_face);
      sets.back().push_back(e);
      std::sort(sets.back().begin(), sets.back().end());
    }
    for (const std::vector<std::size_t>& set : sets) {
      std::vector<Effect> with;
      for (std::size_t other = 0; other < model.effects.size(); ++other)
        if (std::find(set.begin(), set.end(), other) == set.end())
          with.push_back(model.effects[other]);
      with.push_back(form);
      refine_nearby(model.geometry, model.table, model.patches, with);
      if (fit_of(model, with)->residual_square() > fit_of(model, model.effects)->residual_square() +
                                                       kNothing +
                                                       kWave * static_cast<double>(set.size() - 1))
        continue;
      these = set;
      return with;
    }
  }
  return {};
}

std::vector<Effect> with_growing_wave(const PartModel& model, std::vector<std::size_t>& these) {
  constexpr double kSameLength = 0.15, kClearly = 30.0;  // kClearly: chi-square
  constexpr int kMoreValues = 2;
  CheapestAnswer best{.least = cost_of(model, model.effects) - kClearly};
  for (const int face : {0, 1}) {
    const SetsOfAWave sets = sets_of_a_wave(model, face);
    for (const std::vector<std::size_t>& set : sets.sets) {
      const LikeliestProducts likeliest(
          model.geometry, model.table, model.patches,
          *fit_of(model, without(model.effects, set))->residuals_um());
      for (const LikelyForms& likely : likeliest.growing_waves(face)) {
        const double length_mm = likely.forms.front().shape[1];
        if (!sets.lengths_mm.empty() &&
            std::none_of(sets.lengths_mm.begin(), sets.lengths_mm.end(), [&](double own_mm) {
              return std::abs(length_mm - own_mm) < kSameLength * own_mm;
            }))
          continue;
        best.ask(model, one_form_for(model, set, likely.forms, {}, kMoreValues), set);
      }
    }
  }
  if (!best.effects.empty()) these = std::move(best.these);
  return std::move(best.effects);
}

void tell_waves_of_a_form(PartModel& model) {
  constexpr double kCounts = 0.1, kLike = 0.25;
  constexpr std::size_t kFewest = 3;
  if (model.effects.empty()) return;
  const auto fit = fit_of(model, model.effects);
  struct Wave {
    std::size_t effect = 0;
    double order = 0.0, size_um = 0.0;
  };
  std::vector<Wave> waves;
  bool drifts = false;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    drifts = drifts || effect.family->is_drift;
    const NeedsToBeSeen needs = effect.needs();
    if (is_wave_around(effect) && !needs.along_profile && !needs.along_face)
      waves.push_back({e, effect.order(), fit->effect_size_um(static_cast<int>(e))});
  }
  // A wave without a name of as many that runs along the flanks, too, and is larger.
  const auto is_part_of_a_form = [&](const Wave& wave) {
    return model.effects[wave.effect].family->doubt_share > 0.0 &&
           std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& form) {
             return form.is_term() && form.order() == wave.order && wave.order > 1.0 &&
                    form.needs().along_face &&
                    fit->effect_size_um(static_cast<int>(&form - model.effects.data())) >
                        wave.size_um;
           });
  };
  for (const Wave& wave : waves) {
    const EffectFamily* form = form_instead(model, wave.effect);
    if (form == nullptr) continue;
    if (is_part_of_a_form(wave)) {
      model.effects[wave.effect].family = form;
      continue;
    }
    std::set<double> orders;
    double others_um = 0.0;
    bool one_kind = true;
    for (const Wave& other : waves) {
      if (other.size_um < kCounts * wave.size_um) continue;
      one_kind =
          one_kind && model.effects[other.effect].family == model.effects[wave.effect].family;
      orders.insert(other.order);
      if (other.order != wave.order) others_um = std::hypot(others_um, other.size_um);
    }
    if (others_um < kLike * wave.size_um) continue;
    // Jaws and gates press in sharper than a sine: multiples of their number are theirs.
    constexpr double kFewestJaws = 3.0;
    const double lowest = *orders.begin();
    const bool harmonics = lowest >= kFewestJaws && one_kind &&
                           std::all_of(orders.begin(), orders.end(),
                                       [&](double n) { return std::remainder(n, lowest) == 0.0; });
    if (!harmonics && orders.size() >= (drifts ? kFewest - 1 : kFewest))
      model.effects[wave.effect].family = form;
  }
}

bool tell_as_walking_waves(PartModel& model) {
  constexpr double kAlike = 0.8, kFewest = 2.0;            // waves along the flank
  constexpr double kBeside = 1.5, kWhole = 0.03;           // periods a turn: the next whole number
  constexpr int kFewestTeeth = 8, kSeams = 16, kMore = 3;  // kMore: values
  const int z = model.geometry.teeth();
  if (z < kFewestTeeth) return false;
  const EffectFamily *marks = find_family("unnamed_marks"),
                     *walking = find_family("unnamed_walking_waves");
  for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight, FlankChoice::kBoth}) {
    std::vector<WaveAcross> waves;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      const Effect& effect = model.effects[e];
      const bool runs_on = effect.family == marks || effect.family == walking;
      // What runs on may be told in parts of one flank and of both.
      if ((effect.flank != flank && !(flank == FlankChoice::kBoth && runs_on)) ||
          effect.columns() != 2 || effect.family->local ||
          !(effect.family->tells_order_along_profile || runs_on ||
            effect.family == find_family("unnamed_waviness")))
        continue;
      const int side = effect.flank == flank_choice(model.geometry, 0) ? -1 : 1;
      waves.push_back(wave_across(model.geometry, effect, side));
      if (effect.family == walking)
        waves.back().order = effect.shape[2];  // (across its first tooth, too)
      waves.back().effect = e;
      waves.back().size_um = fit_of(model, model.effects)->effect_size_um(static_cast<int>(e));
    }
    if (waves.empty()) continue;
    const WaveAcross most = *std::max_element(
        waves.begin(), waves.end(),
        [](const WaveAcross& a, const WaveAcross& b) { return a.size_um < b.size_um; });
    // Over less than two waves of the face they are forms that teeth have.
    if (most.profile == 0.0 && std::abs(most.face) < kFewest) continue;
    std::vector<std::size_t> these;
    // (one that runs on from tooth to tooth may do so by no whole number itself)
    bool beside =
        model.effects[most.effect].family == marks && model.effects[most.effect].shape[2] != 0.0;
    for (const WaveAcross& own : waves)
      for (const WaveAcross& wave : {own, own.reversed()}) {
        if (std::abs(wave.profile - most.profile) > kAlike ||
            std::abs(wave.face - most.face) > kAlike)
          continue;
        these.push_back(wave.effect);
        beside = beside || (wave.effect != most.effect &&
                            std::abs(std::remainder(wave.order - most.order, z)) < kBeside);
      }
    if (!beside) continue;
    these.erase(std::unique(these.begin(), these.end()), these.end());
    std::vector<Effect> forms;
    const double seam = std::max(1.0, static_cast<double>(z) / kSeams);
    const std::vector<double> profiles =
        most.profile == 0.0 ? std::vector{0.0}
                            : std::vector{most.profile - 0.15, most.profile, most.profile + 0.15};
    for (int tenths = -8; tenths <= 8; ++tenths)
      for (const double profile : profiles)
        for (double from = 1.0; from < z + 1.0; from += seam)
          forms.push_back(
              {walking, flank, {profile, most.face, most.order + 0.1 * tenths, std::floor(from)}});
    const std::vector<Effect> with = one_form_for(model, these, forms, {}, kMore);
    if (with.empty() || std::abs(std::remainder(with.back().shape[2], 1.0)) < kWhole) continue;
    put_in_place_of(model, these, with);
    return true;
  }
  return false;
}

namespace {

/// Waves aslant over either flank that are one of both: those of a cross hatch, that nearly undo
/// each other along lines, are found on one flank first.
bool tell_as_slant_waves_of_both_flanks(PartModel& model) {
  constexpr double kAlike = 0.1;  // waves over the flank
  const EffectFamily* marks = find_family("unnamed_marks");
  const auto is_slant_of = [&](const Effect& effect, FlankChoice flank) {
    return effect.family == marks && effect.flank == flank;
  };
  for (std::size_t a = first_told_here(model); a < model.effects.size(); ++a)
    for (std::size_t b = first_told_here(model); b < model.effects.size(); ++b) {
      const Effect &left = model.effects[a], &right = model.effects[b];
      if (!is_slant_of(left, FlankChoice::kLeft) || !is_slant_of(right, FlankChoice::kRight) ||
          left.shape[2] != right.shape[2])
        continue;
      // (the other way round it is the same wave)
      const double sign =
          left.shape[0] * right.shape[0] + left.shape[1] * right.shape[1] < 0.0 ? -1.0 : 1.0;
      if (std::abs(left.shape[0] - sign * right.shape[0]) > kAlike ||
          std::abs(left.shape[1] - sign * right.shape[1]) > kAlike ||
          (sign < 0.0 && left.shape[2] != 0.0))
        continue;
      const Effect both{marks,
                        FlankChoice::kBoth,
                        {0.5 * (left.shape[0] + sign * right.shape[0]),
                         0.5 * (left.shape[1] + sign * right.shape[1]), left.shape[2]}};
      if (put_one_form_for(model, {std::min(a, b), std::max(a, b)}, {both})) return true;
    }
  return false;
}

}  // namespace

bool tell_as_waves_of_both_flanks(PartModel& model) {
  constexpr double kAlike = 0.02, kNone = 0.25;  // of their length; of a wave
  const EffectFamily *waviness = find_family("unnamed_waviness"),
                     *marks = find_family("unnamed_marks"),
                     *weighed = find_family("unnamed_crossed_waves");
  struct WaveOfOne {
    std::size_t effect = 0;
    double face = 0.0, length_mm = 0.0;
  };
  std::map<FlankChoice, std::vector<WaveOfOne>> waves;
  const double profile_mm =
      std::abs(model.geometry.tip_form_roll_mm() - model.geometry.root_form_roll_mm());
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const auto& [family, flank, shape] = model.effects[e];
    if (flank == FlankChoice::kBoth) continue;
    // (waves weighed by nothing are plain ones)
    if (family == waviness ||
        (family == weighed &&
         gear_effects::FlankCourse::at(shape, 2).kind == gear_effects::FlankCourse::kWhole &&
         gear_effects::AroundCourse::at(shape, 6).kind == gear_effects::AroundCourse::kEvery))
      waves[flank].push_back({e, shape[0], shape[1]});
    if (family != marks || shape[2] != 0.0) continue;
    if (std::abs(shape[0]) < kNone && std::abs(shape[1]) > kNone)
      waves[flank].push_back({e, 1.0, model.geometry.face_width_mm() / std::abs(shape[1])});
    if (std::abs(shape[1]) < kNone && std::abs(shape[0]) > kNone)
      waves[flank].push_back({e, 0.0, profile_mm / std::abs(shape[0])});
  }
  for (const WaveOfOne& left : waves[FlankChoice::kLeft])
    for (const WaveOfOne& right : waves[FlankChoice::kRight]) {
      if (left.face != right.face ||
          std::abs(left.length_mm - right.length_mm) > kAlike * left.length_mm)
        continue;
      std::vector<Effect> forms;
      for (const double times : {0.99, 0.995, 1.0, 1.005, 1.01})
        for (const double opposite : {0.0, 1.0})
          forms.push_back(
              {waviness,
               FlankChoice::kBoth,
               {left.face, 0.5 * times * (left.length_mm + right.length_mm), opposite}});
      if (put_one_form_for(
              model, {std::min(left.effect, right.effect), std::max(left.effect, right.effect)},
              forms))
        return true;
    }
  return tell_as_slant_waves_of_both_flanks(model);
}

}  // namespace trueflank::loop
