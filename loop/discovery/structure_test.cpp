// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/structure_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <tuple>

#include "trueflank/base/threads.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/agreement.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/unit_spread.h"

namespace trueflank::loop {
namespace {

/// A group that keeps less than this of itself beside the fitted columns cannot be seen.
constexpr double kAbsorbed = 2e-3;
/// A column of a group that has less than this of the group's largest is rounding.
constexpr double kRounding = 1e-6;

/// s' inverse s of every column s; written out for one and two rows, which nearly all groups have.
Eigen::VectorXd quadratic_forms(const Eigen::MatrixXd& s, const Eigen::MatrixXd& inverse) {
  if (s.rows() > 2) return s.cwiseProduct(inverse * s).colwise().sum().transpose();
  Eigen::VectorXd forms(s.cols());
  if (s.rows() == 1) {
    for (Eigen::Index k = 0; k < s.cols(); ++k) forms[k] = s(0, k) * (inverse(0, 0) * s(0, k));
    return forms;
  }
  const double a = inverse(0, 0), b = inverse(0, 1), c = inverse(1, 0), d = inverse(1, 1);
  for (Eigen::Index k = 0; k < s.cols(); ++k) {
    const double x = s(0, k), y = s(1, k);
    forms[k] = x * (a * x + b * y) + y * (c * x + d * y);
  }
  return forms;
}

/// Signs of a unit in neighbouring flips.
using FlipSigns = std::array<float, 64>;

/// Signs of all units in all flips, those of one set of flips after the other; the same for the
/// same number of units. Of flips beyond the last 0.
std::vector<FlipSigns> flip_signs(std::size_t units, std::size_t flips) {
  constexpr std::size_t kAtOnce = std::tuple_size_v<FlipSigns>;
  std::mt19937_64 random(20260101);
  std::vector<FlipSigns> signs(units * ((flips + kAtOnce - 1) / kAtOnce), FlipSigns{});
  const std::size_t words = (units + 63) / 64;  // of a flip
  std::vector<std::uint64_t> bits(kAtOnce * words);
  for (std::size_t first = 0; first < flips; first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, flips - first);
    std::generate_n(bits.begin(), count * words, std::ref(random));
    FlipSigns* const of_set = signs.data() + first / kAtOnce * units;
    for (std::size_t i = 0; i < units; ++i)
      for (std::size_t j = 0; j < count; ++j)
        of_set[i][j] = ((bits[j * words + i / 64] >> (i % 64)) & 1u) != 0u ? 1.0f : -1.0f;
  }
  return signs;
}

/// Sums of the units' scores (a column each) under all flips, a column each and some zeros.
FlipScores flipped(const FlipScores& scores, const std::vector<FlipSigns>& signs) {
  constexpr std::size_t kAtOnce = std::tuple_size_v<FlipSigns>;
  const auto rows = static_cast<std::size_t>(scores.rows()),
             units = static_cast<std::size_t>(scores.cols());
  const std::size_t sets = units == 0 ? 0 : signs.size() / units;
  FlipScores sums(scores.rows(), static_cast<Eigen::Index>(sets * kAtOnce));
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    for (std::size_t set = 0; set < sets; ++set)
      for (std::size_t row = 0; row < rows; ++row) {
        const FlipSigns* const of_set = signs.data() + set * units;
        const float* const own = scores.data() + row * units;
        float sum[kAtOnce] = {};
        for (std::size_t i = 0; i < units; ++i)
          for (std::size_t j = 0; j < kAtOnce; ++j) sum[j] += own[i] * of_set[i][j];
        std::copy_n(sum, kAtOnce, sums.data() + row * sets * kAtOnce + set * kAtOnce);
      }
  });
  return sums;
}

}  // namespace

StructureTest::StructureTest(const DiscoveryProblem& problem, const BlockStatistics& statistics,
                             const std::vector<int>& columns, int flips,
                             const std::vector<bool>& banned)
    : problem_(problem), statistics_(statistics) {
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const CandidateGroup& group = problem.groups[g];
    const bool is_asked = group.local_family < 0 && (banned.empty() || !banned[g]);
    asked_.push_back(is_asked);
  }
  project(columns);
  test_by_flips(flips);
  test_wholes(columns, banned);
  test_local(banned);
}

/// What is asked of every unit: what the fit leaves of it, and what it takes from candidates.
struct StructureTest::UnitSums {
  Eigen::VectorXd left;  ///< products of the fitted columns with what the fit leaves
  UnitSpread spread;
};
struct StructureTest::FittedToUnits {
  const std::vector<int>& columns;
  const std::vector<UnitSums>& units;
};

