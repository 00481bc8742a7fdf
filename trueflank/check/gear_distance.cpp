// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/gear_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

constexpr double kSplineError = 1e-9;  // of the module

/// Value and derivatives of a cubic Hermite piece at s in [0, 1].
struct Cubic {
  double p0, d0, c2, c3;
  Cubic(double a, double b, double da, double db)
      : p0(a), d0(da), c2(3.0 * (b - a) - 2.0 * da - db), c3(2.0 * (a - b) + da + db) {}
  [[nodiscard]] double at(double s) const { return p0 + s * (d0 + s * (c2 + s * c3)); }
  [[nodiscard]] double first(double s) const { return d0 + s * (2.0 * c2 + 3.0 * s * c3); }
  [[nodiscard]] double second(double s) const { return 2.0 * c2 + 6.0 * s * c3; }
};

}  // namespace

GearDistance::GearDistance(const ToothProfile& profile)
    : pitch_rad_(kTwoPi / profile.gear().teeth),
      outward_(profile.gear().kind == GearKind::kExternal ? 1.0 : -1.0) {
  const auto& pieces = profile.pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Curve& curve = pieces[i].curve;
    const int index = static_cast<int>(i);
    if (const auto* arc = std::get_if<CircularArc>(&curve.shape)) {
      // run counter-clockwise, the circle's inside is on the left
      const double sign = (curve.end > curve.begin ? 1.0 : -1.0) * outward_;
      arcs_.push_back({arc->centre, arc->radius_mm, std::min(curve.begin, curve.end),
                       std::max(curve.begin, curve.end), sign, index});
    } else if (const auto* involute = std::get_if<Involute>(&curve.shape)) {
      flanks_.push_back({involute->base_radius_mm, involute->base_half_angle_rad,
                         static_cast<double>(involute->sense), std::min(curve.begin, curve.end),
                         std::max(curve.begin, curve.end), index});
    } else if (const auto* line = std::get_if<StraightLine>(&curve.shape)) {
      const double sign = curve.end > curve.begin ? 1.0 : -1.0;
      const double scale = line->direction.norm();
      lines_.push_back({point_at(curve, curve.begin), sign * line->direction / scale, 0.0,
                        std::abs(curve.end - curve.begin) * scale, index});
    } else {
      add_spline(curve, index);
    }
  }
  add_joints(profile);
}

void GearDistance::add_spline(const Curve& curve, int piece) {
  const double span = curve.end - curve.begin;
  const double scale = (curve.end_point() - curve.start_point()).norm();
  Spline s{};
  for (int n = 24;; n *= 2) {
    s = Spline{};
    s.piece = piece;
    const double step = span / n, h = 1e-3 * step;
    for (int i = 0; i <= n; ++i) {
      const double t = curve.begin + step * i;
      const Point2 p = point_at(curve, t);
      const Point2 d = (8.0 * (point_at(curve, t + h) - point_at(curve, t - h)) -
                        (point_at(curve, t + 2.0 * h) - point_at(curve, t - 2.0 * h))) *
                       (step / (12.0 * h));
      s.x.push_back(p.x());
      s.y.push_back(p.y());
      s.dx.push_back(d.x());
      s.dy.push_back(d.y());
    }
    double error = 0.0;
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Cubic x(s.x[k], s.x[k + 1], s.dx[k], s.dx[k + 1]);
      const Cubic y(s.y[k], s.y[k + 1], s.dy[k], s.dy[k + 1]);
      const Point2 exact = point_at(curve, curve.begin + step * (i + 0.5));
      // only the distance across the curve counts
      const Point2 along = Point2(x.first(0.5), y.first(0.5)).normalized();
      error = std::max(error, std::abs(cross(along, exact - Point2(x.at(0.5), y.at(0.5)))));
    }
    if (error < kSplineError * std::min(scale, 1.0) || n >= 1024) break;
  }
  const auto [low_x, high_x] = std::minmax_element(s.x.begin(), s.x.end());
  const auto [low_y, high_y] = std::minmax_element(s.y.begin(), s.y.end());
  s.low_x = *low_x, s.high_x = *high_x, s.low_y = *low_y, s.high_y = *high_y;
  splines_.push_back(std::move(s));
}

