// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/threads.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

namespace {

// Of the thread that sets it: how many times memory is given yet. Negative: always.
thread_local int t_memory_given = -1;

}  // namespace

// (not inlined: g++ takes a free() that it sees beside a new for a mistake)
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (t_memory_given == 0) throw std::bad_alloc();
  if (t_memory_given > 0) --t_memory_given;
  if (void* given = std::malloc(size == 0 ? 1 : size)) return given;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* given) noexcept { std::free(given); }
[[gnu::noinline]] void operator delete(void* given, std::size_t) noexcept { std::free(given); }

namespace trueflank {
namespace {

TEST(Threads, EveryPieceIsDoneOnce) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
    std::vector<int> done(count, 0);
    for_each_piece(count, [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(count, 1));
  }
}

TEST(Threads, EveryPlaceIsWorkedOnOnceAndAtMostSoManyAtATime) {
  for (std::size_t count = 0; count < 14; ++count)
    for (std::size_t at_once = 1; at_once < 6; ++at_once) {
      std::array<std::atomic<int>, 14> times{};
      for_each_run(count, at_once, [&](std::size_t from, std::size_t to) {
        EXPECT_LT(from, to);
        EXPECT_LE(to - from, at_once);
        for (std::size_t i = from; i < to; ++i) ++times[i];
      });
      for (std::size_t i = 0; i < times.size(); ++i) EXPECT_EQ(times[i], i < count ? 1 : 0);
    }
}

TEST(Threads, ExceptionOfAPieceIsThrownOn) {
  const auto work = [](std::size_t i) {
    if (i == 7) throw std::runtime_error("the seventh");
  };
  EXPECT_THROW(for_each_piece(100, work), std::runtime_error);
}

TEST(Threads, WorkWithinWorkIsAllDone) {
  std::atomic<int> done{0};
  for_each_piece(20, [&](std::size_t) { for_each_piece(50, [&](std::size_t) { ++done; }); });
  EXPECT_EQ(done, 1000);
}

// Nothing is waited for that no thread has begun: the caller has done it.
TEST(Threads, HelpIsBegunAtMostOnceEachAndEndsWithItsScope) {
  for (int repeat = 0; repeat < 2000; ++repeat) {
    std::atomic<int> begun{0}, ended{0};
    {
      const Help help(3, [&] {
        ++begun;
        ++ended;
      });
    }
    EXPECT_EQ(begun, ended);
    EXPECT_LE(begun, 3);
  }
}

TEST(Threads, SeveralCallersShareThem) {
  std::atomic<int> done{0};
  {
    std::vector<std::jthread> callers;
    for (int caller = 0; caller < 5; ++caller)
      callers.emplace_back([&] {
        for (int repeat = 0; repeat < 200; ++repeat)
          for_each_piece(7, [&](std::size_t) { ++done; });
      });
  }
  EXPECT_EQ(done, 5 * 200 * 7);
}

// Wherever in it memory fails, the work is done or the failure thrown, and nothing of it is left to
// the threads that are kept.
TEST(Threads, WithoutMemoryForAThreadTheWorkIsDoneWithoutIt) {
  using std::chrono::milliseconds;
  for_each_piece(8, [](std::size_t) {});
  std::this_thread::sleep_for(milliseconds(700));  // none is kept: the next are begun anew
  int failed = 0;
  for (int given = 0; given < 8; ++given) {
    std::atomic<int> done{0};
    bool thrown = false;
    t_memory_given = given;
    try {
      const Help help(4, [&] { ++done; });
      t_memory_given = -1;
    } catch (const std::bad_alloc&) {
      t_memory_given = -1;
      thrown = true;
    }
    failed += thrown ? 1 : 0;
    const int before = done;
    for_each_piece(50, [](std::size_t) { std::this_thread::sleep_for(milliseconds(1)); });
    EXPECT_EQ(done, before) << "given " << given;  // it was withdrawn
    EXPECT_LE(done, thrown ? 0 : 4);
  }
  EXPECT_GT(failed, 0);  // without memory for the task itself
}

// Of the threads a fork takes the caller's alone along.
TEST(Threads, AForkedProcessHasItsOwn) {
  for_each_piece(8, [](std::size_t) {});
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::atomic<int> done{0};
    for_each_piece(100, [&](std::size_t) { ++done; });
    _exit(done == 100 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace trueflank
