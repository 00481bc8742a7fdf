// SPDX-License-Identifier: GPL-3.0-or-later
//
// Our sin, cos, ... against the C library's of long double, which has eleven more bits. This
// program is linked as ours are: std::sin is base/elementary_functions.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// In units of the last place of `right`.
double error_of(double found, long double right) {
  int exponent = 0;
  (void)std::frexp(static_cast<double>(right), &exponent);
  const double unit = std::ldexp(1.0, std::max(exponent - 53, -1074));
  return static_cast<double>(std::abs(static_cast<long double>(found) - right) /
                             static_cast<long double>(unit));
}

struct Compared {
  const char* name;
  std::function<double(double)> ours;
  std::function<long double(long double)> right;
  double from, to;
  double bound;
};

TEST(ElementaryFunctions, AgreeWithLongDoubles) {
  const std::vector<Compared> all = {
      {"sin", [](double x) { return std::sin(x); }, [](long double x) { return std::sin(x); }, -4,
       4, 1.0},
      {"sin", [](double x) { return std::sin(x); }, [](long double x) { return std::sin(x); }, -1e6,
       1e6, 1.0},
      {"sin", [](double x) { return std::sin(x); }, [](long double x) { return std::sin(x); }, 1e6,
       1e9, 1.0},
      {"cos", [](double x) { return std::cos(x); }, [](long double x) { return std::cos(x); }, -4,
       4, 1.0},
      {"cos", [](double x) { return std::cos(x); }, [](long double x) { return std::cos(x); }, -1e6,
       1e6, 1.0},
      {"tan", [](double x) { return std::tan(x); }, [](long double x) { return std::tan(x); }, -100,
       100, 3.0},
      {"asin", [](double x) { return std::asin(x); }, [](long double x) { return std::asin(x); },
       -1, 1, 3.0},
      {"acos", [](double x) { return std::acos(x); }, [](long double x) { return std::acos(x); },
       -1, 1, 3.0},
      {"atan", [](double x) { return std::atan(x); }, [](long double x) { return std::atan(x); },
       -1, 1, 1.5},
      {"atan", [](double x) { return std::atan(x); }, [](long double x) { return std::atan(x); },
       -50, 50, 1.5},
      {"atan2", [](double x) { return std::atan2(x, -0.3); },
       [](long double x) { return std::atan2(x, static_cast<long double>(-0.3)); }, -2, 2, 1.5},
      {"exp", [](double x) { return std::exp(x); }, [](long double x) { return std::exp(x); }, -745,
       709, 1.0},
      {"exp", [](double x) { return std::exp(x); }, [](long double x) { return std::exp(x); }, -1,
       1, 1.0},
      {"log", [](double x) { return std::log(x); }, [](long double x) { return std::log(x); }, 0.0,
       2.0, 1.0},
      {"log", [](double x) { return std::log(x); }, [](long double x) { return std::log(x); }, 0.9,
       1.1, 1.0},
      {"log", [](double x) { return std::log(x); }, [](long double x) { return std::log(x); }, 1.0,
       1e300, 1.0},
      {"pow", [](double x) { return std::pow(x, 0.7); },
       [](long double x) { return std::pow(x, static_cast<long double>(0.7)); }, 0.0, 1e4, 1.0},
      {"pow", [](double x) { return std::pow(10.0, x); },
       [](long double x) { return std::pow(10.0L, x); }, -300, 300, 1.0}};
  std::mt19937_64 random(12);
  for (const Compared& c : all) {
    double worst = 0.0, at = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double x = c.from + (c.to - c.from) * (static_cast<double>(random() >> 11U) * 0x1p-53);
      const double error = error_of(c.ours(x), c.right(static_cast<long double>(x)));
      if (!(error <= worst)) worst = error, at = x;
    }
    EXPECT_LT(worst, c.bound) << c.name << " at " << at;
  }
}

/// A value that the compiler does not know, so that it does not compute with it.
double told(double value) {
  const volatile double hidden = value;
  return hidden;
}

