// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/geometry/curve_spline.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank {

/// Nearest point of a true outline.
struct OutlineFoot {
  Point2 point = Point2::Zero();
  double distance_mm = 0.0;  ///< positive outside the area the outline encloses, negative inside
};

/// Distances from one outline's exact curves, independent of any tessellation. A point is folded
/// into half a tooth by symmetry; the foot on the involute follows from the tangent to the base
/// circle, that on arcs and lines in closed form, that on a trochoid on cubic pieces within 1e-9 mm
/// of it. Accuracy: 1e-9 mm for points within a tenth of the module of the outline, tested in
/// tests/solid/outline_distance_test.cpp. Farther away the nearest of the feet found.
class OutlineDistance {
 public:
  explicit OutlineDistance(const Outline& outline);

  [[nodiscard]] OutlineFoot foot(const Point2& point) const { return foot(folded(point)); }
  /// A point seen from the outline: of a toothed one in the frame of the tooth it is at, in the
  /// half where y >= 0.
  struct Folded {
    Point2 place = Point2::Zero();
    std::size_t tooth = 0;
    bool mirrored = false;
  };
  [[nodiscard]] Folded folded(const Point2& point) const;
  [[nodiscard]] OutlineFoot foot(const Folded& point) const;
  /// Where copies by the outline's symmetry fall together: folded into half a tooth, or on a
  /// circle's radius; nothing where the outline has none.
  [[nodiscard]] std::optional<Point2> place_of_copies(const Point2& point) const {
    if (teeth_ > 0) return folded(point).place;
    if (is_circle_) return Point2((point - centre_).norm(), 0.0);
    return std::nullopt;
  }
  /// Not more than the distance of any point of the outline.
  [[nodiscard]] double lower_bound_mm(const Point2& point) const;
  /// Not more than the distance of any two points of both outlines.
  [[nodiscard]] double lower_bound_mm(const OutlineDistance& other) const;

  /// One smooth curve of the outline, in the frame of the outline's first tooth (or of the
  /// outline).
  struct Piece {
    Curve curve;
    double length_mm = 0.0;
    double turning_rad = 0.0;  ///< angle between its end tangents
  };
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// Copies of the pieces that make the outline: two a tooth (the second mirrored), or one.
  [[nodiscard]] int copies() const { return teeth_ > 0 ? 2 * teeth_ : 1; }
  [[nodiscard]] Point2 to_outline(const Point2& on_piece, int copy) const;
  [[nodiscard]] const Point2& centre() const { return centre_; }

 private:
  struct Form {                                          ///< what foot() needs of a piece
    Point2 low = Point2::Zero(), high = Point2::Zero();  ///< box around it
    Point2 start = Point2::Zero(), end = Point2::Zero();
    Point2 start_normal = Point2::Zero(),
           end_normal = Point2::Zero();  ///< pointing out of the enclosed area; mean of both pieces
    std::optional<CurveSpline> spline;   ///< of a trochoid or a deviated flank
  };
  void add(const Curve& curve);
  void finish();
  [[nodiscard]] Point2 from_tooth(const Point2& p, std::size_t tooth) const;
  [[nodiscard]] OutlineFoot foot_on_half_tooth(const Point2& point) const;
  [[nodiscard]] double to_box_mm2(std::size_t index, const Point2& point) const {
    const Form& form = forms_[index];
    return (form.low - point).cwiseMax(point - form.high).cwiseMax(0.0).squaredNorm();
  }
  void find_likely_teeth();
  [[nodiscard]] std::size_t nearest_direction(const Point2& point) const;
  /// The tooth in whose pitch a point is.
  [[nodiscard]] std::size_t tooth_at(const Point2& point) const;
  [[nodiscard]] OutlineFoot foot_on_piece(std::size_t index, const Point2& point,
                                          double limit_mm) const;

  Point2 centre_ = Point2::Zero();
  int teeth_ = 0;
  bool is_circle_ = false;
  double rotation_rad_ = 0.0;
  std::vector<Point2> directions_;         ///< middles of the teeth
  std::vector<std::size_t> likely_teeth_;  ///< by equal steps of the diamond angle
  double sure_slope_ =
      0.0;  ///< tangent of the angle from a tooth's middle that is surely in its pitch
  double inner_radius_mm_ = 0.0, outer_radius_mm_ = 0.0;
  std::vector<Piece> pieces_;
  std::vector<Form> forms_;
};

}  // namespace trueflank
