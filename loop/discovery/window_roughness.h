// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

// How rough courses are from place to place and in each window. Knows nothing of gears.
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

}  // namespace trueflank::loop
