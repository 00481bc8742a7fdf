// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/fixed_text.h"

#include <array>
#include <charconv>

namespace trueflank {
namespace {

std::string text_of(double value, std::chars_format format, int precision) {
  std::array<char, 512> digits;  // the largest double in fixed notation has 309 before the point
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, format, precision).ptr;
  return {digits.data(), end};
}

}  // namespace

std::string fixed_text(double value, int decimals) {
  return text_of(value, std::chars_format::fixed, decimals);
}

std::string signed_text(double value, int decimals) {
  const std::string text = fixed_text(value, decimals);
  return text.starts_with('-') ? text : "+" + text;
}

std::string general_text(double value, int digits) {
  return text_of(value, std::chars_format::general, digits);
}

std::string right_aligned(const std::string& text, std::size_t width) {
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

std::string left_aligned(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

}  // namespace trueflank
