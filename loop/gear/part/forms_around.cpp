// SPDX-License-Identifier: GPL-3.0-or-later
// One form from tooth to tooth that values one a tooth (an index, runout) show beside one cause
// with a name: waves around the gear, chosen first, would take up parts of both.
#include "trueflank/loop/gear/part/forms_around.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/repeating_pattern.h"
#include "trueflank/loop/gear/fit/trial_fit.h"
#include "trueflank/loop/gear/local/repeating_patterns.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/stretching_waves_beside.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/remainder_around.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

struct BesideForms {
  std::vector<Effect> rest;
  std::vector<std::vector<Effect>> causes;
};

struct WavesAround {
  std::vector<std::size_t> waves, levels;
};

/// Orders and teeth that an effect is at, chosen among as many as there are teeth.
int places_of(const FlankGeometry& geometry, const Effect& effect) {
  if (effect.order() > 0.0 || effect.family->local) return 1;
  // (a pattern that closes around the gear begins anywhere)
  if (effect.family == find_family("unnamed_pattern") &&
      geometry.teeth() % static_cast<int>(effect.shape[gear_effects::kPatternEvery]) == 0)
    return 1;
  const std::vector<TermKey>& keys = effect.family->term_keys;
  return static_cast<int>(std::count_if(keys.begin(), keys.end(), [](const TermKey& key) {
    return key.kind == TermKey::Kind::kInteger && !key.name.ends_with("_degree");
  }));
}

/// What effects leave of so many values, and how many values and places they are told by, as -2 log
/// of likelihood where the noise is not known: an index that a form stands in shows no noise
/// without it.
double cost_around(const FlankGeometry& geometry, double count, double square,
                   const std::vector<Effect>& effects) {
  constexpr double kNothing = 1e-9;
  int places = 0;
  for (const Effect& effect : effects) places += places_of(geometry, effect);
  return count * std::log(std::max(square, kNothing * count)) +
         kChiSquareOfValue * values_of(effects, true) + 2.0 * places * std::log(geometry.teeth());
}

/// Says nothing of where on a flank: values one a tooth show it.
bool is_from_tooth_to_tooth(const Effect& effect) {
  const NeedsToBeSeen needs = effect.needs();
  return !needs.along_profile && !needs.along_face && !effect.family->tells_order_along_profile;
}

/// What stays, and the causes that may stand beside a form that goes from tooth to tooth: of
/// heights, those that the answer names, an eccentricity and the names of orders that it tells
/// without one, up to three at once; of slopes, one of those that the answer names and a tilt.
BesideForms beside_forms(const PartModel& model, const CourseOverFlanks& course) {
  const bool heights = course.profile == 0.0 && course.face == 0.0;
  const auto tilts = [](const Effect& effect) {
    return effect.family->displacement_mm && effect.columns() == 2 &&
           effect.needs().several_heights && !effect.family->shape_is_step;
  };
  const auto moves = [&](const Effect& effect) {
    return effect.family->named &&
           (heights ? moves_the_teeth(effect) && effect.shape.empty() : tilts(effect));
  };
  BesideForms found{.rest = {}, .causes = {{}}};
  std::vector<Effect> names;
  std::set<double> orders;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const EffectFamily& family = *effect.family;
    const bool around = heights ? is_from_tooth_to_tooth(effect)
                                : effect.order() > 0.0 || family.local || tilts(effect) ||
                                      !(family.named || (family.same_on_every_tooth &&
                                                         family.same_on_every_tooth(effect.shape)));
    if (e < first_told_here(model) || !around)
      found.rest.push_back(effect);
    else if (family.named)
      names.push_back(effect);
    else if (effect.order() > 0.0)
      orders.insert(effect.order());
  }
  const auto add = [&](const auto& is_one) {
    for (std::size_t c = 0; c < model.candidates.size(); ++c)
      if (is_one(model.candidates[c]) && !model.unseen[c] &&
          std::find(names.begin(), names.end(), model.candidates[c]) == names.end())
        names.push_back(model.candidates[c]);
  };
  add(moves);
  if (heights)
    add([&](const Effect& effect) {
      return effect.family->named && effect.flank == FlankChoice::kBoth && effect.columns() == 2 &&
             is_from_tooth_to_tooth(effect) && orders.contains(effect.order());
    });
  constexpr std::size_t kMostNames = 5, kMostAtOnce = 3;
  if (names.size() > kMostNames) names.resize(kMostNames);
  for (std::size_t name = 0; name < names.size(); ++name) {
    const std::size_t before = heights ? found.causes.size() : 1;
    for (std::size_t set = 0; set < before; ++set) {
      if (found.causes[set].size() == kMostAtOnce) continue;
      std::vector<Effect> with = found.causes[set];
      with.push_back(names[name]);
      found.causes.push_back(std::move(with));
    }
  }
  return found;
}

