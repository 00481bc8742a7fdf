// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/toothing_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trueflank/base/units.h"
#include "trueflank/geometry/fillet_turn.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {
namespace {

/// Steps back to where a displaced point came from, each as much nearer as the displacement changes from place
/// to place; until they are as short as this.
constexpr int kMostSteps = 40;
constexpr double kShortestStep_mm = 1e-7;
/// Nodes of the table that gives the share of the flank's turn at a circle of the fillet.
constexpr int kFilletNodes = 129;
/// Nearer than this a point lies on the surface, and the direction of its distance is rounding.
constexpr double kOnSurface_mm = 1e-9;
/// Step for slopes in space.
constexpr double kStep_mm = 1e-5;
/// A distance within a plane rises by 1; where two walls meet, its slope is between theirs.
constexpr double kLeastSlope = 0.7;
/// A distance above this part of the fillet's height is also looked for in the section.
constexpr double kSmallFillet = 0.2;
/// Chords of a section's line: of each fillet, and of this part of the flank before it.
constexpr int kRootChords = 48;
constexpr double kFlanksFoot = 0.1;
/// Step along a curve for its tangent, of its length.
constexpr double kParameterStep = 1e-5;

OutlineDistance design_section(const ToothedOutline& outline) {
  return OutlineDistance(ToothedOutline{.profile = outline.profile, .twist = {}});
}

}  // namespace

ToothingDistance::ToothingDistance(const ToothedOutline& outline)
    : outline_(outline),
      toothing_(outline.toothing()),
      unchamfered_(toothing_),
      section_(design_section(outline)) {
  unchamfered_.edge_chamfer_mm = 0.0;
  base_radius_mm_ = base_radius_mm(outline.profile->gear());
  const double slope = toothing_.twist.turn_rad_per_mm *
                       std::max(base_radius_mm_, outline.profile->root_radius_mm());
  steepest_ = std::sqrt(1.0 + slope * slope);
  deviates_ = toothing_.has_deviation() || toothing_.edge_chamfer_mm > 0.0;
  const auto& pieces = outline.profile->pieces();
  flank_ = involute_piece(*outline.profile);
  if (pieces.front().kind == PieceKind::kTip)
    tip_half_angle_rad_ = polar_angle_rad(pieces.front().curve.end_point());
  if (flank_ + 1 < pieces.size() && pieces[flank_ + 1].kind == PieceKind::kRoot)
    root_half_angle_rad_ = kPi / outline.profile->gear().teeth -
                           polar_angle_rad(pieces[flank_ + 1].curve.start_point());
  low_roll_ = std::min(pieces[flank_].curve.begin, pieces[flank_].curve.end);
  high_roll_ = std::max(pieces[flank_].curve.begin, pieces[flank_].curve.end);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces[k].kind != PieceKind::kFillet) continue;
    const Curve& curve = pieces[k].curve;
    for (int i = 0; i < kFilletNodes; ++i) {
      const double at =
          std::lerp(curve.begin, curve.end, static_cast<double>(i) / (kFilletNodes - 1));
      fillet_radii_mm_.push_back(point_at(curve, at).norm());
      fillet_fades_.push_back(fillet_turn_share(*outline.profile, k, at));
    }
  }
  if (deviates_ && !fillet_radii_mm_.empty())
    small_fillet_mm_ = kSmallFillet * std::abs(fillet_radii_mm_.back() - fillet_radii_mm_.front());
  if (toothing_.displacement == nullptr) return;
  const double radius = outline.profile->tip_radius_mm();
  for (int k = 0; k < 16; ++k)
    for (const double z :
         {0.0, 0.5 * toothing_.twist.face_width_mm, toothing_.twist.face_width_mm}) {
      const Point2 p = radius * unit_vector(kTwoPi * k / 16);
      const auto d = (*toothing_.displacement)({p.x(), p.y(), z});
      largest_displacement_mm_ = std::max(largest_displacement_mm_, std::hypot(d[0], d[1], d[2]));
    }
}

Point3 ToothingDistance::in_gear(const Point3& point) const {
  const Point2 turned = outline_.rotation_rad == 0.0
                            ? Point2(point.head<2>())
                            : rotated(point.head<2>(), -outline_.rotation_rad);
  return {turned.x(), turned.y(), point.z() - outline_.z_lower_mm};
}

