// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/measured_lands.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// Fewer points than this say nothing of a land; so many of one tooth say where its own is.
constexpr std::size_t kFewestOfAll = 20, kOfOneTooth = 5;

}  // namespace

MeasuredLands::MeasuredLands(const FlankGeometry& geometry, const ScanData& scan, const Pose& pose,
                             double reach_mm)
    : geometry_(geometry),
      normals_(!scan.normals.empty()),
      root_form_mm_(std::hypot(geometry.base_radius_mm(), geometry.root_form_roll_mm())),
      tip_mm_(static_cast<std::size_t>(geometry.teeth()), geometry.tip_radius_mm()) {
  const double pitch = kTwoPi / geometry.teeth(), tip = geometry.tip_radius_mm();
  const double half =
      tooth_half_angle_rad(geometry.gear(), std::max(tip, geometry.base_radius_mm()));
  std::vector<std::vector<double>> of_tooth(tip_mm_.size());
  std::vector<double> tips, roots;
  // Those near a land are picked out on all processors.
  constexpr std::size_t kPointsOfWork = 16384;
  struct NearLand {
    double radius_mm = 0.0, from_first_rad = 0.0;
  };
  std::vector<std::vector<NearLand>> near((scan.points_mm.size() + kPointsOfWork - 1) /
                                          kPointsOfWork);
  for_each_piece(near.size(), [&](std::size_t piece) {
    const std::size_t end = std::min(scan.points_mm.size(), (piece + 1) * kPointsOfWork);
    for (std::size_t i = piece * kPointsOfWork; i < end; ++i) {
      const auto p = pose(scan.points_mm[i]);
      if (p[2] < 0.0 || p[2] > geometry.face_width_mm()) continue;
      const double radius = std::hypot(p[0], p[1]);
      if (std::abs(radius - tip) < reach_mm ||
          std::abs(radius - geometry.root_radius_mm()) < reach_mm)
        near[piece].push_back({radius, std::atan2(p[1], p[0]) - geometry.twist_rad(p[2])});
    }
  });
  const auto sort = [&](double radius, double from_first) {
    const double number = std::round(from_first / pitch),
                 offset = std::abs(from_first - number * pitch);
    const int z = geometry.teeth();
    if (offset < 0.5 * half && std::abs(radius - tip) < reach_mm) {
      of_tooth[static_cast<std::size_t>(((static_cast<int>(number) % z) + z) % z)].push_back(
          radius);
      tips.push_back(radius);
    }
    if (0.5 * pitch - offset < 0.05 * pitch &&
        std::abs(radius - geometry.root_radius_mm()) < reach_mm)
      roots.push_back(radius - geometry.root_radius_mm());
  };
  for (const auto& points : near)
    for (const NearLand& point : points) sort(point.radius_mm, point.from_first_rad);
  if (roots.size() >= kFewestOfAll) root_mm_ = geometry.sense() * median(roots);
  if (tips.size() < kFewestOfAll) return;
  const double whole = median(tips);
  std::vector<double> scatter;
  for (std::size_t k = 0; k < tip_mm_.size(); ++k) {
    tip_mm_[k] = of_tooth[k].size() >= kOfOneTooth ? median(of_tooth[k]) : whole;
    for (const double radius : of_tooth[k]) scatter.push_back(std::abs(radius - tip_mm_[k]));
  }
  guard_mm_ =
      std::min(3.0 * kSigmaOfMedianSize * median(scatter), 0.1 * geometry.gear().normal_module_mm);
}

bool MeasuredLands::covers(const Place& place, const std::array<double, 3>& point) const {
  const double s = geometry_.sense(), radius = std::sqrt(point[0] * point[0] + point[1] * point[1]);
  if (!normals_ && guard_mm_ > 0.0) {
    const double tip = tip_mm_[static_cast<std::size_t>(place.tooth - 1)];
    if (s * (radius - tip) > -guard_mm_) return true;
  }
  // Fillets that moved outwards reach into what the design has as flank.
  return root_mm_ > 0.0 && s * (radius - root_form_mm_) < root_mm_ + guard_mm_;
}

}  // namespace trueflank::loop
