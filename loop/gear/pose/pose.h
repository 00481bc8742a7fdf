// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "trueflank/base/result.h"
#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/measured/measurement.h"

namespace trueflank::loop {

/// Rigid motion from the scan's frame to the gear's.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();

  [[nodiscard]] std::array<double, 3> operator()(const std::array<double, 3>& p) const {
    const Eigen::Vector3d q = rotation * Eigen::Vector3d(p[0], p[1], p[2]) + translation_mm;
    return {q.x(), q.y(), q.z()};
  }
};

/// Where a scan in any pose lies on the gear: axis by principal directions (where these lead
/// nowhere, from where the scan stands, and by trial over all directions), centre by the tip
/// circle, phase by trial, height by where the points lie on flanks (of a part that is longer than
/// the gear), then all by robust Gauss-Newton on the exact distance (Tukey weights; with its height
/// for herringbone gears). A spur or helical gear looks the same turned by a pitch and turned over:
/// of these poses the one that moves the scan least is taken, so tooth numbers of a free scan are
/// relative. Accuracy: 1e-6 mm on points without noise, tests/loop/pose_test.cpp. Linear in the
/// points. Errors: kInconsistent where the scan is not of this gear; kOutOfRange with too few
/// points.
[[nodiscard]] Result<Pose> fit_pose(const FlankGeometry& geometry, const ScanData& scan);

/// Share of a scan's points near the flanks, tips and roots of the gear in a pose, and the median
/// distance of those near a flank.
struct PoseQuality {
  double share = 0.0, median_mm = kNaN;
  double in_ring = 0.0;  ///< share of all points that lie in the ring of the flanks, on the face
  double beside_face = 0.0;  ///< share of all points that lie above or below the face
};
[[nodiscard]] PoseQuality pose_quality(const FlankGeometry& geometry, const ScanData& scan,
                                       const Pose& pose);

}  // namespace trueflank::loop
