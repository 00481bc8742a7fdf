// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/last_values.h"

#include <gtest/gtest.h>

#include <vector>

namespace trueflank::test {
namespace {

// A comparison of two thermostats asks both at every row: were only the last one kept, each row of
// a log would walk through the whole log twice.
TEST(LastRows, FiguresAskedByTurnsAreWorkedOutOnce) {
  loop::LastRows last;
  int worked_out = 0;
  const auto rows_of = [&](double figure) {
    return last.of({figure}, [&] {
      ++worked_out;
      return std::vector<char>(3, figure > 1.0 ? 1 : 0);
    });
  };
  for (int row = 0; row < 100; ++row) {
    EXPECT_EQ(rows_of(1.0), std::vector<char>(3, 0));
    EXPECT_EQ(rows_of(2.0), std::vector<char>(3, 1));
  }
  EXPECT_EQ(worked_out, 2);
}

TEST(LastRows, FiguresThatWereForgottenAreWorkedOutAnew) {
  loop::LastRows last;
  const auto rows_of = [&](int figure) {
    return last.of({double(figure)},
                   [&] { return std::vector<char>(2, static_cast<char>(figure)); });
  };
  for (const int figure : {1, 2, 3, 4, 5, 6, 7, 1, 6, 2})
    EXPECT_EQ(rows_of(figure), std::vector<char>(2, static_cast<char>(figure)));
}

TEST(LastValues, ArgumentsAskedByTurnsAreWorkedOutOnce) {
  loop::LastValues last;
  int worked_out = 0;
  for (int row = 0; row < 100; ++row)
    for (const double argument : {1.0, 2.0, 3.0}) {
      const double value = last.at(argument, [&](double x) {
        ++worked_out;
        return 10.0 * x;
      });
      EXPECT_EQ(value, 10.0 * argument);
    }
  EXPECT_EQ(worked_out, 3);
}

}  // namespace
}  // namespace trueflank::test
