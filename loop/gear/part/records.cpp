// SPDX-License-Identifier: GPL-3.0-or-later
// Values one a tooth (index, runout) are few beside those of traces and scans, and say what traces
// with zeros of their own, or a scan in a frame of its own, hardly show. What they say alone must
// not be lost in the joint answer.
#include "trueflank/loop/gear/part/records.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

bool is_one_a_tooth(const Observation& row) {
  return row.kind == ObservationKind::kIndex || row.kind == ObservationKind::kRadial;
}

/// The table with these values alone; its traces and sources keep their numbers.
Observations values_one_a_tooth(const Observations& table) {
  Observations single;
  single.traces = table.traces;
  single.poses = table.poses;
  single.pose_is_free = table.pose_is_free;
  for (const Observation& row : table.rows) {
    if (!is_one_a_tooth(row)) continue;
    single.rows.push_back(row);
    single.rows.back().first_place = static_cast<std::uint32_t>(single.places.size());
    for (std::uint32_t p = row.first_place; p < row.first_place + row.places; ++p) {
      single.places.push_back(table.places[p]);
      if (!table.sigmas_um.empty())
        single.sigmas_um.push_back(p < table.sigmas_um.size() ? table.sigmas_um[p] : kNaN);
    }
  }
  return single;
}

/// Of an index or a runout: what is left of it beside the effects that it shows alone, over what
/// its weight promises.
struct LeftOfRecord {
  double square = 0.0, values = 0.0;
};

using RecordKey = std::pair<ObservationKind, int>;  ///< with the source

std::map<RecordKey, LeftOfRecord> left_of_records(const Observations& table, const PointFit& fit) {
  std::map<RecordKey, LeftOfRecord> left;
  const auto row_um = fit.residuals_um();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    LeftOfRecord& of = left[{table.rows[i].kind, table.rows[i].source}];
    const double um = (*row_um)[i];
    of.square += um * um;
    of.values += 1.0;
  }
  return left;
}

/// Straight slopes over the profile or the face that come and go once per turn: in these traces
/// differ where another clamping, or a tilt, is in them too. Low degrees come first in complexity.
bool is_wave_of_slopes(const Effect& effect) {
  const NeedsToBeSeen needs = effect.needs();
  constexpr double kStraight = 1.5;
  return effect.is_term() && effect.order() == 1.0 && effect.family->complexity &&
         effect.family->complexity(effect.shape) < kStraight &&
         needs.along_profile != needs.along_face;
}

/// The same on the whole flank of every tooth.
bool is_constant_on_flanks(const Effect& effect) {
  const NeedsToBeSeen needs = effect.needs();
  return !effect.family->local && !needs.along_profile && !needs.along_face;
}

/// Takes out what the effects from `first_new` on say as well, forms without a name before names,
/// and of the new ones those that earn nothing.
void drop_what_new_ones_say(PartModel& model, std::size_t first_new) {
  constexpr double kIdle = 25.0, kDisplaced = 0.1;  // chi-square a column; share of what it earned
  const auto loss_of = [](const PointFit& fit, std::size_t e) {
    std::vector<bool> with(fit.effects().size(), true);
    with[e] = false;
    return fit.residual_square(with) - fit.residual_square();
  };
  const std::size_t told = first_told_here(model);
  std::vector<double> most(model.effects.size());  // what it may earn and still go
  const std::vector<Effect> old(model.effects.begin(),
                                model.effects.begin() + static_cast<std::ptrdiff_t>(first_new));
  const auto before = fit_of(model, old);
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    most[e] = kIdle * model.effects[e].columns();
    if (e < first_new) most[e] = std::min(most[e], kDisplaced * loss_of(*before, e));
  }
  while (model.effects.size() > told) {
    const auto fit = fit_of(model, model.effects);
    std::size_t idle = model.effects.size();
    double least = 0.0;
    for (std::size_t e = told; e < model.effects.size(); ++e) {
      const double loss = loss_of(*fit, e);
      if (loss > most[e]) continue;
      const bool term = model.effects[e].is_term();
      if (idle < model.effects.size() &&
          (term != model.effects[idle].is_term() ? !term : loss >= least))
        continue;
      idle = e;
      least = loss;
    }
    if (idle == model.effects.size()) return;
    remove_effect(model, idle);
    most.erase(most.begin() + static_cast<std::ptrdiff_t>(idle));
  }
}

