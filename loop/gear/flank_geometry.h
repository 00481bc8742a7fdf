// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "trueflank/base/units.h"
#include "trueflank/geometry/tooth_profile.h"
#include "trueflank/loop/gear/flank_foot.h"
#include "trueflank/train/gear_train.h"

// Where a measured point lies on the gear as designed: tooth, flank, roll length, height, and the
// exact signed distance. Frame: the gear's own; tooth 1 on +x at z = 0, face from 0 to face width.
namespace trueflank::loop {

enum class Surface : std::uint8_t { kFlank, kTip, kRoot, kBore, kNone };

/// A place on the surface as designed, with its outward normal. Every point of a scan has one: kept
/// small.
struct Place {
  Surface surface = Surface::kFlank;
  std::int8_t side = 1;  ///< +1 counter-clockwise flank of its tooth, -1 clockwise
  std::uint8_t file = 0;  ///< of records: its file's number, from 1; 0: of no file of records
  int tooth = 0;         ///< 1-based, counter-clockwise; 0: none
  double roll_mm = 0.0;  ///< transverse roll length of the flank point
  double z_mm = 0.0;
  double radius_mm = 0.0;
  double polar_rad = 0.0;  ///< of the point
  /// Cosine and sine of polar_rad, and of the direction of the transverse part of the outward
  /// normal: every fit asks every place for them.
  std::array<double, 2> polar_direction{1.0, 0.0}, normal_direction{1.0, 0.0};
};
static_assert(sizeof(Place) == 72);

/// Place nearest to a measured point, and how far the point lies outside the material there.
struct PlacedPoint {
  Place place;
  double distance_mm = 0.0;  ///< along the normal, + = too much material
};

/// Share of a flank's length at either end that is not taken as flank: its edges are rounded.
inline constexpr double kFlankMargin = 0.03;

/// The surfaces of one gear in closed form.
/// Source: distances and normals derived in docs/theory/flank-distance.md: involutes of one base
/// circle are parallel curves, so the distance along the base tangent is exact at any distance.
class FlankGeometry {
 public:
  FlankGeometry(const ToothProfile& profile, double face_width_mm, double bore_radius_mm = 0.0,
                bool herringbone = false);
  /// A gear of a design, its flank modifications and edge chamfers included.
  explicit FlankGeometry(const TrainGear& gear, double bore_radius_mm = 0.0);

  [[nodiscard]] const Gear& gear() const { return gear_; }
  [[nodiscard]] int teeth() const { return gear_.teeth; }
  /// +1 external, -1 ring.
  [[nodiscard]] double sense() const { return sense_; }
  [[nodiscard]] double base_radius_mm() const { return base_radius_; }
  [[nodiscard]] double reference_radius_mm() const { return reference_radius_; }
  [[nodiscard]] double tip_radius_mm() const { return tip_radius_; }
  [[nodiscard]] double root_radius_mm() const { return root_radius_; }
  [[nodiscard]] double bore_radius_mm() const { return bore_radius_; }
  [[nodiscard]] double face_width_mm() const { return face_width_; }
  [[nodiscard]] double base_helix_rad() const { return base_helix_; }
  [[nodiscard]] double cos_base_helix() const { return cos_base_helix_; }
  [[nodiscard]] double base_half_angle() const { return half_angle_; }
  [[nodiscard]] double pressure_angle_rad() const { return pressure_angle_; }
  [[nodiscard]] double root_form_roll_mm() const { return root_roll_; }
  [[nodiscard]] double tip_form_roll_mm() const { return tip_roll_; }
  /// Two hands, which meet in the middle of the face.
  [[nodiscard]] bool is_herringbone() const { return herringbone_; }
  [[nodiscard]] double edge_chamfer_mm() const { return edge_chamfer_; }
  /// True this near the groove between the halves of herringbone teeth, or in it.
  [[nodiscard]] bool near_relief_groove(double z_mm, double near_mm) const {
    return relief_groove_ > 0.0 &&
           std::abs(z_mm - 0.5 * face_width_) < 0.5 * relief_groove_ + near_mm;
  }

  /// What the design itself takes off or puts on the involute at a place of a flank [mm, along the
  /// normal, + = material]: relief, crowning.
  [[nodiscard]] double designed_deviation_mm(const Place& place) const;

  /// Roll length as -1 at the root form circle ... +1 at the tip form circle.
  [[nodiscard]] double profile_coordinate(double roll_mm) const {
    return 2.0 * (roll_mm - root_roll_) / (tip_roll_ - root_roll_) - 1.0;
  }
  /// Height as -1 ... +1 over the face.
  [[nodiscard]] double face_coordinate(double z_mm) const { return 2.0 * z_mm / face_width_ - 1.0; }
  /// Length of the involute from the base circle to this roll length.
  [[nodiscard]] double arc_at_roll_mm(double roll_mm) const {
    return 0.5 * roll_mm * roll_mm / base_radius_;
  }
  /// Rotation of the section at a height against that at z = 0.
  [[nodiscard]] double twist_rad(double z_mm) const {
    if (herringbone_ && z_mm > 0.5 * face_width_) return twist_per_mm_ * (face_width_ - z_mm);
    return twist_per_mm_ * z_mm;
  }
  /// 2 pi (tooth - 1) / z: a tooth's angle at z = 0.
  [[nodiscard]] double centre_rad(int tooth) const { return kTwoPi * (tooth - 1) / gear_.teeth; }
  /// z part of the unit normal of a flank.
  [[nodiscard]] double normal_z(const Place& place) const {
    if (place.surface != Surface::kFlank) return 0.0;
    const double hand = herringbone_ && place.z_mm > 0.5 * face_width_ ? -1.0 : 1.0;
    return -hand * place.side * sin_base_helix_;
  }

