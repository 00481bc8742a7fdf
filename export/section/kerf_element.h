// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/geometry/curve.h"
#include "trueflank/solid/shape/part_shape.h"

// What the path of a wire is put together from.
namespace trueflank::io {

/// One piece of the half outline, or an arc about one of its corners, and its offset.
struct Element {
  Curve curve;  ///< the outline's piece; of a corner: a circle of no radius about it
  double offset_mm = 0.0;  ///< along the outward normal
  bool corner = false;

  [[nodiscard]] double parameter(double u) const { return curve.begin + u * (curve.end - curve.begin); }
  [[nodiscard]] Point2 tangent(double u) const {
    if (!corner) return tangent_at(curve, parameter(u));
    // at a corner the normal turns, from the piece before to the piece after
    return perpendicular(unit_vector(parameter(u)));
  }
  [[nodiscard]] Point2 normal(double u) const {
    if (corner) return unit_vector(parameter(u));
    return -perpendicular(tangent(u));
  }
  [[nodiscard]] Point2 foot(double u) const {
    return corner ? std::get<CircularArc>(curve.shape).centre : point_at(curve, parameter(u));
  }
  [[nodiscard]] Point2 point(double u) const { return foot(u) + offset_mm * normal(u); }
};

/// A stretch of an element that the wire's middle runs.
struct Stretch {
  const Element* element = nullptr;
  double from = 0.0, to = 1.0;
};

/// The half of an outline in its order: of teeth from tooth's to gap's middle, of a bore that above the
/// x axis, from +x to -x. Requires: no circle.
[[nodiscard]] std::vector<Curve> half_outline(const Outline& outline);

}  // namespace trueflank::io
