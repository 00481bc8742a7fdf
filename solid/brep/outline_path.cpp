// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/brep/outline_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/contract.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/spline_basis.h"
#include "trueflank/solid/brep/toothing_path.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

/// A piece of one tooth, tooth 1 on +x.
struct ToothPiece {
  PathPiece piece;
  /// Arcs about a centre of their own are a circle a tooth; else index of the shared circle.
  std::optional<PathCircle> own_circle;
};

PlaneSpline mirrored_backwards(PlaneSpline s) {
  std::reverse(s.poles.begin(), s.poles.end());
  for (Point2& pole : s.poles) pole = mirrored(pole);
  std::reverse(s.knots.begin(), s.knots.end());
  for (double& knot : s.knots) knot = 1.0 - knot;
  std::reverse(s.multiplicities.begin(), s.multiplicities.end());
  return s;
}

/// An arc that runs counter-clockwise. The rounding of a ring's tip runs the other way round its
/// centre, seen along the outline: a spline.
const CircularArc* as_arc(const ProfilePiece& piece) {
  if (piece.curve.end < piece.curve.begin) return nullptr;
  return std::get_if<CircularArc>(&piece.curve.shape);
}

/// Builds the pieces of tooth 1 from its half profile, then turns them into all teeth.
class ToothedPath {
 public:
  ToothedPath(const ToothedOutline& outline, const PathTolerance& tolerance)
      : outline_(outline), tolerance_(tolerance) {
    for (const ProfilePiece& piece : outline.profile->pieces())
      if ((piece.curve.end_point() - piece.curve.start_point()).norm() >= tolerance.shortest_mm)
        half_.push_back(piece);
    TRUEFLANK_EXPECTS(!half_.empty());
    gap_angle_rad_ = kPi / outline.profile->gear().teeth;
  }

  OutlinePath build() {
    find_joints();
    build_tooth();
    for (int tooth = 0; tooth < outline_.profile->gear().teeth; ++tooth) place_tooth(tooth);
    join();
    return std::move(path_);
  }

 private:
  bool centred_on(const ProfilePiece& piece, const Point2& direction) const {
    const CircularArc* arc = as_arc(piece);
    return arc && std::abs(cross(arc->centre, direction)) < tolerance::kCurve_mm;
  }

  /// Where the half profile's pieces meet. Where one between them was left out for its shortness, an
  /// arc keeps its end and a spline is led to it.
  void find_joints() {
    const std::size_t n = half_.size();
    const Point2 gap = unit_vector(gap_angle_rad_);
    tip_merged_ = centred_on(half_.front(), Point2::UnitX());
    gap_merged_ = centred_on(half_.back(), gap);
    joints_.resize(n + 1);
    joints_[0] = {half_.front().curve.start_point().x(), 0.0};
    for (std::size_t i = 1; i < n; ++i)
      joints_[i] = as_arc(half_[i - 1]) ? half_[i - 1].curve.end_point()
                                        : half_[i].curve.start_point();
    joints_[n] = half_.back().curve.end_point().dot(gap) * gap;
    for (std::size_t i = 0; i < n; ++i) {
      const Curve& curve = half_[i].curve;
      path_.fit_error_mm = std::max({path_.fit_error_mm, (curve.start_point() - joints_[i]).norm(),
                                     (curve.end_point() - joints_[i + 1]).norm()});
    }
  }

  void build_tooth() {
    const int n = static_cast<int>(half_.size());
    halves_.resize(half_.size());
    for (int i = 0; i < n; ++i) halves_[static_cast<std::size_t>(i)] = half_piece(i);
    const auto add_mirrored = [&](int i) {
      ToothPiece t = halves_[static_cast<std::size_t>(i)];
      t.piece.start = mirrored(joints_[static_cast<std::size_t>(i) + 1]);
      if (auto* spline = std::get_if<PathSpline>(&t.piece.shape))
        spline->spline = mirrored_backwards(std::move(spline->spline));
      if (t.own_circle) {
        t.own_circle->centre = mirrored(t.own_circle->centre);
        t.own_circle->reference_rad = -t.own_circle->reference_rad;
      }
      tooth_.push_back(std::move(t));
    };
    for (int i = n - 1 - (gap_merged_ ? 1 : 0); i >= (tip_merged_ ? 1 : 0); --i) add_mirrored(i);
    for (int i = 0; i < n; ++i) {
      ToothPiece t = halves_[static_cast<std::size_t>(i)];
      if (i == 0 && tip_merged_) t.piece.start = mirrored(joints_[1]);
      tooth_.push_back(std::move(t));
    }
  }

  ToothPiece half_piece(int index) {
    const ProfilePiece& source = half_[static_cast<std::size_t>(index)];
    const Curve& curve = source.curve;
    ToothPiece t;
    t.piece.start = joints_[static_cast<std::size_t>(index)];
    if (const CircularArc* arc = as_arc(source)) {
      t.piece.shape = PathArc{shared_circle(*arc, source.kind)};
      if (arc->centre != Point2::Zero())
        t.own_circle = {arc->centre, arc->radius_mm, 0.5 * (curve.begin + curve.end) + kPi};
    } else if (std::holds_alternative<StraightLine>(curve.shape)) {
      t.piece.shape = PathSegment{};
    } else {
      const bool flank = source.kind == PieceKind::kInvolute;
      BezierFit fit = fit_bezier(curve, flank ? tolerance_.flank_mm : tolerance_.fillet_mm);
      path_.fit_error_mm = std::max(path_.fit_error_mm, fit.error_mm);
      t.piece.shape = PathSpline{std::move(fit.spline)};
    }
    return t;
  }

