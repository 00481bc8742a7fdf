// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/bill_of_materials.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "trueflank/solid/measure/mass_properties.h"

namespace trueflank {
namespace {

std::string grams(double value) {
  if (std::isnan(value)) return "";
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 2);
  return {buffer, end.ptr};
}

}  // namespace

BillOfMaterials bill_of_materials(
    const PartShapes& shapes, const std::function<PartMaterial(const PartShape&)>& material_of) {
  std::vector<int> counts(shapes.parts.size(), 0);
  for (const Placement& body : shapes.assembly) ++counts[static_cast<std::size_t>(body.part)];
  BillOfMaterials bill;
  std::map<std::string, int> bought;
  for (std::size_t i = 0; i < shapes.parts.size(); ++i) {
    const PartShape& part = shapes.parts[i];
    if (!part.bought.empty()) {
      bought[part.bought] += counts[i];
      continue;
    }
    const PartMaterial material = material_of(part);
    bill.push_back({.part = part.name,
                    .material = material.name,
                    .count = counts[i],
                    .mass_g = 1000.0 * mass_properties(part, material.density_kg_m3).mass_kg});
  }
  for (const auto& [designation, count] : bought)
    bill.push_back({.designation = designation, .count = count});
  return bill;
}

void add_bought(BillOfMaterials& bill, const std::string& designation) {
  auto line = bill.begin();
  while (line != bill.end() && (line->designation.empty() || line->designation < designation)) ++line;
  if (line != bill.end() && line->designation == designation)
    ++line->count;
  else
    bill.insert(line, {.designation = designation, .count = 1});
}

std::string bill_csv(const BillOfMaterials& bill) {
  std::string text = "part,designation,count,material,mass_g,mass_all_g\n";
  for (const BillLine& line : bill)
    text += line.part + "," + (line.designation.empty() ? "" : '"' + line.designation + '"') + "," +
            std::to_string(line.count) + "," + line.material + "," + grams(line.mass_g) + "," +
            grams(line.mass_g * line.count) + "\n";
  return text;
}

}  // namespace trueflank
