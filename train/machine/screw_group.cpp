// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/screw_group.h"

#include <algorithm>
#include <cmath>

namespace trueflank {

std::vector<Point2> on_circle(double radius_mm, int count, double first_rad) {
  std::vector<Point2> points;
  for (int i = 0; i < count; ++i)
    points.push_back(radius_mm * unit_vector(first_rad + kTwoPi * i / count));
  return points;
}

double head_depth_mm(const Screw& screw) { return screw.head_height_mm + kHeadCover_mm; }

double under_head_mm(const Screw& screw, double wall_mm) {
  return std::max(kUnderHead * screw.diameter_mm, wall_mm);
}

ScrewGroup with_length(ScrewGroup group, double clamped_mm, double deeper_mm) {
  const Screw& screw = group.screw;
  const double whole = std::abs(group.far_mm - group.head_mm);
  group.shortest_mm = clamped_mm - deeper_mm + screw.diameter_mm;
  group.longest_mm = whole;
  double best = 1e300;
  for (const double length : screw.lengths_mm()) {
    const double deeper = std::max(0.0, clamped_mm + screw.diameter_mm - length);
    if (deeper > deeper_mm || length > whole - deeper || deeper >= best) continue;
    best = deeper;
    group.length_mm = length;
  }
  if (!group.fits()) best = 0.0;
  group.head_mm += group.way * best;
  const double clamped = clamped_mm - best, reach = whole - best;
  const double from = std::clamp(group.length_mm - screw.insert_length_mm, clamped,
                                 std::max(clamped, reach - screw.insert_length_mm));
  group.insert_mm = group.head_mm + group.way * from;
  return group;
}

}  // namespace trueflank
