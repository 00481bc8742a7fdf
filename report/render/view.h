// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trueflank::io {

/// A direction from the model to who looks at it: angle about z from +x, and height above the
/// plane.
struct ViewDirection {
  double azimuth_rad = 0.0, elevation_rad = 0.0;

  /// Of length 1.
  [[nodiscard]] Eigen::Vector3d vector() const;
};

/// A ball about what is seen.
struct ViewedBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_mm = 1.0;
};

/// A plane as a view has it: a x + b y + c + e nearness is above 0 on the side of its normal.
struct ViewedPlane {
  double a = 0.0, b = 0.0, c = 0.0, e = 0.0;
};

/// Where points of space fall in a picture. x grows to the right, y downwards, in steps of samples.
/// `nearness` grows towards the viewer; planes are linear in x, y and nearness.
class View {
 public:
  /// Seen from infinitely far; the ball just fits into a square of this width.
  [[nodiscard]] static View parallel(const ViewDirection& from, const ViewedBall& ball,
                                     double width);
  /// Seen from as many radii of the ball. Requires: above 1.
  [[nodiscard]] static View perspective(const ViewDirection& from, const ViewedBall& ball,
                                        double distance_radii);

  /// x, y, nearness.
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d v = turn_ * (p - origin_);
    if (parallel_) return {x0_ + scale_ * v.x(), y0_ + scale_ * v.y(), -v.z()};
    const double nearness = 1.0 / v.z();
    return {x0_ + scale_ * v.x() * nearness, y0_ + scale_ * v.y() * nearness, nearness};
  }
  [[nodiscard]] Eigen::Vector3d unproject(double x, double y, double nearness) const {
    const Eigen::Vector3d v((x - x0_) / scale_, (y - y0_) / scale_, 1.0);
    if (parallel_) return origin_ + turn_.transpose() * Eigen::Vector3d(v.x(), v.y(), -nearness);
    return origin_ + turn_.transpose() * (v / nearness);
  }
  /// Of the half space normal . p > offset.
  [[nodiscard]] ViewedPlane plane(const Eigen::Vector3d& normal, double offset) const;
  /// From a point to the viewer, of length 1.
  [[nodiscard]] Eigen::Vector3d to_viewer(const Eigen::Vector3d& p) const {
    if (parallel_) return -turn_.row(2).transpose();
    return (origin_ - p).normalized();
  }
  /// The same view, moved and scaled so that the points fill a picture but for a margin.
  [[nodiscard]] View fitted(const std::vector<Eigen::Vector3d>& points, double width, double height,
                            double margin) const;

 private:
  bool parallel_ = true;
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity();  ///< rows: right, down, away from the viewer
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();    ///< the eye, or the ball's centre
  double scale_ = 1.0, x0_ = 0.0, y0_ = 0.0;
};

}  // namespace trueflank::io
