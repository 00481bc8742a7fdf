// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/step_entities.h"

#include <algorithm>
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

}  // namespace

StepId StepEntities::begin(std::string_view opening) {
  text_ += '#';
  append_integer(text_, ++last_);
  text_ += '=';
  text_ += opening;
  return last_;
}

StepId StepEntities::add(std::string_view opening, std::string_view arguments) {
  const StepId id = begin(opening);
  text_ += arguments;
  end();
  return id;
}

StepEntities& StepEntities::put(std::string_view text) {
  text_ += text;
  return *this;
}

StepEntities& StepEntities::put(StepId id) {
  text_ += '#';
  append_integer(text_, id);
  return *this;
}

StepEntities& StepEntities::put(const std::vector<StepId>& ids) {
  char separator = '(';
  for (const StepId id : ids) {
    text_ += separator;
    put(id);
    separator = ',';
  }
  text_ += ')';
  return *this;
}

StepEntities& StepEntities::put_integer(int number) {
  append_integer(text_, number);
  return *this;
}

StepEntities& StepEntities::put_integers(const std::vector<int>& numbers) {
  char separator = '(';
  for (const int number : numbers) {
    text_ += separator;
    append_integer(text_, number);
    separator = ',';
  }
  text_ += ')';
  return *this;
}

StepEntities& StepEntities::put_reals(const std::vector<double>& numbers) {
  char separator = '(';
  for (const double number : numbers) {
    text_ += separator;
    put(number);
    separator = ',';
  }
  text_ += ')';
  return *this;
}

StepEntities& StepEntities::put(double number) {
  const std::size_t start = text_.size();
  append_shortest(text_, number == 0.0 ? 0.0 : number);  // no negative zero
  const std::size_t exponent = text_.find('e', start);
  if (exponent != std::string::npos) text_[exponent] = 'E';
  if (text_.find('.', start) == std::string::npos)
    text_.insert(std::min(exponent, text_.size()), 1, '.');
  return *this;
}

StepEntities& StepEntities::put_coordinate(double value_mm) {
  constexpr double kPerMillimetre = 1e10;
  const double steps = value_mm * kPerMillimetre;
  // beyond 2^53 steps doubles are coarser than the step
  if (std::abs(steps) > 9e15) return put(value_mm);
  return put(std::round(steps) / kPerMillimetre);
}

StepEntities& StepEntities::put_quoted(std::string_view utf8) {
  text_ += '\'';
  for (std::size_t at = 0; at < utf8.size();) {
    const std::uint32_t character = next_character(utf8, at);
    if (character == '\'' || character == '\\') text_ += static_cast<char>(character);
    if (character >= 0x20U && character < 0x7FU)
      text_ += static_cast<char>(character);
    else
      append_encoded(text_, character);
  }
  text_ += '\'';
  return *this;
}

}  // namespace trueflank::io
