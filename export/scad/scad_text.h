// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/base/units.h"
#include "trueflank/export/number_text.h"

// Words of OpenSCAD's language.
namespace trueflank::io {

inline std::string number(double value) {
  std::string text;
  append_shortest(text, value);
  return text;
}
/// For parameters that people read: to a nanometre.
inline std::string short_number(double value) { return decimal_text(value); }
inline std::string degrees(double angle_rad) { return number(deg_from_rad(angle_rad)); }

/// Text without what would end a comment's line.
inline std::string one_line(std::string text) {
  std::erase_if(text, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  return text;
}

template <class... Fields>
std::string list(const Fields&... fields) {
  std::string text;
  ((text += (text.empty() ? "" : ", ") + fields), ...);
  return "[" + text + "]";
}

}  // namespace trueflank::io
