// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/ring_criteria.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/polyline.h"

namespace trueflank {
namespace {

constexpr int kRotations = 64;
constexpr double kSeenOverhang = 1e-3;      // of the module
constexpr double kRemovalChord = 2e-4;      // of the module

/// A point of a tip at which it may run into another.
struct TipPoint {
  double radius_mm = 0.0;
  double half_angle_rad = 0.0;  ///< from the tooth's middle
};

/// The corner where tip circle and flank meet, and the points of a rounding, of one half of the tooth.
std::vector<TipPoint> tip_points(const ToothProfile& profile, bool clockwise) {
  const auto& pieces = clockwise ? profile.clockwise_pieces() : profile.pieces();
  const Curve& first = pieces.front().curve;
  const bool pointed = pieces.front().kind != PieceKind::kTip;
  std::vector<TipPoint> points{{profile.tip_radius_mm(), pointed ? 0.0 : first.end - first.begin}};
  for (const ProfilePiece& piece : pieces) {
    if (piece.kind != PieceKind::kTipRounding) continue;
    constexpr int kPlaces = 16;
    for (int i = 1; i <= kPlaces; ++i) {
      const Point2 p = point_at(
          piece.curve, piece.curve.begin + (piece.curve.end - piece.curve.begin) * i / kPlaces);
      points.push_back({p.norm(), polar_angle_rad(p)});
    }
  }
  return points;
}

/// How far the ring's corner at polar angle phi2 lags when the pinion's stands at phi1.
double corner_margin_rad(const GearPair& pair, const TipPoint& tip1, const TipPoint& tip2,
                         double phi1, double phi2) {
  const double ratio = static_cast<double>(pair.gear1().teeth) / pair.gear2().teeth;
  const double ring_corner =
      ratio * (phi1 - tip1.half_angle_rad) + kPi / pair.gear2().teeth - tip2.half_angle_rad;
  return ring_corner - phi2;
}

/// Where the corners' circles cross. See trochoid_margin_rad.
double trochoid_of(const GearPair& pair, const TipPoint& tip1, const TipPoint& tip2) {
  const double a = pair.centre_distance_mm, r1 = tip1.radius_mm, r2 = tip2.radius_mm;
  const double cos1 = (r2 * r2 - r1 * r1 - a * a) / (2.0 * a * r1);
  const double cos2 = (a * a + r2 * r2 - r1 * r1) / (2.0 * a * r2);
  if (cos1 >= 1.0) return std::numeric_limits<double>::infinity();
  if (cos1 <= -1.0 || std::abs(cos2) >= 1.0) return kNaN;
  return corner_margin_rad(pair, tip1, tip2, std::acos(cos1), std::acos(cos2));
}

/// At the rotation where the corners pass each other worst. See trimming_margin_rad.
double trimming_of(const GearPair& pair, const TipPoint& tip1, const TipPoint& tip2) {
  const double r1 = tip1.radius_mm, r2 = tip2.radius_mm;
  if (r1 >= r2) return kNaN;
  const double s = static_cast<double>(pair.gear1().teeth) / pair.gear2().teeth;
  const double sine1 =
      std::sqrt(std::clamp((1.0 - s * s * r2 * r2 / (r1 * r1)) / (1.0 - s * s), 0.0, 1.0));
  return corner_margin_rad(pair, tip1, tip2, std::asin(sine1), std::asin(r1 / r2 * sine1));
}

/// The smallest over all points of both tips. That of the corners says whether the criterion exists.
template <class Margin>
double smallest_margin_rad(const GearPair& pair, const Margin& margin) {
  double smallest = kNaN;
  for (const bool clockwise1 : {false, true}) {
    if (clockwise1 && pair.profile1->symmetric() && pair.profile2->symmetric()) break;
    // the pinion's leading corner meets the ring's other side
    const std::vector<TipPoint> tips1 = tip_points(*pair.profile1, clockwise1);
    const std::vector<TipPoint> tips2 = tip_points(*pair.profile2, !clockwise1);
    const double corners = margin(pair, tips1.front(), tips2.front());
    if (std::isnan(corners) || std::isinf(corners)) return corners;
    for (const TipPoint& tip1 : tips1)
      for (const TipPoint& tip2 : tips2)
        smallest = std::fmin(smallest, margin(pair, tip1, tip2));
  }
  return smallest;
}

/// A piece of an outline; for the ring also the direction into the space.
struct Edge {
  Point2 a, b;
};

/// The teeth of one gear as polylines; `clockwise` where that half is no mirror image.
struct OutlineHalves {
  HalfToothPolyline half;
  std::optional<HalfToothPolyline> clockwise;

