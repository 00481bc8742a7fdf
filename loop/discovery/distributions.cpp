// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/distributions.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <functional>

#include "trueflank/base/units.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank::loop {
namespace {

// In double precision; NaN where an argument is none, as the functions of <cmath>.
using namespace boost::math::policies;
using Quiet = policy<promote_double<false>, domain_error<ignore_error>, pole_error<ignore_error>,
                     overflow_error<ignore_error>, evaluation_error<ignore_error>>;

}  // namespace

double minus_log_chi_square_tail(double x, int degrees) {
  if (!(x > 0.0)) return 0.0;
  const double half = 0.5 * x;
  // Q(k/2, x/2) by the recurrence from Q(1/2) = erfc or Q(1) = exp; scaled by exp(half).
  double scaled, term;
  if (degrees % 2 == 0) {
    scaled = 1.0;
    term = 1.0;
    for (int k = 2; k < degrees; k += 2) {
      term *= half / (0.5 * k);
      scaled += term;
    }
  } else {
    const double root = std::sqrt(half);
    // erfc(r) exp(r^2): the asymptotic series where erfc itself would underflow.
    scaled = root < 20.0 ? std::erfc(root) * std::exp(half)
                         : 1.0 / (root * std::sqrt(kPi)) * (1.0 - 0.5 / half);
    term = std::sqrt(half / kPi) * 2.0;
    for (int k = 1; k < degrees; k += 2) {
      scaled += term;
      term *= half / (0.5 * k + 1.0);
    }
  }
  return half - std::log(scaled);
}

double normal_two_sided(double z, double excess) {
  const double square = z * z, root_of_two = std::sqrt(2.0);
  const double beyond = excess > 0.0 && square > 3.0 ? excess / 24.0 * std::abs(z) * (square - 3.0) : 0.0;
  return std::min(1.0, std::erfc(std::abs(z) / root_of_two) +
                           2.0 * beyond * std::exp(-0.5 * square) / std::sqrt(kTwoPi));
}

double student_two_sided(double t, double degrees) {
  return boost::math::ibeta(0.5 * degrees, 0.5, degrees / (degrees + t * t), Quiet());
}

double student_95(double degrees) {
  return find_root([&](double t) { return student_two_sided(t, degrees) - 0.05; }, 1.0, 20.0);
}

double skewed_tail(double x, double skewness) {
  const double skew = std::max(0.05, skewness), degrees = 8.0 / (skew * skew);
  const double chi = std::max(0.0, 1.0 + x * std::sqrt(2.0 / degrees)),
               part = 2.0 / (9.0 * degrees);
  return 0.5 * std::erfc((std::cbrt(chi) - 1.0 + part) / std::sqrt(2.0 * part));
}

double f_tail(double f, double degrees, double degrees_below) {
  if (!(f > 0.0)) return 1.0;
  return boost::math::ibeta(0.5 * degrees_below, 0.5 * degrees,
                            degrees_below / (degrees_below + degrees * f), Quiet());
}

double gap_beyond_tail_p_value(double largest, std::vector<double> others) {
  constexpr std::size_t kFewest = 4, kEnough = 8, kShare = 3;
  if (others.size() < kFewest) return 1.0;
  std::sort(others.begin(), others.end(), std::greater<>());
  const std::size_t count = std::min(others.size(), std::max(kEnough, others.size() / kShare));
  double sum = 0.0;
  for (std::size_t i = 1; i < count; ++i)
    sum += static_cast<double>(i + 1) * (others[i - 1] - others[i]);
  const auto gaps = static_cast<double>(count - 1);
  if (!(largest > others.front())) return 1.0;
  return sum > 0.0 ? f_tail((largest - others.front()) * gaps / sum, 2.0, 2.0 * gaps) : 0.0;
}

double beyond_tails_alike_p_value(double size, const std::vector<double>& others) {
  // Density exp(-(|x| / scale)^power): 1 is Laplace's, 2 the normal one.
  struct Tail {
    double power, usual;
  };
  constexpr std::array kTails{Tail{0.5, 0.3}, Tail{0.7, 0.3}, Tail{1.0, 0.6},
                              Tail{1.3, 1.0}, Tail{1.6, 2.0}, Tail{2.0, 6.0}};
  constexpr std::size_t kFewest = 4;
  const auto log_gamma = [](double x) { return boost::math::lgamma(x, Quiet()); };
  std::vector<double> logs;
  for (const double other : others)
    if (other > 0.0) logs.push_back(std::log(other));
  if (logs.size() < kFewest || !(size > 0.0)) return 1.0;
  const auto n = static_cast<double>(logs.size());
  std::array<double, kTails.size()> likely{}, chance{};
  for (std::size_t k = 0; k < kTails.size(); ++k) {
    const double power = kTails[k].power;
    // (in sizes of this one, so that no power overflows)
    double sum = 0.0;
    for (const double log : logs) sum += std::exp(power * (log - std::log(size)));
    likely[k] = (n - 1.0) * std::log(power) - n * log_gamma(1.0 / power) + log_gamma(n / power) -
                n / power * (std::log(sum) + power * std::log(size)) + std::log(kTails[k].usual);
    chance[k] = f_tail(n / sum, 2.0 / power, 2.0 * n / power);
  }
  const double most = *std::max_element(likely.begin(), likely.end());
  double total = 0.0, beyond = 0.0;
  for (std::size_t k = 0; k < kTails.size(); ++k) {
    const double weight = std::exp(likely[k] - most);
    total += weight;
    beyond += weight * chance[k];
  }
  return beyond / total;
}

}  // namespace trueflank::loop
