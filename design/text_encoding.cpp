// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/design/toml_lexer.h"

namespace trueflank {
namespace {

/// Bytes of the UTF-8 sequence at `position`; 0 where it is none (too long a form, surrogates and
/// numbers beyond Unicode included).
std::size_t utf8_length(std::string_view text, std::size_t position) {
  const auto byte = [&](std::size_t i) {
    return position + i < text.size() ? static_cast<unsigned char>(text[position + i]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  const unsigned second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

}  // namespace

Status check_text_encoding(std::string_view text) {
  const auto wrong = [&](std::size_t position, const char* message) {
    const auto newlines = std::count(text.begin(), text.begin() + position, '\n');
    return fail({.code = ErrorCode::kSyntax,
                 .message = message,
                 .remedy = "a TOML file, saved as UTF-8 text",
                 .line = 1 + static_cast<int>(newlines)});
  };
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return wrong(0, "the file is UTF-16 text");
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\0') return wrong(i, "the file holds a NUL byte: it is no text");
    const std::size_t length = utf8_length(text, i);
    if (length == 0) return wrong(i, "the file is not UTF-8 text");
    i += length;
  }
  return {};
}

}  // namespace trueflank
