// SPDX-License-Identifier: GPL-3.0-or-later
// What the chosen effects leave is searched for forms; what these and the hold-out say of the
// effects.
#include "trueflank/loop/gear/part/taken_up.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <vector>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/fit/flank_courses.h"
#include "trueflank/loop/gear/local/rotation_waves.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/clampings/clampings.h"
#include "trueflank/loop/gear/part/drifts.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/scans/bands.h"
#include "trueflank/loop/gear/part/scans/pixels.h"
#include "trueflank/loop/gear/part/scans/spirals.h"
#include "trueflank/loop/gear/part/waves.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/remainder_around.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

bool has_phases_of_its_order(const PartModel& model, const Effect& wave,
                             const std::vector<float>& row_um);
bool is_likeliest_order(PartModel& model, const Effect& wave, const std::vector<Effect>& beside);

/// The same around the gear without a course over the flanks; empty: it has none, or stays the same
/// around the gear.
std::optional<Effect> height_of(const Effect& effect) {
  const std::vector<std::string>& names = effect.family->shape_names;
  const auto first = std::find(names.begin(), names.end(), "profile_degree");
  if (first == names.end() || first == names.begin() || effect.order() > 0.0) return {};
  const auto k = static_cast<std::size_t>(first - names.begin());
  if (effect.shape[k] == 0.0 && effect.shape[k + 1] == 0.0) return {};
  Effect height = effect;
  height.shape[k] = height.shape[k + 1] = 0.0;
  return height;
}

/// A shape that was found takes the place of the nearest of its kind: between two of the grid it
/// would be told as other forms.
void put_on_the_grid(PartModel& model, const Effect& name) {
  Effect* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Effect& candidate : model.candidates) {
    if (candidate.family != name.family || candidate.flank != name.flank) continue;
    double off = 0.0;
    for (std::size_t k = 0; k < name.shape.size(); ++k)
      off += std::abs(candidate.shape[k] - name.shape[k]) / std::abs(name.shape[k]);
    if (!(off < least)) continue;
    least = off;
    nearest = &candidate;
  }
  if (nearest != nullptr && name.family->shape_is_continuous) nearest->shape = name.shape;
}

