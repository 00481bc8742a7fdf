// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/close_drive_loop.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "trueflank/base/number_text.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/drive/bench_remainder.h"
#include "trueflank/loop/drive/bench_visits.h"
#include "trueflank/loop/drive/drive_fit.h"
#include "trueflank/loop/drive/found_drive_effects.h"
#include "trueflank/loop/drive/spell_scan.h"
#include "trueflank/loop/drive/wave_spectrum.h"
#include "trueflank/loop/result/describe.h"

namespace trueflank::loop {
namespace {

/// One outcome of the engine with its shapes refined on the training rows.
struct Outcome {
  DiscoveryResult discovery;
  std::vector<DriveEffect> effects;
  Eigen::VectorXd fold_errors;
  double square = 0.0,
         rows = 1.0;  ///< of what it leaves of the training rows, in their noise's units
  [[nodiscard]] int size() const {
    int size = 0;
    for (const DriveEffect& effect : effects) {
      size += effect.columns();
      for (const DriveShapeValue& value : effect.family->shape_values)
        size += value.continuous ? 1 : 0;
    }
    return size;
  }
  [[nodiscard]] int preference() const {
    int sum = 0;
    for (const DriveEffect& effect : effects) sum += effect.family->preference;
    return sum;
  }
  [[nodiscard]] bool has(const DriveFamily* family) const {
    return std::any_of(effects.begin(), effects.end(),
                       [&](const DriveEffect& e) { return e.family == family; });
  }
};

/// True where a loss of prediction is no more than two standard errors over the folds: one such
/// error in six comes by chance, too often to give up a plain effect for a fancy one.
bool is_tie(const Eigen::VectorXd& loss) {
  const double n = static_cast<double>(loss.size()), sum = loss.sum(), mean = sum / n;
  const double variance = (loss.squaredNorm() - n * mean * mean) / (n - 1.0);
  return sum <= std::max(0.5, 2.0 * std::sqrt(std::max(0.0, n * variance)));
}

/// True where the one predicts as well as the other, or leaves no more than chance takes off by a
/// figure more.
bool predicts_as_well(const Outcome& one, const Outcome& other) {
  constexpr double kAFigure = 6.6, kNoFigure = 4.0;  // chi-square
  if (is_tie(one.fold_errors - other.fold_errors)) return true;
  const double noise = other.square / std::max(1.0, other.rows - other.size());
  const int figures = other.size() - one.size();
  return one.square - other.square < noise * (figures > 0 ? kAFigure * figures : kNoFigure);
}

/// True where the fuller set takes off more than what chance lets the figures that it has more.
bool earns_its_figures(const Outcome& fuller, const Outcome& plain) {
  constexpr double kEach = 9.0;  // chi-square
  const double noise = fuller.square / std::max(1.0, fuller.rows - fuller.size());
  return plain.square - fuller.square > kEach * noise * std::max(1, fuller.size() - plain.size());
}

class Loop {
 public:
  Loop(const DriveModel& model, BenchTable table, const DriveLoopOptions& options)
      : model_(model),
        options_(options),
        table_(std::move(table)),
        curve_(model),
        mesh_slopes_(mesh_slopes(model)) {}

  DriveLoop close() {
    measure_residual();
    candidates_ = drive_candidates(context());
    banned_.assign(candidates_.size(), false);
    if (table_.impossible == Impossible::kEfficiencyAboveOne)
      ban([](const DriveEffect& e) { return e.family->is_loss; });
    Outcome outcome = settle();
    for (int spells = 0; spells < 3 && propose_spell(outcome); ++spells) outcome = settle();
    for (int waves = 0; waves < 4 && propose_wave(outcome); ++waves) outcome = settle();
    if (!outcome.effects.empty()) outcome = simplest_that_is_enough(std::move(outcome));
    drop_what_is_nothing(outcome);
    veto(outcome);
    return report(outcome);
  }

 private:
  [[nodiscard]] DriveContext context() const {
    return {model_, curve_, table_, mesh_slopes_, state_};
  }

