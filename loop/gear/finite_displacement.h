// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/fit/point_fit.h"

namespace trueflank::loop {

/// Makes the fit exact for finite displacements: every point of a scan is moved back by the body
/// effects as fitted, its exact distance taken there, and the linear part of the effects put back
/// on. Near the base circle a flank is so curved that 30 um of shrinkage leave 0.4 um to second
/// order. The table gets the new deviations and places. Returns the largest change of what the fit
/// leaves of a value [um]: at another place its columns say another thing.
double linearise_at(const FlankGeometry& geometry, const PointFit& fit, Observations& table);

/// The largest such change [um] that linearise_at would make to some thousand points, every n-th of the table, which stays as it is.
[[nodiscard]] double change_of_sample_um(const FlankGeometry& geometry, const PointFit& fit,
                                         const Observations& table);

/// By what scans in any pose lie otherwise as a fit of all says: beside an effect the pose may have
/// been off by what the effect does. Empty where no point would come to another height by more than a
/// share of the face (near a step, or low in a foot, it is another value there).
[[nodiscard]] std::vector<Pose> poses_beside(const FlankGeometry& geometry, const PointFit& fit,
                                             const Observations& table);

/// Moves the points of each scan; deviations and places are of the gear as designed again.
void move_scans(const FlankGeometry& geometry, const std::vector<Pose>& by, Observations& table);

/// Moves the points of these rows; deviations and places are of the gear as designed again.
void move_points(const FlankGeometry& geometry, const std::vector<std::size_t>& rows,
                 const std::array<double, 3>& by_mm, Observations& table);

/// Deviations and places of the gear as designed, as make_observations had them: computed again
/// from the points, which takes no memory beside the table.
void undo_displacement(const FlankGeometry& geometry, Observations& table);

}  // namespace trueflank::loop
