// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/close_drive_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/drive/bench_neighbours.h"
#include "trueflank/loop/drive/bench_remainder.h"
#include "trueflank/loop/drive/bench_scatter.h"
#include "trueflank/loop/drive/bench_visits.h"
#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/exchanged_effects.h"
#include "trueflank/loop/drive/found_drive_effects.h"
#include "trueflank/loop/drive/place_profile.h"
#include "trueflank/loop/result/describe.h"

namespace trueflank::loop {
namespace {

class DriveReport {
 public:
  DriveReport(const DriveModel& model, BenchTable table, const DriveLoopOptions& options)
      : selection_(model, std::move(table), options) {}

  DriveLoop close() { return report(selection_.run()); }
  /// The same, and whether the hold-out is so far from the rest that it holds all of something, or
  /// denies what is as good as certain: it holds one end of it.
  std::pair<DriveLoop, bool> close_and_doubt_hold_out() {
    const DriveOutcome outcome = selection_.run();
    constexpr double kAsGoodAsCertain = 100.0;  // chi-square
    const bool doubted =
        selection_.most_denied() > kAsGoodAsCertain || held_out_stands_apart(outcome);
    return {report(outcome), doubted};
  }

 private:
  /// True where what the training leaves of the held-out rows is far more than of its own.
  [[nodiscard]] bool held_out_stands_apart(const DriveOutcome& outcome) const {
    constexpr double kTimes = 2.0, kSurely = 1e-6;
    constexpr double kShared = 2.0;  // rows that may hang together are counted by half
    const DriveContext held = selection_.context();
    const DriveFit training(held, selection_.value_nm(), outcome.effects, FitRows::kTraining);
    const Eigen::VectorXd left = selection_.value_nm() - training.explained_nm();
    std::array<double, 2> square{}, rows{};
    const auto& points = selection_.table().points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t of = points[i].fold == 0 ? 1 : 0;
      const double size = left[static_cast<Eigen::Index>(i)] / points[i].sigma_nm;
      square[of] += size * size;
      rows[of] += 1.0;
    }
    const double degrees = rows[0] - outcome.size();
    if (!(degrees > kShared) || !(rows[1] > kShared) || !(square[0] > 0.0)) return false;
    const double f = (square[1] / rows[1]) / (square[0] / degrees);
    return f > kTimes && f_tail(f, rows[1] / kShared, degrees / kShared) < kSurely;
  }

  DriveLoop report(const DriveOutcome& outcome) {
    DriveLoop done{.result = {},
                   .model = selection_.model(),
                   .table = {},
                   .before_nm = {},
                   .after_nm = {},
                   .effects = {},
                   .coefficients = {},
                   .state = {}};
    const DriveContext held = selection_.context();
    const DriveFit training(held, selection_.value_nm(),
                            with_states_of_all_rows(held, selection_.value_nm(), outcome.effects),
                            FitRows::kTraining);
    const Eigen::VectorXd left_training = selection_.value_nm() - training.explained_nm();
    // Shapes, friction and scale once more with all rows: for the figures people use.
    std::vector<DriveEffect> effects = outcome.effects;
    for (int round = 0; round < 3 && !effects.empty(); ++round) {
      refine_drive_shapes(selection_.context(), selection_.value_nm(), FitRows::kAll, effects);
      const DriveContext here = selection_.context();
      selection_.move_state_to(
          DriveSelection::state_of(DriveFit(here, selection_.value_nm(), effects, FitRows::kAll)));
    }
    const std::vector<std::vector<Parameter>> figures = figures_of_places(outcome.shared, effects);
    const DriveContext here = selection_.context();
    const DriveFit all(here, selection_.value_nm(), effects, FitRows::kAll);
    const Eigen::VectorXd left = selection_.value_nm() - all.explained_nm();
    LoopResult& r = done.result;
    r.gear = "drive";
    r.unit = kNewtonMetres;
    r.observations = static_cast<int>(selection_.table().points.size());
    for (const BenchPoint& p : selection_.table().points) r.held_out += p.fold == 0 ? 1 : 0;
    r.outliers = selection_.table().outliers;
    r.notes = selection_.table().notes;
    r.before = drive_errors(here, selection_.value_nm(), selection_.value_nm());
    r.after = drive_errors(here, left, left_training);
    const double n = static_cast<double>(selection_.table().points.size());
    const BenchRemainder remainder = remainder_of(effects, left);
    r.noise = remainder.follows.empty()
                  ? r.after.rms * std::sqrt(n / std::max(1.0, n - outcome.size()))
                  : remainder.noise_nm;
    r.structure_p_value = outcome.discovery.first_p_value;
    r.structure_left_p_value = outcome.discovery.p_left;
    r.effects = describe_drive_effects({here, all, training, selection_.value_nm(), remainder,
                                        outcome.discovery.chosen, selection_.candidates(),
                                        selection_.exchangeable(), figures});
    const bool run_leaves_less = hold_exchanged_effects(selection_, effects, r.effects);
    list_observable(outcome, r);
    r.measure_next = runs_that_separate(selection_.table(), r.effects);
    judge(outcome, remainder, all, r);
    if (run_leaves_less && r.verdict == Verdict::kExplained) {
      r.verdict = Verdict::kPartlyExplained;
      r.structure_left =
          "a loss that follows the course of the run leaves less than one that follows the temperature, "
          "which changed with it: the same set points again, cold and warm, would tell";
    }
    if (r.verdict == Verdict::kNoEffect) say_where_set_points_lie_off(left, r);
    if (r.verdict != Verdict::kPartlyExplained) say_what_neighbours_share(left, effects, r);
    if (std::string scatter = where_it_scatters(selection_.table(), selection_.model().ratio, left);
        r.verdict != Verdict::kPartlyExplained && !scatter.empty())
      r.notes.push_back(std::move(scatter));
    say_which_readings_are_coarse(r);
    done.before_nm.assign(selection_.value_nm().data(),
                          selection_.value_nm().data() + selection_.value_nm().size());
    done.after_nm.assign(left.data(), left.data() + left.size());
    done.effects = effects;
    done.coefficients.assign(all.coefficients().data(),
                             all.coefficients().data() + all.coefficients().size());
    done.state = selection_.state();
    done.table = selection_.take_table();
    return done;
  }