  void measure_residual() {
    value_.resize(static_cast<Eigen::Index>(table_.points.size()));
    for (std::size_t i = 0; i < table_.points.size(); ++i)
      value_[static_cast<Eigen::Index>(i)] =
          table_.points[i].driven_nm - predicted_nm(model_, curve_, table_.points[i]);
  }

  /// Of what hangs together some is left when units were merged: a quarter of the level makes up
  /// for it.
  [[nodiscard]] double share_of_level() const { return table_.drifts ? 0.25 : 1.0; }

  template <class Predicate>
  bool ban(const Predicate& which) {
    bool any = false;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (!banned_[g] && which(candidates_[g])) banned_[g] = any = true;
    return any;
  }

  [[nodiscard]] Outcome select(const std::vector<bool>& banned) const {
    const DriveContext here = context();
    DiscoveryOptions options;
    options.banned = banned;
    options.first_level = share_of_level() * options_.level;
    options.next_level *= share_of_level();
    Outcome outcome;
    outcome.discovery = discover(drive_problem(here, value_, candidates_), options);
    for (const ChosenGroup& chosen : outcome.discovery.chosen)
      outcome.effects.push_back(candidates_[chosen.group]);
    refine_drive_shapes(here, value_, FitRows::kTraining, outcome.effects);
    const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
    outcome.fold_errors = fit.fold_errors();
    outcome.square = fit.residual_square();
    outcome.rows =
        static_cast<double>(std::count_if(table_.points.begin(), table_.points.end(),
                                          [](const BenchPoint& p) { return p.fold != 0; }));
    return outcome;
  }

  /// Selection until shapes, friction and scale stand still and no effect has the wrong sign.
  Outcome settle() {
    Outcome outcome;
    for (int round = 0; round < 6; ++round) {
      outcome = select(banned_);
      bool again = put_shapes_on_the_grid(outcome);
      again = ban_wrong_signs(outcome) || again;
      again = move_state(outcome) || again;
      if (!again) break;
    }
    return outcome;
  }

  bool put_shapes_on_the_grid(const Outcome& outcome) {
    bool moved = false;
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      auto& grid = candidates_[outcome.discovery.chosen[e].group].shape;
      for (std::size_t k = 0; k < grid.size(); ++k)
        moved = moved || std::abs(grid[k] - outcome.effects[e].shape[k]) > 0.02 * std::abs(grid[k]);
      grid = outcome.effects[e].shape;
    }
    return moved;
  }

  bool ban_wrong_signs(const Outcome& outcome) {
    const DriveContext here = context();
    const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
    bool any = false;
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      const DriveFamily* family = outcome.effects[e].family;
      const double b = fit.coefficients()[fit.first_column(static_cast<int>(e))];
      const bool wrong = (family->only_positive && !(b > 0.0)) ||
                         (family->plausible && !family->plausible(model_, b));
      if (wrong) any = ban([&](const DriveEffect& c) { return c.family == family; }) || any;
    }
    return any;
  }

  /// Friction and scale of a fit become the place about which the model is linear.
  [[nodiscard]] static DriveState state_of(const DriveFit& fit) {
    DriveState state;
    for (std::size_t e = 0; e < fit.effects().size(); ++e) {
      const double b = fit.coefficients()[fit.first_column(static_cast<int>(e))];
      const DriveEffect& effect = fit.effects()[e];
      if (effect.family->into_state) effect.family->into_state(state, effect.shape, b);
    }
    return state;
  }

  bool move_state(const Outcome& outcome) {
    const DriveContext here = context();
    const DriveState next = state_of(DriveFit(here, value_, outcome.effects, FitRows::kTraining));
    const auto far = [&](double DriveState::*value) {
      return std::abs(next.*value - state_.*value) > 2e-4;
    };
    const bool moved = far(&DriveState::shift) || far(&DriveState::difference) ||
                       far(&DriveState::load_value) || far(&DriveState::mixed_value) ||
                       far(&DriveState::scale);
    state_ = next;
    return moved;
  }

