// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "trueflank/geometry/toothing.h"

// Facets that no mesh can do without whose vertices lie on the toothing and whose edges follow the
// joints of its pieces. Source: docs/theory/helical-facets.md. Knows the surface by surface_point()
// alone.
namespace trueflank::test {

struct SurfaceBend {
  double across = 0.0, mixed = 0.0, along = 0.0;  ///< second differences of one cell
};

class LeastFacets {
 public:
  LeastFacets(const Toothing& toothing, double tolerance_mm)
      : toothing_(toothing), tolerance_(tolerance_mm) {}

  /// Of one tooth between two heights between which the surface is smooth.
  [[nodiscard]] double between(double z0, double z1) const {
    double facets = 0.0;
    const auto& pieces = toothing_.profile->pieces();
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
      const bool land =
          pieces[piece].kind == PieceKind::kTip || pieces[piece].kind == PieceKind::kRoot;
      for (const int side : {-1, 1})
        facets += land ? 0.5 * of_land(piece, side, z0, z1) : of_wall(piece, side, z0, z1);
    }
    return facets;
  }

 private:
  static constexpr int kAcross = 60, kAlong = 12;
  using Point3 = Eigen::Vector3d;
  static double whole(double share) { return std::max(1.0, std::ceil(share - 1e-3)); }

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

  [[nodiscard]] double of_wall(std::size_t piece, int side, double z0, double z1) const {
    const Curve& curve = toothing_.profile->pieces()[piece].curve;
    const double room = 8.0 * tolerance_, up = (z1 - z0) / kAlong;
    double bent = 0.0, lower = 0.0, upper = 0.0, first = 0.0, last = 0.0;
    for (int i = 0; i < kAcross; ++i) {
      const double from = std::lerp(curve.begin, curve.end, static_cast<double>(i) / kAcross),
                   to = std::lerp(curve.begin, curve.end, (i + 1.0) / kAcross),
                   middle = 0.5 * (from + to);
      for (int k = 0; k < kAlong; ++k) {
        const double z = z0 + (k + 0.5) * up;
        if (has_break(piece, side, from, to, z)) continue;
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
        const double gauss = across * along - mixed * mixed;
        bent += std::sqrt(std::abs(gauss)) / ((gauss > 0.0 ? 2.598 : 4.473) * tolerance_);
        const auto row = [&](double height) {
          const double departs =
              ends_surface(height) ? level(piece, side, from, to, height) : std::abs(across);
          return std::sqrt(departs / room);
        };
        if (k == 0) lower += row(z0);
        if (k + 1 == kAlong) upper += row(z1);
        if (i == 0) first += std::sqrt(std::abs(along) / room);
        if (i + 1 == kAcross) last += std::sqrt(std::abs(along) / room);
      }
    }
    return std::max(bent, whole(lower) + whole(upper) + whole(first) + whole(last) - 2.0);
  }

  /// Both halves. A land is a cylinder about the axis, or a cone in a chamfer.
  [[nodiscard]] double of_land(std::size_t piece, int side, double z0, double z1) const {
    const Curve& curve = toothing_.profile->pieces()[piece].curve;
    const auto chords = [&](double z) {
      const Point3 a = at(piece, side, curve.begin, z), b = at(piece, side, curve.end, z);
      const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.head<2>().dot(b.head<2>()));
      return whole(2.0 * std::abs(angle) * std::sqrt(a.head<2>().norm() / (8.0 * tolerance_)));
    };
    const bool tip = toothing_.profile->pieces()[piece].kind == PieceKind::kTip;
    double ridge = 0.0;
    const double up = (z1 - z0) / kAlong;
    for (int k = 0; k < kAlong; ++k) {
      const auto on = [&](double share) {
        return at(piece, side, tip ? curve.end : curve.begin, z0 + (k + share) * up);
      };
      const auto angle = [&](const Point3& p) { return std::atan2(p.y(), p.x()); };
      const double turn = angle(on(1.0)) - angle(on(0.0));
      ridge += std::abs(turn) * std::sqrt(on(0.5).head<2>().norm() / (8.0 * tolerance_));
    }
    return chords(z0) + chords(z1) + 2.0 * whole(ridge) - 2.0;
  }

  const Toothing& toothing_;
  double tolerance_;
};

}  // namespace trueflank::test