  [[nodiscard]] double roll_at_radius_mm(double radius_mm) const;
  [[nodiscard]] Place on_flank(int tooth, int side, double roll_mm, double z_mm) const;
  [[nodiscard]] Place on_circle(Surface surface, int tooth, double polar_rad, double radius_mm,
                                double z_mm) const;
  /// Nearest flank of a point, whatever its distance from the flank as designed; place.surface is
  /// kNone outside the involute (with a margin of `margin` of its length at either end).
  [[nodiscard]] PlacedPoint nearest_flank(const std::array<double, 3>& point_mm,
                                          double margin = 0.0) const;
  /// Nearest surface within `reach_mm`: flank, else tip, root or bore, else kNone.
  [[nodiscard]] PlacedPoint nearest(const std::array<double, 3>& point_mm, double reach_mm) const;
  /// Size of the distance that `nearest` tells; NaN where it finds no surface.
  [[nodiscard]] double nearest_distance_mm(const std::array<double, 3>& point_mm,
                                           double reach_mm) const;
  /// @name Of many points, into as many results: the same digits in less than half the time
  /// @{
  void nearest_flanks(std::span<const std::array<double, 3>> points_mm, double margin,
                      PlacedPoint* found) const;
  void nearest(std::span<const std::array<double, 3>> points_mm, double reach_mm,
               PlacedPoint* found) const;
  void nearest_distances_mm(std::span<const std::array<double, 3>> points_mm, double reach_mm,
                            double* found) const;
  /// @}
  /// Roll length at which a ball or pin in a gap touches, and the pressure angle at its centre.
  struct BallContact {
    double roll_mm = 0.0, centre_angle_rad = 0.0;
  };
  [[nodiscard]] BallContact ball_contact(double diameter_mm) const;

 private:
  /// A place whose directions are not computed yet.
  struct Undirected {
    Place place;
    double normal_rad = 0.0;  ///< direction of the transverse part of the outward normal
    double distance_mm = 0.0;
    /// The place has its directions: it stands near the measured point.
    bool is_directed = false;
  };
  [[nodiscard]] Place directed(const Undirected& found) const;
  [[nodiscard]] Undirected flank_place(int tooth, int side, double roll_mm, double z_mm,
                                       double pressure_rad) const;
  [[nodiscard]] Undirected circle_place(Surface surface, int tooth, double polar_rad,
                                        double radius_mm, double z_mm) const;
  [[nodiscard]] Undirected undirected_flank(const std::array<double, 3>& point_mm,
                                            double margin) const;
  [[nodiscard]] Undirected undirected(const std::array<double, 3>& point_mm, double reach_mm) const;
  [[nodiscard]] Undirected beside_flank(const std::array<double, 3>& point_mm, int tooth,
                                        double reach_mm) const;
  [[nodiscard]] ToothedCylinder cylinder() const;
  [[nodiscard]] Undirected found_at(const Foot<OneAtATime>& foot, double margin) const;
  template <class Take>
  void for_feet(std::span<const std::array<double, 3>> points_mm, double margin,
                const Take& take) const;
  Gear gear_;
  double sense_, base_radius_, reference_radius_, tip_radius_, root_radius_, bore_radius_;
  double face_width_, base_helix_, half_angle_, pressure_angle_, root_roll_, tip_roll_;
  double twist_per_mm_, cos_base_helix_, sin_base_helix_;
  double tip_half_rad_, root_half_rad_;  ///< of the tooth at the tip, of the gap at the root
  bool herringbone_;
  FlankDeviation designed_ = {};
  double edge_chamfer_ = 0.0, relief_groove_ = 0.0;
};

inline FlankGeometry::Undirected FlankGeometry::found_at(const Foot<OneAtATime>& foot,
                                                         double margin) const {
  Undirected found;
  Place& place = found.place;
  place.tooth = static_cast<int>(foot.tooth) + 1;
  place.surface = Surface::kNone;
  if (foot.radius <= base_radius_) return found;
  place.surface = Surface::kFlank;
  place.side = foot.side > 0.0 ? 1 : -1;
  place.roll_mm = foot.roll;
  place.z_mm = foot.z;
  place.radius_mm = foot.place_radius;
  place.polar_rad = foot.place_polar;
  found.normal_rad = foot.normal;
  found.distance_mm = foot.distance;
  if (!designed_.empty()) found.distance_mm -= designed_deviation_mm(place);
  if (!(std::abs(profile_coordinate(place.roll_mm)) <= 1.0 - 2.0 * margin)) {
    place.surface = Surface::kNone;
    return found;
  }
  if (!(std::abs(foot.turn) < kSmallAngle)) return found;
  place.polar_direction = foot.to;
  place.normal_direction = foot.normal_direction;
  found.is_directed = true;
  return found;
}

/// In which of so many equal parts of the profile or the face a coordinate (-1 ... 1) lies, from 0.
[[nodiscard]] inline int part_of(double coordinate, int parts) {
  return std::clamp(static_cast<int>(0.5 * (coordinate + 1.0) * parts), 0, parts - 1);
}

}  // namespace trueflank::loop
