// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/pose/toothed_length.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>

#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// A point in the ring of the flanks: 1 near a flank, -1 elsewhere.
struct Vote {
  double z_mm = 0.0, fits = 0.0;
};

std::vector<Vote> votes_of(const FlankGeometry& geometry, const ScanPoints& points,
                           const Pose& pose) {
  // modules; of another toothing in the same ring about one point in eight lies as near by chance
  constexpr double kNear = 0.1;
  const double near = kNear * geometry.gear().normal_module_mm;
  const auto [low, high] =
      std::minmax({std::hypot(geometry.base_radius_mm(), geometry.root_form_roll_mm()),
                   std::hypot(geometry.base_radius_mm(), geometry.tip_form_roll_mm())});
  std::vector<Vote> votes;
  for (const auto& p : points) {
    const auto q = pose(p);
    const double radius = std::hypot(q[0], q[1]);
    if (radius < low || radius > high) continue;
    const PlacedPoint placed = geometry.nearest_flank(q, kFlankMargin);
    if (placed.place.surface != Surface::kFlank) continue;
    votes.push_back({q[2], std::abs(placed.distance_mm) < near ? 1.0 : -1.0});
  }
  return votes;
}

ScanPoints between(const ScanPoints& points, const Pose& pose, double low_mm, double high_mm) {
  ScanPoints result;
  std::copy_if(points.begin(), points.end(), std::back_inserter(result), [&](const auto& p) {
    const double z = pose(p)[2];
    return z >= low_mm && z <= high_mm;
  });
  return result;
}

/// Heights of nearly all points.
std::pair<double, double> height_range(const ScanPoints& points, const Pose& pose) {
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const auto& p : points) heights.push_back(pose(p)[2]);
  return {quantile(heights, 0.005), quantile(heights, 0.995)};
}

constexpr std::size_t kPoints = 6000, kFewestPoints = 60;
constexpr double kLonger = 1.05;  // face widths

/// Moved along the axis so that the teeth stand on the face, and turned as their helix asks.
Pose brought_onto_face(const FlankGeometry& geometry, const ToothedLength& length, Pose pose) {
  const double face = geometry.face_width_mm();
  const double along_mm = 0.5 * (face - length.low_mm - length.high_mm);
  // no turn where the hand changes in the middle
  const double turn_rad = geometry.twist_rad(face) * along_mm / face;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.rotation = turn * pose.rotation;
  pose.translation_mm = turn * pose.translation_mm + Eigen::Vector3d(0.0, 0.0, along_mm);
  return pose;
}

/// The pose moved onto the points of the toothed length alone, and these found anew with it.
std::optional<Pose> settled(const FlankGeometry& geometry, const ScanPoints& points, Pose pose) {
  constexpr int kTimes = 3;
  for (int time = 0; time < kTimes; ++time) {
    const ToothedLength length = toothed_length(geometry, points, pose);
    const ScanPoints of_gear = between(points, pose, length.low_mm, length.high_mm);
    if (!(length.fits > 0.0) || of_gear.size() < kFewestPoints) return {};
    pose = PoseSearch(geometry, of_gear)
               .refined(brought_onto_face(geometry, length, pose), of_gear, {});
  }
  if (geometry.is_herringbone()) return pose;  // whose height its flanks tell
  // End faces hold many points at one height: the flanks' own ends tell where the teeth stand.
  return brought_onto_face(geometry, toothed_length(geometry, points, pose), pose);
}

/// Where the gear fits best so far.
struct Placed {
  Pose pose;
  ToothedLength length;
};

/// Seeks the gear at every height along the axis that a rotation brings onto z.
void look_along(const FlankGeometry& geometry, const ScanPoints& points,
                const Eigen::Matrix3d& rotation, Placed& best) {
  constexpr double kStep = 1.0 / 3.0, kMostSteps = 60.0;
  const double face = geometry.face_width_mm();
  const Pose about{rotation, Eigen::Vector3d::Zero()};
  const auto [low, high] = height_range(points, about);
  if (high - low < kLonger * face) return;
  const double steps = std::min(kMostSteps, std::ceil((high - low - face) / (kStep * face)));
  for (double step = 0.0; step <= steps; step += 1.0) {
    const double from = low + step / steps * (high - low - face);
    const ScanPoints window = between(points, about, from, from + face);
    if (window.size() < kFewestPoints) continue;
    const Pose pose = PoseSearch(geometry, window).about(rotation);
    const ToothedLength length = toothed_length(geometry, points, pose);
    if (length.fits > best.length.fits) best = {pose, length};
  }
}

}  // namespace

ToothedLength toothed_length(const FlankGeometry& geometry, const ScanPoints& points,
                             const Pose& pose) {
  constexpr double kMost = 1.01;  // face widths
  std::vector<Vote> votes = votes_of(geometry, points, pose);
  std::sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) {
    return std::pair(a.z_mm, a.fits) < std::pair(b.z_mm, b.fits);
  });
  std::vector<double> sum_before{0.0};
  for (const Vote& vote : votes) sum_before.push_back(sum_before.back() + vote.fits);
  // for every last point the first one within reach before which the sum is least
  ToothedLength best;
  std::deque<std::size_t> firsts;
  for (std::size_t last = 0; last < votes.size(); ++last) {
    while (!firsts.empty() && sum_before[firsts.back()] >= sum_before[last]) firsts.pop_back();
    firsts.push_back(last);
    while (votes[last].z_mm - votes[firsts.front()].z_mm > kMost * geometry.face_width_mm())
      firsts.pop_front();
    const double fits = sum_before[last + 1] - sum_before[firsts.front()];
    if (fits > best.fits)
      best = {votes[firsts.front()].z_mm, votes[last].z_mm, fits,
              static_cast<double>(last - firsts.front() + 1)};
  }
  return best;
}

double fits_on_face(const FlankGeometry& geometry, const ScanPoints& points, const Pose& pose) {
  double sum = 0.0;
  for (const Vote& vote : votes_of(geometry, points, pose))
    if (vote.z_mm >= 0.0 && vote.z_mm <= geometry.face_width_mm()) sum += vote.fits;
  return sum;
}

bool is_longer_than_face(const FlankGeometry& geometry, const ScanPoints& points,
                         const Pose& pose) {
  const auto [low, high] = height_range(thinned(points, kPoints), pose);
  return high - low > kLonger * geometry.face_width_mm();
}

std::optional<Pose> pose_on_part(const FlankGeometry& geometry, const ScanPoints& points,
                                 const Pose& found) {
  constexpr double kFitsWell = 0.6, kSameAxis = 0.05;
  const ScanPoints some = thinned(points, kPoints);
  std::vector<Eigen::Matrix3d> rotations{found.rotation};
  for (const Eigen::Matrix3d& principal : principal_rotations(some))
    if (principal.row(2).cross(found.rotation.row(2)).norm() > kSameAxis)
      rotations.push_back(principal);
  Placed best;
  for (const Eigen::Matrix3d& rotation : rotations) {
    if (best.length.fits > kFitsWell * best.length.points) break;
    look_along(geometry, some, rotation, best);
  }
  return best.length.fits > 0.0 ? settled(geometry, points, best.pose) : std::nullopt;
}

}  // namespace trueflank::loop