/// How many patterns there are to try: of every number of teeth, from every tooth on.
std::size_t patterns_tried(int teeth) {
  std::size_t tried = 0;
  for (int every = gear_effects::kFewestOfPattern; every <= gear_effects::most_of_pattern(teeth);
       ++every)
    tried += teeth % every == 0 ? 1 : static_cast<std::size_t>(teeth);
  return tried;
}

/// A pattern that repeats beside these: its teeth's values and what stands beside it are fitted to
/// each other in turn.
struct FittedPattern {
  Effect form;
  double square = kNaN, cost = kNaN;
};
/// `least`: what the best of other forms costs.
std::vector<FittedPattern> patterns_beside(const PartModel& model, const std::vector<Effect>& with,
                                           FlankChoice flank, bool opposite, double least) {
  constexpr std::size_t kMost = 3;
  constexpr double kHopeless = 30.0;  // of cost, above what another form leaves
  constexpr int kTurns = 6;
  const EffectFamily* const family = find_family("unnamed_pattern");
  const auto fit = fit_of(model, with);
  std::vector<FittedPattern> found;
  for (const EffectShape& shape : repeating_patterns(
           ValuesOfTeeth(model.geometry, model.table, *fit->residuals_um(), flank, opposite),
           opposite, kMost)) {
    FittedPattern pattern{{family, flank, shape}};
    for (int turn = 0; turn < kTurns; ++turn) {
      std::vector<Effect> all = with;
      all.push_back(pattern.form);
      const auto both = fit_of(model, all);
      const auto last = static_cast<int>(with.size());
      if (!(both->retained(both->first_column(last)) >= kToldApart)) break;
      pattern.square = both->residual_square();
      pattern.cost = cost_around(model.geometry, both->observations(), pattern.square, all);
      if (turn + 1 == kTurns || pattern.cost > least + kHopeless) break;
      // what it leaves, and the pattern as it was
      std::vector<float> residual_um = *both->residuals_um();
      const double amount = both->coefficients()[both->first_column(last)];
      for (std::size_t r = 0; r < residual_um.size(); ++r) {
        double column = 0.0;
        pattern.form.evaluate(model.geometry, model.table->place(model.table->rows[r]), &column);
        residual_um[r] += static_cast<float>(amount * column);
      }
      pattern.form.shape =
          with_means_of(pattern.form.shape,
                        ValuesOfTeeth(model.geometry, model.table, residual_um, flank, opposite));
    }
    if (!std::isnan(pattern.square)) found.push_back(std::move(pattern));
  }
  return found;
}

