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
  static constexpr double kError = 1e-9;

  /// `error`: what pieces may be off by across the curve, where the accuracy above is more than is asked for.
  explicit CurveSpline(const Curve& curve, double error = kError);

  struct Foot {
    Point2 point = Point2::Zero();
    double distance_mm = 0.0;
    bool on_left = false;  ///< the point measured lies left of the direction of travel
  };
  struct Search {
    std::optional<Foot> foot;
    double least_mm = 0.0;  ///< nowhere is the curve nearer to the point than this
  };
  /// The foot of the perpendicular near the nearest node; nothing where that is beyond an end, or
  /// not nearer than the limit.
  [[nodiscard]] Search search(const Point2& point, double limit_mm) const;
  [[nodiscard]] std::optional<Foot> foot(const Point2& point, double limit_mm) const;

 private:
  class Nodes;
  void keep_radii();
  [[nodiscard]] double square_to_box(const Point2& point) const;
  [[nodiscard]] std::size_t nearest_node(const Point2& point) const;
  [[nodiscard]] std::optional<Foot> foot_beside(std::size_t node, const Point2& point, double limit_mm) const;
  std::vector<double> x_, y_, dx_, dy_;  ///< nodes at equal steps of the parameter, derivatives a step
  std::vector<double> radius_mm_;  ///< of the nodes where it rises all the way, negative where it falls
  double longest_mm_ = 0.0;  ///< between neighbouring nodes
  double low_x_ = 0.0, high_x_ = 0.0, low_y_ = 0.0, high_y_ = 0.0;
};

}  // namespace trueflank
