// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/parallel_jobs.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace trueflank::io {

void run_jobs(std::size_t count, const std::function<bool(std::size_t)>& job) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      bool go_on = false;
      try {
        go_on = job(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!thrown) thrown = std::current_exception();
      }
      if (!go_on) next = count;
    }
  };
  const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < std::min(count, processors); ++i) others.emplace_back(work);
  work();
  others.clear();  // joins
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace trueflank::io
