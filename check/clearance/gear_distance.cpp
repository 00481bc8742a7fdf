// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/clearance/gear_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

/// The polar angle of a point within 45 degrees of +x, to kRoughAngle_rad.
double rough_angle_rad(double x, double y) {
  const double t = y / x, square = t * t;
  return t * (0.995354 + square * (-0.288679 + square * 0.079331));
}
constexpr double kRoughAngle_rad = 1e-3;

auto shape_of(const RackTrochoid& c) {
  return std::tie(c.pitch_radius_mm, c.corner_depth_mm, c.corner_offset_mm, c.corner_radius_mm,
                  c.stretch, c.gap_angle_rad);
}
auto shape_of(const CutterTrochoid& c) {
  return std::tie(c.centre_distance_mm, c.cutter_pitch_radius_mm, c.corner_centre_radius_mm,
                  c.corner_centre_angle_rad, c.corner_radius_mm, c.ratio, c.gap_angle_rad,
                  c.contact);
}
auto shape_of(const PointCurve& c) { return std::tie(c.point); }
template <class Shape>
bool same_shape(const Shape& a, const Shape& b)
  requires requires { shape_of(a); }
{
  return shape_of(a) == shape_of(b);
}
/// Other curves have no spline, and curves of two kinds are not the same.
template <class A, class B>
bool same_shape(const A&, const B&) {
  return false;
}

bool same_curve(const Curve& a, const Curve& b) {
  return a.begin == b.begin && a.end == b.end &&
         std::visit([](const auto& one, const auto& other) { return same_shape(one, other); },
                    a.shape, b.shape);
}

/// A curve's spline. The search for a cure asks for one gear after the other that differ in their
/// tips alone and have one fillet: the last few splines of a thread are kept. They depend on the
/// curve and on nothing else.
std::shared_ptr<const CurveSpline> spline_of(const Curve& curve) {
  struct Kept {
    Curve curve;
    std::shared_ptr<const CurveSpline> spline;
  };
  thread_local std::array<Kept, 4> kept;
  thread_local std::size_t oldest = 0;
  for (const Kept& one : kept)
    if (one.spline && same_curve(one.curve, curve)) return one.spline;
  Kept& next = kept[oldest++ % kept.size()];
  next = {curve, std::make_shared<const CurveSpline>(curve)};
  return next.spline;
}

}  // namespace

GearDistance::GearDistance(const ToothProfile& profile)
    : pitch_rad_(kTwoPi / profile.gear().teeth),
      outward_(profile.gear().kind == GearKind::kExternal ? 1.0 : -1.0),
      half_(half_of(profile.pieces())) {
  for (int k = 0; k < profile.gear().teeth; ++k) axes_.push_back(unit_vector(k * pitch_rad_));
  if (!profile.symmetric()) clockwise_ = half_of(profile.clockwise_pieces());
}

GearDistance::Half GearDistance::half_of(const std::vector<ProfilePiece>& pieces) const {
  Half half;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Curve& curve = pieces[i].curve;
    const int index = static_cast<int>(i);
    if (const auto* arc = std::get_if<CircularArc>(&curve.shape)) {
      // run counter-clockwise, the circle's inside is on the left
      const double sign = (curve.end > curve.begin ? 1.0 : -1.0) * outward_;
      half.arcs.push_back({arc->centre, arc->radius_mm, std::min(curve.begin, curve.end),
                           std::max(curve.begin, curve.end), sign, index});
    } else if (const auto* involute = std::get_if<Involute>(&curve.shape)) {
      half.flanks.push_back({involute->base_radius_mm, involute->base_half_angle_rad,
                             static_cast<double>(involute->sense), std::min(curve.begin, curve.end),
                             std::max(curve.begin, curve.end), index});
    } else if (const auto* line = std::get_if<StraightLine>(&curve.shape)) {
      const double sign = curve.end > curve.begin ? 1.0 : -1.0;
      const double scale = line->direction.norm();
      half.lines.push_back({point_at(curve, curve.begin), sign * line->direction / scale, 0.0,
                            std::abs(curve.end - curve.begin) * scale, index});
    } else {
      half.splines.push_back({spline_of(curve), index});
    }
  }
  add_joints(pieces, half);
  return half;
}

void GearDistance::add_joints(const std::vector<ProfilePiece>& pieces, Half& half) const {
  const auto outward = [&](const ProfilePiece& piece, double parameter) -> Point2 {
    return -outward_ * perpendicular(tangent_at(piece.curve, parameter));
  };
  const Point2 gap = unit_vector(0.5 * pitch_rad_);
  const Point2 first = outward(pieces.front(), pieces.front().curve.begin);
  half.joints.push_back({pieces.front().curve.start_point(), first + mirrored(first), 0});
  for (std::size_t i = 1; i < pieces.size(); ++i)
    half.joints.push_back({pieces[i].curve.start_point(),
                           outward(pieces[i - 1], pieces[i - 1].curve.end) +
                               outward(pieces[i], pieces[i].curve.begin),
                           static_cast<int>(i)});
  const Point2 last = outward(pieces.back(), pieces.back().curve.end);
  const Point2 image = 2.0 * last.dot(gap) * gap - last;
  half.joints.push_back(
      {pieces.back().curve.end_point(), last + image, static_cast<int>(pieces.size()) - 1});
}

