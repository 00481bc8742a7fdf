// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/ring_criteria.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/polyline.h"

namespace trueflank {
namespace {

constexpr int kRotations = 64;
constexpr double kSeenOverhang = 1e-3;      // of the module
constexpr double kRemovalChord = 2e-4;      // of the module

/// Half the angle of the tip, between the corners where tip circle and flank meet.
double tip_half_angle_rad(const ToothProfile& profile) {
  return 0.5 * profile.tip_thickness_mm() / profile.tip_radius_mm();
}

/// How far the ring's corner at polar angle phi2 lags when the pinion's stands at phi1.
double corner_margin_rad(const GearPair& pair, double phi1, double phi2) {
  const double ratio = static_cast<double>(pair.gear1().teeth) / pair.gear2().teeth;
  const double ring_corner = ratio * (phi1 - tip_half_angle_rad(*pair.profile1)) +
                             kPi / pair.gear2().teeth - tip_half_angle_rad(*pair.profile2);
  return ring_corner - phi2;
}

/// A piece of an outline; for the ring also the direction into the space.
struct Edge {
  Point2 a, b;
};

/// Outline of the teeth of a gear whose middles lie within an angle from +x.
std::vector<Edge> outline_near_mesh(const HalfToothPolyline& half, int teeth, double rotation_rad,
                                    double reach_rad, const Point2& centre_mm) {
  std::vector<Edge> edges;
  const double pitch = kTwoPi / teeth;
  const int first = static_cast<int>(std::ceil((-reach_rad - rotation_rad) / pitch));
  const int last = static_cast<int>(std::floor((reach_rad - rotation_rad) / pitch));
  for (int k = first; k <= last; ++k) {
    const double turn = rotation_rad + pitch * k;
    for (std::size_t i = 0; i + 1 < half.points.size(); ++i) {
      const Point2 &p = half.points[i], &q = half.points[i + 1];
      edges.push_back({centre_mm + rotated(p, turn), centre_mm + rotated(q, turn)});
      edges.push_back({centre_mm + rotated(mirrored(q), turn), centre_mm + rotated(mirrored(p), turn)});
    }
    if (!half.vertex_at_tooth_middle)
      edges.push_back({centre_mm + rotated(mirrored(half.points.front()), turn),
                       centre_mm + rotated(half.points.front(), turn)});
  }
  return edges;
}

/// The edges of the pinion where +x enters it (they run down), by their height above the line of centres.
class EntryWalls {
 public:
  EntryWalls(const std::vector<Edge>& pinion, double bin_mm) : bin_mm_(bin_mm) {
    for (const Edge& edge : pinion) {
      if (!(edge.a.y() > edge.b.y()) || edge.a.y() < 0.0) continue;
      const std::size_t from = bin(std::max(edge.b.y(), 0.0)), to = bin(edge.a.y());
      if (bins_.size() <= to) bins_.resize(to + 1);
      for (std::size_t k = from; k <= to; ++k) bins_[k].push_back(edge);
    }
  }

