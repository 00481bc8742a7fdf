// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily viscous_drag() {
  DriveFamily f;
  f.id = "viscous_drag";
  f.description = "a torque at the input that grows with speed";
  f.cause = "lubricant's viscosity and filling";
  f.correction = "thinner or less lubricant";
  f.follows = "speed";
  f.parameters = {"nm_per_rpm"};
  f.only_positive = true;
  f.preference = 1;
  f.evaluate = loss([](auto&, const BenchPoint& p, auto&) { return p.speed_rpm; });
  f.calibrate = [](CalibratedLosses& c, const DriveShape&, double b) {
    return CalibratedLosses::add(c.losses.viscous_nm_per_rpm, b, c.losses.viscous_per_c, 0.0);
  };
  f.told_from = {{"bearing_friction", "speeds over two decades"},
                 {"temperature_viscosity", "the same speeds cold and warm, temperature_c logged"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
