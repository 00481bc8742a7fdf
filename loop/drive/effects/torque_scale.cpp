// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

DriveFamily torque_scale() {
  DriveFamily f;
  f.id = "torque_scale";
  f.description =
      "the output's torque reads this many times too much against the input's (or the input's as many "
      "times too little: a bench of two sensors shows only their ratio)";
  f.cause = "torque constant of a motor, calibration of a torque sensor, ratio of a belt";
  f.correction = "calibrate both torques against a lever and weights";
  f.parameters = {"factor"};
  f.side = "output";
  f.is_loss = false;
  f.preference = 3;
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = context.gain(p) * context.efficiency(p) * p.driving_nm;
    if (!p.forward) c[0] /= -context.state.scale;
  };
  f.base = [](const DriveContext&) { return 1.0; };
  f.into_state = [](DriveState& state, const DriveShape&, double b) {
    state.scale = std::clamp(1.0 + b, 0.2, 5.0);
  };
  f.told = [](const DriveContext&, const DriveShape&, double more, const auto&) {
    const char *one = more > 0.0 ? "much" : "little", *other = more > 0.0 ? "little" : "much";
    return printed("the output's torque reads %.2g %% too ", 100.0 * std::abs(more)) + one +
           printed(" against the input's (factor %.4g), or the input's as much too ", 1.0 + more) +
           other + " (two sensors show only their ratio)";
  };
  f.not_carried = kOfTheBench;
  f.told_from = {{"friction_coefficient",
                  "both directions, or each torque against a lever and weights, or without the gearbox"},
                 {"direction_dependent_friction",
                  "each torque against a lever and weights, or a run without the gearbox, or with the two "
                  "sides' roles swapped"},
                 {"swapped_side", "the other direction too"}};
  return f;
}

}  // namespace trueflank::loop::drive_effects
