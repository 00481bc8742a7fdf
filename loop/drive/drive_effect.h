// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/drive_context.h"
#include "trueflank/loop/result/effect_facts.h"
#include "trueflank/loop/result/loop_result.h"

namespace trueflank::loop {

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
struct DriveEffect;

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
  std::function<bool(const DriveModel&, const DriveShape&, double coefficient)> plausible = {};
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
  /// True of effects that together may do what this one does alone: it is asked in their place once
  /// all are chosen; empty: it is not.
  std::function<bool(const std::vector<DriveEffect>&)> may_stand_for = {};
  /// Starts at rows of the run that a scan finds, and dies away.
  bool starts_in_run = false;
  /// The shapes by which it may be what a spectrum shows at an order; empty: none.
  std::function<std::vector<DriveShape>(const DriveContext&, double order)> shapes_at_order = {};
  /// Waves of an order whose phase something moves: the load, the speed, a file; empty: it is none.
  std::function<std::vector<DriveShape>(const DriveContext&, double order, double direction)>
      moved_waves_at_order = {};
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
  /// A reading that where power is gained is asked in place of losses, not beside them.
  bool in_place_of_losses = false;
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
  /// False where an amount cannot be what it is called.
  [[nodiscard]] bool can_be(const DriveModel& model, double coefficient) const {
    return (!family->only_positive || coefficient > 0.0) &&
           (!family->plausible || family->plausible(model, shape, coefficient));
  }
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
