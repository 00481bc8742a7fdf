// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/evaluate.h"

#include "trueflank/base/threads.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/machine/check_machine.h"
#include "trueflank/design/requirements_file.h"
#include "trueflank/session/reported_cure_of.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/flank_modifications.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank {

namespace {

/// Of a gear, or of every one that does not set its own. Requires: materials that are in the table.
const Material& material_of(const StrengthOptions& options, const std::string& gear) {
  const auto own = options.material_of.find(gear);
  return *options.materials.find(own == options.material_of.end() ? options.material : own->second);
}

/// A body is of its first gear's material; carrier and housing are of the gearbox's.
const Material& material_of_part(const GearTrain& train, const StrengthOptions& options,
                                 const PartShape& part) {
  if (part.member == kNoMember) return material_of(options, part.name);
  const auto gears = train.topology().gears_of(part.member);
  return material_of(options, gears.empty() ? part.name : train.gear(gears.front()).name);
}

/// What a bench found to hold the input at rest; NaN where none was.
double drag_of(const GearboxDesign& design) {
  if (!design.losses) return kNaN;
  return loss_torque_nm(*design.losses, {.temperature_c = design.losses->temperature_c.value_or(kNaN)}, 0.0);
}

/// Efficiency, strength and inertia.
void add_drive(const Gearbox& gearbox, const StrengthOptions& strength_options, io::Report& report) {
  const GearTrain& train = gearbox.train();
  report.efficiency = efficiency(train);
  if (train.meshes.empty()) return;
  if (auto result = strength(train, strength_options)) report.strength = std::move(*result);
  if (auto result = strength_plastic(train, strength_options); result && !result->teeth.empty())
    report.plastic = std::move(*result);
  else if (auto iso = strength_iso6336(train, strength_options))
    report.iso6336 = std::move(*iso);
  const auto& shapes = gearbox.parts();  // what does not fit is reported where the parts are made
  if (!shapes) return;
  const auto density_of = [&](const PartShape& part) {
    return material_of_part(train, strength_options, part).density_kg_m3;
  };
  report.inertia = {material_of(strength_options, "").density_kg_m3,
                    reflected_inertia(train, report.efficiency, body_inertias(train, *shapes, density_of),
                                      {.rotor_kg_m2 = train.design.shafts.rotor_inertia_kg_m2,
                                       .load_kg_m2 = train.design.shafts.load_inertia_kg_m2,
                                       .drag_torque_nm = drag_of(train.design)})};
}

/// What stands around the gears of a design with [housing].
void add_machine(const Gearbox& gearbox, const StrengthOptions& strength_options, io::Report& report) {
  const GearTrain& train = gearbox.train();
  const auto& shapes = gearbox.parts();
  if (!train.design.machine || !shapes) return;
  const Findings findings = check_machine(train, *shapes);
  report.findings.insert(report.findings.end(), findings.begin(), findings.end());
  report.bill = bill_of_materials(*shapes, [&](const PartShape& part) {
    const Material& material = material_of_part(train, strength_options, part);
    return PartMaterial{material.name, material.density_kg_m3};
  });
  if (const auto layout = machine_layout(train))
    for (const std::string& designation : bought_for_set_screw(layout->set_screw))
      add_bought(report.bill, designation);
}

}  // namespace

io::Report evaluate(const Gearbox& gearbox, const StrengthOptions& strength_options) {
  const GearTrain& train = gearbox.train();
  io::Report report;
  report.train = gearbox.shared_train();
  report.inches = gearbox.speaks_inches();
  if (const auto& shapes = gearbox.parts()) report.shapes = *shapes;
  auto turning = begun_beside([&train] { return mesh_states(train); });
  add_drive(gearbox, strength_options, report);
  const std::vector<MeshState> states = turning.get();
  report.findings = check_gearbox(train, states);
  add_machine(gearbox, strength_options, report);
  if (verdict(report.findings) == CheckStatus::kFail && !train.meshes.empty())
    report.cure = take_joint_cure(train, report.findings);
  for (std::size_t i = 0; i < states.size(); ++i)
    report.sweeps.push_back(
        {.mesh = train.meshes[i].name,
         .minimum_clearance_um = um_from_mm(states[i].centred.minimum_clearance_mm()),
         .penetration_um = um_from_mm(states[i].centred.penetration_mm())});
  return report;
}

ResultAll<StrengthOptions> strength_options(const Gearbox& gearbox, const MaterialOptions& asked) {
  const GearboxDesign& design = gearbox.design();
  StrengthOptions options;
  if (!asked.file.empty()) {
    auto table = read_materials(asked.file);
    if (!table) return fail_all(gearbox.located(table.error()));
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
    for (std::size_t i = 0; i < design.gears.size(); ++i)
      if (const auto body = options.material_of.find(first_of_body(design, i).name);
          body != options.material_of.end())
        options.material_of.try_emplace(design.gears[i].name, std::string(body->second));
  }
  if (!errors.empty()) return fail_all(gearbox.located(std::move(errors)));
  return with_factors_of(design, std::move(options));
}

}  // namespace trueflank
