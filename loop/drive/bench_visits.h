// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/drive/bench_table.h"

// Which rows of a bench were taken at the same set point, and when: visits.
namespace trueflank::loop {

/// The step in which values are read: of fine readings next to nothing.
[[nodiscard]] double step_of(std::vector<double> values);
/// Levels of a quantity: sorted values apart by more than the setting's scatter (a share of the
/// value, and of the range). Where they run into each other: tenths of the range.
[[nodiscard]] std::vector<int> levels_of(const std::vector<double>& values, double scatter,
                                         double of_range);
[[nodiscard]] std::vector<double> values_of(const std::vector<BenchPoint>& points,
                                            double BenchPoint::*member);
[[nodiscard]] std::vector<int> load_levels(const std::vector<BenchPoint>& points);
[[nodiscard]] std::vector<int> speed_levels(const std::vector<BenchPoint>& points);
/// Numbers from 0 on for pairs.
[[nodiscard]] std::vector<int> together(const std::vector<int>& a, const std::vector<int>& b);

/// Rows of one direction and of the same speed and load, as far as a bench can set them again: one
/// number a row. Rows without levels, of a sweep, share cells of a tenth of the range.
[[nodiscard]] std::vector<int> set_points_of(const std::vector<BenchPoint>& points);

/// Rows of one set point and file that follow each other: one number a row, from 0 on.
[[nodiscard]] std::vector<int> visits_of(const std::vector<BenchPoint>& points,
                                         const std::vector<int>& set_point);

/// Correlation of neighbouring visits' means with what set points and slow courses have in common
/// taken off: of the errors alone, where set points come again. `size`: of every visit, in its
/// noise's units.
[[nodiscard]] double correlation_of_visits(const Eigen::VectorXd& size,
                                           const std::vector<int>& set_point);

/// Step of a lattice on which all values lie and many come again, as coarse readings do; 0: they
/// are read finely.
[[nodiscard]] double lattice_step_of(const std::vector<double>& values);
/// What readings in steps of both sensors add to the driven torque of a direction, standard
/// deviation [N m]. A sensor's step shows where it reads the driven side.
[[nodiscard]] double rounding_of(const std::vector<BenchPoint>& points, bool forward);

/// @name What a series of visits is made of
/// @{
inline constexpr int kSlowWaves = 4;  ///< half waves over the run that are called slow
/// Takes the mean of every cell off.
void take_means(Eigen::VectorXd& values, const std::vector<int>& cell);
/// Size of half wave k over the run.
[[nodiscard]] double on_half_wave(const Eigen::VectorXd& values, int k);
/// Takes the mean and the slowest half waves off.
void take_slow(Eigen::VectorXd& values, int waves);
/// @}

/// The loads, those of one level alike: what a driving torque misreads is in what is left as well,
/// and of rows of one level those near by would be those with the same error. Where they stand at
/// no levels, each its own.
[[nodiscard]] std::vector<double> loads_as_set(const std::vector<BenchPoint>& points,
                                               const std::vector<int>& set_point);

/// Whether a series has a level before it first changes.
enum class FirstLevel { kNothing, kAny };

/// A series in its rows' order, cut into parts of which each has a level of its own: `column`, what
/// 1 of a level makes of every row.
class PartsOfRun {
 public:
  PartsOfRun(const std::vector<double>& column, const std::vector<double>& value, FirstLevel first);
  [[nodiscard]] std::size_t rows() const { return value_.size() - 1; }
  /// What the level of rows [from, to) leaves of their squares, and the level.
  [[nodiscard]] double left(std::size_t from, std::size_t to) const;
  [[nodiscard]] double level(std::size_t from, std::size_t to) const;
  /// First rows of all parts but the first, of the cut that leaves least: every part costs a figure
  /// and its place, in the scatter of rows that follow each other. Of more than 1500 rows none.
  [[nodiscard]] std::vector<std::size_t> likeliest_cuts() const;

 private:
  FirstLevel first_;
  std::vector<double> product_{0.0}, square_{0.0}, value_{0.0};  ///< sums up to every row
  double noise_ = 0.0;
};

/// Notes of every row, in the order they were taken, whether the load rises or falls, and how long
/// ago the direction changed. A load must move by a fortieth of the largest to have turned; a dwell
/// at the turn is half of the way before and half of the one after.
void note_history(std::vector<BenchPoint>& points);
/// Notes of every row which it is, and the one that was taken right before it. Once no more rows
/// are left out.
void note_places(std::vector<BenchPoint>& points);

}  // namespace trueflank::loop