/// Puts effects into the answer, in place of some of its own, and takes out what they make idle.
/// Kept where no more is left for the columns that it costs and the hold-out does not lose; false:
/// it is as it was.
bool adopt(PartModel& model, const std::vector<Effect>& more, const std::vector<double>& p_values,
           const std::vector<Effect>& instead_of = {}) {
  // Chi-square: five standard errors, and what a column takes out by chance; of the held-out error.
  constexpr double kClearly = 25.0, kByChance = 4.0, kNoLoss = 1e-3;
  const std::vector<Effect> effects = model.effects, given = model.options.given;
  const std::vector<ChosenGroup> chosen = model.discovery.chosen;
  const std::vector<double> given_p_values = model.given_p_values;
  for (const Effect& effect : instead_of)
    remove_effect(model, static_cast<std::size_t>(
                             std::find(model.effects.begin(), model.effects.end(), effect) -
                             model.effects.begin()));
  const std::size_t kept = model.effects.size();
  for (std::size_t e = 0; e < more.size(); ++e) {
    if (std::find(model.effects.begin(), model.effects.end(), more[e]) != model.effects.end())
      continue;
    ChosenGroup record;
    record.group = -1;
    record.p_value = p_values[e];
    model.effects.push_back(more[e]);
    model.discovery.chosen.push_back(record);
  }
  drop_what_new_ones_say(model, kept);
  const auto held_out_um = [&](const std::vector<Effect>& of) {
    return fit_of(model, of)->errors(std::vector<bool>(of.size(), true)).held_out_rms_um;
  };
  int columns = 0;
  for (const Effect& effect : model.effects) columns += effect.columns();
  for (const Effect& effect : effects) columns -= effect.columns();
  const double gain =
      fit_of(model, effects)->residual_square() - fit_of(model, model.effects)->residual_square();
  if (gain > kByChance * columns + (columns > 0 ? kClearly : 0.0) &&
      !(held_out_um(model.effects) > (1.0 + kNoLoss) * held_out_um(effects)))
    return true;
  model.effects = effects;
  model.discovery.chosen = chosen;
  model.options.given = given;
  model.given_p_values = given_p_values;
  return false;
}

/// Waves of the answer, constant on each flank, that values one a tooth alone do not tell, which
/// show nothing else: `alone` says what they show. Those with a name only where a form without one
/// stands for them there.
std::vector<Effect> waves_in_place_of(const PartModel& model, const std::vector<Effect>& alone) {
  const bool form = std::any_of(alone.begin(), alone.end(), [](const Effect& effect) {
    return effect.is_term() && effect.order() == 0.0;
  });
  std::vector<Effect> waves;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if ((form || model.effects[e].is_term()) && model.effects[e].order() > 0.0 &&
        is_constant_on_flanks(model.effects[e]) &&
        std::find(alone.begin(), alone.end(), model.effects[e]) == alone.end())
      waves.push_back(model.effects[e]);
  return waves;
}

/// Neighbours around the gear do not tell noise from a wave of few teeth: where the effects that
/// values one a tooth show alone leave clearly less of them, that is their noise. Returns the
/// weights as they were.
std::vector<double> weigh_single_values_by(PartModel& model, const PartModel& alone) {
  constexpr double kClearly = 0.5, kLeast_um2 = 1e-6;
  std::vector<double> weights;
  for (const Patches::Patch& patch : model.patches.patches) weights.push_back(patch.weight);
  double columns = 0.0;
  for (const Effect& effect : alone.effects) columns += effect.columns();
  const double all = static_cast<double>(alone.table->rows.size());
  const auto left = left_of_records(alone.table, *fit_of(alone, alone.effects));
  for (std::size_t i = 0; i < model.table->rows.size(); ++i) {
    const Observation& row = model.table->rows[i];
    if (!is_one_a_tooth(row) || model.patches.patch_of_row[i] < 0 ||
        !std::isnan(model.table->sigma_um(row)))
      continue;
    const LeftOfRecord& of = left.at({row.kind, row.source});
    const double zeros = row.kind == ObservationKind::kIndex ? 2.0 : 1.0;
    const double free = of.values - zeros - columns * of.values / all;
    if (!(free >= 1.0)) continue;
    const double variance = std::max(kLeast_um2, of.square / free);
    double& weight =
        model.patches.patches[static_cast<std::size_t>(model.patches.patch_of_row[i])].weight;
    if (variance < kClearly / weight) weight = 1.0 / variance;
  }
  forget_fits(model);
  return weights;
}

