// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/design_input.h"

#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_file.h"

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

io::Report evaluate(const GearTrain& train) {
  io::Report report;
  report.train = &train;
  const std::vector<MeshState> states = mesh_states(train);
  report.findings = check_gearbox(train, states);
  for (std::size_t i = 0; i < states.size(); ++i)
    report.sweeps.push_back(
        {.mesh = train.meshes[i].name,
         .minimum_clearance_um = um_from_mm(states[i].centred.minimum_clearance_mm()),
         .penetration_um = um_from_mm(states[i].centred.penetration_mm())});
  report.efficiency = efficiency(train);
  return report;
}

}  // namespace trueflank::app
