// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/bench_table.h"
#include "trueflank/loop/drive/drive_model.h"
#include "trueflank/loop/drive/efficiency_curve.h"
#include "trueflank/loop/drive/last_values.h"
#include "trueflank/loop/result/effect_facts.h"
#include "trueflank/loop/result/loop_result.h"

namespace trueflank::loop {

/// exp(-(n/n0)^exponent) of a speed, by the exponent 1 or 2.
[[nodiscard]] double faded(double speed_rpm, double scale_rpm, double exponent);

/// What is found so far of all that changes friction, and of what the sensors misread: about it effects are linear.
struct DriveState {
  double shift = 0.0;        ///< friction_coefficient less the design's
  double difference = 0.0;   ///< direction_dependent_friction
  double load_value = 0.0, load_exponent = 1.0;     ///< load_dependent_friction
  double mixed_value = 0.0, mixed_speed_rpm = 1.0, mixed_exponent = 2.0;  ///< mixed_friction
  double scale = 1.0;
  double input_zero_nm = 0.0, output_zero_nm = 0.0;    ///< torque_offset
  double input_drift_nm = 0.0, output_drift_nm = 0.0;  ///< torque_drift
  std::map<std::size_t, double> mesh_value = {};       ///< mesh_friction, of the meshes that have any
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
  [[nodiscard]] LastEfficiency& last(const BenchPoint& p) const { return p.forward ? last_forward : last_backward; }
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
  /// Change of the driven torque for a unit of mesh friction: the secant from the design to the state, so
  /// that effects whose sum is the state's are exact.
  [[nodiscard]] double friction_slope(const BenchPoint& p) const;
  /// The same for one mesh's friction.
  [[nodiscard]] double mesh_slope(const BenchPoint& p, std::size_t mesh) const;
  /// -1 ... 1 over the bench's loads and speeds (logarithmic where they span decades), temperatures.
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

inline constexpr double kOverNothing = -1.0, kOverSeveral = -2.0;

/// Shape values of an effect: speed, exponent, mesh, order, ...
using DriveShape = std::vector<double>;

/// What is known of one shape value.
struct DriveShapeValue {
  bool continuous = false;  ///< refined after the choice
  bool is_place = false;    ///< a place in a range (-1 ... 1), moved by sums; else a size, by factors
  double reach = 0.3;       ///< how far a place moves at once
  std::function<std::pair<double, double>(const DriveContext&)> limits = {};  ///< where it means its name
};

/// A figure that a parameter needs to be read: the temperature or load it holds at.
using DriveReference = std::pair<std::string, double>;

struct CalibratedLosses;

/// One kind of effect of a drive. One object in one file of effects/, listed in effects/registry.cpp;
/// nothing else knows an effect by its name. Columns: change of the driven torque [N m] per unit
/// coefficient.
struct DriveFamily : EffectFacts {
  std::string side = {};                ///< of sensor effects: input or output
  bool is_loss = true;                  ///< takes power: never fitted to data that gain power
  /// What a loss follows: effects that follow the same are kin; empty: none of load, speed and warmth.
  std::string follows = {};
  /// True of a loss that follows the course of the run alone: a drive that warms up meanwhile does nearly
  /// the same.
  bool follows_the_run = false;
  bool differs_by_direction = false;    ///< a loss that does what a sensor does: data that gain power show the sensor
  bool drifts = false;  ///< a loss that changes evenly over the run: warmth may be the reason
  bool of_one_mesh = false;             ///< of the friction of one mesh alone
  bool bends_over_load = false;         ///< as a bent sensor does: told from that by the other direction alone
  bool hides_in_gains = false;          ///< a loss that data with gained power can neither show nor exclude

