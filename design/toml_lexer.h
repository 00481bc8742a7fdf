// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "trueflank/design/toml_document.h"

namespace trueflank {

/// UTF-8 without NUL bytes? Errors: kSyntax with the line.
[[nodiscard]] Status check_text_encoding(std::string_view text);

[[nodiscard]] constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Walks through a TOML text: characters, comments, strings and bare words.
/// Requires: check_text_encoding holds. Errors (of all functions): kSyntax with line and remedy.
class TomlLexer {
 public:
  explicit TomlLexer(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return position_ >= text_.size(); }
  /// At a newline (\n or \r\n) or at the end.
  [[nodiscard]] bool at_line_end() const;
  /// The next character; NUL at the end.
  [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[position_]; }
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::string_view rest_of_line() const;

  void advance();
  [[nodiscard]] bool take(char c);
  void skip_blanks();
  void skip_line();
  /// Blanks and a comment, then the line must end.
  [[nodiscard]] Status end_line();
  /// Blanks, comments and newlines, as they may stand in an array.
  [[nodiscard]] Status skip_blank_lines();

  /// One part of a dotted key, bare or quoted.
  [[nodiscard]] Result<std::string> key_part();
  /// A string of any of the four kinds; the next character is its quote.
  [[nodiscard]] Result<std::string> string();
  /// A word of a value without quotes, dates with a blank before their time included; may be empty.
  [[nodiscard]] std::string_view word();

  [[nodiscard]] Error error(std::string message, std::string remedy) const;

 private:
  [[nodiscard]] bool next_are(std::string_view characters) const;
  [[nodiscard]] Status comment();
  [[nodiscard]] Status string_character(std::string& result, bool basic, bool multi_line);
  [[nodiscard]] Status escape(std::string& result, bool multi_line);
  [[nodiscard]] Status code_point(std::string& result, int digits);

  std::string_view text_;
  std::size_t position_ = 0;
  int line_ = 1;
};

/// A bare word as the value it is. Errors: kSyntax without line where it is none.
[[nodiscard]] Result<TomlValue> toml_word_value(std::string_view word);

}  // namespace trueflank