/// Effects with a name that do nearly the same on these data, the simplest first.
std::vector<Effect> names_alike(const PartModel& model, const Effect& form) {
  // Between two shapes of a grid the best one may lie that far from either.
  constexpr double kNearly = 0.9, kNearlyOffTheGrid = 0.75;
  std::vector<Effect> effects{form};
  std::vector<std::size_t> group;
  for (std::size_t g = 0; g < model.candidates.size(); ++g)
    if (model.candidates[g].family->named && !model.candidates[g].family->local &&
        !model.banned[g] && model.candidates[g].columns() == form.columns() &&
        (form.columns() == 1 || model.candidates[g].order() == form.order())) {
      effects.push_back(model.candidates[g]);
      group.push_back(g);
    }
  // Columns of names that were compared with another form are at hand.
  if (model.names.groups.empty())
    model.names = make_problem(model.geometry, model.table, model.patches, effects);
  else
    set_candidates(model.geometry, model.patches, model.names_of, effects, model.names);
  model.names_of = std::move(effects);
  const DiscoveryProblem& problem = model.names;
  const auto patches = static_cast<std::size_t>(problem.candidates.rows());
  std::map<int, std::size_t> numbers;
  std::vector<std::size_t> zero_of(patches);
  for (std::size_t i = 0; i < patches; ++i)
    zero_of[i] = numbers.try_emplace(problem.zero[i], numbers.size()).first->second;
  std::vector<double> weights(numbers.size(), 0.0), roots(patches);
  for (std::size_t i = 0; i < patches; ++i) {
    const double weight = problem.weight[static_cast<Eigen::Index>(i)];
    weights[zero_of[i]] += weight;
    roots[i] = std::sqrt(weight);
  }
  // Columns less their zeros, with the roots of the weights on. Neighbours together: their values
  // stand beside each other in a row, and their sums do not wait for each other.
  constexpr std::size_t kAtOnce = 8;
  const auto centred = [&](std::size_t first, std::size_t count) {
    std::array<Eigen::VectorXd, kAtOnce> columns;
    std::vector<std::array<double, kAtOnce>> sums(numbers.size());
    for (std::size_t k = 0; k < count; ++k) columns[k].resize(static_cast<Eigen::Index>(patches));
    const auto row_of = [&](std::size_t i) {
      return problem.candidates.row(static_cast<Eigen::Index>(i)).data() + first;
    };
    for (std::size_t i = 0; i < patches; ++i) {
      const float* const row = row_of(i);
      const double weight = problem.weight[static_cast<Eigen::Index>(i)];
      for (std::size_t k = 0; k < count; ++k)
        sums[zero_of[i]][k] += weight * static_cast<double>(row[k]);
    }
    for (std::size_t zero = 0; zero < sums.size(); ++zero)
      for (double& sum : sums[zero]) sum /= weights[zero];
    for (std::size_t i = 0; i < patches; ++i) {
      const float* const row = row_of(i);
      for (std::size_t k = 0; k < count; ++k)
        columns[k][static_cast<Eigen::Index>(i)] =
            (static_cast<double>(row[k]) - sums[zero_of[i]][k]) * roots[i];
    }
    return columns;
  };
  const auto own_columns = static_cast<std::size_t>(form.columns());
  const auto own = centred(0, own_columns);
  // Names do not ask each other: the same on any number of processors.
  std::vector<double> alike(model.names_of.size(), 1.0);
  const std::size_t names_at_once = kAtOnce / own_columns;
  for_each_run(model.names_of.size(), names_at_once, [&](std::size_t from, std::size_t to) {
    const auto others = centred(from * own_columns, (to - from) * own_columns);
    for (std::size_t effect = std::max<std::size_t>(from, 1); effect < to; ++effect)
      for (std::size_t k = 0; k < own_columns; ++k) {
        const Eigen::VectorXd& other = others[(effect - from) * own_columns + k];
        const double both = own[k].norm() * other.norm();
        alike[effect] =
            std::min(alike[effect], both > 0.0 ? std::abs(own[k].dot(other)) / both : 0.0);
      }
  });
  // Of shapes that are refined the nearest stands for all.
  std::vector<Effect> names;
  std::map<std::pair<const EffectFamily*, FlankChoice>, std::pair<std::size_t, double>> nearest;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Effect& name = model.candidates[group[i]];
    const bool off_the_grid = name.family->shape_is_continuous && !name.family->shape_is_step;
    const double like = alike[i + 1];
    if (!(like > (off_the_grid ? kNearlyOffTheGrid : kNearly))) continue;
    if (!off_the_grid) {
      names.push_back(name);
      continue;
    }
    const auto [known, is_new] = nearest.try_emplace({name.family, name.flank}, names.size(), like);
    if (is_new) {
      names.push_back(name);
    } else if (like > known->second.second) {
      names[known->second.first] = name;
      known->second.second = like;
    }
  }
  std::stable_sort(names.begin(), names.end(),
                   [](const Effect& a, const Effect& b) { return a.order() < b.order(); });
  return names;
}

