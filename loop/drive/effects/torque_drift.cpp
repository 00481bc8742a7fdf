// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

namespace {

/// Fewer set points than this, and any slope over the rows looks like a drift.
constexpr int kFewestUnits = 8;

std::vector<DriveShape> where_rows_follow_each_other(const DriveContext& context) {
  return context.table.units >= kFewestUnits ? std::vector<DriveShape>{{}} : std::vector<DriveShape>{};
}

DriveFamily drift(bool input) {
  DriveFamily f;
  f.id = "torque_drift";
  f.description = input ? "the input's torque reads more and more over the run: this much at its end"
                        : "the output's torque reads more and more over the run: this much at its end";
  f.cause = "a sensor or its amplifier that warms up, a zero that creeps under load";
  f.correction = "warm the sensor up, zero it between set points; take the set points in shuffled order and the "
                 "first ones again at the end";
  f.parameters = {"drift_nm"};
  f.side = input ? "input" : "output";
  f.is_loss = false;
  f.preference = 4;
  f.shapes = where_rows_follow_each_other;
  f.evaluate = [input](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = p.taken * (input != p.forward ? 1.0 : -context.gain(p) * context.efficiency(p));
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

DriveFamily drag_drift() {
  DriveFamily f;
  f.id = "drag_drift";
  f.description = "the drag at the input changes over the run: this much more at its end";
  f.cause = "grease that warms and spreads, seals and teeth that run in";
  f.correction = "run the drive in and warm before measuring; log temperature_c";
  f.parameters = {"drift_nm"};
  f.preference = 4;
  f.shapes = where_rows_follow_each_other;
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = -context.lever(p) * p.taken;
  };
  f.not_carried = "it belongs to the run: the same drive warm has none";
  f.told_from = {{"torque_drift", "a zero reading at rest before and after the run"},
                 {"temperature_drag", "the same set points cold and warm, temperature_c logged"}};
  return f;
}

DriveFamily friction_drift() {
  DriveFamily f;
  f.id = "friction_drift";
  f.description = "the flanks' coefficient of friction changes over the run: this much more at its end";
  f.cause = "flanks that wear or run in, a lubricant that warms or was changed";
  f.correction = "run the drive in; take the first set points again at the end; log temperature_c";
  f.parameters = {"drift"};
  f.preference = 4;
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