/// Scores of every unit and Gram matrices of every group, beside the fitted columns.
void StructureTest::project(const std::vector<int>& columns) {
  const auto& all = statistics_.all();
  const auto p = all.candidate_value.size();
  const auto m = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd gram = all.model_model(columns, columns);
  gram.diagonal() *= 1.0 + 1e-12;
  gram.diagonal().array() += 1e-30;
  const SymmetricSolver solver(gram);
  Eigen::MatrixXd cross(m, p);
  for (Eigen::Index k = 0; k < m; ++k)
    cross.row(k) =
        all.model_candidate[static_cast<std::size_t>(columns[static_cast<std::size_t>(k)])]
            .transpose();
  absorbed_ = Eigen::MatrixXd::Zero(m, p);
  fitted_ = Eigen::VectorXd::Zero(m);
  Eigen::MatrixXd inverse(m, m);
  if (m > 0) {
    inverse = solver.solve_columns(Eigen::MatrixXd::Identity(m, m));
    absorbed_ = inverse * cross;
    fitted_ = inverse * all.model_value(columns);
  }
  const std::size_t groups = problem_.groups.size();
  projected_.resize(groups);
  flipped_.resize(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    const CandidateGroup& group = problem_.groups[g];
    const auto seq = Eigen::seqN(group.first_column, group.columns);
    projected_[g] = statistics_.group_gram(static_cast<int>(g), 0) -
                    cross(Eigen::all, seq).transpose() * absorbed_(Eigen::all, seq);
    flipped_[g] = projected_[g] - statistics_.zero_loss(static_cast<int>(g));
  }
  std::vector<UnitSums> units;
  for (int unit = 0; unit < statistics_.units(); ++unit) {
    const auto& sums = statistics_.unit(unit);
    const Eigen::MatrixXd own = sums.model_model(columns, columns);
    units.push_back({sums.model_value(columns) - own * fitted_, UnitSpread(own, inverse)});
  }
  unit_scores_.resize(p, statistics_.units());
  single_scores_.resize(p, statistics_.units());
  const FittedToUnits fitted{columns, units};
  constexpr std::size_t kAtOnce = 4;
  for_each_run(statistics_.panels().size(), kAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) project_panel(k, fitted);
  });
  observed_ = Eigen::VectorXd::Zero(p);
  for (Eigen::Index unit = 0; unit < unit_scores_.cols(); ++unit) observed_ += unit_scores_.col(unit);
  judge_what_can_be_seen();
}

/// Scores of the candidates of a panel in every unit, and what the fitted columns of every unit
/// take from their groups' spread under flips.
void StructureTest::project_panel(std::size_t p, const FittedToUnits& fitted) {
  const std::size_t m = fitted.columns.size();
  const PanelColumns& panel = statistics_.panels()[p];
  const auto columns = static_cast<std::size_t>(panel.columns);
  // Needed of the groups that flips judge, which of a gear of many teeth are the smaller part.
  int most = 0;
  for (int g = panel.first_group; g < panel.first_group + panel.groups; ++g)
    if (asked_[static_cast<std::size_t>(g)])
      most = std::max(most, problem_.groups[static_cast<std::size_t>(g)].columns);
  Panel absorbed(m, PanelRow{}), spread(m);
  std::vector<const PanelRow*> cross(m), own_rows(m);
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t c = 0; c < columns; ++c)
      absorbed[k][c] = absorbed_(static_cast<Eigen::Index>(k),
                                 panel.first_column + static_cast<Eigen::Index>(c));
  // Of products of columns that stand 0, 1, ... apart.
  std::vector<PanelRow> lost(static_cast<std::size_t>(most), PanelRow{});
  for (int unit = 0; unit < statistics_.units(); ++unit) {
    const UnitSums& sums = fitted.units[static_cast<std::size_t>(unit)];
    PanelRow score{};
    std::copy_n(statistics_.unit(unit).candidate_value.data() + panel.first_column, columns,
                score.begin());
    for (std::size_t k = 0; k < m; ++k)
      cross[k] = &statistics_.unit_candidates(fitted.columns[k], p, unit);
    subtract_rows(score, fitted_.data(), cross.data(), sums.left.data(), absorbed.data(), m);
    std::copy_n(score.begin(), columns, unit_scores_.col(unit).data() + panel.first_column);
    for (std::size_t c = 0; c < columns; ++c)
      single_scores_(panel.first_column + static_cast<Eigen::Index>(c), unit) = static_cast<float>(score[c]);
    if (most == 0 || m == 0) continue;
    const UnitSpread& taken = sums.spread;
    for (std::size_t k = 0; k < taken.rank(); ++k) own_rows[k] = cross[taken.rows()[k]];
    taken.spread_of(own_rows.data(), absorbed, spread);
    for (std::size_t k = 0; k < taken.rank(); ++k) add_products(lost, 1.0, spread[k]);
  }
  for (int g = panel.first_group; g < panel.first_group + panel.groups && m > 0; ++g) {
    if (!asked_[static_cast<std::size_t>(g)]) continue;
    Eigen::MatrixXd& flipped = flipped_[static_cast<std::size_t>(g)];
    const int at = problem_.groups[static_cast<std::size_t>(g)].first_column - panel.first_column;
    for (int a = 0; a < flipped.rows(); ++a)
      for (int b = 0; b < flipped.cols(); ++b)
        flipped(a, b) -= lost[static_cast<std::size_t>(std::abs(a - b))]
                             [static_cast<std::size_t>(at + std::min(a, b))];
  }
}

