// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/threads.h"

#include <gtest/gtest.h>

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

TEST(Threads, ExceptionOfAPieceIsThrownOn) {
  const auto work = [](std::size_t i) {
    if (i == 7) throw std::runtime_error("the seventh");
  };
  EXPECT_THROW(for_each_piece(100, work), std::runtime_error);
}

}  // namespace
}  // namespace trueflank
