// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/gearbox_design.h"

#include <algorithm>

namespace trueflank {

const GearDesign* find_gear(const GearboxDesign& design, const std::string& name) {
  const auto it = std::find_if(design.gears.begin(), design.gears.end(),
                               [&](const GearDesign& gear) { return gear.name == name; });
  return it == design.gears.end() ? nullptr : &*it;
}

const GearDesign* planet_with_bore(const GearboxDesign& design) {
  const int planet = design.topology.first_planet();
  return planet == kNoMember
             ? nullptr
             : &design.gears[static_cast<std::size_t>(design.topology.first_gear_of(planet))];
}

const GearDesign& first_of_body(const GearboxDesign& design, std::size_t gear) {
  const int member = design.topology.gears[gear].member;
  return design.gears[static_cast<std::size_t>(design.topology.first_gear_of(member))];
}

double module_of(const GearboxDesign& design, const GearDesign& gear) {
  return gear.module_mm.value_or(design.module_mm);
}

}  // namespace trueflank
