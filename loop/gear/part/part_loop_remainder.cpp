// SPDX-License-Identifier: GPL-3.0-or-later
// What the chosen effects leave is searched for forms; what these and the hold-out say of the
// effects.
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
#include "trueflank/loop/gear/local/rotation_waves.h"
#include "trueflank/loop/gear/part/flank_courses.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/remainder_around.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {

/// Asked for the same effects again, the answer is kept.
const std::vector<RemainderFinding>& PartLoop::remainder_of(const std::vector<Effect>& effects,
                                                            RemainderOf which) {
  const auto same = [](const Effect& a, const Effect& b) {
    return a.family == b.family && a.flank == b.flank && a.shape == b.shape;
  };
  if (!kept_.valid || !std::equal(effects.begin(), effects.end(), kept_.effects.begin(),
                                  kept_.effects.end(), same)) {
    kept_ = {.valid = true, .effects = effects, .row_um = {}, .findings = {}};
    const auto fit = fit_of(effects);
    kept_.row_um = fit->residuals_um();
    if (fit == plain_fit_) plain_um_ = kept_.row_um;
  }
  auto& findings = kept_.findings[which == RemainderOf::kAll ? 1 : 0];
  if (!findings) {
    names_ = {};  // both would take memory at once
    findings = look_at_remainder(geometry_, table_, patches_, *kept_.row_um, which);
  }
  return *findings;
}

namespace {

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

}  // namespace

/// Waves over the generating rotation that the candidates do not have are taken up at once: beside
/// the candidates alone many others imitate them. Forms that the data as they are show, so that a
/// sector or a step stands beside the waves that would otherwise imitate it: candidates like all
/// others.
void PartLoop::nominate() {
  constexpr int kMostWaves = 6;
  for (const RemainderFinding& finding : options_.start) take_up(finding);
  for (int round = 0; round < kMostWaves; ++round) {
    const auto& findings = remainder_of(options_.given, RemainderOf::kTraining);
    const auto wave = std::find_if(findings.begin(), findings.end(), [](const auto& finding) {
      return finding.effect && finding.effect->family->tells_order_along_profile;
    });
    if (wave == findings.end()) break;
    const Effect& seen = *wave->effect;
    // Beside larger effects that are not fitted yet it may stay where it was.
    if (!is_told_apart(seen, options_.given)) break;
    const bool possible = can_have(options_.makings, *seen.family);
    const Effect as_form{find_form(seen.family->form_word), seen.flank, seen.shape};
    RemainderFinding taken = *wave;
    if (!possible) taken.effect = as_form;
    take_up(taken);
  }
  for (const RemainderFinding& finding : remainder_of(options_.given, RemainderOf::kTraining)) {
    if (!finding.effect || finding.local || !finding.effect->family->shapes(geometry_).empty())
      continue;
    // What stands beside a slope is no candidate beside all others, which it would hide as often:
    // it is where the choice begins anew, should it end in pieces.
    if (finding.beside_line) {
      beside_slopes_.push_back(finding);
      continue;
    }
    if (const std::optional<Effect> name = name_like(finding, options_.given)) {
      put_on_the_grid(*name);
      continue;
    }
    add_candidate(*finding.effect);
    // What forms teeth otherwise may lift them, too.
    if (const std::optional<Effect> height = height_of(*finding.effect);
        height && !table_->points_mm.empty())
      add_candidate(*height);
  }
}

void PartLoop::add_candidate(Effect effect) {
  candidates_.push_back(std::move(effect));
  banned_.push_back(false);
  unseen_.push_back(false);
}

