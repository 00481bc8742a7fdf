// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily temperature_drag() {
  DriveFamily f;
  f.id = "temperature_drag";
  f.description = "drag that falls as the drive warms";
  f.law = "torque_nm exp(-per_c (t - the bench's mean))";
  f.cause = "stiff grease, seals";
  f.correction = "softer grease; warm up";
  f.follows = "warmth";
  f.parameters = {"torque_nm"};
  f.shape_names = {"per_c"};
  f.only_positive = true;
  f.preference = 2;
  f.shapes = rate_shapes;
  f.evaluate = loss([](const DriveContext& context, const BenchPoint& p, const DriveShape& shape) {
    return thinning(context, p, shape[0]);
  });
  f.shape_values = {{.continuous = true, .limits = rate_limits}};
  f.references = mean_temperature;
  f.calibrate = [](CalibratedLosses& c, const DriveShape& shape, double b) {
    return CalibratedLosses::add(c.losses.drag_torque_nm, c.at_reference(b, shape[0]), c.losses.drag_per_c,
                                 shape[0]);
  };
  f.told_from = {{"temperature_viscosity", "a sweep of the speed cold and one warm"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
