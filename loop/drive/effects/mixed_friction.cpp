// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily mixed_friction() {
  DriveFamily f;
  f.id = "mixed_friction";
  f.description = "the flanks' friction coefficient is higher at low speed";
  f.law = "+ value exp(-(n / speed_rpm)^exponent)";
  f.cause = "mixed lubrication of the flanks at low speed";
  f.correction = "viscosity, finish of the flanks";
  f.follows = "speed";
  f.parameters = {"value"};
  f.shape_names = {"speed_rpm", "exponent"};
  f.only_positive = true;
  f.preference = 3;
  f.shapes = fading_shapes;
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape,
                  double* c) {
    c[0] = context.friction_slope(p) * faded(p.speed_rpm, shape[0], shape[1]);
  };
  f.shape_values = {{.continuous = true, .limits = speed_limits}, {}};
  f.plausible = can_be_friction;
  f.into_state = [](DriveState& state, const DriveShape& shape, double b) {
    state.mixed_value = b;
    state.mixed_speed_rpm = shape[0];
    state.mixed_exponent = shape[1];
  };
  f.calibrate = [](CalibratedLosses& c, const DriveShape& shape, double b) {
    return shape[1] == 2.0 && CalibratedLosses::add(c.losses.mixed_friction, b,
                                                    c.losses.mixed_friction_speed_rpm, shape[0]);
  };
  f.not_carried = kFadesOtherwise;
  return f;
}

}  // namespace trueflank::loop::drive_effects
