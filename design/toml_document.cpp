// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/toml_document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

namespace trueflank {
namespace {

/// Control characters from U+0080 on take two bytes; terminals obey them as well.
bool is_upper_control(std::string_view text, std::size_t i) {
  if (text[i] != '\xC2' || i + 1 == text.size()) return false;
  const auto next = static_cast<unsigned char>(text[i + 1]);
  return next >= 0x80 && next < 0xA0;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

}  // namespace

const TomlEntry* TomlTable::find(std::string_view key) const {
  const auto it = std::find_if(entries.begin(), entries.end(),
                               [&](const TomlEntry& entry) { return entry.key == key; });
  return it == entries.end() ? nullptr : &*it;
}

TomlEntry* TomlTable::find(std::string_view key) {
  return const_cast<TomlEntry*>(std::as_const(*this).find(key));
}

std::string shortened_text(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_upper_control(text, i))
      ++i;
    else if (!is_control(text[i]))
      result += text[i];
  }
  constexpr std::size_t kLongest = 60;
  if (result.size() <= kLongest) return result;
  std::size_t end = kLongest - 3;
  while (end > 0 && (static_cast<unsigned char>(result[end]) & 0xC0) == 0x80) --end;
  return result.substr(0, end) + "...";
}

std::string toml_string(std::string_view text) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string result = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool upper = is_upper_control(text, i);
    if (text[i] == '"' || text[i] == '\\') {
      result += '\\';
      result += text[i];
    } else if (upper || is_control(text[i])) {
      const auto byte = static_cast<unsigned char>(upper ? text[++i] : text[i]);
      result += "\\u00";
      result += kHex[byte >> 4];
      result += kHex[byte & 15];
    } else {
      result += text[i];
    }
  }
  return result + '"';
}

std::string toml_number(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
  std::string result(buffer, end);
  if (result.find_first_of(".e") == std::string::npos) result += ".0";
  return result;
}

std::string quoted_toml(const TomlValue& value) {
  const auto text = [](const auto& v) -> std::string {
    using Value = std::decay_t<decltype(v)>;
    if constexpr (std::is_same_v<Value, bool>) return v ? "true" : "false";
    if constexpr (std::is_same_v<Value, std::int64_t>) return std::to_string(v);
    if constexpr (std::is_same_v<Value, double>) return toml_number(v);
    if constexpr (std::is_same_v<Value, std::string>) return toml_string(v);
    if constexpr (std::is_same_v<Value, TomlTable>) return "a table";
    if constexpr (std::is_same_v<Value, TomlOther>) return v.kind;
    if constexpr (std::is_same_v<Value, TomlUnreadable>) return "";
  };
  return shortened_text(std::visit(text, value));
}

}  // namespace trueflank
