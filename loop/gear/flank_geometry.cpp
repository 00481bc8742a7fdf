// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/flank_geometry.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"

namespace trueflank::loop {

namespace {

/// Below this series for angles tell as many digits as the functions: the next term is less than 1e-17
/// of the first.
constexpr double kSmallAngle = 0.01;

/// The arc tangent of (a - b) / (1 + a b) on top of that of b: that of a, where they are near.
double arc_tangent_near(double a, double b, double arc_tangent_of_b) {
  const double t = (a - b) / (1.0 + a * b), s = t * t;
  if (!(s < kSmallAngle * kSmallAngle)) return std::atan(a);
  return arc_tangent_of_b + t * (1.0 - s * (1.0 / 3.0 - s * (0.2 - s * (1.0 / 7.0 - s / 9.0))));
}

/// A direction turned by a small angle.
std::array<double, 2> turned(const std::array<double, 2>& direction, double angle_rad) {
  const double s = angle_rad * angle_rad;
  const double cosine = 1.0 - s * (0.5 - s * (1.0 / 24.0 - s * (1.0 / 720.0 - s / 40320.0)));
  const double sine =
      angle_rad * (1.0 - s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5040.0 - s / 362880.0))));
  return {direction[0] * cosine - direction[1] * sine, direction[0] * sine + direction[1] * cosine};
}

}  // namespace

Place FlankGeometry::directed(const Undirected& found) const {
  if (found.place.surface == Surface::kFlank && std::abs(found.turn_rad) < kSmallAngle)
    return directed_on_flank(found);
  Place place = found.place;
  place.polar_direction = {std::cos(place.polar_rad), std::sin(place.polar_rad)};
  place.normal_direction = {std::cos(found.normal_rad), std::sin(found.normal_rad)};
  return place;
}

/// From the direction of the measured point, without cosines and sines. The normal stands to the
/// direction of the place as the tangent of the base circle stands to the radius: by the angle
/// whose cosine is base radius over radius, short of a right angle.
Place FlankGeometry::directed_on_flank(const Undirected& found) const {
  Place place = found.place;
  place.polar_direction = turned(found.from_direction, found.turn_rad);
  const double along = sense_ * place.roll_mm / place.radius_mm,
               across = place.side * base_radius_ / place.radius_mm;
  const auto [x, y] = place.polar_direction;
  place.normal_direction = {x * along - y * across, x * across + y * along};
  return place;
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
  Undirected found;
  Place& place = found.place;
  place.surface = Surface::kFlank;
  place.tooth = tooth;
  place.side = static_cast<std::int8_t>(side);
  place.roll_mm = roll_mm;
  place.z_mm = z_mm;
  const double xi = roll_mm / base_radius_;
  const double inv = xi - pressure_rad;
  const double centre = centre_rad(tooth) + twist_rad(z_mm);
  place.radius_mm = std::sqrt(base_radius_ * base_radius_ + roll_mm * roll_mm);
  place.polar_rad = centre + side * (half_angle_ - sense_ * inv);
  found.normal_rad = centre + side * (0.5 * kPi + half_angle_ - sense_ * xi);
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
  const double radius = std::sqrt(p[0] * p[0] + p[1] * p[1]);
  const double polar = std::atan2(p[1], p[0]);
  const double pitch = kTwoPi / gear_.teeth;
  const double from_first = polar - twist_rad(p[2]);
  const double number = std::round(from_first / pitch);
  const double offset = from_first - number * pitch;
  int tooth = static_cast<int>(number) % gear_.teeth;
  if (tooth < 0) tooth += gear_.teeth;
  const int side = offset >= 0.0 ? 1 : -1;
  if (radius <= base_radius_) {
    Undirected none;
    none.place.surface = Surface::kNone;
    none.place.tooth = tooth + 1;
    return none;
  }
  const double roll = std::sqrt((radius - base_radius_) * (radius + base_radius_));
  const double pressure = std::atan(roll / base_radius_);  // of the point
  const double involute = roll - base_radius_ * pressure;
  const double transverse = base_radius_ * (side * offset - half_angle_) + sense_ * involute;
  // The foot of the normal: on a helical flank it stands at another height than the point.
  const double distance = transverse * cos_base_helix_;
  const double roll_of_place = std::max(0.0, roll - sense_ * distance * cos_base_helix_);
  const double hand = herringbone_ && p[2] > 0.5 * face_width_ ? -1.0 : 1.0;
  Undirected result = flank_place(
      tooth + 1, side, roll_of_place, p[2] + distance * hand * side * sin_base_helix_,
      arc_tangent_near(roll_of_place / base_radius_, roll / base_radius_, pressure));
  result.from_direction = {p[0] / radius, p[1] / radius};
  // within two turns, but for flanks twisted further
  double turn = result.place.polar_rad - polar;
  if (turn > kPi) turn -= kTwoPi;
  result.turn_rad = std::abs(turn) <= kPi ? turn : std::remainder(turn, kTwoPi);
  result.distance_mm = distance - designed_deviation_mm(result.place);
  const double u = profile_coordinate(result.place.roll_mm);
  if (!(std::abs(u) <= 1.0 - 2.0 * margin)) result.place.surface = Surface::kNone;
  return result;
}

FlankGeometry::Undirected FlankGeometry::undirected(const std::array<double, 3>& p,
                                                    double reach_mm) const {
  Undirected flank = undirected_flank(p, kFlankMargin);
  if (flank.place.surface == Surface::kFlank && std::abs(flank.distance_mm) < reach_mm)
    return flank;
  const double radius = std::hypot(p[0], p[1]);
  const double polar = std::atan2(p[1], p[0]);
  const double pitch = kTwoPi / gear_.teeth;
  const double from_tooth = std::abs(centred_rad(polar - twist_rad(p[2]), pitch));
  Undirected result;
  result.place.surface = Surface::kNone;
  const auto place_on = [&](Surface surface, double nominal) {
    result = circle_place(surface, flank.place.tooth, polar, nominal, p[2]);
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
