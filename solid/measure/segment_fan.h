// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "trueflank/geometry/point2.h"

namespace trueflank {

/// Turns with the direction as an angle does, from 0 to 4 ("diamond angle"), and never faster than the
/// angle in radians; without its arc tangent.
[[nodiscard]] inline double diamond_angle(const Point2& p) {
  const double sum = std::abs(p.x()) + std::abs(p.y());
  if (sum == 0.0) return 0.0;
  if (p.y() >= 0.0) return p.x() >= 0.0 ? p.y() / sum : 1.0 - p.x() / sum;
  return p.x() < 0.0 ? 2.0 - p.y() / sum : 3.0 + p.x() / sum;
}

inline constexpr double kDiamondTurn = 4.0;

struct Segment {
  Point2 a, b;
};

/// Segments of a cut, found by their direction seen from a centre.
class SegmentFan {
 public:
  SegmentFan(std::vector<Segment> segments, const Point2& centre);

  [[nodiscard]] bool empty() const { return segments_.empty(); }
  /// To the nearest segment; infinity without any.
  [[nodiscard]] double distance_mm(const Point2& p) const;

 private:
  [[nodiscard]] std::size_t bin_of(double angle) const;
  void visit(std::size_t bin, const Point2& p, double& best) const;

  std::vector<Segment> segments_;
  Point2 centre_;
  std::size_t bins_ = 1;
  std::vector<std::size_t> begin_, members_;
};

}  // namespace trueflank
