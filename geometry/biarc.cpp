// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/biarc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

constexpr int kSamples = 16;
constexpr int kDeepest = 24;  // halvings

double angle_between(const Point2& from, const Point2& to) {
  return std::atan2(cross(from, to), from.dot(to));
}

/// Two arcs from a to b with these unit tangents, meeting tangentially: of all such biarcs the one
/// whose two tangent lengths are equal. Source: the joint is the middle of a + d s and b - d t, and
/// |b - d t - (a + d s)| = 2 d.
std::array<ArcEdge, 2> biarc(const Point2& a, const Point2& s, const Point2& b, const Point2& t) {
  const Point2 v = b - a;
  const double across = v.dot(s + t), turned = 2.0 * (1.0 - s.dot(t));
  const double square = v.squaredNorm();
  // the root of turned d^2 + 2 across d - square that stays finite for turned -> 0
  const double d = square / (across + std::sqrt(across * across + turned * square));
  const Point2 joint = 0.5 * (a + b + d * (s - t));
  return {ArcEdge{a, std::tan(0.5 * angle_between(s, joint - a))},
          ArcEdge{joint, std::tan(0.5 * angle_between(b - joint, t))}};
}

class Fitter {
 public:
  Fitter(const PlaneCurve& curve, double tolerance_mm) : curve_(curve), tolerance_mm_(tolerance_mm) {}

  void fit(double from, double to, int depth) {
    const Point2 a = curve_.point(from), b = curve_.point(to);
    const std::array<ArcEdge, 2> arcs = biarc(a, curve_.tangent(from), b, curve_.tangent(to));
    const double worst = deviation(arcs, b, from, to);
    if (worst > tolerance_mm_ && depth < kDeepest) {
      const double middle = 0.5 * (from + to);
      fit(from, middle, depth + 1);
      fit(middle, to, depth + 1);
      return;
    }
    chain_.edges.insert(chain_.edges.end(), arcs.begin(), arcs.end());
    chain_.deviation_mm = std::max(chain_.deviation_mm, worst);
  }

  ArcChain take(double to) {
    chain_.end = curve_.point(to);
    return std::move(chain_);
  }

 private:
  /// Of samples of the curve from the arcs. Both run from end to end without turning back, so the
  /// other way round the distance is no larger but for second order.
  [[nodiscard]] double deviation(const std::array<ArcEdge, 2>& arcs, const Point2& b, double from,
                                 double to) const {
    double worst = 0.0;
    for (int i = 1; i < kSamples; ++i) {
      const Point2 p = curve_.point(from + (to - from) * i / kSamples);
      worst = std::max(worst, std::min(distance_mm(arcs[0], arcs[1].start, p),
                                       distance_mm(arcs[1], b, p)));
    }
    return worst;
  }

  const PlaneCurve& curve_;
  double tolerance_mm_;
  ArcChain chain_;
};

struct EdgeCircle {
  Point2 centre = Point2::Zero();
  double radius_mm = 0.0;
  double begin_rad = 0.0, angle_rad = 0.0;
};

EdgeCircle circle_of(const ArcEdge& edge, const Point2& end) {
  const double angle = 4.0 * std::atan(edge.bulge);
  const Point2 chord = end - edge.start;
  // from the chord's middle to the centre, to the left for a counter-clockwise arc
  const double offset = 0.25 * (1.0 / edge.bulge - edge.bulge);
  const Point2 centre = 0.5 * (edge.start + end) + offset * perpendicular(chord);
  return {centre, (edge.start - centre).norm(), polar_angle_rad(edge.start - centre), angle};
}

}  // namespace

ArcChain fit_arcs(const PlaneCurve& curve, double from, double to, double tolerance_mm) {
  TRUEFLANK_EXPECTS(tolerance_mm > 0.0);
  Fitter fitter(curve, tolerance_mm);
  fitter.fit(from, to, 0);
  return fitter.take(to);
}

double distance_mm(const ArcEdge& edge, const Point2& end, const Point2& point) {
  const Point2 chord = end - edge.start;
  const double length = chord.norm();
  if (length == 0.0) return (point - edge.start).norm();
  if (std::abs(edge.bulge) < 1e-9) {  // flat to a picometre for any chord below a metre
    const double along = std::clamp((point - edge.start).dot(chord) / (length * length), 0.0, 1.0);
    return (point - edge.start - along * chord).norm();
  }
  const EdgeCircle circle = circle_of(edge, end);
  const double turned = wrapped_rad(
      (edge.bulge > 0.0 ? 1.0 : -1.0) * (polar_angle_rad(point - circle.centre) - circle.begin_rad));
  if (turned <= std::abs(circle.angle_rad))
    return std::abs((point - circle.centre).norm() - circle.radius_mm);
  return std::min((point - edge.start).norm(), (point - end).norm());
}

Point2 point_on(const ArcEdge& edge, const Point2& end, double share) {
  if (std::abs(edge.bulge) < 1e-9) return edge.start + share * (end - edge.start);
  const EdgeCircle circle = circle_of(edge, end);
  return circle.centre +
         circle.radius_mm * unit_vector(circle.begin_rad + share * circle.angle_rad);
}

}  // namespace trueflank
