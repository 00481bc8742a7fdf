// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/gear_train.h"

// In which order the bodies of a gearbox go together, each moved in along the axis.
namespace trueflank {

/// Bodies that are moved in together along the axis.
struct AssemblyStep {
  std::vector<std::size_t> bodies;  ///< indices into PartShapes::assembly
  int unit = -1;  ///< made before, of these bodies; -1: bodies of one kind, one by one
  double from =
      1.0;  ///< +1: they come down, along -z; -1: up; 0: from the side, across the axis. The first
            ///< step of a unit just lies there
};

/// What is put together by itself: the carrier with its planets, the lid with its bearing, ...
struct AssemblyUnit {
  std::string
      name;  ///< of the part that it is built on; "gearbox" for the last, which is everything
  std::vector<AssemblyStep> steps;
};

struct AssemblyOrder {
  std::vector<AssemblyUnit>
      units;  ///< in the order in which they are made; empty where none exists
  /// Bodies that hold each other: of each two of them neither passes the other. Empty: all go
  /// together.
  std::vector<std::size_t> stuck;

  [[nodiscard]] bool exists() const { return stuck.empty(); }
};

/// Finds an order and proves it: every step's bodies are swept along the axis, from where they
/// stand to infinity, against all bodies that are there already, and meet none. Outlines are taken
/// as circles on the safe side. Gears in mesh pass each other, helical ones turning as screws do;
/// herringbone teeth pass those of their own side of the apex alone, and planets with such teeth are
/// first brought to their sun from the side. An order is found wherever one exists in which each step moves along
/// the axis only. Of a design without a housing the bodies are those of its gears.
[[nodiscard]] AssemblyOrder assembly_order(const GearTrain& train, const PartShapes& shapes);

}  // namespace trueflank