/// Groups that the data show beside the fitted columns, and those of them that flips can judge.
void StructureTest::judge_what_can_be_seen() {
  const std::size_t groups = problem_.groups.size();
  observable_.assign(groups, true);
  testable_.assign(groups, true);
  for (std::size_t g = 0; g < groups; ++g) {
    const Eigen::VectorXd own = statistics_.group_gram(static_cast<int>(g), 0).diagonal();
    // Four times per turn seen on four teeth has a cosine only: its sine is rounding.
    if (!(own.minCoeff() > kRounding * own.maxCoeff())) observable_[g] = testable_[g] = false;
    for (int k = 0; k < own.size(); ++k) {
      if (!(projected_[g](k, k) > kAbsorbed * own[k]) || !(own[k] > 0.0))
        observable_[g] = testable_[g] = false;
      else if (!(flipped_[g](k, k) > 0.05 * projected_[g](k, k)))
        testable_[g] = false;
    }
    if (observable_[g] && determinant_of(projected_[g]) <= 1e-6 * projected_[g].diagonal().prod())
      observable_[g] = testable_[g] = false;
  }
}

/// Of a group: how unlikely its statistic is by chance, minus the logarithm of its tail, or below 0
/// where it cannot be judged. The flips' statistics are taken into the largest of groups of its
/// size.
double StructureTest::judge_under_flips(std::size_t g, const Eigen::Ref<const FlipScores>& scores,
                                        LargestOfSize& largest) const {
  constexpr double kCannotBeJudged = -1.0;
  const CandidateGroup& group = problem_.groups[g];
  const SymmetricSolver under_flips(flipped_[g]);
  if (!under_flips.is_positive()) return kCannotBeJudged;
  const Eigen::MatrixXd s = scores.cast<double>();
  const Eigen::MatrixXd inverse =
      under_flips.solve_columns(Eigen::MatrixXd::Identity(group.columns, group.columns));
  const Eigen::VectorXd statistic = quadratic_forms(s, inverse);
  const Eigen::VectorXd o = observed_(Eigen::seqN(group.first_column, group.columns));
  const double t = o.dot(symmetric_solution(projected_[g], o));
  // The group's own scale: correlation within units widens low modes more than high ones.
  const double flips = static_cast<double>(s.cols());
  const double scale = (statistic.sum() + t) / ((flips + 1.0) * group.columns);
  if (!(scale > 0.0)) return kCannotBeJudged;
  Eigen::VectorXd& of_size = largest[group.columns];
  if (of_size.size() == 0) of_size = Eigen::VectorXd::Zero(s.cols());
  of_size = of_size.cwiseMax(statistic / scale);
  return minus_log_chi_square_tail(t / scale, group.columns);
}

void StructureTest::test_by_flips(int flips) {
  const std::size_t groups = problem_.groups.size();
  group_p_values_.assign(groups, 1.0);
  const std::vector<FlipSigns> signs =
      flip_signs(static_cast<std::size_t>(statistics_.units()), static_cast<std::size_t>(flips));
  std::vector<std::size_t> asked;
  for (std::size_t g = 0; g < groups; ++g)
    if (testable_[g] && asked_[g]) asked.push_back(g);
  if (asked.empty()) return;
  // Groups do not ask each other: the same statistics on any number of processors. Each piece takes
  // in all signs, so there are few.
  constexpr std::size_t kPieces = 4;
  std::vector<double> own(groups, -1.0);
  std::vector<LargestOfSize> largest_of_piece(kPieces);
  for_each_piece(kPieces, [&](std::size_t piece) {
    const std::size_t first = asked.size() * piece / kPieces,
                      end = asked.size() * (piece + 1) / kPieces;
    std::vector<Eigen::Index> columns;
    for (std::size_t i = first; i < end; ++i)
      for (int k = 0; k < problem_.groups[asked[i]].columns; ++k)
        columns.push_back(problem_.groups[asked[i]].first_column + k);
    const FlipScores own_scores = single_scores_(columns, Eigen::all);
    const FlipScores scores = flipped(own_scores, signs);
    Eigen::Index row = 0;
    for (std::size_t i = first; i < end; ++i) {
      const int own_columns = problem_.groups[asked[i]].columns;
      own[asked[i]] =
          judge_under_flips(asked[i], scores.middleRows(row, own_columns).leftCols(flips),
                            largest_of_piece[piece]);
      row += own_columns;
    }
  });
  LargestOfSize largest_of_size = std::move(largest_of_piece.front());
  for (std::size_t piece = 1; piece < largest_of_piece.size(); ++piece)
    for (auto& [columns, of_piece] : largest_of_piece[piece]) {
      const auto [known, is_new] = largest_of_size.try_emplace(columns, of_piece);
      if (!is_new) known->second = known->second.cwiseMax(of_piece);
    }
  compare_with_flips(own, largest_of_size, flips);
}

