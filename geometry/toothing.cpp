// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/toothing.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/fillet_turn.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/point2.h"

namespace trueflank {
namespace {

Flank flank_of(int side, GearKind kind) {
  return flank_side(Flank::kLeft, kind) == side ? Flank::kLeft : Flank::kRight;
}

/// What the chamfer takes at a height; 0 away from the end faces.
double chamfer_depth_mm(const Toothing& t, double z_mm) {
  const double from_end = std::min(z_mm, t.twist.face_width_mm - z_mm);
  return std::max(0.0, t.edge_chamfer_mm - std::max(0.0, from_end));
}

/// Turn of the flank at the circle where the undeviated flank has this roll length.
double flank_turn_rad(const Toothing& t, int tooth, int side, double roll_mm, double z_mm) {
  const Gear& gear = t.profile->gear();
  const double to_transverse = 1.0 / std::cos(base_helix_angle_rad(gear));
  const double chamfer = chamfer_depth_mm(t, z_mm);
  if (!t.has_deviation()) return -chamfer / base_radius_mm(gear);
  const Flank flank = flank_of(side, gear.kind);
  // The point that ends on this circle started on the normal, a deviation below (ring: above).
  const double sense = gear.kind == GearKind::kExternal ? 1.0 : -1.0;
  double deviation = 0.0, start = roll_mm;
  for (int i = 0; i < 20; ++i) {
    deviation = t.deviation->deviation_mm(tooth, flank, start, z_mm) * to_transverse;
    const double next = roll_mm - sense * deviation;
    if (std::abs(next - start) < 1e-13) break;
    start = next;
  }
  return (deviation - chamfer) / base_radius_mm(gear);
}

/// The section's half tooth at a height, before turning: the flank shortened by the tip's chamfer.
struct HalfPoint {
  Point2 point;
  double turn_rad = 0.0;
};

/// Roll angle where the flank ends towards the tip once the chamfer has lowered it.
double lowered_tip_roll(const ToothProfile& profile, std::size_t flank, double depth_mm) {
  const Curve& curve = profile.pieces()[flank].curve;
  if (depth_mm == 0.0 || flank != 1) return curve.begin;  // trimmed tips keep their height
  const Gear& gear = profile.gear();
  const double lower = gear.kind == GearKind::kExternal ? -depth_mm : depth_mm;
  const double radius = profile.tip_form_radius_mm() + lower;
  return roll_length_mm(std::max(radius, base_radius_mm(gear)), base_radius_mm(gear)) /
         base_radius_mm(gear);
}

HalfPoint half_point(const Toothing& t, const ToothPlace& place, double z_mm) {
  const ToothProfile& profile = *t.profile;
  const auto& pieces = profile.pieces();
  const ProfilePiece& piece = pieces[place.piece];
  const std::size_t flank = involute_piece(profile);
  const double r_b = base_radius_mm(profile.gear());
  const double depth = chamfer_depth_mm(t, z_mm);
  const auto turn_at = [&](double roll_angle) {
    return flank_turn_rad(t, place.tooth, place.side, r_b * roll_angle, z_mm);
  };
  const Curve& curve = piece.curve;
  if (place.piece > flank) {  // fillet, root
    if (piece.kind != PieceKind::kFillet) {
      const Point2 point = point_at(curve, place.parameter);
      if (place.piece != flank + 1) return {point, 0.0};
      // A sharp root: the land is scaled in its angle from the gap's middle, as the tip's is.
      const double gap = kPi / profile.gear().teeth;
      const double whole = gap - polar_angle_rad(curve.start_point());
      return {point, turn_at(pieces[flank].curve.end) * (gap - polar_angle_rad(point)) / whole};
    }
    return {point_at(curve, place.parameter),
            turn_at(pieces[flank].curve.end) *
                fillet_turn_share(profile, place.piece, place.parameter)};
  }
  const Curve& involute = pieces[flank].curve;
  const double tip_roll = lowered_tip_roll(profile, flank, depth);
  if (place.piece == flank) {
    double roll = place.parameter;
    if (tip_roll != involute.begin)
      roll = involute.end + (roll - involute.end) * (tip_roll - involute.end) /
                                (involute.begin - involute.end);
    return {point_at(involute, roll), turn_at(roll)};
  }
  const double turn = turn_at(tip_roll);
  const Point2 point = point_at(curve, place.parameter);
  if (piece.kind != PieceKind::kTip) return {point, turn};
  const Point2 corner = point_at(involute, tip_roll);
  const double end = polar_angle_rad(curve.end_point());
  const double share = end > 0.0 ? polar_angle_rad(point) / end : 1.0;
  if (tip_roll == involute.begin) return {point, turn * share};
  const double angle = polar_angle_rad(corner) * share;
  return {corner.norm() * unit_vector(angle), turn * share};
}

/// As half_point, where the bed chamfer moves walls into the material by a depth: the parallel flank,
/// turned by the deviation of the place it comes from.
HalfPoint inset_half_point(const Toothing& t, const ToothPlace& place, double depth_mm, double z_mm) {
  const auto& pieces = t.profile->pieces();
  const Point2 point = t.bed->point(place.piece, place.parameter, depth_mm);
  if (!t.has_deviation()) return {point, 0.0};
  const std::size_t flank = involute_piece(*t.profile);
  const double r_b = base_radius_mm(t.profile->gear());
  const auto turn_at = [&](double parameter) {
    const double foot = t.bed->foot(flank, parameter, depth_mm);
    return flank_turn_rad(t, place.tooth, place.side, r_b * foot, z_mm);
  };
  const Curve& involute = pieces[flank].curve;
  const ProfilePiece& piece = pieces[place.piece];
  if (place.piece == flank) return {point, turn_at(place.parameter)};
  if (place.piece > flank) {
    if (piece.kind != PieceKind::kFillet) return {point, 0.0};
    return {point, turn_at(involute.end) * fillet_turn_share(*t.profile, place.piece, place.parameter)};
  }
  const double turn = turn_at(involute.begin);
  if (piece.kind != PieceKind::kTip) return {point, turn};
  const double end = polar_angle_rad(t.bed->point(place.piece, piece.curve.end, depth_mm));
  return {point, end > 0.0 ? turn * polar_angle_rad(point) / end : turn};
}

}  // namespace

std::size_t involute_piece(const ToothProfile& profile) {
  const auto& pieces = profile.pieces();
  const auto found = std::find_if(pieces.begin(), pieces.end(), [](const ProfilePiece& p) {
    return p.kind == PieceKind::kInvolute;
  });
  TRUEFLANK_EXPECTS(found != pieces.end());
  return static_cast<std::size_t>(found - pieces.begin());
}

FaceTwist face_twist(const Gear& gear, double face_width_mm, bool herringbone,
                     double relief_groove_mm) {
  const double turn = gear.helix_angle_rad == 0.0
                          ? 0.0
                          : std::tan(gear.helix_angle_rad) / reference_radius_mm(gear);
  return {.turn_rad_per_mm = turn, .face_width_mm = face_width_mm,
          .herringbone = herringbone && turn != 0.0,
          .relief_groove_mm = herringbone && turn != 0.0 ? relief_groove_mm : 0.0};
}

double section_turn_rad(const FaceTwist& twist, double z_mm) {
  if (twist.herringbone && z_mm > 0.5 * twist.face_width_mm)
    return twist.turn_rad_per_mm * (twist.face_width_mm - z_mm);
  return twist.turn_rad_per_mm * z_mm;
}

double deviation_turn_rad(const Toothing& toothing, const ToothPlace& place, double z_mm) {
  if (!toothing.has_deviation() && toothing.edge_chamfer_mm == 0.0) return 0.0;
  return half_point(toothing, place, z_mm).turn_rad;
}

double break_parameter(const Toothing& toothing, int tooth, int side, double roll_mm, double z_mm) {
  TRUEFLANK_EXPECTS(toothing.has_deviation());
  const ToothProfile& profile = *toothing.profile;
  const Gear& gear = profile.gear();
  const double r_b = base_radius_mm(gear);
  const double deviation_mm =
      toothing.deviation->deviation_mm(tooth, flank_of(side, gear.kind), roll_mm, z_mm) /
      std::cos(base_helix_angle_rad(gear));
  const double sense = gear.kind == GearKind::kExternal ? 1.0 : -1.0;
  const double roll = (roll_mm + sense * deviation_mm) / r_b;
  const std::size_t flank = involute_piece(profile);
  const Curve& curve = profile.pieces()[flank].curve;
  double begin = lowered_tip_roll(profile, flank, chamfer_depth_mm(toothing, z_mm)),
         end = curve.end;
  if (const double depth = toothing.bed_depth_mm(z_mm); depth > 0.0) {
    begin = toothing.bed->foot(flank, curve.begin, depth);
    end = toothing.bed->foot(flank, curve.end, depth);
  }
  if (begin == curve.begin && end == curve.end) return roll;
  return curve.end + (roll - end) * (curve.begin - curve.end) / (begin - end);
}

Point2 section_point(const Toothing& toothing, const ToothPlace& place, double z_mm) {
  TRUEFLANK_EXPECTS(toothing.profile != nullptr && place.piece < toothing.profile->pieces().size());
  HalfPoint half;
  if (const double depth = toothing.bed_depth_mm(z_mm); depth > 0.0)
    half = inset_half_point(toothing, place, depth, z_mm);
  else if (toothing.has_deviation() || toothing.edge_chamfer_mm != 0.0)
    half = half_point(toothing, place, z_mm);
  else
    half.point = point_at(toothing.profile->pieces()[place.piece].curve, place.parameter);
  const Point2 turned = half.turn_rad == 0.0 ? half.point : rotated(half.point, half.turn_rad);
  const Point2 on_side = place.side > 0 ? turned : mirrored(turned);
  if (place.tooth == 0) return on_side;
  return rotated(on_side, kTwoPi * place.tooth / toothing.profile->gear().teeth);
}

std::array<double, 3> surface_point(const Toothing& toothing, const ToothPlace& place,
                                    double z_mm) {
  const Point2 section = section_point(toothing, place, z_mm);
  const double turn = section_turn_rad(toothing.twist, z_mm);
  const Point2 p = turn == 0.0 ? section : rotated(section, turn);
  std::array<double, 3> point{p.x(), p.y(), z_mm};
  if (toothing.displacement == nullptr) return point;
  const std::array<double, 3> d = (*toothing.displacement)(point);
  return {point[0] + d[0], point[1] + d[1], point[2] + d[2]};
}

}  // namespace trueflank
