// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one source that sees toml++.
#include "trueflank/design/toml_document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "trueflank/design/toml_text.h"

namespace trueflank {
namespace {

TomlTable converted(const toml::table& table);

TomlValue converted(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* string = node.as_string()) return string->get();
  if (const auto* table = node.as_table()) return converted(*table);
  return TomlOther{node.is_array() ? "an array" : "a date or time"};
}

TomlTable converted(const toml::table& table) {
  TomlTable result;
  for (const auto& [key, node] : table) {
    const auto line = key.source().begin ? key.source().begin.line : node.source().begin.line;
    result.entries.push_back(
        {.key = std::string(key.str()), .value = converted(node), .line = static_cast<int>(line)});
  }
  std::stable_sort(result.entries.begin(), result.entries.end(),
                   [](const TomlEntry& a, const TomlEntry& b) { return a.line < b.line; });
  return result;
}

/// What the parser says, as far as it is printable.
std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) result += c;
  return result;
}

std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

}  // namespace

const TomlEntry* TomlTable::find(std::string_view key) const {
  const auto it = std::find_if(entries.begin(), entries.end(),
                               [&](const TomlEntry& entry) { return entry.key == key; });
  return it == entries.end() ? nullptr : &*it;
}

Result<TomlTable> parse_toml(std::string_view text) {
  if (auto status = check_toml_text(text); !status) return fail(status.error());
  try {
    return converted(toml::parse(text));
  } catch (const toml::parse_error& error) {
    return fail({.code = ErrorCode::kSyntax,
                 .message = shortened(printable(error.description())),
                 .remedy = "TOML: key = value, one a line, text in quotes, tables as [name]",
                 .line = static_cast<int>(error.source().begin.line)});
  }
}

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      constexpr char kHex[] = "0123456789ABCDEF";
      result += "\\u00";
      result += kHex[byte >> 4];
      result += kHex[byte & 15];
    } else {
      result += c;
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
  };
  return shortened(std::visit(text, value));
}

}  // namespace trueflank
