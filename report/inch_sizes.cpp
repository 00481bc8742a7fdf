// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/inch_sizes.h"

#include <nlohmann/json.hpp>

#include "trueflank/base/number_text.h"

namespace trueflank::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInch_mm = 25.4;

double inches(double length_mm) { return length_mm / kInch_mm; }

std::string inch_text(double value) { return printed_number(value, "%.5f"); }

/// Before or behind a text, up to the width of a column.
std::string column(const std::string& text, std::size_t width, bool left) {
  const std::string pad(text.size() < width ? width - text.size() : 0, ' ');
  return left ? text + pad : pad + text;
}

/// Names and values of a gear's sizes, in the order of the table.
std::vector<std::pair<const char*, double>> sizes_of(const TrainGear& gear) {
  const ToothProfile& profile = gear.profile;
  return {{"diametral_pitch", kInch_mm / profile.gear().normal_module_mm},
          {"tip_diameter_in", inches(2.0 * profile.tip_radius_mm())},
          {"root_diameter_in", inches(2.0 * profile.root_radius_mm())},
          {"root_form_diameter_in", inches(2.0 * profile.root_form_radius_mm())},
          {"face_width_in", inches(gear.face_width_mm)}};
}

}  // namespace

std::string inch_table(const GearTrain& train) {
  std::string text = column("gear", 8, true);
  for (const char* title : {"DP", "tip in", "root in", "form in", "width in"}) text += column(title, 11, false);
  text += "\n";
  for (const TrainGear& gear : train.gears) {
    text += column(gear.name, 8, true);
    for (const auto& [name, value] : sizes_of(gear)) text += column(inch_text(value), 11, false);
    text += "\n";
  }
  if (!train.meshes.empty())
    for (const GearTrain* stage : train.each_stage())
      text += "centre distance " + inch_text(inches(stage->centre_distance_mm)) + " in\n";
  for (const TrainMesh& mesh : train.meshes)
    text += "backlash " + mesh.name + " " + inch_text(inches(mesh.backlash_mm)) + " in\n";
  return text + "\n";
}

std::string inch_json_text(const GearTrain& train) {
  Json json = Json::object();
  if (!train.meshes.empty()) json["centre_distance_in"] = inches(train.centre_distance_mm);
  for (const GearTrain& stage : train.stages) json["stages"].push_back({{"centre_distance_in", inches(stage.centre_distance_mm)}});
  json["gears"] = Json::object();
  for (const TrainGear& gear : train.gears)
    for (const auto& [name, value] : sizes_of(gear)) json["gears"][gear.name][name] = value;
  json["meshes"] = Json::object();
  for (const TrainMesh& mesh : train.meshes) json["meshes"][mesh.name]["backlash_in"] = inches(mesh.backlash_mm);
  return json.dump();
}

}  // namespace trueflank::io
