// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/threads.h"

#include <pthread.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <list>
#include <utility>

namespace trueflank {

struct Help::Task {
  std::function<void()> work;
  std::size_t wanted = 0, running = 0;
  std::condition_variable done;
};

/// Threads that wait for tasks. A thread is begun where none waits, and ends when it was not asked
/// for a while: a program that uses the library keeps none for long.
class KeptThreads {
 public:
  static KeptThreads& ours() { return *slot(); }

  void add(Help::Task& task) {
    const std::size_t asked = task.wanted;  // (others take from it once it is in the list)
    std::unique_lock lock(mutex_);
    tasks_.push_back(&task);
    wanted_ += asked;
    const std::size_t most = 2 * processors();
    while (waiting_ + begun_ < wanted_ && threads_ < most) {
      ++threads_, ++begun_;
      try {
        std::thread([this] { serve(); }).detach();
      } catch (const std::exception&) {  // no thread, or no memory to begin one
        --threads_, --begun_;
        break;  // those that run share what there is to do
      }
    }
    lock.unlock();
    for (std::size_t i = 0; i < asked; ++i) asked_.notify_one();
  }

  void withdraw(Help::Task& task) {
    std::unique_lock lock(mutex_);
    wanted_ -= task.wanted;
    task.wanted = 0;
    task.done.wait(lock, [&] { return task.running == 0; });
    tasks_.remove(&task);
  }

 private:
  /// Never destroyed: threads wait in it until the program ends. A forked process has none of them,
  /// and a new one.
  static KeptThreads*& slot() {
    static KeptThreads* threads = [] {
      pthread_atfork(nullptr, nullptr, [] { slot() = new KeptThreads; });
      return new KeptThreads;
    }();
    return threads;
  }

  void serve() {
    constexpr std::chrono::milliseconds kPatience{500};
    std::unique_lock lock(mutex_);
    --begun_;
    for (;;) {
      ++waiting_;
      const bool asked = asked_.wait_for(lock, kPatience, [&] { return wanted_ > 0; });
      --waiting_;
      if (!asked) break;
      Help::Task& task = *next();
      --task.wanted, --wanted_, ++task.running;
      lock.unlock();
      task.work();
      lock.lock();
      if (--task.running == 0) task.done.notify_one();
    }
    --threads_;
  }

  /// The last one that wants threads: what is asked within another piece of work is done first.
  [[nodiscard]] Help::Task* next() const {
    for (auto task = tasks_.rbegin();; ++task)
      if ((*task)->wanted > 0) return *task;
  }

  std::mutex mutex_;
  std::condition_variable asked_;
  std::list<Help::Task*> tasks_;
  std::size_t wanted_ = 0;  ///< by all tasks together
  std::size_t threads_ = 0, begun_ = 0,
              waiting_ = 0;  ///< all; those that do not serve yet; idle ones
};

Help::Help(std::size_t count, std::function<void()> work) {
  if (count == 0) return;
  task_ = std::make_unique<Task>();
  task_->work = std::move(work);
  task_->wanted = count;
  KeptThreads::ours().add(*task_);
}

Help::~Help() {
  if (task_) KeptThreads::ours().withdraw(*task_);
}

}  // namespace trueflank
