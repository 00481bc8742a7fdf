// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trueflank::loop {

/// Products of each of the columns (rows of the result) with each of others (its columns) of as
/// many rows: those of `columns.transpose() * other` digit for digit, for any number of others at
/// once. The columns are read once for many others, where a product with one of them mostly waits
/// for memory.
[[nodiscard]] Eigen::MatrixXd column_products(const Eigen::MatrixXd& columns,
                                              const std::vector<const double*>& others);

}  // namespace trueflank::loop
