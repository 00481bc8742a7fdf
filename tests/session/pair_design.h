// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace trueflank {

/// A pair that passes every check, with a teeth number of the wheel to choose.
inline std::string pair_design(int wheel_teeth = 31, const std::string& more = {}) {
  return "format = 1\nname = \"pair\"\n[gearbox]\nkind = \"pair\"\nmodule_mm = 1.0\nbacklash_mm = 0.05\n" + more +
         "[pinion]\nteeth = 20\nface_width_mm = 3.0\n[wheel]\nteeth = " + std::to_string(wheel_teeth) +
         "\nface_width_mm = 3.0\n";
}

}  // namespace trueflank
