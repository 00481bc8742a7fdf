// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace trueflank {

/// Legendre's polynomial of this degree (>= 0), orthogonal on -1 ... 1, by Bonnet's recursion.
[[nodiscard]] inline double legendre(int degree, double x) {
  if (degree == 0) return 1.0;
  double before = 1.0, now = x;
  for (int k = 1; k < degree; ++k) {
    const double next = ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0);
    before = now;
    now = next;
  }
  return now;
}

}  // namespace trueflank
