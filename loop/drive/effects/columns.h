// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "trueflank/loop/drive/calibrated_losses.h"
#include "trueflank/loop/drive/drive_effect.h"

// What several effects of a drive are made of. Torques are at the input shaft; forms and sources:
// docs/drive-loop.md.
namespace trueflank::loop::drive_effects {

/// A loss torque at the input [N m per unit], as it shows on the driven side.
template <class Loss>
auto loss(Loss torque) {
  return [torque](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
    c[0] = -context.lever(p) * torque(context, p, shape);
  };
}

/// Scales of a course over speed that the bench's speeds can show, and where they may move to.
[[nodiscard]] std::vector<DriveShape> speed_shapes(const DriveContext& context);
[[nodiscard]] std::pair<double, double> speed_limits(const DriveContext& context);
/// Rates per degree at which something thins, where the bench grew warm.
[[nodiscard]] std::vector<DriveShape> rate_shapes(const DriveContext& context);
[[nodiscard]] std::pair<double, double> rate_limits(const DriveContext& context);
/// exp(-rate (t - the bench's mean)).
[[nodiscard]] double thinning(const DriveContext& context, const BenchPoint& p, double rate);
[[nodiscard]] std::vector<DriveReference> mean_temperature(const DriveContext& context);

/// Flanks that rub dry, plastic on plastic, come to about this; what a bench shows beyond is no friction of
/// flanks but a scale of its torques, or a loss elsewhere.
inline constexpr double kMostFriction = 0.4;
/// True where the design's friction with this change can be one of flanks that rub.
[[nodiscard]] bool can_be_friction(const DriveModel& model, const DriveShape& shape, double change);

/// "in a wave of order 0.25 per input turn (carrier)".
[[nodiscard]] std::string wave_in_words(const DriveModel& model, double order);
[[nodiscard]] std::string short_text(double value);
/// Scales of the speed, and the exponent by which a loss fades with it: 2, or 1.
[[nodiscard]] std::vector<DriveShape> fading_shapes(const DriveContext& context);
/// What is said of one that fades by exp(-n/n0): a design has the other alone.
inline constexpr const char* kFadesOtherwise =
    "a design's [losses] have exp(-(n/n0)^2) alone, and one of it";

[[nodiscard]] inline double first_value(const DriveShape& shape) { return shape[0]; }

/// The one shape of an effect that grows over the run; none where any slope over so few set points looks like it.
[[nodiscard]] std::vector<DriveShape> where_rows_follow_each_other(const DriveContext& context);

/// What the size of a wave follows, or that it comes by the clock.
enum WaveHow {
  kWaveEven,
  kWaveWithLoad,
  kWaveGrows,
  kWaveByRows,
  kWaveWithSpeed,
  kWaveWithWarmth,
  kWaveWithCold,
  kWaveWithSpeedSquare
};
/// The values of a wave of sizes: `kWaveDirection` is that of in_direction(). The last three are
/// those of one that a part of the range alone has.
enum WaveValue : std::size_t {
  kWaveOrder,
  kWaveHow,
  kWaveDirection,
  kWavePhase,
  kWaveOver,   ///< load, speed, temperature, or the run (kOverRun)
  kWavePlace,  ///< 0 ... 1, of the largest load and speed
  kWaveSide
};
inline constexpr double kOverRun = 3.0, kOverDrivingLoad = 4.0;
/// Where it is: beyond the place, up to it, or on both sides the one opposite to the other.
enum WaveSide { kWaveAbove, kWaveBelow, kWaveTurnsOver };
/// What makes a wave larger in a row, 1 at the most.
[[nodiscard]] double size_of_wave(const DriveContext& context, const BenchPoint& p, double how);
/// Where a row is, 0 ... 1, for the place of a wave.
[[nodiscard]] double share_for_wave(const DriveContext& context, const BenchPoint& p, double over);

/// Places half-way between rows that differ, of at most so many rows to either side of a place.
[[nodiscard]] std::vector<double> places_between(std::vector<double> shares, double about,
                                                 std::ptrdiff_t most);

/// What changes in the course of a run or over a part of a turn.
enum What { kFlanks, kDrag, kOutputReads, kOutputGain };
/// Its change of the driven torque [N m] for 1 N m at the input; of the flanks and of a gain at the
/// largest load.
[[nodiscard]] double changed_nm(const DriveContext& context, const BenchPoint& p, double what);
/// What the size of a loss follows: What, or the speed.
inline constexpr double kBySpeed = 4.0;
/// Change of the driven torque [N m] for 1 N m at the input, at the largest load or speed.
[[nodiscard]] double sized_loss_nm(const DriveContext& context, const BenchPoint& p, double of);
/// " in proportion to the speed"; empty of what is the same everywhere.
[[nodiscard]] std::string in_proportion(double of);
/// " at the largest speed"; empty of what is the same everywhere.
[[nodiscard]] std::string at_the_largest(double of);
/// The output's torque over what the largest load makes of it in the lossless drive. Backward it
/// drives, and may be read wrong itself: the input's torque says what it was.
[[nodiscard]] double true_share(const DriveContext& context, const BenchPoint& p);
/// Loss at the input [N m] of the largest load for a unit of the flanks' coefficient.
[[nodiscard]] double nm_of_coefficient(const DriveContext& context);
/// 0 ... 1 over the run (order 0), or over the turn that comes so often per turn of the input.
[[nodiscard]] double place_of_spell(const BenchPoint& p, double order);
/// Rows since the last rest: the last change of direction (period 0), or what comes again after so
/// many rows.
[[nodiscard]] double rows_since_rest(const BenchPoint& p, double period, double phase);
/// "of the input", "of order 0.5333 (planet against the carrier)".
[[nodiscard]] std::string turn_in_words(const DriveModel& model, double order);
/// Steps to both sides of a place, 0 first, from the first one on each larger than the one before
/// up to the last: an interval is as fine as these. Of very many rows there are fewer.
[[nodiscard]] std::vector<double> growing_steps(const DriveContext& context, double first,
                                                double last);
/// Growing steps of a value, added to it or, as shares of it, multiplied, and its limits.
struct ValueSteps {
  double first = 0.0, last = 0.0, least = 0.0, most = 0.0;
  bool as_shares = false;
};
/// Shapes whose first value is moved by these; the others stay.
[[nodiscard]] std::vector<DriveShape> with_first_moved(const DriveContext& context,
                                                       const DriveShape& about,
                                                       const ValueSteps& steps);
/// A figure as so many percent more or less: "2.5 (2.4 to 2.6) % less".
[[nodiscard]] std::string percent_in_words(const Parameter& figure);
/// True where the rows are of one file, in the order in which they were taken, and not too few.
[[nodiscard]] bool has_one_course(const DriveContext& context);

/// How all terms of a drive's effects without a name are written.
[[nodiscard]] std::vector<TermKey> drive_term_keys();
/// Facts that all of them share.
[[nodiscard]] DriveFamily without_a_name();
/// -1 ... 1 over load, speed or temperature (over = 0, 1, 2).
[[nodiscard]] double coordinate(const DriveContext& context, const BenchPoint& p, double over);
[[nodiscard]] const char* name_of_quantity(double over);

/// Both directions (0), or forward (1) and backward (2) alone, where both were run.
[[nodiscard]] std::vector<double> directions_alone(const DriveContext& context);
[[nodiscard]] inline bool is_of_direction(const BenchPoint& p, double which) {
  return which == 0.0 || p.forward == (which == 1.0);
}
/// As a reading of the output's torque, which takes in the one direction what it gives in the
/// other.
inline constexpr double kAsItReads = 3.0;
/// As a gain of that reading: in proportion to the output's torque, at the largest load.
inline constexpr double kAsItsGainReads = 4.0;
/// Change of the driven torque [N m] for 1 N m lost at the input in both directions (0), in one (1,
/// 2), or for 1 N m, as a torque at the input, that the output reads too much (kAsItReads,
/// kAsItsGainReads).
[[nodiscard]] double in_direction(const DriveContext& context, const BenchPoint& p, double which);
/// " while the input drives"; empty of both.
[[nodiscard]] std::string direction_in_words(double which);

/// "rpm" as keys end with it: "load_nm", "rpm", "c".
[[nodiscard]] std::string key_of_quantity(double over);
/// " N m at the input", " rpm", " C".
[[nodiscard]] std::string unit_of_quantity(double over);
/// " rpm" as it follows "per".
[[nodiscard]] std::string unit_alone(double over);
/// Of a reading: two sensors show only their ratio.
inline constexpr const char* kNoLoss =
    " (the same sign in both directions: a reading, no loss; the input's torque read wrong the "
    "other way looks alike)";
/// "reads 0.52 (0.5 to 0.54) N m more"; the sign of the figure is in the words.
[[nodiscard]] std::string reads_in_words(const Parameter& figure);
/// A family of what a sensor of the output reads wrong, with one amount.
[[nodiscard]] DriveFamily reading_without_a_name();
/// term_shapes of a reading of the output, or of its gain (What).
[[nodiscard]] std::vector<DriveShape> terms_of_reading(double what);

/// A figure whose interval is not known yet.
[[nodiscard]] Parameter figure_of(const std::string& name, double value);
/// "1240 rpm (1180 to 1300)".
[[nodiscard]] std::string with_interval(const Parameter& figure, const std::string& unit);
/// Loads, speeds or temperatures at which something was measured, from the lowest on; of very
/// many 24.
[[nodiscard]] std::vector<double> levels_run(const DriveContext& context, double over);
/// Shares of the range at these levels and half way between them.
[[nodiscard]] std::vector<double> places_between_levels(const DriveContext& context, double over);

/// True where the load, the speed or the temperature (0, 1, 2) went up and down often enough that
/// this is no drift, and both ways have rows enough.
[[nodiscard]] bool goes_up_and_down(const DriveContext& context, double over);

/// True where one without a name follows the load.
[[nodiscard]] bool some_follows_the_load(const std::vector<DriveEffect>& effects);

/// What forms must take off that are asked beside those that were asked first: they are told once
/// in a million benches that do not hold them (chi-square).
inline constexpr double kDearerForms = 12.0;

inline constexpr const char* kOfTheBench = "it is the bench's, not the drive's";

}  // namespace trueflank::loop::drive_effects