/// The effect with a name that says what a finding says: at its best shape it takes out nearly as
/// much beside the others, with the right sign.
std::optional<Effect> name_like(const PartModel& model, const RemainderFinding& finding,
                                const std::vector<Effect>& beside) {
  // Chi-square; share of what the form takes out. A hollow with a place and a width of its own
  // comes nearer to any kink than that.
  const double kNothing = 9.0, kNearly = finding.effect->family->is_like_many ? 0.01 : 0.05;
  constexpr std::size_t kMostTried = 6;
  std::vector<Effect> names = names_alike(model, *finding.effect);
  if (names.empty()) return {};
  if (names.size() > kMostTried) names.resize(kMostTried);
  std::vector<Effect> with = beside;
  const double none = fit_of(model, with)->residual_square();
  with.push_back(*finding.effect);
  refine_nearby(model.geometry, model.table, model.patches, with);
  const double form = fit_of(model, with)->residual_square();
  for (const Effect& name : names) {
    with = beside;
    with.push_back(name);
    if (name.family->shape_is_continuous)
      refine_shapes(model.geometry, model.table, model.patches, with, beside.size());
    const auto fit = fit_of(model, with);
    if (fit->residual_square() > form + std::max(kNothing, kNearly * (none - form))) continue;
    if (is_possible(model.geometry, *fit, static_cast<int>(with.size()) - 1)) return with.back();
  }
  return {};
}

bool is_order_of_all_data(PartModel& model, std::size_t e) {
  const Effect wave = model.effects[e];
  std::vector<Effect> beside = model.effects;
  beside.erase(beside.begin() + static_cast<std::ptrdiff_t>(e));
  if (std::find(model.candidates.begin(), model.candidates.end(), wave) != model.candidates.end())
    return is_likeliest_order(model, wave, beside);
  // No candidate: found in the traces.
  const auto row_um = fit_of(model, beside)->residuals_um();
  std::vector<bool> used(model.table->rows.size());
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = model.patches.patch_of_row[i] >= 0;
  const double sense = model.geometry.sense();
  const RotationWave asked{.order = static_cast<int>(std::lround(wave.order())),
                           .side = wave.flank == FlankChoice::kBoth                      ? 0
                                   : (wave.flank == FlankChoice::kLeft) == (sense > 0.0) ? 1
                                                                                         : -1,
                           .backwards = wave.family->of_traces_only};
  if (chance_of_rotation_wave(model.geometry, model.table, *row_um, used, asked) <= kRemainderLevel)
    return true;
  // Of few teeth that says nothing.
  const bool twin = std::any_of(beside.begin(), beside.end(), [&](const Effect& other) {
    return other.family == wave.family && other.shape == wave.shape;
  });
  return twin && has_phases_of_its_order(model, wave, *row_um);
}

/// True where a wave of the traces of one flank takes nearly as much out of them as one of its
/// length in a phase of its own on every tooth does: by chance the phases of three teeth or more
/// seldom are those of an order.
bool has_phases_of_its_order(const PartModel& model, const Effect& wave,
                             const std::vector<float>& row_um) {
  constexpr double kNearly = 0.9;
  constexpr std::size_t kFewestTeeth = 3;
  struct Row {
    int tooth = 0;
    Eigen::Vector3d values;  // of both columns, and what is left without the wave
  };
  std::map<int, std::vector<Row>> traces;
  for (std::size_t i = 0; i < model.table->rows.size(); ++i) {
    const Observation& row = model.table->rows[i];
    const Place& place = model.table->place(row);
    if (row.trace < 0 || model.patches.patch_of_row[i] < 0 ||
        wave.flank != flank_choice(model.geometry, place.side > 0 ? 1 : 0))
      continue;
    double c[2];
    wave.evaluate(model.geometry, place, c);
    traces[row.trace].push_back({place.tooth, {c[0], c[1], row_um[i]}});
  }
  const auto taken = [](const Eigen::Matrix3d& sums) {
    const double determinant = sums(0, 0) * sums(1, 1) - sums(0, 1) * sums(0, 1);
    if (!(determinant > 0.0)) return 0.0;
    const double p = sums(0, 2), q = sums(1, 2);
    return (p * p * sums(1, 1) - 2.0 * p * q * sums(0, 1) + q * q * sums(0, 0)) / determinant;
  };
  std::map<int, Eigen::Matrix3d> of_teeth;
  for (const auto& [trace, rows] : traces) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Row& row : rows) mean += row.values / static_cast<double>(rows.size());
    Eigen::Matrix3d& sums =
        of_teeth.try_emplace(rows.front().tooth, Eigen::Matrix3d::Zero()).first->second;
    for (const Row& row : rows) sums += (row.values - mean) * (row.values - mean).transpose();
  }
  if (of_teeth.size() < kFewestTeeth) return false;
  Eigen::Matrix3d together = Eigen::Matrix3d::Zero();
  double apart = 0.0;
  for (const auto& [tooth, sums] : of_teeth) {
    together += sums;
    apart += taken(sums);
  }
  return taken(together) >= kNearly * apart;
}

