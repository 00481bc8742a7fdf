// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/file_units.h"

#include <charconv>
#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

template <class FromFile>
double exactly_read_back(double inside, double approximate, FromFile from_file) {
  for (int digits = 1; digits <= 17; ++digits) {
    char buffer[40];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, approximate,
                                   std::chars_format::general, digits).ptr;
    double candidate = 0.0;
    std::from_chars(buffer, end, candidate);
    if (from_file(candidate) == inside) return candidate;
  }
  double below = approximate, above = approximate;
  for (int step = 0; step < 4; ++step) {
    below = std::nextafter(below, -HUGE_VAL);
    above = std::nextafter(above, HUGE_VAL);
    if (from_file(below) == inside) return below;
    if (from_file(above) == inside) return above;
  }
  return approximate;
}

}  // namespace

double file_deg(double angle_rad) {
  return exactly_read_back(angle_rad, deg_from_rad(angle_rad), rad_from_deg);
}

double file_um(double length_mm) {
  return exactly_read_back(length_mm, um_from_mm(length_mm), mm_from_um);
}

}  // namespace trueflank