  OutlineHalves(const ToothProfile& profile, double tolerance_mm)
      : half(tessellate(profile, tolerance_mm)) {
    if (profile.symmetric()) return;
    const ToothProfile image = profile.mirror_image();
    half = with_middles(std::move(half), profile);
    clockwise = with_middles(tessellate(image, tolerance_mm), image);
  }
};

/// Outline of the teeth of a gear whose middles lie within an angle from +x, but for those that lie
/// below the line of centres as a whole: only the upper half is looked at. Takes the place of `edges`.
void place_near_mesh(const OutlineHalves& halves, int teeth, double rotation_rad, double reach_rad,
                     const Point2& centre_mm, std::vector<Edge>& edges) {
  edges.clear();
  const double pitch = kTwoPi / teeth;
  const double lowest_rad = std::max(-reach_rad, -pitch);
  const int first = static_cast<int>(std::ceil((lowest_rad - rotation_rad) / pitch));
  const int last = static_cast<int>(std::floor((reach_rad - rotation_rad) / pitch));
  const HalfToothPolyline& half = halves.half;
  const HalfToothPolyline& other = halves.clockwise ? *halves.clockwise : half;
  edges.reserve(static_cast<std::size_t>(std::max(0, last - first + 1)) *
                (half.points.size() + other.points.size()));
  for (int k = first; k <= last; ++k) {
    const Point2 axis = unit_vector(rotation_rad + pitch * k), across = perpendicular(axis);
    const auto placed = [&](double x, double y) -> Point2 {
      return centre_mm + x * axis + y * across;
    };
    Point2 last_point = placed(half.points.front().x(), half.points.front().y());
    if (!half.vertex_at_tooth_middle)
      edges.push_back({placed(half.points.front().x(), -half.points.front().y()), last_point});
    for (std::size_t i = 1; i < half.points.size(); ++i) {
      const Point2 next = placed(half.points[i].x(), half.points[i].y());
      edges.push_back({last_point, next});
      last_point = next;
    }
    last_point = placed(other.points.front().x(), -other.points.front().y());
    for (std::size_t i = 1; i < other.points.size(); ++i) {
      const Point2 next = placed(other.points[i].x(), -other.points[i].y());
      edges.push_back({next, last_point});
      last_point = next;
    }
  }
}

/// The edges of the pinion where +x enters it (they run down), by their height above the line of centres.
class EntryWalls {
 public:
  explicit EntryWalls(double bin_mm) : bin_mm_(bin_mm) {}

  /// Takes the place of the walls before.
  void stand(const std::vector<Edge>& pinion) {
    first_.assign(1, 0);
    for (const Edge& edge : pinion) {
      if (!enters(edge)) continue;
      if (first_.size() <= bin(edge.a.y()) + 1) first_.resize(bin(edge.a.y()) + 2, 0);
      for (std::size_t k = lowest_bin(edge); k <= bin(edge.a.y()); ++k) ++first_[k];
    }
    std::size_t last = 0;
    for (std::size_t& count : first_) count = last += count;
    walls_.resize(last);
    for (auto edge = pinion.rbegin(); edge != pinion.rend(); ++edge) {
      if (!enters(*edge)) continue;
      for (std::size_t k = lowest_bin(*edge); k <= bin(edge->a.y()); ++k) walls_[--first_[k]] = *edge;
    }
  }

  /// Above which no wall stands.
  [[nodiscard]] double top_mm() const { return bin_mm_ * static_cast<double>(first_.size() - 1); }