  /// What is left, asked apart from all candidates: by its kinds of rows, and by neighbours.
  [[nodiscard]] BenchRemainder remainder_of(const std::vector<DriveEffect>& effects,
                                            const Eigen::VectorXd& left) const {
    const double ratio = selection_.model().ratio;
    BenchRemainder remainder = ask_remainder(selection_.table(), ratio, left);
    std::vector<double> orders;
    for (const DriveEffect& e : effects)
      if (const double order = e.order(); order > 0.0) orders.push_back(order);
    const SharedByNearRows near = ask_neighbours(selection_.table(), ratio, orders, left);
    if (near.told.empty()) return remainder;
    if (remainder.follows.empty()) {
      remainder.follows = "what is left " + near.told;
      remainder.p_value = near.p_value;
      remainder.share = near.share;
      remainder.noise_nm = near.noise_nm;
    }
    remainder.noise_nm = std::min(remainder.noise_nm, near.noise_nm);
    return remainder;
  }

  /// Where effects that have places may lie, and of places that explain as much one that was run.
  [[nodiscard]] std::vector<std::vector<Parameter>> figures_of_places(
      double shared, std::vector<DriveEffect>& effects) const {
    std::vector<std::vector<Parameter>> figures(effects.size());
    const DriveContext here = selection_.context();
    for (std::size_t e = 0; e < effects.size(); ++e) {
      if (!effects[e].family->figures) continue;
      const DriveFit fit(here, selection_.value_nm(), effects, FitRows::kAll);
      const double rows = static_cast<double>(selection_.table().points.size());
      const double noise = fit.residual_square() / std::max(1.0, rows - size_of(effects));
      const double t = student_95(fit.degrees());
      const PlaceProfile profile = profile_of_place(here, selection_.value_nm(), effects, e,
                                                    FitRows::kAll, t * t * noise * shared);
      effects[e].shape = profile.shape;
      figures[e] = profile.figures;
    }
    return figures;
  }

  void list_observable(const DriveOutcome& outcome, LoopResult& r) const {
    std::set<std::string> seen;
    for (std::size_t g = 0; g < selection_.candidates().size(); ++g)
      if (g < outcome.discovery.observable.size() && outcome.discovery.observable[g])
        seen.insert(selection_.candidates()[g].family->id);
    for (const DriveFamily& family : drive_library())
      if (family.named && !seen.contains(family.id) &&
          std::find(r.not_observable.begin(), r.not_observable.end(), family.id) ==
              r.not_observable.end())
        r.not_observable.push_back(family.id);
  }

