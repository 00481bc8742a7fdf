// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/clearance/gear_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "trueflank/base/always_inline.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

/// The polar angle of a point within 45 degrees of +x, to kRoughAngle_rad.
double rough_angle_rad(double x, double y) {
  const double t = y / x, square = t * t;
  return t * (0.995354 + square * (-0.288679 + square * 0.079331));
}
constexpr double kRoughAngle_rad = 1e-3;
constexpr double kSlack_mm = 1e-9;       // for the rounding of what a point moves by

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
std::shared_ptr<const CurveSpline> spline_of(const Curve& curve, double error) {
  struct Kept {
    Curve curve;
    double error = 0.0;
    std::shared_ptr<const CurveSpline> spline;
  };
  thread_local std::array<Kept, 4> kept;
  thread_local std::size_t oldest = 0;
  for (const Kept& one : kept)
    if (one.spline && one.error == error && same_curve(one.curve, curve)) return one.spline;
  Kept& next = kept[oldest++ % kept.size()];
  next = {curve, error, std::make_shared<const CurveSpline>(curve, error)};
  return next.spline;
}

}  // namespace

GearDistance::GearDistance(const ToothProfile& profile, double spline_error)
    : pitch_rad_(kTwoPi / profile.gear().teeth),
      outward_(profile.gear().kind == GearKind::kExternal ? 1.0 : -1.0),
      half_(half_of(profile.pieces(), spline_error)) {
  for (int k = 0; k < profile.gear().teeth; ++k) axes_.push_back(unit_vector(k * pitch_rad_));
  if (!profile.symmetric()) clockwise_ = half_of(profile.clockwise_pieces(), spline_error);
}

GearDistance::Half GearDistance::half_of(const std::vector<ProfilePiece>& pieces,
                                         double spline_error) const {
  Half half;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Curve& curve = pieces[i].curve;
    const int index = static_cast<int>(i);
    if (const auto* arc = std::get_if<CircularArc>(&curve.shape)) {
      // run counter-clockwise, the circle's inside is on the left
      const double sign = (curve.end > curve.begin ? 1.0 : -1.0) * outward_;
      const auto [from, to] = std::minmax(curve.begin, curve.end);
      half.arcs.push_back({arc->centre, arc->radius_mm, sign, unit_vector(from), unit_vector(to), index});
    } else if (const auto* involute = std::get_if<Involute>(&curve.shape)) {
      half.flanks.push_back({involute->base_radius_mm, involute->base_half_angle_rad,
                             static_cast<double>(involute->sense), std::min(curve.begin, curve.end),
                             std::max(curve.begin, curve.end), curve.start_point(),
                             curve.end_point(), index});
    } else if (const auto* line = std::get_if<StraightLine>(&curve.shape)) {
      const double sign = curve.end > curve.begin ? 1.0 : -1.0;
      const double scale = line->direction.norm();
      half.lines.push_back({point_at(curve, curve.begin), sign * line->direction / scale, 0.0,
                            std::abs(curve.end - curve.begin) * scale, index});
    } else {
      half.splines.push_back({spline_of(curve, spline_error), index});
    }
  }
  add_joints(pieces, half);
  set_order(half);
  return half;
}

void GearDistance::set_order(Half& half) {
  const auto add = [&](Shape shape, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) half.order.push_back({shape, i});
  };
  add(Shape::kFlank, half.flanks.size());
  add(Shape::kArc, half.arcs.size());
  add(Shape::kLine, half.lines.size());
  add(Shape::kSpline, half.splines.size());
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
  half.joints.push_back(
      {pieces.back().curve.end_point(), last.dot(gap) * gap, static_cast<int>(pieces.size()) - 1});
}

/// The tooth in whose pitch a point lies. A mesh is turned on the mate's +x side: there a rough
/// angle tells the tooth of all points but those next to the middle of a gap.
TRUEFLANK_ALWAYS_INLINE inline int GearDistance::tooth_at(const Point2& point) const {
  if (point.x() > std::abs(point.y())) {
    const double pitches = rough_angle_rad(point.x(), point.y()) / pitch_rad_;
    const int tooth = static_cast<int>(pitches + std::copysign(0.5, pitches));
    if (std::abs(pitches - tooth) < 0.5 - kRoughAngle_rad / pitch_rad_) return tooth;
  }
  return static_cast<int>(std::nearbyint(polar_angle_rad(point) / pitch_rad_));
}

TRUEFLANK_ALWAYS_INLINE inline Point2 GearDistance::folded(const Point2& point, bool& clockwise) const {
  const auto teeth = static_cast<int>(axes_.size());
  const int tooth = tooth_at(point);
  const Point2& axis = axes_[static_cast<std::size_t>((tooth + teeth) % teeth)];
  const double across = cross(axis, point);
  clockwise = across < 0.0;
  return {axis.dot(point), std::abs(across)};
}

GearDistance::Nearest GearDistance::nearest(const Point2& point) const {
  Before nothing;
  return nearest(point, nothing);
}

GearDistance::Nearest GearDistance::nearest(const Point2& point, Before& before) const {
  bool clockwise = false;
  const Point2 q = folded(point, clockwise);
  Best best{std::numeric_limits<double>::infinity(), 0.0, -1, Point2::Zero()};
  if (!clockwise_) {
    // folding brings no two points farther apart
    const double moved_mm = (point - before.point_).norm() + kSlack_mm;
    before.point_ = point;
    before.nearest_mm_ += moved_mm;
    for (double& least : before.least_mm_) least -= moved_mm;
    measure(half_, q, best, before);
    before.nearest_mm_ = best.magnitude;
  } else {
    Before nothing;
    measure(clockwise ? *clockwise_ : half_, q, best, nothing);
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
    Before nothing;
    measure(other, 2.0 * along * ray - q, best, nothing);
    taken = taken || best.magnitude < before;
  };
  look_across(Point2::UnitX());
  look_across(unit_vector(0.5 * pitch_rad_));
  clockwise = clockwise != taken;
}

