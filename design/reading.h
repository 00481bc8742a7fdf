// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "trueflank/design/inch_keys.h"
#include "trueflank/design/key_rule.h"
#include "trueflank/design/toml_document.h"

namespace trueflank {

/// What has been read of a file so far: which keys it has, and every error.
class Reading {
 public:
  struct Found {
    int line = 0;
    std::string value;  ///< as the file writes it
    bool good = true;   ///< obeys its own rule
  };

  void add(const std::string& key, Found found) { found_[key] = std::move(found); }
  /// Every key of a table and of those in it, dotted; what the file's text could not be read as is not
  /// good.
  void add_all(const TomlTable& table, const std::string& prefix = "");
  /// A key that the file has in inches: errors of the metric one name what is written.
  void add_inches(const InchKey& key);
  [[nodiscard]] bool has(const std::string& key) const { return found_.contains(key); }
  /// There, and of itself right: fit to be compared with other values.
  [[nodiscard]] bool good(const std::string& key) const;
  /// Line of a key, else of the nearest table around it, else 1.
  [[nodiscard]] int line(std::string key) const;
  [[nodiscard]] const std::map<std::string, Found>& found() const { return found_; }

  /// Adds an error; line and value are looked up by its key where it has none. Beyond kMostErrors
  /// they are only counted.
  void report(Error error);
  /// An error about the key's value and others.
  void contradiction(const std::string& key, std::string message, std::string remedy);
  void missing(const std::string& key, std::string message, std::string remedy);
  void unknown(const std::string& key, std::string message, std::string remedy);

  /// All errors in the order of their lines; the file's name in each.
  [[nodiscard]] Errors errors(const std::string& file) const;
  [[nodiscard]] bool clean() const { return errors_.empty(); }
  [[nodiscard]] bool full() const { return errors_.size() >= kMostErrors; }

  static constexpr std::size_t kMostErrors = 1000;

 private:
  std::map<std::string, Found> found_;
  std::map<std::string, InchKey> inches_;  ///< by the metric key
  Errors errors_;
  std::size_t more_ = 0;
};

}  // namespace trueflank
