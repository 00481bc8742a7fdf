// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "trueflank/loop/drive/bench_table.h"

namespace trueflank::loop {

/// Where rows scatter clearly more than elsewhere, over the load, the speed or the temperature, in
/// one sentence; empty where they do not. `left_nm`: of the driven torque, what no effect explains.
/// Guarantees: in rows that scatter alike less than once in ten thousand benches (Welch's test of
/// the sizes, for every place that is tried).
[[nodiscard]] std::string where_it_scatters(const BenchTable& table, double ratio,
                                            const Eigen::VectorXd& left_nm);

}  // namespace trueflank::loop
