// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"

// Waves over the angle of the input whose phase something moves: a load, a speed, another file.
namespace trueflank::loop::drive_effects {

/// After the values of a wave of sizes up to its phase, which is that where nothing moves it.
enum MovedWaveValue : std::size_t {
  kMovedWhat = kWavePhase + 1,  ///< which load, speed or file
  kMovedBy                      ///< periods that it is later where it is moved most
};

/// What moves a wave, and how that is told.
struct MovedWave {
  std::string what, by;  ///< names of these values
  /// By how much of `by` the wave of a row is moved, 0 ... 1.
  std::function<double(const DriveContext&, const BenchPoint&, const DriveShape&)> share;
  std::function<std::vector<DriveShape>(const DriveContext&, double order, double direction)>
      at_order;
  /// Moves a phase and how far it is moved, together, so that neither undoes the other.
  using Move = std::function<void(DriveShape&, double phase, double by)>;
  std::function<Move(const DriveContext&, const DriveShape& about)> move;
  double most_by = 0.0;  ///< how far `by` goes to either side at once
  /// How far it is moved, as people know it.
  std::function<Parameter(const DriveContext&, const DriveShape&)> figure;
  std::function<std::string(const DriveShape&)> words;  ///< ", whose phase goes with the speed"
  /// Where it is most, and how far that is moved.
  std::function<std::string(const DriveContext&, const DriveShape&, double amount,
                            const Parameter& moved)>
      places;
  std::function<std::string(const DriveShape&)> cause;  ///< " (a filter?)"
};

/// Degrees of the input, 0 ... one period, at which the wave is most where a share of `by` moves
/// it.
[[nodiscard]] double moved_most_at_deg(const DriveShape& s, double amount, double share);
/// The family of waves that this moves.
[[nodiscard]] DriveFamily moved_by(const MovedWave& wave);

}  // namespace trueflank::loop::drive_effects
