// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily temperature_viscosity() {
  DriveFamily f;
  f.id = "temperature_viscosity";
  f.description = "viscous drag that thins as the drive warms";
  f.law = "nm_per_rpm exp(-per_c (t - the bench's mean))";
  f.cause = "viscosity of the lubricant";
  f.correction = "warm up, or a lubricant of higher viscosity index";
  f.follows = "warmth";
  f.parameters = {"nm_per_rpm"};
  f.shape_names = {"per_c"};
  f.only_positive = true;
  f.preference = 2;
  f.shapes = rate_shapes;
  f.evaluate = loss([](const DriveContext& context, const BenchPoint& p, const DriveShape& shape) {
    return p.speed_rpm * thinning(context, p, shape[0]);
  });
  f.shape_values = {{.continuous = true, .limits = rate_limits}};
  f.references = mean_temperature;
  f.calibrate = [](CalibratedLosses& c, const DriveShape& shape, double b) {
    return CalibratedLosses::add(c.losses.viscous_nm_per_rpm, c.at_reference(b, shape[0]),
                                 c.losses.viscous_per_c, shape[0]);
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
