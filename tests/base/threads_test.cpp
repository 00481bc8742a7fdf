// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/threads.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <vector>

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

}  // namespace
}  // namespace trueflank
