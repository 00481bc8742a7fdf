// SPDX-License-Identifier: GPL-3.0-or-later
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
  f.not_carried = kOfTheBench;
  f.told_from = {{"torque_offset", "the first set points again at the end"},
                 {"drag_drift", "a zero reading at rest before and after the run"},
                 {"temperature_drag", "the same set points cold and warm, temperature_c logged"}};
  return f;
}

}  // namespace

DriveFamily input_torque_drift() { return drift(true); }
DriveFamily output_torque_drift() { return drift(false); }

}  // namespace trueflank::loop::drive_effects
