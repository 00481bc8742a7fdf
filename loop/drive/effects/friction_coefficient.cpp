// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily friction_coefficient() {
  DriveFamily f;
  f.id = "friction_coefficient";
  f.description = "the tooth flanks rub with another coefficient than designed";
  f.cause = "lubricant, finish, material of the flanks";
  f.correction = "design with this coefficient; change lubricant or finish";
  f.follows = "load";
  f.parameters = {"value"};
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = context.friction_slope(p);
  };
  f.plausible = can_be_friction;
  f.hides_in_gains = true;
  f.base = [](const DriveContext& context) { return context.model.friction; };
  f.into_state = [](DriveState& state, const DriveShape&, double b) { state.shift = b; };
  f.calibrate = [](CalibratedLosses& c, const DriveShape&, double b) {
    c.friction_shift += b;
    return true;
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
