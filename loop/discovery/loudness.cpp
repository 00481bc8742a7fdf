// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/loudness.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kFewestInACourse = 12;

double scatter_of_bends(const VectorXd& course) {
  const Index m = course.size();
  const VectorXd bends =
      (course.head(m - 2) - 2.0 * course.segment(1, m - 2) + course.tail(m - 2)) / std::sqrt(6.0);
  return robust_sigma(std::vector(bends.data(), bends.data() + bends.size()));
}

/// By the median of the cosine coefficients of the shorter two thirds of the wavelengths.
double scatter_of_waves(const VectorXd& course) {
  const Index m = course.size();
  // cos(pi k (i + 1/2) / m) has 4 m values.
  const double step = 0.5 * kPi / static_cast<double>(m);
  std::vector<double> cosine(static_cast<std::size_t>(4 * m));
  for (std::size_t j = 0; j < cosine.size(); ++j)
    cosine[j] = std::cos(step * static_cast<double>(j));
  std::vector<double> coefficients;
  for (Index k = m / 3; k < m; ++k) {
    double sum = 0.0;
    for (Index i = 0; i < m; ++i)
      sum += course[i] * cosine[static_cast<std::size_t>(k * (2 * i + 1) % (4 * m))];
    coefficients.push_back(sum * std::sqrt(2.0 / static_cast<double>(m)));
  }
  return robust_sigma(std::move(coefficients));
}

}  // namespace

double short_wave_scatter(const VectorXd& course) {
  if (course.size() < kFewestInACourse) return 0.0;
  const double scatter = std::min(scatter_of_bends(course), scatter_of_waves(course));
  // Values on few levels: most differences are none.
  constexpr double kRounding = 1e-6;
  return scatter > kRounding * course.norm() ? scatter : 0.0;
}

double least_chance(double errors, double degrees, double normal_chance, double asked_below) {
  if (std::isinf(degrees) || normal_chance > asked_below) return 0.0;
  return student_two_sided(std::abs(errors), degrees);
}

Loudness loudness_of(const std::vector<double>& scatters, const std::vector<double>& values) {
  // Variance of the logarithm of a median of sizes, by so many values of which neighbours share
  // some: 1.36 (that of independent ones) over 0.55.
  constexpr double kByChance = 2.5, kFarOff = 6.0, kHardlyMore = 0.3;
  constexpr std::size_t kFewest = 5;
  std::vector<double> known;
  Loudness loud{.factors = std::vector<double>(scatters.size(), 1.0)};
  for (const double scatter : scatters)
    if (scatter > 0.0) known.push_back(scatter);
  if (known.size() < kFewest) return loud;
  const auto members = static_cast<double>(known.size());
  const double usual = median(std::move(known));
  double squares = 0.0, chance = 0.0;
  for (std::size_t i = 0; i < scatters.size(); ++i) {
    if (!(scatters[i] > 0.0)) continue;
    const double off = std::log(scatters[i] / usual);
    squares += off * off;
    chance += kByChance / values[i];
  }
  double differ = squares > 0.0 ? 1.0 - chance / squares : 0.0;
  if (differ < kHardlyMore) differ = 0.0;
  // A factor's square is known as chi-square of so many degrees is, by the variance of its
  // logarithm.
  if (differ > 0.0) loud.degrees = members / (2.0 * chance * differ);
  for (std::size_t i = 0; i < scatters.size(); ++i) {
    if (!(scatters[i] > 0.0)) continue;
    const double off = std::log(scatters[i] / usual);
    // A median of few sizes is sooner far too small than far too large.
    const double by_itself = off > 0.0 ? 1.0 - kFarOff * kByChance / (values[i] * off * off) : 0.0;
    loud.factors[i] = std::exp(off * std::max(differ, by_itself));
  }
  return loud;
}

}  // namespace trueflank::loop