/// True where they entered the answer.
bool adopt_from_single_values(PartModel& model, const PartModel& alone, std::vector<Effect> more,
                              std::vector<double> p_values) {
  const bool traced = is_traced(model.table);
  const std::vector<Effect> without_slopes = more;
  for (std::size_t g = 0; traced && g < model.candidates.size(); ++g) {
    if (model.banned[g] || !is_wave_of_slopes(model.candidates[g]) ||
        std::find(model.effects.begin(), model.effects.end(), model.candidates[g]) !=
            model.effects.end())
      continue;
    more.push_back(model.candidates[g]);
    p_values.push_back(model.discovery.p_left);
  }
  const std::vector<Effect> waves = waves_in_place_of(model, alone.effects);
  if (!waves.empty() && adopt(model, more, p_values, waves)) return true;
  return adopt(model, more, p_values) || adopt(model, without_slopes, p_values);
}

/// A tooth that stands out less surely than this is none. Beside traces more is asked of one table:
/// forms, waves and teeth along these.
double tooth_by_chance(const PartModel& model) {
  return has_single_values_only(model) ? 0.005 : 0.002;
}

/// How likely one value is as far out as this one, whose like are `others`: by their tail, or among
/// them.
double chance_of_value(double size, const std::vector<double>& others) {
  const auto n = static_cast<double>(others.size());
  const double beyond = gap_beyond_tail_p_value(size, others);
  if (beyond < 1.0) return beyond / n;
  const auto further =
      std::count_if(others.begin(), others.end(), [&](double o) { return o >= size; });
  return std::min(1.0, (1.0 + static_cast<double>(further)) / (n + 1.0));
}

/// Correlation of the two values of a tooth.
double correlation_of_pairs(const std::vector<std::vector<double>>& pairs) {
  double a = 0.0, b = 0.0, n = 0.0, product = 0.0, square_a = 0.0, square_b = 0.0;
  for (const auto& pair : pairs) {
    a += pair[0];
    b += pair[1];
    n += 1.0;
  }
  for (const auto& pair : pairs) {
    product += (pair[0] - a / n) * (pair[1] - b / n);
    square_a += (pair[0] - a / n) * (pair[0] - a / n);
    square_b += (pair[1] - b / n) * (pair[1] - b / n);
  }
  return product / std::sqrt(std::max(square_a * square_b, 1e-300));
}

/// How likely both values of a tooth, one of each flank, stand out by chance together: a wild value
/// is that of one flank, long tails or not. Of the smaller one counts what the larger does not
/// foretell, as far as flanks of the other teeth may share their errors. 1 where these are opposite
/// on many teeth, or where a tooth has not two values.
double chance_of_both_flanks(const std::vector<double>& own_um,
                             const std::vector<std::vector<double>>& others_um) {
  constexpr double kTests = 2.0, kMostShared = 0.95, kOpposite = 0.3, kSeldom = 0.1;
  constexpr std::size_t kFewestTeeth = 12;
  const auto is_pair = [](const std::vector<double>& values) { return values.size() == 2; };
  if (!is_pair(own_um) || others_um.size() < kFewestTeeth ||
      !std::all_of(others_um.begin(), others_um.end(), is_pair))
    return 1.0;
  std::vector<double> sizes;
  for (const auto& pair : others_um)
    for (const double um : pair) sizes.push_back(std::abs(um));
  const auto n = static_cast<double>(others_um.size());
  const double correlation = correlation_of_pairs(others_um);
  if (correlation < -kOpposite) return 1.0;
  const double shared = std::clamp(correlation, 0.0, kMostShared);
  const double way = own_um[0] + own_um[1] > 0.0 ? 1.0 : -1.0;
  const auto [smaller, larger] = std::minmax({way * own_um[0], way * own_um[1]});
  const double beside = (smaller - shared * larger) / std::sqrt(1.0 - shared * shared);
  const double of_smaller = chance_of_value(beside, sizes);
  if (of_smaller > kSeldom) return 1.0;
  return std::min(1.0, kTests * (n + 1.0) * chance_of_value(larger, sizes) * of_smaller);
}

