// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/discovery/course_scan.h"

// Waves that courses have each in a phase of its own. Knows nothing of gears.
namespace trueflank::loop {

/// The wavelength whose power over all courses of a set stands out most of that beside it: a line
/// stands out of any spectrum that is smooth. `loud`: how much louder than the usual course each
/// course of a set is. `tests`: how many wavelengths were asked; the p-value is not yet paid for
/// them. `holders` where few courses have nearly all of it.
[[nodiscard]] CourseFinding own_waves(const std::vector<Eigen::MatrixXd>& sets,
                                      const std::vector<Eigen::VectorXd>& loud, double& tests);

}  // namespace trueflank::loop
