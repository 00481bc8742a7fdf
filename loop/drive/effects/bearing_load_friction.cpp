// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

namespace {

/// Of which torque bearings lose a share: what the output carries, the input's, the torque of the
/// side that drives.
enum Carried { kByOutput, kByInput, kDriving };

}  // namespace

DriveFamily bearing_load_friction() {
  DriveFamily f;
  f.id = "bearing_load_friction";
  f.description = "a torque at the input in proportion to what bearings carry";
  f.cause = "rolling bearings under load (Palmgren's load-dependent part)";
  f.correction = "larger pitch, fewer or smaller bearings";
  f.follows = "load";
  f.parameters = {"share"};
  f.shape_names = {"carried"};
  f.shape_where_absent = {double(kByOutput)};
  f.only_positive = true;
  f.preference = 4;
  f.shapes = [](const DriveContext& context) {
    const bool both = context.table.has(true) && context.table.has(false);
    return both ? std::vector<DriveShape>{{double(kByOutput)}, {double(kByInput)}, {double(kDriving)}}
                : std::vector<DriveShape>{{double(kByOutput)}};
  };
  f.evaluate = loss([](const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
    const bool whole = s[0] == double(kDriving) || p.forward == (s[0] == double(kByInput));
    return (whole ? 1.0 : context.efficiency(p)) * context.load_nm(p);
  });
  f.detail = [](const DriveModel&, const DriveShape& s) {
    return std::string(s[0] == double(kByOutput)  ? ": the output's torque"
                       : s[0] == double(kByInput) ? ": the input's torque"
                                                  : ": the torque of the side that drives");
  };
  // Rolling bearings lose far less of what they carry; plain ones about so much.
  f.plausible = [](const DriveModel&, const DriveShape&, double share) { return share < 0.05; };
  f.calibrate = [](CalibratedLosses& c, const DriveShape& s, double b) {
    if (s[0] != double(kByOutput)) return false;
    c.losses.bearing_load_share += b;
    return true;
  };
  f.not_carried = "a design's [losses] have a share of the output's torque alone";
  f.told_from = {{"friction_coefficient", "teeth and bearings apart: another bearing, or the planets' teeth out of mesh"},
                 {"mesh_friction", "teeth and bearings apart: another bearing, or the planets' teeth out of mesh"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
