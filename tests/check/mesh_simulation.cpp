// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/check/mesh_simulation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trueflank::test {
namespace {

/// The half tooth that `point` gives for a piece and a parameter, from the tooth's middle.
template <class PointOf>
std::vector<Point2> half_tooth(const ToothProfile& profile, const PointOf& point) {
  const double module = profile.gear().normal_module_mm;
  std::vector<Point2> half;
  for (std::size_t k = 0; k < profile.pieces().size(); ++k) {
    const ProfilePiece& piece = profile.pieces()[k];
    const Curve& c = piece.curve;
    double length = 0.0;
    Point2 last = c.start_point();
    for (int i = 1; i <= 32; ++i) {
      const Point2 next = point_at(c, c.begin + (c.end - c.begin) * i / 32.0);
      length += (next - last).norm();
      last = next;
    }
    // 0.1 um of sag on a radius of 0.2 module needs 0.0126 module; long pieces are flatter
    const double spacing = piece.kind == PieceKind::kInvolute ? 0.02 : 0.012;
    const int n = std::max(8, static_cast<int>(std::ceil(length / (spacing * module))));
    for (int i = half.empty() ? 0 : 1; i <= n; ++i)
      half.push_back(point(k, c.begin + (c.end - c.begin) * i / n));
  }
  return half;
}

/// One whole tooth, from the middle of one gap to the middle of the next, and its edges by radius.
class ToothPolygon {
 public:
  explicit ToothPolygon(const ToothProfile& profile) : ToothPolygon(profile.gear()) {
    const auto half = half_tooth(
        profile, [&](std::size_t k, double t) { return point_at(profile.pieces()[k].curve, t); });
    set_points(half, half);
  }
  explicit ToothPolygon(const MadeSection& made) : ToothPolygon(made.toothing.profile->gear()) {
    const auto of_side = [&](int side) {
      return half_tooth(*made.toothing.profile, [&](std::size_t k, double t) {
        const Point2 p = section_point(made.toothing, {0, side, k, t}, made.z_mm);
        return side > 0 ? p : Point2(p.x(), -p.y());
      });
    };
    set_points(of_side(1), of_side(-1));
  }

  [[nodiscard]] double window() const { return 0.08 * module_; }
  [[nodiscard]] double slack() const { return 0.002 * module_; }  // far above rounding
  [[nodiscard]] const std::vector<Point2>& points() const { return points_; }
  /// Points next to each other, all within a radius of the one in their middle.
  struct Run {
    std::size_t first, middle, end;
    double radius;
  };
  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  [[nodiscard]] int teeth() const { return teeth_; }
  [[nodiscard]] double tip_reach() const { return external_ ? high_ : low_; }

  /// Whether everything within a radius of a point, `from_axis` from the gear's, lies farther than `least` beside all teeth.
  [[nodiscard]] bool passes_by(double from_axis, double radius, double least) const {
    const double beyond = radius + least + slack();
    return external_ ? from_axis > high_ + beyond : from_axis < low_ - beyond;
  }

  /// Signed distance of a point in the gear's frame, cut off at +- the window. What is farther out
  /// than `least` may be told as anything that is not less.
  [[nodiscard]] double signed_distance(const Point2& p, double least) const {
    const double r = p.norm();
    if (external_ ? r > high_ + least : r < low_ - least) return window();
    if (external_ ? r < low_ - window() : r > high_ + window()) return -window();
    Point2 own = in_frame_of(tooth_, p);
    if (!(own.x() > 0.0 && std::abs(own.y()) < own_slope_ * own.x())) {
      const auto tooth = static_cast<int>(std::round(std::atan2(p.y(), p.x()) * teeth_ / (2.0 * M_PI)));
      tooth_ = static_cast<std::size_t>((tooth + teeth_) % teeth_);
      own = in_frame_of(tooth_, p);
    }
    if (const double bound = bound_near(own); bound > least) return bound;
    return of_own_tooth(own, r);
  }

 private:
  [[nodiscard]] Point2 in_frame_of(std::size_t tooth, const Point2& p) const {
    const Point2& axis = axes_[tooth];
    return {axis.dot(p), axis.x() * p.y() - axis.y() * p.x()};
  }

