// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/discovery/loudness.h"

// How rough courses are from place to place, in each window, and where they are few. Knows nothing
// of gears.
namespace trueflank::loop {

/// Correlation of values at places beside each other, whatever few of them stand out. Courses are
/// the columns of a set.
[[nodiscard]] double likeness_of_neighbours(const Eigen::MatrixXd& set);

/// How rough courses are from place to place, as squares, and how rough each is usually.
struct Roughness {
  Eigen::MatrixXd squares;
  std::vector<double> usual;
};
[[nodiscard]] Roughness roughness_of(const Eigen::MatrixXd& set);

/// How much rougher than usual a course is within each window of so many rows, where it is: wild
/// points and bursts of noise are, what has a form is not. 1 elsewhere.
[[nodiscard]] Eigen::MatrixXd roughness_in_windows(const Roughness& of, Eigen::Index width);

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
