// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace trueflank::io {

/// Runs job(0) ... job(count - 1) on all processors, begun in this order; returns when all are done.
/// job returns false to let no more begin. An exception of a job is thrown on after the others ended.
void run_jobs(std::size_t count, const std::function<bool(std::size_t)>& job);

}  // namespace trueflank::io