/// What single values say of a form of one tooth, and of the same of every other.
struct ScoresOfTeeth {
  double own = 0.0;  ///< size, as the others'
  std::vector<double> others;
  std::vector<int> teeth;  ///< of the others
  std::vector<double> own_um;
  std::vector<std::vector<double>> others_um;
};

ScoresOfTeeth scores_of_teeth(const Observations& table, const Effect& tooth,
                              const FlankGeometry& geometry, const std::vector<float>& row_um) {
  ScoresOfTeeth scores;
  Effect each = tooth;
  for (int k = 1; k <= geometry.teeth(); ++k) {
    each.shape[0] = k;
    double product = 0.0, square = 0.0, column = 0.0;
    std::vector<double> of_tooth_um;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const Observation& row = table.rows[i];
      if (!is_one_a_tooth(row)) continue;
      double of_row = 0.0;
      for (std::uint32_t p = 0; p < row.places; ++p) {
        each.evaluate(geometry, table.places[row.first_place + p], &column);
        of_row += row.weight * column;
      }
      product += of_row * row_um[i];
      square += of_row * of_row;
      if (of_row != 0.0) of_tooth_um.push_back(std::copysign(1.0, of_row) * row_um[i]);
    }
    if (!(square > 0.0)) continue;
    const double size = std::abs(product) / std::sqrt(square);
    if (k == static_cast<int>(tooth.shape[0])) {
      scores.own = size;
      scores.own_um = std::move(of_tooth_um);
    } else {
      scores.others.push_back(size);
      scores.teeth.push_back(k);
      scores.others_um.push_back(std::move(of_tooth_um));
    }
  }
  return scores;
}

double mean_square(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return squares / static_cast<double>(values.size());
}

/// What the other flank's teeth score, as loud as these: they tell of the same tails.
void add_other_flank(const Observations& table, Effect tooth, const FlankGeometry& geometry,
                     const std::vector<float>& row_um, ScoresOfTeeth& scores) {
  if (tooth.flank == FlankChoice::kBoth) return;
  tooth.flank = tooth.flank == FlankChoice::kLeft ? FlankChoice::kRight : FlankChoice::kLeft;
  ScoresOfTeeth there = scores_of_teeth(table, tooth, geometry, row_um);
  there.others.push_back(there.own);
  there.teeth.push_back(static_cast<int>(tooth.shape[0]));
  const double usual = mean_square(there.others);
  if (scores.others.empty() || !(usual > 0.0)) return;
  const double as_loud = std::sqrt(mean_square(scores.others) / usual);
  for (const double size : there.others) scores.others.push_back(size * as_loud);
  scores.teeth.insert(scores.teeth.end(), there.teeth.begin(), there.teeth.end());
}

/// How much louder every so manieth tooth is than the others, counted from this one on; 1 where
/// none clearly is.
double loudness_of_every(int tooth, const ScoresOfTeeth& scores) {
  constexpr int kFewestBetween = 2, kMostBetween = 8;
  constexpr std::size_t kFewest = 3;
  constexpr double kClearly = 0.01 / (kMostBetween - kFewestBetween + 1);
  double loudness = 1.0, least = kClearly;
  for (int every = kFewestBetween; every <= kMostBetween; ++every) {
    std::vector<double> these, rest;
    for (std::size_t i = 0; i < scores.others.size(); ++i)
      ((scores.teeth[i] - tooth) % every == 0 ? these : rest).push_back(scores.others[i]);
    if (these.size() < kFewest || rest.size() < kFewest) continue;
    const double ratio = mean_square(these) / mean_square(rest);
    const double p =
        f_tail(ratio, static_cast<double>(these.size()), static_cast<double>(rest.size()));
    if (!(p < least)) continue;
    least = p;
    loudness = std::sqrt(ratio);
  }
  return loudness;
}