  /// Where the spectrum of what is left has a line that noise would not make: one candidate more.
  bool propose_wave(const Outcome& outcome) {
    if (table_.impossible == Impossible::kEfficiencyAboveOne) return false;
    const DriveContext here = context();
    const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
    const LikeliestOrder line = likeliest_order(here, value_ - fit.explained_nm());
    constexpr double kLevel = 0.002;  // searched beside the engine's own test
    if (!(line.p_value < kLevel)) return false;
    for (const DriveEffect& candidate : candidates_)
      if (const double order = candidate.order();
          order > 0.0 && std::abs(order - line.order) < 0.5 / std::max(1.0, table_.turns))
        return false;
    const auto& library = drive_library();
    const auto host = std::find_if(library.begin(), library.end(), [](const DriveFamily& family) {
      return static_cast<bool>(family.shape_of_wave);
    });
    candidates_.push_back({&*host, host->shape_of_wave(line.order, line.opposite)});
    banned_.push_back(false);
    return true;
  }

  /// Where a part of the run, or of every turn of a shaft, differs from the rest more than noise
  /// would: one candidate more. What goes round with the angle, or has no name, may only imitate it
  /// and is left out while it is looked for; a spell that was chosen stays.
  bool propose_spell(const Outcome& outcome) {
    if (table_.impossible == Impossible::kEfficiencyAboveOne) return false;
    constexpr double kLevel = 0.001;  // searched beside the engine's own test
    const DriveContext here = context();
    const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
    std::vector<bool> left_out;
    for (const DriveEffect& effect : outcome.effects)
      left_out.push_back(!effect.family->shape_of_spell &&
                         (!effect.family->named || effect.order() > 0.0));
    const Eigen::VectorXd left = value_ - fit.columns() * fit.without(left_out);
    const LikeliestSpell of_turns = likeliest_spell_of_turns(here, left),
                         of_run = likeliest_spell_of_run(here, left);
    const LikeliestSpell& spell = of_turns.p_value <= of_run.p_value ? of_turns : of_run;
    if (!(spell.p_value < kLevel)) return false;
    const auto& library = drive_library();
    const auto host = std::find_if(library.begin(), library.end(), [](const DriveFamily& family) {
      return static_cast<bool>(family.shape_of_spell);
    });
    const DriveShape shape =
        host->shape_of_spell(spell.what, spell.order, spell.begin, spell.length);
    for (const DriveEffect& candidate : candidates_)
      if (candidate.family == &*host && candidate.shape == shape) return false;
    candidates_.push_back({&*host, shape});
    banned_.push_back(false);
    return true;
  }

  /// Tries the named effects in the order in which people would think of them: where the plainer
  /// ones predict as well as what the engine chose among all, they are kept.
  Outcome plainest(Outcome outcome) {
    for (int most = 0; most <= 4; ++most) {
      std::vector<bool> banned = banned_;
      for (std::size_t g = 0; g < candidates_.size(); ++g)
        if (candidates_[g].family->preference > most) banned[g] = true;
      Outcome other = settled(banned);
      if (other.effects.empty() || !predicts_as_well(other, outcome)) continue;
      if (other.size() > outcome.size()) continue;
      const auto rank = [](const Outcome& o) { return std::pair(o.size(), o.preference()); };
      if (rank(other) >= rank(outcome)) continue;
      remember(other, outcome);
      return other;
    }
    return outcome;
  }

