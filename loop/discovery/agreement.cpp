// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/agreement.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/column_panels.h"
#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewest = 4, kMost = 24;
/// Share of a group's information that must lie in whole traces, and below which a trace holds none
/// of it.
constexpr double kInWholes = 0.9, kNone = 1e-3;

/// What a trace shows about its own course counts as so many more traces, from so many values on.
constexpr double kOwnDegrees = 4.0;
constexpr Eigen::Index kFewestValues = 16;
constexpr int kCourse = 9;  ///< coefficients of a trace's own course

/// Orthonormal polynomials over n places in a row, n x kCourse.
Eigen::MatrixXd courses(Eigen::Index n) {
  Eigen::MatrixXd powers(n, kCourse);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k < kCourse; ++k)
      powers(i, k) = std::pow(2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1.0, k);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(powers);
  return qr.householderQ() * Eigen::MatrixXd::Identity(n, kCourse);
}

/// What is left of errors that hang together by rho from one to the next, once a course of n is
/// taken out: mean square, and mean product of neighbours.
std::pair<double, double> left_of_chain(Eigen::Index n, double rho) {
  const Eigen::MatrixXd q = courses(n);
  Eigen::MatrixXd chain(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      chain(i, k) = std::pow(rho, static_cast<double>(std::abs(i - k)));
  const Eigen::MatrixXd half = chain - q * (q.transpose() * chain);
  const Eigen::MatrixXd left = half - (half * q) * q.transpose();
  return {left.diagonal().mean(), left.diagonal(1).mean()};
}

/// Variance that slow candidates meet in a trace, by what traces scatter about their own courses
/// and by how that hangs together from one value to the next; 0 where there are no traces of enough
/// values.
double scatter_within(const DiscoveryProblem& problem, const BlockStatistics& statistics,
                      const std::map<int, std::vector<int>>& wholes) {
  double squares = 0.0, products = 0.0, values = 0.0, pairs = 0.0, traces = 0.0;
  for (const auto& [whole, rows] : wholes) {
    const auto n = static_cast<Eigen::Index>(rows.size());
    if (problem.zero[rows.front()] < 0 || n < kFewestValues) continue;
    const Eigen::MatrixXd q = courses(n);
    Eigen::VectorXd left = problem.weight(rows).cwiseSqrt().cwiseProduct(statistics.value()(rows));
    left -= q * (q.transpose() * left);
    squares += left.squaredNorm();
    products += left.head(n - 1).dot(left.tail(n - 1));
    values += static_cast<double>(n);
    pairs += static_cast<double>(n - 1);
    traces += 1.0;
  }
  if (traces == 0.0 || !(squares > 0.0)) return 0.0;
  const auto n = static_cast<Eigen::Index>(values / traces);
  const double seen = products / pairs / (squares / values);
  double rho = 0.0;
  std::pair<double, double> left = left_of_chain(n, 0.0);
  while (rho < 0.9 && left.second / left.first < seen) left = left_of_chain(n, rho += 0.05);
  return squares / values / left.first * (1.0 + rho) / (1.0 - rho);
}

/// Of the columns of one group: few, and so without memory of their own.
constexpr int kMostColumns = 8;
using GroupMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostColumns, kMostColumns>;
using GroupVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostColumns, 1>;

/// What the wholes say of one group.
struct Agreement {
  GroupMatrix gram;
  GroupVector score;
  double total = 0.0;  ///< squares that every whole explains by itself
  int degrees = 0;     ///< and with how many numbers
};

void add_whole(Agreement& sum, const GroupMatrix& gram, const GroupVector& score,
               double information) {
  if (gram.rows() == 1) {  // its own direction
    if (!(gram(0, 0) > kNone * information)) return;
    sum.gram += gram;
    sum.score += score;
    sum.total += score[0] * score[0] / gram(0, 0);
    ++sum.degrees;
    return;
  }
  const Eigen::SelfAdjointEigenSolver<GroupMatrix> own{gram};
  for (Eigen::Index k = 0; k < gram.rows(); ++k) {
    if (!(own.eigenvalues()[k] > kNone * information)) continue;
    const GroupVector direction = own.eigenvectors().col(k);
    const double along = direction.dot(score);
    sum.gram += own.eigenvalues()[k] * direction * direction.transpose();
    sum.score += along * direction;
    sum.total += along * along / own.eigenvalues()[k];
    ++sum.degrees;
  }
}

double p_of(const Agreement& sum, int fitted, double within) {
  const auto columns = static_cast<int>(sum.score.size());
  const int below = sum.degrees - columns - fitted;
  if (below < 1 || (below < 2 && !(within > 0.0))) return 1.0;
  const Eigen::LDLT<Eigen::MatrixXd> gram{Eigen::MatrixXd(sum.gram)};
  if (gram.info() != Eigen::Success || !gram.isPositive()) return 1.0;
  const Eigen::VectorXd score = sum.score;
  const double explained = score.dot(gram.solve(score));
  const double left = std::max(sum.total - explained, 1e-12 * sum.total);
  const double own = within > 0.0 ? kOwnDegrees : 0.0;
  const double variance = (left + own * within) / (below + own);
  return f_tail(explained / columns / variance, columns, below + own);
}

/// The values of one whole, what is fitted to them and what that leaves.
struct WholeRows {
  std::vector<int> rows;
  Eigen::MatrixXd fitted;  ///< M x values
  Eigen::VectorXd weight, weighted_left;
};

struct Asked {
  const DiscoveryProblem& problem;
  const BlockStatistics& statistics;
  const FittedModel& model;
  const std::vector<Eigen::MatrixXd>& projected;
  const std::vector<bool>& observable;
};

/// True for a group of so many columns that lives in more wholes than are asked: flips judge it.
bool lives_in_too_many(const Agreement& sum, int columns) {
  return sum.degrees > static_cast<int>(kMost) * columns;
}

/// What every whole says of the groups of a panel, until all of them live in too many.
void add_wholes(const std::vector<WholeRows>& wholes, const Asked& asked, const PanelColumns& panel,
                std::vector<Agreement>& sums) {
  const std::vector<CandidateGroup>& groups = asked.problem.groups;
  if (groups[panel.first_group].local_family >= 0) return;
  const Eigen::Index m = asked.model.absorbed.rows();
  Panel absorbed(static_cast<std::size_t>(m), PanelRow{}), beside;
  for (Eigen::Index k = 0; k < m; ++k)
    for (int c = 0; c < panel.columns; ++c)
      absorbed[k][c] = asked.model.absorbed(k, panel.first_column + c);
  int most = 1;
  for (int g = panel.first_group; g < panel.first_group + panel.groups; ++g)
    most = std::max(most, groups[g].columns);
  for (const WholeRows& whole : wholes) {
    std::vector<PanelRow> products(static_cast<std::size_t>(most), PanelRow{});
    PanelRow scores{};
    beside.assign(whole.rows.size(), PanelRow{});
    for (std::size_t r = 0; r < whole.rows.size(); ++r) {
      const float* row =
          asked.statistics.candidates().row(whole.rows[r]).data() + panel.first_column;
      std::copy_n(row, panel.columns, beside[r].begin());
      subtract_rows(beside[r], whole.fitted.col(r).data(), absorbed.data(), absorbed.size());
      add_products(products, whole.weight[r], beside[r]);
    }
    add_rows(scores, whole.weighted_left.data(), beside.data(), beside.size());
    bool any = false;
    for (int g = panel.first_group; g < panel.first_group + panel.groups; ++g) {
      if (!asked.observable[g] || lives_in_too_many(sums[g], groups[g].columns)) continue;
      any = true;
      const int own = groups[g].columns, at = groups[g].first_column - panel.first_column;
      GroupMatrix gram(own, own);
      GroupVector score(own);
      for (int k = 0; k < own; ++k) {
        score[k] = scores[at + k];
        for (int l = 0; l <= k; ++l) gram(k, l) = gram(l, k) = products[k - l][at + l];
      }
      add_whole(sums[g], gram, score,
                asked.projected[g].trace() / static_cast<double>(wholes.size()));
    }
    if (!any) return;
  }
}

}  // namespace

