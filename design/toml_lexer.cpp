// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/toml_lexer.h"

#include <algorithm>
#include <cstdint>

namespace trueflank {
namespace {


bool is_key_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_' || c == '-';
}

/// Allowed in comments and strings: all but control characters; the tab is none of those.
bool is_text(char c) { return (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) || c == '\t'; }

void append_utf8(std::string& result, std::uint32_t code) {
  const auto byte = [&](std::uint32_t bits) { result += static_cast<char>(bits); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | (code >> 6));
    byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | (code >> 12));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | (code >> 18));
    byte(0x80 | ((code >> 12) & 0x3F));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  }
}

}  // namespace

Error TomlLexer::error(std::string message, std::string remedy) const {
  return {.code = ErrorCode::kSyntax,
          .message = std::move(message),
          .remedy = std::move(remedy),
          .line = line_};
}

bool TomlLexer::next_are(std::string_view characters) const {
  return text_.substr(position_).starts_with(characters);
}

bool TomlLexer::at_line_end() const { return at_end() || peek() == '\n' || next_are("\r\n"); }

std::string_view TomlLexer::rest_of_line() const {
  const std::string_view rest = text_.substr(position_);
  return rest.substr(0, rest.find_first_of("\r\n"));
}

void TomlLexer::advance() {
  if (peek() == '\n') ++line_;
  ++position_;
}

bool TomlLexer::take(char c) {
  if (at_end() || peek() != c) return false;
  advance();
  return true;
}

void TomlLexer::skip_blanks() {
  while (peek() == ' ' || peek() == '\t') advance();
}

void TomlLexer::skip_line() {
  while (!at_end() && peek() != '\n') advance();
  if (!at_end()) advance();
}

Status TomlLexer::comment() {
  while (!at_line_end()) {
    if (!is_text(peek()))
      return fail(error("a control character in a comment", "printable text"));
    advance();
  }
  return {};
}

Status TomlLexer::end_line() {
  skip_blanks();
  if (peek() == '#')
    if (auto status = comment(); !status) return status;
  if (!at_line_end())
    return fail(error("more than one value",
                      "one value a line: a decimal point, no unit, text in quotes"));
  if (peek() == '\r') advance();
  if (!at_end()) advance();
  return {};
}

Status TomlLexer::skip_blank_lines() {
  for (;;) {
    skip_blanks();
    if (peek() == '#') {
      if (auto status = comment(); !status) return status;
    } else if (at_end() || !at_line_end()) {
      return {};
    } else {
      if (peek() == '\r') advance();
      advance();
    }
  }
}

Result<std::string> TomlLexer::key_part() {
  if (next_are("\"\"\"") || next_are("'''"))
    return fail(error("a key in three quotes", "a key of letters, digits and _"));
  if (peek() == '"' || peek() == '\'') return string();
  const std::size_t begin = position_;
  while (!at_end() && is_key_letter(peek())) advance();
  if (static_cast<unsigned char>(peek()) >= 0x80)
    return fail(error("a letter beyond ASCII outside of strings and comments",
                      "keys of the letters a-z, digits and _; text in quotes"));
  if (position_ > begin) return std::string(text_.substr(begin, position_ - begin));
  return fail(error("a key or a table's name is missing", "key = value, or [table]"));
}

Result<std::string> TomlLexer::string() {
  const char quote = peek();
  const std::string three(3, quote);
  const bool multi_line = next_are(three), basic = quote == '"';
  const Error open = error("text whose closing quote is missing",
                           std::string("a closing ") + (multi_line ? three : three.substr(2)));
  for (int i = 0; i < (multi_line ? 3 : 1); ++i) advance();
  if (multi_line && at_line_end() && !at_end()) {
    if (peek() == '\r') advance();
    advance();
  }
  std::string result;
  for (;;) {
    if (at_end() || (!multi_line && at_line_end())) return fail(open);
    if (!multi_line && take(quote)) return result;
    if (multi_line && next_are(three)) {
      for (int i = 0; i < 3; ++i) advance();
      // up to two quotes more belong to the text
      for (int i = 0; i < 2 && take(quote); ++i) result += quote;
      return result;
    }
    if (auto status = string_character(result, basic, multi_line); !status)
      return fail(status.error());
  }
}

Status TomlLexer::string_character(std::string& result, bool basic, bool multi_line) {
  if (basic && peek() == '\\') return escape(result, multi_line);
  if (multi_line && at_line_end()) {
    if (peek() == '\r') advance();
  } else if (!is_text(peek())) {
    return fail(error("a control character in text", "an escape such as \\t or \\u0007"));
  }
  result += peek();
  advance();
  return {};
}

Status TomlLexer::escape(std::string& result, bool multi_line) {
  advance();
  const char c = peek();
  constexpr std::string_view kNames = "btnfr\"\\", kMeant = "\b\t\n\f\r\"\\";
  if (const auto i = kNames.find(c); !at_end() && i != std::string_view::npos) {
    result += kMeant[i];
    advance();
    return {};
  }
  if (c == 'u' || c == 'U') {
    advance();
    return code_point(result, c == 'u' ? 4 : 8);
  }
  // a backslash at the end of a line swallows all white space up to the next character
  if (multi_line) {
    TomlLexer ahead = *this;
    ahead.skip_blanks();
    if (!ahead.at_end() && ahead.at_line_end()) {
      *this = ahead;
      while (!at_end() && (peek() == ' ' || peek() == '\t' || at_line_end())) advance();
      return {};
    }
  }
  return fail(
      error("an escape that TOML does not know", "\\\\ for a backslash, or 'text' as it is"));
}

Status TomlLexer::code_point(std::string& result, int digits) {
  std::uint32_t code = 0;
  for (int i = 0; i < digits; ++i) {
    const char c = peek();
    const bool small = c >= 'a' && c <= 'f', large = c >= 'A' && c <= 'F';
    if (!is_digit(c) && !small && !large)
      return fail(error("an escape with too few hexadecimal digits", "\\u0041 or \\U00000041"));
    code = code * 16 + static_cast<std::uint32_t>(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
    advance();
  }
  if (code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF))
    return fail(error("an escape for no character of Unicode", "\\u0041 or \\U00000041"));
  append_utf8(result, code);
  return {};
}

std::string_view TomlLexer::word() {
  const std::size_t begin = position_;
  const auto run = [&] {
    constexpr std::string_view kEnds = " \t#,]}[{=\"'";
    while (!at_line_end() && kEnds.find(peek()) == std::string_view::npos) advance();
  };
  run();
  // 1979-05-27 07:32:00
  const std::string_view rest = text_.substr(position_);
  const std::string_view date = text_.substr(begin, position_ - begin);
  if (date.size() == 10 && date[4] == '-' && rest.size() > 3 && rest[0] == ' ' &&
      is_digit(rest[1]) && is_digit(rest[2]) && rest[3] == ':') {
    advance();
    run();
  }
  return text_.substr(begin, position_ - begin);
}

}  // namespace trueflank
