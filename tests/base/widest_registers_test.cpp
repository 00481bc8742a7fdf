// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/widest_registers.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace trueflank {
namespace {

constexpr std::size_t kCount = 67;  // no multiple of any register
using Row = std::array<double, kCount>;

Row random_row(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Row row{};
  for (double& value : row) value = any(random);
  return row;
}

TEST(WidestRegisters, GiveTheDigitsOfOneSumAfterTheOther) {
  const Row a = random_row(1), b = random_row(2);
  Row sums{};
  for (int round = 0; round < 3; ++round)
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      for (std::size_t i = 0; i < kCount; ++i) sums[i] += a[i] * b[i] + a[i] * 0.3;
    });
  for (std::size_t i = 0; i < kCount; ++i) {
    volatile double sum = 0.0, product = a[i] * b[i], other = a[i] * 0.3;
    for (int round = 0; round < 3; ++round) {
      volatile const double both = product + other;
      sum = sum + both;
    }
    EXPECT_EQ(sums[i], sum) << i;
  }
}

}  // namespace
}  // namespace trueflank