/// The forms from tooth to tooth of a course that leave least beside one cause or none, in place of
/// all that effects say of that; the best of its family, the best first.
std::vector<RemainderFinding> forms_around(const PartModel& model, const CourseOverFlanks& course,
                                           int teeth) {
  constexpr std::size_t kMost = 2;
  const auto [rest, beside] = beside_forms(model, course);
  std::vector<std::vector<Effect>> sets = forms_from_tooth_to_tooth(model.geometry.teeth(), course);
  if (course.profile == 0.0 && course.face == 0.0)
    for (const auto& [flank, opposite] :
         {std::pair(FlankChoice::kBoth, 0.0), std::pair(FlankChoice::kBoth, 1.0),
          std::pair(FlankChoice::kLeft, 0.0), std::pair(FlankChoice::kRight, 0.0)}) {
      sets.push_back(slips_around(model.geometry.teeth(), flank, opposite));
      if (flank != FlankChoice::kBoth) continue;
      for (std::vector<Effect>& set : slits_arches_bursts(model.geometry.teeth(), opposite))
        sets.push_back(std::move(set));
      sets.push_back(stretching_waves_beside(model, rest, beside, opposite != 0.0));
    }
  std::erase_if(sets, [](const std::vector<Effect>& set) { return set.empty(); });
  constexpr std::size_t kMovedEach = 4;  // and where each could come to
  std::size_t tried = 0;
  // (forms of which there are far more are no looks of the others)
  const auto is_of_many = [](const std::vector<Effect>& set) {
    return set.front().family == find_family("unnamed_cut_order") ||
           set.front().family == find_family("unnamed_changing_wave") ||
           set.front().family == find_family("unnamed_slip") ||
           set.front().family == find_family("unnamed_slit") ||
           set.front().family == find_family("unnamed_arch_around") ||
           set.front().family == find_family("unnamed_sectors");
  };
  const auto stretch = [](const std::vector<Effect>& set) {
    return set.front().family == find_family("unnamed_stretching_wave");
  };
  for (const std::vector<Effect>& set : sets)
    if (!is_of_many(set) && !stretch(set)) tried += kMovedEach * set.size() * beside.size();
  tried += beside.size() * patterns_tried(model.geometry.teeth());
  // Both flanks of a tooth may share their error: a value a tooth.
  const double none = fit_of(model, rest)->residual_square();
  const double count = fit_of(model, rest)->observations();
  const auto chance = [none, teeth](double square, int values, std::size_t looks) {
    const double degrees = teeth - values - 1.0;
    if (!(degrees > 0.0)) return 1.0;
    const double f = (none - square) / values / (std::max(square, 1e-12 * none) / degrees);
    return std::min(1.0, static_cast<double>(looks) * f_tail(f, values, degrees));
  };
  std::vector<std::pair<double, RemainderFinding>> found;
  for (const std::vector<Effect>& set : sets) {
    std::pair<double, RemainderFinding> best{kNaN, {}};
    std::vector<EffectShape> shapes;
    for (const Effect& form : set) shapes.push_back(form.shape);
    for (const std::vector<Effect>& names : beside) {
      std::vector<Effect> with = rest;
      with.insert(with.end(), names.begin(), names.end());
      with.push_back(set.front());
      const TrialFit fit(model.geometry, model.table, model.patches, with);
      const std::vector<TrialFit::Trial> trials = fit.with_shapes(with.size() - 1, shapes, 1e300);
      std::size_t least = shapes.size();
      double square = kNaN;
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (trials[i].square >= square || trials[i].retained < kToldApart) continue;
        square = trials[i].square;
        least = i;
      }
      if (least == shapes.size()) continue;
      Effect form = set[least];
      if (form.family->nearby)
        square = move_alone(model.geometry, fit, with.size() - 1, form.shape);
      with.back() = form;
      // (blocks look like swellings where the noise is large)
      constexpr double kOfBlocks = 25.0;
      const double cost = cost_around(model.geometry, count, square, with) +
                          (form.family == find_family("unnamed_sectors") ? kOfBlocks : 0.0);
      if (cost >= best.first) continue;
      best.first = cost;
      best.second.p_value = chance(square, values_of({form}, true) + values_of(names, true),
                                   stretch(set) ? looks_for_stretching_waves(model, beside.size())
                                   : is_of_many(set) ? kMovedEach * set.size() * beside.size()
                                                     : tried);
      best.second.effect = std::move(form);
    }
    if (best.second.effect) found.push_back(std::move(best));
  }
  double least = kNaN;
  for (const auto& [cost, finding] : found)
    if (!(cost >= least)) least = cost;
  if (course.profile == 0.0 && course.face == 0.0)
    for (const auto& [flank, opposite] :
         {std::pair(FlankChoice::kBoth, true), std::pair(FlankChoice::kBoth, false),
          std::pair(FlankChoice::kLeft, false), std::pair(FlankChoice::kRight, false)}) {
      std::pair<double, RemainderFinding> best{kNaN, {}};
      for (const std::vector<Effect>& names : beside) {
        std::vector<Effect> with = rest;
        with.insert(with.end(), names.begin(), names.end());
        for (FittedPattern& pattern : patterns_beside(model, with, flank, opposite, least)) {
          if (pattern.cost >= best.first) continue;
          best.first = pattern.cost;
          best.second.p_value = chance(
              pattern.square, values_of({pattern.form}, true) + values_of(names, true), tried);
          best.second.effect = std::move(pattern.form);
        }
      }
      if (best.second.effect) found.push_back(std::move(best));
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  // (one tooth in so many beside another form is a drift of teeth that are cut in such steps)
  const auto is_of = [](const RemainderFinding& one, const char* family) {
    return one.effect->family == find_family(family);
  };
  std::vector<RemainderFinding> starts;
  bool steps = false, comb = false;
  for (auto& [cost, finding] : found) {
    const bool is_comb = is_of(finding, "unnamed_comb");
    if (starts.size() >= kMost && !(steps && is_comb && !comb)) continue;
    steps = steps || is_of(finding, "unnamed_cut_order");
    comb = comb || is_comb;
    finding.square = cost;
    starts.push_back(std::move(finding));
  }
  return starts;
}