Point3 ToothingDistance::undisplaced(const Point3& in_gear) const {
  if (toothing_.displacement == nullptr) return in_gear;
  Point3 origin = in_gear;
  for (int i = 0; i < kMostSteps; ++i) {
    const Point3 before = origin;
    const auto d = (*toothing_.displacement)({origin.x(), origin.y(), origin.z()});
    origin = in_gear - Point3(d.data());
    if ((origin - before).squaredNorm() <= kShortestStep_mm * kShortestStep_mm) break;
  }
  return origin;
}

double ToothingDistance::undisplaced_z_mm(const Point3& point) const {
  return undisplaced(in_gear(point)).z() + outline_.z_lower_mm;
}

double ToothingDistance::lower_bound_mm(const Point3& point) const {
  // a deviation turns points about the axis: their radii stay
  const double bound = section_.lower_bound_mm(point.head<2>()) - toothing_.edge_chamfer_mm -
                       toothing_.bed_depth_mm(0.0) - 2.0 * largest_displacement_mm_;
  return std::max(0.0, bound) / steepest_;
}

double ToothingDistance::chamfer_depth_mm(double z_mm) const {
  const double from_end = std::min(z_mm, toothing_.twist.face_width_mm - z_mm);
  return std::max(0.0, toothing_.edge_chamfer_mm - std::max(0.0, from_end));
}

ToothingDistance::CircleTurn ToothingDistance::turn_of_circle(int tooth, int side, double radius_mm,
                                                              double z_mm) const {
  const double r_b = base_radius_mm_;
  const double roll = std::clamp(roll_length_mm(radius_mm, r_b) / r_b, low_roll_, high_roll_);
  double fade = 1.0, fade_rise = 0.0;
  const double to_root =
      fillet_radii_mm_.empty() ? 0.0 : fillet_radii_mm_.back() - fillet_radii_mm_.front();
  const double into =
      fillet_radii_mm_.empty() ? -1.0 : (radius_mm - fillet_radii_mm_.front()) * to_root;
  if (into > 0.0) {
    const bool falls = to_root < 0.0;
    const auto node =
        std::partition_point(fillet_radii_mm_.begin(), fillet_radii_mm_.end(),
                             [&](double r) { return falls ? r > radius_mm : r < radius_mm; });
    if (node == fillet_radii_mm_.end()) return {};
    const auto i = static_cast<std::size_t>(node - fillet_radii_mm_.begin());
    const double before = fillet_radii_mm_[i - 1], step = fillet_radii_mm_[i] - before;
    const double share = step != 0.0 ? (radius_mm - before) / step : 0.0;
    fade = std::lerp(fillet_fades_[i - 1], fillet_fades_[i], share);
    if (step != 0.0) fade_rise = (fillet_fades_[i] - fillet_fades_[i - 1]) / step;
  }
  const double turn = toothing_.has_deviation()
                          ? deviation_turn_rad(unchamfered_, {tooth, side, flank_, roll}, z_mm)
                          : 0.0;
  const double whole = turn - chamfer_depth_mm(z_mm) / r_b;
  return {fade * whole, fade_rise * whole};
}

ToothingDistance::CircleTurn ToothingDistance::turn_back(const Point2& place, double z_mm) const {
  const int teeth = outline_.profile->gear().teeth;
  const double pitch = kTwoPi / teeth;
  const double angle = polar_angle_rad(place);
  const double away = std::round(wrapped_rad(angle) / pitch);
  const int tooth = static_cast<int>(away) % teeth;
  const int side = centred_rad(angle - away * pitch) < 0.0 ? -1 : 1;
  const double radius = place.norm();
  auto [turn, rise] = turn_of_circle(tooth, side, radius, z_mm);
  // the tip's land is scaled in its angle, so that its end meets the flank; an undercut foot may be
  // as narrow and is no land
  const double from_middle = std::abs(centred_rad(angle - away * pitch));
  const ToothProfile& profile = *outline_.profile;
  const bool at_tip_end =
      std::abs(radius - profile.tip_radius_mm()) < std::abs(radius - profile.root_form_radius_mm());
  if (at_tip_end && from_middle < tip_half_angle_rad_ + turn)
    turn *= from_middle / (tip_half_angle_rad_ + turn);
  const double from_gap = 0.5 * pitch - from_middle;  // the land of a sharp root alike
  if (root_half_angle_rad_ > 0.0 && !at_tip_end && from_gap < root_half_angle_rad_ - turn)
    turn *= from_gap / (root_half_angle_rad_ - turn);
  return {-side * turn, -side * rise};
}

