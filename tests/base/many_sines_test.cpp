// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/many_sines.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

/// In bits: zeros have signs, and what is no number is the same.
void expect_the_digits_of_one(const std::vector<double>& angles) {
  std::vector<double> sines(angles.size()), cosines(angles.size());
  sines_and_cosines(angles, sines, cosines);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    EXPECT_EQ(bits(sines[i]), bits(std::sin(angles[i]))) << "sine of " << angles[i];
    EXPECT_EQ(bits(cosines[i]), bits(std::cos(angles[i]))) << "cosine of " << angles[i];
  }
}

TEST(ManySines, HaveTheDigitsOfOneAfterTheOther) {
  std::mt19937 random(7);
  for (const double most : {1e-9, 0.8, 4.0, 1e3, 1e6}) {
    std::uniform_real_distribution<double> any(-most, most);
    std::vector<double> angles(4003);  // no multiple of any register
    for (double& angle : angles) angle = any(random);
    expect_the_digits_of_one(angles);
  }
}

TEST(ManySines, HaveThemAtTheBordersOfTheReductionAndBeyond) {
  std::vector<double> angles = {0.0,
                                -0.0,
                                0x1p-27,
                                0.785,
                                1e6,
                                1e7,
                                1e300,
                                std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()};
  for (int quarter = 1; quarter < 200; ++quarter) angles.push_back(quarter * 0x1.921fb54442d18p-1);
  const std::size_t count = angles.size();
  for (std::size_t i = 0; i < count; ++i) {
    angles.push_back(-angles[i]);
    angles.push_back(std::nextafter(angles[i], 1e308));
    angles.push_back(std::nextafter(angles[i], -1e308));
  }
  for (std::size_t few = 0; few < 9; ++few)
    expect_the_digits_of_one({angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(few)});
  expect_the_digits_of_one(angles);
}

TEST(ManySines, NeedRoomForAll) {
  const std::vector<double> angles(3);
  std::vector<double> sines(3), cosines(2);
  EXPECT_THROW(sines_and_cosines(angles, sines, cosines), ContractViolation);
}

}  // namespace
}  // namespace trueflank
