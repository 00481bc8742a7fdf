// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "trueflank/geometry/curve_spline.h"
#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {

/// Signed distance from the exact profile of a whole gear.
///
/// A point is first folded into the wedge of half a tooth. That is exact: the profile is symmetric
/// in the middles of tooth and gap, and of a point's mirror images the one in the same wedge is
/// never farther. Where the halves of the teeth differ, the neighbours of that wedge are looked at
/// too. Involutes, arcs and straight lines are then measured in closed form, trochoids on cubic
/// pieces within 1e-9 module of the curve.
/// Frame: the gear's own, tooth 1 on +x.
class GearDistance {
 public:
  struct Nearest {
    double distance_mm = 0.0;       ///< from the profile; > 0 outside the material, < 0 inside
    int piece = -1;                 ///< index of the nearest point's piece, of that half's pieces
    bool corner = false;            ///< it is the beginning of that piece (or the end of the last)
    bool clockwise_half = false;    ///< on which half of its tooth the nearest point lies
    Point2 point = Point2::Zero();  ///< nearest point, folded into the first half tooth's wedge
  };

  /// What the point measured before told of the pieces. The distance of a piece changes by no more than
  /// the point moves: pieces that were far away need not be measured again where the next point is near.
  class Before {
   private:
    friend class GearDistance;
    static constexpr std::size_t kPieces = 7;  // of a half tooth, first to be measured; any further one always is
    Point2 point_ = Point2::Zero();
    double nearest_mm_ = std::numeric_limits<double>::infinity();
    std::array<double, kPieces + 1> least_mm_{};  // none of a piece is nearer; last: of all joints
  };

  /// Copies what it needs. `spline_error`: CurveSpline's, of trochoids.
  explicit GearDistance(const ToothProfile& profile, double spline_error = CurveSpline::kError);

  [[nodiscard]] Nearest nearest(const Point2& point) const;
  /// The same to the last digit, sooner where the point lies near the one measured before.
  [[nodiscard]] Nearest nearest(const Point2& point, Before& before) const;

 private:
  struct Joint {
    Point2 at;
    Point2 outward;  // bisects the outward normals of both sides
    int piece;
  };
  struct Arc {
    Point2 centre;
    double radius, inside_sign;  // inside_sign: +1 where space is outside the circle
    Point2 first, last;          // directions of the ends, counter-clockwise
    int piece;
  };
  struct Flank {
    double base_radius, half_angle, sense, from, to;
    Point2 first, last;  // its ends
    int piece;
  };
  struct Line {
    Point2 start, direction;
    double from, to;
    int piece;
  };
  struct Spline {
    std::shared_ptr<const CurveSpline> curve;
    int piece;
  };
  struct Best {
    double magnitude, signed_mm;
    int piece;
    Point2 point;
    bool corner = false;
  };

  enum class Shape { kFlank, kArc, kLine, kSpline };
  struct Measured {
    Shape shape;
    std::size_t index;  // among those of its shape
  };
  /// The pieces of one half tooth, in the counter-clockwise wedge.
  struct Half {
    std::vector<Joint> joints;
    std::vector<Arc> arcs;
    std::vector<Flank> flanks;
    std::vector<Line> lines;
    std::vector<Spline> splines;
    std::vector<Measured> order;  // of all pieces: by shape, flanks first, which are nearest most often
  };

  [[nodiscard]] int tooth_at(const Point2& point) const;
  [[nodiscard]] Half half_of(const std::vector<ProfilePiece>& pieces, double spline_error) const;
  void add_joints(const std::vector<ProfilePiece>& pieces, Half& half) const;
  [[nodiscard]] static bool surely_outside(const Point2& e, const Flank& flank);
  [[nodiscard]] static bool in_angle(const Arc& arc, const Point2& from_centre);
  /// The tooth's wedge, and the point folded into it; whether it lay on the clockwise side.
  [[nodiscard]] Point2 folded(const Point2& point, bool& clockwise) const;
  /// Takes over what lies nearer than `best`, passing over what `before` knows to be farther away.
  void measure(const Half& half, const Point2& q, Best& best, Before& before) const;
  void measure_joints(const Half& half, const Point2& q, Best& best, Before& before) const;
  void measure_neighbours(const Point2& q, Best& best, bool& clockwise) const;
  static void set_order(Half& half);
  double measure_piece(const Half& half, const Measured& piece, const Point2& q, Best& best) const;
  // Each takes over its foot if that is nearer than `best`, and returns what no part of it is nearer than.
  double measure_arc(const Arc& arc, const Point2& q, Best& best) const;
  double measure_flank(const Flank& flank, const Point2& q, Best& best) const;
  double measure_line(const Line& line, const Point2& q, Best& best) const;
  double measure_spline(const Spline& spline, const Point2& q, Best& best) const;

  double pitch_rad_;
  std::vector<Point2> axes_;  // directions of the teeth
  double outward_;  // +1: space is on the right of the direction of travel (external), -1: left
  Half half_;
  std::optional<Half> clockwise_;  // where it is not the mirror image
};

}  // namespace trueflank