  /// Tip and root circle are one circle for all teeth; their arcs leave gaps or teeth free.
  int shared_circle(const CircularArc& arc, PieceKind kind) {
    if (arc.centre != Point2::Zero()) return -1;
    const double free_rad = kind == PieceKind::kRoot ? 0.0 : gap_angle_rad_;
    path_.circles.push_back({arc.centre, arc.radius_mm, free_rad + outline_.rotation_rad});
    return static_cast<int>(path_.circles.size()) - 1;
  }

  void place_tooth(int tooth) {
    const int teeth = outline_.profile->gear().teeth;
    const double turn_rad = outline_.rotation_rad + kTwoPi * tooth / teeth;
    const Point2 e = unit_vector(turn_rad);
    const auto turned = [&](const Point2& p) -> Point2 {
      return {e.x() * p.x() - e.y() * p.y(), e.y() * p.x() + e.x() * p.y()};
    };
    for (const ToothPiece& t : tooth_) {
      PathPiece piece = t.piece;
      piece.start = turned(piece.start);
      if (auto* spline = std::get_if<PathSpline>(&piece.shape))
        for (Point2& pole : spline->spline.poles) pole = turned(pole);
      if (t.own_circle) {
        std::get<PathArc>(piece.shape).circle = static_cast<int>(path_.circles.size());
        path_.circles.push_back({turned(t.own_circle->centre), t.own_circle->radius_mm,
                                 t.own_circle->reference_rad + turn_rad});
      }
      path_.pieces.push_back(std::move(piece));
    }
  }

  /// Neighbours share their ends to the last bit.
  void join() {
    auto& pieces = path_.pieces;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (auto* spline = std::get_if<PathSpline>(&pieces[i].shape)) {
        spline->spline.poles.front() = pieces[i].start;
        spline->spline.poles.back() = pieces[(i + 1) % pieces.size()].start;
      }
  }

  const ToothedOutline& outline_;
  PathTolerance tolerance_;
  std::vector<ProfilePiece> half_;
  double gap_angle_rad_ = 0.0;
  bool tip_merged_ = false, gap_merged_ = false;
  std::vector<Point2> joints_;
  std::vector<ToothPiece> halves_, tooth_;
  OutlinePath path_;
};

OutlinePath path_of(const ToothedOutline& outline, const PathTolerance& tolerance) {
  TRUEFLANK_EXPECTS(outline.profile != nullptr);
  if (!is_plain(outline.toothing())) return toothing_path(outline, tolerance);
  ToothedOutline at_mid_face = outline;
  at_mid_face.rotation_rad += section_turn_rad(outline.twist, 0.5 * outline.twist.face_width_mm);
  return ToothedPath(at_mid_face, tolerance).build();
}

OutlinePath path_of(const CircleOutline& outline, const PathTolerance&) {
  const Point2 start = outline.centre + Point2(outline.radius_mm, 0.0);
  return {.circles = {{outline.centre, outline.radius_mm, 0.0}}, .pieces = {{start, PathArc{}}}};
}

OutlinePath path_of(const BoreOutline& outline, const PathTolerance& tolerance) {
  const BoreDesign& bore = outline.bore;
  const double radius = 0.5 * bore.diameter_mm;
  if (bore.kind == BoreKind::kRound) return path_of(CircleOutline{{0.0, 0.0}, radius}, tolerance);
  OutlinePath path;
  // keyway and flat are on +x: no arc passes there
  if (bore.kind != BoreKind::kHex) path.circles.push_back({Point2::Zero(), radius, 0.0});
  for (const BoreEdge& edge : bore_edges(bore)) {
    PathPiece piece{edge.from, PathSegment{}};
    if (edge.arc) piece.shape = PathArc{};
    path.pieces.push_back(std::move(piece));
  }
  return path;
}

/// A piece's start and points after it.
void append_points(const OutlinePath& path, std::size_t index, std::vector<Point2>& polygon) {
  const PathPiece& piece = path.pieces[index];
  const Point2 end = path.pieces[(index + 1) % path.pieces.size()].start;
  polygon.push_back(piece.start);
  if (const auto* spline = std::get_if<PathSpline>(&piece.shape)) {
    constexpr int kSteps = 32;
    const SplineBasis basis(spline->spline.degree, spline->spline.knots);
    for (int i = 1; i < kSteps; ++i)
      polygon.push_back(point_at(spline->spline, basis, static_cast<double>(i) / kSteps));
  } else if (const auto* arc = std::get_if<PathArc>(&piece.shape)) {
    const PathCircle& circle = path.circles[static_cast<std::size_t>(arc->circle)];
    const double from = polar_angle_rad(piece.start - circle.centre);
    double span = wrapped_rad(polar_angle_rad(end - circle.centre) - from);
    if (path.pieces.size() == 1) span = kTwoPi;
    const int steps = 2 + static_cast<int>(std::abs(span) * std::sqrt(circle.radius_mm / 1e-3));
    for (int i = 1; i < steps; ++i)
      polygon.push_back(circle.centre + circle.radius_mm * unit_vector(from + span * i / steps));
  }
}

}  // namespace

OutlinePath outline_path(const Outline& outline, const PathTolerance& tolerance) {
  return std::visit([&](const auto& o) { return path_of(o, tolerance); }, outline);
}

std::vector<Point2> path_polygon(const OutlinePath& path) {
  std::vector<Point2> polygon;
  for (std::size_t i = 0; i < path.pieces.size(); ++i) append_points(path, i, polygon);
  return polygon;
}

bool contains(const std::vector<Point2>& polygon, const Point2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 &a = polygon[j], &b = polygon[i];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

}  // namespace trueflank
