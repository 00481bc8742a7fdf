// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/brep/brep_wall.h"

#include <algorithm>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/brep/tooth_columns.h"
#include "trueflank/solid/brep/toothing_path.h"

namespace trueflank {
namespace {

class WallBuilder {
 public:
  WallBuilder(Brep& brep, Wall& wall, double z_lower_mm, double z_upper_mm)
      : brep_(brep), wall_(wall), path_(wall.path), z_lower_mm_(z_lower_mm),
        z_upper_mm_(z_upper_mm) {}

  void build() {
    brep_.fit_error_mm = std::max(brep_.fit_error_mm, path_.fit_error_mm);
    add_cylinders();
    add_uprights();
    for (std::size_t i = 0; i < path_.pieces.size(); ++i) {
      add_end_edges(i);
      add_face(i);
    }
  }

 private:
  std::size_t next(std::size_t i) const { return (i + 1) % path_.pieces.size(); }

  void add_cylinders() {
    for (const PathCircle& c : path_.circles) {
      const Point3 reference = at_height(unit_vector(c.reference_rad), 0.0);
      const Frame3 lower{at_height(c.centre, z_lower_mm_), Point3::UnitZ(), reference};
      const Frame3 upper{at_height(c.centre, z_upper_mm_), Point3::UnitZ(), reference};
      lower_circles_.push_back(add_to<BrepCurve>(brep_.curves, CircleCurve{lower, c.radius_mm}));
      upper_circles_.push_back(add_to<BrepCurve>(brep_.curves, CircleCurve{upper, c.radius_mm}));
      cylinders_.push_back(add_to<BrepSurface>(brep_.surfaces, CylinderSurface{lower, c.radius_mm}));
    }
  }

  /// Vertices, and the straight edges that rise from one to the other.
  void add_uprights() {
    for (const PathPiece& piece : path_.pieces) {
      const Point3 low = at_height(piece.start, z_lower_mm_);
      lower_vertices_.push_back(add_to(brep_.vertices, low));
      upper_vertices_.push_back(add_to(brep_.vertices, at_height(piece.start, z_upper_mm_)));
      const int line = add_to<BrepCurve>(brep_.curves, LineCurve{low, Point3::UnitZ()});
      uprights_.push_back(
          add_to(brep_.edges, BrepEdge{lower_vertices_.back(), upper_vertices_.back(), line}));
    }
  }

  int add_curve(std::size_t i, double z_mm) {
    const PathPiece& piece = path_.pieces[i];
    if (const auto* s = std::get_if<PathSpline>(&piece.shape)) {
      SplineCurve curve{.degree = s->spline.degree, .poles = {}, .knots = s->spline.knots,
                        .multiplicities = s->spline.multiplicities};
      for (const Point2& pole : s->spline.poles) curve.poles.push_back(at_height(pole, z_mm));
      return add_to<BrepCurve>(brep_.curves, std::move(curve));
    }
    const Point2 along = path_.pieces[next(i)].start - piece.start;
    return add_to<BrepCurve>(
        brep_.curves, LineCurve{at_height(piece.start, z_mm), at_height(along.normalized(), 0.0)});
  }

  void add_end_edges(std::size_t i) {
    const auto* arc = std::get_if<PathArc>(&path_.pieces[i].shape);
    const auto add = [&](const std::vector<int>& vertices, const std::vector<int>& circles,
                         double z_mm) -> OrientedEdge {
      const int curve = arc ? circles[static_cast<std::size_t>(arc->circle)] : add_curve(i, z_mm);
      return {add_to(brep_.edges, BrepEdge{vertices[i], vertices[next(i)], curve}), true};
    };
    wall_.lower.push_back(add(lower_vertices_, lower_circles_, z_lower_mm_));
    wall_.upper.push_back(add(upper_vertices_, upper_circles_, z_upper_mm_));
  }

  void add_face(std::size_t i) {
    BrepFace face;
    if (const auto* arc = std::get_if<PathArc>(&path_.pieces[i].shape)) {
      face.surface = cylinders_[static_cast<std::size_t>(arc->circle)];
      face.same_sense = wall_.outer;
    } else if (std::holds_alternative<PathSpline>(path_.pieces[i].shape)) {
      const int curve = brep_.edges[static_cast<std::size_t>(wall_.lower[i].edge)].curve;
      face.surface =
          add_to<BrepSurface>(brep_.surfaces, ExtrusionSurface{curve, Point3::UnitZ()});
      face.same_sense = wall_.outer;
    } else {
      face.surface = add_to<BrepSurface>(brep_.surfaces, PlaneSurface{side_plane(i)});
    }
    const OrientedEdge lower = wall_.lower[i], upper = wall_.upper[i];
    const OrientedEdge up_here{uprights_[i], true}, up_next{uprights_[next(i)], true};
    face.loops = {wall_face_loop(wall_.outer, lower, up_next, upper, up_here)};
    brep_.faces.push_back(std::move(face));
  }

  Frame3 side_plane(std::size_t i) const {
    const Point2 along = (path_.pieces[next(i)].start - path_.pieces[i].start).normalized();
    const Point2 outward = wall_.outer ? Point2(-perpendicular(along)) : perpendicular(along);
    return {at_height(path_.pieces[i].start, z_lower_mm_), at_height(outward, 0.0),
            at_height(along, 0.0)};
  }

  Brep& brep_;
  Wall& wall_;
  const OutlinePath& path_;
  double z_lower_mm_, z_upper_mm_;
  std::vector<int> lower_circles_, upper_circles_, cylinders_;
  std::vector<int> lower_vertices_, upper_vertices_, uprights_;
};

}  // namespace

bool is_prismatic(const Outline& outline) {
  const auto* toothed = std::get_if<ToothedOutline>(&outline);
  return toothed == nullptr || toothed->toothing().prismatic();
}

Error too_rough(double error_mm) {
  return {.code = ErrorCode::kUnsupported,
          .message = "the tooth surface bends more than splines of 64 spans follow: " +
                     trimmed_number(um_from_mm(error_mm)) + " um off",
          .remedy = "a mesh format, or a smoother deviation"};
}

Status check_wall(const Wall& wall, const PathTolerance& tolerance) {
  const auto* toothed = std::get_if<ToothedOutline>(wall.outline);
  if (toothed == nullptr || is_plain(toothed->toothing())) return {};
  if (auto ok = ToothColumns(toothed->toothing(), tolerance.shortest_mm).check(); !ok) return ok;
  if (!(wall.path.fit_error_mm <= kSurfaceContract_mm)) return fail(too_rough(wall.path.fit_error_mm));
  return {};
}

void add_prismatic_wall(Brep& brep, Wall& wall, double z_lower_mm, double z_upper_mm) {
  WallBuilder(brep, wall, z_lower_mm, z_upper_mm).build();
}

BrepLoop wall_face_loop(bool outer, OrientedEdge lower, OrientedEdge up_next, OrientedEdge upper,
                        OrientedEdge up_here) {
  if (outer) return {lower, up_next, reversed(upper), reversed(up_here)};
  return {up_here, upper, reversed(up_next), reversed(lower)};
}

}  // namespace trueflank
