// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/discovery.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/block_statistics.h"
#include "trueflank/loop/discovery/cross_validation.h"
#include "trueflank/loop/discovery/kept_sums.h"
#include "trueflank/loop/discovery/quick_errors.h"
#include "trueflank/loop/discovery/structure_test.h"

namespace trueflank::loop {
namespace {

/// Chi-square by which anchors tell two models apart.
constexpr double kAnchorsTell = 4.0;
/// Share of what two effects explain that one preferred to them may leave: second order of displacements,
/// which is put right once the effect is chosen.
constexpr double kNearly = 3e-3;
/// Chi-square in the folds that is nothing, rounding included.
constexpr double kNothing = 0.5;

}  // namespace

class Discovery::Selection {
 public:
  Selection(const DiscoveryProblem& problem, const DiscoveryOptions& options)
      : problem_(problem),
        options_(options),
        kept_(problem.kept),
        sums_(kept_ ? kept_->taken_for(problem) : std::make_unique<BlockStatistics>(problem)),
        statistics_(*sums_),
        beside_(problem_, statistics_, options_.banned) {
    for (int i = 0; i < statistics_.model_columns(); ++i) nuisance_.push_back(i);
  }
  Selection(const Selection&) = delete;
  Selection& operator=(const Selection&) = delete;
  ~Selection() {
    if (kept_) kept_->give_back(std::move(sums_));
  }

  /// All but what finished() adds.
  void choose() {
    forward();
    if (chosen_.empty()) return;
    simplify();
    const FoldErrors full = CrossValidation(problem_, statistics_, active()).base_errors();
    for (int i = 0; i < static_cast<int>(chosen_.size()); ++i) {
      ChosenGroup& record = chosen_[i].record;
      const FoldErrors gain =
          CrossValidation(problem_, statistics_, active(i)).base_errors() - full;
      record.gain = gain.sum() / statistics_.total_weight();
      record.gain_error = total_error_of(gain) / statistics_.total_weight();
      result_.chosen.push_back(record);
    }
  }
  [[nodiscard]] const DiscoveryResult& result() const { return result_; }
  /// BIC, confounded groups of the final set, and the test of what is left.
  DiscoveryResult finished() {
    if (chosen_.empty()) return result_;
    const FoldErrors full = CrossValidation(problem_, statistics_, active()).base_errors();
    for (int i = 0; i < static_cast<int>(chosen_.size()); ++i) {
      result_.chosen[i].bic_gain = bic_gain(i);
      find_confounded(i, full);
    }
    if (active() == tested_) return result_;
    beside_.put_beside(active());
    const StructureTest test(problem_, statistics_, beside_, options_.flips, options_.banned);
    result_.p_left = test.p_value();
    result_.most_likely_left = test.most_likely();
    return result_;
  }

 private:
  struct Tried {
    int group;
    FoldErrors gain;
  };
  struct Chosen {
    ChosenGroup record;
    int first_model_column = 0;
  };

