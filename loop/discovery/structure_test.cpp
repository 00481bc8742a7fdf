// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/structure_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <tuple>

#include "trueflank/base/threads.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/agreement.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// A group that keeps less than this of itself beside the fitted columns cannot be seen.
constexpr double kAbsorbed = 2e-3;
/// A column of a group that has less than this of the group's largest is rounding.
constexpr double kRounding = 1e-6;

/// s' inverse s of every column s; written out for one and two rows, which nearly all groups have.
Eigen::VectorXd quadratic_forms(const Eigen::Ref<const FlipScores>& scores,
                                const Eigen::MatrixXd& inverse) {
  if (scores.rows() > 2) {
    const Eigen::MatrixXd s = scores.cast<double>();
    return s.cwiseProduct(inverse * s).colwise().sum().transpose();
  }
  Eigen::VectorXd forms(scores.cols());
  double* const form = forms.data();
  const auto count = static_cast<std::size_t>(scores.cols());
  const float* const first = scores.data();
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    if (scores.rows() == 1) {
      const double a = inverse(0, 0);
      for (std::size_t k = 0; k < count; ++k) {
        const auto x = static_cast<double>(first[k]);
        form[k] = x * (a * x);
      }
      return;
    }
    const float* const second = first + scores.outerStride();
    const double a = inverse(0, 0), b = inverse(0, 1), c = inverse(1, 0), d = inverse(1, 1);
    for (std::size_t k = 0; k < count; ++k) {
      const double x = first[k], y = second[k];
      form[k] = x * (a * x + b * y) + y * (c * x + d * y);
    }
  });
  return forms;
}

/// Signs of a unit in neighbouring flips.
using FlipSigns = std::array<float, 64>;

/// Signs of all units in all flips, those of one set of flips after the other; the same for the
/// same number of units. Of flips beyond the last 0.
std::vector<FlipSigns> new_flip_signs(std::size_t units, std::size_t flips) {
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

/// The same. Every step of a choice asks for them: those of few units stay at hand.
std::shared_ptr<const std::vector<FlipSigns>> flip_signs(std::size_t units, std::size_t flips) {
  constexpr std::size_t kMostBytes = 12'000'000;
  struct Kept {
    std::size_t units = 0, flips = 0;
    std::shared_ptr<const std::vector<FlipSigns>> signs;
  };
  thread_local Kept kept;
  if (kept.signs && kept.units == units && kept.flips == flips) return kept.signs;
  auto signs = std::make_shared<const std::vector<FlipSigns>>(new_flip_signs(units, flips));
  if (signs->size() * sizeof(FlipSigns) <= kMostBytes) kept = {units, flips, signs};
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
                             const ProjectedCandidates& beside, int flips,
                             const std::vector<bool>& banned)
    : problem_(problem), statistics_(statistics), beside_(beside) {
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const CandidateGroup& group = problem.groups[g];
    const bool is_asked = group.local_family < 0 && (banned.empty() || !banned[g]);
    asked_.push_back(is_asked);
    projected_.push_back(beside.gram(static_cast<int>(g)));
    flipped_.push_back(projected_.back() - statistics.zero_loss(static_cast<int>(g)));
    if (is_asked) flipped_.back() -= beside.lost_by_flips(static_cast<int>(g));
  }
  judge_what_can_be_seen();
  test_by_flips(flips);
  test_wholes(banned);
  test_local(banned);
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
  const Eigen::MatrixXd inverse =
      under_flips.solve_columns(Eigen::MatrixXd::Identity(group.columns, group.columns));
  const Eigen::VectorXd statistic = quadratic_forms(scores, inverse);
  const Eigen::VectorXd o = beside_.scores().segment(group.first_column, group.columns);
  const double t = o.dot(symmetric_solution(projected_[g], o));
  // The group's own scale: correlation within units widens low modes more than high ones.
  const double flips = static_cast<double>(scores.cols());
  const double scale = (statistic.sum() + t) / ((flips + 1.0) * group.columns);
  if (!(scale > 0.0)) return kCannotBeJudged;
  Eigen::VectorXd& of_size = largest[group.columns];
  if (of_size.size() == 0) of_size = Eigen::VectorXd::Zero(scores.cols());
  of_size = of_size.cwiseMax(statistic / scale);
  return minus_log_chi_square_tail(t / scale, group.columns);
}

void StructureTest::test_by_flips(int flips) {
  const std::size_t groups = problem_.groups.size();
  group_p_values_.assign(groups, 1.0);
  const auto signs =
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
    FlipScores own_scores(static_cast<Eigen::Index>(columns.size()), beside_.unit_scores().cols());
    for (Eigen::Index unit = 0; unit < own_scores.cols(); ++unit)
      for (Eigen::Index k = 0; k < own_scores.rows(); ++k)
        own_scores(k, unit) =
            static_cast<float>(beside_.unit_scores()(columns[static_cast<std::size_t>(k)], unit));
    const FlipScores scores = flipped(own_scores, *signs);
    Eigen::Index row = 0;
    for (std::size_t i = first; i < end; ++i) {
      const int own_columns = problem_.groups[asked[i]].columns;
      own[asked[i]] = judge_under_flips(
          asked[i], scores.middleRows(row, own_columns).leftCols(flips), largest_of_piece[piece]);
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
    if (own[g] >= 0.0 && (most_likely_ < 0 || own[g] > own[most_likely_]))
      most_likely_ = static_cast<int>(g);
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
void StructureTest::test_wholes(const std::vector<bool>& banned) {
  const std::vector<double> single =
      agreement_of_wholes(problem_, statistics_, beside_, projected_, observable_);
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
          beside_.scores()[problem_.groups[g].first_column] / std::sqrt(projected_[g](0, 0));
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
    test_two_that_hide_each_other(members, score, static_cast<double>(families.size()));
  }
}

/// Of two that stand out, each widens what the other is judged by: both together against the rest.
/// Neighbours that stand out alike are left to the search for sectors.
void StructureTest::test_two_that_hide_each_other(const std::vector<int>& members,
                                                  const std::vector<double>& score,
                                                  double families) {
  const std::size_t n = members.size();
  std::vector<double> sorted = score;
  const double middle = median(sorted);
  const auto size = [&](std::size_t i) { return std::abs(score[i] - middle); };
  std::size_t first = 0, second = 1;
  if (size(second) > size(first)) std::swap(first, second);
  for (std::size_t i = 2; i < n; ++i) {
    if (size(i) > size(first)) {
      second = first;
      first = i;
    } else if (size(i) > size(second)) {
      second = i;
    }
  }
  const std::size_t apart = first > second ? first - second : second - first;
  const bool beside = apart == 1 || apart == n - 1;
  if (beside && (score[first] > middle) == (score[second] > middle)) return;
  const auto rest = static_cast<double>(n - 2);
  double mean = 0.0, square = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    if (i != first && i != second) mean += score[i] / rest;
  for (std::size_t i = 0; i < n; ++i)
    if (i != first && i != second) square += (score[i] - mean) * (score[i] - mean);
  const double variance = square / (rest - 1.0);
  if (!(variance > 0.0)) return;
  const double a = score[first] - mean, b = score[second] - mean;
  // Both less the mean of the rest, which they share.
  const double both = (a * a + b * b - (a + b) * (a + b) / (rest + 2.0)) / variance;
  const double pairs = 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
  const double p = families * pairs * f_tail(0.5 * both, 2.0, rest - 1.0);
  if (p >= local_p_value_) return;
  local_p_value_ = p;
  most_likely_local_ = members[first];
}

}  // namespace trueflank::loop
