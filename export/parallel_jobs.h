// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace trueflank::io {

/// Something to do once others are done.
struct QueuedJob {
  std::function<bool()> work;       ///< false: it failed, and no job after it begins
  std::vector<std::size_t> needs;   ///< indices of jobs that come before it in the queue
};

/// Runs all jobs on all processors; a free processor begins the first one that has what it needs.
/// Returns when all are done. Where jobs fail, those before the first of them are done all the
/// same: which one that is does not hang on which processor was faster. An exception is a failure
/// too, and that of the first job is thrown on after the others ended. Returns: the index of the
/// first job that failed. Requires: jobs need earlier jobs only.
std::optional<std::size_t> run_jobs(const std::vector<QueuedJob>& jobs);

}  // namespace trueflank::io
