// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/finite_displacement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/threads.h"

namespace trueflank::loop {

namespace {

constexpr std::size_t kRowsOfWork = 16384;

/// Does `work(i)` for every row of a scan, on all processors; returns the largest of its results.
template <class Work>
double largest_of_points(const Observations& table, const Work& work) {
  const std::size_t rows = table.points_mm.size();
  std::vector<double> largest((rows + kRowsOfWork - 1) / kRowsOfWork, 0.0);
  for_each_piece(largest.size(), [&](std::size_t piece) {
    const std::size_t end = std::min(rows, (piece + 1) * kRowsOfWork);
    double most = 0.0;
    for (std::size_t i = piece * kRowsOfWork; i < end; ++i) most = std::max(most, work(i));
    largest[piece] = most;
  });
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

}  // namespace

namespace {

/// Moves points of scanned flanks back by what a fit says moved them.
class MoveBack {
 public:
  MoveBack(const FlankGeometry& geometry, const PointFit& fit) : geometry_(geometry), fit_(fit) {
    for (int e = 0; e < static_cast<int>(fit.effects().size()); ++e)
      if (fit.effects()[static_cast<std::size_t>(e)].family->displacement_mm) body_.push_back(e);
  }

  struct Moved {
    Place place;
    double deviation_um = 0.0;
    double change_um = 0.0;  ///< of what the fit leaves there
  };
  /// Where a row's point lay, and its deviation there; nothing where it is on no flank, or would
  /// come onto another one.
  [[nodiscard]] std::optional<Moved> operator()(const Observations& table, std::size_t i) const {
    const Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kScanFlank) return {};
    const Place& place = table.places[row.first_place];
    const PlacedPoint placed = geometry_.nearest_flank(moved_back(table.points_mm[i]));
    if (placed.place.tooth != place.tooth || placed.place.side != place.side ||
        !(placed.place.roll_mm > 0.0))
      return {};
    const double left_um = um_from_mm(placed.distance_mm);
    Moved moved{placed.place, left_um + moved_by_um(placed.place),
                left_um - (row.deviation_um - moved_by_um(place))};
    moved.place.surface = place.surface;
    return moved;
  }

 private:
  /// What the columns say the displacement does at a place.
  [[nodiscard]] double moved_by_um(const Place& place) const {
    double sum = 0.0, values[8];
    for (const int e : body_) {
      const Effect& effect = fit_.effects()[static_cast<std::size_t>(e)];
      effect.evaluate(geometry_, place, values);
      for (int k = 0; k < effect.columns(); ++k)
        sum += values[k] * fit_.coefficients()[fit_.first_column(e) + k];
    }
    return sum;
  }
  [[nodiscard]] std::array<double, 3> moved_back(const std::array<double, 3>& p) const {
    std::array<double, 3> back = p;
    // The displacement belongs to the point before it was moved: two steps find it.
    for (int step = 0; step < 2; ++step) {
      std::array<double, 3> q = p;
      for (const int e : body_) {
        const Effect& effect = fit_.effects()[static_cast<std::size_t>(e)];
        const auto u = effect.family->displacement_mm(
            geometry_, back, effect.shape, fit_.coefficients().data() + fit_.first_column(e));
        for (std::size_t k = 0; k < 3; ++k) q[k] -= u[k];
      }
      back = q;
    }
    return back;
  }

  const FlankGeometry& geometry_;
  const PointFit& fit_;
  std::vector<int> body_;
};

}  // namespace

double change_of_sample_um(const FlankGeometry& geometry, const PointFit& fit,
                           const Observations& table) {
  constexpr std::size_t kSample = 8192;
  const MoveBack move_back(geometry, fit);
  const std::size_t stride = std::max<std::size_t>(1, table.points_mm.size() / kSample);
  double most = 0.0;
  for (std::size_t i = 0; i < table.points_mm.size(); i += stride)
    if (const auto moved = move_back(table, i))
      most = std::max(most, std::abs(moved->change_um));
  return most;
}

double linearise_at(const FlankGeometry& geometry, const PointFit& fit, Observations& table) {
  const MoveBack move_back(geometry, fit);
  table.is_displaced = true;
  return largest_of_points(table, [&](std::size_t i) {
    const auto moved = move_back(table, i);
    if (!moved) return 0.0;
    Observation& row = table.rows[i];
    row.deviation_um = moved->deviation_um;
    table.places[row.first_place] = moved->place;
    return std::abs(moved->change_um);
  });
}

std::vector<Pose> poses_beside(const FlankGeometry& geometry, const PointFit& fit,
                               const Observations& table) {
  constexpr double kHeight = 0.005;  // of the face
  const NuisanceColumns nuisance(geometry, table);
  const double middle_mm = 0.5 * geometry.face_width_mm();
  const double radius_mm = std::max(geometry.tip_radius_mm(), geometry.root_radius_mm());
  std::vector<Pose> back(table.poses.size());
  bool moves = false;
  for (std::size_t s = 0; s < back.size(); ++s) {
    if (!table.pose_is_free[s]) continue;
    const Eigen::VectorXd by =
        1e-3 * fit.coefficients().segment(nuisance.first_of(s), NuisanceColumns::kOfFreePose);
    const Eigen::Vector3d turn(by[3], by[4], by[0]), middle(0.0, 0.0, middle_mm);
    moves = moves || std::hypot(by[3], by[4]) * radius_mm > kHeight * geometry.face_width_mm();
    if (turn.norm() > 0.0)
      back[s].rotation = Eigen::AngleAxisd(-turn.norm(), turn.normalized()).toRotationMatrix();
    back[s].translation_mm =
        middle - back[s].rotation * (middle + Eigen::Vector3d(by[1], by[2], 0.0));
  }
  if (!moves) back.clear();
  return back;
}

void move_scans(const FlankGeometry& geometry, const std::vector<Pose>& by, Observations& table) {
  for (std::size_t s = 0; s < by.size(); ++s) {
    Pose& pose = table.poses[s];
    pose.rotation = by[s].rotation * pose.rotation;
    pose.translation_mm = by[s].rotation * pose.translation_mm + by[s].translation_mm;
  }
  const double reach_mm = kReachOfNearest * geometry.gear().normal_module_mm;
  largest_of_points(table, [&](std::size_t i) {
    Observation& row = table.rows[i];
    auto& point = table.points_mm[i];
    point = by[static_cast<std::size_t>(row.source)](point);
    Place& place = table.places[row.first_place];
    const PlacedPoint placed = row.kind == ObservationKind::kScanFlank
                                   ? as_designed(geometry, table, i)
                                   : geometry.nearest(point, reach_mm);
    if (placed.place.surface == place.surface) {
      row.deviation_um = um_from_mm(placed.distance_mm);
      place = placed.place;
    }
    return 0.0;
  });
  table.is_displaced = false;
}

void undo_displacement(const FlankGeometry& geometry, Observations& table) {
  if (!table.is_displaced) return;
  largest_of_points(table, [&](std::size_t i) {
    Observation& row = table.rows[i];
    if (row.kind != ObservationKind::kScanFlank) return 0.0;
    const PlacedPoint placed = as_designed(geometry, table, i);
    row.deviation_um = um_from_mm(placed.distance_mm);
    table.places[row.first_place] = placed.place;
    return 0.0;
  });
  table.is_displaced = false;
}

}  // namespace trueflank::loop