  /// @name Columns
  /// @{
  std::vector<DriveShapeValue> shape_values = {};  ///< as many as shape_names; empty: none is refined
  std::function<std::vector<DriveShape>(const DriveContext&)> shapes = {};
  std::function<int(const DriveShape&)> columns = {};
  std::function<void(const DriveContext&, const BenchPoint&, const DriveShape&, double* columns)>
      evaluate = {};
  /// False where an amount cannot be this effect; empty: any can.
  std::function<bool(const DriveModel&, double coefficient)> plausible = {};
  /// What moves the place about which the model is linear.
  std::function<void(DriveState&, const DriveShape&, double coefficient)> into_state = {};
  /// Over which quantity alone it has a course: load, speed or temperature (0, 1, 2); empty: none.
  std::function<double(const DriveShape&)> over = {};
  /// Of what has no course of its own but may be a piece of one: over which quantity; kOverNothing:
  /// the same everywhere; kOverSeveral: over more than one.
  std::function<double(const DriveShape&)> piece_over = {};
  /// Over which quantity it has a course in proportion to the load; kOverNothing, or empty: none.
  std::function<double(const DriveShape&)> beside_load = {};
  /// It has a place: told only where it leaves clearly less than what begins nowhere.
  bool has_a_place = false;
  std::function<bool(const DriveShape&)> begins_nowhere = {};
  /// Where it is nothing is a figure of its own, and stands for what is the same everywhere.
  bool holds_a_constant = false;
  /// Kinds of shapes of which each is tried by its own likeliest place; empty: there is one.
  std::function<int(const DriveShape&)> kind = {};
  /// Shapes that differ in their kind alone, tried once a place is found; empty: none.
  std::function<std::vector<DriveShape>(const DriveShape&)> kin_shapes = {};
  /// True of a shape that goes after a plainer one that explains as much; empty: none.
  std::function<bool(const DriveShape&)> is_odd = {};
  /// Waves per turn of the input; empty: it is none.
  std::function<double(const DriveShape&)> order = {};
  /// The shape of a wave that the spectrum proposes, the directions opposite or not; empty: it takes none.
  std::function<DriveShape(double order, bool opposite)> shape_of_wave = {};
  /// The shape of a part of the run (order 0) or of a turn, 0 ... 1, that a scan proposes; empty: it takes none.
  std::function<DriveShape(double what, double order, double begin, double length)> shape_of_spell = {};
  /// How often per turn of the input what it holds comes again; empty: it does not, or is a wave.
  std::function<double(const DriveShape&)> turns_per_turn = {};
  /// The shape of what dies away from every rest on that a scan proposes; empty: it takes none.
  std::function<DriveShape(double what, double period, double phase, double rows)> shape_of_rest =
      {};
  /// The shape of what is there at times and at times not, of the places of the run where it begins
  /// and ends in turn, that a scan proposes; empty: it takes none.
  std::function<DriveShape(double what, const std::vector<double>& changes)> shape_of_states = {};
  /// The shape of what stands at levels between which the run jumps, the largest of them 1, and the
  /// levels [N m at the input] of a shape; empty: it takes none.
  std::function<DriveShape(double what, const std::vector<double>& changes,
                           const std::vector<double>& levels)>
      shape_of_levels = {};
  /// What it leaves falls in steps over its place: it is sought among all of them.
  bool falls_in_steps = false;
  /// It jumps once in the course of the run, at its second shape value (-1 ... 1 over the run).
  bool jumps_in_run = false;
  /// At how many rows of the run it begins, ends or jumps, of a shape; empty: at none.
  std::function<double(const DriveShape&)> changes_in_run = {};
  /// A wave of another size in every row: asked in place of plain waves of about its order.
  bool is_wave_of_sizes = false;
  /// A wave of a part of the loads, speeds, temperatures or the run: asked by the spectra of parts.
  bool is_wave_of_part = false;
  /// A wave that is largest at a speed: asked at the orders of waves that were found.
  bool is_resonant_wave = false;
  /// Follows what the rows right before a row were.
  bool follows_rows_before = false;
  /// Short, and comes again over the angle at no turn of a shaft: found by a scan.
  bool comes_again_over_the_angle = false;
  /// Comes and goes over the run in waves that a scan finds.
  bool comes_again_over_the_run = false;
  /// Reads no more than so much of the output's torque.
  bool is_cap = false;
  /// Starts at rows of the run that a scan finds, and dies away.
  bool starts_in_run = false;
  /// The shapes by which it may be what a spectrum shows at an order; empty: none.
  std::function<std::vector<DriveShape>(const DriveContext&, double order)> shapes_at_order = {};
  /// Waves of an order whose phase goes with the load or the speed; empty: it is none of these.
  std::function<std::vector<DriveShape>(const DriveContext&, double order, double direction)>
      late_waves_at_order = {};
  /// Waves of an order that lie otherwise in one of several files; empty: it is none of these.
  std::function<std::vector<DriveShape>(const DriveContext&, double order, double direction)>
      turned_waves_at_order = {};
  /// The shape of a slow course of the run, a polynomial, that a scan proposes; empty: it takes none.
  std::function<DriveShape(double what, int degree)> shape_of_wander = {};
  /// @}

