// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

// Some traces or flanks of a record are measured worse than others. How much worse is told from
// how their own neighbouring values scatter. Knows nothing of gears.
namespace trueflank::loop {

/// Scatter of the values of one course from place to place, in any unit that is the same for all
/// courses: the smaller of two that few wild points, a step, a spot (by second differences) and a
/// line (by the median of the shorter wavelengths) hardly touch. 0 of fewer than 12 values, and
/// where most values do not differ.
[[nodiscard]] double short_wave_scatter(const Eigen::VectorXd& course);

/// Variance of the logarithm of a robust scatter, times the number of differences it was told from.
inline constexpr double kVarianceOfLogScatter = 2.5;

/// By what factor the random error of each member is larger than that of the usual one, and with
/// how many degrees of freedom these factors are known; infinite where all members are taken as
/// alike.
struct Loudness {
  std::vector<double> factors;
  double degrees = std::numeric_limits<double>::infinity();
};

/// The least that chance can be of a value so many standard errors off, as its error is known by a
/// loudness with these degrees: Student's two tails. Not computed, 0, above `asked_below` of the
/// normal error's chance, or where loudness is known.
[[nodiscard]] double least_chance(double errors, double degrees, double normal_chance,
                                  double asked_below = 1e-3);

/// `scatters`: a robust one of each, 0 where it is not known (factor 1). `values`: how many
/// differences it was told from. Where the members' scatters differ hardly more than chance makes
/// them, all are alike but for those far louder, whose logarithms are shrunk by what chance makes
/// of them; else all logarithms are shrunk by the share of their variance that chance makes.
[[nodiscard]] Loudness loudness_of(const std::vector<double>& scatters,
                                   const std::vector<double>& values);

/// loudness_of where members are few: fewer than five are asked beside as many of the quieter half
/// as are missing, so that one that stands far above these is told, and none is quieter.
[[nodiscard]] Loudness loudness_of_few(const std::vector<double>& scatters,
                                       const std::vector<double>& values);

/// By how much louder than usual the places of courses are that stand beside each other (one a
/// column of a set, zero mean), the same for all of them: 1 or more, a factor a row, and 1
/// everywhere where they differ hardly more than chance makes them. From second differences, each
/// course in its own scatter: `scatters`, one a column of the set (0: not known).
[[nodiscard]] Eigen::VectorXd loudness_of_places(const std::vector<Eigen::MatrixXd>& sets,
                                                 const std::vector<std::vector<double>>& scatters);

}  // namespace trueflank::loop
