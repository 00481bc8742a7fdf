// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/parallel_jobs.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "trueflank/base/contract.h"
#include "trueflank/base/threads.h"

namespace trueflank::io {
namespace {

class Queue {
 public:
  explicit Queue(const std::vector<QueuedJob>& jobs)
      : jobs_(jobs), state_(jobs.size(), State::kWaiting), end_(jobs.size()) {
    for (std::size_t i = 0; i < jobs.size(); ++i)
      for (const std::size_t need : jobs[i].needs) TRUEFLANK_EXPECTS(need < i);
  }

  /// What each processor does.
  void work() {
    while (const auto job = next()) {
      bool done = false;
      std::exception_ptr thrown;
      try {
        done = jobs_[*job].work();
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      state_[*job] = State::kDone;
      if (!done && *job < end_) {
        end_ = *job;
        thrown_ = thrown;
      }
      changed_.notify_all();
    }
  }
  /// Throws on what the first job that failed threw.
  [[nodiscard]] std::optional<std::size_t> first_failed() const {
    if (thrown_) std::rethrow_exception(thrown_);
    return end_ < jobs_.size() ? std::optional(end_) : std::nullopt;
  }

 private:
  enum class State { kWaiting, kBegun, kDone };

  [[nodiscard]] bool ready(std::size_t job) const {
    const auto& needs = jobs_[job].needs;
    return state_[job] == State::kWaiting &&
           std::all_of(needs.begin(), needs.end(),
                       [&](std::size_t need) { return state_[need] == State::kDone; });
  }
  /// Waits for a job to be ready; nothing where none is left.
  std::optional<std::size_t> next() {
    std::unique_lock lock(mutex_);
    while (true) {
      bool all_begun = true;
      for (std::size_t i = 0; i < end_; ++i) {
        if (ready(i)) {
          state_[i] = State::kBegun;
          return i;
        }
        all_begun = all_begun && state_[i] != State::kWaiting;
      }
      if (all_begun) return std::nullopt;
      changed_.wait(lock);
    }
  }

  const std::vector<QueuedJob>& jobs_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<State> state_;
  std::size_t end_;  ///< jobs from here on do not begin: the first that failed, or their number
  std::exception_ptr thrown_;
};

}  // namespace

std::optional<std::size_t> run_jobs(const std::vector<QueuedJob>& jobs) {
  Queue queue(jobs);
  const std::size_t processors = trueflank::processors();
  if (jobs.empty()) return std::nullopt;
  {
    const Help others(std::min(jobs.size(), processors) - 1, [&queue] { queue.work(); });
    queue.work();
  }
  return queue.first_failed();
}

}  // namespace trueflank::io
