// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace trueflank {

/// A zero of a continuous function between two places where its signs differ, by bisection with
/// regula falsi (Illinois) steps. Where the signs are equal: the end with the smaller magnitude.
/// Accuracy: the last two places of the argument.
template <class Function>
[[nodiscard]] double find_root(const Function& f, double low, double high) {
  double f_low = f(low), f_high = f(high);
  if (f_low == 0.0) return low;
  if (f_high == 0.0) return high;
  if (f_low * f_high > 0.0) return std::abs(f_low) < std::abs(f_high) ? low : high;
  int side = 0;
  for (int i = 0; i < 200; ++i) {
    double mid = (f_low * high - f_high * low) / (f_low - f_high);
    if (i % 4 == 3 || !(mid > std::min(low, high) && mid < std::max(low, high)))
      mid = 0.5 * (low + high);
    const double f_mid = f(mid);
    if (f_mid == 0.0) return mid;
    if (f_mid * f_low > 0.0) {
      low = mid;
      f_low = f_mid;
      if (side == 1) f_high *= 0.5;
      side = 1;
    } else {
      high = mid;
      f_high = f_mid;
      if (side == -1) f_low *= 0.5;
      side = -1;
    }
    if (std::abs(high - low) <= 4e-16 * (std::abs(low) + std::abs(high))) break;
  }
  return 0.5 * (low + high);
}

/// Both sides of the place where a property ends that holds at `with` and not at `without`, by so many halvings of the
/// stretch between them: first where it still holds.
template <class Property>
[[nodiscard]] std::pair<double, double> sides_of_change(const Property& holds, double with,
                                                        double without, int halvings) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (with + without);
    (holds(middle) ? with : without) = middle;
  }
  return {with, without};
}

}  // namespace trueflank
