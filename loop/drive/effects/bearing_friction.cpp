// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily bearing_friction() {
  DriveFamily f;
  f.id = "bearing_friction";
  f.description = "a torque at the input that grows with the 2/3 power of speed";
  f.cause = "lubricated rolling bearings (Palmgren's load-independent part)";
  f.correction = "bearing size, seals, viscosity";
  f.follows = "speed";
  f.parameters = {"nm_at_1000_rpm"};
  f.only_positive = true;
  f.preference = 2;
  f.evaluate = loss([](auto&, const BenchPoint& p, auto&) {
    return std::pow(p.speed_rpm / 1000.0, 2.0 / 3.0);
  });
  f.calibrate = [](CalibratedLosses& c, const DriveShape&, double b) {
    c.losses.bearing_nm_at_1000_rpm += b;
    return true;
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
