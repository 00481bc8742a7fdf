// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A sensor that sits askew on its shaft, or reads another torque at every angle: a wave of its reading, not
// of the loss. The two differ in that a reading is too high with the power either way, a loss takes power
// either way, so only both directions tell them apart.
namespace trueflank::loop::drive_effects {

namespace {

DriveFamily wave_of_reading(bool input) {
  DriveFamily f;
  f.id = "torque_wave";
  f.description = input ? "the input's torque reads too high and too low with the angle of its shaft"
                        : "the output's torque reads too high and too low with the angle of its shaft";
  f.cause = "a sensor or coupling that sits askew or off centre, a sensor's own wave over its turn";
  f.correction = "align the sensor; turn it on its shaft and measure again";
  f.parameters = {"amplitude_nm", "phase_deg"};
  f.shape_names = {"order", "with_load"};
  f.form = ParameterForm::kWave;
  f.side = input ? "input" : "output";
  f.is_loss = false;
  f.preference = 3;
  f.shapes = [input](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    const BenchTable& table = context.table;
    if (!table.has_angle || !table.has(true) || !table.has(false)) return shapes;
    for (const double times : {1.0, 2.0}) {
      const double order = input ? times : times / context.model.ratio;
      const bool whole = std::abs(order - std::round(order)) < 1e-9;
      if (table.turns <= 1.01 ? !whole : table.turns * order < 1.5) continue;
      shapes.push_back({order, 0.0});
      shapes.push_back({order, 1.0});
    }
    return shapes;
  };
  f.evaluate = [input](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
    double size = context.misread(p, input);
    if (shape[1] != 0.0) size *= p.load_nm / context.table.most_load_nm;
    c[0] = size * std::cos(shape[0] * p.angle_rad);
    c[1] = size * std::sin(shape[0] * p.angle_rad);
  };
  f.order = first_value;
  f.words = [](const DriveModel& model, const DriveShape& shape, const DriveContext*) {
    return wave_in_words(model, shape[0]) + (shape[1] != 0.0 ? ", in proportion to the load" : "");
  };
  f.detail = [words = f.words](const DriveModel& model, const DriveShape& shape) {
    return ": " + words(model, shape, nullptr);
  };
  f.not_carried = kOfTheBench;
  f.told_from = {{"angle_periodic_friction",
                  "the same run with the sensor turned on its shaft, or both sensors without the gearbox"}};
  return f;
}

}  // namespace

DriveFamily input_torque_wave() { return wave_of_reading(true); }
DriveFamily output_torque_wave() { return wave_of_reading(false); }

}  // namespace trueflank::loop::drive_effects
