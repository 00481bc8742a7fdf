// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/reading.h"

#include <algorithm>

namespace trueflank {

void Reading::add_all(const TomlTable& table, const std::string& prefix) {
  for (const TomlEntry& entry : table.entries) {
    const std::string key = prefix + entry.key;
    const bool readable = !std::holds_alternative<TomlUnreadable>(entry.value);
    add(key, {.line = entry.line, .value = quoted_toml(entry.value), .good = readable});
    if (const auto* inner = std::get_if<TomlTable>(&entry.value)) add_all(*inner, key + ".");
  }
}

void Reading::add_inches(const InchKey& key) {
  add(key.written, {.line = key.line, .value = key.value});
  if (key.twice)
    contradiction(key.written, "given twice: " + key.metric + " is there too", "one of both keys");
  else
    inches_[key.metric] = key;
}

bool Reading::good(const std::string& key) const {
  const auto it = found_.find(key);
  return it != found_.end() && it->second.good;
}

int Reading::line(std::string key) const {
  for (;;) {
    const auto it = found_.find(key);
    if (it != found_.end()) return it->second.line;
    const auto dot = key.rfind('.');
    if (dot == std::string::npos) return 1;
    key.resize(dot);
  }
}

void Reading::report(Error error) {
  if (error.line == 0) error.line = line(error.key);
  if (const auto it = found_.find(error.key); it != found_.end()) {
    it->second.good = false;
    if (error.value.empty()) error.value = it->second.value;
  }
  if (const auto inches = inches_.find(error.key); inches != inches_.end()) {
    const bool converted = error.value != inches->second.value;
    error.message += error.message.empty() || !converted ? "" : ", taken as " + error.value + " of " + error.key;
    error.key = inches->second.written;
    error.value = inches->second.value;
  }
  if (full())
    ++more_;
  else
    errors_.push_back(std::move(error));
}

void Reading::contradiction(const std::string& key, std::string message, std::string remedy) {
  report({.code = ErrorCode::kInconsistent,
          .message = std::move(message),
          .key = key,
          .remedy = std::move(remedy)});
}

void Reading::missing(const std::string& key, std::string message, std::string remedy) {
  report({.code = ErrorCode::kMissingKey,
          .message = std::move(message),
          .key = key,
          .remedy = std::move(remedy)});
}

void Reading::unknown(const std::string& key, std::string message, std::string remedy) {
  report({.code = ErrorCode::kUnknownKey,
          .message = std::move(message),
          .key = key,
          .remedy = std::move(remedy)});
}

Errors Reading::errors(const std::string& file) const {
  Errors sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Error& a, const Error& b) { return a.line < b.line; });
  if (more_ > 0)
    sorted.push_back({.code = sorted.back().code,
                      .message = "and " + std::to_string(more_) + " errors more",
                      .remedy = "a design file",
                      .line = sorted.back().line});
  for (Error& error : sorted) error.file = file;
  return sorted;
}

}  // namespace trueflank
