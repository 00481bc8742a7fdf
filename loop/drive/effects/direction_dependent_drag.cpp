// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily direction_dependent_drag() {
  DriveFamily f;
  f.id = "direction_dependent_drag";
  f.description = "the drag at the input is larger when the output drives: backward less forward";
  f.cause = "seals or one-way parts, a brake's magnet";
  f.correction = "run both senses of rotation: a sensor's zero changes sides, a drag does not";
  f.parameters = {"difference_nm"};
  f.preference = 4;
  f.differs_by_direction = true;
  f.told = [](const DriveContext&, const DriveShape&, double more, const auto&) {
    return std::string("the drag at the input is larger when the ") +
           (more > 0.0 ? "output" : "input") + printed(" drives, by %.3g N m", std::abs(more));
  };
  f.shapes = [](const DriveContext& context) {
    return context.table.has(true) && context.table.has(false)
               ? std::vector<DriveShape>{{}}
               : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = -context.lever(p) * (p.forward ? -0.5 : 0.5);
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