/// Waves from tooth to tooth on these flanks, and what lifts all of them alike.
WavesAround waves_around(const PartModel& model, FlankChoice flank) {
  WavesAround found;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.flank != flank || effect.family->local || effect.family->displacement_mm) continue;
    if (effect.order() > 0.0 && is_from_tooth_to_tooth(effect))
      found.waves.push_back(e);
    else if (runs_of(model.geometry, effect) == Runs::kNowhere)
      found.levels.push_back(e);
  }
  return found;
}

/// One of the forms for the waves whose order is a multiple, and the mean beside them or without
/// it.
bool put_form_for_multiples(PartModel& model, const WavesAround& around, int of, std::size_t fewest,
                            const std::vector<Effect>& forms) {
  std::vector<std::size_t> these;
  for (const std::size_t e : around.waves)
    if (std::remainder(model.effects[e].order(), double(of)) == 0.0) these.push_back(e);
  if (these.size() < fewest) return false;
  std::vector<std::size_t> with_levels = these;
  with_levels.insert(with_levels.end(), around.levels.begin(), around.levels.end());
  std::sort(with_levels.begin(), with_levels.end());
  return put_one_form_for(model, with_levels, forms) ||
         (!around.levels.empty() && put_one_form_for(model, these, forms));
}

bool has_pieces_that_cancel(const PartModel& model) {
  const auto fit = fit_of(model, model.effects);
  const auto is_part_of = [](const Effect& wave, const Effect& form) {
    return wave.family->named && wave.order() > 0.0 && !form.shape.empty() &&
           form.family->shape_names.front() == "number" &&
           std::remainder(wave.order(), form.shape[0]) == 0.0;
  };
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    for (int k = 0; k < model.effects[e].columns(); ++k)
      if (!(fit->retained(fit->first_column(static_cast<int>(e)) + k) >= kToldApart)) return true;
    for (const Effect& wave : model.effects)
      if (is_part_of(wave, model.effects[e])) return true;
  }
  return false;
}