  /// Signed distance of a point in the frame of this tooth, `r` from the axis, cut off at +- the
  /// window.
  [[nodiscard]] double of_own_tooth(const Point2& own, double r) const {
    const double x = own.x(), y = own.y();
    const auto cell_index = static_cast<std::size_t>(std::clamp(
        static_cast<int>(std::floor((r - low_) / cell())), 0, static_cast<int>(cells_.size()) - 1));
    double nearest = window() * window(), reach = square_of(window() + longest_);
    int crossings = 0;
    for (const Edge& edge : cells_[cell_index][y > 0.0 ? 1 : 0]) {
      const double dx = x - edge.ax, dy = y - edge.ay;
      // edges that the circle of radius r crosses between the tooth's middle and the point
      if ((edge.radius_a > r) != (edge.radius_b > r)) {
        const double v = (r - edge.radius_a) / (edge.radius_b - edge.radius_a);
        const double at_x = edge.ax + v * edge.ex, at_y = edge.ay + v * edge.ey;
        const double ahead = at_x * y - at_y * x;
        if (y > 0.0 ? at_y > 0.0 && ahead > 0.0 : at_y <= 0.0 && ahead < 0.0) ++crossings;
      }
      if (dx * dx + dy * dy > reach) continue;
      const double u = edge.square > 0.0
                           ? std::clamp((dx * edge.ex + dy * edge.ey) / edge.square, 0.0, 1.0)
                           : 0.0;
      const double ox = dx - u * edge.ex, oy = dy - u * edge.ey;
      if (const double square = ox * ox + oy * oy; square < nearest) {
        nearest = square;
        reach = square_of(std::sqrt(nearest) + longest_);
      }
    }
    // at the tooth's middle there is material up to the tip circle
    const bool middle_inside = external_ ? r < middle_radius() : r > middle_radius();
    const bool inside = (crossings % 2 == 0) == middle_inside;
    return inside ? -std::sqrt(nearest) : std::sqrt(nearest);
  }

  /// What no signed distance near a point is below: that of the middle of its square, less half a
  /// diagonal. Squares are filled when they are first asked for.
  [[nodiscard]] double bound_near(const Point2& own) const {
    const Point2 place = (own - corner_) / square();
    if (!(place.x() >= 0.0 && place.y() >= 0.0)) return -window();
    const auto column = static_cast<std::size_t>(place.x()),
               row = static_cast<std::size_t>(place.y());
    if (column >= columns_ || row >= rows_) return -window();
    double& bound = bounds_[row * columns_ + column];
    if (std::isnan(bound)) {
      const Point2 middle = corner_ + square() * Point2(static_cast<double>(column) + 0.5,
                                                        static_cast<double>(row) + 0.5);
      const double r = middle.norm();
      const double distance =
          r > high_ + window() || r < low_ - window() ? -window() : of_own_tooth(middle, r);
      bound = std::max(-window(), distance - std::sqrt(0.5) * square() - slack());
    }
    return bound;
  }

  explicit ToothPolygon(const Gear& gear)
      : teeth_(gear.teeth),
        external_(gear.kind == GearKind::kExternal),
        module_(gear.normal_module_mm) {
    if (teeth_ > 2) own_slope_ = (1.0 - 1e-9) * std::tan(M_PI / teeth_);
    for (int k = 0; k < teeth_; ++k)
      axes_.push_back({std::cos(2.0 * M_PI * k / teeth_), std::sin(2.0 * M_PI * k / teeth_)});
  }
  struct Edge {
    double ax, ay, ex, ey, square, radius_a, radius_b;
  };
  [[nodiscard]] static double square_of(double value) { return value * value; }

