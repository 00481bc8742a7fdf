// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tails of the distributions the loop judges by.
namespace trueflank::loop {

/// -log P(chi-square with 1 ... 8 degrees of freedom > x). Finite for any x.
[[nodiscard]] double minus_log_chi_square_tail(double x, int degrees);
/// P(|Student t| > t). Accuracy: 1e-10.
[[nodiscard]] double student_two_sided(double t, double degrees);
/// t with P(|Student t| <= t) = 0.95.
[[nodiscard]] double student_95(double degrees);

/// P(F with these degrees of freedom > f). Accuracy: 1e-10.
[[nodiscard]] double f_tail(double f, double degrees, double degrees_below);

}  // namespace trueflank::loop
