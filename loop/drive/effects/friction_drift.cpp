// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily friction_drift() {
  DriveFamily f;
  f.id = "friction_drift";
  f.description = "the flanks' coefficient of friction changes over the run: this much more at its end";
  f.cause = "flanks that wear or run in, a lubricant that warms or was changed";
  f.correction = "run the drive in; take the first set points again at the end; log temperature_c";
  f.parameters = {"drift"};
  f.preference = 4;
  f.drifts = true;
  f.told = [](const DriveContext&, const DriveShape&, double more, const auto&) {
    return std::string("the flanks' coefficient of friction ") + (more > 0.0 ? "grows" : "falls") +
           printed(" over the run, by %.3g to its end", std::abs(more));
  };
  f.shapes = where_rows_follow_each_other;
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = context.friction_slope(p) * p.taken;
  };
  f.not_carried = "it belongs to the run: the same drive run in has none";
  f.told_from = {{"drag_drift", "a sweep of the load at the beginning and at the end"},
                 {"temperature_viscosity", "the same set points cold and warm, temperature_c logged"},
                 {"torque_scale", "each torque against a lever and weights before and after the run"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
