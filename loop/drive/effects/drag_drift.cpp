// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily drag_drift() {
  DriveFamily f;
  f.id = "drag_drift";
  f.description = "the drag at the input changes over the run: this much more at its end";
  f.cause = "grease that warms and spreads, seals and teeth that run in";
  f.correction = "run the drive in and warm before measuring; log temperature_c";
  f.parameters = {"drift_nm"};
  f.preference = 4;
  f.told = [](const DriveContext&, const DriveShape&, double more, const auto&) {
    return std::string("the drag at the input ") + (more > 0.0 ? "grows" : "falls") +
           printed(" over the run, by %.3g N m to its end", std::abs(more));
  };
  f.follows_the_run = true;
  f.shapes = where_rows_follow_each_other;
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = -context.lever(p) * p.taken;
  };
  f.not_carried = "it belongs to the run: the same drive warm has none";
  f.told_from = {{"torque_drift", "a zero reading at rest before and after the run"},
                 {"temperature_drag", "the same set points cold and warm, temperature_c logged"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
