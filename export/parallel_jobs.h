// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace trueflank::io {

/// Something to do once others are done.
struct QueuedJob {
  std::function<bool()> work;       ///< false: no more jobs begin
  std::vector<std::size_t> needs;   ///< indices of jobs that come before it in the queue
};

/// Runs all jobs on all processors; a free processor begins the first one that has what it needs.
/// Returns when all are done. An exception of a job is thrown on after the others ended.
/// Requires: jobs need earlier jobs only.
void run_jobs(const std::vector<QueuedJob>& jobs);

}  // namespace trueflank::io
