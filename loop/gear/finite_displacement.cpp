// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/finite_displacement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "trueflank/base/threads.h"

namespace trueflank::loop {

namespace {

constexpr std::size_t kRowsMovedAtOnce = 16384;

/// Rows whose places are found together.
constexpr std::size_t kOfOneMotion = 64;
using FoundTogether = std::array<PlacedPoint, kOfOneMotion>;

/// Does `work(from, to)` for runs of neighbours among the rows of scans, on all processors; returns
/// the largest of its results.
template <class Work>
double largest_of_points(const Observations& table, const Work& work) {
  const std::size_t rows = table.points_mm.size();
  std::vector<double> largest((rows + kRowsMovedAtOnce - 1) / kRowsMovedAtOnce, 0.0);
  for_each_piece(largest.size(), [&](std::size_t piece) {
    const std::size_t end = std::min(rows, (piece + 1) * kRowsMovedAtOnce);
    double most = 0.0;
    for (std::size_t i = piece * kRowsMovedAtOnce; i < end; i += kOfOneMotion)
      most = std::max(most, work(i, std::min(end, i + kOfOneMotion)));
    largest[piece] = most;
  });
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

/// Rows of scanned flanks from ... to - 1, and their places as designed.
std::vector<std::size_t> flanks_as_designed(const FlankGeometry& geometry,
                                            const Observations& table, std::size_t from,
                                            std::size_t to, FoundTogether& placed) {
  std::vector<std::size_t> rows;
  rows.reserve(to - from);
  for (std::size_t i = from; i < to; ++i)
    if (table.rows[i].kind == ObservationKind::kScanFlank) rows.push_back(i);
  as_designed(geometry, table, rows, placed.data());
  return rows;
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
  /// `take(i, moved)` for rows from ... to - 1, kOfOneMotion at most: where their points lay, and
  /// their deviations there; not for what is on no flank, or would come onto another one.
  template <class Take>
  void for_rows(const Observations& table, std::span<const std::size_t> rows,
                const Take& take) const {
    std::array<std::array<double, 3>, kOfOneMotion> points;
    FoundTogether placed;
    std::array<std::size_t, kOfOneMotion> on_flanks;
    std::size_t count = 0;
    for (const std::size_t i : rows) {
      if (table.rows[i].kind != ObservationKind::kScanFlank) continue;
      on_flanks[count] = i;
      points[count++] = moved_back(table.points_mm[i]);
    }
    geometry_.nearest_flanks({points.data(), count}, 0.0, placed.data());
    for (std::size_t k = 0; k < count; ++k)
      if (const auto moved = moved_of(table, on_flanks[k], placed[k])) take(on_flanks[k], *moved);
  }

 private:
  [[nodiscard]] std::optional<Moved> moved_of(const Observations& table, std::size_t i,
                                              const PlacedPoint& placed) const {
    const Observation& row = table.rows[i];
    const Place& place = table.places[row.first_place];
    if (placed.place.tooth != place.tooth || placed.place.side != place.side ||
        !(placed.place.roll_mm > 0.0))
      return {};
    const double left_um = um_from_mm(placed.distance_mm);
    Moved moved{placed.place, left_um + moved_by_um(placed.place),
                left_um - (row.deviation_um - moved_by_um(place))};
    moved.place.surface = place.surface;
    return moved;
  }

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
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.points_mm.size();) {
    rows.clear();
    for (; rows.size() < kOfOneMotion && i < table.points_mm.size(); i += stride) rows.push_back(i);
    move_back.for_rows(table, rows, [&](std::size_t, const MoveBack::Moved& moved) {
      most = std::max(most, std::abs(moved.change_um));
    });
  }
  return most;
}

double linearise_at(const FlankGeometry& geometry, const PointFit& fit, Observations& table) {
  const MoveBack move_back(geometry, fit);
  table.is_displaced = true;
  return largest_of_points(table, [&](std::size_t from, std::size_t to) {
    std::array<std::size_t, kOfOneMotion> rows;
    std::iota(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(to - from), from);
    double most = 0.0;
    move_back.for_rows(table, {rows.data(), to - from},
                       [&](std::size_t i, const MoveBack::Moved& moved) {
                         Observation& row = table.rows[i];
                         row.deviation_um = moved.deviation_um;
                         table.places[row.first_place] = moved.place;
                         most = std::max(most, std::abs(moved.change_um));
                       });
    return most;
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
  largest_of_points(table, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i)
      table.points_mm[i] = by[static_cast<std::size_t>(table.rows[i].source)](table.points_mm[i]);
    FoundTogether placed;
    flanks_as_designed(geometry, table, from, to, placed);
    std::size_t next = 0;
    for (std::size_t i = from; i < to; ++i) {
      Observation& row = table.rows[i];
      Place& place = table.places[row.first_place];
      const PlacedPoint own = row.kind == ObservationKind::kScanFlank
                                  ? placed[next++]
                                  : geometry.nearest(table.points_mm[i], reach_mm);
      if (own.place.surface != place.surface) continue;
      row.deviation_um = um_from_mm(own.distance_mm);
      place = own.place;
    }
    return 0.0;
  });
  table.is_displaced = false;
}

void move_points(const FlankGeometry& geometry, const std::vector<std::size_t>& rows,
                 const std::array<double, 3>& by_mm, Observations& table) {
  for (const std::size_t row : rows)
    for (std::size_t k = 0; k < 3; ++k) table.points_mm[row][k] += by_mm[k];
  table.is_displaced = true;
  undo_displacement(geometry, table);
}

void undo_displacement(const FlankGeometry& geometry, Observations& table) {
  if (!table.is_displaced) return;
  largest_of_points(table, [&](std::size_t from, std::size_t to) {
    FoundTogether placed;
    const std::vector<std::size_t> rows = flanks_as_designed(geometry, table, from, to, placed);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      Observation& row = table.rows[rows[k]];
      row.deviation_um = um_from_mm(placed[k].distance_mm);
      table.places[row.first_place] = placed[k].place;
    }
    return 0.0;
  });
  table.is_displaced = false;
}

}  // namespace trueflank::loop
