// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "trueflank/loop/drive/bench_table.h"
#include "trueflank/loop/drive/drive_model.h"
#include "trueflank/loop/drive/efficiency_curve.h"
#include "trueflank/loop/drive/last_values.h"

// Where the effects of a drive are asked what they do: the drive, its bench, what is found so far.
namespace trueflank::loop {

/// exp(-(n/n0)^exponent) of a speed, by the exponent 1 or 2.
[[nodiscard]] double faded(double speed_rpm, double scale_rpm, double exponent);

/// What is found so far of all that changes friction, and of what the sensors misread: about it
/// effects are linear.
struct DriveState {
  double shift = 0.0;                            ///< friction_coefficient less the design's
  double difference = 0.0;                       ///< direction_dependent_friction
  double load_value = 0.0, load_exponent = 1.0;  ///< load_dependent_friction
  double mixed_value = 0.0, mixed_speed_rpm = 1.0, mixed_exponent = 2.0;  ///< mixed_friction
  double speed_share = 0.0, speed_bend = 1.0;  ///< unnamed_friction_by_speed
  double scale = 1.0;
  double input_zero_nm = 0.0, output_zero_nm = 0.0;    ///< torque_offset
  double input_drift_nm = 0.0, output_drift_nm = 0.0;  ///< torque_drift
  std::map<std::size_t, double> mesh_value = {};  ///< mesh_friction, of the meshes that have any
  bool operator==(const DriveState&) const = default;
};

/// Where columns are evaluated: the drive, the bench's extent, the state. What was asked of rows is
/// kept: another state is another context.
struct DriveContext {
  const DriveModel& model;
  const EfficiencyCurve& curve;
  const BenchTable& table;
  const std::vector<EfficiencyCurve>& mesh_curves;  ///< over one mesh's friction alone
  DriveState state;
  mutable LastEfficiency last_forward{true}, last_backward{false};
  mutable LastValues last_speeds = {}, last_speed_coordinates = {};  ///< of this table
  mutable LastRows<char> last_switched = {};                         ///< of this table
  mutable LastRows<int> last_rows_since = {};
  mutable LastRows<double> last_powers = {}, last_memories = {}, last_shares = {};
  mutable RowValues row_efficiencies = {}, row_friction_slopes = {},
                    row_flank_changes = {};  ///< of this table and state

  [[nodiscard]] DriveContext in_state(const DriveState& other) const {
    return {model, curve, table, mesh_curves, other};
  }
  /// The meshes' friction at a point: as designed, and as the state has it.
  [[nodiscard]] double designed_friction(const BenchPoint& p) const {
    return model.friction_at(p.at());
  }
  [[nodiscard]] double friction(const BenchPoint& p) const;
  [[nodiscard]] double efficiency(const BenchPoint& p) const {
    return row_efficiencies.of(table.points, p, [&] { return last(p).at(curve, friction(p)); });
  }
  [[nodiscard]] LastEfficiency& last(const BenchPoint& p) const {
    return p.forward ? last_forward : last_backward;
  }
  /// Driven torque per unit of driving torque of the lossless drive.
  [[nodiscard]] double gain(const BenchPoint& p) const {
    return p.forward ? model.ratio : 1.0 / model.ratio;
  }
  /// N m that the driven side reads less per N m lost at the input.
  [[nodiscard]] double lever(const BenchPoint& p) const {
    return p.forward ? model.ratio * efficiency(p) * state.scale : 1.0;
  }
  /// N m that the driven side reads more than predicted per N m that a side reads too much.
  [[nodiscard]] double misread(const BenchPoint& p, bool input) const {
    if (input != p.forward) return 1.0;
    // What the driving side reads too much is missed on the driven side.
    return -gain(p) * efficiency(p) * (p.forward ? state.scale : 1.0 / state.scale);
  }
  /// The load without what the driving side's sensor misreads.
  [[nodiscard]] double load_nm(const BenchPoint& p) const {
    if (p.forward) return p.load_nm - state.input_zero_nm - p.taken * state.input_drift_nm;
    const double misread_nm = state.output_zero_nm + p.taken * state.output_drift_nm;
    return (p.load_nm - misread_nm / model.ratio) / state.scale;
  }
  /// (n / n_middle)^-bend - 1 over the bend: 0 in the geometric middle of the bench's speeds.
  [[nodiscard]] double course_of_speed(double speed_rpm, double bend) const;
  /// Change of the driven torque for a unit of mesh friction: the secant from the design to the
  /// state, so that effects whose sum is the state's are exact.
  [[nodiscard]] double friction_slope(const BenchPoint& p) const;
  /// The same for one mesh's friction.
  [[nodiscard]] double mesh_slope(const BenchPoint& p, std::size_t mesh) const;
  /// -1 ... 1 over the bench's loads and speeds (logarithmic where they span decades),
  /// temperatures.
  [[nodiscard]] double load_coordinate(const BenchPoint& p) const;
  [[nodiscard]] double speed_coordinate(const BenchPoint& p) const;
  [[nodiscard]] double temperature_coordinate(const BenchPoint& p) const;
  /// The other way: the load, speed or temperature (over = 0, 1, 2) at a coordinate.
  [[nodiscard]] double quantity_at(double over, double coordinate) const;
  /// The coordinate of a load, speed or temperature.
  [[nodiscard]] double coordinate_of(double over, double quantity) const;
  /// 0 ... 1 from no load, from the lowest speed or temperature on to the highest, evenly. Of loads
  /// it is what the output carries, as the lossless drive passes it to the input.
  [[nodiscard]] double share_of_range(const BenchPoint& p, double over) const;
  [[nodiscard]] double share_at(double over, double quantity) const;
  [[nodiscard]] double quantity_at_share(double over, double share) const;
  /// Of the lowest load, speed or temperature.
  [[nodiscard]] double least_share(double over) const;
};

/// Of every mesh, in the model's order; of one mesh alone none is needed.
[[nodiscard]] std::vector<EfficiencyCurve> mesh_curves(const DriveModel& model);
/// Driven torque of the model as designed [N m].
[[nodiscard]] double predicted_nm(const DriveModel& model, const EfficiencyCurve& curve,
                                  const BenchPoint& p);

}  // namespace trueflank::loop