  void judge(const DriveOutcome& outcome, const BenchRemainder& remainder, const DriveFit& all,
             LoopResult& r) {
    constexpr double kLeft = 0.01, kSureThoughDenied = 0.0015;
    const DiscoveryResult& d = outcome.discovery;
    const bool left = d.p_left <= kLeft && d.most_likely_left >= 0;
    if (outcome.effects.empty())
      // What the hold-out denied must be surer than what it was not asked about.
      r.verdict = d.first_p_value <= selection_.share_of_level() *
                                         (selection_.vetoed() ? kSureThoughDenied : kLeft)
                      ? Verdict::kPartlyExplained
                      : Verdict::kNoEffect;
    else
      r.verdict = left ? Verdict::kPartlyExplained : Verdict::kExplained;
    if (left)
      r.structure_left = "what is left looks most like " +
                         words_for(selection_.model(), selection_.candidates()[d.most_likely_left]);
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
        r.after.held_out_rms > larger_than_noise(r.noise, rows_that_count())) {
      r.verdict = Verdict::kPartlyExplained;
      r.structure_left = printed(
          "on the rows held out from the fit %.2g times the noise is left: these effects fit the "
          "rows they were "
          "found in better than others",
          r.after.held_out_rms / r.noise);
    }
    judge_impossible(all, r);
  }

  /// A quarter above the noise, and as much more as the rms of so few rows may scatter.
  [[nodiscard]] static double larger_than_noise(double noise, double rows) {
    return noise * (1.25 + 3.0 / std::sqrt(2.0 * std::max(1.0, rows)));
  }

  /// Of the rows held out: where the errors of a direction differ the larger ones make the figure.
  [[nodiscard]] double rows_that_count() const {
    double count = 0.0;
    for (const bool forward : {true, false}) {
      double square = 0.0, fourth = 0.0;
      for (const BenchPoint& p : selection_.table().points) {
        if (p.fold != 0 || p.forward != forward) continue;
        square += p.sigma_nm * p.sigma_nm;
        fourth += std::pow(p.sigma_nm, 4);
      }
      if (fourth > 0.0) count += square * square / fourth;
    }
    return count;
  }

  /// What readings in steps add to the residual: all of a dwell may be rounded alike. A sensor's
  /// step shows where it reads the driven side.
  [[nodiscard]] double rounding_nm() const {
    std::array<std::vector<double>, 2> driven;  // of the input backward, of the output forward
    for (const BenchPoint& p : selection_.table().points)
      driven[p.forward ? 1 : 0].push_back(p.driven_nm);
    const double ratio = selection_.model().ratio, input = step_of(std::move(driven[0])),
                 output = step_of(std::move(driven[1]));
    return std::max(1.0, 1.0 / ratio) * std::hypot(output, ratio * input) / std::sqrt(12.0);
  }

  /// A torque that is logged in steps as wide as what is called noise hides what is smaller.
  void say_which_readings_are_coarse(LoopResult& r) const {
    constexpr double kMuch = 0.5;  // of the noise
    const auto& points = selection_.table().points;
    for (const bool output : {true, false}) {
      std::vector<double> read;
      double square = 0.0;  // of what 1 N m too much moves the driven torque by
      for (const BenchPoint& p : points) {
        const bool driven = p.forward == output;
        read.push_back(driven ? p.driven_nm : p.driving_nm);
        square += driven || !(p.driving_nm > 0.0) ? 1.0 : std::pow(p.driven_nm / p.driving_nm, 2);
      }
      const double step = lattice_step_of(read),
                   error = step * std::sqrt(square / (12.0 * static_cast<double>(points.size())));
      if (!(error > kMuch * r.noise)) continue;
      r.notes.push_back(
          printed("the %s torque is logged in steps of %.3g N m, which make %.2g N m rms of the "
                  "%.2g N m that are called noise: what is smaller is hidden; log it finer",
                  output ? "output's" : "input's", step, error, r.noise));
    }
  }

