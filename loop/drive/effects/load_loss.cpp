// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily load_loss() {
  DriveFamily f;
  f.id = "load_loss";
  f.description = "a torque at the input that grows faster than the load: torque_nm (T / T_most)^exponent, T_most the "
                  "bench's largest torque at the input";
  f.cause = "housing, carrier or ring that bends under load, seals and bearings that are pressed askew";
  f.correction = "stiffen what bends; design at the load that counts";
  f.follows = "load";
  f.bends_over_load = true;
  f.parameters = {"torque_nm"};
  f.shape_names = {"exponent"};
  f.only_positive = true;
  f.preference = 3;
  f.shapes = [](const DriveContext&) { return std::vector<DriveShape>{{1.3}, {1.6}, {2.0}, {2.5}}; };
  f.evaluate = loss([](const DriveContext& context, const BenchPoint& p, const DriveShape& shape) {
    return std::pow(std::max(context.load_nm(p), 0.0) / context.table.most_load_nm, shape[0]);
  });
  f.shape_values = {
      {.continuous = true, .limits = [](const DriveContext&) { return std::pair(1.15, 4.0); }}};
  f.references = [](const DriveContext& context) {
    return std::vector<DriveReference>{{"reference_nm", context.table.most_load_nm}};
  };
  f.not_carried = "a design has no loss of this form; its nearest is load_dependent_friction";
  f.told_from = {{"load_dependent_friction", "a second ratio: what the flanks lose follows their sliding"},
                 {"friction_coefficient", "a sweep of the load over a decade"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
