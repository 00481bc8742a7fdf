// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/design_input.h"

#include <future>

#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/requirements_file.h"
#include "trueflank/solid/mass_properties.h"
#include "trueflank/solid/part_shape.h"

namespace trueflank::app {

ResultAll<GearTrain> read_train(const std::string& path) {
  auto file = read_design_file(path);
  if (!file) return fail_all(file.error());
  auto train = lay_out(file->design);
  if (!train) return fail_all(located(train.error(), *file));
  return train;
}

Errors located_in(const std::string& path, Errors errors) {
  const auto file = read_design_file(path);
  return file ? located(std::move(errors), *file) : std::move(errors);
}

Errors not_built(const GearboxDesign& design) {
  Errors errors;
  const auto refuse = [&](std::string key, std::string value, std::string remedy) {
    errors.push_back({.code = ErrorCode::kUnsupported,
                      .message = "understood, but this version does not build it",
                      .key = std::move(key),
                      .value = std::move(value),
                      .remedy = std::move(remedy)});
  };
  if (design.helix_angle_rad != 0.0)
    refuse("gearbox.helix_angle_deg", std::to_string(deg_from_rad(design.helix_angle_rad)),
           "0 (check and loop take helical gears)");
  if (design.herringbone) refuse("gearbox.herringbone", "true", "false");
  for (const GearDesign& gear : design.gears)
    if (gear.modifications != ModificationsDesign{})
      refuse(gear.name + ".modifications", "", "no modifications");
  return errors;
}

namespace {

/// Efficiency, strength and inertia.
void add_drive(const GearTrain& train, const StrengthOptions& strength_options,
               io::Report& report) {
  report.efficiency = efficiency(train);
  if (train.design.kind == TrainKind::kGear) return;
  if (auto result = strength(train, strength_options)) report.strength = std::move(*result);
  const Material* material = strength_options.materials.find(strength_options.material);
  const auto shapes = part_shapes(train);  // what does not fit is told where the parts are made
  if (material && shapes)
    report.inertia = {material->density_kg_m3,
                      reflected_inertia(train, report.efficiency,
                                        body_inertias(*shapes, material->density_kg_m3))};
}

}  // namespace

io::Report evaluate(const GearTrain& train, const StrengthOptions& strength_options) {
  io::Report report;
  report.train = &train;
  auto turning = std::async(std::launch::async, [&train] { return mesh_states(train); });
  add_drive(train, strength_options, report);
  const std::vector<MeshState> states = turning.get();
  report.findings = check_gearbox(train, states);
  for (std::size_t i = 0; i < states.size(); ++i)
    report.sweeps.push_back(
        {.mesh = train.meshes[i].name,
         .minimum_clearance_um = um_from_mm(states[i].centred.minimum_clearance_mm()),
         .penetration_um = um_from_mm(states[i].centred.penetration_mm())});
  return report;
}

ResultAll<StrengthOptions> strength_options(const std::string& material,
                                            const std::string& materials_file) {
  StrengthOptions options;
  if (!materials_file.empty()) {
    auto table = read_materials(materials_file);
    if (!table) return fail_all(table.error());
    options.materials = std::move(*table);
  }
  if (!material.empty()) options.material = material;
  if (options.materials.find(options.material)) return options;
  std::string known;
  for (const Material& m : options.materials.all()) known += (known.empty() ? "" : ", ") + m.name;
  return fail_all({{.code = ErrorCode::kUsage, .message = "no such material", .key = "--material",
                    .value = options.material, .remedy = known}});
}

}  // namespace trueflank::app
