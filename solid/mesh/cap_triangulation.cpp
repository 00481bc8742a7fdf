// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mesh/cap_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

using Indices = std::vector<std::uint32_t>;

/// A closed loop about the centre during the work, counter-clockwise, with the circles it lies between.
struct Ring {
  Indices vertices;
  double inner_radius_mm = 0.0, outer_radius_mm = 0.0;
};

/// A circular hole beside the centre, seen from there.
struct SideHole {
  Indices vertices;
  double angle_rad = 0.0, distance_mm = 0.0, radius_mm = 0.0;
  [[nodiscard]] double half_angle_rad() const { return std::asin(radius_mm / distance_mm); }
};

/// Corners of a polygon on a circle so that its sides dip at most `dip_mm` inside.
int corners_for_dip(double radius_mm, double dip_mm) {
  const double half = std::acos(std::max(0.0, 1.0 - dip_mm / radius_mm));
  return static_cast<int>(std::ceil(kPi / half));
}

class CapBuilder {
 public:
  CapBuilder(const OutlineLoop& outer, const std::vector<const OutlineLoop*>& holes)
      : centre_(outer.centre), outer_(outer) {
    outer_ring_ = take(outer);
    for (const OutlineLoop* hole : holes) {
      if (hole->centre == centre_) {
        TRUEFLANK_EXPECTS(inner_ == nullptr);
        inner_ = hole;
        inner_ring_ = take(*hole);
      } else {
        TRUEFLANK_EXPECTS(hole->teeth == 0);
        const Ring ring = take(*hole);
        const Point2 to = hole->centre - centre_;
        side_holes_.push_back(
            {ring.vertices, polar_angle_rad(to), to.norm(), hole->outer_radius_mm});
      }
    }
    loop_points_ = points_.size();
    std::sort(side_holes_.begin(), side_holes_.end(),
              [](const SideHole& a, const SideHole& b) { return a.angle_rad < b.angle_rad; });
  }

  CapTriangulation build() {
    Ring outside = outer_ring_;
    std::optional<Ring> inside = inner_ring_;
    if (outer_.teeth > 0)
      outside = separate_teeth(outer_, outer_ring_, inner_reach(), Direction::kInwards);
    if (inner_ != nullptr && inner_->teeth > 0)
      inside = separate_teeth(*inner_, *inner_ring_, outer_reach(outside), Direction::kOutwards);
    if (side_holes_.empty())
      join(outside, inside);
    else if (holes_stand_apart())
      fill_around_holes(outside, inside);
    else
      fill_by_bridges(outside, inside);
    CapTriangulation result;
    result.added_points.assign(points_.begin() + static_cast<std::ptrdiff_t>(loop_points_),
                               points_.end());
    result.triangles = std::move(triangles_);
    for (Point2& p : result.added_points) p += centre_;
    return result;
  }

 private:
  /// Where the face goes on, seen from a toothed loop; the sign of that step in radius.
  enum class Direction { kInwards, kOutwards };
  static double sign(Direction direction) { return direction == Direction::kInwards ? -1.0 : 1.0; }