/// By flips of all the data, against the other orders of its family on its flanks.
bool is_likeliest_order(PartModel& model, const Effect& wave, const std::vector<Effect>& beside) {
  constexpr double kSame = 2.0, kOwn = 0.8;
  DiscoveryProblem& problem = candidates_problem(model);
  const Eigen::Index of_pose = problem.nuisance.cols();
  if (!beside.empty())
    add_nuisance(problem, make_problem(model.geometry, model.table, model.patches, beside));
  const std::vector<int> folds = problem.fold;
  std::replace(problem.fold.begin(), problem.fold.end(), 0, 1);
  DiscoveryOptions options;
  options.most_effects = 0;
  options.banned.assign(model.candidates.size(), true);
  for (std::size_t g = 0; g < model.candidates.size(); ++g)
    if (model.candidates[g].family == wave.family && model.candidates[g].flank == wave.flank)
      options.banned[g] = model.banned[g] && !(model.candidates[g] == wave);
  const DiscoveryResult all = discover(problem, options);
  problem.fold = folds;
  problem.nuisance.conservativeResize(Eigen::NoChange, of_pose);
  if (all.p_left > kNextLevel / model.options.tables || all.most_likely_left < 0) return false;
  const Effect& most_likely = model.candidates[static_cast<std::size_t>(all.most_likely_left)];
  if (std::abs(most_likely.order() - wave.order()) <= kSame) return true;
  // On few teeth, or over short profiles, orders look alike.
  const PointFit both(model.geometry, model.table, model.patches, {most_likely, wave});
  return both.retained(both.first_column(1)) < kOwn;
}

/// Spots that a surer form of the same tooth and flank consists of: crests of a wave.
bool is_part_of_a_surer(const std::vector<RemainderFinding>& all, const RemainderFinding& one) {
  return std::any_of(all.begin(), all.end(), [&](const RemainderFinding& other) {
    return other.effect && other.local && other.effect->family != one.effect->family &&
           other.effect->flank == one.effect->flank && other.p_value < one.p_value &&
           other.effect->shape.front() == one.effect->shape.front();
  });
}

/// A place on one flank (a burr) without which far more is left than chance takes out.
bool is_spot_beyond_doubt(const PointFit& fit, std::size_t effect) {
  constexpr double kBeyondDoubt = 100.0;  // chi-square: ten standard errors
  const EffectFamily& family = *fit.effects()[effect].family;
  if (!family.flank_only || family.named || !family.nearby) return false;
  std::vector<bool> with(fit.effects().size(), true);
  with[effect] = false;
  return fit.residual_square(with) - fit.residual_square() > kBeyondDoubt;
}

}  // namespace

const std::vector<RemainderFinding>& remainder_of(PartModel& model,
                                                  const std::vector<Effect>& effects,
                                                  RemainderOf which) {
  const auto same = [](const Effect& a, const Effect& b) {
    return a.family == b.family && a.flank == b.flank && a.shape == b.shape;
  };
  if (!model.kept.valid || !std::equal(effects.begin(), effects.end(), model.kept.effects.begin(),
                                       model.kept.effects.end(), same)) {
    model.kept = {.valid = true, .effects = effects, .row_um = {}, .findings = {}};
    const auto fit = fit_of(model, effects);
    model.kept.row_um = fit->residuals_um();
    if (fit == model.plain_fit) model.plain_um = model.kept.row_um;
  }
  auto& findings = model.kept.findings[which == RemainderOf::kAll ? 1 : 0];
  if (!findings) {
    model.names = {};  // both would take memory at once
    findings =
        look_at_remainder(model.geometry, model.table, model.patches, *model.kept.row_um, which);
  }
  return *findings;
}

