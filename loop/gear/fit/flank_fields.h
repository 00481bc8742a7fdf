// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "trueflank/loop/gear/fit/point_fit.h"

// What the effects of a fit do over the flanks of all teeth.
namespace trueflank::loop {

inline constexpr int kGridSide = 5;

/// What an effect does on a grid over the flanks: a column a tooth; left flank first, then right
/// one, height by height from root to tip.
using FlankField = Eigen::MatrixXd;

[[nodiscard]] FlankField field_of(const FlankGeometry& geometry, const PointFit& fit,
                                  std::size_t effect);

/// A field without the height of each flank, which traces with zeros of their own do not show.
void take_off_heights(Eigen::Ref<FlankField> field);

/// Effects in the mean of the teeth, on the grid of one flank: heights down, rolls across.
using MeanOfFlank = Eigen::Matrix<double, kGridSide, kGridSide>;
[[nodiscard]] std::array<MeanOfFlank, 2> mean_of_flanks(const FlankField& field);

/// True where a name is the same all along one direction of the flanks, the forms change it there
/// by more than half of itself, and it stands as it is on less than half of the way.
[[nodiscard]] bool is_mean_across(const std::array<MeanOfFlank, 2>& name,
                                  const std::array<MeanOfFlank, 2>& forms);

}  // namespace trueflank::loop