  Ring take(const OutlineLoop& loop) {
    Ring ring{{}, loop.inner_radius_mm, loop.outer_radius_mm};
    for (const Point2& p : loop.points) {
      ring.vertices.push_back(static_cast<std::uint32_t>(points_.size()));
      points_.push_back(p - centre_);
    }
    return ring;
  }
  std::uint32_t add_point(const Point2& p) {
    points_.push_back(p);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

  /// Largest radius of what lies inside the outer loop.
  [[nodiscard]] double inner_reach() const {
    double reach = inner_ring_ ? inner_ring_->outer_radius_mm : 0.0;
    for (const SideHole& hole : side_holes_) reach = std::max(reach, hole.distance_mm + hole.radius_mm);
    return reach;
  }
  /// Smallest radius of what lies outside the inner loop.
  [[nodiscard]] double outer_reach(const Ring& outside) const {
    double reach = outside.inner_radius_mm;
    for (const SideHole& hole : side_holes_) reach = std::min(reach, hole.distance_mm - hole.radius_mm);
    return reach;
  }

  Ring circle_ring(double radius_mm, int corners, double first_angle_rad) {
    Ring ring{{}, radius_mm * std::cos(kPi / corners), radius_mm};
    for (int i = 0; i < corners; ++i)
      ring.vertices.push_back(
          add_point(radius_mm * unit_vector(first_angle_rad + kTwoPi * i / corners)));
    return ring;
  }

  void append_delaunay(std::vector<IndexTriangle> part) {
    make_delaunay(points_, part);
    triangles_.insert(triangles_.end(), part.begin(), part.end());
  }

  /// Fills between the teeth and a polygon beyond their roots, `limit_mm` being the radius of what
  /// lies behind that; returns the polygon.
  Ring separate_teeth(const OutlineLoop& loop, const Ring& ring, double limit_mm,
                      Direction direction) {
    const double foot = direction == Direction::kInwards ? ring.inner_radius_mm : ring.outer_radius_mm;
    const double wall = sign(direction) * (limit_mm - foot);
    TRUEFLANK_EXPECTS(wall > 0.0);
    // a third of the wall leaves as much to a second polygon; a bit more than half a pitch makes
    // triangles of good shape
    const double away = std::min(wall / 3.0, 0.6 * kTwoPi * foot / loop.teeth);
    const double radius = foot + sign(direction) * away;
    const int corners = corners_for_dip(radius, 0.2 * away);
    const int per_tooth = (corners + loop.teeth - 1) / loop.teeth;
    const Ring polygon =
        circle_ring(radius, per_tooth * loop.teeth, polar_angle_rad(points_[ring.vertices[0]]));
    fill_teeth(loop, ring, polygon, per_tooth, direction);
    return polygon;
  }

  /// Tooth by tooth; where teeth are alike, all as the first.
  void fill_teeth(const OutlineLoop& loop, const Ring& ring, const Ring& polygon, int per_tooth,
                  Direction direction) {
    const auto n = static_cast<std::uint32_t>(loop.points_per_tooth);
    const auto m = static_cast<std::uint32_t>(per_tooth);
    const auto all_n = n * static_cast<std::uint32_t>(loop.teeth);
    const auto all_m = m * static_cast<std::uint32_t>(loop.teeth);
    std::vector<IndexTriangle> tooth;
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(loop.teeth); ++k) {
      const auto copied = [&](std::uint32_t v) {
        return v <= n ? ring.vertices[(k * n + v) % all_n]
                      : polygon.vertices[(k * m + v - n - 1) % all_m];
      };
      if (k == 0 || !loop.teeth_alike) {
        // the tooth's points 0 ... n, then the polygon's 0 ... m
        std::vector<Point2> points;
        for (std::uint32_t i = 0; i <= n + 1 + m; ++i) points.push_back(points_[copied(i)]);
        Indices boundary;
        for (std::uint32_t i = 0; i <= n; ++i) boundary.push_back(i);
        for (std::uint32_t i = 0; i <= m; ++i) boundary.push_back(n + 1 + m - i);
        if (direction == Direction::kOutwards) std::reverse(boundary.begin(), boundary.end());
        tooth = clip_ears(points, boundary);
        make_delaunay(points, tooth);
      }
      for (const IndexTriangle& t : tooth)
        triangles_.push_back({copied(t[0]), copied(t[1]), copied(t[2])});
    }
  }