void GearDistance::add_joints(const ToothProfile& profile) {
  const auto& pieces = profile.pieces();
  const auto outward = [&](const ProfilePiece& piece, double parameter) -> Point2 {
    return -outward_ * perpendicular(tangent_at(piece.curve, parameter));
  };
  const Point2 gap = unit_vector(0.5 * pitch_rad_);
  const Point2 first = outward(pieces.front(), pieces.front().curve.begin);
  joints_.push_back({pieces.front().curve.start_point(), first + mirrored(first), 0});
  for (std::size_t i = 1; i < pieces.size(); ++i)
    joints_.push_back({pieces[i].curve.start_point(),
                       outward(pieces[i - 1], pieces[i - 1].curve.end) +
                           outward(pieces[i], pieces[i].curve.begin),
                       static_cast<int>(i)});
  const Point2 last = outward(pieces.back(), pieces.back().curve.end);
  const Point2 image = 2.0 * last.dot(gap) * gap - last;
  joints_.push_back(
      {pieces.back().curve.end_point(), last + image, static_cast<int>(pieces.size()) - 1});
}

GearDistance::Nearest GearDistance::nearest(const Point2& point) const {
  const double r = point.norm();
  double phi = std::atan2(point.y(), point.x());
  phi -= pitch_rad_ * std::nearbyint(phi / pitch_rad_);
  const bool clockwise = phi < 0.0;
  phi = std::abs(phi);
  const Point2 q(r * std::cos(phi), r * std::sin(phi));

  Best best{std::numeric_limits<double>::infinity(), 0.0, -1, Point2::Zero()};
  for (const Flank& flank : flanks_) measure_flank(flank, r, phi, best);
  for (const Arc& arc : arcs_) measure_arc(arc, q, best);
  for (const Line& line : lines_) measure_line(line, q, best);
  for (const Spline& spline : splines_) measure_spline(spline, q, best);
  for (const Joint& joint : joints_) {
    const Point2 away = q - joint.at;
    const double square = away.squaredNorm();
    // a joint within rounding of a foot on a piece leaves the piece its better sign
    if (!(square < best.magnitude * best.magnitude * (1.0 - 1e-9))) continue;
    const double distance = std::sqrt(square);
    best = {distance, away.dot(joint.outward) < 0.0 ? -distance : distance, joint.piece, joint.at,
            true};
  }
  return {best.signed_mm, best.piece, best.corner, clockwise, best.point};
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

void GearDistance::measure_flank(const Flank& flank, double r, double phi, Best& best) const {
  const double r_b = flank.base_radius;
  if (r < r_b) return;
  // the normal through the point touches the base circle at tau
  const double length = std::sqrt((r - r_b) * (r + r_b));
  const double tau = phi + flank.sense * std::atan2(length, r_b);
  const double roll = flank.sense * (tau - flank.half_angle);
  if (roll < flank.from || roll > flank.to) return;
  const double beyond = -flank.sense * (length - r_b * roll);
  const double distance = std::abs(beyond);
  if (!(distance < best.magnitude)) return;
  const Point2 e = unit_vector(tau);
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

void GearDistance::measure_spline(const Spline& s, const Point2& q, Best& best) const {
  const double off_x = std::max({s.low_x - q.x(), q.x() - s.high_x, 0.0});
  const double off_y = std::max({s.low_y - q.y(), q.y() - s.high_y, 0.0});
  if (off_x * off_x + off_y * off_y > best.magnitude * best.magnitude) return;
  const std::size_t n = s.x.size();
  std::size_t node = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = s.x[i] - q.x(), dy = s.y[i] - q.y();
    const double square = dx * dx + dy * dy;
    if (square < nearest) nearest = square, node = i;
  }
  // the distance falls towards the side of the node where the foot lies
  const double slope = (s.x[node] - q.x()) * s.dx[node] + (s.y[node] - q.y()) * s.dy[node];
  if ((slope < 0.0 && node + 1 == n) || (slope > 0.0 && node == 0)) return;
  const std::size_t k = slope < 0.0 ? node : std::max<std::size_t>(node, 1) - 1;
  const Cubic x(s.x[k], s.x[k + 1], s.dx[k], s.dx[k + 1]);
  const Cubic y(s.y[k], s.y[k + 1], s.dy[k], s.dy[k + 1]);
  double low = 0.0, high = 1.0, at = slope < 0.0 ? 0.1 : 0.9;
  for (int i = 0; i < 20; ++i) {
    const double ax = x.at(at) - q.x(), ay = y.at(at) - q.y();
    const double fx = x.first(at), fy = y.first(at);
    const double g = ax * fx + ay * fy;
    (g > 0.0 ? high : low) = at;
    const double bend = fx * fx + fy * fy + ax * x.second(at) + ay * y.second(at);
    double next = bend > 0.0 ? at - g / bend : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool done = std::abs(next - at) < 1e-9;
    at = next;
    if (done) break;
  }
  const Point2 foot(x.at(at), y.at(at));
  const Point2 along(x.first(at), y.first(at));
  const double distance = (q - foot).norm();
  if (!(distance < best.magnitude)) return;
  const double left = cross(along, q - foot);
  best = {distance, outward_ * left > 0.0 ? -distance : distance, s.piece, foot};
}

}  // namespace trueflank
