// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace trueflank {

/// Where a function is smallest between two places, and how small.
struct ScalarMinimum {
  double at = 0.0;
  double value = 0.0;
};

/// Golden section with parabolic steps (Brent). Finds the minimum of a function with one valley in
/// [low, high], one of several otherwise; ends included.
/// `done`: told the lowest value so far, those of both ends, and how far from its place the search may still look;
/// true where that is answer enough. `aside`: the function again, at a place that the answer is not taken from.
/// Accuracy: `tolerance` of the argument, at most 61 evaluations.
template <class Function, class Done, class Aside>
[[nodiscard]] ScalarMinimum find_minimum(const Function& f, double low, double high, double tolerance,
                                         const Done& done, const Aside& aside) {
  constexpr double kNearEnd = 0.1;   // of the range
  constexpr double kRising = 1e-10;  // far above what distances [mm] found by such a search are off by
  constexpr double kGolden = 0.3819660112501051;
  double x = low + kGolden * (high - low), w = x, v = x;
  double fx = f(x), fw = fx, fv = fx, step = 0.0, last = 0.0;
  const double end_low = f(low), end_high = f(high);
  double a = low, b = high;
  bool end_tried = false;
  for (int i = 0; i < 58; ++i) {
    const double mid = 0.5 * (a + b);
    if (std::abs(x - mid) <= 2.0 * tolerance - 0.5 * (b - a)) break;
    if (done(fx, end_low, end_high, x < mid ? b - x : x - a)) break;
    // Golden section takes thirty steps to an end. Where a narrow range is left beside it and the function rises
    // from it, that is where they lead.
    if (!end_tried && b - a < kNearEnd * (high - low) && (a == low || b == high)) {
      end_tried = true;
      const double end = a == low ? end_low : end_high;
      if (end < fx && aside(a == low ? low + 2.0 * tolerance : high - 2.0 * tolerance) > end + kRising) break;
    }
    bool golden = true;
    if (std::abs(last) > tolerance) {
      const double r = (x - w) * (fx - fv), q0 = (x - v) * (fx - fw);
      double p = (x - v) * q0 - (x - w) * r, q = 2.0 * (q0 - r);
      if (q > 0.0) p = -p;
      q = std::abs(q);
      const double before = last;
      last = step;
      if (std::abs(p) < std::abs(0.5 * q * before) && p > q * (a - x) && p < q * (b - x)) {
        step = p / q;
        const double u = x + step;
        if (u - a < 2.0 * tolerance || b - u < 2.0 * tolerance)
          step = x < mid ? tolerance : -tolerance;
        golden = false;
      }
    }
    if (golden) {
      last = x < mid ? b - x : a - x;
      step = kGolden * last;
    }
    const double u = std::abs(step) >= tolerance ? x + step : x + (step > 0.0 ? tolerance : -tolerance);
    const double fu = f(u);
    if (fu <= fx) {
      (u < x ? b : a) = x;
      v = w, fv = fw;
      w = x, fw = fx;
      x = u, fx = fu;
    } else {
      (u < x ? a : b) = u;
      if (fu <= fw || w == x) {
        v = w, fv = fw;
        w = u, fw = fu;
      } else if (fu <= fv || v == x || v == w) {
        v = u, fv = fu;
      }
    }
  }
  if (end_low < fx && end_low <= end_high) return {low, end_low};
  if (end_high < fx) return {high, end_high};
  return {x, fx};
}
template <class Function>
[[nodiscard]] ScalarMinimum find_minimum(const Function& f, double low, double high, double tolerance) {
  return find_minimum(f, low, high, tolerance, [](double, double, double, double) { return false; }, f);
}

}  // namespace trueflank
