// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/agreement.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/base/threads.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/column_panels.h"
#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kMostTried = 24;
static_assert(4 * kMostTried == kMostWholesAsked);
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
  return orthonormal_columns(powers);
}

/// What is left of errors that hang together by rho from one to the next, once courses q are
/// taken out: mean square, and mean product of neighbours.
std::pair<double, double> left_of_chain(const Eigen::MatrixXd& q, double rho) {
  const Eigen::Index n = q.rows();
  std::vector<double> powers;
  for (Eigen::Index i = 0; i < n; ++i) powers.push_back(std::pow(rho, static_cast<double>(i)));
  Eigen::MatrixXd chain(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      chain(i, k) = powers[static_cast<std::size_t>(std::abs(i - k))];
  const Eigen::MatrixXd half = chain - q * (q.transpose() * chain);
  const Eigen::MatrixXd left = half - (half * q) * q.transpose();
  return {left.diagonal().mean(), left.diagonal(1).mean()};
}

}  // namespace

/// By what traces scatter about their own courses and by how that hangs together from one value to the
/// next.
double scatter_within(const DiscoveryProblem& problem, const BlockStatistics& statistics) {
  std::map<int, std::vector<int>> wholes;  // with a zero of their own
  for (const int i : statistics.used())
    if (problem.whole[i] >= 0 && problem.zero[i] >= 0) wholes[problem.whole[i]].push_back(i);
  std::map<Eigen::Index, Eigen::MatrixXd> courses_of;  // by the number of values
  const auto known_courses = [&](Eigen::Index n) -> const Eigen::MatrixXd& {
    Eigen::MatrixXd& q = courses_of[n];
    if (q.size() == 0) q = courses(n);
    return q;
  };
  double squares = 0.0, products = 0.0, values = 0.0, pairs = 0.0, traces = 0.0;
  for (const auto& [whole, rows] : wholes) {
    const auto n = static_cast<Eigen::Index>(rows.size());
    if (n < kFewestValues) continue;
    const Eigen::MatrixXd& q = known_courses(n);
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
  const Eigen::MatrixXd& q = known_courses(n);
  std::pair<double, double> left = left_of_chain(q, 0.0);
  while (rho < 0.9 && left.second / left.first < seen) left = left_of_chain(q, rho += 0.05);
  return squares / values / left.first * (1.0 + rho) / (1.0 - rho);
}

namespace {

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

/// Eigenvalues of a symmetric matrix of two rows, and the direction (cosine and sine) of the first.
struct TwoDirections {
  double first = 0.0, second = 0.0, cosine = 1.0, sine = 0.0;
};

TwoDirections two_directions(double a, double mixed, double b) {
  const double half = 0.5 * (a - b), middle = 0.5 * (a + b), off = std::sqrt(half * half + mixed * mixed);
  if (!(off > 0.0)) return {middle, middle};
  // of the two forms of the direction the one without cancellation
  const double along = half > 0.0 ? half + off : mixed, across = half > 0.0 ? mixed : off - half;
  const double length = std::sqrt(along * along + across * across), larger = middle + off;
  return {larger, (a * b - mixed * mixed) / larger, along / length, across / length};
}

/// What a whole says along one direction of a group with two columns.
void add_direction(Agreement& sum, double value, double cosine, double sine, const double* score) {
  const double along = cosine * score[0] + sine * score[1];
  sum.gram(0, 0) += value * cosine * cosine;
  sum.gram(1, 1) += value * sine * sine;
  sum.gram(1, 0) += value * cosine * sine;
  sum.gram(0, 1) = sum.gram(1, 0);
  sum.score[0] += along * cosine;
  sum.score[1] += along * sine;
  sum.total += along * along / value;
  ++sum.degrees;
}

/// The part of a group's Gram matrix in a whole that stands in a panel's products.
GroupMatrix gram_of(const PanelRow* products, int at, int columns) {
  GroupMatrix gram(columns, columns);
  for (int k = 0; k < columns; ++k)
    for (int l = 0; l <= k; ++l) gram(k, l) = gram(l, k) = products[k - l][at + l];
  return gram;
}

/// The same of a group of more columns.
[[gnu::noinline]] void add_directions(Agreement& sum, const GroupMatrix& gram, const double* score,
                                      double least) {
  const Eigen::SelfAdjointEigenSolver<GroupMatrix> own{gram};
  const Eigen::Map<const Eigen::VectorXd> scores(score, gram.cols());
  for (Eigen::Index k = 0; k < gram.cols(); ++k) {
    const double value = own.eigenvalues()[k];
    if (!(value > least)) continue;
    const GroupVector direction = own.eigenvectors().col(k);
    const double along = direction.dot(scores);
    sum.gram += value * direction * direction.transpose();
    sum.score += along * direction;
    sum.total += along * along / value;
    ++sum.degrees;
  }
}

/// Takes in what a whole says of a group whose columns stand in a panel from `at` on: directions with
/// more than `least`. Nearly all groups have one column or two, for which it is written out.
void add_whole(Agreement& sum, const PanelRow* products, const double* score, int at, double least) {
  const auto columns = static_cast<int>(sum.score.size());
  if (columns == 1) {
    const double gram = products[0][at];
    if (!(gram > least)) return;
    sum.gram(0, 0) += gram;
    sum.score[0] += score[0];
    sum.total += score[0] * score[0] / gram;
    ++sum.degrees;
    return;
  }
  if (columns == 2) {
    const TwoDirections own = two_directions(products[0][at], products[1][at], products[0][at + 1]);
    if (own.first > least) add_direction(sum, own.first, own.cosine, own.sine, score);
    if (own.second > least) add_direction(sum, own.second, -own.sine, own.cosine, score);
    return;
  }
  add_directions(sum, gram_of(products, at, columns), score, least);
}

double p_of(const Agreement& sum, int fitted, double within) {
  const auto columns = static_cast<int>(sum.score.size());
  const int below = sum.degrees - columns - fitted;
  if (below < 1 || (below < 2 && !(within > 0.0))) return 1.0;
  const SymmetricSolver gram{Eigen::MatrixXd(sum.gram)};
  if (!gram.is_positive()) return 1.0;
  const Eigen::VectorXd score = sum.score;
  const double explained = score.dot(gram.solve(score));
  const double left = std::max(sum.total - explained, 1e-12 * sum.total);
  const double own = within > 0.0 ? kOwnDegrees : 0.0;
  const double variance = (left + own * within) / (below + own);
  return f_tail(explained / columns / variance, columns, below + own);
}

/// True for a group of so many columns that lives in more wholes than are asked: flips judge it.
bool lives_in_too_many(const Agreement& sum, int columns) {
  return sum.degrees > static_cast<int>(kMostTried) * columns;
}

struct Asked {
  const DiscoveryProblem& problem;
  const BlockStatistics& statistics;
  const ProjectedCandidates& beside;
  const std::vector<Eigen::MatrixXd>& projected;
  const std::vector<bool>& observable;
};

/// What every whole says of the groups of a panel, until all of them live in too many.
void add_wholes(const Asked& asked, std::size_t number, std::vector<Agreement>& sums) {
  const std::vector<CandidateGroup>& groups = asked.problem.groups;
  const PanelColumns& panel = asked.statistics.panels()[number];
  if (!asked.beside.is_asked(number)) return;
  const auto wholes = static_cast<double>(asked.statistics.wholes().size());
  std::vector<int> open;
  for (int g = panel.first_group; g < panel.first_group + panel.groups; ++g)
    if (asked.observable[g]) open.push_back(g);
  std::size_t at_whole = 0;
  for (const auto& [key, whole] : asked.statistics.wholes()) {
    if (open.empty()) return;
    PanelRow scores{};
    for (const int unit : whole.units) {
      const double* const of_unit =
          asked.beside.unit_scores().col(unit).data() + panel.first_column;
      for (int c = 0; c < panel.columns; ++c) scores[static_cast<std::size_t>(c)] += of_unit[c];
    }
    const PanelRow* const products = asked.beside.products_of_whole(number, at_whole++);
    std::erase_if(open, [&](int g) {
      const int at = groups[g].first_column - panel.first_column;
      add_whole(sums[g], products, scores.data() + at, at, kNone * asked.projected[g].trace() / wholes);
      return lives_in_too_many(sums[g], groups[g].columns);
    });
  }
}

}  // namespace

std::vector<double> agreement_of_wholes(const DiscoveryProblem& problem,
                                        const BlockStatistics& statistics,
                                        const ProjectedCandidates& beside,
                                        const std::vector<Eigen::MatrixXd>& projected,
                                        const std::vector<bool>& observable) {
  const auto& wholes = statistics.wholes();
  if (wholes.size() < kFewestWholesAsked || wholes.size() > kMostWholesAsked) return {};
  const std::size_t groups = problem.groups.size();
  std::vector<Agreement> sums(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    const int columns = problem.groups[g].columns;
    sums[g].gram = GroupMatrix::Zero(columns, columns);
    sums[g].score = GroupVector::Zero(columns);
  }
  constexpr std::size_t kAtOnce = 4;
  for_each_run(statistics.panels().size(), kAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t p = from; p < to; ++p)
      add_wholes({problem, statistics, beside, projected, observable}, p, sums);
  });
  const double within = statistics.scatter_within();
  std::vector<double> single(groups, 1.0);
  for (std::size_t g = 0; g < groups; ++g) {
    const int columns = problem.groups[g].columns;
    if (!observable[g] || problem.groups[g].local_family >= 0 ||
        sums[g].gram.trace() < kInWholes * projected[g].trace() ||
        lives_in_too_many(sums[g], columns))
      continue;
    single[g] = p_of(sums[g], static_cast<int>(beside.fitted()), within);
  }
  return single;
}

}  // namespace trueflank::loop
