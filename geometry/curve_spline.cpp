// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/curve_spline.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "trueflank/base/always_inline.h"
#include "trueflank/geometry/point2.h"

namespace trueflank {
namespace {

constexpr int kFewestPieces = 24, kMostPieces = 1024;

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

/// The nodes of a curve cut into n pieces at equal steps of its parameter, each computed when it is
/// first asked for.
class CurveSpline::Nodes {
 public:
  Nodes(const Curve& curve, int n)
      : curve_(curve), pieces_(n), step_((curve.end - curve.begin) / n), nodes_(static_cast<std::size_t>(n) + 1) {}

  /// How far the cubic of a piece is from the curve, at its middle; only across the curve counts.
  [[nodiscard]] double error_of(int piece) {
    const Node a = at(piece), b = at(piece + 1);
    const Cubic x(a.place.x(), b.place.x(), a.derivative.x(), b.derivative.x());
    const Cubic y(a.place.y(), b.place.y(), a.derivative.y(), b.derivative.y());
    const Point2 exact = point_at(curve_, curve_.begin + step_ * (piece + 0.5));
    const Point2 along = Point2(x.first(0.5), y.first(0.5)).normalized();
    return std::abs(cross(along, exact - Point2(x.at(0.5), y.at(0.5))));
  }
  /// A piece that is farther off than the limit, sought from one near a share of the way on: errors
  /// peak at the same place however many pieces there are.
  [[nodiscard]] std::optional<int> piece_beyond(double limit, double& share) {
    const int first = std::min(static_cast<int>(share * pieces_), pieces_ - 1);
    for (int i = 0; i < pieces_; ++i) {
      const int piece = (first + i) % pieces_;
      if (!(error_of(piece) >= limit)) continue;
      share = (piece + 0.5) / pieces_;
      return piece;
    }
    return std::nullopt;
  }
  void move_to(CurveSpline& spline) {
    for (int i = 0; i <= pieces_; ++i) {
      const Node& node = at(i);
      spline.x_.push_back(node.place.x());
      spline.y_.push_back(node.place.y());
      spline.dx_.push_back(node.derivative.x());
      spline.dy_.push_back(node.derivative.y());
    }
  }

 private:
  struct Node {
    Point2 place, derivative;
  };
  const Node& at(int i) {
    std::optional<Node>& node = nodes_[static_cast<std::size_t>(i)];
    if (node) return *node;
    const double h = 1e-3 * step_, t = curve_.begin + step_ * i;
    const Point2 derivative = (8.0 * (point_at(curve_, t + h) - point_at(curve_, t - h)) -
                               (point_at(curve_, t + 2.0 * h) - point_at(curve_, t - 2.0 * h))) *
                              (step_ / (12.0 * h));
    return node.emplace(Node{point_at(curve_, t), derivative});
  }

