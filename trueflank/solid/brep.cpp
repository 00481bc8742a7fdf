// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines that go on through several slabs are one wall, so that a flank stays one face. Where
// slabs differ, the ends of walls bound the steps between them: the points of one section alone.
#include "trueflank/solid/brep.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/solid/outline_loop.h"

namespace trueflank {
namespace {

Point3 at_height(const Point2& p, double z_mm) { return {p.x(), p.y(), z_mm}; }

/// An outline from the slab it starts in to the one it ends with.
struct Wall {
  const Outline* outline = nullptr;
  bool outer = true;  ///< bounds the material from outside
  std::size_t first_slab = 0, last_slab = 0;
  OutlinePath path;
  std::vector<OrientedEdge> lower, upper;  ///< along the path
};

std::vector<Wall> walls_of(const PartShape& part, const PathTolerance& tolerance) {
  std::vector<Wall> walls;
  const auto add = [&](const Outline& outline, bool outer, std::size_t slab) {
    for (Wall& wall : walls)
      if (wall.last_slab + 1 == slab && wall.outer == outer && same_outline(*wall.outline, outline)) {
        wall.last_slab = slab;
        return;
      }
    walls.push_back({.outline = &outline, .outer = outer, .first_slab = slab, .last_slab = slab,
                     .path = outline_path(outline, tolerance), .lower = {}, .upper = {}});
  };
  for (std::size_t i = 0; i < part.slabs.size(); ++i) {
    add(part.slabs[i].outer, true, i);
    for (const Outline& hole : part.slabs[i].holes) add(hole, false, i);
  }
  return walls;
}

template <class T>
int add_to(std::vector<T>& list, T item) {
  list.push_back(std::move(item));
  return static_cast<int>(list.size()) - 1;
}

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
    const auto back = [](OrientedEdge e) { return OrientedEdge{e.edge, !e.forward}; };
    if (wall_.outer)
      face.loops = {{lower, up_next, back(upper), back(up_here)}};
    else
      face.loops = {{up_here, upper, back(up_next), back(lower)}};
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

/// End of a wall at one height, where it bounds a flat face.
struct WallEnd {
  const Wall* wall = nullptr;
  bool above = false;  ///< the wall stands on this height, else it ends here
  OutlineExtent extent = {};
  std::vector<Point2> polygon = {};      ///< made where the extents do not tell
  std::vector<std::size_t> inside = {};  ///< other ends that contain this one
};

bool is_circle(const WallEnd& end) { return end.wall->path.pieces.size() == 1; }

/// What is known from the circles about the axis between which two ends lie.
enum class Nesting { kInside, kApart, kUnknown };
Nesting nesting_by_radii(const WallEnd& inner, const WallEnd& outer) {
  const double inner_off = inner.extent.centre.norm(), outer_off = outer.extent.centre.norm();
  const double nearest = std::max(inner_off - inner.extent.outer_radius_mm,
                                  inner.extent.inner_radius_mm - inner_off);
  if (nearest > outer_off + outer.extent.outer_radius_mm) return Nesting::kApart;
  if (inner_off + inner.extent.outer_radius_mm < outer.extent.inner_radius_mm - outer_off)
    return Nesting::kInside;
  return Nesting::kUnknown;
}

/// How many of the inner polygon's points the outer end contains. The polygon's vertices are on the
/// path and the paths do not touch, so all or none, or they cross.
std::size_t points_within(const WallEnd& inner, const WallEnd& outer) {
  const auto within = [&](const Point2& p) {
    if (!is_circle(outer)) return contains(outer.polygon, p);
    const PathCircle& circle = outer.wall->path.circles.front();
    return (p - circle.centre).norm() < circle.radius_mm;
  };
  return static_cast<std::size_t>(
      std::count_if(inner.polygon.begin(), inner.polygon.end(), within));
}

Status find_nesting(std::vector<WallEnd>& ends, const PartShape& part) {
  for (WallEnd& end : ends) end.extent = extent(*end.wall->outline);
  const auto make_polygon = [](WallEnd& end) {
    if (end.polygon.empty()) end.polygon = path_polygon(end.wall->path);
  };
  for (WallEnd& inner : ends)
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (&ends[k] == &inner) continue;
      const Nesting nesting = nesting_by_radii(inner, ends[k]);
      if (nesting == Nesting::kInside) inner.inside.push_back(k);
      if (nesting != Nesting::kUnknown) continue;
      make_polygon(inner);
      if (!is_circle(ends[k])) make_polygon(ends[k]);
      const std::size_t count = points_within(inner, ends[k]);
      if (count == inner.polygon.size()) inner.inside.push_back(k);
      if (count != 0 && count != inner.polygon.size())
        return fail({.code = ErrorCode::kUnsupported,
                     .message = "part " + part.name +
                                ": the outlines of two layers cross where they meet",
                     .key = part.name,
                     .remedy = "a neck between the layers that is smaller than both"});
    }
  return {};
}

/// The flat faces at one height. A point belongs to a face where an odd number of ends contain it
/// (in one section, not in the other); ends nested evenly deep are outer boundaries.
Status add_flat_faces(Brep& brep, std::vector<WallEnd> ends, double z_mm, const PartShape& part) {
  if (auto ok = find_nesting(ends, part); !ok) return ok;
  const auto loop_of = [](const WallEnd& end, bool along) {
    BrepLoop loop = end.above ? end.wall->lower : end.wall->upper;
    if (along) return loop;
    std::reverse(loop.begin(), loop.end());
    for (OrientedEdge& e : loop) e.forward = !e.forward;
    return loop;
  };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].inside.size() % 2 != 0) continue;
    // just inside: in the material of the wall's own slab, or of the other one
    const bool material_above = ends[i].wall->outer == ends[i].above;
    const Frame3 frame{{0.0, 0.0, z_mm},
                       material_above ? Point3(-Point3::UnitZ()) : Point3::UnitZ(),
                       Point3::UnitX()};
    BrepFace face;
    face.surface = add_to<BrepSurface>(brep.surfaces, PlaneSurface{frame});
    face.loops.push_back(loop_of(ends[i], !material_above));
    for (const WallEnd& hole : ends)
      if (hole.inside.size() == ends[i].inside.size() + 1 &&
          std::find(hole.inside.begin(), hole.inside.end(), i) != hole.inside.end())
        face.loops.push_back(loop_of(hole, material_above));
    brep.faces.push_back(std::move(face));
  }
  return {};
}

}  // namespace

