// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/solid/measure/outline_distance.h"

namespace trueflank {

using Point3 = Eigen::Vector3d;

/// Distances in space from a toothing's true surface, twist, deviation, chamfers and displacement
/// included; nothing of any tessellation is used.
/// How: a point is moved back by the displacement, turned back by the twist, and turned back by the
/// deviation that its circle has at its height; then it is as far from the design's section as it
/// was from the true one at its height; a bed chamfer is so much less material all round. The
/// distance square to the surface follows from the slope. Where that is not small beside the height
/// of the fillet, which may be micrometres, and less than the flank deviates: the section at the
/// point's height, as a line of chords. Accuracy: 1 % of the distance for slopes of the deviation
/// up to 1 % on the flank, any on the fillet; distances within a tenth of the module.
class ToothingDistance {
 public:
  explicit ToothingDistance(const ToothedOutline& outline);

  /// Positive outside what the outline encloses. Frame: the part's.
  [[nodiscard]] double distance_mm(const Point3& point) const;
  /// Not more than the distance of any point of the toothing.
  [[nodiscard]] double lower_bound_mm(const Point3& point) const;
  /// The height a point would have without the displacement.
  [[nodiscard]] double undisplaced_z_mm(const Point3& point) const;

  /// Where the surface's line over a place of the section passes a height; copies of the pieces as
  /// OutlineDistance counts them. Frame: the part's.
  [[nodiscard]] Point2 point_at_height(std::size_t piece, double parameter, int copy,
                                       double z_mm) const;
  /// Parameters of a piece at which the deviation breaks, on a copy of it at a height. Frame: the
  /// part's.
  [[nodiscard]] std::vector<double> breaks_at_height(std::size_t piece, int copy,
                                                     double z_mm) const;
  /// Ratio of the distance square to the surface to that within the section, at a place.
  [[nodiscard]] double slope_share(std::size_t piece, double parameter, int copy,
                                   double z_mm) const;

 private:
  [[nodiscard]] double distance_by_turning_mm(const Point3& point) const;
  /// From the surface's line at the point's height, its root and the flank's foot; of the teeth
  /// nearby.
  [[nodiscard]] double distance_from_root_mm(const Point3& point) const;
  [[nodiscard]] Point3 in_gear(const Point3& point) const;
  [[nodiscard]] Point3 undisplaced(const Point3& in_gear) const;
  struct SectionFoot {
    double distance_mm = 0.0;
    double lever_mm = 0.0;  ///< of the normal about the axis
    double stretch = 1.0;   ///< slope of the distance within the plane: circles turn differently
  };
  /// A circle's turn, and how it changes with the radius over the fillet.
  struct CircleTurn {
    double turn_rad = 0.0;
    double rise_rad_per_mm = 0.0;
  };
  [[nodiscard]] SectionFoot section_foot(const Point2& turned_back, double z_mm) const;
  [[nodiscard]] CircleTurn turn_of_circle(int tooth, int side, double radius_mm, double z_mm) const;
  /// The side-signed turn that takes a place near the true section back to the design's, and its
  /// rise.
  [[nodiscard]] CircleTurn turn_back(const Point2& place, double z_mm) const;
  [[nodiscard]] double chamfer_depth_mm(double z_mm) const;

  ToothedOutline outline_;
  Toothing toothing_, unchamfered_;
  OutlineDistance section_;  ///< of the design, tooth 1 on +x
  std::size_t flank_ = 0;
  double low_roll_ = 0.0, high_roll_ = 0.0;  ///< roll angles of the flank's ends
  double tip_half_angle_rad_ = 0.0;
  double root_half_angle_rad_ = 0.0;  ///< of a root that meets the flank without a fillet
  bool deviates_ = false;
  double base_radius_mm_ = 0.0;
  double steepest_ = 1.0;  ///< way along the wall a way across it, at most
  double largest_displacement_mm_ = 0.0;
  double small_fillet_mm_ = kNaN;  ///< part of the fillet's height; NaN: no fillet to look at
  std::vector<double> fillet_radii_mm_, fillet_fades_;  ///< from the root form circle on
};

}  // namespace trueflank
