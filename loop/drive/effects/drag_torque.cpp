// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily drag_torque() {
  DriveFamily f;
  f.id = "drag_torque";
  f.description = "a drag at the input, the same at every load and speed";
  f.cause = "preload of bearings, seals, teeth without backlash, grease";
  f.correction = "check preload, seals, backlash and filling";
  f.follows = "nothing";
  f.parameters = {"torque_nm"};
  f.only_positive = true;
  f.evaluate = loss([](auto&, auto&, auto&) { return 1.0; });
  f.calibrate = [](CalibratedLosses& c, const DriveShape&, double b) {
    return CalibratedLosses::add(c.losses.drag_torque_nm, b, c.losses.drag_per_c, 0.0);
  };
  f.told_from = {{"friction_coefficient", "a sweep of the load, no load included"},
                 {"viscous_drag", "a sweep of the speed"},
                 {"load_dependent_friction", "more loads, no load included"},
                 {"temperature_drag", "the same set points cold and warm, temperature_c logged"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
