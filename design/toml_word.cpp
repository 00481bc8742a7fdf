// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a word without quotes stands for: true, false, a number, a date or a time.
#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "trueflank/design/toml_lexer.h"

namespace trueflank {
namespace {


/// Digits with single underscores between them, which are left out; nothing where it is not that.
template <class IsDigit>
std::optional<std::string> digits(std::string_view text, IsDigit is_one) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool between = i > 0 && i + 1 < text.size() && is_one(text[i - 1]) && is_one(text[i + 1]);
    if (is_one(text[i]))
      result += text[i];
    else if (text[i] != '_' || !between)
      return std::nullopt;
  }
  return result.empty() ? std::nullopt : std::optional(result);
}

Error no_value(std::string message, const std::string& remedy = "") {
  const char* usual = "a number such as 1.5, true, false, or text in quotes";
  return {.code = ErrorCode::kSyntax,
          .message = std::move(message),
          .remedy = remedy.empty() ? usual : remedy};
}

Result<TomlValue> whole_number(const std::string& text, int base, bool negative) {
  std::int64_t value = 0;
  const std::string number = negative ? "-" + text : text;
  const auto end = number.data() + number.size();
  const auto result = std::from_chars(number.data(), end, value, base);
  if (result.ec != std::errc()) return fail(no_value("a whole number of more than 64 bits"));
  return TomlValue(value);
}

std::optional<Result<TomlValue>> with_prefix(std::string_view word) {
  if (word.size() < 3 || word[0] != '0') return std::nullopt;
  const int base = word[1] == 'x' ? 16 : word[1] == 'o' ? 8 : word[1] == 'b' ? 2 : 0;
  if (base == 0) return std::nullopt;
  const auto found = digits(word.substr(2), [base](char c) {
    const char small = static_cast<char>(c | 0x20);
    const int value = is_digit(c) ? c - '0' : small >= 'a' && small <= 'f' ? small - 'a' + 10 : 99;
    return value < base;
  });
  if (!found) return fail(no_value("a number with a wrong digit"));
  return whole_number(*found, base, false);
}

/// [digits][.digits][e[+-]digits], no leading zeros.
std::optional<Result<TomlValue>> decimal(std::string_view unsigned_word, bool negative) {
  std::string_view rest = unsigned_word;
  const std::string_view before = rest.substr(0, rest.find_first_of(".eE"));
  rest.remove_prefix(before.size());
  const auto whole = digits(before, is_digit);
  if (!whole || (whole->size() > 1 && whole->front() == '0')) return std::nullopt;
  if (rest.empty()) return whole_number(*whole, 10, negative);
  std::string number = (negative ? "-" : "") + *whole;
  if (rest.front() == '.') {
    const std::string_view behind = rest.substr(1, rest.find_first_of("eE") - 1);
    rest.remove_prefix(1 + behind.size());
    const auto fraction = digits(behind, is_digit);
    if (!fraction) return std::nullopt;
    number += "." + *fraction;
  }
  if (!rest.empty()) {
    rest.remove_prefix(1);
    number += "e";
    if (rest.starts_with('-')) number += "-";
    if (rest.starts_with('-') || rest.starts_with('+')) rest.remove_prefix(1);
    const auto exponent = digits(rest, is_digit);
    if (!exponent) return std::nullopt;
    number += *exponent;
  }
  double value = 0.0;
  const auto result = std::from_chars(number.data(), number.data() + number.size(), value);
  if (result.ec != std::errc()) return fail(no_value("a number beyond what doubles can hold"));
  return Result<TomlValue>(TomlValue(value));
}

/// Two digits at `i` within bounds.
bool two_digits(std::string_view text, std::size_t i, int lower, int upper) {
  if (i + 2 > text.size() || !is_digit(text[i]) || !is_digit(text[i + 1])) return false;
  const int value = 10 * (text[i] - '0') + text[i + 1] - '0';
  return value >= lower && value <= upper;
}

bool is_date(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  for (std::size_t i = 0; i < 4; ++i)
    if (!is_digit(text[i])) return false;
  const auto number = [&](std::size_t i) { return 10 * (text[i] - '0') + text[i + 1] - '0'; };
  if (!two_digits(text, 5, 1, 12)) return false;
  const int year = 100 * number(0) + number(2), month = number(5);
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  const int days[] = {31, leap ? 29 : 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return two_digits(text, 8, 1, days[month - 1]);
}

/// hh:mm:ss[.digits]; what follows is left in `text`.
bool takes_time(std::string_view& text) {
  if (!two_digits(text, 0, 0, 23) || !two_digits(text, 3, 0, 59) || !two_digits(text, 6, 0, 60) ||
      text[2] != ':' || text[5] != ':')
    return false;
  text.remove_prefix(8);
  if (!text.starts_with('.')) return true;
  text.remove_prefix(1);
  const auto end = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(end);
  return end > 0;
}

bool is_offset(std::string_view text) {
  if (text.empty() || text == "Z" || text == "z") return true;
  return text.size() == 6 && (text[0] == '+' || text[0] == '-') && text[3] == ':' &&
         two_digits(text, 1, 0, 23) && two_digits(text, 4, 0, 59);
}

bool is_date_or_time(std::string_view word) {
  if (is_date(word)) return true;
  std::string_view rest = word;
  if (word.size() > 11 && is_date(word.substr(0, 10)) &&
      std::string_view("Tt ").find(word[10]) != std::string_view::npos) {
    rest.remove_prefix(11);
    return takes_time(rest) && is_offset(rest);
  }
  return takes_time(rest) && rest.empty();
}

}  // namespace

Result<TomlValue> toml_word_value(std::string_view word) {
  if (word.empty()) return fail(no_value("a value is missing"));
  if (word == "true" || word == "false") return TomlValue(word == "true");
  const bool negative = word.front() == '-';
  const std::string_view number = word.substr(negative || word.front() == '+' ? 1 : 0);
  if (number == "inf" || number == "nan") {
    const double value = number == "inf" ? std::numeric_limits<double>::infinity()
                                         : std::numeric_limits<double>::quiet_NaN();
    return TomlValue(negative ? -value : value);
  }
  if (const auto value = with_prefix(word)) return *value;
  if (const auto value = decimal(number, negative)) return *value;
  if (is_date_or_time(word)) return TomlValue(TomlOther{"a date or time"});
  return fail(no_value("neither a number nor text in quotes",
                       "a number such as 1.5, or text in quotes: " +
                           toml_string(shortened_text(word))));
}

}  // namespace trueflank