  /// Fills between two star-shaped loops, or one and the centre.
  void join(const Ring& outside, const std::optional<Ring>& inside) {
    if (!inside) {
      const std::uint32_t hub = add_point(Point2::Zero());
      const auto& v = outside.vertices;
      for (std::size_t i = 0; i < v.size(); ++i)
        triangles_.push_back({hub, v[i], v[i + 1 < v.size() ? i + 1 : 0]});
      return;
    }
    std::vector<IndexTriangle> zip = zipped(*inside, outside);
    const bool valid = std::all_of(zip.begin(), zip.end(), [&](const IndexTriangle& t) {
      return cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]) > 0.0;
    });
    if (!valid) zip = clip_ears(points_, cut_open(outside.vertices, inside->vertices));
    append_delaunay(std::move(zip));
  }

  /// Triangles between two loops, always going on at the one whose next vertex comes first.
  std::vector<IndexTriangle> zipped(const Ring& inside, const Ring& outside) const {
    const auto &a = inside.vertices, &b = outside.vertices;
    const double base = polar_angle_rad(points_[a[0]]);
    const auto angle_of = [&](std::uint32_t v) { return polar_angle_rad(points_[v]) - base; };
    std::size_t first = 0;
    for (std::size_t j = 1; j < b.size(); ++j)
      if (std::abs(centred_rad(angle_of(b[j]))) < std::abs(centred_rad(angle_of(b[first])))) first = j;
    const auto unwrapped = [&](const Indices& v, std::size_t start) {
      std::vector<double> angles{centred_rad(angle_of(v[start]))};
      for (std::size_t i = 1; i <= v.size(); ++i)
        angles.push_back(angles.back() +
                         wrapped_rad(angle_of(v[(start + i) % v.size()]) - angles.back()));
      return angles;
    };
    const std::vector<double> angle_a = unwrapped(a, 0), angle_b = unwrapped(b, first);
    std::vector<IndexTriangle> triangles;
    triangles.reserve(a.size() + b.size());
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
      const std::uint32_t on_a = a[i % a.size()], on_b = b[(first + j) % b.size()];
      const bool outer_next = i == a.size() || (j < b.size() && angle_b[j + 1] < angle_a[i + 1]);
      if (outer_next)
        triangles.push_back({on_a, on_b, b[(first + ++j) % b.size()]});
      else
        triangles.push_back({on_a, on_b, a[++i % a.size()]});
    }
    return triangles;
  }

  /// Whether every hole has a sector of its own, seen from the centre, and lies outside the inner loop.
  [[nodiscard]] bool holes_stand_apart() const {
    const std::size_t n = side_holes_.size();
    const double behind = inner_ring_ ? inner_ring_->outer_radius_mm : 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const SideHole &a = side_holes_[k], &b = side_holes_[(k + 1) % n];
      if (!(a.distance_mm - a.radius_mm > behind)) return false;
      const double from = a.angle_rad + a.half_angle_rad();
      if (!(b.angle_rad + (k + 1 == n ? kTwoPi : 0.0) - b.half_angle_rad() > from)) return false;
    }
    return true;
  }

  /// One polygon of all loops, the nearest loop joined to it first: no bridge crosses another loop.
  void fill_by_bridges(const Ring& outside, const std::optional<Ring>& inside) {
    std::vector<Indices> holes;
    for (const SideHole& hole : side_holes_) holes.push_back(hole.vertices);
    if (inside) holes.push_back(inside->vertices);
    Indices polygon = outside.vertices;
    while (!holes.empty()) {
      const auto nearest = std::min_element(holes.begin(), holes.end(), [&](const Indices& a, const Indices& b) {
        return gap_squared(polygon, a) < gap_squared(polygon, b);
      });
      polygon = cut_open(polygon, *nearest);
      holes.erase(nearest);
    }
    append_delaunay(clip_ears(points_, polygon));
  }

  [[nodiscard]] double gap_squared(const Indices& a, const Indices& b) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : a)
      for (const std::uint32_t j : b) nearest = std::min(nearest, (points_[i] - points_[j]).squaredNorm());
    return nearest;
  }

  /// Outer loop and hole as one polygon, joined by an edge between their nearest vertices.
  [[nodiscard]] Indices cut_open(const Indices& outer, const Indices& hole) const {
    std::size_t at_outer = 0, at_hole = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outer.size(); ++i)
      for (std::size_t j = 0; j < hole.size(); ++j) {
        const double apart = (points_[outer[i]] - points_[hole[j]]).squaredNorm();
        if (apart >= nearest) continue;
        nearest = apart;
        at_outer = i;
        at_hole = j;
      }
    Indices polygon;
    for (std::size_t i = 0; i <= outer.size(); ++i)
      polygon.push_back(outer[(at_outer + i) % outer.size()]);
    for (std::size_t j = 0; j <= hole.size(); ++j)
      polygon.push_back(hole[(at_hole + hole.size() - j) % hole.size()]);
    return polygon;
  }

  /// Angles halfway between neighbouring holes, and the smallest gap they leave.
  struct Cuts {
    std::vector<double> angles_rad;
    double smallest_gap_rad = kTwoPi;
  };
  [[nodiscard]] Cuts cuts_between_holes() const {
    Cuts cuts;
    const std::size_t n = side_holes_.size();
    for (std::size_t k = 0; k < n; ++k) {
      const SideHole &a = side_holes_[k], &b = side_holes_[(k + 1) % n];
      const double end = a.angle_rad + a.half_angle_rad();
      const double start =
          b.angle_rad + (k + 1 == n ? kTwoPi : 0.0) - b.half_angle_rad();
      TRUEFLANK_EXPECTS(start > end);
      cuts.angles_rad.push_back(0.5 * (start + end));
      cuts.smallest_gap_rad = std::min(cuts.smallest_gap_rad, start - end);
    }
    return cuts;
  }

  /// Two polygons around the holes take the cuts; they have vertices close enough to the cuts' angles.
  void fill_around_holes(const Ring& outside, const std::optional<Ring>& inside) {
    const Cuts cuts = cuts_between_holes();
    double outermost = 0.0, innermost = std::numeric_limits<double>::infinity();
    for (const SideHole& hole : side_holes_) {
      outermost = std::max(outermost, hole.distance_mm + hole.radius_mm);
      innermost = std::min(innermost, hole.distance_mm - hole.radius_mm);
    }
    const double behind = inside ? inside->outer_radius_mm : 0.0;
    TRUEFLANK_EXPECTS(innermost > behind && outermost < outside.inner_radius_mm);
    const int wanted = static_cast<int>(std::ceil(kTwoPi / (0.5 * cuts.smallest_gap_rad)));
    const auto polygon_at = [&](double radius, double room) {
      return circle_ring(radius, std::max({wanted, 12, corners_for_dip(radius, 0.2 * room)}),
                         cuts.angles_rad.front());
    };
    const double room_out = 0.5 * (outside.inner_radius_mm - outermost);
    const double room_in = 0.5 * (innermost - behind);
    const Ring upper = polygon_at(outermost + room_out, room_out);
    const Ring lower = polygon_at(innermost - room_in, room_in);
    join(outside, upper);
    join(lower, inside);
    for (std::size_t k = 0; k < side_holes_.size(); ++k)
      fill_sector(upper, lower, cuts.angles_rad[k],
                  cuts.angles_rad[(k + 1) % side_holes_.size()],
                  side_holes_[(k + 1) % side_holes_.size()]);
  }

  /// Number of the vertex of a polygon nearest to a direction.
  [[nodiscard]] std::size_t vertex_towards(const Ring& ring, double angle_rad) const {
    const auto n = static_cast<double>(ring.vertices.size());
    const double first = polar_angle_rad(points_[ring.vertices[0]]);
    const auto step = static_cast<std::size_t>(
        std::lround(wrapped_rad(angle_rad - first) / kTwoPi * n));
    return step % ring.vertices.size();
  }

  void fill_sector(const Ring& upper, const Ring& lower, double from_rad, double to_rad,
                   const SideHole& hole) {
    const auto arc = [&](const Ring& ring) {
      const std::size_t n = ring.vertices.size();
      const std::size_t begin = vertex_towards(ring, from_rad), end = vertex_towards(ring, to_rad);
      Indices vertices{ring.vertices[begin]};
      std::size_t i = begin;
      do {
        i = (i + 1) % n;
        vertices.push_back(ring.vertices[i]);
      } while (i != end);
      return vertices;
    };
    Indices sector = arc(upper);
    const Indices below = arc(lower);
    sector.insert(sector.end(), below.rbegin(), below.rend());
    append_delaunay(clip_ears(points_, cut_open(sector, hole.vertices)));
  }

  Point2 centre_;
  const OutlineLoop& outer_;
  const OutlineLoop* inner_ = nullptr;
  Ring outer_ring_;
  std::optional<Ring> inner_ring_;
  std::vector<SideHole> side_holes_;
  std::vector<Point2> points_;  ///< relative to the centre
  std::size_t loop_points_ = 0;
  std::vector<IndexTriangle> triangles_;
};

}  // namespace

CapTriangulation triangulate_cap(const OutlineLoop& outer,
                                 const std::vector<const OutlineLoop*>& holes) {
  return CapBuilder(outer, holes).build();
}

}  // namespace trueflank