void take_form_around(PartModel& model, const CourseOverFlanks& course, int teeth) {
  constexpr double kClearlyLess = 9.0;
  const auto cost = [](const PartModel& part) {
    const auto fit = fit_of(part, part.effects);
    return cost_around(part.geometry, fit->observations(), fit->residual_square(), part.effects);
  };
  const double own = cost(model);
  const bool seen = first_told_here(model) < model.effects.size();
  double least = own - kClearlyLess;
  std::unique_ptr<PartModel> best;
  for (const RemainderFinding& start : forms_around(model, course, teeth)) {
    if (!(start.square < own) && start.effect->family != find_family("unnamed_comb")) continue;
    if (!seen && start.p_value > kRemainderLevel / model.options.tables) continue;
    PartOptions options = model.options;
    options.given.resize(first_told_here(model));
    options.start = {start};
    auto other = std::make_unique<PartModel>(model.geometry, model.table, std::move(options));
    explain_part(*other);
    if (!(cost(*other) < least) || has_pieces_that_cancel(*other)) continue;
    least = cost(*other);
    best = std::move(other);
  }
  if (!best) return;
  model.alone = std::move(best->alone);
  take_over(model, *best);
}

/// What waves add up to on every tooth [um], on the flank that lies counter-clockwise.
std::vector<double> on_teeth_um(const PartModel& model, const std::vector<std::size_t>& waves) {
  const FlankGeometry& geometry = model.geometry;
  const auto fit = fit_of(model, model.effects);
  const double roll = 0.5 * (geometry.root_form_roll_mm() + geometry.tip_form_roll_mm());
  std::vector<double> um;
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth) {
    double& sum = um.emplace_back(0.0);
    for (const std::size_t e : waves) {
      std::array<double, 8> columns{};
      model.effects[e].evaluate(geometry,
                                geometry.on_flank(tooth, 1, roll, 0.5 * geometry.face_width_mm()),
                                columns.data());
      for (int c = 0; c < model.effects[e].columns(); ++c)
        sum += columns[static_cast<std::size_t>(c)] *
               fit->coefficients()[fit->first_column(static_cast<int>(e)) + c];
    }
  }
  return um;
}

/// Waves of both flanks, each tooth as it stands, of orders that are multiples; opposite on the
/// flanks, so that the teeth stand aside, or alike.
std::vector<std::size_t> multiples_of(const PartModel& model, int of, bool opposite) {
  const FlankGeometry& geometry = model.geometry;
  const double roll = 0.5 * (geometry.root_form_roll_mm() + geometry.tip_form_roll_mm()),
               middle = 0.5 * geometry.face_width_mm();
  std::vector<std::size_t> waves;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const bool alternates = effect.family == find_family("unnamed_alternation") &&
                            effect.shape[0] == 0.0 && effect.shape[1] == 0.0;
    if (effect.flank != FlankChoice::kBoth || effect.family->displacement_mm ||
        !(alternates || (is_wave_around(effect) && effect.columns() == 2)) ||
        std::remainder(alternates ? 0.5 * geometry.teeth() : effect.order(), double(of)) != 0.0)
      continue;
    std::array<double, 2> one{}, other{};
    effect.evaluate(geometry, geometry.on_flank(1, 1, roll, middle), one.data());
    effect.evaluate(geometry, geometry.on_flank(1, -1, roll, middle), other.data());
    if ((one[0] * other[0] + one[1] * other[1] < 0.0) == opposite) waves.push_back(e);
  }
  return waves;
}

/// The first teeth's values as a pattern, about their mean and of a mean square of 1.
Effect pattern_of(const std::vector<double>& um, int every, bool opposite) {
  std::vector<double> own(um.begin(), um.begin() + every);
  double mean = 0.0, square = 0.0;
  for (const double value : own) mean += value / every;
  for (const double value : own) square += (value - mean) * (value - mean) / every;
  EffectShape shape{double(every), 1.0, opposite ? 1.0 : 0.0};
  for (const double value : own) shape.push_back((value - mean) / std::sqrt(square));
  return {find_family("unnamed_pattern"), FlankChoice::kBoth, std::move(shape)};
}

}  // namespace

