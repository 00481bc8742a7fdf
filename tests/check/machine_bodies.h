// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/check/check_designs.h"
#include "trueflank/check/finding.h"
#include "trueflank/solid/shape/part_shape.h"

// Bodies of a few discs in place of a gearbox's parts, and what is found about them.
namespace trueflank {

/// nullptr where there is none.
inline const Finding* find_finding(const Findings& findings, const std::string& id,
                                   const std::string& where) {
  for (const Finding& f : findings)
    if (f.id == id && f.where == where) return &f;
  return nullptr;
}
using test::only;
inline CircleOutline round(double radius_mm, double x = 0.0, double y = 0.0) {
  return {.centre = {x, y}, .radius_mm = radius_mm};
}
inline PartShape disc(const std::string& name, double lower, double upper, CircleOutline outer,
                      std::vector<Outline> holes = {}) {
  return {.name = name, .slabs = {{lower, upper, outer, std::move(holes)}}};
}
/// A body a part, where the part is.
inline PartShapes bodies(std::vector<PartShape> parts) {
  PartShapes shapes{.parts = std::move(parts)};
  for (std::size_t i = 0; i < shapes.parts.size(); ++i)
    shapes.assembly.push_back({.part = static_cast<int>(i), .name = shapes.parts[i].name});
  return shapes;
}

}  // namespace trueflank