  [[nodiscard]] std::vector<int> active(int without = -1, int without2 = -1) const {
    std::vector<int> columns = nuisance_;
    for (int i = 0; i < static_cast<int>(chosen_.size()); ++i) {
      if (i == without || i == without2) continue;
      for (int k = 0; k < problem_.groups[chosen_[i].record.group].columns; ++k)
        columns.push_back(chosen_[i].first_model_column + k);
    }
    return columns;
  }
  /// Standard error of a sum over the ordinary folds.
  [[nodiscard]] double total_error_of(FoldErrors folds) const {
    double n = static_cast<double>(folds.size());
    double mean = folds.sum(), squares = folds.squaredNorm();
    if (problem_.anchor_fold > 0 && problem_.anchor_fold <= folds.size()) {
      const double anchor = folds[problem_.anchor_fold - 1];
      mean -= anchor;
      squares -= anchor * anchor;
      n -= 1.0;
    }
    if (n < 2.0) return 0.0;
    mean /= n;
    return std::sqrt(std::max(0.0, n * (squares - n * mean * mean) / (n - 1.0)));
  }
  /// True where a loss of prediction is no more than its error, in the folds and at the anchors. With a
  /// margin: perhaps it is, where every fold may be off by so much.
  [[nodiscard]] bool is_tie(const FoldErrors& loss, double margin = 0.0) const {
    double anchor = 0.0;
    if (problem_.anchor_fold > 0 && problem_.anchor_fold <= loss.size())
      anchor = loss[problem_.anchor_fold - 1];
    // (the standard error of a sum follows its terms by less than four times their number)
    return anchor <= kAnchorsTell + margin &&
           loss.sum() - anchor <= std::max(total_error_of(loss), kNothing) +
                                      4.0 * static_cast<double>(loss.size()) * margin;
  }
  [[nodiscard]] bool is_chosen(int group) const {
    return std::any_of(chosen_.begin(), chosen_.end(),
                       [&](const Chosen& c) { return c.record.group == group; });
  }
  [[nodiscard]] bool allowed(int group) const {
    if (!options_.banned.empty() && options_.banned[group]) return false;
    if (!result_.observable[group] || is_chosen(group)) return false;
    // One effect enters once: not again at a neighbouring shape.
    const int kin = problem_.groups[group].kin;
    return kin < 0 || std::none_of(chosen_.begin(), chosen_.end(), [&](const Chosen& c) {
             return problem_.groups[c.record.group].kin == kin;
           });
  }

  void forward() {
    while (true) {
      // What a full model leaves is asked once it is simplified.
      const int most = options_.most_effects;
      if (!chosen_.empty() && static_cast<int>(chosen_.size()) >= most) return;
      tested_ = active();
      beside_.put_beside(tested_);
      const StructureTest test(problem_, statistics_, beside_, options_.flips, options_.banned);
      if (result_.observable.empty()) result_.observable = test.observable();
      const bool first = chosen_.empty();
      if (first) {
        result_.first_common_p_value = test.p_value();
        result_.first_p_value = std::min(test.p_value(), test.local_p_value());
      }
      result_.p_left = test.p_value();
      result_.most_likely_left = test.most_likely();
      if (most <= 0) return;
      if (test.local_p_value() < options_.local_level &&
          (test.local_p_value() < test.most_likely_single_p_value() || test.p_value() > 0.02) &&
          allowed(test.most_likely_local())) {
        add(test.most_likely_local(), test.local_p_value());
        continue;
      }
      const double level = first ? options_.first_level : options_.next_level;
      if (test.p_value() > level) return;
      const auto pick = best_candidate(test, level);
      if (!pick) return;
      add(*pick, test.p_value_of(*pick));
    }
  }

  void add(int group, double p_value) {
    Chosen chosen;
    chosen.record.group = group;
    chosen.record.p_value = p_value;
    chosen.first_model_column = statistics_.add_group(group);
    chosen_.push_back(chosen);
  }

  /// The candidate that predicts the folds best, or a preferred one as good within a standard error.
  std::optional<int> best_candidate(const StructureTest& test, double level) const {
    const CrossValidation model(problem_, statistics_, active());
    const FoldErrors base = model.base_errors();
    std::vector<int> asked;
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g)
      if (allowed(g) && problem_.groups[g].local_family < 0 && !(test.p_value_of(g) > level))
        asked.push_back(g);
    const std::vector<FoldErrors> with = model.errors_with(asked);
    std::vector<Tried> tried;
    for (std::size_t i = 0; i < asked.size(); ++i) tried.push_back({asked[i], base - with[i]});
    if (tried.empty()) return std::nullopt;
    const auto best = std::max_element(tried.begin(), tried.end(), [](const auto& a, const auto& b) {
      return a.gain.sum() < b.gain.sum();
    });
    if (is_tie(best->gain)) return std::nullopt;
    return preferred(tried, *best);
  }