  /// Few set points of many rows each can be turned over in so few ways that no effect is surer
  /// than chance: then readings within a set point, as many of them as do not hang together, say
  /// whether the set points are off the model.
  void say_where_set_points_lie_off(const Eigen::VectorXd& left, LoopResult& r) const {
    constexpr double kSure = 1e-6, kSlow = 0.95, kRowsEach = 20.0;
    constexpr int kFewest = 3;
    const auto& points = selection_.table().points;
    const std::vector<int> visit = visits_of(points, set_points_of(points));
    const int visits = visit.empty() ? 0 : visit.back() + 1;
    const auto rows = static_cast<double>(points.size());
    if (visits < kFewest || rows < kRowsEach * visits) return;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(visits), count = mean;
    for (std::size_t i = 0; i < points.size(); ++i) {
      mean[visit[i]] += left[static_cast<Eigen::Index>(i)];
      count[visit[i]] += 1.0;
    }
    mean = mean.cwiseQuotient(count).eval();
    double within = 0.0, beside = 0.0, last = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double off = left[static_cast<Eigen::Index>(i)] - mean[visit[i]];
      within += off * off;
      if (i > 0 && visit[i] == visit[i - 1]) beside += off * last;
      last = off;
    }
    const double alike = std::max(0.0, beside / within);
    if (!(within > 0.0) || alike > kSlow) return;
    const double square = within / (rows - visits), rounding = rounding_nm(),
                 together = (1.0 + alike) / (1.0 - alike),
                 off_square =
                     count.dot((mean.cwiseAbs2().array() - rounding * rounding).matrix()) / visits;
    const double p = f_tail(off_square / (square * together), visits, (rows - visits) / together);
    if (p > kSure) return;
    r.verdict = Verdict::kPartlyExplained;
    r.structure_left_p_value = std::min(r.structure_left_p_value, p);
    r.noise = std::sqrt(square);
    r.structure_left = printed(
        "the %d set points lie %.2g N m off the model, and readings of one set point scatter by "
        "%.2g N m: something is lost or read wrong, but so few set points do not tell what",
        visits, std::sqrt(off_square * visits / rows), r.noise);
    r.measure_next.insert(
        r.measure_next.begin(),
        "run more loads and speeds, ten set points or more: these are too few to tell "
        "one effect from chance");
  }

  /// Errors that hang together look like something slow: who reads "noise" is told so.
  void say_what_neighbours_share(const Eigen::VectorXd& left,
                                 const std::vector<DriveEffect>& effects, LoopResult& r) const {
    // Beside a course of the run that has no name less is enough: more of it is the likely reason.
    constexpr double kMuch = 0.35, kBesideACourse = 0.25;
    constexpr Eigen::Index kFewest = 60;
    if (left.size() < kFewest) return;
    const double shared = shared_by_neighbours(left);
    const bool course = std::any_of(effects.begin(), effects.end(), [](const DriveEffect& e) {
      return e.family->shape_of_wander || (e.family->shape_of_spell && e.shape[1] == 0.0);
    });
    const double enough =
        course ? std::max(kBesideACourse, 3.5 / std::sqrt(static_cast<double>(left.size()))) : kMuch;
    const auto [visits, by_visits] = shared_by_visits(left);
    const bool rows = shared > enough;
    if (!rows && !(by_visits > std::max(kMuch, 3.5 / std::sqrt(static_cast<double>(visits))))) return;
    const std::string text = printed(
        "neighbouring %s share %.0f %% of what is left: errors that hang together, or something "
        "slow that these "
        "columns do not hold (the same set points again, in another order, would tell)",
        rows ? "rows" : "set points", 100.0 * (rows ? shared : by_visits));
    if (r.verdict == Verdict::kExplained) {
      r.verdict = Verdict::kPartlyExplained;
      r.structure_left = text;
    } else {
      r.structure_left += "; " + text;
    }
  }

  /// As it is or turned over in one direction, as what a sensor of the output shares shows.
  [[nodiscard]] double shared_by_neighbours(const Eigen::VectorXd& left) const {
    const auto& points = selection_.table().points;
    const std::vector<int> set_point = set_points_of(points);
    Eigen::VectorXd alike = left, opposite = left;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      alike[row] /= points[i].sigma_nm;
      opposite[row] = points[i].forward ? alike[row] : -alike[row];
    }
    return std::max(correlation_of_visits(alike, set_point),
                    correlation_of_visits(opposite, set_point));
  }

  /// The same of whole dwells: where every set point was visited once, the rows of a dwell have their common
  /// error in the set point's mean.
  [[nodiscard]] std::pair<int, double> shared_by_visits(const Eigen::VectorXd& left) const {
    constexpr int kFewestVisits = 48;
    const auto& points = selection_.table().points;
    const std::vector<int> set_point = set_points_of(points), visit = visits_of(points, set_point);
    const int visits = visit.empty() ? 0 : visit.back() + 1;
    if (visits < kFewestVisits || 2 * static_cast<std::size_t>(visits) > points.size())
      return {visits, 0.0};
    Eigen::VectorXd alike = Eigen::VectorXd::Zero(visits), count = alike;
    std::vector<int> of_visit(static_cast<std::size_t>(visits));
    for (std::size_t i = 0; i < points.size(); ++i) {
      alike[visit[i]] += left[static_cast<Eigen::Index>(i)] / points[i].sigma_nm;
      count[visit[i]] += 1.0;
      of_visit[static_cast<std::size_t>(visit[i])] = set_point[i];
    }
    alike = alike.cwiseQuotient(count.cwiseSqrt()).eval();
    Eigen::VectorXd opposite = alike;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].forward) opposite[visit[i]] = -alike[visit[i]];
    return {visits, std::max(correlation_of_visits(alike, of_visit),
                             correlation_of_visits(opposite, of_visit))};
  }

  /// True where no power is gained once what the sensors read wrong is taken off. Of both
  /// directions a scale or a zero that has a name stands for a friction as well: that stays open.
  /// Of one direction nothing else could be told, and the names it stands for are said with it.
  [[nodiscard]] bool readings_explain_the_gain(const DriveFit& all) const {
    const BenchTable& table = selection_.table();
    const bool both = table.has(true) && table.has(false);
    std::vector<double> taken_off(table.points.size(), 0.0);
    bool any = false;
    for (std::size_t e = 0; e < all.effects().size(); ++e) {
      if (all.effects()[e].family->is_loss) continue;
      if (both && all.effects()[e].family->named) return false;
      any = true;
      const Eigen::VectorXd moved = all.explained_nm(static_cast<int>(e));
      for (std::size_t i = 0; i < taken_off.size(); ++i)
        taken_off[i] += moved[static_cast<Eigen::Index>(i)];
    }
    return any && power_gained(table.points, selection_.model().ratio, taken_off).file < 0;
  }

  void judge_impossible(const DriveFit& all, LoopResult& r) const {
    const std::vector<DriveEffect>& effects = all.effects();
    if (selection_.table().impossible == Impossible::kNothing) return;
    if (selection_.table().impossible == Impossible::kEfficiencyAboveOne) {
      if (r.verdict == Verdict::kExplained && readings_explain_the_gain(all)) {
        r.notes.push_back(selection_.table().impossible_text +
                          "; with what the sensors read wrong taken off, none is gained");
        return;
      }
      r.verdict = Verdict::kPartlyExplained;
      const bool losses = std::any_of(effects.begin(), effects.end(),
                                      [](const auto& e) { return e.family->is_loss; });
      const bool reads_oddly = std::any_of(effects.begin(), effects.end(), [](const auto& e) {
        return !e.family->named && !e.family->is_loss;
      });
      r.structure_left =
          selection_.table().impossible_text +
          (reads_oddly ? "; a sensor reads wrong in these data, and "
                       : "; a torque scale or an offset is in these data, and ") +
          (losses ? "the losses beside it are as sure as it is" : "no friction was fitted to them");
      r.notes.push_back(selection_.table().impossible_text);
      return;
    }
    r.notes.push_back(selection_.table().impossible_text +
                      "; the data were put right and judged so: correct the file");
    FoundEffect swapped;
    swapped.id = "swapped_side";
    swapped.description = selection_.table().impossible_text;
    swapped.cause = "columns or directions of the bench's file were mixed up";
    swapped.correction = "correct the file";
    swapped.correctable = false;
    swapped.sentence = selection_.table().impossible_text + first_action(swapped.correction);
    swapped.sure = "as good as certain: no drive can have such torques";
    swapped.explained_fraction = kNaN;
    r.effects.insert(r.effects.begin(), swapped);
    if (r.verdict == Verdict::kNoEffect) r.verdict = Verdict::kExplained;
  }

  DriveSelection selection_;
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
  auto [done, doubted] = DriveReport(model, *table, options).close_and_doubt_hold_out();
  if (!doubted) return std::move(done);
  // Another hold-out, and what leaves clearly less of all rows.
  constexpr double kClearlyLess = 0.9;
  deal_hold_out_anew(*table);
  DriveLoop anew = DriveReport(model, std::move(*table), options).close();
  // (states of single rows follow a few wild ones as well)
  const auto tells_states = [](const DriveLoop& loop) {
    return std::any_of(loop.effects.begin(), loop.effects.end(),
                       [](const DriveEffect& e) { return bool(e.family->shape_of_states); });
  };
  const bool less = anew.result.after.rms < kClearlyLess * done.result.after.rms,
             by_states = !done.effects.empty() && tells_states(anew) && !tells_states(done);
  return less && !by_states ? std::move(anew) : std::move(done);
}

DriveLoop close_drive_table(const DriveModel& model, BenchTable table,
                            const DriveLoopOptions& options) {
  measure_extent(table);
  return DriveReport(model, std::move(table), options).close();
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
