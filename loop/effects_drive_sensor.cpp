// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/loop/drive_effect.h"

// What is wrong with the bench, not with the drive.
namespace trueflank::loop {
namespace {

using Shape = std::vector<double>;

DriveFamily torque_scale() {
  DriveFamily f;
  f.id = "torque_scale";
  f.description =
      "the output's torque reads this many times too much against the input's (or the input's as many "
      "times too little: a bench of two sensors tells only their ratio)";
  f.cause = "torque constant of a motor, calibration of a torque sensor, ratio of a belt";
  f.correction = "calibrate both torques against a lever and weights";
  f.parameters = {"factor"};
  f.side = "output";
  f.is_loss = false;
  f.preference = 3;
  f.base = 1.0;
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape&, double* c) {
    c[0] = context.gain(p) * context.efficiency(p) * p.driving_nm;
    if (!p.forward) c[0] /= -context.state.scale;
  };
  return f;
}

DriveFamily torque_offset(bool input) {
  DriveFamily f;
  f.id = "torque_offset";
  f.description = input ? "the input's torque reads this much too high"
                        : "the output's torque reads this much too high";
  f.cause = "zero of the sensor or of a motor current";
  f.correction = "zero the sensor before each run; run both senses of rotation";
  f.parameters = {"offset_nm"};
  f.side = input ? "input" : "output";
  f.is_loss = false;
  f.preference = 3;
  f.evaluate = [input](const DriveContext& context, const BenchPoint& p, const Shape&, double* c) {
    // What the driving side reads too much is missed on the driven side.
    c[0] = input != p.forward ? 1.0 : -context.gain(p) * context.efficiency(p);
  };
  return f;
}

DriveFamily directional_drag() {
  DriveFamily f;
  f.id = "direction_dependent_drag";
  f.description = "the drag at the input is larger when the output drives: backward less forward";
  f.cause = "seals or one-way parts, a brake's magnet";
  f.correction = "run both senses of rotation: a sensor's zero changes sides, a drag does not";
  f.parameters = {"difference_nm"};
  f.preference = 4;
  f.shapes = [](const DriveContext& context) {
    return context.table.has(true) && context.table.has(false)
               ? std::vector<Shape>{{}}
               : std::vector<Shape>{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape&, double* c) {
    c[0] = -context.lever(p) * (p.forward ? -0.5 : 0.5);
  };
  return f;
}

}  // namespace

std::vector<DriveFamily> drive_sensor_effects() {
  return {torque_scale(), torque_offset(true), torque_offset(false), directional_drag()};
}

}  // namespace trueflank::loop
