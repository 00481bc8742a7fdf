// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/section/kerf_element.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank::io {
namespace {

Curve line_from(const Point2& a, const Point2& b) {
  const double length = (b - a).norm();
  return {StraightLine{a, (b - a) / length}, 0.0, length};
}

std::vector<Curve> half_bore(const BoreDesign& bore) {
  std::vector<Curve> half;
  for (const BoreEdge& edge : bore_edges(bore)) {
    if (edge.arc) {
      const double begin = polar_angle_rad(edge.from);
      double angle = wrapped_rad(polar_angle_rad(edge.to) - begin);
      if (angle == 0.0) angle = kTwoPi;
      const double from = std::max(begin, 0.0), to = std::min(begin + angle, kPi);
      if (to > from)
        half.push_back({CircularArc{Point2::Zero(), 0.5 * bore.diameter_mm}, from, to});
      continue;
    }
    Point2 a = edge.from, b = edge.to;
    if (a.y() <= 0.0 && b.y() <= 0.0) continue;
    const auto on_axis = [&] { return Point2(a + (b - a) * (a.y() / (a.y() - b.y()))); };
    if (a.y() < 0.0) a = Point2(on_axis().x(), 0.0);
    else if (b.y() < 0.0) b = Point2(on_axis().x(), 0.0);
    half.push_back(line_from(a, b));
  }
  std::sort(half.begin(), half.end(), [](const Curve& p, const Curve& q) {
    const auto middle = [](const Curve& c) {
      return polar_angle_rad(point_at(c, 0.5 * (c.begin + c.end)));
    };
    return middle(p) < middle(q);
  });
  return half;
}

}  // namespace

std::vector<Curve> half_outline(const Outline& outline) {
  const auto* toothed = std::get_if<ToothedOutline>(&outline);
  if (toothed == nullptr) return half_bore(std::get<BoreOutline>(outline).bore);
  std::vector<Curve> half;
  for (const ProfilePiece& piece : toothed->profile->pieces()) half.push_back(piece.curve);
  return half;
}

}  // namespace trueflank::io
