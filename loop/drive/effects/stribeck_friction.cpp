// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily stribeck_friction() {
  DriveFamily f;
  f.id = "stribeck_friction";
  f.description = "a torque at the input that fades as the drive speeds up";
  f.law = "torque_nm exp(-(n / speed_rpm)^exponent)";
  f.cause = "boundary lubrication at low speed";
  f.correction = "lubricant with better boundary film, smoother flanks and seals";
  f.follows = "speed";
  f.parameters = {"torque_nm"};
  f.shape_names = {"speed_rpm", "exponent"};
  f.only_positive = true;
  f.preference = 2;
  f.shapes = fading_shapes;
  f.evaluate = loss([](auto&, const BenchPoint& p, const DriveShape& shape) {
    return faded(p.speed_rpm, shape[0], shape[1]);
  });
  f.shape_values = {{.continuous = true, .limits = speed_limits}, {}};
  f.calibrate = [](CalibratedLosses& c, const DriveShape& shape, double b) {
    return shape[1] == 2.0 && CalibratedLosses::add(c.losses.stribeck_torque_nm, b,
                                                    c.losses.stribeck_speed_rpm, shape[0]);
  };
  f.told_from = {{"viscous_drag", "speeds over two decades, creeping included"},
                 {"mixed_friction", "a sweep of the load at creeping speed"}};
  f.not_carried = kFadesOtherwise;
  return f;
}

}  // namespace trueflank::loop::drive_effects