  /// Of those as good as the best the one with the lowest preference, then the fewest columns, then the
  /// simplest, then the one that gains most. Names of the same columns gain alike but for rounding: of
  /// them the one listed first.
  [[nodiscard]] int preferred(const std::vector<Tried>& tried, const Tried& best) const {
    const double rounding = 1e-9 * std::abs(best.gain.sum());
    const auto rank = [&](const Tried& t) {
      const CandidateGroup& group = problem_.groups[t.group];
      return std::tuple(group.preference, group.columns, group.complexity);
    };
    const Tried* pick = nullptr;
    for (const Tried& other : tried) {
      if (&other != &best && !is_tie(best.gain - other.gain)) continue;
      if (!pick || rank(other) < rank(*pick) ||
          (rank(other) == rank(*pick) && other.gain.sum() > pick->gain.sum() + rounding))
        pick = &other;
    }
    return pick->group;
  }

  void simplify() {
    for (int round = 0; round < 6; ++round)
      if (!remove_idle() && !merge_two() && !replace_one()) return;
  }

  /// Removes the chosen group that earns least, where that is less than a standard error.
  bool remove_idle() {
    const FoldErrors full = CrossValidation(problem_, statistics_, active()).base_errors();
    int worst = -1;
    double least = 1e300;
    for (int i = 0; i < static_cast<int>(chosen_.size()); ++i) {
      if (problem_.groups[chosen_[i].record.group].local_family >= 0) continue;
      const FoldErrors loss =
          CrossValidation(problem_, statistics_, active(i)).base_errors() - full;
      const double ratio = loss.sum() / std::max(total_error_of(loss), 1e-300);
      if (is_tie(loss) && ratio < least) {
        least = ratio;
        worst = i;
      }
    }
    if (worst < 0) return false;
    chosen_.erase(chosen_.begin() + worst);
    return true;
  }

