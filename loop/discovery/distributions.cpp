// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/distributions.h"

#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank::loop {
namespace {

/// Regularised incomplete beta function by its continued fraction (Lentz).
double beta_fraction(double a, double b, double x) {
  double c = 1.0, d = 1.0 - (a + b) * x / (a + 1.0);
  d = 1.0 / (std::abs(d) < 1e-300 ? 1e-300 : d);
  double h = d;
  for (int i = 1; i <= 300; ++i) {
    const double m = i;
    double factor = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / (1.0 + factor * d);
    c = 1.0 + factor / c;
    h *= d * c;
    factor = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / (1.0 + factor * d);
    c = 1.0 + factor / c;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-14) break;
  }
  return h;
}

double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

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

double student_two_sided(double t, double degrees) {
  return incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
}

double student_95(double degrees) {
  return find_root([&](double t) { return student_two_sided(t, degrees) - 0.05; }, 1.0, 20.0);
}

double f_tail(double f, double degrees, double degrees_below) {
  if (!(f > 0.0)) return 1.0;
  return incomplete_beta(0.5 * degrees_below, 0.5 * degrees,
                         degrees_below / (degrees_below + degrees * f));
}

}  // namespace trueflank::loop