void nominate(PartModel& model) {
  constexpr int kMostWaves = 6;
  for (const RemainderFinding& finding : model.options.start) take_up(model, finding);
  if (const auto drift = drift_over_traces(model)) take_up(model, *drift);
  for (const RemainderFinding& clamping : clampings_of_files(model)) take_up(model, clamping);
  for (const RemainderFinding& pixels : pixels_of_plane(model)) take_up(model, pixels);
  for (const RemainderFinding& march : marching_waves(model)) take_up(model, march);
  if (const auto bands = bands_of_flanks(model)) take_up(model, *bands);
  if (const auto spiral = spiral_of_flanks(model)) take_up(model, *spiral);
  for (const RemainderFinding& wave : waves_of_odd_course(model)) take_up(model, wave);
  for (int round = 0; round < kMostWaves; ++round) {
    const auto& findings = remainder_of(model, model.options.given, RemainderOf::kTraining);
    const auto wave = std::find_if(findings.begin(), findings.end(), [](const auto& finding) {
      return finding.effect && finding.effect->family->tells_order_along_profile;
    });
    if (wave == findings.end()) break;
    const Effect& seen = *wave->effect;
    // Beside larger effects that are not fitted yet it may stay where it was.
    if (!is_told_apart(model, seen, model.options.given)) break;
    const bool possible = can_have(model.options.makings, *seen.family);
    const Effect as_form{find_form(seen.family->form_word), seen.flank, seen.shape};
    RemainderFinding taken = *wave;
    if (!possible) taken.effect = as_form;
    take_up(model, taken);
  }
  for (const RemainderFinding& finding :
       remainder_of(model, model.options.given, RemainderOf::kTraining)) {
    if (!finding.effect || finding.local || !finding.effect->family->shapes(model.geometry).empty())
      continue;
    // What stands beside a slope is no candidate beside all others, which it would hide as often:
    // it is where the choice begins anew, should it end in pieces.
    if (finding.beside_line) {
      model.beside_slopes.push_back(finding);
      continue;
    }
    if (const std::optional<Effect> name = name_like(model, finding, model.options.given)) {
      put_on_the_grid(model, *name);
      continue;
    }
    add_candidate(model, *finding.effect);
    // What forms teeth otherwise may lift them, too.
    if (const std::optional<Effect> height = height_of(*finding.effect);
        height && !model.table->points_mm.empty())
      add_candidate(model, *height);
  }
}

bool is_told_apart(const PartModel& model, const Effect& effect,
                   const std::vector<Effect>& beside) {
  std::vector<Effect> with = beside;
  with.push_back(effect);
  const auto fit = fit_of(model, with);
  const int first = fit->first_column(static_cast<int>(beside.size()));
  for (int k = 0; k < effect.columns(); ++k)
    if (!(fit->retained(first + k) >= kToldApart)) return false;
  return true;
}

void take_up(PartModel& model, const RemainderFinding& finding) {
  model.options.given.push_back(*finding.effect);
  model.given_p_values.push_back(finding.p_value);
  ban_given(model);
}

bool take_up_again(PartModel& model, const std::vector<Effect>& before) {
  constexpr double kFar = 100.0;  // chi-square a column
  for (const Effect& name : before) {
    const auto at = std::find(model.candidates.begin(), model.candidates.end(), name);
    if (!name.family->named || !name.family->displacement_mm || name.columns() != 2 ||
        name.family->shape_is_continuous || at == model.candidates.end() ||
        model.banned[static_cast<std::size_t>(at - model.candidates.begin())] ||
        std::find(model.effects.begin(), model.effects.end(), name) != model.effects.end() ||
        !is_told_apart(model, name, model.effects))
      continue;
    std::vector<Effect> with = model.effects;
    with.push_back(name);
    const double gain =
        fit_of(model, model.effects)->residual_square() - fit_of(model, with)->residual_square();
    if (gain < kFar * name.columns()) continue;
    RemainderFinding finding;
    finding.p_value = std::exp(-minus_log_chi_square_tail(gain, name.columns()));
    finding.effect = name;
    take_up(model, finding);
    return true;
  }
  return false;
}

