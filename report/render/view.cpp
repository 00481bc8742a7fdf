// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"

namespace trueflank::io {
namespace {

Eigen::Matrix3d turn_of(const ViewDirection& from) {
  const Eigen::Vector3d away = -from.vector();
  const Eigen::Vector3d right(-std::sin(from.azimuth_rad), std::cos(from.azimuth_rad), 0.0);
  Eigen::Matrix3d turn;
  turn.row(0) = right;
  turn.row(1) = away.cross(right);
  turn.row(2) = away;
  return turn;
}

}  // namespace

Eigen::Vector3d ViewDirection::vector() const {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

View View::parallel(const ViewDirection& from, const ViewedBall& ball, double width) {
  View view;
  view.turn_ = turn_of(from);
  view.origin_ = ball.centre;
  view.scale_ = 0.5 * width / ball.radius_mm;
  view.x0_ = view.y0_ = 0.5 * width;
  return view;
}

View View::perspective(const ViewDirection& from, const ViewedBall& ball, double distance_radii) {
  TRUEFLANK_EXPECTS(distance_radii > 1.0);
  View view;
  view.parallel_ = false;
  view.turn_ = turn_of(from);
  view.origin_ = ball.centre + distance_radii * ball.radius_mm * from.vector();
  return view;
}

ViewedPlane View::plane(const Eigen::Vector3d& normal, double offset) const {
  const Eigen::Vector3d n = turn_ * normal;
  const double at_origin = normal.dot(origin_) - offset;
  const double a = n.x() / scale_, b = n.y() / scale_;
  const double c = (parallel_ ? at_origin : n.z()) - a * x0_ - b * y0_;
  return {a, b, c, parallel_ ? -n.z() : at_origin};
}

View View::fitted(const std::vector<Eigen::Vector3d>& points, double width, double height,
                  double margin) const {
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d at = project(p).head<2>();
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Eigen::Vector2d size = (high - low).cwiseMax(1e-12);
  const double grow =
      std::min((width - 2.0 * margin) / size.x(), (height - 2.0 * margin) / size.y());
  View view = *this;
  view.scale_ *= grow;
  view.x0_ = 0.5 * width + grow * (x0_ - 0.5 * (low.x() + high.x()));
  view.y0_ = 0.5 * height + grow * (y0_ - 0.5 * (low.y() + high.y()));
  return view;
}

}  // namespace trueflank::io