/// A shape that was found takes the place of the nearest of its kind: between two of the grid it would
/// be told as other forms.
void PartLoop::put_on_the_grid(const Effect& name) {
  Effect* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Effect& candidate : candidates_) {
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
std::vector<Effect> PartLoop::names_alike(const Effect& form) const {
  // Between two shapes of a grid the best one may lie that far from either.
  constexpr double kNearly = 0.9, kNearlyOffTheGrid = 0.75;
  std::vector<Effect> effects{form};
  std::vector<std::size_t> group;
  for (std::size_t g = 0; g < candidates_.size(); ++g)
    if (candidates_[g].family->named && !candidates_[g].family->local && !banned_[g] &&
        candidates_[g].columns() == form.columns() &&
        (form.columns() == 1 || candidates_[g].order() == form.order())) {
      effects.push_back(candidates_[g]);
      group.push_back(g);
    }
  // Columns of names that were compared with another form are at hand.
  if (names_.groups.empty())
    names_ = make_problem(geometry_, table_, patches_, effects);
  else
    set_candidates(geometry_, patches_, names_of_, effects, names_);
  names_of_ = std::move(effects);
  const DiscoveryProblem& problem = names_;
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
  std::vector<double> alike(names_of_.size(), 1.0);
  const std::size_t names_at_once = kAtOnce / own_columns;
  for_each_run(names_of_.size(), names_at_once, [&](std::size_t from, std::size_t to) {
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
    const Effect& name = candidates_[group[i]];
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
std::optional<Effect> PartLoop::name_like(const RemainderFinding& finding,
                                          const std::vector<Effect>& beside) const {
  // Chi-square; share of what the form takes out. A hollow with a place and a width of its own comes
  // nearer to any kink than that.
  const double kNothing = 9.0, kNearly = finding.effect->family->is_like_many ? 0.01 : 0.05;
  constexpr std::size_t kMostTried = 6;
  std::vector<Effect> names = names_alike(*finding.effect);
  if (names.empty()) return {};
  if (names.size() > kMostTried) names.resize(kMostTried);
  std::vector<Effect> with = beside;
  const double none = fit_of(with)->residual_square();
  with.push_back(*finding.effect);
  refine_nearby(geometry_, table_, patches_, with);
  const double form = fit_of(with)->residual_square();
  for (const Effect& name : names) {
    with = beside;
    with.push_back(name);
    if (name.family->shape_is_continuous)
      refine_shapes(geometry_, table_, patches_, with, beside.size());
    const auto fit = fit_of(with);
    if (fit->residual_square() > form + std::max(kNothing, kNearly * (none - form))) continue;
    if (is_possible(geometry_, *fit, static_cast<int>(with.size()) - 1)) return with.back();
  }
  return {};
}

/// True where what an effect does is not nearly what others do together.
bool PartLoop::is_told_apart(const Effect& effect, const std::vector<Effect>& beside) const {
  std::vector<Effect> with = beside;
  with.push_back(effect);
  const auto fit = fit_of(with);
  const int first = fit->first_column(static_cast<int>(beside.size()));
  for (int k = 0; k < effect.columns(); ++k)
    if (!(fit->retained(first + k) >= kToldApart)) return false;
  return true;
}

/// The finding enters the model, and all else is chosen anew beside it.
void PartLoop::take_up(const RemainderFinding& finding) {
  options_.given.push_back(*finding.effect);
  given_p_values_.push_back(finding.p_value);
  ban_given();
}

/// A name that moves the whole gear and went while forms of a few teeth came, though it takes out
/// far more than chance beside them: folds that hold such teeth predict the others badly, and
/// little is told by what they say of it. It stays from now on. True where there was one.
bool PartLoop::take_up_again(const std::vector<Effect>& before) {
  constexpr double kFar = 100.0;  // chi-square a column
  for (const Effect& name : before) {
    const auto at = std::find(candidates_.begin(), candidates_.end(), name);
    if (!name.family->named || !name.family->displacement_mm || name.columns() != 2 ||
        name.family->shape_is_continuous || at == candidates_.end() ||
        banned_[static_cast<std::size_t>(at - candidates_.begin())] ||
        std::find(effects_.begin(), effects_.end(), name) != effects_.end() ||
        !is_told_apart(name, effects_))
      continue;
    std::vector<Effect> with = effects_;
    with.push_back(name);
    const double gain = fit_of(effects_)->residual_square() - fit_of(with)->residual_square();
    if (gain < kFar * name.columns()) continue;
    RemainderFinding finding;
    finding.p_value = std::exp(-minus_log_chi_square_tail(gain, name.columns()));
    finding.effect = name;
    take_up(finding);
    return true;
  }
  return false;
}

bool PartLoop::take_up_remainder() {
  constexpr int kAtOnce = 4;
  std::vector<Effect> effects = effects_;
  const auto known = [&](const Effect& found) {
    return std::any_of(effects.begin(), effects.end(), [&](const Effect& e) {
      return e.family == found.family && e.flank == found.flank && e.shape == found.shape;
    });
  };
  const auto take_first = [&](RemainderOf which, bool local) {
    const std::vector<RemainderFinding> findings = remainder_of(effects, which);
    for (RemainderFinding finding : findings) {
      if (!finding.effect || finding.local != local) continue;
      // what a name says is told by its name, if the way of making can have it
      const EffectFamily& family = *finding.effect->family;
      if (family.named && !can_have(options_.makings, family))
        finding.effect->family = find_form(family.form_word);
      else if (!local && !family.named)
        if (const std::optional<Effect> name = name_like(finding, effects)) finding.effect = *name;
      if (known(*finding.effect) || !is_told_apart(*finding.effect, effects)) continue;
      take_up(finding);
      effects.push_back(*finding.effect);
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
    names_ = {};
    return true;
  }
  while (taken < kAtOnce && take_first(RemainderOf::kAll, true)) ++taken;
  names_ = {};
  return taken > 0;
}

/// Of the effects [first, end) that are asked for, the one whose loss costs least, and how much (chi-square).
PartLoop::LeastMissed PartLoop::least_missed(std::size_t first, std::size_t end,
                                             const std::function<bool(const Effect&)>& is_asked) const {
  const auto fit = fit_of(effects_);
  LeastMissed found;
  for (std::size_t e = first; e < end; ++e) {
    if (!is_asked(effects_[e])) continue;
    std::vector<bool> with(effects_.size(), true);
    with[e] = false;
    const double loss = fit->residual_square(with) - fit->residual_square();
    if (loss < found.loss) found = {e, loss};
  }
  return found;
}

/// Forms that a better one, taken up later, made idle. True where there were any.
bool PartLoop::drop_idle_forms() {
  constexpr double kIdle = 25.0;  // chi-square: five standard errors
  bool any = false;
  while (!given_p_values_.empty()) {
    const std::size_t first = first_told_here();
    const auto [idle, loss] = least_missed(first, options_.given.size(), [](const Effect&) { return true; });
    if (loss > kIdle) return any;
    effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(idle));
    options_.given.erase(options_.given.begin() + static_cast<std::ptrdiff_t>(idle));
    given_p_values_.erase(given_p_values_.begin() + static_cast<std::ptrdiff_t>(idle - first));
    any = true;
  }
  return any;
}

/// Machine's orders are many: one that was learnt from four fifths of the data, or before the other
/// effects, must stand out of its kind in all of the data beside these. True where one does not.
bool PartLoop::drop_doubtful_orders() {
  const std::size_t told = first_told_here();
  bool any = false;
  for (std::size_t e = effects_.size(); e-- > told;) {
    const EffectFamily& family = *effects_[e].family;
    if (!family.named || !family.tells_order_along_profile || is_order_of_all_data(e)) continue;
    any = true;
    if (e < options_.given.size()) {
      options_.given.erase(options_.given.begin() + static_cast<std::ptrdiff_t>(e));
      given_p_values_.erase(given_p_values_.begin() + static_cast<std::ptrdiff_t>(e - told));
      discovery_.chosen.erase(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(e));
      effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(e));
      continue;
    }
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (candidates_[g] == effects_[e]) banned_[g] = true;
  }
  return any;
}

bool PartLoop::is_order_of_all_data(std::size_t e) {
  const Effect wave = effects_[e];
  std::vector<Effect> beside = effects_;
  beside.erase(beside.begin() + static_cast<std::ptrdiff_t>(e));
  if (std::find(candidates_.begin(), candidates_.end(), wave) != candidates_.end())
    return is_likeliest_order(wave, beside);
  // No candidate: found in the traces.
  const auto row_um = fit_of(beside)->residuals_um();
  std::vector<bool> used(table_->rows.size());
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = patches_.patch_of_row[i] >= 0;
  const double sense = geometry_.sense();
  const RotationWave asked{.order = static_cast<int>(std::lround(wave.order())),
                           .side = wave.flank == FlankChoice::kBoth                     ? 0
                                   : (wave.flank == FlankChoice::kLeft) == (sense > 0.0) ? 1
                                                                                         : -1,
                           .backwards = wave.family->of_traces_only};
  if (chance_of_rotation_wave(geometry_, table_, *row_um, used, asked) <= kRemainderLevel)
    return true;
  // Of few teeth that says nothing.
  const bool twin = std::any_of(beside.begin(), beside.end(), [&](const Effect& other) {
    return other.family == wave.family && other.shape == wave.shape;
  });
  return twin && has_phases_of_its_order(wave, *row_um);
}

/// True where a wave of the traces of one flank takes nearly as much out of them as one of its
/// length in a phase of its own on every tooth does: by chance the phases of three teeth or more
/// seldom are those of an order.
bool PartLoop::has_phases_of_its_order(const Effect& wave, const std::vector<float>& row_um) const {
  constexpr double kNearly = 0.9;
  constexpr std::size_t kFewestTeeth = 3;
  struct Row {
    int tooth = 0;
    Eigen::Vector3d values;  // of both columns, and what is left without the wave
  };
  std::map<int, std::vector<Row>> traces;
  for (std::size_t i = 0; i < table_->rows.size(); ++i) {
    const Observation& row = table_->rows[i];
    const Place& place = table_->place(row);
    if (row.trace < 0 || patches_.patch_of_row[i] < 0 ||
        wave.flank != flank_choice(geometry_, place.side > 0 ? 1 : 0))
      continue;
    double c[2];
    wave.evaluate(geometry_, place, c);
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
bool PartLoop::is_likeliest_order(const Effect& wave, const std::vector<Effect>& beside) {
  constexpr double kSame = 2.0, kOwn = 0.8;
  DiscoveryProblem& problem = candidates_problem();
  const Eigen::Index of_pose = problem.nuisance.cols();
  if (!beside.empty()) add_nuisance(problem, make_problem(geometry_, table_, patches_, beside));
  const std::vector<int> folds = problem.fold;
  std::replace(problem.fold.begin(), problem.fold.end(), 0, 1);
  DiscoveryOptions options;
  options.most_effects = 0;
  options.banned.assign(candidates_.size(), true);
  for (std::size_t g = 0; g < candidates_.size(); ++g)
    if (candidates_[g].family == wave.family && candidates_[g].flank == wave.flank)
      options.banned[g] = banned_[g] && !(candidates_[g] == wave);
  const DiscoveryResult all = discover(problem, options);
  problem.fold = folds;
  problem.nuisance.conservativeResize(Eigen::NoChange, of_pose);
  if (all.p_left > kNextLevel / options_.tables || all.most_likely_left < 0) return false;
  const Effect& most_likely = candidates_[static_cast<std::size_t>(all.most_likely_left)];
  if (std::abs(most_likely.order() - wave.order()) <= kSame) return true;
  // On few teeth, or over short profiles, orders look alike.
  const PointFit both(geometry_, table_, patches_, {most_likely, wave});
  return both.retained(both.first_column(1)) < kOwn;
}

/// Bans a family on these flanks; true where that is new.
bool PartLoop::ban_alike(const Effect& effect) {
  bool any = false;
  for (std::size_t g = 0; g < candidates_.size(); ++g)
    if (candidates_[g].family == effect.family && candidates_[g].flank == effect.flank &&
        !banned_[g])
      banned_[g] = any = true;
  return any;
}

/// A name must hold whether or not forms without a name stand beside it: where its size hangs on
/// them it is a part of the description, no cause. (What moves teeth aside bends none.) True where
/// any was banned.
bool PartLoop::ban_what_forms_explain() {
  constexpr double kHangs = 0.25;
  const auto is_form = [&](const Effect& e) {
    return e.is_term() && e.family->shapes && e.family->shapes(geometry_).empty() &&
           !moves_teeth_aside(e);
  };
  std::vector<Effect> without;
  std::copy_if(effects_.begin(), effects_.end(), std::back_inserter(without),
               [&](const Effect& e) { return !is_form(e); });
  if (without.size() == effects_.size()) return false;
  // What all flanks stand out by may change with a form: it is free in both.
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  std::vector<Effect> with = effects_;
  if (is_told_apart(level, effects_)) {
    with.push_back(level);
    without.push_back(level);
  }
  const auto fit = fit_of(with), fit_without = fit_of(without);
  const PointFit &full = *fit, &bare = *fit_without;
  bool any = false;
  int at = 0;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const Effect& effect = effects_[e];
    if (is_form(effect)) continue;
    const int own = at++;
    if (!effect.family->named || effect.family->local || stands_beside_forms(full, e)) continue;
    const auto b =
        full.coefficients().segment(full.first_column(static_cast<int>(e)), effect.columns());
    const auto b0 = bare.coefficients().segment(bare.first_column(own), effect.columns());
    if ((b - b0).norm() <= kHangs * std::max(b.norm(), b0.norm())) continue;
    any = ban_alike(effect) || any;
    // What could not be told from it is no better.
    for (const int group : discovery_.chosen[e].confounded)
      if (candidates_[group].family->named) any = ban_alike(candidates_[group]) || any;
  }
  return any;
}

namespace {

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

/// The locked hold-out may say no: an effect without which its error is smaller is taken back, the
/// one that harms most first. A weak effect that is true may cost a little there by its own error;
/// and of what stands on one tooth the hold-out knows nothing: these go only where the error would
/// rise. A place beyond doubt that goes so (its ends lie in the fold beside it) is told as left.
void PartLoop::veto() {
  constexpr double kClearly = 0.98, kNoLoss = 1e-3;
  const std::size_t told = first_told_here();
  while (effects_.size() > told) {
    const auto fit = fit_of(effects_);
    if (fit->held_out() == 0) return;
    std::vector<bool> with(effects_.size(), true);
    const double full = fit->errors(with).held_out_rms_um;
    // Together they may harm where none does alone.
    const double none = plain_fit()->errors({}).held_out_rms_um;
    // (what a few teeth have the values held out may not have at all)
    const bool on_few = std::any_of(effects_.begin(), effects_.end(), gear_effects::is_of_teeth);
    const bool rises = full > (on_few ? 1.0 + kNoLoss : 1.0) * none;
    double least = rises ? 1e300 : kClearly * full;
    std::size_t worst = effects_.size();
    for (std::size_t e = told; e < effects_.size(); ++e) {
      if (effects_[e].family->local && !rises) continue;
      with[e] = false;
      const double error = fit->errors(with).held_out_rms_um;
      with[e] = true;
      if (error >= least) continue;
      least = error;
      worst = e;
    }
    if (worst == effects_.size()) return;
    if (is_spot_beyond_doubt(*fit, worst)) denied_spot_ = effects_[worst];
    effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(worst));
    discovery_.chosen.erase(discovery_.chosen.begin() + static_cast<std::ptrdiff_t>(worst));
    if (worst < options_.given.size()) {
      options_.given.erase(options_.given.begin() + static_cast<std::ptrdiff_t>(worst));
      given_p_values_.erase(given_p_values_.begin() + static_cast<std::ptrdiff_t>(worst - told));
    }
    vetoed_ = true;
    // deviations about a displacement that is taken back
    if (!moves_points() && !table_->points_mm.empty() && !put_points_back()) leave_out_across_steps();
  }
}

}  // namespace trueflank::loop