ToothingDistance::SectionFoot ToothingDistance::section_foot(const Point2& turned_back,
                                                             double z_mm) const {
  // turning, a section moves square to itself by the lever of the foot about the axis
  const auto foot_of = [&](const Point2& point, double rise_rad_per_mm) {
    const OutlineFoot foot = section_.foot(point);
    if (std::abs(foot.distance_mm) < kOnSurface_mm) return SectionFoot{foot.distance_mm};
    const Point2 normal = (point - foot.point) / foot.distance_mm;
    const double lever = cross(foot.point, normal);
    if (rise_rad_per_mm == 0.0) return SectionFoot{foot.distance_mm, lever};
    const Point2 slope = normal + lever * rise_rad_per_mm * point.normalized();
    return SectionFoot{foot.distance_mm, lever, std::max(slope.norm(), kLeastSlope)};
  };
  if (!deviates_) return foot_of(turned_back, 0.0);
  const auto turned_by = [&](const CircleTurn& turn) {
    return foot_of(rotated(turned_back, turn.turn_rad), turn.rise_rad_per_mm);
  };
  SectionFoot foot;
  if (toothing_.bed_depth_mm(z_mm) == 0.0) {
    foot = turned_by(turn_back(turned_back, z_mm));
  } else {  // deep in the material: the deviation is that of the place on the design straight over
            // it
    Point2 over = turned_back;
    for (int i = 0; i < 2; ++i)
      over = section_.foot(rotated(turned_back, turn_back(over, z_mm).turn_rad)).point;
    foot = turned_by(turn_back(over, z_mm));
  }
  const double depth = chamfer_depth_mm(z_mm);
  if (depth == 0.0 || flank_ != 1) return foot;  // trimmed and radial tips keep their height
  const bool external = outline_.profile->gear().kind == GearKind::kExternal;
  const double lowered = outline_.profile->tip_radius_mm() + (external ? -depth : depth);
  const double over_tip = turned_back.norm() - lowered;
  const bool at_tip = external ? over_tip > foot.distance_mm : over_tip < foot.distance_mm;
  return at_tip ? SectionFoot{over_tip, 0.0} : foot;
}

double ToothingDistance::distance_mm(const Point3& point) const {
  const double distance = distance_by_turning_mm(point);
  if (!(std::abs(distance) > small_fillet_mm_)) return distance;
  const double radius = point.head<2>().norm(), reach = 2.0 * std::abs(distance);
  const auto [low, high] = std::minmax(fillet_radii_mm_.front(), fillet_radii_mm_.back());
  if (radius < low - reach || radius > high + reach) return distance;
  return std::copysign(std::min(std::abs(distance), distance_from_root_mm(point)), distance);
}

double ToothingDistance::distance_from_root_mm(const Point3& point) const {
  const Point3 p = undisplaced(in_gear(point));
  const int teeth = outline_.profile->gear().teeth;
  const double angle = polar_angle_rad(p.head<2>()) - section_turn_rad(toothing_.twist, p.z());
  const int tooth = static_cast<int>(std::round(wrapped_rad(angle) * teeth / kTwoPi));
  const auto& pieces = outline_.profile->pieces();
  double nearest = std::numeric_limits<double>::infinity();
  for (int side = 0; side < 6; ++side) {
    const int copy = 2 * ((tooth + side / 2 - 1 + teeth) % teeth) + side % 2;
    for (std::size_t k = flank_; k < pieces.size(); ++k) {
      const Curve& curve = pieces[k].curve;
      const double from =
          k == flank_ ? std::lerp(curve.end, curve.begin, kFlanksFoot) : curve.begin;
      Point2 before = point_at_height(k, from, copy, point.z());
      for (int i = 1; i <= kRootChords; ++i) {
        const Point2 after = point_at_height(
            k, std::lerp(from, curve.end, static_cast<double>(i) / kRootChords), copy, point.z());
        const Point2 chord = after - before;
        const double along =
            chord.dot(point.head<2>() - before) / std::max(chord.squaredNorm(), 1e-300);
        nearest = std::min(nearest,
                           (point.head<2>() - before - std::clamp(along, 0.0, 1.0) * chord).norm());
        before = after;
      }
    }
  }
  return nearest;
}