Result<Brep> brep_of(const PartShape& part, const PathTolerance& tolerance) {
  TRUEFLANK_EXPECTS(!part.slabs.empty());
  for (std::size_t i = 0; i < part.slabs.size(); ++i) {
    TRUEFLANK_EXPECTS(part.slabs[i].z_upper_mm > part.slabs[i].z_lower_mm);
    TRUEFLANK_EXPECTS(i == 0 || part.slabs[i].z_lower_mm == part.slabs[i - 1].z_upper_mm);
  }
  Brep brep;
  std::vector<Wall> walls = walls_of(part, tolerance);
  for (Wall& wall : walls)
    WallBuilder(brep, wall, part.slabs[wall.first_slab].z_lower_mm,
                part.slabs[wall.last_slab].z_upper_mm)
        .build();
  for (std::size_t level = 0; level <= part.slabs.size(); ++level) {
    std::vector<WallEnd> ends;
    for (const Wall& wall : walls) {
      if (wall.first_slab == level) ends.push_back({.wall = &wall, .above = true});
      if (wall.last_slab + 1 == level) ends.push_back({.wall = &wall, .above = false});
    }
    const double z_mm =
        level == 0 ? part.slabs.front().z_lower_mm : part.slabs[level - 1].z_upper_mm;
    if (auto ok = add_flat_faces(brep, std::move(ends), z_mm, part); !ok) return fail(ok.error());
  }
  return brep;
}

bool is_closed(const Brep& brep) {
  std::vector<int> forward(brep.edges.size(), 0), backward(brep.edges.size(), 0);
  const auto end_of = [&](const OrientedEdge& e, bool last) {
    const BrepEdge& edge = brep.edges[static_cast<std::size_t>(e.edge)];
    return e.forward == last ? edge.end : edge.start;
  };
  long loops = 0;
  for (const BrepFace& face : brep.faces)
    for (const BrepLoop& loop : face.loops) {
      ++loops;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        if (end_of(loop[i], true) != end_of(loop[(i + 1) % loop.size()], false)) return false;
        ++(loop[i].forward ? forward : backward)[static_cast<std::size_t>(loop[i].edge)];
      }
    }
  const auto once = [](int count) { return count == 1; };
  // V - E + F - (inner loops) = 2 (shells - handles)
  const long euler = static_cast<long>(brep.vertices.size()) -
                     static_cast<long>(brep.edges.size()) +
                     2 * static_cast<long>(brep.faces.size()) - loops;
  return std::all_of(forward.begin(), forward.end(), once) &&
         std::all_of(backward.begin(), backward.end(), once) && euler % 2 == 0;
}

}  // namespace trueflank
