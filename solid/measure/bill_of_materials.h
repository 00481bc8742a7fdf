// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// A line of the bill of materials.
struct BillLine {
  std::string part;         ///< name of its files; empty: bought
  std::string designation;  ///< what to order; empty: made
  std::string material;     ///< of what is made
  int count = 0;
  double mass_g = kNaN;     ///< of one, solid; NaN: bought
};
using BillOfMaterials = std::vector<BillLine>;

/// What a part is made of.
struct PartMaterial {
  std::string name;
  double density_kg_m3 = kNaN;
};

/// Made parts in the order of the shapes, then what is bought, by designation.
[[nodiscard]] BillOfMaterials bill_of_materials(const PartShapes& shapes,
                                                const std::function<PartMaterial(const PartShape&)>& material_of);

/// Adds one of what is bought and is no body of the assembly, in its place.
void add_bought(BillOfMaterials& bill, const std::string& designation);

/// The bill as a table for other programs (docs/gearbox.md).
[[nodiscard]] std::string bill_csv(const BillOfMaterials& bill);

}  // namespace trueflank
