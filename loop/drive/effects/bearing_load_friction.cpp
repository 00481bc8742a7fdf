// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily bearing_load_friction() {
  DriveFamily f;
  f.id = "bearing_load_friction";
  f.description = "a torque at the input in proportion to what the output carries";
  f.cause = "rolling bearings under load (Palmgren's load-dependent part)";
  f.correction = "larger pitch, fewer or smaller bearings";
  f.follows = "load";
  f.parameters = {"share"};
  f.only_positive = true;
  f.preference = 4;
  f.evaluate = loss([](const DriveContext& context, const BenchPoint& p, auto&) {
    return (p.forward ? context.efficiency(p) : 1.0) * context.load_nm(p);
  });
  // Rolling bearings lose far less of what they carry; plain ones about so much.
  f.plausible = [](const DriveModel&, const DriveShape&, double share) { return share < 0.05; };
  f.calibrate = [](CalibratedLosses& c, const DriveShape&, double b) {
    c.losses.bearing_load_share += b;
    return true;
  };
  f.told_from = {{"friction_coefficient", "teeth and bearings apart: another bearing, or the planets' teeth out of mesh"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