/// How likely the tails of the teeth's own scores, or those of their values, reach as far as one
/// tooth does by chance.
double chance_of_tooth(const Observations& table, const Effect& tooth,
                       const FlankGeometry& geometry, const std::vector<float>& row_um) {
  const ScoresOfTeeth scores = scores_of_teeth(table, tooth, geometry, row_um);
  ScoresOfTeeth all = scores;
  add_other_flank(table, tooth, geometry, row_um, all);
  const double loudness = loudness_of_every(static_cast<int>(tooth.shape[0]), all);
  // (what both flanks have is asked twice: as one score, and as a pair)
  const double tests = tooth.flank == FlankChoice::kBoth ? 2.0 : 1.0;
  const double own = scores.own / loudness;
  const double number = tests * static_cast<double>(all.others.size() + 1);
  std::vector<double> own_um = scores.own_um;
  for (double& um : own_um) um /= loudness;
  return std::min({gap_beyond_tail_p_value(own, scores.others),
                   number * beyond_tails_alike_p_value(own, all.others),
                   chance_of_both_flanks(own_um, scores.others_um)});
}

/// The sizes of one tooth's single values, if nothing but they shows its height; empty otherwise.
std::vector<double> heights_of_single_values(const Observations& table, const Effect& tooth,
                                             const FlankGeometry& geometry,
                                             const std::vector<float>& row_um) {
  std::vector<double> heights;
  double column = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    if (row.kind == ObservationKind::kSize) continue;
    tooth.evaluate(geometry, table.place(row), &column);
    if (column == 0.0) continue;
    if (is_one_a_tooth(row))
      heights.push_back(std::abs(static_cast<double>(row_um[i])));
    else if (row.trace < 0)
      return {};
  }
  return heights;
}

/// Takes a tooth that one flank's values do not bear out as one that stands on both flanks, where
/// the values of both bear that out.
bool take_tooth_of_both_flanks(PartModel& model, std::size_t e) {
  const Effect one = model.effects[e];
  const Effect both{find_family("single_tooth"), FlankChoice::kBoth, one.shape};
  if (one.family != find_family("unnamed_flank") ||
      std::find(model.candidates.begin(), model.candidates.end(), both) == model.candidates.end())
    return false;
  Effect other = one;
  other.flank = one.flank == FlankChoice::kLeft ? FlankChoice::kRight : FlankChoice::kLeft;
  std::vector<Effect> without = model.effects;
  std::erase(without, one);
  std::erase(without, other);
  const auto left_um = PointFit(model.geometry, model.table, model.patches, without).residuals_um();
  if (chance_of_tooth(model.table, both, model.geometry, *left_um) > tooth_by_chance(model))
    return false;
  model.effects[e] = both;
  model.discovery.chosen[e].group = -1;
  const auto there = std::find(model.effects.begin(), model.effects.end(), other);
  if (there != model.effects.end())
    remove_effect(model, static_cast<std::size_t>(there - model.effects.begin()));
  forget_fits(model);
  return true;
}

/// The named effects as people read them.
std::vector<FoundEffect> told(const PartModel& model) {
  const auto fit = fit_of(model, model.effects);
  const ShapeUncertainty uncertainty =
      shape_uncertainty(model.geometry, model.table, model.patches, *fit);
  const std::vector<std::string> hidden = not_observable(model);
  std::vector<FoundEffect> found =
      describe_effects({model.geometry, *fit, model.discovery, model.candidates, uncertainty,
                        hidden, model.options.makings, model.unseen});
  std::erase_if(found, [](const FoundEffect& effect) { return !effect.named; });
  return found;
}

/// One wave, or one effect: ids, flanks and what has no interval (an order) agree.
bool is_the_same(const FoundEffect& a, const FoundEffect& b) {
  return a.named && a.id == b.id && a.flank == b.flank &&
         std::equal(a.parameters.begin(), a.parameters.end(), b.parameters.begin(),
                    b.parameters.end(), [](const Parameter& p, const Parameter& q) {
                      return p.name == q.name && (p.low < p.high || p.value == q.value);
                    });
}

/// A phase within half a period of another.
Parameter turned_towards(Parameter phase, const Parameter& other, double period) {
  const double turns = period * std::round((other.value - phase.value) / period);
  phase.value += turns;
  phase.low += turns;
  phase.high += turns;
  return phase;
}

}  // namespace

