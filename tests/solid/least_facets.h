// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/geometry/toothing.h"

// Facets that no mesh can do without whose vertices lie on the toothing and whose edges follow the
// joints of its pieces. Source: docs/theory/helical-facets.md. Knows the surface by surface_point()
// alone.
namespace trueflank::test {

struct SurfaceBend {
  double across = 0.0, mixed = 0.0, along = 0.0;  ///< second differences of one cell
};

/// Steps across by which a facet between two rows that are one step apart may reach beyond its edge
/// on one of them. `room`: eight tolerances.
inline double reach_on_row(double across, double mixed, double along, double room) {
  const double bent = std::max(std::abs(across), 1e-9 * room),
               left = (mixed * mixed / bent - std::copysign(along, across * along)) / room;
  return std::sqrt((1.0 + std::max(0.0, left)) * room / bent) + std::abs(mixed) / bent;
}
/// Steps across times steps along that a facet covers at most.
inline double most_area(double across, double mixed, double along, double tolerance) {
  const double gauss = across * along - mixed * mixed;
  return (gauss > 0.0 ? 2.598 : 4.473) * tolerance / std::sqrt(std::abs(gauss));
}

class LeastFacets {
 public:
  LeastFacets(const Toothing& toothing, double tolerance_mm)
      : toothing_(toothing), tolerance_(tolerance_mm) {}

  /// Of one tooth between two heights between which the surface is smooth.
  [[nodiscard]] double between(double z0, double z1) const {
    double facets = 0.0;
    for (const int side : {-1, 1})
      for (const Wall& one : walls(side, z0, z1)) facets += one.facets();
    return facets;
  }

 private:
  static constexpr int kAcross = 60, kAlong = 12;
  using Point3 = Eigen::Vector3d;
  static double whole(double share) { return std::max(1.0, std::ceil(share - 1e-3)); }