/// The tooth in whose pitch a point lies. A mesh is turned on the mate's +x side: there a rough
/// angle tells the tooth of all points but those next to the middle of a gap.
int GearDistance::tooth_at(const Point2& point) const {
  if (point.x() > std::abs(point.y())) {
    const double pitches = rough_angle_rad(point.x(), point.y()) / pitch_rad_;
    const int tooth = static_cast<int>(pitches + std::copysign(0.5, pitches));
    if (std::abs(pitches - tooth) < 0.5 - kRoughAngle_rad / pitch_rad_) return tooth;
  }
  return static_cast<int>(std::nearbyint(polar_angle_rad(point) / pitch_rad_));
}

GearDistance::Nearest GearDistance::nearest(const Point2& point) const {
  const auto teeth = static_cast<int>(axes_.size());
  const int tooth = tooth_at(point);
  const Point2& axis = axes_[static_cast<std::size_t>((tooth + teeth) % teeth)];
  const double across = cross(axis, point);
  bool clockwise = across < 0.0;
  const Point2 q(axis.dot(point), std::abs(across));

  Best best{std::numeric_limits<double>::infinity(), 0.0, -1, Point2::Zero()};
  if (!clockwise_) {
    measure(half_, q, best);
  } else {
    measure(clockwise ? *clockwise_ : half_, q, best);
    measure_neighbours(q, best, clockwise);
  }
  return {best.signed_mm, best.piece, best.corner, clockwise, best.point};
}

void GearDistance::measure_neighbours(const Point2& q, Best& best, bool& clockwise) const {
  const Half& other = clockwise ? half_ : *clockwise_;
  bool taken = false;
  // beyond the ray that parts the wedges nothing is nearer than the ray
  const auto look_across = [&](const Point2& ray) {
    const double along = q.dot(ray);
    const double away = along > 0.0 ? std::abs(cross(ray, q)) : q.norm();
    if (!(away < best.magnitude)) return;
    const double before = best.magnitude;
    measure(other, 2.0 * along * ray - q, best);
    taken = taken || best.magnitude < before;
  };
  look_across(Point2::UnitX());
  look_across(unit_vector(0.5 * pitch_rad_));
  clockwise = clockwise != taken;
}

void GearDistance::measure(const Half& half, const Point2& q, Best& best) const {
  for (const Flank& flank : half.flanks) measure_flank(flank, q, best);
  for (const Arc& arc : half.arcs) measure_arc(arc, q, best);
  for (const Line& line : half.lines) measure_line(line, q, best);
  for (const Spline& spline : half.splines) measure_spline(spline, q, best);
  for (const Joint& joint : half.joints) {
    const Point2 away = q - joint.at;
    const double square = away.squaredNorm();
    // a joint within rounding of a foot on a piece leaves the piece its better sign
    if (!(square < best.magnitude * best.magnitude * (1.0 - 1e-9))) continue;
    const double distance = std::sqrt(square);
    best = {distance, away.dot(joint.outward) < 0.0 ? -distance : distance, joint.piece, joint.at,
            true};
  }
}

void GearDistance::measure_arc(const Arc& arc, const Point2& q, Best& best) const {
  const Point2 from_centre = q - arc.centre;
  const double radial = from_centre.norm();
  const double distance = std::abs(radial - arc.radius);
  if (!(distance < best.magnitude)) return;
  const double angle = std::atan2(from_centre.y(), from_centre.x());
  const double past = wrapped_rad(angle - arc.from);
  if (past > arc.to - arc.from) return;
  best = {distance, arc.inside_sign * (radial - arc.radius), arc.piece,
          arc.centre + from_centre * (radial > 0.0 ? arc.radius / radial : 0.0)};
}

/// The rough angle tells it of most points whose foot is not on the flank.
bool GearDistance::surely_outside(const Point2& e, const Flank& flank) {
  if (!(e.x() > std::abs(e.y()))) return false;
  const double roll = flank.sense * (rough_angle_rad(e.x(), e.y()) - flank.half_angle);
  return roll < flank.from - kRoughAngle_rad || roll > flank.to + kRoughAngle_rad;
}

void GearDistance::measure_flank(const Flank& flank, const Point2& q, Best& best) const {
  const double r_b = flank.base_radius, square = q.squaredNorm();
  if (square < r_b * r_b) return;
  // the normal through the point touches the base circle in the direction e, at tau
  const double r = std::sqrt(square), length = std::sqrt((r - r_b) * (r + r_b));
  const Point2 e = (r_b * q + flank.sense * length * perpendicular(q)) / square;
  if (surely_outside(e, flank)) return;
  const double roll = flank.sense * (polar_angle_rad(e) - flank.half_angle);
  if (roll < flank.from || roll > flank.to) return;
  const double beyond = -flank.sense * (length - r_b * roll);
  const double distance = std::abs(beyond);
  if (!(distance < best.magnitude)) return;
  best = {distance, beyond, flank.piece, r_b * (e - flank.sense * roll * perpendicular(e))};
}

void GearDistance::measure_line(const Line& line, const Point2& q, Best& best) const {
  const Point2 from_start = q - line.start;
  const double along = from_start.dot(line.direction);
  if (along < line.from || along > line.to) return;
  const double left = cross(line.direction, from_start);
  if (!(std::abs(left) < best.magnitude)) return;
  best = {std::abs(left), -outward_ * left, line.piece, line.start + along * line.direction};
}

void GearDistance::measure_spline(const Spline& spline, const Point2& q, Best& best) const {
  const auto foot = spline.curve->foot(q, best.magnitude);
  if (!foot) return;
  best = {foot->distance_mm,
          (outward_ > 0.0) == foot->on_left ? -foot->distance_mm : foot->distance_mm, spline.piece,
          foot->point};
}

}  // namespace trueflank
