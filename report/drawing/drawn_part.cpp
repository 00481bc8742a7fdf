// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/drawn_part.h"

#include <algorithm>

#include "trueflank/solid/measure/mass_properties.h"

namespace trueflank::io {

DrawnMaterial material_of(const DrawingModel& model, const PartShape& part) {
  const StrengthOptions& options = *model.materials;
  DrawnMaterial drawn{.name = options.material};
  for (const TrainGear* gear : gears_of(*model.train, part)) {
    if (const auto own = options.material_of.find(gear->name); own != options.material_of.end()) drawn.name = own->second;
    break;
  }
  if (const Material* material = options.materials.find(drawn.name)) {
    drawn.mass_kg = mass_properties(part, material->density_kg_m3).mass_kg;
    drawn.mass_text = drawn.mass_kg < 1.0 ? drawing_number(1e3 * drawn.mass_kg, 2) + " g" : drawing_number(drawn.mass_kg, 3) + " kg";
  }
  return drawn;
}

std::string proper_name(const std::string& part) {
  std::string name = part;
  std::replace(name.begin(), name.end(), '_', ' ');
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
  // ring2: a person leaves a space
  if (const std::size_t digit = name.find_first_of("0123456789"); digit != std::string::npos && digit > 0 && name[digit - 1] != ' ')
    name.insert(digit, " ");
  return name;
}

std::string modification_text(const GearTrain& train, const std::string& gear) {
  const GearDesign* design = find_gear(train.design, gear);
  if (!design) return {};
  const ModificationsDesign& m = design->modifications;
  std::string text;
  const auto add = [&](const char* what, double value, const std::string& rest = "") {
    if (value == 0.0) return;
    text += (text.empty() ? "" : ", ") + std::string(what) + " " + drawing_number(value, 2) + rest;
  };
  add("tip relief", m.tip_relief_um, " um from Ø" + drawing_number(m.tip_relief_start_diameter_mm, 3));
  add("root relief", m.root_relief_um, " um from Ø" + drawing_number(m.root_relief_start_diameter_mm, 3));
  add("profile crowning", m.profile_crowning_um, " um");
  add("profile slope", m.profile_slope_um, " um");
  add("lead crowning", m.crowning_um, " um");
  add("end relief", m.end_relief_um, " um over " + drawing_number(m.end_relief_length_mm, 3) + " mm");
  add("helix slope", m.helix_slope_um, " um");
  add("edge chamfer", m.edge_chamfer_mm, " mm");
  add("tip rounding", m.tip_rounding_mm, " mm");
  return text.empty() ? text : proper_name(gear) + ": " + text + ".";
}

}  // namespace trueflank::io