  /// Whether a wall stands within `travel_mm` of a point in +x.
  [[nodiscard]] bool ahead(const Point2& from, double travel_mm) const {
    if (from.y() < 0.0 || bin(from.y()) + 1 >= first_.size()) return false;
    for (std::size_t i = first_[bin(from.y())]; i < first_[bin(from.y()) + 1]; ++i) {
      const Edge& wall = walls_[i];
      if (!(wall.a.y() > from.y() && wall.b.y() <= from.y())) continue;
      const double u = (from.y() - wall.a.y()) / (wall.b.y() - wall.a.y());
      const double x = wall.a.x() + u * (wall.b.x() - wall.a.x());
      if (x > from.x() && x - from.x() < travel_mm) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] static bool enters(const Edge& edge) { return edge.a.y() > edge.b.y() && edge.a.y() >= 0.0; }
  [[nodiscard]] std::size_t bin(double y) const { return static_cast<std::size_t>(y / bin_mm_); }
  [[nodiscard]] std::size_t lowest_bin(const Edge& edge) const { return bin(std::max(edge.b.y(), 0.0)); }
  double bin_mm_;
  std::vector<Edge> walls_;         // bin by bin
  std::vector<std::size_t> first_;  // of each bin, and the end of the last
};

/// Does pinion material stand beyond the ring's edge, seen in +x, so that it cannot move in -x? Looks at
/// the upper half only: the other is the mirror image of another rotation.
/// Edges run counter-clockwise; the ring's space is on the left of its edges.
bool blocked(const EntryWalls& pinion, const std::vector<Edge>& ring, double travel_mm,
             double seen_mm) {
  const double lowest_mm = -1.001 * seen_mm, highest_mm = pinion.top_mm() + 1.001 * seen_mm;
  for (const Edge& edge : ring) {
    if (edge.a.y() < lowest_mm || edge.a.y() > highest_mm) continue;
    const Point2 along = edge.b - edge.a;
    const double length = along.norm();
    if (length == 0.0) continue;
    // a little into the space, so that flanks that only touch do not block
    if (pinion.ahead(edge.a + perpendicular(along) * (seen_mm / length), travel_mm)) return true;
  }
  return false;
}

/// At which rotations the upper half keeps the pinion in the ring.
std::vector<bool> blocked_above(const GearPair& pair) {
  const double m = pair.gear1().normal_module_mm, a = pair.centre_distance_mm;
  const double r1 = pair.profile1->tip_radius_mm(), r2 = pair.profile2->tip_radius_mm();
  const double travel = a - (r2 - r1);
  const int z1 = pair.gear1().teeth, z2 = pair.gear2().teeth;
  const double pitch1 = kTwoPi / z1, pitch2 = kTwoPi / z2;
  const double cos1 = std::clamp((r2 * r2 - r1 * r1 - a * a) / (2.0 * a * r1), -1.0, 1.0);
  const double cos2 = std::clamp((a * a + r2 * r2 - r1 * r1) / (2.0 * a * r2), -1.0, 1.0);
  const double reach1 = std::min(std::acos(cos1) + 1.5 * pitch1, 0.5 * kPi);
  const double reach2 = std::min(std::acos(cos2) + 1.5 * pitch2, 0.5 * kPi);
  const OutlineHalves half1(*pair.profile1, kRemovalChord * m);
  const OutlineHalves half2(*pair.profile2, kRemovalChord * m);
  std::vector<bool> upper(kRotations);
  std::vector<Edge> pinion, ring;
  EntryWalls walls(0.1 * m);
  for (int i = 0; i < kRotations; ++i) {
    const double turn = pitch1 * i / kRotations;
    place_near_mesh(half1, z1, turn, reach1, Point2::Zero(), pinion);
    place_near_mesh(half2, z2, turn * z1 / z2 + 0.5 * pitch2, reach2, Point2(-a, 0.0), ring);
    walls.stand(pinion);
    upper[static_cast<std::size_t>(i)] = blocked(walls, ring, travel, kSeenOverhang * m);
  }
  return upper;
}

/// The lower half is the upper one of the mirror image, which turns the other way.
std::vector<bool> blocked_at(const GearPair& pair) {
  const std::vector<bool> upper = blocked_above(pair);
  std::vector<bool> lower = upper;
  if (!pair.profile1->symmetric() || !pair.profile2->symmetric()) {
    const ToothProfile image1 = pair.profile1->mirror_image(), image2 = pair.profile2->mirror_image();
    lower = blocked_above({&image1, &image2, pair.centre_distance_mm});
  }
  std::vector<bool> either = upper;
  for (std::size_t i = 0; i < either.size(); ++i)
    either[i] = upper[i] || lower[(kRotations - i) % kRotations];
  return either;
}

}  // namespace

double trochoid_margin_rad(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.internal());
  return smallest_margin_rad(pair, trochoid_of);
}

double trimming_margin_rad(const GearPair& pair) {
  TRUEFLANK_EXPECTS(pair.internal());
  return smallest_margin_rad(pair, trimming_of);
}

RadialRemoval radial_removal(const GearPair& pair) {
  return radial_removal(std::vector<GearPair>{pair}, 0.0);
}

RadialRemoval radial_removal(const std::vector<GearPair>& sections, double twist_rad) {
  TRUEFLANK_EXPECTS(!sections.empty() && sections.front().internal());
  const GearPair& first = sections.front();
  RadialRemoval removal;
  if (first.profile1->tip_radius_mm() >= first.profile2->tip_radius_mm()) return removal;
  std::vector<bool> blocked(kRotations, false);
  for (const GearPair& pair : sections) {
    const std::vector<bool> here = blocked_at(pair);
    for (std::size_t i = 0; i < blocked.size(); ++i) blocked[i] = blocked[i] || here[i];
  }
  // at rotation i the sections of the face stand at the rotations i ... i + window
  const double steps = std::abs(twist_rad) * first.gear1().teeth / kTwoPi * kRotations;
  const auto window = static_cast<std::size_t>(std::min(std::ceil(steps), kRotations - 1.0));
  int free = 0;
  for (std::size_t i = 0; i < blocked.size(); ++i) {
    bool leaves = true;
    for (std::size_t k = 0; k <= window; ++k) leaves = leaves && !blocked[(i + k) % kRotations];
    removal.free_at.push_back(leaves);
    free += leaves ? 1 : 0;
  }
  removal.free_share = static_cast<double>(free) / kRotations;
  removal.at_every_rotation = free == kRotations;
  removal.at_some_rotation = free > 0;
  return removal;
}

}  // namespace trueflank
