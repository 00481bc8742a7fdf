// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>

namespace trueflank {
namespace {

template <class... Arguments>
std::string by_printf(const char* format, Arguments... arguments) {
  char room[2000];
  std::snprintf(room, sizeof room, format, arguments...);
  return room;
}

/// What must be shown of `value` where `format` writes it: zero has no sign.
template <class... Arguments>
double shown(double value, const char* format, Arguments... arguments) {
  return std::strtod(by_printf(format, arguments..., value).c_str(), nullptr) == 0.0 ? 0.0 : value;
}

// The C library is the judge: the test program itself runs in the C locale.
TEST(Printed, IsWhatPrintfWrites) {
  std::mt19937_64 random(20261122);
  for (int i = 0; i < 4000; ++i) {
    const double exponent = std::uniform_real_distribution<>(-12.0, 15.0)(random);
    const double value = (random() % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent);
    const double round = std::round(value * 4.0) / 4.0;  // ties
    const int precision = static_cast<int>(random() % 9);
    for (const double x : {value, round}) {
      EXPECT_EQ(printed("%.*f", precision, x), by_printf("%.*f", precision, shown(x, "%.*f", precision)));
      EXPECT_EQ(printed("%.*g", precision, x), by_printf("%.*g", precision, shown(x, "%.*g", precision)));
      EXPECT_EQ(printed("%+12.3e|%-14g|%014.4f", x, x, x),
                by_printf("%+12.3e|%-14g|%014.4f", shown(x, "%.3e"), shown(x, "%g"), shown(x, "%.4f")));
    }
  }
  for (const double x : {0.0, 0.5, 1.5, 2.5, 1e300, 5e-324, HUGE_VAL, -HUGE_VAL})
    EXPECT_EQ(printed("%f %e %g %8.1f %+g", x, x, x, x, x), by_printf("%f %e %g %8.1f %+g", x, x, x, x, x));
}

TEST(Printed, WordsAndWholeNumbers) {
  const std::string word = "ring1";
  EXPECT_EQ(printed("%-8s|%8s|%.2s|%c|100 %%", word.c_str(), word.c_str(), word.c_str(), 'x'),
            "ring1   |   ring1|ri|x|100 %");
  EXPECT_EQ(printed("%d|%+4d|%-4d|%04d|%02ld|%zu|%14lld|%u", -3, 7, 7, -7, 5L, std::size_t{12}, -9000000000LL, 4000000000U),
            by_printf("%d|%+4d|%-4d|%04d|%02ld|%zu|%14lld|%u", -3, 7, 7, -7, 5L, std::size_t{12}, -9000000000LL, 4000000000U));
}

TEST(Printed, ZeroHasNoSignHoweverItIsRounded) {
  EXPECT_EQ(printed("%f|%g|%.1e|%5.1f|%+.1f|%06.2f", -0.0, -0.0, -0.0, -0.04, -0.04, -0.001),
            "0.000000|0|0.0e+00|  0.0|+0.0|000.00");
  EXPECT_EQ(printed("%.1f|%.2f", -0.06, -0.04), "-0.1|-0.04");
}

TEST(PrintedNumber, NeverMinusZero) {
  EXPECT_EQ(printed_number(-0.0), "0.00");
  EXPECT_EQ(printed_number(-0.004), "0.00");
  EXPECT_EQ(printed_number(-1.239), "-1.24");
  EXPECT_EQ(printed_number(0.25, "%g"), "0.25");
}

TEST(TrimmedNumber, HasNoIdleZerosAndNoMinusZero) {
  EXPECT_EQ(trimmed_number(46.0), "46");
  EXPECT_EQ(trimmed_number(0.25), "0.25");
  EXPECT_EQ(trimmed_number(1e-9), "0");
  EXPECT_EQ(trimmed_number(-1e-9), "0");
  EXPECT_EQ(trimmed_number(2.678, 2), "2.68");
  EXPECT_EQ(trimmed_number(1200.0, 0), "1200");
}

TEST(Joined, PutsTheWordBetween) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"sun"}), "sun");
  EXPECT_EQ(joined({"sun", "", "ring"}, "; "), "sun; ; ring");
}

}  // namespace
}  // namespace trueflank
