// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "trueflank/geometry/gear.h"

int main() {
  const trueflank::Gear gear{.teeth = 39, .normal_module_mm = 2.0};
  std::cout << trueflank::reference_radius_mm(gear) << '\n';
  return trueflank::reference_radius_mm(gear) == 39.0 ? 0 : 1;
}
