// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily direction_dependent_friction() {
  DriveFamily f;
  f.id = "direction_dependent_friction";
  f.description = "the flanks rub more when the output drives: friction backward less forward";
  f.cause = "friction of approach above that of recess, edges of the tips, lubrication";
  f.correction = "relieve the tips of the teeth; more recess than approach";
  f.parameters = {"difference"};
  f.told = [](const DriveContext& context, const DriveShape&, double difference, const auto&) {
    const double mean = context.model.friction + context.state.shift;
    const bool output = difference > 0.0;
    return std::string("the flanks rub more when the ") + (output ? "output" : "input") +
           " drives: " +
           printed("%.3g against %.3g when the ", mean + 0.5 * std::abs(difference),
                   mean - 0.5 * std::abs(difference)) +
           (output ? "input" : "output") +
           printed(" does (friction backward less forward: difference %.3g)", difference);
  };
  f.preference = 3;
  f.shapes = [](const DriveContext& context) {
    return context.table.has(true) && context.table.has(false) ? std::vector<DriveShape>{{}} : std::vector<DriveShape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = context.friction_slope(p) * (p.forward ? -0.5 : 0.5);
  };
  f.plausible = [](const DriveModel&, const DriveShape&, double difference) {
    return std::abs(difference) < kMostFriction;
  };
  f.hides_in_gains = true;
  f.differs_by_direction = true;
  f.into_state = [](DriveState& state, const DriveShape&, double b) { state.difference = b; };
  f.calibrate = [](CalibratedLosses& c, const DriveShape&, double b) {
    c.friction_difference += b;
    return true;
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
