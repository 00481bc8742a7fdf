// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "trueflank/loop/drive/drive_effect.h"

// Waves over the angle that a part of the rows alone has: spectra of parts of the range, which are
// sums, put together.
namespace trueflank::loop {

/// A wave of one direction, of one side of a load, a speed, a temperature or a place of the run, or
/// one that turns over there; even, or in proportion to the load or the speed.
struct PartWave {
  DriveShape shape;         ///< of a wave of sizes, or of a part (effects/columns.h)
  bool is_of_part = false;  ///< it has a place
  std::size_t looks = 0;    ///< at how many orders and places was looked
};

/// The likeliest of every kind that take off more than noise lets the best of so many looks; none
/// where the rows and the orders are too many to ask. `left` [N m]: what other effects leave.
[[nodiscard]] std::vector<PartWave> waves_of_parts(const DriveContext& context,
                                                   const Eigen::VectorXd& left);

/// The same wave with its order, place and phase where they take most off `left` [N m], near by.
[[nodiscard]] DriveShape finer_part_wave(const DriveContext& context, const Eigen::VectorXd& left,
                                         const DriveShape& wave);

}  // namespace trueflank::loop
