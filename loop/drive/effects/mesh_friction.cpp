// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily mesh_friction() {
  DriveFamily f;
  f.id = "mesh_friction";
  f.description = "one mesh rubs otherwise than designed: its coefficient less the others'";
  f.cause = "that mesh's lubricant, finish or damage";
  f.correction = "inspect that mesh";
  f.follows = "load";
  f.parameters = {"difference"};
  f.shape_names = {"mesh"};
  f.preference = 4;
  f.of_one_mesh = true;
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (context.model.meshes.size() > 1)
      for (std::size_t k = 0; k < context.model.meshes.size(); ++k)
        shapes.push_back({static_cast<double>(k + 1)});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
    c[0] = context.mesh_slope(p, static_cast<std::size_t>(shape[0]) - 1);
  };
  f.into_state = [](DriveState& state, const DriveShape& shape, double b) {
    state.mesh_value[static_cast<std::size_t>(shape[0]) - 1] = b;
  };
  f.plausible = can_be_friction;
  f.told = [](const DriveContext& context, const DriveShape& shape, double more, const auto&) {
    return "the mesh " + context.model.meshes[static_cast<std::size_t>(shape[0]) - 1] + " rubs " +
           (more > 0.0 ? "more" : "less") + " than the others: its coefficient is " +
           printed("%.3g ", std::abs(more)) + (more > 0.0 ? "higher" : "lower") +
           printed(" (difference %.3g)", more);
  };
  f.detail = [](const DriveModel& model, const DriveShape& shape) {
    return " (" + model.meshes[static_cast<std::size_t>(shape[0]) - 1] + ")";
  };
  const char* run = "a second ratio, or one layer locked: the two shafts alone do not distinguish the meshes";
  f.told_from = {{"friction_coefficient", run}, {"direction_dependent_friction", run}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