  /// Leaves out one kind of effect after the other: where the rest finds a set that predicts as
  /// well, the two cannot be told apart, and the simpler one is kept.
  Outcome simplest(Outcome outcome) {
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
      Outcome other = settled(banned);
      if (other.effects.empty() || !predicts_as_well(other, outcome)) continue;
      if (other.effects.size() > outcome.effects.size() + 1) continue;
      const auto rank = [](const Outcome& o) { return std::pair(o.size(), o.preference()); };
      const bool better = rank(other) < rank(outcome);
      remember(better ? other : outcome, better ? outcome : other);
      if (better) outcome = std::move(other);
    }
    // What was left out on the way may have brought a description in where a name does as well.
    if (std::any_of(outcome.effects.begin(), outcome.effects.end(),
                    [](const DriveEffect& e) { return !e.family->named; }))
      outcome = plainest(std::move(outcome));
    settle_state(outcome);
    return outcome;
  }

  /// The simplest, but for one that leaves structure of which the fuller set leaves none.
  Outcome simplest_that_is_enough(Outcome whole) {
    Outcome plain = simplest(whole);
    if (!earns_its_figures(whole, plain) || !leaves_structure(plain)) return plain;
    settle_state(whole);
    if (!leaves_structure(whole)) return whole;
    settle_state(plain);
    return plain;
  }
  /// Asked of the training rows alone.
  [[nodiscard]] bool leaves_structure(const Outcome& outcome) const {
    const DriveContext here = context();
    const Eigen::VectorXd left =
        value_ - DriveFit(here, value_, outcome.effects, FitRows::kTraining).explained_nm();
    BenchTable seen = table_;
    seen.points.clear();
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < table_.points.size(); ++i) {
      if (table_.points[i].fold == 0) continue;
      seen.points.push_back(table_.points[i]);
      rows.push_back(static_cast<Eigen::Index>(i));
    }
    const Eigen::VectorXd left_of_seen = left(rows);
    return !ask_remainder(seen, model_.ratio, left_of_seen).follows.empty();
  }

  /// A selection among fewer candidates, about its own state; wrong signs are banned in it alone.
  Outcome settled(std::vector<bool> banned) {
    const std::vector<bool> kept_banned = banned_;
    const std::vector<DriveEffect> kept = candidates_;
    const DriveState state = state_;
    banned_ = std::move(banned);
    Outcome outcome = settle();
    banned_ = kept_banned;
    candidates_ = kept;
    state_ = state;
    return outcome;
  }

  /// The state of an outcome that was settled about another one.
  void settle_state(const Outcome& outcome) {
    for (int round = 0; round < 6 && move_state(outcome); ++round) {
    }
  }

  /// Of several effects those that are nothing once all shapes are free: they only mended another's
  /// shape.
  void drop_what_is_nothing(Outcome& outcome) {
    constexpr double kStandsOut = 3.0;  // standard errors
    while (outcome.effects.size() > 1) {
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
            b.dot(symmetric_solution(covariance.block(first, first, columns, columns), b)) /
            columns;
        if (square >= least_square) continue;
        least_square = square;
        least = e;
      }
      if (least == outcome.effects.size()) return;
      leave_out(outcome, least);
    }
  }

  /// The locked hold-out may say no: while its error would rise, the effect goes that harms it
  /// most.
  void veto(Outcome& outcome) {
    while (!outcome.effects.empty()) {
      const DriveContext here = context();
      const DriveFit fit(here, value_, outcome.effects, FitRows::kTraining);
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

  void leave_out(Outcome& outcome, std::size_t effect) {
    const auto at = static_cast<std::ptrdiff_t>(effect);
    outcome.effects.erase(outcome.effects.begin() + at);
    outcome.discovery.chosen.erase(outcome.discovery.chosen.begin() + at);
    refine_drive_shapes(context(), value_, FitRows::kTraining, outcome.effects);
    settle_state(outcome);
  }

  void remember(const Outcome& kept, const Outcome& other) {
    for (const DriveEffect& mine : kept.effects) {
      if (other.has(mine.family)) continue;
      for (const DriveEffect& theirs : other.effects)
        if (theirs.family->named && !kept.has(theirs.family))
          exchangeable_[mine.family->id].insert(theirs.family->id);
    }
  }

  DriveLoop report(const Outcome& outcome) {
    DriveLoop done{.result = {},
                   .model = model_,
                   .table = {},
                   .before_nm = {},
                   .after_nm = {},
                   .effects = {},
                   .coefficients = {},
                   .state = {}};
    const DriveContext held = context();
    const DriveFit training(held, value_, outcome.effects, FitRows::kTraining);
    const Eigen::VectorXd left_training = value_ - training.explained_nm();
    // Shapes, friction and scale once more with all rows: for the figures people use.
    std::vector<DriveEffect> effects = outcome.effects;
    for (int round = 0; round < 3 && !effects.empty(); ++round) {
      refine_drive_shapes(context(), value_, FitRows::kAll, effects);
      const DriveContext here = context();
      state_ = state_of(DriveFit(here, value_, effects, FitRows::kAll));
    }
    const DriveContext here = context();
    const DriveFit all(here, value_, effects, FitRows::kAll);
    const Eigen::VectorXd left = value_ - all.explained_nm();
    LoopResult& r = done.result;
    r.gear = "drive";
    r.unit = kNewtonMetres;
    r.observations = static_cast<int>(table_.points.size());
    for (const BenchPoint& p : table_.points) r.held_out += p.fold == 0 ? 1 : 0;
    r.outliers = table_.outliers;
    r.notes = table_.notes;
    r.before = drive_errors(here, value_, value_);
    r.after = drive_errors(here, left, left_training);
    const double n = static_cast<double>(table_.points.size());
    const BenchRemainder remainder = ask_remainder(table_, model_.ratio, left);
    r.noise = remainder.follows.empty()
                  ? r.after.rms * std::sqrt(n / std::max(1.0, n - outcome.size()))
                  : remainder.noise_nm;
    r.structure_p_value = outcome.discovery.first_p_value;
    r.structure_left_p_value = outcome.discovery.p_left;
    r.effects = describe_drive_effects({here, all, training, value_, remainder,
                                        outcome.discovery.chosen, candidates_, exchangeable_});
    list_observable(outcome, r);
    r.measure_next = runs_that_separate(table_, r.effects);
    judge(outcome, remainder, r);
    if (r.verdict != Verdict::kPartlyExplained) say_what_neighbours_share(left, r);
    done.before_nm.assign(value_.data(), value_.data() + value_.size());
    done.after_nm.assign(left.data(), left.data() + left.size());
    done.effects = effects;
    done.coefficients.assign(all.coefficients().data(),
                             all.coefficients().data() + all.coefficients().size());
    done.state = state_;
    done.table = std::move(table_);
    return done;
  }

  void list_observable(const Outcome& outcome, LoopResult& r) const {
    std::set<std::string> seen;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (g < outcome.discovery.observable.size() && outcome.discovery.observable[g])
        seen.insert(candidates_[g].family->id);
    for (const DriveFamily& family : drive_library())
      if (family.named && !seen.contains(family.id) &&
          std::find(r.not_observable.begin(), r.not_observable.end(), family.id) ==
              r.not_observable.end())
        r.not_observable.push_back(family.id);
  }

  void judge(const Outcome& outcome, const BenchRemainder& remainder, LoopResult& r) {
    constexpr double kLeft = 0.01, kSureThoughDenied = 0.0015;
    const DiscoveryResult& d = outcome.discovery;
    const bool left = d.p_left <= kLeft && d.likest_left >= 0;
    if (outcome.effects.empty())
      // What the hold-out denied must be surer than what it was not asked about.
      r.verdict = d.first_p_value <= share_of_level() * (vetoed_ ? kSureThoughDenied : kLeft)
                      ? Verdict::kPartlyExplained
                      : Verdict::kNoEffect;
    else
      r.verdict = left ? Verdict::kPartlyExplained : Verdict::kExplained;
    if (left)
      r.structure_left =
          "what is left looks most like " + words_for(model_, candidates_[d.likest_left]);
    else
      r.structure_left = "nothing beyond the measurement's own noise was found";
    if (!left && outcome.effects.empty() && r.verdict == Verdict::kPartlyExplained)
      r.structure_left =
          "what the model leaves is more than noise makes by chance, but no effect and no form in "
          "it predicts rows that it was not fitted to";
    if (!remainder.follows.empty()) {
      r.verdict = Verdict::kPartlyExplained;
      r.structure_left_p_value = std::min(r.structure_left_p_value, remainder.p_value);
      r.structure_left = remainder.follows;
    }
    if (r.verdict == Verdict::kExplained &&
        r.after.held_out_rms > larger_than_noise(r.noise, r.held_out)) {
      r.verdict = Verdict::kPartlyExplained;
      r.structure_left = printed(
          "on the rows held out from the fit %.2g times the noise is left: these effects fit the "
          "rows they were "
          "found in better than others",
          r.after.held_out_rms / r.noise);
    }
    judge_impossible(r);
  }

  /// A quarter above the noise, and as much more as the rms of so few rows may scatter.
  [[nodiscard]] static double larger_than_noise(double noise, int rows) {
    return noise * (1.25 + 3.0 / std::sqrt(2.0 * std::max(1, rows)));
  }

  /// Errors that hang together look like something slow: who reads "noise" is told so.
  void say_what_neighbours_share(const Eigen::VectorXd& left, LoopResult& r) const {
    constexpr double kMuch = 0.35, kHalf = 0.45;
    constexpr Eigen::Index kFewest = 60;
    if (left.size() < kFewest) return;
    Eigen::VectorXd size = left;
    for (Eigen::Index i = 0; i < size.size(); ++i)
      size[i] /= table_.points[static_cast<std::size_t>(i)].sigma_nm;
    const double shared = correlation_of_visits(size, set_points_of(table_.points));
    if (!(shared > kMuch)) return;
    const std::string text = printed(
        "neighbouring rows share %.0f %% of what is left: errors that hang together, or something "
        "slow that these "
        "columns do not hold (the same set points again, in another order, would tell)",
        100.0 * shared);
    if (r.verdict == Verdict::kExplained && shared > kHalf) {
      r.verdict = Verdict::kPartlyExplained;
      r.structure_left = text;
    } else {
      r.structure_left += "; " + text;
    }
  }

  void judge_impossible(LoopResult& r) const {
    if (table_.impossible == Impossible::kNothing) return;
    if (table_.impossible == Impossible::kEfficiencyAboveOne) {
      r.verdict = Verdict::kPartlyExplained;
      r.structure_left =
          table_.impossible_text +
          "; a torque scale or an offset is in these data, and no friction was fitted "
          "to them";
      r.notes.push_back(table_.impossible_text);
      return;
    }
    r.notes.push_back(table_.impossible_text +
                      "; the data were put right and judged so: correct the file");
    FoundEffect swapped;
    swapped.id = "swapped_side";
    swapped.description = table_.impossible_text;
    swapped.cause = "columns or directions of the bench's file were mixed up";
    swapped.correction = "correct the file";
    swapped.correctable = false;
    swapped.sentence = table_.impossible_text + first_action(swapped.correction);
    swapped.sure = "as good as certain: no drive can have such torques";
    swapped.explained_fraction = kNaN;
    r.effects.insert(r.effects.begin(), swapped);
    if (r.verdict == Verdict::kNoEffect) r.verdict = Verdict::kExplained;
  }

  const DriveModel& model_;
  const DriveLoopOptions& options_;
  BenchTable table_;
  const EfficiencyCurve curve_;
  const std::vector<DriveEfficiency> mesh_slopes_;
  DriveState state_;
  Eigen::VectorXd value_;
  std::vector<DriveEffect> candidates_;
  std::vector<bool> banned_;
  std::map<std::string, std::set<std::string>> exchangeable_;
  bool vetoed_ = false;  ///< effects were taken back
};

}  // namespace

ResultAll<DriveLoop> close_drive_loop(const DriveModel& model, const BenchData& data,
                                      const DriveLoopOptions& options) {
  if (!data.quantities.empty() && data.rows.empty()) return explain_quantities(model, data);
  auto table = make_bench_table(model, data);
  if (!table) return fail_all(std::move(table.error()));
  if (!data.quantities.empty())
    table->notes.push_back(std::to_string(data.quantities.size()) +
                           " single quantities were not used beside the rows");
  return Loop(model, std::move(*table), options).close();
}

DriveLoop close_drive_table(const DriveModel& model, BenchTable table,
                            const DriveLoopOptions& options) {
  measure_extent(table);
  return Loop(model, std::move(table), options).close();
}

ResultAll<DriveLoop> close_drive_loop(const GearTrain& train,
                                      const std::vector<std::string>& files) {
  auto model = drive_model(train);
  if (!model) return fail_all({model.error()});
  auto data = read_bench_files(files);
  if (!data) return fail_all(std::move(data.error()));
  return close_drive_loop(*model, *data);
}

}  // namespace trueflank::loop
