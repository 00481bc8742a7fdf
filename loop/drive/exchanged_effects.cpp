// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/exchanged_effects.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/drive/found_drive_effects.h"
#include "trueflank/loop/result/describe.h"

namespace trueflank::loop {
namespace {

constexpr double kTie = 4.0;  // chi-square
/// Square of the cosine between what two effects do beside the others: less of it and no shape or
/// place about which they are linear makes one of them do what the other does.
constexpr double kMayBeAlike = 0.6;
/// What stands beside the others in one effect's place must be its own: at least this part of how far the
/// effect itself is. Two that make up for each other, as a scale beside a friction that differs between the
/// directions, are no plain cause.
constexpr double kOwnPart = 0.1;

class Exchange {
 public:
  Exchange(DriveSelection& selection, const std::vector<DriveEffect>& effects,
           std::vector<FoundEffect>& found)
      : selection_(selection), effects_(effects), found_(found) {}

  /// True where what follows the run leaves surely less than what follows the temperature.
  bool run() {
    const DriveState state = selection_.state();
    const double own = square_of(effects_);
    double rows = 0.0;
    for (const BenchPoint& p : selection_.table().points) rows += p.sigma_nm > 0.0 ? 1.0 : 0.0;
    const double noise = own / std::max(1.0, rows - static_cast<double>(effects_.size()));
    for (std::size_t e = 0; e < effects_.size(); ++e)
      for (const DriveEffect& other : in_place_of(e)) {
        std::vector<DriveEffect> with = effects_;
        with[e] = other;
        settle(with);
        if (square_of(with) - own < kTie * noise && possible(with)) hold(with, e);
        selection_.move_state_to(state);
      }
    return ask_the_run(own, rows);
  }

 private:
  /// What follows the temperature may follow the run in which the drive grew warm: what explains as much
  /// and follows the run has the name of a drag that changes over the file.
  bool ask_the_run(double own, double rows) {
    constexpr double kSure = 25.0;  // chi-square
    const double free = std::max(1.0, rows - static_cast<double>(effects_.size()));
    bool surely_less = false;
    const DriveState state = selection_.state();
    const auto named = std::find_if(drive_library().begin(), drive_library().end(),
                                    [](const DriveFamily& f) { return f.named && f.follows_the_run; });
    for (std::size_t e = 0; e < effects_.size(); ++e) {
      FoundEffect* as_told = told(effects_[e]);
      if (as_told == nullptr || effects_[e].family->follows != "warmth") continue;
      bool as_well = false;
      for (const DriveEffect& other : selection_.candidates()) {
        if (!other.family->follows_the_run) continue;
        std::vector<DriveEffect> with = effects_;
        with[e] = other;
        settle(with);
        const double square = square_of(with);
        as_well = as_well || square - own < kTie * own / free;
        surely_less = surely_less || own - square > kSure * square / free;
        selection_.move_state_to(state);
      }
      if (as_well && named != drive_library().end()) cannot_be_told_from(*as_told, named->id);
    }
    return surely_less;
  }

  [[nodiscard]] FoundEffect* told(const DriveEffect& effect) {
    const auto is_it = [&](const FoundEffect& f) {
      return f.named && f.id == effect.family->id && f.side == effect.family->side;
    };
    // (of two of one name nobody says which is meant)
    const auto at = std::find_if(found_.begin(), found_.end(), is_it);
    return at == found_.end() || std::count_if(at, found_.end(), is_it) > 1 ? nullptr : &*at;
  }

  /// Named effects of one column that do nearly the same, of each the shape that does most; of its
  /// own kind those of another form, as one that fades by another exponent.
  [[nodiscard]] std::vector<DriveEffect> in_place_of(std::size_t e) {
    const DriveFamily* own = effects_[e].family;
    std::vector<DriveEffect> others;
    if (told(effects_[e]) == nullptr || effects_[e].columns() != 1) return others;
    const Beside beside = beside_of(e);
    double best = 0.0;
    for (const DriveEffect& candidate : selection_.candidates()) {
      const DriveFamily* family = candidate.family;
      bool taken = of_one_form(candidate, effects_[e]) || (family == own && family->of_one_mesh);
      for (std::size_t k = 0; k < effects_.size(); ++k)
        taken = taken || (k != e && effects_[k].family->id == family->id);
      // One with more figures holds this one as a limit: no other cause.
      if (taken || !family->named || candidate.columns() != 1 ||
          figures_of(*family) > figures_of(*own) || !selection_.may_be_there(*family))
        continue;
      const Eigen::VectorXd column = column_of(candidate), rest = beside.rest_of(column);
      if (rest.squaredNorm() < kOwnPart * beside.own_part * column.squaredNorm()) continue;
      const double alike = std::pow(rest.dot(beside.own), 2) /
                           std::max(rest.squaredNorm() * beside.own.squaredNorm(), 1e-300);
      if (alike < kMayBeAlike) continue;
      const bool same = !others.empty() && (family == own ? of_one_form(others.back(), candidate)
                                                          : others.back().family == family);
      if (same && alike <= best) continue;
      best = alike;
      if (same)
        others.back() = candidate;
      else
        others.push_back(candidate);
    }
    return others;
  }

  /// True where nothing but values that a fit moves differ.
  [[nodiscard]] static bool of_one_form(const DriveEffect& a, const DriveEffect& b) {
    if (a.family != b.family || a.shape.size() != b.shape.size()) return false;
    for (std::size_t k = 0; k < a.shape.size(); ++k) {
      const bool moves = k < a.family->shape_values.size() && a.family->shape_values[k].continuous;
      if (!moves && a.shape[k] != b.shape[k]) return false;
    }
    return true;
  }

