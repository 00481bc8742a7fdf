// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

namespace {

DriveFamily offset(bool input) {
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
  f.evaluate = [input](const DriveContext& context, const BenchPoint& p, const DriveShape&, double* c) {
    c[0] = context.misread(p, input);
  };
  f.into_state = [input](DriveState& state, const DriveShape&, double b) {
    (input ? state.input_zero_nm : state.output_zero_nm) = b;
  };
  f.told = [input](const DriveContext&, const DriveShape&, double b,
                   const std::vector<Parameter>&) {
    return std::string(input ? "the input's" : "the output's") + " torque reads " +
           printed("%.3g", std::abs(b)) + " N m too " + (b > 0.0 ? "high" : "low");
  };
  f.not_carried = kOfTheBench;
  const std::string at_rest =
      "a reading of both torques at rest with nothing on the shafts (the sensor that does not read "
      "0 has the zero)";
  f.told_from = {
      {of_side("torque_offset", "input"), at_rest},
      {of_side("torque_offset", "output"), at_rest},
      {"drag_torque", "both directions, and a zero reading at rest"},
      {"direction_dependent_drag", "both senses of rotation, and a zero reading at rest"},
      {"torque_scale", "a sweep of the load, zero included"}};
  return f;
}

}  // namespace

DriveFamily input_torque_offset() { return offset(true); }
DriveFamily output_torque_offset() { return offset(false); }

}  // namespace trueflank::loop::drive_effects
