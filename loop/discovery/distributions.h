// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

// Tails of the distributions the loop judges by.
namespace trueflank::loop {

/// -log P(chi-square with 1 ... 8 degrees of freedom > x). Finite for any x.
[[nodiscard]] double minus_log_chi_square_tail(double x, int degrees);
/// P(|Student t| > t). Accuracy: 1e-10.
[[nodiscard]] double student_two_sided(double t, double degrees);
/// t with P(|Student t| <= t) = 0.95.
[[nodiscard]] double student_95(double degrees);

/// P(|a normal variable| > z), or of a mean whose excess kurtosis is above 0: Edgeworth's first term
/// in it, for tails longer than normal.
[[nodiscard]] double normal_two_sided(double z, double excess = 0.0);

/// P(a sum > x of its standard deviations) of one with this skewness, mean zero: Pearson's type
/// III, Wilson and Hilferty's approximation. A skewness below 0.05 is taken as that.
[[nodiscard]] double skewed_tail(double x, double skewness);

/// P(F with these degrees of freedom > f). Accuracy: 1e-10.
[[nodiscard]] double f_tail(double f, double degrees, double degrees_below);
/// How likely chance alone sets the largest of sizes so far beyond the others, where the tail of such sizes falls
/// no slower than an exponential: its gap against the gaps among the largest others, which are then all
/// exponential once each is multiplied by its rank (Renyi). No assumption of how wide or how normal errors are.
/// Requires: at least 4 others; with fewer it says 1.
[[nodiscard]] double gap_beyond_tail_p_value(double largest, std::vector<double> others);
/// How likely one value more is as far out by chance, where the others tell how long their tails
/// are: over generalised normal distributions, from tails longer than exponential ones to normal
/// ones, each weighed by how likely it makes the others and by how usual it is. Scale unknown;
/// sizes about zero. Requires: at least 4 others above zero; with fewer it says 1.
[[nodiscard]] double beyond_tails_alike_p_value(double size, const std::vector<double>& others);

}  // namespace trueflank::loop
