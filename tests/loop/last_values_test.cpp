// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/last_values.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace trueflank::loop {
namespace {

TEST(LastRows, TwoEffectsThatAreAskedInTurnAreWorkedOutOnceEach) {
  LastRows<char> last;
  int worked_out = 0;
  const auto rows_of = [&](double figure) {
    return last.of(std::array{figure, 1.0}, [&] {
      ++worked_out;
      return std::vector<char>{figure > 0.0 ? char{1} : char{0}};
    });
  };
  for (int row = 0; row < 100; ++row) {
    EXPECT_EQ(rows_of(-1.0), std::vector<char>{0});
    EXPECT_EQ(rows_of(2.0), std::vector<char>{1});
  }
  EXPECT_EQ(worked_out, 2);
}

TEST(LastRows, OthersTakeThePlaceOfTheOldest) {
  LastRows<char> last;
  int worked_out = 0;
  for (int figure = 0; figure < 20; ++figure)
    EXPECT_EQ(last.of(std::array{1.0 * figure},
                      [&] {
                        ++worked_out;
                        return std::vector<char>(3, static_cast<char>(figure));
                      }),
              std::vector<char>(3, static_cast<char>(figure)));
  EXPECT_EQ(worked_out, 20);
}

TEST(LastValues, AValueIsWorkedOutOnce) {
  LastValues last;
  int worked_out = 0;
  for (int row = 0; row < 100; ++row)
    EXPECT_EQ(last.at(row % 3,
                      [&](double x) {
                        ++worked_out;
                        return 2.0 * x;
                      }),
              2.0 * (row % 3));
  EXPECT_EQ(worked_out, 3);
}

}  // namespace
}  // namespace trueflank::loop