  /// Both halves counter-clockwise; the clockwise one is mirrored here.
  void set_points(const std::vector<Point2>& half, const std::vector<Point2>& clockwise) {
    for (auto p = clockwise.rbegin(); p != clockwise.rend(); ++p)
      points_.push_back({p->x(), -p->y()});
    for (std::size_t i = half.front().y() == 0.0 ? 1 : 0; i < half.size(); ++i)
      points_.push_back(half[i]);
    constexpr std::size_t kRun = 4;
    for (std::size_t first = 0; first < points_.size(); first += kRun) {
      Run run{first, 0, std::min(first + kRun, points_.size()), 0.0};
      run.middle = (run.first + run.end) / 2;
      for (std::size_t i = run.first; i < run.end; ++i)
        run.radius = std::max(run.radius, (points_[i] - points_[run.middle]).norm());
      runs_.push_back(run);
    }
    std::vector<double> radii;
    low_ = 1e300;
    for (const Point2& p : points_) {
      radii.push_back(p.norm());
      low_ = std::min(low_, radii.back());
      high_ = std::max(high_, radii.back());
    }
    const int count = static_cast<int>(std::ceil((high_ - low_) / cell())) + 1;
    cells_.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
      const Point2 along = points_[i + 1] - points_[i];
      const Edge edge{points_[i].x(),      points_[i].y(), along.x(),   along.y(),
                      along.squaredNorm(), radii[i],       radii[i + 1]};
      longest_ = std::max(longest_, along.norm());
      const double reach_low = std::min(radii[i], radii[i + 1]) - window() - low_;
      const double reach_high = std::max(radii[i], radii[i + 1]) + window() - low_;
      const int from = std::max(0, static_cast<int>(std::floor(reach_low / cell())));
      const int to = std::min(count - 1, static_cast<int>(std::floor(reach_high / cell())));
      const double y_low = std::min(points_[i].y(), points_[i + 1].y()), y_high = std::max(points_[i].y(), points_[i + 1].y());
      for (int k = from; k <= to; ++k) {
        std::array<std::vector<Edge>, 2>& sides = cells_[static_cast<std::size_t>(k)];
        if (y_low < window() + slack()) sides[0].push_back(edge);
        if (y_high > -window() - slack()) sides[1].push_back(edge);
      }
    }
    set_squares();
  }

  void set_squares() {
    const double half_width = std::sin(std::min(M_PI / teeth_, M_PI / 2)) * high_ + window();
    corner_ = {std::cos(std::min(M_PI / teeth_, M_PI / 2)) * low_ - window(), -half_width};
    columns_ = static_cast<std::size_t>((high_ + window() - corner_.x()) / square()) + 1;
    rows_ = static_cast<std::size_t>(2.0 * half_width / square()) + 1;
    bounds_.assign(columns_ * rows_, NAN);
  }

  [[nodiscard]] double square() const { return 0.015 * module_; }
  [[nodiscard]] double cell() const { return 0.04 * module_; }
  [[nodiscard]] double middle_radius() const { return external_ ? high_ : low_; }

  int teeth_;
  bool external_;
  double module_;
  std::vector<Point2> points_;
  std::vector<Run> runs_;
  std::vector<Point2> axes_;  // directions of the teeth
  mutable std::size_t tooth_ = 0;  // whose sector held the last point: mostly the next one's too
  double own_slope_ = 0.0;  // a sector's side to its middle, and a little less
  double low_ = 0.0, high_ = 0.0, longest_ = 0.0;
  /// By the radius; the edges that count for points at y <= 0, and for the others.
  std::vector<std::array<std::vector<Edge>, 2>> cells_;
  Point2 corner_ = Point2::Zero();  // of the squares
  std::size_t columns_ = 0, rows_ = 0;
  mutable std::vector<double> bounds_;
};

Point2 rotated_by(const Point2& p, double c, double s) { return {c * p.x() - s * p.y(), s * p.x() + c * p.y()}; }
Point2 turned_by(const Point2& p, double angle) { return rotated_by(p, std::cos(angle), std::sin(angle)); }

/// Vertices of `mover`, placed, against `mate`, placed; `best` where none is nearer than that.
double smallest(const ToothPolygon& mover, double mover_turn, const Point2& mover_axis,
                const ToothPolygon& mate, double mate_turn, const Point2& mate_axis,
                bool mate_is_ring, double best) {
  const double pitch = 2.0 * M_PI / mover.teeth();
  const double c2 = std::cos(-mate_turn), s2 = std::sin(-mate_turn);
  for (int k = 0; k < mover.teeth(); ++k) {
    // a tooth whose tip is nowhere near the mate's teeth is left out
    const double turn = mover_turn + pitch * k;
    const Point2 tip = mover_axis + turned_by({mover.tip_reach(), 0.0}, turn);
    const double away = (tip - mate_axis).norm();
    const double slack = 0.8 * pitch * mover.tip_reach() + mate.window();
    if (mate_is_ring ? away < mate.tip_reach() - slack : away > mate.tip_reach() + slack) continue;
    const double c = std::cos(turn), s = std::sin(turn);
    const auto distance_of = [&](std::size_t i, double least) {
      const Point2& p = mover.points()[i];
      const double x = mover_axis.x() + c * p.x() - s * p.y() - mate_axis.x();
      const double y = mover_axis.y() + s * p.x() + c * p.y() - mate_axis.y();
      return mate.signed_distance({c2 * x - s2 * y, s2 * x + c2 * y}, least);
    };
    for (const ToothPolygon::Run& run : mover.runs()) {
      const Point2 middle = mover_axis + rotated_by(mover.points()[run.middle], c, s) - mate_axis;
      if (mate.passes_by(middle.norm(), run.radius, best)) continue;
      // no distance differs from another by more than its point does
      const double beyond = best + run.radius + mate.slack();
      if (beyond < mate.window() && distance_of(run.middle, beyond) > beyond) continue;
      for (std::size_t i = run.first; i < run.end; ++i) best = std::min(best, distance_of(i, best));
    }
  }
  return best;
}

