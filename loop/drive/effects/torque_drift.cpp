// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

namespace {

DriveFamily drift(bool input) {
  DriveFamily f;
  f.id = "torque_drift";
  f.description = input ? "the input's torque drifts over the run: this much more at its end"
                        : "the output's torque drifts over the run: this much more at its end";
  f.cause = "a sensor or its amplifier that warms up, a zero that creeps under load";
  f.correction = "warm the sensor up, zero it between set points; take the set points in shuffled order and the "
                 "first ones again at the end";
  f.parameters = {"drift_nm"};
  f.side = input ? "input" : "output";
  f.is_loss = false;
  f.preference = 4;
  f.shapes = where_rows_follow_each_other;
  f.evaluate = [input](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = p.taken * context.misread(p, input);
  };
  f.into_state = [input](DriveState& state, const DriveShape&, double b) {
    (input ? state.input_drift_nm : state.output_drift_nm) = b;
  };
  f.told = [input](const DriveContext&, const DriveShape&, double b,
                   const std::vector<Parameter>&) {
    return std::string(input ? "the input's" : "the output's") + " torque drifts: it reads " +
           printed("%.3g", std::abs(b)) + " N m too " + (b > 0.0 ? "high" : "low") +
           " at the end of the file if it was right at its start";
  };
  f.not_carried = kOfTheBench;
  const std::string at_rest =
      "a reading of both torques at rest with nothing on the shafts, before the run and after (the "
      "sensor whose zero "
      "moved drifts)";
  f.told_from = {{of_side("torque_drift", "input"), at_rest},
                 {of_side("torque_drift", "output"), at_rest},
                 {"torque_offset", "the first set points again at the end"},
                 {"drag_drift", "a zero reading at rest before and after the run"},
                 {"temperature_drag", "the same set points cold and warm, temperature_c logged"}};
  return f;
}

}  // namespace

DriveFamily input_torque_drift() { return drift(true); }
DriveFamily output_torque_drift() { return drift(false); }

}  // namespace trueflank::loop::drive_effects
