// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/pose/pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/pose/pose_search.h"
#include "trueflank/loop/gear/pose/toothed_length.h"

namespace trueflank::loop {
namespace {

/// Of the equal poses (turned by whole pitches) the one that turns the scan least about z.
Pose least_turned(const FlankGeometry& geometry, Pose pose) {
  const Eigen::Matrix3d& r = pose.rotation;
  const double angle = std::atan2(r(1, 0) - r(0, 1), r(0, 0) + r(1, 1));
  const double pitch = kTwoPi / geometry.teeth();
  const Eigen::Matrix3d back =
      Eigen::AngleAxisd(-pitch * std::round(angle / pitch), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  pose.rotation = back * pose.rotation;
  pose.translation_mm = back * pose.translation_mm;
  return pose;
}

}  // namespace

PoseQuality pose_quality(const FlankGeometry& geometry, const ScanData& scan, const Pose& pose) {
  const double reach = 0.3 * geometry.gear().normal_module_mm;
  const auto [low, high] = std::minmax({std::hypot(geometry.base_radius_mm(), geometry.root_form_roll_mm()),
                                        std::hypot(geometry.base_radius_mm(), geometry.tip_form_roll_mm())});
  constexpr double kBeyondFace = 0.02;  // of the face, whose height is known by its points
  const double beyond = kBeyondFace * geometry.face_width_mm();
  std::vector<double> distances;
  double near = 0.0, all = 0.0, beside = 0.0;
  const ScanPoints points = thinned(scan.points_mm, 5000);
  for (const auto& p : points) {
    const auto q = pose(p);
    const double radius = std::hypot(q[0], q[1]);
    // Faces, hub and rim are no teeth, and lands of tips and roots, which a mesh may hold in many
    // points, no flanks, and beside the gear stands another one: only what lies in the ring of the
    // flanks counts.
    if (q[2] < -beyond || q[2] > geometry.face_width_mm() + beyond) {
      beside += 1.0;
      continue;
    }
    if (radius < low || radius > high) continue;
    all += 1.0;
    const PlacedPoint placed = geometry.nearest_flank(q, 0.03);
    if (placed.place.surface != Surface::kFlank) continue;
    if (std::abs(placed.distance_mm) > reach) continue;
    near += 1.0;
    distances.push_back(placed.distance_mm);
  }
  PoseQuality quality;
  quality.share = all > 0.0 ? near / all : 0.0;
  const auto count = static_cast<double>(std::max<std::size_t>(1, points.size()));
  quality.in_ring = all / count;
  quality.beside_face = beside / count;
  if (distances.empty()) return quality;
  // Points at random lie as far from a flank as the search reaches: half of them beyond half of it.
  const double centre = quantile(distances, 0.5);
  std::vector<double> spread;
  for (const double d : distances) spread.push_back(std::abs(d - centre));
  if (quantile(spread, 0.5) > 0.4 * reach) quality.share = 0.0;
  for (double& d : distances) d = std::abs(d);
  quality.median_mm = quantile(distances, 0.5);
  return quality;
}

Result<Pose> fit_pose(const FlankGeometry& geometry, const ScanData& scan) {
  if (scan.points_mm.size() < 100)
    return fail({.code = ErrorCode::kOutOfRange,
                 .message = "a scan in free pose needs at least 100 points, this one has " +
                            std::to_string(scan.points_mm.size()),
                 .file = scan.file});
  PoseSearch search(geometry, scan.points_mm);
  const ScanPoints points = thinned(scan.points_mm, 40000);
  Pose pose = search.refined(search.best(), points, {});
  constexpr double kGood = 0.8;  // nearly 1 where all points are on flanks as designed
  constexpr double kClose = 0.03;  // modules: what made gears lie off, and not by their pose
  const double module = geometry.gear().normal_module_mm;
  PoseQuality of_pose = pose_quality(geometry, scan, pose);
  const auto take_if_better = [&](const Pose& other) {
    const PoseQuality quality = pose_quality(geometry, scan, other);
    // Of points at random some few lie near flanks in some pose.
    constexpr double kFits = 0.5, kInRing = 0.2, kMuchCloser = 0.5;
    if (quality.share < kFits || quality.in_ring < kInRing) return;
    if (!(of_pose.share < kGood
              ? quality.share > of_pose.share
              : quality.share >= kGood && quality.median_mm < kMuchCloser * of_pose.median_mm))
      return;
    pose = other;
    of_pose = quality;
  };
  if (of_pose.share < kGood || of_pose.median_mm > kClose * module)
    take_if_better(search.refined(search.best_as_it_stands(), points, {}));
  if (of_pose.share < kGood) take_if_better(search.refined(search.best_of_all_axes(), points, {}));
  constexpr double kMoreFit = 1.005;
  if (of_pose.share < kGood || is_longer_than_face(geometry, points, pose))
    if (const auto on_part = pose_on_part(geometry, points, pose);
        on_part &&
        fits_on_face(geometry, points, *on_part) > kMoreFit * fits_on_face(geometry, points, pose))
      pose = *on_part;
  return least_turned(geometry, pose);
}

}  // namespace trueflank::loop
