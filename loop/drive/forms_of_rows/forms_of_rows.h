// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
/// What the size of a wave over the run follows: What, or the speed.
inline constexpr double kRwBySpeed = 4.0;
enum RunWaveFrom { kRwToEitherSide, kRwFromNothing };
/// Periods from the middle of the run on.
[[nodiscard]] double periods_of_run(double share, double times, double stretch);
/// Row of a point, 0 ... 1 over the rows of the log.
[[nodiscard]] double share_of_run(const BenchTable& table, const BenchPoint& p);
/// What starts at rows of the run, in growing order, and dies away within so many rows.
enum StartsValue : std::size_t { kStartsOf, kStartsRows, kFirstStart };
/// Change of the driven torque [N m] for 1 N m at the input, at the largest load or speed.
[[nodiscard]] double run_wave_nm(const DriveContext& context, const BenchPoint& p, double of);

}  // namespace trueflank::loop::drive_effects
