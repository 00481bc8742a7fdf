// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/outline_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "trueflank/base/units.h"
#include "trueflank/solid/measure/segment_fan.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// Places where a curve's radii are taken.
constexpr int kNodes = 33;
/// The tooth in whose pitch a point is comes from a table; from an arc tangent near the middle of a
/// gap, as a share of half a pitch, and where teeth are few.
constexpr std::size_t kBinsPerTooth = 8;
constexpr double kSurePitch = 0.999;
constexpr int kLeastTeethLikely = 5;

double parameter(const Curve& curve, double share) {
  return curve.begin + share * (curve.end - curve.begin);
}

double length_of(const Curve& curve) {
  double length = 0.0;
  Point2 last = curve.start_point();
  for (int i = 1; i <= 16; ++i) {
    const Point2 next = point_at(curve, parameter(curve, i / 16.0));
    length += (next - last).norm();
    last = next;
  }
  return length;
}

double turning_of(const Curve& curve) {
  double turning = 0.0;
  Point2 last = tangent_at(curve, curve.begin);
  for (int i = 1; i <= 8; ++i) {
    const Point2 next = tangent_at(curve, parameter(curve, i / 8.0));
    turning += std::abs(std::atan2(cross(last, next), last.dot(next)));
    last = next;
  }
  return turning;
}

/// Out of the enclosed area: right of the direction of travel.
Point2 normal_of(const Curve& curve, double at) { return -perpendicular(tangent_at(curve, at)); }

/// The foot within a curve, where there is one.
using InnerFoot = std::optional<OutlineFoot>;

InnerFoot inner_foot(const CircularArc& c, const Curve& curve, const Point2& p) {
  const double low = std::min(curve.begin, curve.end), high = std::max(curve.begin, curve.end);
  const Point2 from_centre = p - c.centre;
  const double distance = from_centre.norm();
  if (distance == 0.0 || low + wrapped_rad(polar_angle_rad(from_centre) - low) > high) return {};
  const double outside =
      curve.end > curve.begin ? 1.0 : -1.0;  // counter-clockwise: away from the centre
  return OutlineFoot{c.centre + from_centre * (c.radius_mm / distance),
                     outside * (distance - c.radius_mm)};
}

InnerFoot inner_foot(const StraightLine& c, const Curve& curve, const Point2& p) {
  const double t = (p - c.start).dot(c.direction) / c.direction.squaredNorm();
  if (t < std::min(curve.begin, curve.end) || t > std::max(curve.begin, curve.end)) return {};
  const Point2 right = curve.end > curve.begin ? Point2(-perpendicular(c.direction.normalized()))
                                               : perpendicular(c.direction.normalized());
  const Point2 foot = c.start + t * c.direction;
  return OutlineFoot{foot, (p - foot).dot(right)};
}

InnerFoot inner_foot(const Involute& c, const Curve& curve, const Point2& p) {
  const double r2 = p.squaredNorm(), r_b = c.base_radius_mm;
  if (r2 < r_b * r_b) return {};
  // The normal through p touches the base circle at angle tau and crosses the involute at roll
  // angle xi; outside the enclosed area the point is farther from there than the involute, on
  // either kind.
  const double tangent = std::sqrt(r2 - r_b * r_b);
  const double tau = polar_angle_rad(r_b * p + c.sense * tangent * perpendicular(p));
  const double xi = c.sense * (tau - c.base_half_angle_rad);
  if (xi < std::min(curve.begin, curve.end) || xi > std::max(curve.begin, curve.end)) return {};
  const Point2 e = (r_b * p + c.sense * tangent * perpendicular(p)) / r2;
  const double distance = tangent - r_b * xi;
  return OutlineFoot{p + c.sense * distance * perpendicular(e), distance};
}

Curve line_between(const Point2& from, const Point2& to) {
  const double length = (to - from).norm();
  return {StraightLine{from, (to - from) / length}, 0.0, length};
}

}  // namespace