void hold_to_single_values(PartModel& model) {
  if (!is_traced(model.table) && model.table->points_mm.empty()) return;
  Observations single = values_one_a_tooth(model.table);
  if (single.rows.empty()) return;
  PartOptions options = model.options;
  options.given.resize(first_told_here(model));
  PartModel alone(model.geometry, std::move(single), std::move(options));
  explain_part(alone);
  model.alone = told(alone);
  std::vector<Effect> more;
  std::vector<double> p_values;
  const auto add = [&](const Effect& effect, double p_value) {
    if (std::find(model.effects.begin(), model.effects.end(), effect) != model.effects.end())
      return;
    more.push_back(effect);
    p_values.push_back(p_value);
  };
  for (std::size_t e = 0; e < alone.effects.size(); ++e)
    if (!alone.effects[e].family->local) add(alone.effects[e], alone.discovery.chosen[e].p_value);
  if (more.empty()) return;
  const std::vector<double> weights = weigh_single_values_by(model, alone);
  if (adopt_from_single_values(model, alone, std::move(more), std::move(p_values))) return;
  for (std::size_t i = 0; i < weights.size(); ++i) model.patches.patches[i].weight = weights[i];
  forget_fits(model);
}

void drop_teeth_within_the_tails(PartModel& model) {
  if (std::none_of(model.table->rows.begin(), model.table->rows.end(), is_one_a_tooth)) return;
  for (std::size_t e = model.effects.size(); e-- > model.options.given.size();) {
    if (!model.effects[e].family->local || model.effects[e].columns() != 1) continue;
    std::vector<Effect> without = model.effects;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
    const auto left_um =
        PointFit(model.geometry, model.table, model.patches, without).residuals_um();
    const std::vector<float>& after_um = *left_um;
    const std::vector<double> heights =
        heights_of_single_values(model.table, model.effects[e], model.geometry, after_um);
    if (heights.empty()) continue;
    if (chance_of_tooth(model.table, model.effects[e], model.geometry, after_um) >
        tooth_by_chance(model)) {
      if (!take_tooth_of_both_flanks(model, e)) remove_effect(model, e);
      continue;
    }
    std::vector<double> along, single;
    for (std::size_t i = 0; i < model.table->rows.size(); ++i)
      if (model.patches.patch_of_row[i] >= 0 && model.table->rows[i].kind != ObservationKind::kSize)
        (is_one_a_tooth(model.table->rows[i]) ? single : along)
            .push_back(std::abs(static_cast<double>(after_um[i])));
    const double usual_along = robust_sigma(along), usual_single = robust_sigma(single);
    if (!(usual_along > 0.0) || !(usual_single > 0.0)) continue;
    const auto share_further = [&](double height) {
      const double out = height / usual_single * usual_along;
      return static_cast<double>(
                 std::count_if(along.begin(), along.end(), [&](double um) { return um >= out; })) /
             static_cast<double>(along.size());
    };
    // Of one wild value, and of two that are wild on one tooth. None is as far out: no trace says
    // that such errors occur.
    const bool pair = heights.size() == 2;
    double expected = static_cast<double>(single.size()) / (pair ? 2.0 : 1.0);
    if (pair)
      expected *= share_further(heights[0]) * share_further(heights[1]);
    else
      expected *= share_further(*std::max_element(heights.begin(), heights.end()));
    if (expected > tooth_by_chance(model)) remove_effect(model, e);
  }
}

void say_where_records_differ(const std::vector<FoundEffect>& alone, LoopResult& result) {
  for (FoundEffect& joint : result.effects)
    for (const FoundEffect& single : alone) {
      if (!is_the_same(joint, single)) continue;
      const EffectFamily* family = find_family(joint.id);
      for (std::size_t k = 0; k < joint.parameters.size(); ++k) {
        Parameter& both = joint.parameters[k];
        Parameter one = single.parameters[k];
        if (family != nullptr && both.name == "phase_deg")
          one = turned_towards(one, both, 360.0 / family->phase_divisor);
        if (!(both.low < both.high) || (both.low <= one.high && one.low <= both.high)) continue;
        result.notes.push_back(joint.id + ", " + both.name +
                               printed(": values one a tooth (index, runout) alone say %.4g [%.4g, "
                                       "%.4g], with the traces it is %.4g [%.4g, %.4g]: they "
                                       "contradict each other, the interval holds both",
                                       one.value, one.low, one.high, both.value, both.low,
                                       both.high));
        both.low = std::min(both.low, one.low);
        both.high = std::max(both.high, one.high);
      }
    }
}

}  // namespace trueflank::loop
