// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <utility>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/drive/bench_remainder.h"
#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/found_drive_effects.h"

// What was chosen made simpler, and what is nothing taken back.
namespace trueflank::loop {
namespace {

/// True where a loss of prediction is no more than two standard errors over the folds: one such
/// error in six comes by chance, too often to give up a plain effect for a fancy one.
bool is_tie(const Eigen::VectorXd& loss) {
  const double n = static_cast<double>(loss.size()), sum = loss.sum(), mean = sum / n;
  const double variance = (loss.squaredNorm() - n * mean * mean) / (n - 1.0);
  return sum <= std::max(0.5, 2.0 * std::sqrt(std::max(0.0, n * variance)));
}

/// True where the one predicts as well as the other, or leaves no more than chance takes off by a
/// figure more. What stands in a short part of the run fills so few folds that these say nothing: what
/// it leaves more must not be sure either.
bool predicts_as_well(const DriveOutcome& one, const DriveOutcome& other) {
  constexpr double kAFigure = 6.6, kNoFigure = 4.0, kSure = 25.0;  // chi-square
  const double noise = other.square / std::max(1.0, other.rows - other.size());
  const int figures = other.size() - one.size();
  const double sure = kSure + kAFigure * std::max(0, figures);
  if (one.square - other.square > noise * other.shared * sure) return false;
  if (is_tie(one.fold_errors - other.fold_errors)) return true;
  return one.square - other.square < noise * (figures > 0 ? kAFigure * figures : kNoFigure);
}

bool has_unnamed(const DriveOutcome& outcome) {
  return std::any_of(outcome.effects.begin(), outcome.effects.end(),
                     [](const DriveEffect& e) { return !e.family->named; });
}

}  // namespace

bool earns_its_figures(const DriveOutcome& fuller, const DriveOutcome& plain) {
  constexpr double kEach = 9.0;  // chi-square
  const double noise = fuller.square / std::max(1.0, fuller.rows - fuller.size());
  return plain.square - fuller.square > kEach * noise * std::max(1, fuller.size() - plain.size());
}

bool DriveSelection::is_plainer(const DriveOutcome& other, const DriveOutcome& outcome) {
  const auto rank = [](const DriveOutcome& o) { return std::pair(o.size(), o.preference()); };
  return !other.effects.empty() && predicts_as_well(other, outcome) &&
         other.size() <= outcome.size() && rank(other) < rank(outcome);
}

DriveOutcome DriveSelection::plainest(DriveOutcome outcome) {
  for (int most = 0; most <= 4; ++most) {
    std::vector<bool> banned = banned_;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (candidates_[g].family->preference > most) banned[g] = true;
    DriveOutcome other = settled(banned);
    if (!is_plainer(other, outcome)) other = with_another_name(std::move(other), outcome, banned);
    if (!is_plainer(other, outcome)) continue;
    remember(other, outcome);
    return other;
  }
  return outcome;
}

DriveOutcome DriveSelection::with_another_name(DriveOutcome other, const DriveOutcome& outcome,
                                               const std::vector<bool>& banned) {
  constexpr double kNearly = 2.0;  // of the squares
  if (!has_unnamed(outcome) || other.square > kNearly * outcome.square) return other;
  for (const DriveEffect& effect : other.effects) {
    if (!effect.family->named) continue;
    std::vector<bool> without = banned;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (candidates_[g].family == effect.family) without[g] = true;
    DriveOutcome next = settled(without);
    if (is_plainer(next, outcome)) return next;
  }
  return other;
}

DriveOutcome DriveSelection::simplest(DriveOutcome outcome) {
  outcome = plainest(std::move(outcome));
  std::set<const DriveFamily*> tried;
  for (int round = 0; round < 8; ++round) {
    const DriveFamily* next = nullptr;
    for (const DriveEffect& effect : outcome.effects)
      if (effect.family->named && !tried.contains(effect.family) &&
          (next == nullptr || effect.family->preference > next->preference))
        next = effect.family;
    if (next == nullptr) break;
    tried.insert(next);
    std::vector<bool> banned = banned_;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (candidates_[g].family == next) banned[g] = true;
    DriveOutcome other = settled(banned);
    if (other.effects.empty() || !predicts_as_well(other, outcome)) continue;
    if (other.effects.size() > outcome.effects.size() + 1) continue;
    const auto rank = [](const DriveOutcome& o) { return std::pair(o.size(), o.preference()); };
    const bool better = rank(other) < rank(outcome);
    remember(better ? other : outcome, better ? outcome : other);
    if (better) outcome = std::move(other);
  }
  // What was left out on the way may have brought a description in where a name does as well.
  if (has_unnamed(outcome)) outcome = plainest(std::move(outcome));
  settle_state(outcome);
  return outcome;
}

DriveOutcome DriveSelection::simplest_that_is_enough(DriveOutcome whole) {
  DriveOutcome plain = simplest(whole);
  if (!earns_its_figures(whole, plain) || !leaves_structure(plain)) return plain;
  settle_state(whole);
  if (!leaves_structure(whole)) return whole;
  settle_state(plain);
  return plain;
}

bool DriveSelection::leaves_structure(const DriveOutcome& outcome) const {
  const DriveContext here = context();
  const Eigen::VectorXd left =
      value_ - DriveFit(here, value_, outcome.effects, FitRows::kTraining).explained_nm();
  BenchTable seen = without_rows(table_);
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < table_.points.size(); ++i) {
    if (table_.points[i].fold == 0) continue;
    seen.points.push_back(table_.points[i]);
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  const Eigen::VectorXd left_of_seen = left(rows);
  return !ask_remainder(seen, model_.ratio, left_of_seen).follows.empty();
}

DriveOutcome DriveSelection::settled(std::vector<bool> banned) {
  const std::vector<bool> kept_banned = banned_;
  const std::vector<DriveEffect> kept = candidates_;
  const DriveState state = state_;
  banned_ = std::move(banned);
  DriveOutcome outcome = settle();
  banned_ = kept_banned;
  candidates_ = kept;
  state_ = state;
  return outcome;
}

void DriveSelection::settle_state(const DriveOutcome& outcome) {
  for (int round = 0; round < 6 && move_state(outcome); ++round) {
  }
}

void DriveSelection::sharpen_courses(DriveOutcome& outcome) {
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    const DriveEffect course = outcome.effects[e];
    if (!course.family->over || course.columns() == 1) continue;
    const double over = course.family->over(course.shape);
    const auto square_with = [&](const DriveEffect& effect, std::vector<DriveEffect>& effects,
                                 bool refined) {
      effects = outcome.effects;
      effects[e] = effect;
      if (refined) refine_drive_shapes(context(), value_, FitRows::kTraining, effects);
      const DriveContext here = context();
      return DriveFit(here, value_, effects, FitRows::kTraining).residual_square();
    };
    // Of each kind the likeliest on the grid.
    std::map<const DriveFamily*, std::pair<double, std::size_t>> likeliest;
    std::vector<DriveEffect> effects;
    for (std::size_t g = 0; g < candidates_.size(); ++g) {
      const DriveEffect& other = candidates_[g];
      if (banned_[g] || !other.family->over || other.columns() != 1 ||
          other.family->over(other.shape) != over)
        continue;
      const double square = square_with(other, effects, false);
      const auto [at, is_new] = likeliest.try_emplace(other.family, square, g);
      if (!is_new && square < at->second.first) at->second = {square, g};
    }
    double least = square_with(course, effects, false);
    const double of_course = least;
    std::vector<DriveEffect> sharp;
    for (const auto& [family, at] : likeliest) {
      const double square = square_with(candidates_[at.second], effects, true);
      if (square >= least) continue;
      least = square;
      sharp = effects;
      outcome.discovery.chosen[e].group = static_cast<int>(at.second);
    }
    if (!(least < of_course)) continue;
    outcome.effects = sharp;
    settle_after_exchange(outcome);
  }
}