  const Curve& curve_;
  int pieces_;
  double step_;
  std::vector<std::optional<Node>> nodes_;
};

CurveSpline::CurveSpline(const Curve& curve, double error) {
  const double scale = (curve.end_point() - curve.start_point()).norm();
  double worst = 0.0;  // where on the curve the last cut was too coarse
  for (int n = kFewestPieces;; n *= 2) {
    Nodes nodes(curve, n);
    if (n < kMostPieces && nodes.piece_beyond(error * std::min(scale, 1.0), worst)) continue;
    nodes.move_to(*this);
    break;
  }
  const auto [low_x, high_x] = std::minmax_element(x_.begin(), x_.end());
  const auto [low_y, high_y] = std::minmax_element(y_.begin(), y_.end());
  keep_radii();
  for (std::size_t i = 1; i < x_.size(); ++i)
    longest_mm_ = std::max(longest_mm_, std::hypot(x_[i] - x_[i - 1], y_[i] - y_[i - 1]));
  low_x_ = *low_x, high_x_ = *high_x, low_y_ = *low_y, high_y_ = *high_y;
}

void CurveSpline::keep_radii() {
  for (std::size_t i = 0; i < x_.size(); ++i) radius_mm_.push_back(std::hypot(x_[i], y_[i]));
  if (radius_mm_.front() > radius_mm_.back())
    for (double& radius : radius_mm_) radius = -radius;
  const auto step = std::adjacent_find(radius_mm_.begin(), radius_mm_.end(), std::greater_equal<>());
  if (step != radius_mm_.end()) radius_mm_.clear();
}

/// Exact: a node whose radius differs from the point's by more than another's distance is farther.
TRUEFLANK_ALWAYS_INLINE inline std::size_t CurveSpline::nearest_node(const Point2& q) const {
  const auto square = [&](std::size_t i) {
    const double dx = x_[i] - q.x(), dy = y_[i] - q.y();
    return dx * dx + dy * dy;
  };
  const std::size_t n = x_.size();
  std::size_t node = 0;
  double nearest = std::numeric_limits<double>::infinity();
  if (radius_mm_.empty()) {
    for (std::size_t i = 0; i < n; ++i)
      if (const double s = square(i); s < nearest) nearest = s, node = i;
    return node;
  }
  const double radius = std::copysign(q.norm(), radius_mm_.back());
  const auto at = std::lower_bound(radius_mm_.begin(), radius_mm_.end(), radius);
  const auto above = static_cast<std::size_t>(at - radius_mm_.begin());
  const auto may_be_nearer = [&](std::size_t i) {
    return std::pow(radius_mm_[i] - radius, 2) < nearest;
  };
  for (std::size_t i = above; i < n && may_be_nearer(i); ++i)
    if (const double s = square(i); s < nearest) nearest = s, node = i;
  for (std::size_t i = above; i-- > 0 && may_be_nearer(i);)
    if (const double s = square(i); s < nearest) nearest = s, node = i;
  return node;
}

/// Squared distance from the box of the nodes.
TRUEFLANK_ALWAYS_INLINE inline double CurveSpline::square_to_box(const Point2& q) const {
  const double off_x = std::max({low_x_ - q.x(), q.x() - high_x_, 0.0});
  const double off_y = std::max({low_y_ - q.y(), q.y() - high_y_, 0.0});
  return off_x * off_x + off_y * off_y;
}

std::optional<CurveSpline::Foot> CurveSpline::foot(const Point2& q, double limit_mm) const {
  if (square_to_box(q) > limit_mm * limit_mm) return std::nullopt;
  return foot_beside(nearest_node(q), q, limit_mm);
}

CurveSpline::Search CurveSpline::search(const Point2& q, double limit_mm) const {
  const double off_square = square_to_box(q);
  // a piece bulges out of the box of its ends by less than it is long
  if (off_square > limit_mm * limit_mm) return {std::nullopt, std::sqrt(off_square) - longest_mm_};
  const std::size_t node = nearest_node(q);
  // every place of the curve is nearer to a node than its piece is long
  return {foot_beside(node, q, limit_mm),
          (q - Point2(x_[node], y_[node])).norm() - longest_mm_};
}

TRUEFLANK_ALWAYS_INLINE inline std::optional<CurveSpline::Foot> CurveSpline::foot_beside(
    std::size_t node, const Point2& q, double limit_mm) const {
  const std::size_t n = x_.size();
  // the distance falls towards the side of the node where the foot lies
  const double slope = (x_[node] - q.x()) * dx_[node] + (y_[node] - q.y()) * dy_[node];
  if ((slope < 0.0 && node + 1 == n) || (slope > 0.0 && node == 0)) return std::nullopt;
  const std::size_t k = slope < 0.0 ? node : std::max<std::size_t>(node, 1) - 1;
  const Cubic x(x_[k], x_[k + 1], dx_[k], dx_[k + 1]);
  const Cubic y(y_[k], y_[k + 1], dy_[k], dy_[k + 1]);
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
  const double distance = (q - foot).norm();
  if (!(distance < limit_mm)) return std::nullopt;
  const Point2 along(x.first(at), y.first(at));
  return Foot{foot, distance, cross(along, q - foot) > 0.0};
}

}  // namespace trueflank