TRUEFLANK_ALWAYS_INLINE inline double GearDistance::measure_piece(const Half& half, const Measured& piece, const Point2& q, Best& best) const {
  switch (piece.shape) {
    case Shape::kFlank: return measure_flank(half.flanks[piece.index], q, best);
    case Shape::kArc: return measure_arc(half.arcs[piece.index], q, best);
    case Shape::kLine: return measure_line(half.lines[piece.index], q, best);
    case Shape::kSpline: break;
  }
  return measure_spline(half.splines[piece.index], q, best);
}

void GearDistance::measure(const Half& half, const Point2& q, Best& best, Before& before) const {
  const double nearest_mm = before.nearest_mm_;
  const std::size_t pieces = half.order.size(), bounded = std::min(pieces, Before::kPieces);
  for (std::size_t k = 0; k < bounded; ++k)
    if (before.least_mm_[k] <= nearest_mm)
      before.least_mm_[k] = measure_piece(half, half.order[k], q, best);
  for (std::size_t k = bounded; k < pieces; ++k) measure_piece(half, half.order[k], q, best);
  if (before.least_mm_.back() <= nearest_mm) measure_joints(half, q, best, before);
}

void GearDistance::measure_joints(const Half& half, const Point2& q, Best& best, Before& before) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Joint& joint : half.joints) {
    const Point2 away = q - joint.at;
    const double square = away.squaredNorm();
    least = std::min(least, square);
    // a joint within rounding of a foot on a piece leaves the piece its better sign
    if (!(square < best.magnitude * best.magnitude * (1.0 - 1e-9))) continue;
    const double distance = std::sqrt(square);
    best = {distance, away.dot(joint.outward) < 0.0 ? -distance : distance, joint.piece, joint.at,
            true};
  }
  before.least_mm_.back() = std::sqrt(least);
}

/// Between the directions of the arc's ends. No arc of a half tooth is half a circle.
bool GearDistance::in_angle(const Arc& arc, const Point2& from_centre) {
  return cross(arc.first, from_centre) >= 0.0 && cross(from_centre, arc.last) >= 0.0;
}

TRUEFLANK_ALWAYS_INLINE inline double GearDistance::measure_arc(const Arc& arc, const Point2& q, Best& best) const {
  const Point2 from_centre = q - arc.centre;
  const double radial = from_centre.norm();
  const double distance = std::abs(radial - arc.radius);
  if (distance < best.magnitude && in_angle(arc, from_centre))
    best = {distance, arc.inside_sign * (radial - arc.radius), arc.piece,
            arc.centre + from_centre * (radial > 0.0 ? arc.radius / radial : 0.0)};
  return distance;
}

/// The rough angle tells it of most points whose foot is not on the flank.
TRUEFLANK_ALWAYS_INLINE inline bool GearDistance::surely_outside(const Point2& e, const Flank& flank) {
  if (!(e.x() > std::abs(e.y()))) return false;
  const double roll = flank.sense * (rough_angle_rad(e.x(), e.y()) - flank.half_angle);
  return roll < flank.from - kRoughAngle_rad || roll > flank.to + kRoughAngle_rad;
}

TRUEFLANK_ALWAYS_INLINE inline double GearDistance::measure_flank(const Flank& flank, const Point2& q, Best& best) const {
  // without a foot of its own one of its ends is nearest
  const auto to_ends = [&] {
    return std::sqrt(std::min((q - flank.first).squaredNorm(), (q - flank.last).squaredNorm()));
  };
  const double r_b = flank.base_radius, square = q.squaredNorm();
  if (square < r_b * r_b) return to_ends();
  // the normal through the point touches the base circle in the direction e, at tau
  const double r = std::sqrt(square), length = std::sqrt((r - r_b) * (r + r_b));
  const Point2 e = (r_b * q + flank.sense * length * perpendicular(q)) / square;
  if (surely_outside(e, flank)) return to_ends();
  const double roll = flank.sense * (polar_angle_rad(e) - flank.half_angle);
  if (roll < flank.from || roll > flank.to) return to_ends();
  const double beyond = -flank.sense * (length - r_b * roll);
  const double distance = std::abs(beyond);
  if (!(distance < best.magnitude)) return std::min(distance, to_ends());
  best = {distance, beyond, flank.piece, r_b * (e - flank.sense * roll * perpendicular(e))};
  return distance;
}

double GearDistance::measure_line(const Line& line, const Point2& q, Best& best) const {
  const Point2 from_start = q - line.start;
  const double along = from_start.dot(line.direction);
  const double left = cross(line.direction, from_start);
  if (along >= line.from && along <= line.to && std::abs(left) < best.magnitude)
    best = {std::abs(left), -outward_ * left, line.piece, line.start + along * line.direction};
  return std::abs(left);
}

double GearDistance::measure_spline(const Spline& spline, const Point2& q, Best& best) const {
  const CurveSpline::Search search = spline.curve->search(q, best.magnitude);
  if (const auto& foot = search.foot)
    best = {foot->distance_mm,
            (outward_ > 0.0) == foot->on_left ? -foot->distance_mm : foot->distance_mm,
            spline.piece, foot->point};
  return search.least_mm;
}

}  // namespace trueflank