bool take_up_remainder(PartModel& model) {
  constexpr int kAtOnce = 4;
  std::vector<Effect> effects = model.effects;
  const auto known = [&](const Effect& found) {
    return std::any_of(effects.begin(), effects.end(), [&](const Effect& e) {
      return e.family == found.family && e.flank == found.flank && e.shape == found.shape;
    });
  };
  const auto take_first = [&](RemainderOf which, bool local) {
    const std::vector<RemainderFinding> findings = remainder_of(model, effects, which);
    for (RemainderFinding finding : findings) {
      if (!finding.effect || finding.local != local) continue;
      if (local && is_part_of_a_surer(findings, finding)) continue;
      // what a name says is told by its name, if the way of making can have it
      const EffectFamily& family = *finding.effect->family;
      if (family.named && !can_have(model.options.makings, family))
        finding.effect->family = find_form(family.form_word);
      else if (!local && !family.named)
        if (const std::optional<Effect> name = name_like(model, finding, effects))
          finding.effect = *name;
      if (known(*finding.effect) || !is_told_apart(model, *finding.effect, effects)) continue;
      effects.push_back(*finding.effect);
      // At its place, or the next one found would be what this one leaves beside it.
      if (local && family.nearby) {
        const TrialFit fit = fit_to_refine(model.geometry, model.table, model.patches, effects);
        move_alone(model.geometry, fit, effects.size() - 1, effects.back().shape);
        finding.effect = effects.back();
      }
      take_up(model, finding);
      return true;
    }
    return false;
  };
  int taken = 0;
  while (taken < kAtOnce && take_first(RemainderOf::kTraining, false)) ++taken;
  // What stands on one tooth cannot be learnt from others: from all the data. Beside forms that
  // were just taken up, and that the choice has not settled yet, a tooth where one begins looks
  // odd.
  if (taken > 0) {
    model.names = {};
    return true;
  }
  while (taken < kAtOnce && take_first(RemainderOf::kAll, true)) ++taken;
  model.names = {};
  return taken > 0;
}

LeastMissed least_missed(const PartModel& model, std::size_t first, std::size_t end,
                         const std::function<bool(const Effect&)>& is_asked) {
  const auto fit = fit_of(model, model.effects);
  LeastMissed found;
  for (std::size_t e = first; e < end; ++e) {
    if (!is_asked(model.effects[e])) continue;
    std::vector<bool> with(model.effects.size(), true);
    with[e] = false;
    const double loss = fit->residual_square(with) - fit->residual_square();
    if (loss < found.loss) found = {e, loss};
  }
  return found;
}

bool drop_doubtful_orders(PartModel& model) {
  const std::size_t told = first_told_here(model);
  bool any = false;
  for (std::size_t e = model.effects.size(); e-- > told;) {
    const EffectFamily& family = *model.effects[e].family;
    if (!family.named || !family.tells_order_along_profile || is_order_of_all_data(model, e))
      continue;
    any = true;
    if (e < model.options.given.size()) {
      model.options.given.erase(model.options.given.begin() + static_cast<std::ptrdiff_t>(e));
      model.given_p_values.erase(model.given_p_values.begin() +
                                 static_cast<std::ptrdiff_t>(e - told));
      model.discovery.chosen.erase(model.discovery.chosen.begin() + static_cast<std::ptrdiff_t>(e));
      model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(e));
      continue;
    }
    for (std::size_t g = 0; g < model.candidates.size(); ++g)
      if (model.candidates[g] == model.effects[e]) model.banned[g] = true;
  }
  return any;
}

