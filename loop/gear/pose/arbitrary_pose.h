// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/fit/point_fit.h"

// A scan in any pose does not say which tooth is the first, nor which end of the gear is up.
namespace trueflank::loop {

/// True where nothing but such scans (and sizes) was measured.
[[nodiscard]] bool is_of_any_pose(const Observations& table);
/// True where nothing but scans (and sizes) was measured, in whatever frame: how a part is turned
/// about its axis is then fitted.
[[nodiscard]] bool may_be_turned(const Observations& table);

/// How far the flanks stand out [um] by an effect that moves all flanks alike, or all left or all
/// right ones; NaN: it does not.
[[nodiscard]] double height_of_flanks_um(const FlankGeometry& geometry, const PointFit& fit,
                                         int effect);

/// True where these effects of a fit, taken together, would be another correction with another
/// tooth for the first or the other end up: they differ from tooth to tooth, or between a flank and
/// the other one seen from the other end, if no effect of the fit says which end is up.
[[nodiscard]] bool hangs_on_pose(const FlankGeometry& geometry, const PointFit& fit,
                                 const std::vector<int>& effects);

}  // namespace trueflank::loop
