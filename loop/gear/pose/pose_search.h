// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/pose/pose.h"

namespace trueflank::loop {

using ScanPoints = std::vector<std::array<double, 3>>;

/// Every n-th point, so that at most about `most` remain: the same points every time.
[[nodiscard]] ScanPoints thinned(const ScanPoints& points, std::size_t most);

/// Rotations that bring each principal direction of the points onto z, far points left out.
[[nodiscard]] std::array<Eigen::Matrix3d, 3> principal_rotations(const ScanPoints& points);

/// Poses of points on a gear, from several starts.
class PoseSearch {
 public:
  PoseSearch(const FlankGeometry& geometry, const ScanPoints& points)
      : geometry_(geometry),
        few_(thinned(points, 300)),
        coarse_(thinned(points, 1500)),
        fine_(thinned(points, 6000)) {}

  /// Axis by principal directions.
  [[nodiscard]] Pose best() const;
  /// The same with axes that no principal direction comes near: of a pinion about 2.4 times as long
  /// as its radius the points scatter alike in all directions.
  [[nodiscard]] Pose best_of_all_axes() const;
  /// The same from where the scan stands, as of one that was aligned roughly: a few teeth show
  /// neither the axis nor its place.
  [[nodiscard]] Pose best_as_it_stands() const;
  /// With the axis that a rotation brings onto z: centre by the tip circle, phase by trial.
  [[nodiscard]] Pose about(const Eigen::Matrix3d& rotation) const;
  /// When a refinement ends: after so many rounds, or where the step is smaller than `still` [mm
  /// and rad] and the weights hardly change any more.
  struct Rounds {
    int rounds = 8;
    double still = 1e-8;
  };
  /// Gauss-Newton with Tukey weights whose width follows the residual down.
  [[nodiscard]] Pose refined(Pose pose, const ScanPoints& points, const Rounds& limits) const;

 private:
  using Vector5 = Eigen::Matrix<double, 5, 1>;

  /// How unlike their distances from an axis are, and how far points lie beyond the faces: mean
  /// square [mm^2].
  [[nodiscard]] double unlike_a_cylinder(const Eigen::Vector3d& axis,
                                         const ScanPoints& points) const;
  /// Directions about which the points lie in the ring of the teeth best, found on a grid of all
  /// and moved to where they do most.
  [[nodiscard]] std::vector<Eigen::Vector3d> likeliest_axes(std::size_t most) const;
  /// Middle of the points' height range onto the middle of the face.
  void place_height(Pose& pose, const ScanPoints& points) const;
  /// Axis on z, centre by the tip circle.
  [[nodiscard]] Pose start(const Eigen::Matrix3d& rotation) const;
  /// Algebraic circle through all points: right within the tooth height for any sector.
  [[nodiscard]] static Eigen::Vector2d circle_centre(const Pose& pose, const ScanPoints& points);
  /// Step of the centre that brings the outermost (ring: innermost) points of each pitch onto the
  /// tip circle.
  [[nodiscard]] Eigen::Vector2d tip_circle_step(const Pose& pose,
                                                const Eigen::Vector2d& centre) const;
  /// Infinite where it is certainly more than `most`: what comes to that is not looked at to the
  /// end.
  [[nodiscard]] double cost(const Pose& pose, const ScanPoints& points,
                            double most = kInfinite) const;
  /// Best turn about the axis (and small shift), by trial, of herringbone gears with either end up;
  /// returns its cost.
  [[nodiscard]] double search_phase(Pose& pose) const;
  [[nodiscard]] double search_phase_as_it_stands(Pose& pose) const;
  /// Tells the cost of every pose that is among the `best` cheapest, on all processors; others may
  /// get an infinite one. Which of them do depends on the order of work, the cheapest do not.
  void judge(std::vector<std::pair<double, Pose>>& tried, const ScanPoints& points,
             std::size_t best) const;
  /// Step (dx, dy, rotation vector) of one Gauss-Newton round; the width is the reach, then
  /// follows.
  Vector5 newton_step(const Pose& pose, const ScanPoints& points, double& width) const;
  /// Step along the axis that the two hands of a herringbone gear ask for.
  [[nodiscard]] double height_step_mm(const Pose& pose, const ScanPoints& points,
                                      double width) const;

  static constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const FlankGeometry& geometry_;
  ScanPoints few_, coarse_, fine_;
};

}  // namespace trueflank::loop