bool ban_alike(PartModel& model, const Effect& effect) {
  bool any = false;
  for (std::size_t g = 0; g < model.candidates.size(); ++g)
    if (model.candidates[g].family == effect.family && model.candidates[g].flank == effect.flank &&
        !model.banned[g])
      model.banned[g] = any = true;
  return any;
}

bool ban_what_forms_explain(PartModel& model) {
  constexpr double kHangs = 0.25;
  const auto is_form = [&](const Effect& e) {
    return e.is_term() && e.family->shapes && e.family->shapes(model.geometry).empty() &&
           !moves_teeth_aside(e);
  };
  std::vector<Effect> without;
  std::copy_if(model.effects.begin(), model.effects.end(), std::back_inserter(without),
               [&](const Effect& e) { return !is_form(e); });
  if (without.size() == model.effects.size()) return false;
  // What all flanks stand out by may change with a form: it is free in both.
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  std::vector<Effect> with = model.effects;
  if (is_told_apart(model, level, model.effects)) {
    with.push_back(level);
    without.push_back(level);
  }
  const auto fit = fit_of(model, with), fit_without = fit_of(model, without);
  const PointFit &full = *fit, &bare = *fit_without;
  bool any = false;
  int at = 0;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (is_form(effect)) continue;
    const int own = at++;
    if (!effect.family->named || effect.family->local || stands_beside_forms(model, full, e))
      continue;
    const auto b =
        full.coefficients().segment(full.first_column(static_cast<int>(e)), effect.columns());
    const auto b0 = bare.coefficients().segment(bare.first_column(own), effect.columns());
    if ((b - b0).norm() <= kHangs * std::max(b.norm(), b0.norm())) continue;
    any = ban_alike(model, effect) || any;
    // What could not be told from it is no better.
    for (const int group : model.discovery.chosen[e].confounded)
      if (model.candidates[group].family->named)
        any = ban_alike(model, model.candidates[group]) || any;
  }
  return any;
}

void veto(PartModel& model) {
  constexpr double kClearly = 0.98, kNoLoss = 1e-3;
  const std::size_t told = first_told_here(model);
  while (model.effects.size() > told) {
    const auto fit = fit_of(model, model.effects);
    if (fit->held_out() == 0) return;
    std::vector<bool> with(model.effects.size(), true);
    const double full = fit->errors(with).held_out_rms_um;
    // Together they may harm where none does alone.
    const double none = plain_fit(model)->errors({}).held_out_rms_um;
    // (what a few teeth have the values held out may not have at all)
    const bool on_few =
        std::any_of(model.effects.begin(), model.effects.end(), gear_effects::is_of_teeth);
    const bool rises = full > (on_few ? 1.0 + kNoLoss : 1.0) * none;
    double least = rises ? 1e300 : kClearly * full;
    std::size_t worst = model.effects.size();
    for (std::size_t e = told; e < model.effects.size(); ++e) {
      if (model.effects[e].family->local && !rises) continue;
      with[e] = false;
      const double error = fit->errors(with).held_out_rms_um;
      with[e] = true;
      if (error >= least) continue;
      least = error;
      worst = e;
    }
    if (worst == model.effects.size()) return;
    if (is_spot_beyond_doubt(*fit, worst)) model.denied_spot = model.effects[worst];
    model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(worst));
    model.discovery.chosen.erase(model.discovery.chosen.begin() +
                                 static_cast<std::ptrdiff_t>(worst));
    if (worst < model.options.given.size()) {
      model.options.given.erase(model.options.given.begin() + static_cast<std::ptrdiff_t>(worst));
      model.given_p_values.erase(model.given_p_values.begin() +
                                 static_cast<std::ptrdiff_t>(worst - told));
    }
    model.vetoed = true;
    // deviations about a displacement that is taken back
    if (!moves_points(model) && !model.table->points_mm.empty() && !put_points_back(model))
      leave_out_across_steps(model);
  }
}

}  // namespace trueflank::loop
