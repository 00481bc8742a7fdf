// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily load_dependent_friction() {
  DriveFamily f;
  f.id = "load_dependent_friction";
  f.description =
      "the flanks' friction coefficient changes with load: + value (T / T_most)^exponent, T_most the "
      "bench's largest torque at the input";
  f.cause = "lubricant film under pressure, elastic deformation of teeth and housing";
  f.correction = "stiffness, viscosity; design at the load that counts";
  f.follows = "load";
  f.bends_over_load = true;
  f.parameters = {"value"};
  f.shape_names = {"exponent"};
  f.preference = 2;
  f.shapes = [](const DriveContext&) { return std::vector<DriveShape>{{0.3}, {0.5}, {0.75}, {1.0}, {1.4}, {2.0}}; };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
    const double part = std::max(context.load_nm(p), 0.0) / context.table.most_load_nm;
    c[0] = context.friction_slope(p) * std::pow(part, shape[0]);
  };
  f.shape_values = {
      {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.2, 3.0); }}};
  f.plausible = can_be_friction;
  f.into_state = [](DriveState& state, const DriveShape& shape, double b) {
    state.load_value = b;
    state.load_exponent = shape[0];
  };
  f.references = [](const DriveContext& context) {
    return std::vector<DriveReference>{{"reference_nm", context.table.most_load_nm}};
  };
  f.calibrate = [](CalibratedLosses& c, const DriveShape& shape, double b) {
    if (!CalibratedLosses::add(c.losses.load_friction, b, c.losses.load_friction_exponent, shape[0]))
      return false;
    c.losses.load_friction_reference_nm = c.bench_load_nm;
    return true;
  };
  f.told_from = {{"friction_coefficient", "a sweep of the load over a decade"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
