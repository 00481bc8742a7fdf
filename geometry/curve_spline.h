// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/geometry/curve.h"

namespace trueflank {

/// A curve as cubic Hermite pieces, for nearest points at speed: a trochoid costs several sines and
/// cosines a point, its cubic a few products.
/// Accuracy: within 1e-9 of the curve's size, or 1e-9 mm where it is larger than that, across the
/// curve; tested in tests/geometry/curve_spline_test.cpp.
class CurveSpline {
 public:
  explicit CurveSpline(const Curve& curve);

  struct Foot {
    Point2 point = Point2::Zero();
    double distance_mm = 0.0;
    bool on_left = false;  ///< the point measured lies left of the direction of travel
  };
  /// The foot of the perpendicular near the nearest node; nothing where that is beyond an end, or
  /// not nearer than the limit.
  [[nodiscard]] std::optional<Foot> foot(const Point2& point, double limit_mm) const;

 private:
  class Nodes;
  void keep_radii();
  [[nodiscard]] std::size_t nearest_node(const Point2& point) const;
  std::vector<double> x_, y_, dx_, dy_;  ///< nodes at equal steps of the parameter, derivatives a step
  std::vector<double> radius_mm_;  ///< of the nodes where it rises all the way, negative where it falls
  double low_x_ = 0.0, high_x_ = 0.0, low_y_ = 0.0, high_y_ = 0.0;
};

}  // namespace trueflank
