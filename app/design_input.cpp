// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/design_input.h"

#include <algorithm>
#include <future>

#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/requirements_file.h"
#include "trueflank/solid/mass_properties.h"
#include "trueflank/solid/part_shape.h"
#include "trueflank/train/flank_modifications.h"

namespace trueflank::app {

ResultAll<GearTrain> read_train(const std::string& path, const MadeOptions& made) {
  auto file = read_design_file(path);
  if (!file) return fail_all(file.error());
  if (!made.process.empty()) {
    const Process* process = file->tools.processes.find(made.process);
    if (!process) {
      std::string known;
      for (const std::string& name : names_of(file->tools.processes))
        known += (known.empty() ? "" : ", ") + name;
      return fail_all({{.code = ErrorCode::kUsage, .message = "no such process",
                        .key = "--process", .value = made.process, .remedy = known}});
    }
    file->design.made.process = *process;
  }
  if (made.kerf_mm) file->design.made.kerf_mm = made.kerf_mm;
  auto train = lay_out(file->design);
  if (!train) return fail_all(located(train.error(), *file));
  return train;
}

Errors located_in(const std::string& path, Errors errors) {
  const auto file = read_design_file(path);
  return file ? located(std::move(errors), *file) : std::move(errors);
}

namespace {

/// Of a gear, or of every one that does not set its own. Requires: materials that are in the table.
const Material& material_of(const StrengthOptions& options, const std::string& gear) {
  const auto own = options.material_of.find(gear);
  return *options.materials.find(own == options.material_of.end() ? options.material : own->second);
}

/// What a bench found to hold the input at rest; NaN where none was.
double drag_of(const GearboxDesign& design) {
  if (!design.losses) return kNaN;
  return loss_torque_nm(*design.losses, {.temperature_c = design.losses->temperature_c.value_or(kNaN)}, 0.0);
}

/// Efficiency, strength and inertia.
void add_drive(const GearTrain& train, const StrengthOptions& strength_options,
               io::Report& report) {
  report.efficiency = efficiency(train);
  if (train.design.kind == TrainKind::kGear) return;
  if (auto result = strength(train, strength_options)) report.strength = std::move(*result);
  const auto shapes = part_shapes(train);  // what does not fit is told where the parts are made
  if (!shapes) return;
  const std::string planet = train.find("planet1") ? "planet1" : "planet";
  const auto density_of = [&](const std::string& part) {  // planets that differ are planet_1, ...
    return material_of(strength_options, part.starts_with("planet") ? planet : part).density_kg_m3;
  };
  report.inertia = {density_of(""),
                    reflected_inertia(train, report.efficiency, body_inertias(*shapes, density_of),
                                      {.rotor_kg_m2 = train.design.shafts.rotor_inertia_kg_m2,
                                       .load_kg_m2 = train.design.shafts.load_inertia_kg_m2,
                                       .drag_torque_nm = drag_of(train.design)})};
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

ResultAll<StrengthOptions> strength_options(const GearboxDesign& design,
                                            const MaterialOptions& asked) {
  StrengthOptions options;
  if (!asked.file.empty()) {
    auto table = read_materials(asked.file);
    if (!table) return fail_all(table.error());
    options.materials = std::move(*table);
  }
  std::string known;
  for (const Material& m : options.materials.all()) known += (known.empty() ? "" : ", ") + m.name;
  Errors errors;
  const auto take = [&](const std::string& name, const std::string& key, std::string& place) {
    if (options.materials.find(name)) {
      place = name;
      return;
    }
    const bool option = key.starts_with("--");
    errors.push_back({.code = option ? ErrorCode::kUsage : ErrorCode::kOutOfRange,
                      .message = "no such material",
                      .key = key,
                      .value = name,
                      .remedy = known + "; or --materials FILE with a table [material." + name + "]"});
  };
  if (!asked.material.empty()) {
    take(asked.material, "--material", options.material);
  } else {
    if (!design.material.empty()) take(design.material, "gearbox.material", options.material);
    for (const GearDesign& gear : design.gears)
      if (!gear.material.empty())
        take(gear.material, gear.name + ".material", options.material_of[gear.name]);
    if (const auto planet = options.material_of.find("planet1"); planet != options.material_of.end())
      options.material_of.try_emplace("planet2", planet->second);
  }
  if (!errors.empty()) return fail_all(std::move(errors));
  return options;
}

}  // namespace trueflank::app
