// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trueflank/loop/drive/drive_model.h"
#include "trueflank/loop/measured/bench_data.h"

// Bench rows as the engine needs them: who drives whom, what may share its error, what is held out.
namespace trueflank::loop {

/// One usable row, seen from the driving side.
struct BenchPoint {
  bool forward = true;
  double speed_rpm = 0.0;
  double driving_nm = 0.0, driven_nm = 0.0;
  double load_nm = 0.0;     ///< the driving torque as the lossless drive passes it to the input
  /// What the output carries, as the lossless drive passes it to the input; where it is driven, of
  /// the smooth fit, so that no row's error is in it.
  double carried_nm = 0.0;
  double temperature_c = kNaN;
  double angle_rad = kNaN;  ///< of the input, unwrapped
  double taken = 0.0;       ///< when among the rows of its file: 0 first ... 1 last
  double sigma_nm =
      kNaN;  ///< of driven_nm: as given, else estimated for its direction, load and speed
  int unit = 0;             ///< rows of one set point, or of a stretch of a log
  /// Rows that share the rounding of one coarse reading of the driving torque; -1: it is read finely.
  int reading = -1;
  int fold = 0;             ///< 0 locked hold-out, 1 ... 8 cross-validation
  int file = 0, line = 0;
  int way = 0, speed_way = 0;  ///< of the load and the speed: 1 while it rises, -1 while it falls,
                               ///< 0 before it has moved
  /// The same where what stands at a turn keeps the way that it came by, as a sensor's or a
  /// lever's friction does; `way` gives half of what stands there to either.
  int way_kept = 0, speed_way_kept = 0;
  /// Which way each went from the row before; 0 where it stood.
  int way_stepped = 0, speed_way_stepped = 0;
  /// Warmer (1) or colder (-1) than the row before; where it is the same: 0, or as it came to it.
  int warmth_stepped = 0, warmth_kept = 0;
  /// How far the load and the speed have moved since they turned, of the largest.
  double moved = 0.0, speed_moved = 0.0;
  int row = 0;                 ///< of its file, from 0 on, with the rows that were left out
  int place = -1;              ///< which of BenchTable::every_row() it is
  /// Of BenchTable::row_before(); -1: none was taken right before, or it was left out.
  int before = -1;
  int since_turn = 0;          ///< rows since the direction changed or the file began
  /// DriveContext::speed_coordinate() of a speed, once computed: every shape that is tried asks it.
  double known_speed_rpm = kNaN, known_speed_coordinate = kNaN;
  [[nodiscard]] DrivePoint at() const { return {forward, speed_rpm, load_nm, temperature_c}; }
};

/// What no gearbox can do, and what it is instead.
enum class Impossible {
  kNothing,
  kEfficiencyAboveOne,  ///< one direction gains power: a torque scale or an offset
  kSwappedColumns,      ///< input and output torque are interchanged
  kSwappedDirections,   ///< forward is backward and the reverse
};

struct BenchTable {
  std::vector<BenchPoint> points;
  int units = 0;
  int outliers = 0;
  bool drifts = false;  ///< neighbouring set points hang together: a log, or a drifting zero
  bool has_temperature = false, has_angle = false;
  double turns = 0.0;   ///< of the input that the angles span
  /// The least of the angles and how far they reach, where they go to and fro; else a reach of 0.
  double least_angle_rad = 0.0, swing_rad = 0.0;
  double most_speed_rpm = 0.0, least_speed_rpm = 0.0, most_load_nm = 0.0, least_load_nm = 0.0;
  double most_carried_nm = 0.0, least_carried_nm = 0.0;
  std::array<double, 2> most_carried_of{};  ///< backward, forward
  std::array<int, 3> levels{};  ///< distinct loads, speeds, temperatures, up to 8
  double mean_temperature_c = kNaN, least_temperature_c = kNaN, temperature_span_c = 0.0;
  Impossible impossible = Impossible::kNothing;
  std::string impossible_text;  ///< one sentence: where, and how far
  std::vector<std::string> notes;
  std::vector<std::string> files;  ///< as named by who gave them

  /// Of a table of some rows: all of them, which must outlive it.
  const std::vector<BenchPoint>* all_points = nullptr;

  [[nodiscard]] bool has(bool forward) const;
  /// All rows, of a table of some rows too.
  [[nodiscard]] const std::vector<BenchPoint>& every_row() const {
    return all_points != nullptr ? *all_points : points;
  }
  /// The row that was taken right before; nullptr: none was, or it was left out.
  [[nodiscard]] const BenchPoint* row_before(const BenchPoint& p) const {
    return p.before < 0 ? nullptr : &every_row()[static_cast<std::size_t>(p.before)];
  }
};

/// The table without its rows, to take some of them: each still finds the row before it. `table`
/// must outlive it.
[[nodiscard]] BenchTable without_rows(const BenchTable& table);

inline constexpr int kBenchFolds = 8;

/// Judges the rows and puts them into the table. Swapped columns or directions are put right in it
/// and told by `impossible`. Errors: torques in another unit than N m or in mixed units, signs that
/// change inside a direction, a side without any torque, fewer than 8 rows.
[[nodiscard]] ResultAll<BenchTable> make_bench_table(const DriveModel& model, const BenchData& data);

/// Set points of one direction and a sixth of its loads that deliver more than they take: of which
/// file, and in words. `taken_off_nm`: of every row, what its sensors read too much on the driven
/// side; empty: nothing.
struct PowerGained {
  int file = -1;  ///< -1: nowhere
  std::string text;
};
[[nodiscard]] PowerGained power_gained(const std::vector<BenchPoint>& points, double ratio,
                                       const std::vector<double>& taken_off_nm);

/// @name Steps of it, for its own use and tests
/// @{
/// Magnitudes: a side whose torques all come with a minus is turned, and told. Errors: mixed signs.
[[nodiscard]] Errors settle_signs(BenchData& data, std::vector<std::string>& notes);
/// Errors: a direction in which the input or the output never has a torque.
[[nodiscard]] Errors refuse_no_torque(const BenchData& data);
/// Errors: another unit than N m, or mixed ones. Tells swapped columns and directions.
[[nodiscard]] Errors judge_units(const DriveModel& model, const BenchData& data, Impossible& swapped);
/// Residual of a smooth fit of each direction over load, speed and temperature, which knows nothing of
/// any effect: what is noise, which rows lie far off.
struct SmoothFit {
  std::vector<double> residual_nm;
  double sigma_forward_nm = kNaN, sigma_backward_nm = kNaN;
  std::vector<double>
      sigma_nm;  ///< of every row: its direction's, or what grows with load or speed
};
/// The error of every row in its direction's: 1 each, or what grows with the load or the speed
/// where that is sure.
[[nodiscard]] std::vector<double> growth_of_noise(const std::vector<BenchPoint>& points,
                                                  const SmoothFit& fit);
[[nodiscard]] SmoothFit smooth_fit(const std::vector<BenchPoint>& points);
/// Ranges and levels of the points.
void measure_extent(BenchTable& table);
/// Units and folds of points in the order they were taken.
void assign_blocks(BenchTable& table, const SmoothFit& fit);
/// Other folds of shorter stretches, a quarter of a unit each: for a hold-out that holds all of
/// something, which no training row shows.
void deal_hold_out_anew(BenchTable& table);
/// @}

}  // namespace trueflank::loop