std::vector<double> agreement_of_wholes(const DiscoveryProblem& problem,
                                        const BlockStatistics& statistics, const FittedModel& model,
                                        const std::vector<Eigen::MatrixXd>& projected,
                                        const std::vector<bool>& observable) {
  std::map<int, std::vector<int>> wholes;
  for (const int i : statistics.used())
    if (!problem.whole.empty() && problem.whole[i] >= 0) wholes[problem.whole[i]].push_back(i);
  if (wholes.size() < kFewest || wholes.size() > 4 * kMost) return {};
  const std::size_t groups = problem.groups.size();
  std::vector<Agreement> sums(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    const int columns = problem.groups[g].columns;
    sums[g].gram = GroupMatrix::Zero(columns, columns);
    sums[g].score = GroupVector::Zero(columns);
  }
  std::vector<WholeRows> values;
  for (const auto& [whole, rows] : wholes) {
    const Eigen::MatrixXd fitted = statistics.model()(rows, model.columns);
    WholeRows one{rows, fitted.transpose(), problem.weight(rows), {}};
    one.weighted_left = one.weight.cwiseProduct(statistics.value()(rows) - fitted * model.fitted);
    values.push_back(std::move(one));
  }
  // Groups do not ask each other: the same sums on any number of processors.
  constexpr std::size_t kPanelsOfWork = 4;
  const std::vector<PanelColumns>& panels = statistics.panels();
  for_each_piece((panels.size() + kPanelsOfWork - 1) / kPanelsOfWork, [&](std::size_t piece) {
    const std::size_t from = piece * kPanelsOfWork;
    for (std::size_t p = from; p < std::min(panels.size(), from + kPanelsOfWork); ++p)
      add_wholes(values, {problem, statistics, model, projected, observable}, panels[p], sums);
  });
  const double within = scatter_within(problem, statistics, wholes);
  std::vector<double> single(groups, 1.0);
  for (std::size_t g = 0; g < groups; ++g) {
    const int columns = problem.groups[g].columns;
    if (!observable[g] || problem.groups[g].local_family >= 0 ||
        sums[g].gram.trace() < kInWholes * projected[g].trace() ||
        lives_in_too_many(sums[g], columns))
      continue;
    single[g] = p_of(sums[g], static_cast<int>(model.columns.size()), within);
  }
  return single;
}

}  // namespace trueflank::loop
