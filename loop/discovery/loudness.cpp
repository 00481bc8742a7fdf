// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/loudness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <utility>

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

/// cos(pi j / 2m) of j = 0 ... 4m - 1. A loop asks for courses of a few lengths again and again: those asked for
/// last are at hand.
const std::vector<double>& cosines_of(Index m) {
  constexpr std::size_t kMostKept = 4;
  thread_local std::deque<std::vector<double>> kept;
  const auto count = static_cast<std::size_t>(4 * m);
  for (const std::vector<double>& known : kept)
    if (known.size() == count) return known;
  if (kept.size() == kMostKept) kept.pop_front();
  std::vector<double>& cosine = kept.emplace_back(count);
  const double step = 0.5 * kPi / static_cast<double>(m);
  for (std::size_t j = 0; j < count; ++j) cosine[j] = std::cos(step * static_cast<double>(j));
  return cosine;
}

/// By the median of the cosine coefficients of the shorter two thirds of the wavelengths.
double scatter_of_waves(const VectorXd& course) {
  constexpr std::size_t kAtOnce = 4;  // sums that do not wait for each other
  const auto m = static_cast<std::size_t>(course.size());
  const std::vector<double>& cosine = cosines_of(course.size());
  std::vector<double> coefficients;
  for (std::size_t first = m / 3; first < m; first += kAtOnce) {
    std::array<double, kAtOnce> sums{};
    std::array<std::size_t, kAtOnce> at{};  // k (2i + 1), less multiples of 4m
    for (std::size_t c = 0; c < kAtOnce; ++c) at[c] = std::min(first + c, m - 1);
    const std::array<std::size_t, kAtOnce> k = at;
    for (const double value : course)
      for (std::size_t c = 0; c < kAtOnce; ++c) {
        sums[c] += value * cosine[at[c]];
        at[c] += 2 * k[c];
        if (at[c] >= 4 * m) at[c] -= 4 * m;
      }
    for (std::size_t c = 0; c < std::min(kAtOnce, m - first); ++c)
      coefficients.push_back(sums[c] * std::sqrt(2.0 / static_cast<double>(m)));
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

Loudness loudness_of_few(const std::vector<double>& scatters, const std::vector<double>& values) {
  constexpr std::size_t kEnough = 5;
  std::vector<std::pair<double, double>> known;
  for (std::size_t i = 0; i < scatters.size(); ++i)
    if (scatters[i] > 0.0) known.emplace_back(scatters[i], values[i]);
  if (known.size() < 2 || known.size() >= kEnough) return loudness_of(scatters, values);
  std::sort(known.begin(), known.end());
  const auto [usual, count] = known[(known.size() - 1) / 2];
  std::vector<double> filled = scatters, of_filled = values;
  filled.resize(scatters.size() + kEnough - known.size(), usual);
  of_filled.resize(filled.size(), count);
  Loudness loud = loudness_of(filled, of_filled);
  loud.factors.resize(scatters.size());
  for (double& factor : loud.factors) factor = std::max(1.0, factor);
  return loud;
}

VectorXd loudness_of_places(const std::vector<Eigen::MatrixXd>& sets,
                            const std::vector<std::vector<double>>& scatters) {
  constexpr Index kParts = 12;
  constexpr std::size_t kFewestInAPart = 12;
  const Index m = sets.front().rows();
  std::vector<std::vector<double>> bends(kParts);
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (Index c = 0; c < sets[s].cols(); ++c) {
      const double usual = scatters[s][static_cast<std::size_t>(c)];
      if (!(usual > 0.0)) continue;
      const auto course = sets[s].col(c);
      for (Index i = 1; i + 1 < m; ++i)
        bends[static_cast<std::size_t>(kParts * i / m)].push_back(
            (course[i - 1] - 2.0 * course[i] + course[i + 1]) / usual);
    }
  std::vector<double> of_parts, values;
  for (std::vector<double>& of_part : bends) {
    values.push_back(static_cast<double>(of_part.size()));
    of_parts.push_back(of_part.size() < kFewestInAPart ? 0.0 : robust_sigma(std::move(of_part)));
  }
  const std::vector<double> factors = loudness_of(of_parts, values).factors;
  VectorXd loud(m);
  for (Index i = 0; i < m; ++i) {  // straight from the middle of a part to that of the next
    const double at = std::clamp(
        (static_cast<double>(i) + 0.5) * kParts / static_cast<double>(m) - 0.5, 0.0, kParts - 1.0);
    const auto before = std::min<std::size_t>(static_cast<std::size_t>(at), kParts - 2);
    const double part = at - static_cast<double>(before);
    loud[i] = std::max(1.0, (1.0 - part) * factors[before] + part * factors[before + 1]);
  }
  return loud;
}

}  // namespace trueflank::loop