bool tell_as_repeating(PartModel& model) {
  const int z = model.geometry.teeth();
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
    const WavesAround around = waves_around(model, flank);
    if (around.waves.empty()) continue;
    for (int every = 3; every <= kMostOfComb; ++every) {
      if (z % every != 0) continue;
      std::vector<Effect> combs = combs_of(every, flank, 0.0);
      if (flank == FlankChoice::kBoth)
        for (Effect& aside : combs_of(every, flank, 1.0)) combs.push_back(std::move(aside));
      if (put_form_for_multiples(model, around, z / every, 1, combs)) return true;
    }
    std::vector<std::vector<Effect>> swellings(kMostSwellings + 1);
    for (Effect& form : swellings_around(z, flank))
      swellings[static_cast<std::size_t>(form.shape[0])].push_back(std::move(form));
    for (int number = 2; number <= kMostSwellings; ++number)
      if (put_form_for_multiples(model, around, number, 2,
                                 swellings[static_cast<std::size_t>(number)]))
        return true;
    for (int number = 2; number <= kMostSectors; ++number) {
      std::vector<Effect> sectors = sectors_around(z, flank, 0.0, number);
      if (flank == FlankChoice::kBoth)
        for (Effect& aside : sectors_around(z, flank, 1.0, number))
          sectors.push_back(std::move(aside));
      // (a few waves are swellings as well)
      if (put_form_for_multiples(model, around, number, 3, sectors)) return true;
    }
  }
  return false;
}

bool tell_as_swellings_at_end(PartModel& model) {
  constexpr std::size_t kFewestOfOne = 3;
  const EffectFamily* const swellings = find_family("unnamed_swellings_at_end");
  std::vector<std::size_t> waves, feet, others;
  int in_common = 0, lowest = 0;  // orders
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.family == swellings) {
      others.push_back(e);
      continue;
    }
    // (Waves of an order may have a phase of each flank.)
    const bool of_a_flank =
        effect.flank != FlankChoice::kBoth && effect.family != find_family("unnamed_crossed_order");
    if (of_a_flank || effect.family->local || effect.needs().along_profile ||
        (effect.family->displacement_mm && effect.order() == 0.0))
      continue;
    if (const int order = static_cast<int>(effect.order()); order > 0) {
      waves.push_back(e);
      in_common = std::gcd(in_common, order);
      if (effect.needs().along_face && effect.columns() == 2)
        lowest = lowest == 0 ? order : std::min(lowest, order);
    } else if (const Runs runs = runs_of(model.geometry, effect);
               (runs == Runs::kOverFace || runs == Runs::kNowhere) &&
               (!effect.family->named || effect.family->shape_is_continuous)) {
      feet.push_back(e);
    }
  }
  if (lowest == 0) return false;
  for (const int number : std::set<int>{in_common, lowest}) {
    if (number > kMostSwellings) continue;
    std::vector<std::size_t> these;
    for (const std::size_t e : waves)
      if (std::remainder(model.effects[e].order(), double(number)) == 0.0) these.push_back(e);
    for (const std::size_t e : others)  // more of them, as pieces
      if (std::remainder(model.effects[e].shape[0], double(number)) == 0.0) these.push_back(e);
    std::sort(these.begin(), these.end());
    if (number == 1 && these.size() < kFewestOfOne) continue;
    std::vector<std::size_t> all = these;
    all.insert(all.end(), feet.begin(), feet.end());
    std::sort(all.begin(), all.end());
    if (all.size() < 2) continue;
    const std::vector<Effect> forms = swellings_at_ends(model.geometry, number);
    if (put_one_form_for(model, all, forms) ||
        (!feet.empty() && put_one_form_for(model, these, forms)))
      return true;
  }
  return false;
}