/// p-values corrected for all groups: how often the largest statistic of a flip, whichever group it
/// is of, is as unlikely as a group's own.
void StructureTest::compare_with_flips(const std::vector<double>& own,
                                       const LargestOfSize& largest_of_size, int flips) {
  for (std::size_t g = 0; g < own.size(); ++g)
    if (own[g] >= 0.0 && (most_likely_ < 0 || own[g] > own[most_likely_])) most_likely_ = static_cast<int>(g);
  if (most_likely_ < 0) return;
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(flips);
  for (const auto& [columns, statistics] : largest_of_size)
    for (int k = 0; k < flips; ++k)
      largest[k] = std::max(largest[k], minus_log_chi_square_tail(statistics[k], columns));
  std::sort(largest.data(), largest.data() + flips);
  for (std::size_t g = 0; g < own.size(); ++g) {
    if (own[g] < 0.0) continue;
    const auto above =
        largest.data() + flips - std::lower_bound(largest.data(), largest.data() + flips, own[g]);
    group_p_values_[g] = (1.0 + static_cast<double>(above)) / (flips + 1.0);
  }
  p_value_ = group_p_values_[most_likely_];
  most_likely_single_p_value_ = std::exp(-own[most_likely_]);
}

/// The groups that live in few whole traces or flanks, by how much these agree.
void StructureTest::test_wholes(const std::vector<int>& columns, const std::vector<bool>& banned) {
  const std::vector<double> single = agreement_of_wholes(
      problem_, statistics_, {columns, absorbed_, fitted_, unit_scores_}, projected_, observable_);
  double tested = 0.0;
  for (std::size_t g = 0; g < single.size(); ++g)
    if (single[g] < 1.0 && (banned.empty() || !banned[g])) tested += 1.0;
  if (tested == 0.0) return;
  // Two tests are made of one question: each has half of the level.
  constexpr double kTests = 2.0;
  p_value_ = std::min(1.0, kTests * p_value_);
  for (double& p : group_p_values_) p = std::min(1.0, kTests * p);
  for (std::size_t g = 0; g < single.size(); ++g) {
    if (!(single[g] < 1.0) || (!banned.empty() && banned[g])) continue;
    const double p = kTests * tested * single[g];
    group_p_values_[g] = std::min(group_p_values_[g], p);
    if (p >= p_value_) continue;
    p_value_ = p;
    most_likely_ = static_cast<int>(g);
    most_likely_single_p_value_ = std::min(most_likely_single_p_value_, single[g]);
  }
}

/// Each local group against the others of its family: studentised with itself left out.
void StructureTest::test_local(const std::vector<bool>& banned) {
  std::map<int, std::vector<int>> families;
  int tested = 0;
  for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
    const CandidateGroup& group = problem_.groups[g];
    if (group.local_family < 0 || group.columns != 1 || !observable_[g]) continue;
    if (!banned.empty() && banned[g]) continue;
    families[group.local_family].push_back(g);
    ++tested;
  }
  for (const auto& [family, members] : families) {
    const double n = static_cast<double>(members.size());
    if (n < 8) continue;
    // Weighted by what each can tell: a half measured tooth scatters more.
    std::vector<double> score;
    double sum = 0.0, squares = 0.0;
    for (const int g : members) {
      const double value =
          observed_[problem_.groups[g].first_column] / std::sqrt(projected_[g](0, 0));
      score.push_back(value);
      sum += value;
      squares += value * value;
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      const double mean = (sum - score[i]) / (n - 1.0);
      const double variance = (squares - score[i] * score[i] - (n - 1.0) * mean * mean) / (n - 2.0);
      if (!(variance > 0.0)) continue;
      const double t = (score[i] - mean) / std::sqrt(variance * n / (n - 1.0));
      const double p = tested * student_two_sided(std::abs(t), n - 2.0);
      if (p < local_p_value_) {
        local_p_value_ = p;
        most_likely_local_ = members[i];
      }
    }
  }
}

}  // namespace trueflank::loop
