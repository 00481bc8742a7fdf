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
      : jobs_(jobs), state_(jobs.size(), State::kWaiting), left_(jobs.size()) {
    for (std::size_t i = 0; i < jobs.size(); ++i)
      for (const std::size_t need : jobs[i].needs) TRUEFLANK_EXPECTS(need < i);
  }

  /// What each processor does.
  void work() {
    while (const auto job = next()) {
      bool go_on = false;
      try {
        go_on = jobs_[*job].work();
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!thrown_) thrown_ = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      state_[*job] = State::kDone;
      if (!go_on) left_ = 0;
      changed_.notify_all();
    }
  }
  void throw_what_was_thrown() const {
    if (thrown_) std::rethrow_exception(thrown_);
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
    while (left_ > 0) {
      for (std::size_t i = 0; i < jobs_.size(); ++i) {
        if (!ready(i)) continue;
        state_[i] = State::kBegun;
        if (--left_ == 0) changed_.notify_all();
        return i;
      }
      changed_.wait(lock);
    }
    return std::nullopt;
  }

  const std::vector<QueuedJob>& jobs_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<State> state_;
  std::size_t left_;  ///< not yet begun
  std::exception_ptr thrown_;
};

}  // namespace

void run_jobs(const std::vector<QueuedJob>& jobs) {
  Queue queue(jobs);
  const std::size_t processors = trueflank::processors();
  if (jobs.empty()) return;
  {
    const Help others(std::min(jobs.size(), processors) - 1, [&queue] { queue.work(); });
    queue.work();
  }
  queue.throw_what_was_thrown();
}

}  // namespace trueflank::io