OutlineDistance::OutlineDistance(const Outline& outline) {
  const OutlineExtent radii = extent(outline);
  centre_ = radii.centre;
  inner_radius_mm_ = radii.inner_radius_mm;
  outer_radius_mm_ = radii.outer_radius_mm;
  if (const auto* toothed = std::get_if<ToothedOutline>(&outline)) {
    teeth_ = toothed->profile->gear().teeth;
    rotation_rad_ = toothed->rotation_rad;
    for (int k = 0; k < teeth_; ++k)
      directions_.push_back(unit_vector(rotation_rad_ + kTwoPi * k / teeth_));
    find_likely_teeth();
    for (const ProfilePiece& piece : toothed->profile->pieces()) add(piece.curve);
  } else if (const auto* circle = std::get_if<CircleOutline>(&outline)) {
    is_circle_ = true;
    add({CircularArc{Point2::Zero(), circle->radius_mm}, 0.0, kTwoPi});
  } else {
    const BoreDesign& bore = std::get<BoreOutline>(outline).bore;
    for (const BoreEdge& edge : bore_edges(bore)) {
      if (!edge.arc) {
        add(line_between(edge.from, edge.to));
        continue;
      }
      const double from = polar_angle_rad(edge.from);
      double angle = wrapped_rad(polar_angle_rad(edge.to) - from);
      if (angle == 0.0) angle = kTwoPi;
      add({CircularArc{Point2::Zero(), 0.5 * bore.diameter_mm}, from, from + angle});
    }
  }
  finish();
}

void OutlineDistance::add(const Curve& curve) {
  pieces_.push_back({curve, length_of(curve), turning_of(curve)});
  Form form;
  form.start = curve.start_point();
  form.end = curve.end_point();
  if (std::holds_alternative<RackTrochoid>(curve.shape) ||
      std::holds_alternative<CutterTrochoid>(curve.shape) ||
      std::holds_alternative<PointCurve>(curve.shape))
    form.spline.emplace(curve);
  form.low = form.high = form.start;
  for (int i = 1; i < kNodes; ++i) {
    const Point2 node = point_at(curve, parameter(curve, i / (kNodes - 1.0)));
    form.low = form.low.cwiseMin(node);
    form.high = form.high.cwiseMax(node);
  }
  // a curve bulges beyond its samples
  const double margin =
      1e-9 + pieces_.back().length_mm * std::min(0.1, pieces_.back().turning_rad / 8.0);
  form.low.array() -= margin;
  form.high.array() += margin;
  forms_.push_back(std::move(form));
}

void OutlineDistance::finish() {
  const std::size_t n = pieces_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Curve& curve = pieces_[i].curve;
    forms_[i].start_normal = normal_of(curve, curve.begin);
    forms_[i].end_normal = normal_of(curve, curve.end);
  }
  for (std::size_t i = 0; i < n; ++i) {
    Form& next = forms_[i + 1 < n ? i + 1 : 0];
    if (teeth_ > 0 && i + 1 == n) break;
    forms_[i].end_normal = next.start_normal = forms_[i].end_normal + next.start_normal;
  }
  if (teeth_ == 0) return;
  // beyond the middles of tooth and gap the mirror image goes on
  forms_.front().start_normal.y() = 0.0;
  const Point2 gap = unit_vector(kPi / teeth_);
  forms_.back().end_normal = gap * forms_.back().end_normal.dot(gap);
}

double OutlineDistance::lower_bound_mm(const Point2& point) const {
  const double r = (point - centre_).norm();
  return std::max({0.0, r - outer_radius_mm_, inner_radius_mm_ - r});
}

double OutlineDistance::lower_bound_mm(const OutlineDistance& other) const {
  const double apart = (other.centre_ - centre_).norm();
  return std::max({0.0, apart - outer_radius_mm_ - other.outer_radius_mm_,
                   inner_radius_mm_ - apart - other.outer_radius_mm_,
                   other.inner_radius_mm_ - apart - outer_radius_mm_});
}

Point2 OutlineDistance::to_outline(const Point2& on_piece, int copy) const {
  if (teeth_ == 0) return on_piece + centre_;
  return from_tooth(copy % 2 == 0 ? on_piece : mirrored(on_piece),
                    static_cast<std::size_t>(copy / 2));
}

Point2 OutlineDistance::from_tooth(const Point2& p, std::size_t tooth) const {
  const Point2& direction = directions_[tooth];
  return p.x() * direction + p.y() * perpendicular(direction);
}

