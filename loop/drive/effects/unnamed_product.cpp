// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss in proportion to torque and speed together: flanks or bearings that rub more the faster
// they turn, a lubricant film that starves. The sloping forms over load and speed hold it in four
// columns together only, and two of these look like a friction and a viscous drag.
namespace trueflank::loop::drive_effects {

DriveFamily unnamed_product() {
  constexpr double kLeastSpread = 2.0;
  constexpr int kFewestLevels = 3;
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shapes = [](const DriveContext& context) {
    const BenchTable& table = context.table;
    const bool shows = table.most_speed_rpm > kLeastSpread * table.least_speed_rpm &&
                       table.levels[0] >= kFewestLevels && table.levels[1] >= kFewestLevels;
    return shows ? std::vector<DriveShape>{{}} : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = -context.lever(p) * (p.load_nm / context.table.most_load_nm) *
           (p.speed_rpm / context.table.most_speed_rpm);
  };
  f.beside_load = [](const DriveShape&) { return 1.0; };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("in proportion to the load times the speed");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 1.0, 0.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