void DriveSelection::settle_after_exchange(DriveOutcome& outcome) {
  settle_state(outcome);
  const DriveContext here = context();
  const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
  outcome.fold_errors = fit.fold_errors();
  outcome.square = fit.residual_square();
  outcome.shared = shared_inside_units(fit);
}

void DriveSelection::follow_the_run(DriveOutcome& outcome) {
  constexpr double kSure = 25.0;  // chi-square
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    if (outcome.effects[e].family->follows != "warmth") continue;
    DriveOutcome best = outcome;
    settle_after_exchange(best);
    const double before = best.square;
    for (std::size_t g = 0; g < candidates_.size(); ++g) {
      if (banned_[g] || !candidates_[g].family->follows_the_run) continue;
      DriveOutcome other = outcome;
      other.effects[e] = candidates_[g];
      refine_drive_shapes(context(), value_, FitRows::kTraining, other.effects);
      settle_after_exchange(other);
      if (other.square >= best.square) continue;
      // That the drive grew warm meanwhile stays a likely reason.
      ChosenGroup& record = other.discovery.chosen[e];
      record.confounded = {record.group};
      record.group = static_cast<int>(g);
      best = std::move(other);
    }
    const double noise = best.square / std::max(1.0, best.rows - best.size());
    if (before - best.square > kSure * noise * best.shared) outcome = std::move(best);
    settle_state(outcome);
  }
}

