// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/key_rule.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace trueflank {
namespace {

std::string type_name(const KeyRule& rule) {
  switch (rule.type) {
    case KeyType::kWholeList:
      return "a whole number, or several in quotes by commas, each";
    case KeyType::kWhole:
      return rule.lower == rule.upper ? "" : "a whole number";
    case KeyType::kNumber:
      return "a number";
    case KeyType::kText:
      return "text in quotes";
    case KeyType::kFlag:
      return "true or false";
    case KeyType::kChoice:
      break;
  }
  std::string list = rule.choices.size() == 1 ? "" : "one of ";
  for (std::size_t i = 0; i < rule.choices.size(); ++i)
    list += (i ? ", \"" : "\"") + std::string(rule.choices[i]) + '"';
  return list;
}

std::string range(const KeyRule& rule) {
  if (rule.type != KeyType::kWhole && rule.type != KeyType::kWholeList &&
      rule.type != KeyType::kNumber)
    return "";
  const bool below = std::isfinite(rule.lower), above = std::isfinite(rule.upper);
  if (rule.lower == rule.upper) return plain_number(rule.lower);
  if (below && above)
    return " from " + plain_number(rule.lower) + " to " + plain_number(rule.upper);
  if (below) return " of at least " + plain_number(rule.lower);
  if (above) return " of at most " + plain_number(rule.upper);
  return "";
}

Error wrong(ErrorCode code, const KeyRule& rule, const std::string& key, const TomlValue& value,
            std::string why) {
  return {.code = code,
          .message = std::move(why),
          .key = key,
          .value = quoted_toml(value),
          .remedy = wanted(rule)};
}

/// Letters to put in, leave out, change or swap with their neighbour; either case alike.
std::size_t letters_to_change(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  const auto differ = [&](std::size_t i, std::size_t j) { return lower(a[i]) != lower(b[j]); };
  std::vector<std::size_t> before, last, row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + differ(i, j), last[j + 1] + 1, row[j] + 1});
      if (i > 0 && j > 0 && !differ(i, j - 1) && !differ(i - 1, j))
        row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string plain_number(double number) {
  char buffer[400];
  const bool readable = std::abs(number) < 1e7 && (number == 0.0 || std::abs(number) >= 1e-4);
  const auto format = readable ? std::chars_format::fixed : std::chars_format::general;
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number, format).ptr};
}

std::string plain_mm(double length_mm) { return plain_number(std::round(length_mm * 1e4) / 1e4) + " mm"; }

std::string wanted(const KeyRule& rule) {
  std::string text = type_name(rule) + range(rule);
  const std::string unit = rule.unit;
  if (unit == "module") return text + ", times the module";
  return unit.empty() ? text : text + " " + unit;
}

Result<KeyValue> take_value(const KeyRule& rule, const std::string& key, const TomlValue& value) {
  const auto wrong_type = [&](std::string why) {
    return fail(wrong(ErrorCode::kWrongType, rule, key, value, std::move(why)));
  };
  const auto out_of_range = [&](std::string why) {
    return fail(wrong(ErrorCode::kOutOfRange, rule, key, value, std::move(why)));
  };
  const auto* whole = std::get_if<std::int64_t>(&value);
  const auto* text = std::get_if<std::string>(&value);
  switch (rule.type) {
    case KeyType::kFlag:
      if (const auto* flag = std::get_if<bool>(&value)) return KeyValue(*flag);
      return wrong_type("neither true nor false");
    case KeyType::kText:
      if (text) return KeyValue(*text);
      return wrong_type("not text in quotes");
    case KeyType::kChoice:
      if (!text) return wrong_type("not text in quotes");
      if (std::find(rule.choices.begin(), rule.choices.end(), *text) == rule.choices.end())
        return out_of_range("no such value");
      return KeyValue(*text);
    case KeyType::kWhole:
      if (!whole) return wrong_type("not a whole number");
      if (rule.lower == rule.upper && static_cast<double>(*whole) != rule.lower)
        return out_of_range("no such value");
      if (static_cast<double>(*whole) < rule.lower || static_cast<double>(*whole) > rule.upper)
        return out_of_range("out of range");
      return KeyValue(*whole);
    case KeyType::kWholeList: {
      std::string list = text ? *text + "," : whole ? std::to_string(*whole) + "," : "";
      if (list.empty()) return wrong_type("neither a whole number nor text in quotes");
      std::erase(list, ' ');
      for (std::size_t from = 0; from < list.size();) {
        const std::size_t end = list.find(',', from);
        double number = 0.0;
        const auto [stop, error] = std::from_chars(list.data() + from, list.data() + end, number);
        if (error != std::errc() || stop != list.data() + end || number != std::floor(number))
          return wrong_type("not whole numbers by commas");
        if (number < rule.lower || number > rule.upper) return out_of_range("out of range");
        from = end + 1;
      }
      list.pop_back();
      return KeyValue(list);
    }
    case KeyType::kNumber:
      break;
  }
  const auto* real = std::get_if<double>(&value);
  if (!whole && !real) return wrong_type("not a number");
  const double number = whole ? static_cast<double>(*whole) : *real;
  if (!std::isfinite(number)) return out_of_range("not a finite number");
  if (number < rule.lower || number > rule.upper) return out_of_range("out of range");
  return KeyValue(number + 0.0);  // -0.0 becomes 0.0
}

std::string nearest_name(std::string_view unknown, const std::vector<std::string>& known) {
  if (unknown.size() > 64) return "";
  std::string best;
  std::size_t least = 1 + std::max<std::size_t>(1, unknown.size() / 3);
  for (const std::string& name : known) {
    // "bore" for "bore_mm": a forgotten unit costs nothing
    const bool unit_missing = name.size() > unknown.size() && name.starts_with(unknown) &&
                              name[unknown.size()] == '_' && unknown.size() > 2;
    const std::size_t distance = unit_missing ? 1 : letters_to_change(unknown, name);
    if (distance >= least) continue;
    least = distance;
    best = name;
  }
  return best;
}

}  // namespace trueflank
