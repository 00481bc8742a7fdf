// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/inch_keys.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace trueflank {
namespace {

constexpr double kInch_mm = 25.4;
constexpr std::string_view kPitch = "diametral_pitch", kModule = "module_mm";

std::optional<double> number_of(const TomlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

/// The nearest number of 15 digits: 0.09 in is 2.286 mm, not 2.2859999999999996.
double as_decimal(double value) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 14).ptr;
  double decimal = value;
  std::from_chars(text.data(), end, decimal);
  return decimal;
}

/// The metric key; empty where this is none in inches.
std::string metric_name(const std::string& key) {
  if (key == kPitch) return std::string(kModule);
  if (key.size() > 3 && key.ends_with("_in")) return key.substr(0, key.size() - 3) + "_mm";
  return "";
}

void convert(TomlTable& table, const std::string& prefix, std::vector<InchKey>& renamed) {
  for (std::size_t i = 0; i < table.entries.size(); ++i) {
    TomlEntry& entry = table.entries[i];
    if (auto* inner = std::get_if<TomlTable>(&entry.value)) {
      convert(*inner, prefix + entry.key + ".", renamed);
      continue;
    }
    const std::string metric = metric_name(entry.key);
    const auto number = number_of(entry.value);
    if (metric.empty()) continue;
    const bool twice = table.find(metric) != nullptr;
    renamed.push_back({prefix + entry.key, prefix + metric, quoted_toml(entry.value), entry.line, twice});
    if (twice) continue;
    if (number) entry.value = entry.key == kPitch ? kInch_mm / *number : as_decimal(kInch_mm * *number);
    entry.key = metric;
  }
  // what is given twice is reported to the user, and taken once
  std::erase_if(table.entries, [&](const TomlEntry& entry) {
    return std::any_of(renamed.begin(), renamed.end(), [&](const InchKey& key) {
      return key.twice && key.written == prefix + entry.key;
    });
  });
}

}  // namespace

std::vector<InchKey> to_metric(TomlTable& root) {
  std::vector<InchKey> renamed;
  convert(root, "", renamed);
  return renamed;
}

}  // namespace trueflank
