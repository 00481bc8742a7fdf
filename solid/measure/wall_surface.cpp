// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/wall_surface.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

BedChamfer bed_of(const Outline& outline) {
  if (const auto* circle = std::get_if<CircleOutline>(&outline)) return circle->bed;
  return std::get<BoreOutline>(outline).bed;
}

}  // namespace

BedDistance::BedDistance(const Outline& outline)
    : outline_(outline),
      bed_(bed_of(outline)),
      above_(outline_at_height(outline, bed_of(outline).height_mm)) {}

double BedDistance::slope_at(double z_mm) const {
  return z_mm < bed_.height_mm ? bed_.grow_mm / bed_.height_mm : 0.0;
}

double BedDistance::distance_mm(const Point3& point) const {
  const bool chamfered = point.z() < bed_.height_mm;
  const double within =
      chamfered ? OutlineDistance(outline_at_height(outline_, point.z())).foot(point.head<2>()).distance_mm
                : above_.foot(point.head<2>()).distance_mm;
  return within / std::hypot(1.0, slope_at(point.z()));
}

double BedDistance::lower_bound_mm(const Point3& point) const {
  const double bound = above_.lower_bound_mm(point.head<2>());
  // corners that stay sharp go farther than the wall: at most twice as far
  const double moved = 2.0 * std::abs(bed_.grow_at_mm(point.z()));
  return std::max(0.0, bound - moved) / std::hypot(1.0, slope_at(point.z()));
}

Point2 BedDistance::point_at_height(std::size_t piece, double parameter, int copy,
                                    double z_mm) const {
  if (!(z_mm < bed_.height_mm))
    return above_.to_outline(point_at(above_.pieces()[piece].curve, parameter), copy);
  const OutlineDistance here(outline_at_height(outline_, z_mm));
  TRUEFLANK_EXPECTS(here.pieces().size() == above_.pieces().size());
  const Curve &design = above_.pieces()[piece].curve, &moved = here.pieces()[piece].curve;
  const double share = (parameter - design.begin) / (design.end - design.begin);
  return here.to_outline(point_at(moved, std::lerp(moved.begin, moved.end, share)), copy);
}

double BedDistance::slope_share(std::size_t, double, int, double z_mm) const {
  return 1.0 / std::hypot(1.0, slope_at(z_mm));
}

double distance_mm(const WallSurface& wall, const Point3& point) {
  return std::visit([&](const auto& w) { return w.distance_mm(point); }, wall);
}
double lower_bound_mm(const WallSurface& wall, const Point3& point) {
  return std::visit([&](const auto& w) { return w.lower_bound_mm(point); }, wall);
}
double undisplaced_z_mm(const WallSurface& wall, const Point3& point) {
  return std::visit([&](const auto& w) { return w.undisplaced_z_mm(point); }, wall);
}
Point2 point_at_height(const WallSurface& wall, std::size_t piece, double parameter, int copy,
                       double z_mm) {
  return std::visit([&](const auto& w) { return w.point_at_height(piece, parameter, copy, z_mm); }, wall);
}
std::vector<double> breaks_at_height(const WallSurface& wall, std::size_t piece, int copy,
                                     double z_mm) {
  return std::visit([&](const auto& w) { return w.breaks_at_height(piece, copy, z_mm); }, wall);
}
double slope_share(const WallSurface& wall, std::size_t piece, double parameter, int copy,
                   double z_mm) {
  return std::visit([&](const auto& w) { return w.slope_share(piece, parameter, copy, z_mm); }, wall);
}

std::optional<WallSurface> wall_surface(const Outline& outline, double from_z_mm) {
  if (const auto* toothed = std::get_if<ToothedOutline>(&outline)) {
    if (is_plain_prism(*toothed)) return std::nullopt;
    return ToothingDistance(*toothed);
  }
  if (!(from_z_mm < bed_height_mm(outline))) return std::nullopt;
  return BedDistance(outline);
}

}  // namespace trueflank
