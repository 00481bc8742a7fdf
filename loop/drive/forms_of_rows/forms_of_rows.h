// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"

// Forms that count rows or turns of no shaft: where they lie, for who seeks them.
namespace trueflank::loop::drive_effects {

/// Few growing steps to both sides, 0 first: for shapes of several values that are moved together.
[[nodiscard]] inline std::vector<double> coarse_steps(double first, double last) {
  constexpr double kGrowth = 1.8;
  std::vector<double> steps{0.0};
  for (double step = first; step < last; step *= kGrowth) {
    steps.push_back(step);
    steps.push_back(-step);
  }
  return steps;
}

/// A short loss of any order. The slip is in periods over all the turns, the centre and the half
/// width in periods, the centre from the middle of the run on.
enum PitValue : std::size_t { kPitOrder, kPitSlip, kPitCentre, kPitHalf, kPitSharp };
/// Periods per turn of the input.
[[nodiscard]] double order_of_pits(const BenchTable& table, const DriveShape& s);
/// Periods from the middle of the nearest one on.
[[nodiscard]] double place_of_pit(const BenchTable& table, const BenchPoint& p,
                                  const DriveShape& s);

/// A wave over the rows of the run. The phase is that of the middle row, in periods; the last
/// period is exp(stretch) times as long as the first. The plain family has no stretch.
enum RunWaveValue : std::size_t { kRwTimes, kRwPhase, kRwOf, kRwFrom, kRwStretch };
enum RunWaveFrom { kRwToEitherSide, kRwFromNothing };
/// Periods from the middle of the run on.
[[nodiscard]] double periods_of_run(double share, double times, double stretch);
/// Row of a point, 0 ... 1 over the rows of the log.
[[nodiscard]] double share_of_run(const BenchTable& table, const BenchPoint& p);
/// What starts at rows of the run, in growing order, and dies away within so many rows.
enum StartsValue : std::size_t { kStartsOf, kStartsRows, kFirstStart };

/// Of more files than these none is asked by itself.
inline constexpr int kMostFilesAsked = 5;
/// Files of which each has so many rows at least and leaves the others so many; none of one file.
[[nodiscard]] std::vector<int> files_to_ask(const BenchTable& table, std::size_t fewest,
                                            std::size_t fewest_of_others);
[[nodiscard]] std::string name_of_file(const BenchTable& table, double number);

}  // namespace trueflank::loop::drive_effects
