// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <limits>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

/// What stands between % and the letter.
struct Directive {
  bool left = false, plus = false, zeros = false;
  int width = 0, precision = -1;
  int longs = 0;  ///< l: 1, ll and z: 2
};

/// Reads it; `at` then stands on the letter.
Directive directive(const char*& at, va_list& arguments) {
  Directive d;
  for (;; ++at) {
    if (*at == '-') d.left = true;
    else if (*at == '+') d.plus = true;
    else if (*at == '0') d.zeros = true;
    else break;
  }
  const auto count = [&] {
    if (*at == '*') {
      ++at;
      return va_arg(arguments, int);
    }
    int n = 0;
    for (; *at >= '0' && *at <= '9'; ++at) n = 10 * n + (*at - '0');
    return n;
  };
  d.width = count();
  if (*at == '.') {
    ++at;
    d.precision = count();
  }
  for (; *at == 'l' || *at == 'z'; ++at) d.longs += *at == 'z' ? 2 : 1;
  return d;
}

void append_padded(std::string& text, const Directive& d, std::string word, bool is_number) {
  const auto width = static_cast<std::size_t>(std::max(0, d.width));
  if (word.size() < width) {
    const std::size_t missing = width - word.size();
    if (d.left) word.append(missing, ' ');
    else if (d.zeros && is_number) word.insert(word.front() == '-' || word.front() == '+' ? 1 : 0, missing, '0');
    else word.insert(0, missing, ' ');
  }
  text += word;
}

template <class... Arguments>
std::string signed_text(const Directive& d, bool negative, Arguments... arguments) {
  std::array<char, 400> room;  // the largest double has 309 digits before the point
  const auto end = std::to_chars(room.data(), room.data() + room.size(), arguments...);
  TRUEFLANK_EXPECTS(end.ec == std::errc());
  return (d.plus && !negative ? "+" : "") + std::string(room.data(), end.ptr);
}

std::string real_text(const Directive& d, char letter, double value) {
  const std::chars_format form = letter == 'f'   ? std::chars_format::fixed
                                 : letter == 'e' ? std::chars_format::scientific
                                                 : std::chars_format::general;
  const int precision = d.precision < 0 ? 6 : d.precision;
  std::string text = signed_text(d, std::signbit(value), value, form, precision);
  const bool is_zero = text.substr(0, text.find('e')).find_first_not_of("-0.") == std::string::npos;
  return is_zero && std::signbit(value) ? signed_text(d, false, 0.0, form, precision) : text;
}

long long signed_argument(const Directive& d, va_list& arguments) {
  if (d.longs == 0) return va_arg(arguments, int);
  return d.longs == 1 ? va_arg(arguments, long) : va_arg(arguments, long long);
}
unsigned long long unsigned_argument(const Directive& d, va_list& arguments) {
  if (d.longs == 0) return va_arg(arguments, unsigned);
  return d.longs == 1 ? va_arg(arguments, unsigned long) : va_arg(arguments, unsigned long long);
}

}  // namespace

std::string printed(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::string text;
  for (const char* at = format; *at != '\0'; ++at) {
    if (*at != '%') {
      text += *at;
      continue;
    }
    ++at;
    Directive d = directive(at, arguments);
    switch (*at) {
      case '%': text += '%'; break;
      case 'c': append_padded(text, d, std::string(1, static_cast<char>(va_arg(arguments, int))), false); break;
      case 's': {
        const std::string_view word = va_arg(arguments, const char*);
        append_padded(text, d,
                      std::string(word.substr(0, d.precision < 0 ? word.size() : static_cast<std::size_t>(d.precision))),
                      false);
        break;
      }
      case 'd':
      case 'i': {
        const long long value = signed_argument(d, arguments);
        append_padded(text, d, signed_text(d, value < 0, value), true);
        break;
      }
      case 'u':
        append_padded(text, d, signed_text({}, false, unsigned_argument(d, arguments)), true);
        break;
      case 'f':
      case 'e':
      case 'g': {
        const double value = va_arg(arguments, double);
        append_padded(text, d, real_text(d, *at, value), std::isfinite(value));
        break;
      }
      default: TRUEFLANK_EXPECTS(false && "a letter that printed() knows");
    }
  }
  va_end(arguments);
  return text;
}

std::string printed_number(double value, const char* format) {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
#pragma GCC diagnostic ignored "-Wformat-security"
  return printed(format, value);
#pragma GCC diagnostic pop
}

std::string trimmed_number(double value, int decimals) {
  std::string text = printed("%.*f", decimals, value);
  if (decimals > 0 && std::isfinite(value)) text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string whole_um(double length_mm) { return std::to_string(std::lround(um_from_mm(length_mm))) + " um"; }

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) {
    if (&word != &words.front()) text += between;
    text += word;
  }
  return text;
}

}  // namespace trueflank