void DriveSelection::prefer_plainer_names(DriveOutcome& outcome) {
  constexpr double kAsWell = 4.0;  // chi-square
  for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
    const DriveFamily* own = outcome.effects[e].family;
    if (!own->named || outcome.effects[e].columns() != 1) continue;
    DriveOutcome now = outcome;
    settle_after_exchange(now);
    const double noise = now.square / std::max(1.0, now.rows - now.size());
    const DriveState state = state_;
    std::size_t best = candidates_.size();
    DriveOutcome plainer;
    for (std::size_t g = 0; g < candidates_.size(); ++g) {
      const DriveEffect& other = candidates_[g];
      if (banned_[g] || !other.family->named || other.columns() != 1 ||
          other.family->preference >= own->preference || outcome.has(other.family) ||
          (best < candidates_.size() &&
           other.family->preference >= candidates_[best].family->preference))
        continue;
      DriveOutcome with = outcome;
      with.effects[e] = other;
      if (with.size() > outcome.size()) continue;
      refine_drive_shapes(context(), value_, FitRows::kTraining, with.effects);
      settle_after_exchange(with);
      if (with.square - now.square < kAsWell * noise * now.shared && is_possible(with)) {
        best = g;
        plainer = std::move(with);
      }
      state_ = state;
    }
    if (best == candidates_.size()) continue;
    ChosenGroup& record = plainer.discovery.chosen[e];
    exchangeable_[candidates_[best].family->id].insert(own->id);
    record.confounded.clear();
    record.group = static_cast<int>(best);
    outcome = std::move(plainer);
    settle_after_exchange(outcome);
  }
}

bool DriveSelection::is_possible(const DriveOutcome& outcome) const {
  const DriveContext here = context();
  const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
  if (!fit.can_be()) return false;
  const DriveState state = state_of(fit);
  return rubs_both_ways(state) && every_mesh_rubs(state);
}

void DriveSelection::drop_what_is_nothing(DriveOutcome& outcome) {
  constexpr double kStandsOut = 3.0;  // standard errors
  // (one of several that mended each other may be nothing without the ones that were taken back)
  while (outcome.effects.size() > (vetoed_ ? 0 : 1)) {
    const DriveContext here = context();
    const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
    const Eigen::MatrixXd covariance = fit.covariance();
    std::size_t least = outcome.effects.size();
    double least_square = kStandsOut * kStandsOut;
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      const int first = fit.first_column(static_cast<int>(e)),
                columns = outcome.effects[e].columns();
      const Eigen::VectorXd b = fit.coefficients().segment(first, columns);
      const double square =
          b.dot(symmetric_solution(covariance.block(first, first, columns, columns), b)) / columns;
      if (square >= least_square) continue;
      least_square = square;
      least = e;
    }
    if (least == outcome.effects.size()) return;
    leave_out(outcome, least);
  }
}

void DriveSelection::veto(DriveOutcome& outcome) {
  while (!outcome.effects.empty()) {
    const DriveContext here = context();
    // (which of two states comes at random no row foretells)
    constexpr double kAtRandom = 0.2;  // changes for a row
    const bool at_random =
        std::any_of(outcome.effects.begin(), outcome.effects.end(), [&](const DriveEffect& e) {
          return e.family->shape_of_states &&
                 static_cast<double>(e.shape.size()) - 1.0 > kAtRandom * outcome.rows;
        });
    const DriveFit fit(
        here, value_,
        at_random ? with_states_of_all_rows(here, value_, outcome.effects) : outcome.effects,
        FitRows::kTraining);
    const auto error = [&](const std::vector<bool>& left_out) {
      return drive_errors(here, value_, value_ - fit.columns() * fit.without(left_out))
          .held_out_rms;
    };
    std::vector<bool> left_out(outcome.effects.size(), false);
    const double none = error(std::vector<bool>(outcome.effects.size(), true));
    if (!(error(left_out) > none)) return;
    std::size_t worst = 0;
    double least = 1e300;
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      left_out[e] = true;
      if (const double without = error(left_out); without < least) {
        least = without;
        worst = e;
      }
      left_out[e] = false;
    }
    leave_out(outcome, worst);
    vetoed_ = true;
  }
}

void DriveSelection::stand_by_the_whole(const DriveOutcome& whole, DriveOutcome& outcome) {
  const DriveState state = state_;
  DriveOutcome fuller = whole;
  settle_after_exchange(fuller);
  vetoed_ = false;
  veto(fuller);
  if (!vetoed_ && !fuller.effects.empty()) {
    outcome = std::move(fuller);
    return;
  }
  vetoed_ = true;
  state_ = state;
}

void DriveSelection::leave_out(DriveOutcome& outcome, std::size_t effect) {
  const auto at = static_cast<std::ptrdiff_t>(effect);
  outcome.effects.erase(outcome.effects.begin() + at);
  outcome.discovery.chosen.erase(outcome.discovery.chosen.begin() + at);
  refine_drive_shapes(context(), value_, FitRows::kTraining, outcome.effects);
  settle_state(outcome);
}

void DriveSelection::remember(const DriveOutcome& kept, const DriveOutcome& other) {
  for (const DriveEffect& mine : kept.effects) {
    if (other.has(mine.family)) continue;
    for (const DriveEffect& theirs : other.effects)
      if (theirs.family->named && !kept.has(theirs.family))
        exchangeable_[mine.family->id].insert(theirs.family->id);
  }
}

}  // namespace trueflank::loop