double ToothingDistance::distance_by_turning_mm(const Point3& point) const {
  const Point3 p = undisplaced(in_gear(point));
  const double turn_rate = toothing_.twist.turn_rad_per_mm;
  const auto section_at = [&](const Point3& place) {
    const double turn = section_turn_rad(toothing_.twist, place.z());
    return section_foot(turn == 0.0 ? Point2(place.head<2>()) : rotated(place.head<2>(), -turn),
                        place.z());
  };
  const SectionFoot foot = section_at(p);
  const double shrinks = outline_.profile->gear().kind == GearKind::kExternal ? 1.0 : -1.0;
  const auto distance_at = [&](const Point3& place) {
    return section_at(place).distance_mm + shrinks * toothing_.bed_depth_mm(place.z());
  };
  if (chamfer_depth_mm(p.z()) > 0.0 || toothing_.bed_depth_mm(p.z()) > 0.0) {
    // a chamfer turns circles so differently that the way back stretches: by its slopes in space
    const double distance = foot.distance_mm + shrinks * toothing_.bed_depth_mm(p.z());
    if (std::abs(distance) < kOnSurface_mm) return distance;
    Point3 slopes;
    for (int k = 0; k < 3; ++k) {
      const Point3 step = kStep_mm * Point3::Unit(k);
      slopes[k] = (distance_at(p + step) - distance_at(p - step)) / (2.0 * kStep_mm);
    }
    return distance / std::max(slopes.norm(), kLeastSlope);
  }
  const double slope = turn_rate * foot.lever_mm;
  if (slope == 0.0) return foot.distance_mm / foot.stretch;
  return foot.distance_mm / std::hypot(foot.stretch, slope);
}

Point2 ToothingDistance::point_at_height(std::size_t piece, double parameter, int copy,
                                         double z_mm) const {
  const ToothPlace place{copy / 2, copy % 2 == 0 ? 1 : -1, piece, parameter};
  const double goal = z_mm - outline_.z_lower_mm;
  auto p = surface_point(toothing_, place, goal);
  if (toothing_.displacement != nullptr)
    for (int i = 0; i < 2; ++i) p = surface_point(toothing_, place, goal - (p[2] - goal));
  return rotated({p[0], p[1]}, outline_.rotation_rad);
}

std::vector<double> ToothingDistance::breaks_at_height(std::size_t piece, int copy,
                                                       double z_mm) const {
  std::vector<double> breaks;
  if (piece != flank_ || !toothing_.has_deviation()) return breaks;
  const Curve& curve = outline_.profile->pieces()[piece].curve;
  for (const double roll_mm : toothing_.deviation->roll_breaks_mm) {
    const double at = break_parameter(toothing_, copy / 2, copy % 2 == 0 ? 1 : -1, roll_mm,
                                      z_mm - outline_.z_lower_mm);
    if ((at - curve.begin) * (at - curve.end) < 0.0) breaks.push_back(at);
  }
  return breaks;
}

double ToothingDistance::slope_share(std::size_t piece, double parameter, int copy,
                                     double z_mm) const {
  const Curve& curve = outline_.profile->pieces()[piece].curve;
  const double step = kParameterStep * (curve.end - curve.begin);
  const bool at_end = (parameter + step - curve.begin) * (parameter + step - curve.end) > 0.0;
  const auto at = [&](double t, double z) { return point_at_height(piece, t, copy, z); };
  const Point2 here = at(parameter, z_mm);
  const Point2 along = (at(at_end ? parameter - step : parameter + step, z_mm) - here).normalized();
  const double height = z_mm - outline_.z_lower_mm;
  const double up = height + kStep_mm > toothing_.twist.face_width_mm ? -kStep_mm : kStep_mm;
  const double slope = cross(along, at(parameter, z_mm + up) - here) / up;
  return 1.0 / std::sqrt(1.0 + slope * slope);
}

}  // namespace trueflank
