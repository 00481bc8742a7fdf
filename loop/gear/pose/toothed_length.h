// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/loop/gear/pose/pose_search.h"

// A scan of a whole part holds more than the gear: another toothing beside it, a hub, a shaft.
namespace trueflank::loop {

/// Heights between which a posed scan lies on the flanks of the gear, no more than a face width
/// apart.
struct ToothedLength {
  double low_mm = 0.0, high_mm = 0.0;
  /// Points in the ring of the flanks and between the heights: those near a flank less the others;
  /// all.
  double fits = 0.0, points = 0.0;
};

/// Those heights between which the most points fit. O(n log n).
[[nodiscard]] ToothedLength toothed_length(const FlankGeometry& geometry, const ScanPoints& points,
                                           const Pose& pose);

/// As ToothedLength::fits, between the ends of the face.
[[nodiscard]] double fits_on_face(const FlankGeometry& geometry, const ScanPoints& points,
                                  const Pose& pose);

/// True where the points of a posed scan reach further along the axis than the face is wide.
[[nodiscard]] bool is_longer_than_face(const FlankGeometry& geometry, const ScanPoints& points,
                                       const Pose& pose);

/// Pose of a scan of a whole part: the gear is sought at every height along the axis of the pose
/// that was found, and, where it fits nowhere, along each principal direction. Nothing where no
/// direction is longer than the face, or the gear fits nowhere.
[[nodiscard]] std::optional<Pose> pose_on_part(const FlankGeometry& geometry,
                                               const ScanPoints& points, const Pose& found);

}  // namespace trueflank::loop