TEST(ElementaryFunctions, HaveTheValuesOfTheStandardAtTheEnds) {
  const auto same = [](double found, double right) {
    return std::isnan(right) ? std::isnan(found)
                             : found == right && std::signbit(found) == std::signbit(right);
  };
  const double pi = std::acos(told(-1.0));
  EXPECT_EQ(pi, 3.14159265358979323846);
  EXPECT_TRUE(same(std::sin(told(-0.0)), -0.0));
  EXPECT_TRUE(same(std::sin(told(kInfinity)), kNan));
  EXPECT_TRUE(same(std::cos(told(0.0)), 1.0));
  EXPECT_TRUE(same(std::tan(told(-0.0)), -0.0));
  EXPECT_TRUE(same(std::asin(told(1.0)), 0.5 * pi));
  EXPECT_TRUE(same(std::asin(told(1.5)), kNan));
  EXPECT_TRUE(same(std::acos(told(1.0)), 0.0));
  EXPECT_TRUE(same(std::acos(told(0.0)), 0.5 * pi));
  EXPECT_TRUE(same(std::atan(told(-kInfinity)), -0.5 * pi));
  EXPECT_TRUE(same(std::atan(told(kNan)), kNan));
  EXPECT_TRUE(same(std::atan2(told(0.0), told(-0.0)), pi));
  EXPECT_TRUE(same(std::atan2(told(-0.0), told(1.0)), -0.0));
  EXPECT_TRUE(same(std::atan2(told(-1.0), told(0.0)), -0.5 * pi));
  EXPECT_TRUE(same(std::atan2(told(1.0), told(kInfinity)), 0.0));
  EXPECT_TRUE(same(std::exp(told(0.0)), 1.0));
  EXPECT_TRUE(same(std::exp(told(-kInfinity)), 0.0));
  EXPECT_TRUE(same(std::exp(told(711.0)), kInfinity));
  EXPECT_TRUE(same(std::log(told(1.0)), 0.0));
  EXPECT_TRUE(same(std::log(told(0.0)), -kInfinity));
  EXPECT_TRUE(same(std::log(told(-1.0)), kNan));
  EXPECT_TRUE(same(std::log(told(kInfinity)), kInfinity));
  EXPECT_TRUE(same(std::pow(told(-2.0), told(3.0)), -8.0));
  EXPECT_TRUE(same(std::pow(told(-2.0), told(0.5)), kNan));
  EXPECT_TRUE(same(std::pow(told(0.0), told(0.0)), 1.0));
  EXPECT_TRUE(same(std::pow(told(10.0), told(-2.0)), 0.01));
  EXPECT_TRUE(same(std::pow(told(10.0), told(22.0)), 1e22));
  EXPECT_TRUE(same(std::pow(told(1e300), told(2.0)), kInfinity));
  EXPECT_TRUE(same(std::pow(told(1e-300), told(kInfinity)), 0.0));
  EXPECT_TRUE(same(std::pow(told(3.0), told(0.0)), 1.0));
}

/// The last digits too are the same on every processor: a sum over the bits of many values, as
/// found on processors with fused multiply-add and without (and with the processor's own taken away
/// by emulation).
TEST(ElementaryFunctions, GiveTheSameDigitsOnEveryProcessor) {
  std::uint64_t sum = 0;
  std::mt19937_64 random(13);
  const auto add = [&](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    sum = sum * 1099511628211U + bits;
  };
  for (int i = 0; i < 20000; ++i) {
    const double x = static_cast<double>(random() >> 11U) * 0x1p-53;
    const double y = 20.0 * x - 10.0;
    for (const double value :
         {std::sin(y), std::cos(y), std::tan(y), std::asin(x), std::acos(x), std::atan(y),
          std::atan2(y, x), std::exp(y), std::log(x), std::pow(x, y)})
      add(value);
  }
  EXPECT_EQ(sum, 13875039276281418580U);
}

}  // namespace
