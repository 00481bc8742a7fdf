// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/ascii_letters.h"

#include <gtest/gtest.h>

namespace trueflank::test {
namespace {

TEST(AsciiLetters, AreThoseOfTheAlphabetAndNoOtherByte) {
  const std::string_view small = "abcdefghijklmnopqrstuvwxyz",
                         capital = "ABCDEFGHIJKLMNOPQRSTUVWXYZ", digits = "0123456789";
  for (int byte = 0; byte < 256; ++byte) {
    const auto c = static_cast<char>(byte);
    const std::size_t as_small_at = small.find(c), as_capital_at = capital.find(c);
    const bool is_one = as_small_at != small.npos, is_other = as_capital_at != capital.npos;
    EXPECT_EQ(is_small(c), is_one) << byte;
    EXPECT_EQ(is_capital(c), is_other) << byte;
    EXPECT_EQ(is_letter(c), is_one || is_other) << byte;
    EXPECT_EQ(is_digit(c), digits.find(c) != digits.npos) << byte;
    EXPECT_EQ(as_small(c), is_other ? small[as_capital_at] : c) << byte;
    EXPECT_EQ(as_capital(c), is_one ? capital[as_small_at] : c) << byte;
  }
}

TEST(AsciiLetters, LeaveOtherLettersWhole) {
  EXPECT_EQ(lowered("DEVIATION [µm] Ä"), "deviation [µm] Ä");
  EXPECT_EQ(capitalised("the lid"), "The lid");
  EXPECT_EQ(capitalised("ähnlich"), "ähnlich");
  EXPECT_EQ(capitalised(""), "");
}

}  // namespace
}  // namespace trueflank::test