double both_ways(const ToothPolygon& gear1, double turn1, const ToothPolygon& gear2, double turn2,
                 const Point2& axis2, bool internal, double best) {
  const Point2 origin = Point2::Zero();
  best = smallest(gear1, turn1, origin, gear2, turn2, axis2, internal, best);
  return smallest(gear2, turn2, axis2, gear1, turn1, origin, false, best);
}

SimulatedClearance turned_through(const ToothPolygon& gear1, const ToothPolygon& gear2, double a,
                                  bool internal, double m, double gear2_turn) {
  const int z1 = gear1.teeth(), z2 = gear2.teeth();
  // relative travel of the far end of the engagement per turn of gear 1
  const double relative =
      internal ? 1.0 - static_cast<double>(z1) / z2 : 1.0 + static_cast<double>(z1) / z2;
  const double lever = internal ? gear1.tip_reach() : 3.0 * m + 0.3 * gear1.tip_reach();
  const double pitch = 2.0 * M_PI / z1;
  const int positions =
      std::clamp(static_cast<int>(std::ceil(pitch * relative * lever / (0.01 * m))), 60, 1500);
  SimulatedClearance result{gear1.window(), gear1.window()};
  for (int i = 0; i < positions; ++i) {
    const double turn1 = pitch * i / positions;
    // tooth 1 of gear 1 on the line of centres faces a gap of gear 2
    const double turn2 =
        (internal ? M_PI / z2 + turn1 * z1 / z2 : M_PI + M_PI / z2 - turn1 * z1 / z2) + gear2_turn;
    result.clearance_mm = both_ways(gear1, turn1, gear2, turn2, {internal ? -a : a, 0.0}, internal,
                                    result.clearance_mm);
  }
  return result;
}

}  // namespace

double simulate_position_mm(const GearPair& pair, double rotation1_rad, double rotation2_rad,
                            const Point2& axis2_mm) {
  const ToothPolygon gear1(*pair.profile1), gear2(*pair.profile2);
  return both_ways(gear1, rotation1_rad, gear2, rotation2_rad, axis2_mm, pair.internal(),
                   gear1.window());
}

double simulate_position_mm(const MadeSection& gear1, double rotation1_rad,
                            const MadeSection& gear2, double rotation2_rad,
                            const Point2& axis2_mm) {
  const bool internal = gear2.toothing.profile->gear().kind == GearKind::kInternal;
  const ToothPolygon first(gear1), second(gear2);
  return both_ways(first, rotation1_rad, second, rotation2_rad, axis2_mm, internal, first.window());
}

SimulatedClearance simulate_mesh(const GearPair& pair, double gear2_turn_rad) {
  return turned_through(ToothPolygon(*pair.profile1), ToothPolygon(*pair.profile2),
                        pair.centre_distance_mm, pair.internal(), pair.gear1().normal_module_mm,
                        gear2_turn_rad);
}

SimulatedClearance simulate_sections(const MadeSection& gear1, const MadeSection& gear2,
                                     double centre_distance_mm, double gear2_turn_rad) {
  const Gear& second = gear2.toothing.profile->gear();
  return turned_through(ToothPolygon(gear1), ToothPolygon(gear2), centre_distance_mm,
                        second.kind == GearKind::kInternal, second.normal_module_mm,
                        gear2_turn_rad);
}

}  // namespace trueflank::test
