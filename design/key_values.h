// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "trueflank/design/key_rule.h"

// Between the value of a key in the file and a member of the design: what the tables of keys are
// written with.
namespace trueflank::key_values {

using Value = std::optional<KeyValue>;  ///< nothing: the file need not say it

inline double number(const KeyValue& value) { return std::get<double>(value); }
inline int whole(const KeyValue& value) { return static_cast<int>(std::get<std::int64_t>(value)); }
inline const std::string& text(const KeyValue& value) { return std::get<std::string>(value); }

inline Value whole_value(int value) { return KeyValue(static_cast<std::int64_t>(value)); }
inline Value unless(double value, double by_default) {
  return value == by_default ? Value() : Value(value);
}
inline Value unless_zero(double value) { return unless(value, 0.0); }
inline Value if_given(const std::optional<double>& value) {
  return value ? Value(*value) : Value();
}

}  // namespace trueflank::key_values
