// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/trend_scan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::loop {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Orthonormal polynomials over the rows, one a column, from the constant on.
MatrixXd polynomials(Index rows, Index count) {
  MatrixXd powers(rows, count);
  for (Index i = 0; i < rows; ++i) {
    const double x = (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(rows) - 1.0;
    // (Chebyshev's: powers of x would be too alike)
    for (Index k = 0; k < count; ++k)
      powers(i, k) = std::cos(static_cast<double>(k) * std::acos(x));
  }
  return orthonormal_columns(powers);
}

/// The power that errors would have at a degree, continued from the degrees `from` on: the steepest
/// law that these do not deny.
double continued_to(int degree, int from, const VectorXd& power, double courses) {
  constexpr double kSteepest = 3.0, kStep = 0.25;
  constexpr double kNotDenied = 2.0;  // of the logarithm of the likelihood
  const auto count = static_cast<int>(power.size());
  double most_likely = -1e300, steepest = 0.0;
  std::vector<std::pair<double, double>> laws;  // likelihood, power at the degree
  for (double exponent = 0.0; exponent <= kSteepest; exponent += kStep) {
    double level = 0.0;
    for (int k = from; k < count; ++k) level += power[k] * std::pow(k, exponent);
    level /= count - from;
    double likelihood = 0.0;
    for (int k = from; k < count; ++k) {
      const double there = level * std::pow(k, -exponent);
      likelihood -= 0.5 * courses * (std::log(there) + power[k] / there);
    }
    laws.emplace_back(likelihood, level * std::pow(degree, -exponent));
    most_likely = std::max(most_likely, likelihood);
  }
  for (const auto& [likelihood, there] : laws)
    if (likelihood >= most_likely - kNotDenied) steepest = there;
  return steepest;
}

/// Few courses need more degrees to know their errors by.
Index degrees_for(double courses, Index rows) {
  constexpr double kValues = 100.0;
  constexpr Index kFewest = 9, kMost = 25;
  return std::clamp<Index>(1 + static_cast<Index>(kValues / courses), kFewest,
                           std::max(kFewest, std::min(kMost, rows / 3)));
}

}  // namespace

std::optional<OwnTrend> own_trend(const std::vector<MatrixXd>& sets) {
  constexpr Index kFewestRows = 16, kFewestInASet = 3;
  if (sets.empty() || sets.front().rows() < kFewestRows) return {};
  const Index rows = sets.front().rows();
  double courses = 0.0;  // that differ from the mean of theirs
  for (const MatrixXd& set : sets)
    if (set.cols() >= kFewestInASet) courses += static_cast<double>(set.cols() - 1);
  if (!(courses > 0.0)) return {};
  const MatrixXd basis = polynomials(rows, degrees_for(courses, rows));
  VectorXd power = VectorXd::Zero(basis.cols());
  for (const MatrixXd& set : sets)
    if (set.cols() >= kFewestInASet)
      power += (basis.transpose() * (set.colwise() - set.rowwise().mean())).rowwise().squaredNorm();
  power /= courses;
  if (!(power.tail(power.size() - 1).minCoeff() > 0.0)) return {};
  // A line beside a bow is asked for from the degrees above both, and must be larger there.
  struct Question {
    int degree = 0, from = 0;
    double still_an_error = 0.0;
  };
  constexpr Question kQuestions[] = {{1, 2, 2.5}, {1, 3, 4.0}, {2, 3, 2.5}};
  std::optional<OwnTrend> surest;
  for (const auto& [degree, from, still_an_error] : kQuestions) {
    const double error = continued_to(degree, from, power, courses);
    const double of_errors = courses * static_cast<double>(power.size() - from);
    const double p_value =
        std::min(1.0, static_cast<double>(std::size(kQuestions)) *
                          f_tail(power[degree] / (still_an_error * error), courses, of_errors));
    if (surest && surest->p_value <= p_value) continue;
    const VectorXd form = basis.col(degree);
    surest = OwnTrend{
        degree, p_value,
        std::sqrt(std::max(0.0, power[degree] - error)) * (form.maxCoeff() - form.minCoeff())};
  }
  return surest;
}

}  // namespace trueflank::loop
