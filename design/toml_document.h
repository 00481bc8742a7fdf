// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trueflank/base/result.h"

// A TOML 1.0 text as a plain tree in which every value knows its line. Why a parser of our own:
// docs/decisions/0010-own-toml-parser.md.
namespace trueflank {

struct TomlEntry;

/// How a table came to be; decides what may be added to it later.
enum class TomlOrigin { kImplied, kHeader, kDotted, kInline };

/// Entries in the order of the file.
struct TomlTable {
  std::vector<TomlEntry> entries;
  TomlOrigin origin = TomlOrigin::kImplied;

  /// nullptr where there is none.
  [[nodiscard]] const TomlEntry* find(std::string_view key) const;
  [[nodiscard]] TomlEntry* find(std::string_view key);
};

/// A value that is well formed but that no file of ours uses.
struct TomlOther {
  const char* kind = "";  ///< "an array", "a date or time"
};

/// A value that could not be read; its error is among the document's.
struct TomlUnreadable {};

using TomlValue =
    std::variant<bool, std::int64_t, double, std::string, TomlTable, TomlOther, TomlUnreadable>;

struct TomlEntry {
  std::string key;
  TomlValue value;
  int line = 0;  ///< of the key, or of the table's header
};

struct TomlDocument {
  TomlTable root;
  Errors errors;      ///< in the order of lines
  bool whole = true;  ///< false: there was too much, or no text at all, and not all was read
};

/// @name What a text may have; far beyond any use, so that no text can exhaust stack or time
/// @{
inline constexpr int kDeepestToml = 32;      ///< parts of a key, levels of brackets
inline constexpr int kMostTomlKeys = 10000;  ///< in a whole text
inline constexpr std::size_t kMostTomlErrors = 100;
/// @}

/// Reads a TOML 1.0 text. After a wrong line it goes on with the next that begins a key or a table,
/// so that all wrong lines are reported at once.
/// Errors: kSyntax with line, dotted key, the value as written, and what would be right. Text that
/// is no UTF-8 is one error.
[[nodiscard]] TomlDocument parse_toml(std::string_view text);

/// A value as an error quotes it: as the file would write it, shortened to one short line of
/// printable characters.
[[nodiscard]] std::string quoted_toml(const TomlValue& value);
/// Printable ASCII and letters of a text, at most 60 characters of it.
[[nodiscard]] std::string shortened_text(std::string_view text);
/// A string as TOML writes it, with quotes and escapes.
[[nodiscard]] std::string toml_string(std::string_view text);
/// A number as TOML writes a float: the fewest digits that read back to the same double.
[[nodiscard]] std::string toml_number(double number);

}  // namespace trueflank
