// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

// Work beside the caller's, where the system gives threads: small containers and full process
// tables do not, and then everything is done all the same, one thing after the other.
namespace trueflank {

/// Begins `work` on a thread of its own; where none can be started it is done when its result is
/// asked for.
template <class Work>
[[nodiscard]] auto begun_beside(const Work& work) {
  // with both, the library falls back to the second; what it was given to move is gone by then, so
  // it copies
  return std::async(std::launch::async | std::launch::deferred, work);
}

/// As many threads as can be started, `count` at most, each doing `work`. The caller does the same
/// work and so all of it where there are none. Joined when they are destroyed.
template <class Work>
[[nodiscard]] std::vector<std::jthread> helping_threads(std::size_t count, const Work& work) {
  std::vector<std::jthread> threads;
  threads.reserve(count);
  try {
    while (threads.size() < count) threads.emplace_back(work);
  } catch (const std::system_error&) {
    // the ones that run share what there is to do
  }
  return threads;
}

/// Up to `count` other threads do `work` once each, beside the caller, who does the same work: all
/// of it where no thread is free in time. They are kept for a moment for whoever asks next, and
/// there are at most twice as many as processors. `work` throws nothing.
class Help {
 public:
  Help(std::size_t count, std::function<void()> work);
  Help(const Help&) = delete;
  Help& operator=(const Help&) = delete;
  /// Takes back what no thread has begun, and waits for those that have.
  ~Help();

 private:
  struct Task;
  friend class KeptThreads;
  std::unique_ptr<Task> task_;
};

/// Asked of the system once: it opens a file for each answer.
[[nodiscard]] inline std::size_t processors() {
  static const std::size_t known = std::max(1U, std::thread::hardware_concurrency());
  return known;
}

/// Does `work(i)` for every i below `count` on all processors, in any order; returns when all is
/// done. An exception is thrown on once the others ended.
template <class Work>
void for_each_piece(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr thrown;
  std::mutex mutex;
  const auto take_pieces = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  };
  if (count > 0) {
    const Help others(std::min(count, processors()) - 1, take_pieces);
    take_pieces();
  }
  if (thrown) std::rethrow_exception(thrown);
}

/// Does `work(from, to)` for runs of `at_once` neighbours that make up 0 ... count - 1, on all processors, in any
/// order. For what does not ask each other: the same results on any number of processors.
template <class Work>
void for_each_run(std::size_t count, std::size_t at_once, const Work& work) {
  for_each_piece((count + at_once - 1) / at_once, [&](std::size_t piece) {
    work(piece * at_once, std::min(count, (piece + 1) * at_once));
  });
}

}  // namespace trueflank
