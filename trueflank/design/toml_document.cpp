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

std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The key of a line and what the line gives it, as well as that can be told of wrong TOML.
struct Place {
  std::string key;
  std::string value;
};

Place place_at(std::string_view text, int line) {
  Place place;
  std::string table;
  for (int number = 1; number <= line && !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view row = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto equals = row.find('=');
    if (row.starts_with('[')) {
      table = trimmed(row.substr(1, row.find(']') - 1));
      place = {table, std::string(row)};
    } else if (equals == std::string_view::npos) {
      place = {table, std::string(row)};
    } else {
      const std::string key(trimmed(row.substr(0, equals)));
      place = {table.empty() ? key : table + "." + key, std::string(trimmed(row.substr(equals + 1)))};
    }
  }
  return place;
}

std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) result += c;
  return result;
}

Error syntax_error(std::string_view text, int line, std::string_view description) {
  Place place = place_at(text, line);
  const bool twice = description.find("redefine") != std::string_view::npos;
  return {.code = ErrorCode::kSyntax,
          .message = twice ? place.key + " is given twice" : printable(description),
          .key = shortened(printable(place.key)),
          .value = shortened(printable(place.value)),
          .remedy = twice ? "one of the two"
                          : "TOML: key = value, one a line, text in quotes, tables as [name]",
          .line = line};
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
    return fail(syntax_error(text, static_cast<int>(error.source().begin.line),
                             error.description()));
  }
}

std::string toml_string(std::string_view text) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string result = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0u;
    // control characters from U+0080 on take two bytes; terminals obey them as well
    const bool upper_control = byte == 0xC2 && next >= 0x80 && next < 0xA0;
    if (byte == '"' || byte == '\\') {
      result += '\\';
      result += text[i];
    } else if (byte < 0x20 || byte == 0x7F || upper_control) {
      if (upper_control) byte = static_cast<unsigned char>(text[++i]);
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
  };
  return shortened(std::visit(text, value));
}

}  // namespace trueflank