  /// Places of a chosen group's columns in active().
  [[nodiscard]] std::vector<Eigen::Index> places_of(const std::vector<int>& chosen) const {
    std::vector<Eigen::Index> places;
    auto at = static_cast<Eigen::Index>(nuisance_.size());
    for (int i = 0; i < static_cast<int>(chosen_.size()); ++i) {
      const int columns = problem_.groups[chosen_[i].record.group].columns;
      for (int k = 0; k < columns; ++k, ++at)
        if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) places.push_back(at);
    }
    return places;
  }
  /// Quick errors of the model as it is, for every group that may stand in place of another.
  const QuickErrors& quick_errors() {
    const std::vector<int> columns = active();
    if (quick_ && quick_of_ == columns) return *quick_;
    std::vector<int> groups;
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g)
      if (problem_.groups[g].local_family < 0 && result_.observable[g] && !is_chosen(g))
        groups.push_back(g);
    quick_of_ = columns;
    return quick_.emplace(problem_, statistics_, columns, groups);
  }
  /// Of groups asked in place of some chosen ones those that are worth an exact answer: `may(group, loss,
  /// earned, margin)` is asked with quick errors, less those of the whole model.
  template <class May>
  std::vector<int> worth_asking(const std::vector<int>& instead_of, const std::vector<int>& asked,
                                const FoldErrors& full, const May& may) {
    // Of few exchanges the exact answers cost no more.
    if (chosen_.size() < 3) return asked;
    const QuickErrors& quick = quick_errors();
    if (!quick.are_reliable()) return asked;
    const QuickErrors::Less less = quick.errors_less(places_of(instead_of), asked);
    const double earned = (less.base - full).sum();
    std::vector<int> groups;
    for (std::size_t n = 0; n < asked.size(); ++n)
      if (may(asked[n], less.with[n] - full, earned, quick.rounding())) groups.push_back(asked[n]);
    return groups;
  }

  /// One candidate in place of two chosen ones, where it predicts as well.
  bool merge_two() {
    if (chosen_.size() < 2) return false;
    const FoldErrors full = CrossValidation(problem_, statistics_, active()).base_errors();
    for (int i = 0; i < static_cast<int>(chosen_.size()); ++i)
      for (int k = i + 1; k < static_cast<int>(chosen_.size()); ++k) {
        const CandidateGroup& a = problem_.groups[chosen_[i].record.group];
        const CandidateGroup& b = problem_.groups[chosen_[k].record.group];
        // A name for one flank may stand for a name for both and what the other flank lacks of it.
        const int limit = std::min(a.preference, b.preference);
        const int most = std::max(a.preference, b.preference);
        const auto may_merge = [&](int g, const FoldErrors& loss, double earned, double margin) {
          return is_tie(loss, margin) ||
                 (problem_.groups[g].preference < most &&
                  loss.sum() < kNearly * earned + static_cast<double>(2 * loss.size()) * margin);
        };
        std::vector<int> asked;
        for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
          const CandidateGroup& group = problem_.groups[g];
          if (allowed(g) && group.local_family < 0 &&
              group.preference <= (group.named && a.named != b.named ? most : limit) &&
              group.columns < a.columns + b.columns)
            asked.push_back(g);
        }
        asked = worth_asking({i, k}, asked, full, may_merge);
        if (asked.empty()) continue;
        const CrossValidation model(problem_, statistics_, active(i, k));
        const double earned = (model.base_errors() - full).sum();
        const std::vector<FoldErrors> with = model.errors_with(asked);
        int best = -1;
        double best_loss = 1e300;
        for (std::size_t n = 0; n < asked.size(); ++n) {
          const FoldErrors loss = with[n] - full;
          if (may_merge(asked[n], loss, earned, 0.0) && loss.sum() < best_loss) {
            best_loss = loss.sum();
            best = asked[n];
          }
        }
        if (best < 0) continue;
        const double p_value = std::min(chosen_[i].record.p_value, chosen_[k].record.p_value);
        chosen_.erase(chosen_.begin() + k);
        chosen_.erase(chosen_.begin() + i);
        add(best, p_value);
        return true;
      }
    return false;
  }

  /// Another candidate in place of a chosen one, where it predicts better by a standard error.
  bool replace_one() {
    const FoldErrors full = CrossValidation(problem_, statistics_, active()).base_errors();
    const auto may_replace = [&](int, const FoldErrors& loss, double, double margin) {
      return !is_tie(-loss, -margin) && !is_tie(-0.5 * loss, -margin);
    };
    for (int i = 0; i < static_cast<int>(chosen_.size()); ++i) {
      const CandidateGroup& now = problem_.groups[chosen_[i].record.group];
      if (now.local_family >= 0) continue;
      std::vector<int> asked;
      for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
        const CandidateGroup& group = problem_.groups[g];
        const bool kin = now.kin >= 0 && group.kin == now.kin && !is_chosen(g);
        if ((!allowed(g) && !kin) || group.local_family >= 0 || !result_.observable[g]) continue;
        if (!options_.banned.empty() && options_.banned[g]) continue;
        asked.push_back(g);
      }
      asked = worth_asking({i}, asked, full, may_replace);
      if (asked.empty()) continue;
      const CrossValidation model(problem_, statistics_, active(i));
      const std::vector<FoldErrors> with = model.errors_with(asked);
      std::vector<Tried> tried;
      int best = -1;
      for (std::size_t n = 0; n < asked.size(); ++n) {
        const FoldErrors gain = full - with[n];
        if (!may_replace(asked[n], -gain, 0.0, 0.0)) continue;
        tried.push_back({asked[n], gain});
        if (best < 0 || gain.sum() > tried[best].gain.sum()) best = static_cast<int>(tried.size()) - 1;
      }
      if (best < 0 || tried[best].gain.sum() <= 2.0 * total_error_of(tried[best].gain)) continue;
      best = preferred(tried, tried[best]);
      const double p_value = chosen_[i].record.p_value;
      chosen_.erase(chosen_.begin() + i);
      add(best, p_value);
      return true;
    }
    return false;
  }

  [[nodiscard]] double residual_square(const std::vector<int>& columns) const {
    const auto& all = statistics_.all();
    Eigen::MatrixXd gram = all.model_model(columns, columns);
    gram.diagonal() *= 1.0 + 1e-12;
    const Eigen::VectorXd right = all.model_value(columns);
    return all.value_value - right.dot(symmetric_solution(gram, right));
  }

  /// With one observation a unit and fold as the effective number: values of a unit hang together.
  [[nodiscard]] double bic_gain(int i) const {
    const double n = static_cast<double>(statistics_.units() * std::max(1, statistics_.folds()));
    const double d = problem_.groups[chosen_[i].record.group].columns;
    return n * std::log(residual_square(active(i)) /
                        std::max(residual_square(active()), 1e-300)) - d * std::log(n);
  }

  void find_confounded(int i, const FoldErrors& full) {
    ChosenGroup& record = result_.chosen[i];
    const CandidateGroup& own = problem_.groups[record.group];
    std::vector<int> asked;
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
      const CandidateGroup& group = problem_.groups[g];
      if (g == record.group || is_chosen(g) || group.local_family >= 0 || !result_.observable[g])
        continue;
      if (own.kin >= 0 && group.kin == own.kin) continue;
      asked.push_back(g);
    }
    // As good within a standard error, and close to what the effect itself earns.
    const double earned = record.gain * statistics_.total_weight();
    const auto may_be_it = [&](int, const FoldErrors& loss, double, double margin) {
      return is_tie(loss, margin) &&
             loss.sum() < 0.1 * earned + static_cast<double>(loss.size()) * margin;
    };
    asked = worth_asking({i}, asked, full, may_be_it);
    if (asked.empty()) return;
    const std::vector<FoldErrors> with =
        CrossValidation(problem_, statistics_, active(i)).errors_with(asked);
    for (std::size_t n = 0; n < asked.size(); ++n)
      if (may_be_it(asked[n], with[n] - full, earned, 0.0)) record.confounded.push_back(asked[n]);
  }

  const DiscoveryProblem& problem_;
  DiscoveryOptions options_;
  std::shared_ptr<KeptSums> kept_;  ///< (the problem may be another when the choice ends)
  std::unique_ptr<BlockStatistics> sums_;
  BlockStatistics& statistics_;
  ProjectedCandidates beside_;
  std::optional<QuickErrors> quick_;
  std::vector<int> quick_of_;  ///< the model whose they are
  std::vector<int> nuisance_;
  std::vector<Chosen> chosen_;
  std::vector<int> tested_;  ///< columns beside which structure was looked for last
  DiscoveryResult result_;
};

Discovery::Discovery(const DiscoveryProblem& problem, const DiscoveryOptions& options) {
  const auto n = problem.value.size();
  TRUEFLANK_EXPECTS(problem.weight.size() == n && problem.nuisance.rows() == n &&
                    problem.candidates.rows() == n);
  TRUEFLANK_EXPECTS(static_cast<Eigen::Index>(problem.unit.size()) == n &&
                    static_cast<Eigen::Index>(problem.fold.size()) == n &&
                    static_cast<Eigen::Index>(problem.zero.size()) == n);
  selection_ = std::make_unique<Selection>(problem, options);
  selection_->choose();
}
Discovery::Discovery(Discovery&&) noexcept = default;
Discovery& Discovery::operator=(Discovery&&) noexcept = default;
Discovery::~Discovery() = default;

const DiscoveryResult& Discovery::chosen() const { return selection_->result(); }

DiscoveryResult Discovery::finished() && { return selection_->finished(); }

DiscoveryResult discover(const DiscoveryProblem& problem, const DiscoveryOptions& options) {
  return Discovery(problem, options).finished();
}

}  // namespace trueflank::loop
