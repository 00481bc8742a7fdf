// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/step/step_entities.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "trueflank/export/number_text.h"

namespace trueflank::io {
namespace {

/// A character as ISO 10303-21 spells it: four hexadecimal digits where that is enough.
void append_encoded(std::string& text, std::uint32_t character) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  const bool wide = character > 0xFFFFU;
  text += wide ? "\\X4\\" : "\\X2\\";
  for (int shift = wide ? 28 : 12; shift >= 0; shift -= 4)
    text += kDigits[(character >> shift) & 15U];
  text += "\\X0\\";
}

/// One character of UTF-8, moving on past it; what is not UTF-8 becomes U+FFFD.
std::uint32_t next_character(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const std::uint32_t first = byte(at++);
  if (first < 0x80U) return first;
  const int more = first >= 0xF0U ? 3 : first >= 0xE0U ? 2 : first >= 0xC0U ? 1 : 0;
  if (more == 0 || first >= 0xF8U) return 0xFFFDU;
  std::uint32_t character = first & (0x3FU >> more);
  for (int i = 0; i < more; ++i) {
    if ((byte(at) & 0xC0U) != 0x80U) return 0xFFFDU;
    character = (character << 6U) | (byte(at++) & 0x3FU);
  }
  return character;
}

/// Ten decimals less the zeros at their end.
char* put_fraction(char* at, std::uint64_t fraction) {
  const auto first = static_cast<std::uint32_t>(fraction / 100'000U);
  const auto last = static_cast<std::uint32_t>(fraction % 100'000U);
  const auto put_five = [](char* to, std::uint32_t five) {
    for (int i = 4; i >= 0; --i, five /= 10) to[i] = static_cast<char>('0' + five % 10);
  };
  put_five(at, first);
  char* end = at + 5;
  if (last != 0) {
    put_five(end, last);
    end += 5;
  }
  while (end[-1] == '0') --end;
  return end;
}

}  // namespace

void StepEntities::grow(std::size_t bytes) {
  constexpr std::size_t kLeast = 4096;
  text_.resize(size_ + std::max({bytes, size_, kLeast}));
}

std::string StepEntities::take() {
  text_.resize(size_);
  size_ = 0;
  return std::move(text_);
}

StepId StepEntities::begin(std::string_view opening) {
  char* at = room(opening.size() + kNumberRoom + 2);
  *at++ = '#';
  at = io::put_integer(at, static_cast<std::uint32_t>(++last_));
  *at++ = '=';
  ends_at(std::copy(opening.begin(), opening.end(), at));
  return last_;
}

StepId StepEntities::add(std::string_view opening, std::string_view arguments) {
  const StepId id = begin(opening);
  put(arguments).end();
  return id;
}

StepEntities& StepEntities::put(std::string_view text) {
  ends_at(std::copy(text.begin(), text.end(), room(text.size())));
  return *this;
}

StepEntities& StepEntities::put(StepId id) {
  char* at = room(kNumberRoom + 1);
  *at++ = '#';
  ends_at(io::put_integer(at, static_cast<std::uint32_t>(id)));
  return *this;
}

StepEntities& StepEntities::put(const std::vector<StepId>& ids) {
  char* at = room(ids.size() * (kNumberRoom + 2) + 2);
  char separator = '(';
  for (const StepId id : ids) {
    *at++ = separator;
    *at++ = '#';
    at = io::put_integer(at, static_cast<std::uint32_t>(id));
    separator = ',';
  }
  if (ids.empty()) *at++ = '(';
  *at++ = ')';
  ends_at(at);
  return *this;
}

StepEntities& StepEntities::put_integer(int number) {
  char* const at = room(kNumberRoom);
  ends_at(std::to_chars(at, at + kNumberRoom, number).ptr);
  return *this;
}

StepEntities& StepEntities::put_integers(const std::vector<int>& numbers) {
  char separator = '(';
  for (const int number : numbers) {
    put(std::string_view(&separator, 1)).put_integer(number);
    separator = ',';
  }
  return put(")");
}

StepEntities& StepEntities::put_reals(const std::vector<double>& numbers) {
  char separator = '(';
  for (const double number : numbers) {
    put(std::string_view(&separator, 1)).put(number);
    separator = ',';
  }
  return put(")");
}

StepEntities& StepEntities::put(double number) {
  char* const start = room(kNumberRoom + 1);
  // no negative zero
  char* end = std::to_chars(start, start + kNumberRoom, number == 0.0 ? 0.0 : number).ptr;
  char* const exponent = std::find(start, end, 'e');
  if (exponent != end) *exponent = 'E';
  if (std::find(start, end, '.') == end) {
    std::copy_backward(exponent, end, end + 1);
    *exponent = '.';
    ++end;
  }
  ends_at(end);
  return *this;
}

StepEntities& StepEntities::put_coordinate(double value_mm) {
  constexpr double kPerMillimetre = 1e10;
  const double steps = value_mm * kPerMillimetre;
  // beyond 2^53 steps doubles are coarser than the step
  if (std::abs(steps) > 9e15) return put(value_mm);
  const double whole = std::round(steps);
  // Decimals of 15 digits or less differ as doubles: the steps' own digits are the shortest that read back
  // the same. Without an exponent, as put() writes numbers of this size.
  constexpr double kLeastSteps = 1e7, kMostSteps = 1e14;
  const double size = std::abs(whole);
  if (size < kLeastSteps || size >= kMostSteps) return put(whole / kPerMillimetre);
  char* at = room(kNumberRoom);
  if (whole < 0.0) *at++ = '-';
  const auto count = static_cast<std::uint64_t>(size);
  at = io::put_integer(at, static_cast<std::uint32_t>(count / 10'000'000'000U));
  *at++ = '.';
  const std::uint64_t fraction = count % 10'000'000'000U;
  if (fraction != 0) at = put_fraction(at, fraction);
  ends_at(at);
  return *this;
}

StepEntities& StepEntities::put_quoted(std::string_view utf8) {
  std::string text(1, '\'');
  for (std::size_t at = 0; at < utf8.size();) {
    const std::uint32_t character = next_character(utf8, at);
    if (character == '\'' || character == '\\') text += static_cast<char>(character);
    if (character >= 0x20U && character < 0x7FU)
      text += static_cast<char>(character);
    else
      append_encoded(text, character);
  }
  text += '\'';
  return put(text);
}

}  // namespace trueflank::io
