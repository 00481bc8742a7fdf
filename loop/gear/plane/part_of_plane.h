// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effect.h"

namespace trueflank::loop {

/// A part of the transverse plane, at all heights: between two bounds, beyond one, or a disc. As it
/// stands among the shape values of a form.
struct PartOfPlane {
  enum Kind { kStrip, kBeyond, kDisc };
  static constexpr std::size_t kValues = 8;

  Kind kind = kStrip;
  double direction_deg = 0.0;  ///< across the bounds
  double from_mm = 0.0;        ///< the bound, or the nearer one of a strip, along that direction
  double to_mm = 0.0;          ///< the other bound of a strip
  double x_mm = 0.0, y_mm = 0.0, radius_mm = 0.0;  ///< of a disc
  double edge_mm = 0.0;  ///< over what it begins and ends, from a tenth to nine tenths, about

  [[nodiscard]] static PartOfPlane at(const EffectShape& shape) {
    return {static_cast<Kind>(static_cast<int>(shape[0])),
            shape[1],
            shape[2],
            shape[3],
            shape[4],
            shape[5],
            shape[6],
            shape[7]};
  }
  [[nodiscard]] EffectShape shape() const {
    return {double(kind), direction_deg, from_mm, to_mm, x_mm, y_mm, radius_mm, edge_mm};
  }
  /// How far a place lies along the direction, or from the middle of a disc [mm].
  [[nodiscard]] double along_mm(double x, double y) const {
    if (kind == kDisc) return std::hypot(x - x_mm, y - y_mm);
    const double direction = rad_from_deg(direction_deg);
    return x * std::cos(direction) + y * std::sin(direction);
  }
  /// 1 in the part, 0 outside, of a place that lies so far along.
  [[nodiscard]] double value_at(double along) const;
  [[nodiscard]] double value(double x, double y) const { return value_at(along_mm(x, y)); }
  /// Bounds, directions and places that were sought.
  [[nodiscard]] int values_sought() const {
    return (kind == kBeyond ? 2 : 3) + (edge_mm > 0.0 ? 1 : 0);
  }
  /// Neither narrower than a flank tells nor so soft that it is a swelling, and not about the axis.
  [[nodiscard]] bool is_distinct(double radius_of_gear_mm) const;
  /// The same moved, turned, wider or narrower, by shares of a gear's radius.
  [[nodiscard]] std::vector<PartOfPlane> beside(double radius_of_gear_mm) const;
  /// "where x lies between 2.8 mm and 7.9 mm"
  [[nodiscard]] std::string words() const;
};

}  // namespace trueflank::loop
