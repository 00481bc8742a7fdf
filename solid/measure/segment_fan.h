// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/geometry/point2.h"

namespace trueflank {

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
  [[nodiscard]] std::size_t bin_of(double diamond_angle) const;
  void visit(std::size_t bin, const Point2& p, double& best) const;

  std::vector<Segment> segments_;
  Point2 centre_;
  std::size_t bins_ = 1;
  std::vector<std::size_t> begin_, members_;
};

}  // namespace trueflank
