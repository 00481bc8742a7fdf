// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of text files of points, each as exact as the C++ library reads it.
#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "trueflank/loop/measured/read_measurement.h"

namespace trueflank::test {
namespace {

double as_the_library_reads(const std::string& number) {
  double value = std::nan("");
  std::from_chars(number.data(), number.data() + number.size(), value);
  return value;
}

std::string digits(std::mt19937_64& random, std::uint64_t count) {
  std::string all;
  for (std::uint64_t k = 0; k < count; ++k) all += static_cast<char>('0' + random() % 10);
  return all;
}

/// A number below a thousand with up to 20 digits, some with an exponent.
std::string any_number(std::mt19937_64& random) {
  std::string text = random() % 2 == 0 ? "-" : "";
  text += random() % 8 == 0 ? "00" : "";
  text += digits(random, 1 + random() % 3);
  if (const auto behind = random() % 18; behind > 0) text += "." + digits(random, behind);
  if (random() % 16 == 0) text += "e-" + std::to_string(random() % 30);
  return text;
}

TEST(ReadPoints, NumbersAreThoseOfTheLibrary) {
  std::mt19937_64 random(20261127);
  constexpr std::size_t kPoints = 50000;
  std::vector<std::array<double, 3>> expected;
  std::string text;
  for (std::size_t i = 0; i < kPoints; ++i) {
    std::array<double, 3> point{};
    for (double& value : point) {
      const std::string number = any_number(random);
      value = as_the_library_reads(number);
      text += number + (random() % 4 == 0 ? " \t" : " ");
    }
    text += random() % 4 == 0 ? "\r\n" : "\n";
    expected.push_back(point);
  }
  std::vector<std::string> notes;
  const auto scan = loop::read_xyz("points.xyz", text, notes);
  ASSERT_TRUE(scan.has_value());
  EXPECT_TRUE(notes.empty());
  ASSERT_EQ(scan->points_mm.size(), kPoints);
  for (std::size_t i = 0; i < kPoints; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(scan->points_mm[i][k], expected[i][k]) << i;
      ASSERT_EQ(std::signbit(scan->points_mm[i][k]), std::signbit(expected[i][k])) << i;
    }
}

TEST(ReadPoints, LinesThatAreNoThreePlainNumbersAreReadAsBefore) {
  const std::string text =
      "4\n# a comment\n1 2 3\n  +1.5 .5 5.\n\t1e1\t2 3 4 5\n12345678901234567890.5e-18 0 -0.0\n1 "
      "2\n1 2 x\n1 2e7 3\n";
  std::vector<std::string> notes;
  const auto scan = loop::read_xyz("points.xyz", text, notes);
  ASSERT_TRUE(scan.has_value()) << scan.error().message;
  const std::vector<std::array<double, 3>> expected{
      {1.0, 2.0, 3.0}, {1.5, 0.5, 5.0}, {10.0, 2.0, 3.0}, {12.3456789012345678905, 0.0, -0.0}};
  EXPECT_EQ(scan->points_mm, expected);
  ASSERT_EQ(notes.size(), 3U);
  for (std::size_t k = 0; k < notes.size(); ++k)
    EXPECT_EQ(notes[k].find("points.xyz:" + std::to_string(7 + k) + ": left out"), 0U) << notes[k];
}

}  // namespace
}  // namespace trueflank::test
