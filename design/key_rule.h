// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/design/toml_document.h"

namespace trueflank {

enum class KeyType { kWhole, kWholeList, kNumber, kText, kChoice, kFlag };

/// What a key of a TOML file of ours may hold.
struct KeyRule {
  const char* name = "";
  KeyType type = KeyType::kNumber;
  const char* unit = "";  ///< "mm", "um", "deg", "module" (a coefficient), "" for pure numbers
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::vector<const char*> choices = {};  ///< kChoice
  bool required = false;
  const char* by_default = "";  ///< in words or as a value; empty where required
  const char* meaning = "";     ///< one line for the reference
};

/// A value that obeys its rule: kWhole, kNumber, kText, kChoice and kWholeList (a text by commas), kFlag.
using KeyValue = std::variant<std::int64_t, double, std::string, bool>;

/// Takes a value by its rule; whole numbers are taken where numbers are wanted. `key` is the dotted
/// key for the error. Errors: kWrongType, kOutOfRange (NaN and infinity too); without a line.
[[nodiscard]] Result<KeyValue> take_value(const KeyRule& rule, const std::string& key,
                                          const TomlValue& value);

/// What would be right: "a whole number from 5 to 500", "one of "3k", "simple"".
[[nodiscard]] std::string wanted(const KeyRule& rule);
/// A bound as people write it: 0.05, 100, 20000.
[[nodiscard]] std::string plain_number(double number);
/// A length to a ten-thousandth of a millimetre: "1.25 mm".
[[nodiscard]] std::string plain_mm(double length_mm);

/// The name nearest to one that is not known, by the letters to change; empty where none is near.
[[nodiscard]] std::string nearest_name(std::string_view unknown,
                                       const std::vector<std::string>& known);

}  // namespace trueflank