void take_form_around(PartModel& model) {
  constexpr int kFewestTeeth = 8, kPieces = 3;
  if (!model.options.start.empty() || model.options.joined || model.options.names_only ||
      !model.table->points_mm.empty())
    return;
  std::map<ObservationKind, std::set<int>> teeth;
  for (const Patches::Patch& patch : model.patches.patches)
    if (patch.kind != ObservationKind::kSize)
      teeth[patch.kind].insert(patch.places.front().place.tooth);
  const auto teeth_of = [&](ObservationKind kind) {
    const auto found = teeth.find(kind);
    return found == teeth.end() ? 0 : static_cast<int>(found->second.size());
  };
  const bool traced = teeth_of(ObservationKind::kProfile) + teeth_of(ObservationKind::kHelix) > 0;
  if (!traced) {
    const int most =
        std::max(teeth_of(ObservationKind::kIndex), teeth_of(ObservationKind::kRadial));
    if (most >= kFewestTeeth) take_form_around(model, {}, most);
    return;
  }
  const auto pieces = std::count_if(
      model.effects.begin() + static_cast<std::ptrdiff_t>(first_told_here(model)),
      model.effects.end(), [](const Effect& effect) { return !effect.family->named; });
  if (pieces < kPieces) return;
  if (const int profiles = teeth_of(ObservationKind::kProfile); profiles >= kFewestTeeth)
    take_form_around(model, {.profile = 1.0}, profiles);
  if (const int helices = teeth_of(ObservationKind::kHelix); helices >= kFewestTeeth)
    take_form_around(model, {.face = 1.0}, helices);
}

bool add_form_that_is_left(PartModel& model) {
  constexpr double kSure = 1e-6, kClearly = 25.0;  // of chance, all places asked; of cost
  if (!has_single_values_only(model)) return false;
  for (const RemainderFinding& finding : model.remainder) {
    if (!finding.effect || finding.local || !(finding.p_value < kSure) ||
        !is_told_apart(model, *finding.effect, model.effects))
      continue;
    std::vector<Effect> with = model.effects;
    with.push_back(*finding.effect);
    refine_nearby(model.geometry, model.table, model.patches, with);
    // (the noise is taken for more than it is while such a form stands in it)
    const auto cost = [&](const std::vector<Effect>& effects) {
      const auto fit = fit_of(model, effects);
      return cost_around(model.geometry, fit->observations(), fit->residual_square(), effects);
    };
    if (cost(with) > cost(model.effects) - kClearly) continue;
    put_in_place_of(model, {}, with);
    model.discovery.chosen.back().p_value = finding.p_value;
    return true;
  }
  return false;
}

void tell_waves_as_pattern(PartModel& model) {
  constexpr int kFewest = 3, kMost = 8, kOfMachines = 7;
  constexpr double kNothing = 4.0;  // chi-square
  if (model.table->points_mm.empty() || model.options.joined) return;
  const int z = model.geometry.teeth();
  for (int every = kFewest; every <= kMost; ++every)
    for (const bool opposite : {true, false}) {
      if (z % every != 0 || z / every < 2) continue;
      const std::vector<std::size_t> waves = multiples_of(model, z / every, opposite);
      const bool alone = every == kFewest && z / every > kOfMachines;
      if (waves.size() < (alone ? 1U : 2U)) continue;
      std::vector<Effect> with;
      for (std::size_t e = 0; e < model.effects.size(); ++e)
        if (std::find(waves.begin(), waves.end(), e) == waves.end())
          with.push_back(model.effects[e]);
      with.push_back(pattern_of(on_teeth_um(model, waves), every, opposite));
      if (fit_of(model, with)->residual_square() >
          fit_of(model, model.effects)->residual_square() + kNothing)
        continue;
      put_in_place_of(model, waves, with);
      return;
    }
}

}  // namespace trueflank::loop
