// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/quantity_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank {

std::string number_text(double value, int digits) {
  if (std::isnan(value)) return "nothing";
  std::array<char, 400> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, digits);
  std::string text(buffer.data(), end.ptr);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string bound_text(double value, Rounded rounded, int digits) {
  const double scale = std::pow(10.0, digits);
  // what stands on the last decimal but for the error of the multiplication is not moved
  const double slack = 1e-13 * std::abs(value) * scale;
  const double whole = rounded == Rounded::kUp ? std::ceil(value * scale - slack) : std::floor(value * scale + slack);
  return number_text(whole / scale, digits);
}

std::string mm_text(double length_mm) { return number_text(length_mm, 4) + " mm"; }
std::string um_text(double length_mm) { return number_text(um_from_mm(length_mm), 2) + " um"; }
std::string deg_text(double angle_rad) { return number_text(deg_from_rad(angle_rad), 3) + " deg"; }

}  // namespace trueflank