void OutlineDistance::find_likely_teeth() {
  const std::size_t bins = kBinsPerTooth * directions_.size();
  for (std::size_t i = 0; i < bins; ++i) {
    const double turn = kDiamondTurn * (static_cast<double>(i) + 0.5) / static_cast<double>(bins);
    const double share = turn - std::floor(turn);
    Point2 there(1.0 - share, share);
    for (int quarter = 0; quarter < static_cast<int>(turn); ++quarter) there = perpendicular(there);
    likely_teeth_.push_back(nearest_direction(there));
  }
  if (teeth_ >= kLeastTeethLikely) sure_slope_ = std::tan(kSurePitch * kPi / teeth_);
}

std::size_t OutlineDistance::nearest_direction(const Point2& point) const {
  const double pitch = kTwoPi / teeth_;
  const double teeth_away = std::round(wrapped_rad(polar_angle_rad(point) - rotation_rad_) / pitch);
  return static_cast<std::size_t>(teeth_away) % directions_.size();
}

std::size_t OutlineDistance::tooth_at(const Point2& point) const {
  const auto bin = static_cast<std::size_t>(diamond_angle(point) / kDiamondTurn *
                                            static_cast<double>(likely_teeth_.size()));
  const std::size_t tooth = likely_teeth_[std::min(bin, likely_teeth_.size() - 1)];
  const Point2& direction = directions_[tooth];
  const bool sure = std::abs(cross(direction, point)) < sure_slope_ * direction.dot(point);
  return sure ? tooth : nearest_direction(point);
}

OutlineDistance::Folded OutlineDistance::folded(const Point2& point) const {
  if (teeth_ == 0) return {.place = point - centre_};
  const std::size_t tooth = tooth_at(point);
  const Point2& direction = directions_[tooth];
  const Point2 local(direction.dot(point), cross(direction, point));
  const bool below = local.y() < 0.0;
  return {below ? mirrored(local) : local, tooth, below};
}

OutlineFoot OutlineDistance::foot(const Folded& point) const {
  OutlineFoot result = foot_on_half_tooth(point.place);
  if (teeth_ == 0)
    result.point += centre_;
  else
    result.point = from_tooth(point.mirrored ? mirrored(result.point) : result.point, point.tooth);
  return result;
}

OutlineFoot OutlineDistance::foot_on_half_tooth(const Point2& point) const {
  std::size_t first = 0;  // most likely the nearest: the others will not be looked at
  double least_mm2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pieces_.size() && least_mm2 > 0.0; ++i)
    if (const double to_box = to_box_mm2(i, point); to_box < least_mm2)
      least_mm2 = to_box, first = i;
  OutlineFoot best = foot_on_piece(first, point, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (i == first || to_box_mm2(i, point) > best.distance_mm * best.distance_mm) continue;
    const OutlineFoot candidate = foot_on_piece(i, point, std::abs(best.distance_mm));
    if (std::abs(candidate.distance_mm) < std::abs(best.distance_mm)) best = candidate;
  }
  return best;
}

OutlineFoot OutlineDistance::foot_on_piece(std::size_t index, const Point2& point,
                                           double limit_mm) const {
  const Curve& curve = pieces_[index].curve;
  const Form& form = forms_[index];
  const auto signed_foot = [&](const Point2& at, const Point2& normal) {
    const Point2 away = point - at;
    return OutlineFoot{at, std::copysign(away.norm(), away.dot(normal))};
  };
  InnerFoot within;
  if (const auto* arc = std::get_if<CircularArc>(&curve.shape))
    within = inner_foot(*arc, curve, point);
  else if (const auto* line = std::get_if<StraightLine>(&curve.shape))
    within = inner_foot(*line, curve, point);
  else if (const auto* involute = std::get_if<Involute>(&curve.shape))
    within = inner_foot(*involute, curve, point);
  else if (const auto foot = form.spline->foot(point, limit_mm))
    within = {foot->point, foot->on_left ? -foot->distance_mm : foot->distance_mm};
  if (within) return *within;
  const bool start = (point - form.start).squaredNorm() < (point - form.end).squaredNorm();
  return start ? signed_foot(form.start, form.start_normal)
               : signed_foot(form.end, form.end_normal);
}

}  // namespace trueflank