  /// Whether a wall stands within `travel_mm` of a point in +x.
  [[nodiscard]] bool ahead(const Point2& from, double travel_mm) const {
    if (from.y() < 0.0 || bin(from.y()) >= bins_.size()) return false;
    for (const Edge& wall : bins_[bin(from.y())]) {
      if (!(wall.a.y() > from.y() && wall.b.y() <= from.y())) continue;
      const double u = (from.y() - wall.a.y()) / (wall.b.y() - wall.a.y());
      const double x = wall.a.x() + u * (wall.b.x() - wall.a.x());
      if (x > from.x() && x - from.x() < travel_mm) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] std::size_t bin(double y) const { return static_cast<std::size_t>(y / bin_mm_); }
  double bin_mm_;
  std::vector<std::vector<Edge>> bins_;
};

/// Does pinion material stand beyond the ring's edge, seen in +x, so that it cannot move in -x? Looks at
/// the upper half only: the other is the mirror image of another rotation.
/// Edges run counter-clockwise; the ring's space is on the left of its edges.
bool blocked(const EntryWalls& pinion, const std::vector<Edge>& ring, double travel_mm,
             double seen_mm) {
  for (const Edge& edge : ring) {
    const Point2 along = edge.b - edge.a;
    const double length = along.norm();
    if (length == 0.0) continue;
    // a little into the space, so that flanks that only touch do not block
    if (pinion.ahead(edge.a + perpendicular(along) * (seen_mm / length), travel_mm)) return true;
  }
  return false;
}

}  // namespace

double trochoid_margin_rad(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.internal());
  const double a = pair.centre_distance_mm;
  const double r1 = pair.profile1->tip_radius_mm(), r2 = pair.profile2->tip_radius_mm();
  const double cos1 = (r2 * r2 - r1 * r1 - a * a) / (2.0 * a * r1);
  const double cos2 = (a * a + r2 * r2 - r1 * r1) / (2.0 * a * r2);
  if (cos1 >= 1.0) return std::numeric_limits<double>::infinity();
  if (cos1 <= -1.0 || std::abs(cos2) >= 1.0) return kNaN;
  return corner_margin_rad(pair, std::acos(cos1), std::acos(cos2));
}

double trimming_margin_rad(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.internal());
  const double r1 = pair.profile1->tip_radius_mm(), r2 = pair.profile2->tip_radius_mm();
  if (r1 >= r2) return kNaN;
  const double s = static_cast<double>(pair.gear1().teeth) / pair.gear2().teeth;
  const double sine1 =
      std::sqrt(std::clamp((1.0 - s * s * r2 * r2 / (r1 * r1)) / (1.0 - s * s), 0.0, 1.0));
  return corner_margin_rad(pair, std::asin(sine1), std::asin(r1 / r2 * sine1));
}

RadialRemoval radial_removal(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.internal());
  const double m = pair.gear1().normal_module_mm, a = pair.centre_distance_mm;
  const double r1 = pair.profile1->tip_radius_mm(), r2 = pair.profile2->tip_radius_mm();
  RadialRemoval removal;
  if (r1 >= r2) return removal;
  const double travel = a - (r2 - r1);
  const int z1 = pair.gear1().teeth, z2 = pair.gear2().teeth;
  const double pitch1 = kTwoPi / z1, pitch2 = kTwoPi / z2;
  const double cos1 = std::clamp((r2 * r2 - r1 * r1 - a * a) / (2.0 * a * r1), -1.0, 1.0);
  const double cos2 = std::clamp((a * a + r2 * r2 - r1 * r1) / (2.0 * a * r2), -1.0, 1.0);
  const double reach1 = std::min(std::acos(cos1) + 1.5 * pitch1, 0.5 * kPi);
  const double reach2 = std::min(std::acos(cos2) + 1.5 * pitch2, 0.5 * kPi);
  const HalfToothPolyline half1 = tessellate(*pair.profile1, kRemovalChord * m);
  const HalfToothPolyline half2 = tessellate(*pair.profile2, kRemovalChord * m);
  std::vector<bool> upper(kRotations);
  for (int i = 0; i < kRotations; ++i) {
    const double turn = pitch1 * i / kRotations;
    const auto pinion = outline_near_mesh(half1, z1, turn, reach1, Point2::Zero());
    const auto ring = outline_near_mesh(half2, z2, turn * z1 / z2 + 0.5 * pitch2, reach2,
                                        Point2(-a, 0.0));
    upper[static_cast<std::size_t>(i)] = 
        blocked(EntryWalls(pinion, 0.1 * m), ring, travel, kSeenOverhang * m);
  }
  int free = 0;
  for (int i = 0; i < kRotations; ++i) {
    const auto mirror = static_cast<std::size_t>((kRotations - i) % kRotations);
    if (!upper[static_cast<std::size_t>(i)] && !upper[mirror]) ++free;
  }
  removal.free_share = static_cast<double>(free) / kRotations;
  removal.at_every_rotation = free == kRotations;
  removal.at_some_rotation = free > 0;
  return removal;
}

}  // namespace trueflank
