// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trueflank/loop/bench_table.h"
#include "trueflank/loop/drive_model.h"

namespace trueflank::loop {

/// Efficiencies of a drive's meshes over their common friction, tabulated once.
class EfficiencyCurve {
 public:
  explicit EfficiencyCurve(const DriveModel& model);
  /// Accuracy: 1e-7 for friction up to 0.6 (cubic between steps of 0.02); beyond, the end's value.
  [[nodiscard]] double at(bool forward, double friction) const;

 private:
  std::vector<double> forward_, backward_;
};

/// What is found so far of all that changes friction, and of the scale: about it effects are linear.
struct DriveState {
  double shift = 0.0;        ///< friction_coefficient less the design's
  double difference = 0.0;   ///< direction_dependent_friction
  double load_value = 0.0, load_exponent = 1.0;     ///< load_dependent_friction
  double mixed_value = 0.0, mixed_speed_rpm = 1.0;  ///< mixed_friction
  double scale = 1.0;
};

/// Where columns are evaluated: the drive, the bench's extent, the state.
struct DriveContext {
  const DriveModel& model;
  const EfficiencyCurve& curve;
  const BenchTable& table;
  const std::vector<DriveEfficiency>& mesh_slopes;  ///< of efficiency over one mesh's friction alone
  DriveState state;

  /// The meshes' friction at a point: as designed, and as the state has it.
  [[nodiscard]] double designed_friction(const BenchPoint& p) const {
    return model.friction_at(p.at());
  }
  [[nodiscard]] double friction(const BenchPoint& p) const;
  [[nodiscard]] double efficiency(const BenchPoint& p) const { return curve.at(p.forward, friction(p)); }
  /// Driven torque per unit of driving torque of the lossless drive.
  [[nodiscard]] double gain(const BenchPoint& p) const {
    return p.forward ? model.ratio : 1.0 / model.ratio;
  }
  /// N m on the driven side per N m lost at the input.
  [[nodiscard]] double lever(const BenchPoint& p) const {
    return p.forward ? model.ratio * efficiency(p) : 1.0;
  }
  /// Change of the driven torque for a unit of mesh friction: the secant from the design to the state, so
  /// that effects whose sum is the state's are exact.
  [[nodiscard]] double friction_slope(const BenchPoint& p) const;
  /// -1 ... 1 over the bench's loads and speeds (logarithmic where they span decades), temperatures.
  [[nodiscard]] double load_coordinate(const BenchPoint& p) const;
  [[nodiscard]] double speed_coordinate(const BenchPoint& p) const;
  [[nodiscard]] double temperature_coordinate(const BenchPoint& p) const;
  /// The other way: the load, speed or temperature (over = 0, 1, 2) at a coordinate.
  [[nodiscard]] double quantity_at(double over, double coordinate) const;
};

/// Slopes of the efficiencies at the designed friction over one mesh's friction alone.
[[nodiscard]] std::vector<DriveEfficiency> mesh_slopes(const DriveModel& model);
/// Driven torque of the model as designed [N m].
[[nodiscard]] double predicted_nm(const DriveModel& model, const EfficiencyCurve& curve,
                                  const BenchPoint& p);

enum class DriveForm { kPlain, kWave };

/// One kind of effect of a drive. Columns: change of the driven torque [N m] per unit coefficient.
struct DriveFamily {
  std::string id;
  std::string description, cause, correction;
  std::vector<std::string> parameters;   ///< kPlain: one a column; kWave: amplitude, phase
  std::vector<std::string> shape_names = {};
  std::vector<bool> shape_continuous = {};  ///< per shape value: refined after the choice
  DriveForm form = DriveForm::kPlain;
  std::string side = {};         ///< of sensor effects: input or output
  bool is_loss = true;           ///< takes power: never fitted to data that gain power
  bool only_positive = false;    ///< a negative coefficient is not this effect
  bool named = true;
  int preference = 0;
  double base = 0.0;             ///< added to the coefficient in the report (factor: 1)
  std::function<std::vector<std::vector<double>>(const DriveContext&)> shapes = {};
  std::function<int(const std::vector<double>& shape)> columns = {};
  std::function<void(const DriveContext&, const BenchPoint&, const std::vector<double>& shape,
                     double* columns)>
      evaluate = {};
};

struct DriveEffect {
  const DriveFamily* family = nullptr;
  std::vector<double> shape;
  [[nodiscard]] int columns() const { return family->columns(shape); }
};

/// The library: loss effects, sensor effects, free form. Lives as long as the program.
[[nodiscard]] const std::vector<DriveFamily>& drive_library();
[[nodiscard]] const DriveFamily* find_drive_family(const std::string& id);
/// Every candidate that this bench's columns can carry.
[[nodiscard]] std::vector<DriveEffect> drive_candidates(const DriveContext& context);

/// @name Parts of the library
/// @{
[[nodiscard]] std::vector<DriveFamily> drive_loss_effects();
[[nodiscard]] std::vector<DriveFamily> drive_sensor_effects();
[[nodiscard]] std::vector<DriveFamily> drive_free_effects();
/// @}

}  // namespace trueflank::loop