  /// @name How it is told
  /// @{
  std::function<double(const DriveContext&)> base = {};  ///< added to the coefficient in the report
  std::function<std::vector<DriveReference>(const DriveContext&)> references = {};
  /// Of its size, as a formula: told after the description.
  std::string law = {};
  /// Added to the description, of which mesh or order it is.
  std::function<std::string(const DriveModel&, const DriveShape&)> detail = {};
  /// In words, with figures of the bench where a context is given; empty: its id.
  std::function<std::string(const DriveModel&, const DriveShape&, const DriveContext*)> words = {};
  /// Effects without a name: the shapes of the terms it is written as, in the form of drive_term_keys().
  std::function<std::vector<DriveShape>(const DriveShape&)> term_shapes = {};
  /// Effects without a name: told as an effect of its own, not as a piece of another.
  bool stands_alone = false;
  /// Figures people know it by, of a shape and a coefficient: where it begins, how wide it is. One
  /// called amplitude_nm stands for the coefficient's size.
  std::function<std::vector<Parameter>(const DriveContext&, const DriveShape&, double coefficient)>
      figures = {};
  /// The whole description, of these figures (if any) with their intervals.
  std::function<std::string(const DriveContext&, const DriveShape&, double coefficient,
                            const std::vector<Parameter>& figures)>
      told = {};
  /// Shapes that hold all that it can be: of its kind, or (nullptr) of all kinds, to be found by.
  std::function<std::vector<DriveShape>(const DriveContext&, const DriveShape* about)> all_shapes =
      {};
  /// Shapes of what may be all that a bench holds, or all but what has a name, to be found by once
  /// the others are chosen; empty: it is asked otherwise.
  std::function<std::vector<DriveShape>(const DriveContext&)> whole_shapes = {};
  /// What it must take off more than others to be told as a whole form (chi-square).
  double dearer = 0.0;
  /// A reading that no loss of the library does in one direction alone.
  bool asked_of_one_direction = false;
  /// False of a shape of which the most stands where nothing was run; empty: none is so.
  std::function<bool(const DriveContext&, const DriveShape&)> shows = {};
  /// True of a place that was run: it goes before shapes that explain as much; empty: none.
  std::function<bool(const DriveContext&, const DriveShape&)> was_run = {};
  /// @}

  /// @name How it is corrected
  /// @{
  /// Puts it into a design's [losses]; false where another of its kind with another shape is there.
  /// Empty: a design cannot carry it, and `not_carried` says why.
  std::function<bool(CalibratedLosses&, const DriveShape&, double coefficient)> calibrate = {};
  std::string not_carried = {};
  /// @}
};

/// Of families that are found by a scan, or asked as whole forms: none is tried by itself.
[[nodiscard]] inline std::vector<DriveShape> no_shapes(const DriveContext&) { return {}; }

struct DriveEffect {
  const DriveFamily* family = nullptr;
  DriveShape shape;
  [[nodiscard]] int columns() const { return family->columns(shape); }
  [[nodiscard]] double order() const { return family->order ? family->order(shape) : 0.0; }
};

/// An effect of a sensor as it is listed where the other side's would look the same: "torque_offset
/// (output)".
[[nodiscard]] inline std::string of_side(const std::string& id, const std::string& side) {
  return id + " (" + side + ")";
}

/// The library: loss effects, sensor effects, free form. Lives as long as the program.
[[nodiscard]] const std::vector<DriveFamily>& drive_library();
/// The first effect of the library that has something.
template <class Member>
[[nodiscard]] const DriveFamily* family_with(Member DriveFamily::*something) {
  const auto& library = drive_library();
  return &*std::find_if(library.begin(), library.end(), [&](const DriveFamily& family) {
    return static_cast<bool>(family.*something);
  });
}
[[nodiscard]] const DriveFamily* find_drive_family(const std::string& id);
/// Every candidate that this bench's columns can carry.
[[nodiscard]] std::vector<DriveEffect> drive_candidates(const DriveContext& context);

}  // namespace trueflank::loop
