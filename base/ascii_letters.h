// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

// Letters and digits of names, keys and columns: the same in every locale that a host program may
// have set. In Turkey std::tolower() leaves an 'I' as it is, and where a letter is one byte it
// changes halves of UTF-8 letters.
namespace trueflank {

[[nodiscard]] constexpr bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
[[nodiscard]] constexpr bool is_small(char c) { return c >= 'a' && c <= 'z'; }
[[nodiscard]] constexpr bool is_letter(char c) { return is_capital(c) || is_small(c); }
[[nodiscard]] constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

[[nodiscard]] constexpr char as_small(char c) {
  return is_capital(c) ? static_cast<char>(c - 'A' + 'a') : c;
}
[[nodiscard]] constexpr char as_capital(char c) {
  return is_small(c) ? static_cast<char>(c - 'a' + 'A') : c;
}

/// With small letters alone: "Taper [µm]" -> "taper [µm]".
[[nodiscard]] inline std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = as_small(c);
  return result;
}

/// As a sentence begins: "the lid" -> "The lid".
[[nodiscard]] inline std::string capitalised(std::string text) {
  if (!text.empty()) text.front() = as_capital(text.front());
  return text;
}

}  // namespace trueflank
