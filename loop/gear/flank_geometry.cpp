// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/flank_geometry.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"

namespace trueflank::loop {

Place FlankGeometry::directed(const Undirected& found) const {
  Place place = found.place;
  if (found.is_directed) return place;
  place.polar_direction = {std::cos(place.polar_rad), std::sin(place.polar_rad)};
  place.normal_direction = {std::cos(found.normal_rad), std::sin(found.normal_rad)};
  return place;
}

ToothedCylinder FlankGeometry::cylinder() const {
  return {.teeth = gear_.teeth,
          .sense = sense_,
          .base_radius = base_radius_,
          .half_angle = half_angle_,
          .face_width = face_width_,
          .twist_per_mm = twist_per_mm_,
          .cos_base_helix = cos_base_helix_,
          .sin_base_helix = sin_base_helix_,
          .herringbone = herringbone_};
}

FlankGeometry::FlankGeometry(const ToothProfile& profile, double face_width_mm,
                             double bore_radius_mm, bool herringbone)
    : gear_(profile.gear()),
      sense_(gear_.kind == GearKind::kExternal ? 1.0 : -1.0),
      base_radius_(trueflank::base_radius_mm(gear_)),
      reference_radius_(trueflank::reference_radius_mm(gear_)),
      tip_radius_(profile.tip_radius_mm()),
      root_radius_(profile.root_radius_mm()),
      bore_radius_(bore_radius_mm),
      face_width_(face_width_mm),
      base_helix_(base_helix_angle_rad(gear_)),
      half_angle_(base_half_angle_rad(gear_)),
      pressure_angle_(transverse_pressure_angle_rad(gear_)),
      root_roll_(profile.root_form_roll_length_mm()),
      tip_roll_(profile.tip_form_roll_length_mm()),
      twist_per_mm_(std::tan(base_helix_) / base_radius_),
      cos_base_helix_(std::cos(base_helix_)),
      sin_base_helix_(std::sin(base_helix_)),
      tip_half_rad_(tooth_half_angle_rad(gear_, std::max(tip_radius_, base_radius_))),
      root_half_rad_(kPi / gear_.teeth -
                     tooth_half_angle_rad(gear_, std::max(root_radius_, base_radius_))),
      herringbone_(herringbone) {
  TRUEFLANK_EXPECTS(face_width_mm > 0.0);
}

FlankGeometry::FlankGeometry(const TrainGear& gear, double bore_radius_mm)
    : FlankGeometry(gear.profile, gear.face_width_mm, bore_radius_mm, gear.twist.herringbone) {
  designed_ = gear.deviation;
  edge_chamfer_ = gear.edge_chamfer_mm;
  relief_groove_ = gear.twist.relief_groove_mm;
}

double FlankGeometry::designed_deviation_mm(const Place& place) const {
  if (designed_.empty() || place.surface != Surface::kFlank) return 0.0;
  const Flank flank =
      flank_side(Flank::kLeft, gear_.kind) == place.side ? Flank::kLeft : Flank::kRight;
  return designed_.deviation_mm(place.tooth - 1, flank, place.roll_mm, place.z_mm);
}

double FlankGeometry::roll_at_radius_mm(double radius_mm) const {
  return roll_length_mm(radius_mm, base_radius_);
}

Place FlankGeometry::on_flank(int tooth, int side, double roll_mm, double z_mm) const {
  return directed(flank_place(tooth, side, roll_mm, z_mm, std::atan(roll_mm / base_radius_)));
}

/// The pressure angle is the arc tangent of the roll length over the base radius.
FlankGeometry::Undirected FlankGeometry::flank_place(int tooth, int side, double roll_mm,
                                                     double z_mm, double pressure_rad) const {
  Foot<OneAtATime> foot;
  foot.tooth = tooth - 1;
  foot.side = side;
  foot.roll = roll_mm;
  foot.z = z_mm;
  set_place<OneAtATime>(cylinder(), pressure_rad, foot);
  Undirected found;
  found.place = {.surface = Surface::kFlank,
                 .side = static_cast<std::int8_t>(side),
                 .tooth = tooth,
                 .roll_mm = roll_mm,
                 .z_mm = z_mm,
                 .radius_mm = foot.place_radius,
                 .polar_rad = foot.place_polar};
  found.normal_rad = foot.normal;
  return found;
}

Place FlankGeometry::on_circle(Surface surface, int tooth, double polar_rad, double radius_mm,
                               double z_mm) const {
  return directed(circle_place(surface, tooth, polar_rad, radius_mm, z_mm));
}

FlankGeometry::Undirected FlankGeometry::circle_place(Surface surface, int tooth, double polar_rad,
                                                      double radius_mm, double z_mm) const {
  Undirected found;
  Place& place = found.place;
  place.surface = surface;
  place.tooth = tooth;
  place.z_mm = z_mm;
  place.radius_mm = radius_mm;
  place.polar_rad = polar_rad;
  // Walls of the toothing face outwards on a gear, inwards on a ring; a bore faces the axis.
  const bool outwards = surface != Surface::kBore && sense_ > 0.0;
  found.normal_rad = outwards ? polar_rad : polar_rad + kPi;
  return found;
}

PlacedPoint FlankGeometry::nearest_flank(const std::array<double, 3>& p, double margin) const {
  const Undirected found = undirected_flank(p, margin);
  return {directed(found), found.distance_mm};
}

PlacedPoint FlankGeometry::nearest(const std::array<double, 3>& p, double reach_mm) const {
  const Undirected found = undirected(p, reach_mm);
  return {directed(found), found.distance_mm};
}

double FlankGeometry::nearest_distance_mm(const std::array<double, 3>& p, double reach_mm) const {
  const Undirected placed = undirected(p, reach_mm);
  return placed.place.surface == Surface::kNone ? kNaN : std::abs(placed.distance_mm);
}

FlankGeometry::Undirected FlankGeometry::undirected_flank(const std::array<double, 3>& p,
                                                          double margin) const {
  return found_at(foot_of<OneAtATime>(cylinder(), p[0], p[1], p[2]), margin);
}

FlankGeometry::Undirected FlankGeometry::undirected(const std::array<double, 3>& p,
                                                    double reach_mm) const {
  const Undirected flank = undirected_flank(p, kFlankMargin);
  if (flank.place.surface == Surface::kFlank && std::abs(flank.distance_mm) < reach_mm)
    return flank;
  return beside_flank(p, flank.place.tooth, reach_mm);
}

/// Of a point near no flank: tip, root or bore, else none.
FlankGeometry::Undirected FlankGeometry::beside_flank(const std::array<double, 3>& p, int tooth,
                                                      double reach_mm) const {
  const double radius = std::hypot(p[0], p[1]);
  const double polar = std::atan2(p[1], p[0]);
  const double pitch = kTwoPi / gear_.teeth;
  const double from_tooth = std::abs(centred_rad(polar - twist_rad(p[2]), pitch));
  Undirected result;
  result.place.surface = Surface::kNone;
  const auto place_on = [&](Surface surface, double nominal) {
    result = circle_place(surface, tooth, polar, nominal, p[2]);
    const double outward = surface == Surface::kBore ? -1.0 : sense_;
    result.distance_mm = outward * (radius - nominal);
  };
  if (std::abs(radius - tip_radius_) < reach_mm && from_tooth < 0.7 * tip_half_rad_)
    place_on(Surface::kTip, tip_radius_);
  else if (std::abs(radius - root_radius_) < reach_mm &&
           0.5 * pitch - from_tooth < std::min(0.25 * root_half_rad_, 0.05 * pitch))
    place_on(Surface::kRoot, root_radius_);
  else if (bore_radius_ > 0.0 && std::abs(radius - bore_radius_) < reach_mm)
    place_on(Surface::kBore, bore_radius_);
  return result;
}

FlankGeometry::BallContact FlankGeometry::ball_contact(double diameter_mm) const {
  // The ball's centre lies on the involute parallel to the flank at the transverse ball radius.
  const double radius = 0.5 * diameter_mm / std::cos(base_helix_);
  const double inv = sense_ > 0.0 ? radius / base_radius_ + half_angle_ - kPi / gear_.teeth
                                  : kPi / gear_.teeth - half_angle_ - radius / base_radius_;
  BallContact contact;
  if (inv <= 0.0) return {kNaN, kNaN};
  contact.centre_angle_rad = inverse_involute_rad(inv);
  contact.roll_mm = base_radius_ * std::tan(contact.centre_angle_rad) - sense_ * radius;
  return contact;
}

}  // namespace trueflank::loop