  /// What a wall between two joints asks for, or half of a land: the other half has as many.
  struct Wall {
    bool half = false;
    double bent = 0.0;                ///< facets by area
    double lower = 0.0, upper = 0.0;  ///< edges of rows
    double first = 0.0, last = 0.0;   ///< edges of joints
    /// Of a share of the width: facets by area, edges of both rows, and how many cells a facet on
    /// one of these goes beyond it.
    struct Cell {
      double bent = 0.0, edges = 0.0, reach = 0.0;
    };
    std::vector<Cell> cells = {};
    /// A corner's facet may have an edge of a row and one of a joint.
    static double beyond_corners(double edges) { return std::max(0.0, whole(edges) - 2.0); }
    [[nodiscard]] double facets() const {
      const double rows = whole(lower) + whole(upper) - 2.0;
      if (half) return 0.5 * rows + whole(std::max(first, last));
      return std::max({bent, rows + whole(first) + whole(last), in_stretches()});
    }
    /// In stretches edges of rows are counted, in others areas; what reaches from one of the first
    /// kind into one of the other is left out.
    [[nodiscard]] double in_stretches() const {
      const std::size_t n = cells.size();
      std::vector<double> most(n + 1, 0.0);  // of what is left of a place
      const auto place = [&](double cell) {
        return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(n)));
      };
      for (std::size_t end = 0; end < n; ++end) {
        most[end + 1] = std::max(most[end + 1], most[end] + cells[end].bent);
        // all stretches of edges that have this cell as their last but that begin earlier
        double edges = end + 1 == n ? beyond_corners(last) : 0.0;
        double low = static_cast<double>(n), high = 0.0;
        for (std::size_t from = end + 1; from-- > 0;) {
          const auto at = static_cast<double>(from);
          edges += cells[from].edges;
          low = std::min(low, at - cells[from].reach);
          high = std::max(high, at + 1.0 + cells[from].reach);
          const double with_first = from == 0 ? edges + beyond_corners(first) : edges;
          double& there = most[place(std::ceil(high))];
          there = std::max(there, most[place(std::floor(low))] + with_first);
        }
      }
      return most[n];
    }
  };
  /// Of one side, from the tip to the root.
  [[nodiscard]] std::vector<Wall> walls(int side, double z0, double z1) const {
    std::vector<Wall> result;
    for (std::size_t piece = 0; piece < toothing_.profile->pieces().size(); ++piece)
      result.push_back(is_land(piece) ? land(piece, side, z0, z1) : wall(piece, side, z0, z1));
    // an edge of a joint is one of both pieces, and as short as either asks for
    for (std::size_t piece = 1; piece < result.size(); ++piece)
      result[piece - 1].last = result[piece].first =
          std::max(result[piece - 1].last, result[piece].first);
    return result;
  }
  [[nodiscard]] bool is_land(std::size_t piece) const {
    const PieceKind kind = toothing_.profile->pieces()[piece].kind;
    return kind == PieceKind::kTip || kind == PieceKind::kRoot;
  }

  [[nodiscard]] Point3 at(std::size_t piece, int side, double parameter, double z) const {
    const auto p = surface_point(toothing_, {0, side, piece, parameter}, z);
    return Point3(p.data());
  }

  [[nodiscard]] bool has_break(std::size_t piece, int side, double from, double to,
                               double z) const {
    if (!toothing_.has_deviation() || piece != involute_piece(*toothing_.profile)) return false;
    const double reach = to - from;
    for (const double roll : toothing_.deviation->roll_breaks_mm) {
      const double there = break_parameter(toothing_, 0, side, roll, z);
      if ((there - from + reach) * (there - to - reach) <= 0.0) return true;
    }
    return false;
  }

  /// End faces and the breaks of chamfers: a row's edge bounds a surface that goes on to one side
  /// only. Its middle has no foot on that surface, or the surface's edge none on the facet, so that
  /// one of them is off by the whole departure in the section's plane.
  [[nodiscard]] bool ends_surface(double z) const {
    const double from_end = std::min(z, toothing_.twist.face_width_mm - z);
    return std::abs(from_end) < 1e-9 || std::abs(from_end - toothing_.edge_chamfer_mm) < 1e-9;
  }
  /// Second difference of a section in its own plane.
  [[nodiscard]] double level(std::size_t piece, int side, double from, double to, double z) const {
    const Point3 a = at(piece, side, from, z), b = at(piece, side, to, z);
    const Point3 bent = 4.0 * (a + b - 2.0 * at(piece, side, 0.5 * (from + to), z));
    const Point3 chord = (b - a).normalized();
    return (bent - chord * bent.dot(chord)).norm();
  }

  [[nodiscard]] Wall wall(std::size_t piece, int side, double z0, double z1) const {
    const Curve& curve = toothing_.profile->pieces()[piece].curve;
    const double room = 8.0 * tolerance_, up = (z1 - z0) / kAlong;
    Wall result;
    auto& [half, bent, lower, upper, first, last, cells] = result;
    for (int i = 0; i < kAcross; ++i) {
      const double from = std::lerp(curve.begin, curve.end, static_cast<double>(i) / kAcross),
                   to = std::lerp(curve.begin, curve.end, (i + 1.0) / kAcross),
                   middle = 0.5 * (from + to);
      Wall::Cell& cell = cells.emplace_back();
      for (int k = 0; k < kAlong; ++k) {
        const double z = z0 + (k + 0.5) * up;
        if (has_break(piece, side, from, to, z)) {
          cell.reach = kAcross;
          continue;
        }
        const Point3 p = at(piece, side, middle, z), a = at(piece, side, from, z),
                     b = at(piece, side, to, z), c = at(piece, side, middle, z - 0.5 * up),
                     d = at(piece, side, middle, z + 0.5 * up),
                     e = at(piece, side, from, z - 0.5 * up), f = at(piece, side, to, z + 0.5 * up);
        const Point3 normal = (b - a).cross(d - c).normalized();
        const auto bend = [&](const Point3& u, const Point3& v) {
          return 4.0 * (u + v - 2.0 * p).dot(normal);
        };
        const double across = bend(a, b), along = bend(c, d),
                     mixed = 0.5 * (bend(e, f) - across - along);
        cell.bent += 1.0 / most_area(across, mixed, along, tolerance_);
        cell.reach = std::max(cell.reach,
                              reach_on_row(across, mixed * kAlong, along * kAlong * kAlong, room));
        const auto row = [&](double height) {
          const double departs =
              ends_surface(height) ? level(piece, side, from, to, height) : std::abs(across);
          return std::sqrt(departs / room);
        };
        if (k == 0) lower += row(z0), cell.edges += row(z0);
        if (k + 1 == kAlong) upper += row(z1), cell.edges += row(z1);
        if (i == 0) first += std::sqrt(std::abs(along) / room);
        if (i + 1 == kAcross) last += std::sqrt(std::abs(along) / room);
      }
    }
    for (const Wall::Cell& cell : cells) bent += cell.bent;
    return result;
  }

  /// A land is a cylinder about the axis, or a cone in a chamfer. Its middle is no joint.
  [[nodiscard]] Wall land(std::size_t piece, int side, double z0, double z1) const {
    const Curve& curve = toothing_.profile->pieces()[piece].curve;
    const auto chords = [&](double z) {
      const Point3 a = at(piece, side, curve.begin, z), b = at(piece, side, curve.end, z);
      const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.head<2>().dot(b.head<2>()));
      return 2.0 * std::abs(angle) * std::sqrt(a.head<2>().norm() / (8.0 * tolerance_));
    };
    const bool tip = toothing_.profile->pieces()[piece].kind == PieceKind::kTip;
    double ridge = 0.0;
    const double up = (z1 - z0) / kAlong;
    for (int k = 0; k < kAlong; ++k) {
      const auto on = [&](double share) {
        return at(piece, side, tip ? curve.end : curve.begin, z0 + (k + share) * up);
      };
      const auto angle = [&](const Point3& p) { return std::atan2(p.y(), p.x()); };
      const double turn = std::remainder(angle(on(1.0)) - angle(on(0.0)), kTwoPi);
      ridge += std::abs(turn) * std::sqrt(on(0.5).head<2>().norm() / (8.0 * tolerance_));
    }
    Wall result{.half = true, .lower = chords(z0), .upper = chords(z1)};
    (tip ? result.last : result.first) = ridge;
    return result;
  }

  const Toothing& toothing_;
  double tolerance_;
};

}  // namespace trueflank::test
