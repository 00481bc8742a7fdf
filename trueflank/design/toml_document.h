// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trueflank/base/result.h"

// A TOML text as a plain tree in which every value knows its line.
namespace trueflank {

struct TomlEntry;

/// Entries in the order of the file.
struct TomlTable {
  std::vector<TomlEntry> entries;

  /// nullptr where there is none.
  [[nodiscard]] const TomlEntry* find(std::string_view key) const;
};

/// A kind of value no file of ours uses: an array, a date, a time.
struct TomlOther {
  const char* kind = "";
};

using TomlValue = std::variant<bool, std::int64_t, double, std::string, TomlTable, TomlOther>;

struct TomlEntry {
  std::string key;
  TomlValue value;
  int line = 0;  ///< of the key, or of the table's header
};

/// Reads a TOML text.
/// Errors: kSyntax, one error with its line (a parser cannot go on behind it): not UTF-8 text, not
/// TOML, or one of what TOML allows and we do not: non-ASCII letters in bare keys, tables nested
/// deeper than kDeepestToml.
[[nodiscard]] Result<TomlTable> parse_toml(std::string_view text);

inline constexpr int kDeepestToml = 32;

/// A value as an error quotes it: as the file would write it, shortened to one short line of
/// printable characters.
[[nodiscard]] std::string quoted_toml(const TomlValue& value);
/// A string as TOML writes it, with quotes and escapes.
[[nodiscard]] std::string toml_string(std::string_view text);
/// A number as TOML writes a float: the fewest digits that read back to the same double.
[[nodiscard]] std::string toml_number(double number);

}  // namespace trueflank