  [[nodiscard]] static std::size_t figures_of(const DriveFamily& family) {
    return family.parameters.size() +
           static_cast<std::size_t>(std::count_if(family.shape_values.begin(), family.shape_values.end(),
                                                  [](const auto& value) { return value.continuous; }));
  }

  /// What is left of a column beside all effects but one, in the noise's units.
  struct Beside {
    Eigen::MatrixXd others;  ///< orthonormal
    Eigen::VectorXd own;
    double own_part = 1.0;  ///< of the square of the whole column
    [[nodiscard]] Eigen::VectorXd rest_of(const Eigen::VectorXd& column) const {
      return column - others * (others.transpose() * column);
    }
  };
  [[nodiscard]] Beside beside_of(std::size_t e) const {
    const DriveContext here = selection_.context();
    const DriveFit fit(here, selection_.value_nm(), effects_, FitRows::kAll);
    const int first = fit.first_column(static_cast<int>(e));
    std::vector<Eigen::Index> kept;
    for (Eigen::Index c = 0; c < fit.columns().cols(); ++c)
      if (c != first) kept.push_back(c);
    const Eigen::MatrixXd others = weights().asDiagonal() * fit.columns()(Eigen::all, kept);
    Beside beside;
    beside.others = orthonormal_columns(others);
    const Eigen::VectorXd column = weights().cwiseProduct(fit.columns().col(first));
    beside.own = beside.rest_of(column);
    beside.own_part = beside.own.squaredNorm() / std::max(column.squaredNorm(), 1e-300);
    return beside;
  }
  [[nodiscard]] Eigen::VectorXd weights() const {
    const auto& points = selection_.table().points;
    Eigen::VectorXd weights(static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
      weights[static_cast<Eigen::Index>(i)] = 1.0 / points[i].sigma_nm;
    return weights;
  }
  [[nodiscard]] Eigen::VectorXd column_of(const DriveEffect& effect) const {
    const DriveContext here = selection_.context();
    const auto& points = selection_.table().points;
    Eigen::VectorXd column(static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
      double value = 0.0;
      effect.family->evaluate(here, points[i], effect.shape, &value);
      column[static_cast<Eigen::Index>(i)] = value / points[i].sigma_nm;
    }
    return column;
  }

  void settle(std::vector<DriveEffect>& effects) {
    for (int round = 0; round < 4; ++round) {
      const DriveContext here = selection_.context();
      selection_.move_state_to(
          DriveSelection::state_of(DriveFit(here, selection_.value_nm(), effects, FitRows::kAll)));
      refine_drive_shapes(selection_.context(), selection_.value_nm(), FitRows::kAll, effects);
    }
  }
  [[nodiscard]] double square_of(const std::vector<DriveEffect>& effects) const {
    const DriveContext here = selection_.context();
    return DriveFit(here, selection_.value_nm(), effects, FitRows::kAll).residual_square();
  }

  [[nodiscard]] bool possible(const std::vector<DriveEffect>& with) const {
    const DriveContext here = selection_.context();
    const DriveFit fit(here, selection_.value_nm(), with, FitRows::kAll);
    if (!fit.can_be()) return false;
    const DriveState state = DriveSelection::state_of(fit);
    return selection_.rubs_both_ways(state) && selection_.every_mesh_rubs(state);
  }

  /// The intervals of all but the exchanged one hold what they are in the other set, and its own
  /// where its form alone was exchanged; else it is said to be indistinguishable from what stands
  /// in its place.
  void hold(const std::vector<DriveEffect>& with, std::size_t exchanged) {
    const DriveContext here = selection_.context();
    const DriveFit fit(here, selection_.value_nm(), with, FitRows::kAll);
    const Eigen::MatrixXd covariance = fit.covariance();
    for (std::size_t e = 0; e < with.size(); ++e) {
      FoundEffect* as_told = told(effects_[e]);
      if (as_told == nullptr) continue;
      if (e == exchanged && with[e].family != effects_[e].family) {
        if (with[e].family->id == as_told->id)
          may_be_the_other_sensors(*as_told, with[e],
                                   fit.coefficients()[fit.first_column(static_cast<int>(e))]);
        else
          cannot_be_told_from(*as_told, with[e].family->id);
        continue;
      }
      for (const Parameter& other : drive_parameters(fit, covariance, static_cast<int>(e)))
        for (Parameter& p : as_told->parameters) {
          if (p.name != other.name) continue;
          p.low = std::min(p.low, other.low);
          p.high = std::max(p.high, other.high);
        }
    }
  }
  /// One of the two sensors, and these data do not say which.
  void may_be_the_other_sensors(FoundEffect& effect, const DriveEffect& other,
                                double coefficient) const {
    const std::size_t told = effect.description.size();
    if (other.family->told)
      effect.description += ", or " +
                            other.family->told(selection_.context(), other.shape, coefficient, {}) +
                            " (these data do not say which)";
    effect.sentence = capitalised(effect.description) +
                      effect.sentence.substr(std::min(told, effect.sentence.size()));
    cannot_be_told_from(effect, of_side(other.family->id, other.family->side));
  }
  static void cannot_be_told_from(FoundEffect& effect, const std::string& id) {
    std::vector<std::string>& others = effect.confounded_with;
    if (id == effect.id || std::find(others.begin(), others.end(), id) != others.end()) return;
    others.push_back(id);
    std::sort(others.begin(), others.end());
    effect.sure = sure_words(effect.p_value, others);
  }

  DriveSelection& selection_;
  const std::vector<DriveEffect>& effects_;
  std::vector<FoundEffect>& found_;
};

}  // namespace

bool hold_exchanged_effects(DriveSelection& selection, const std::vector<DriveEffect>& effects,
                            std::vector<FoundEffect>& found) {
  return !effects.empty() && Exchange(selection, effects, found).run();
}

}  // namespace trueflank::loop
