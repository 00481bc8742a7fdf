// SPDX-License-Identifier: GPL-3.0-or-later
//
// Outlines that go on through several slabs are one wall, so that a flank stays one face. Where
// slabs differ, the ends of walls bound the steps between them: the points of one section alone.
#include "trueflank/solid/brep/brep.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/spline_basis.h"
#include "trueflank/solid/brep/brep_wall.h"
#include "trueflank/solid/shape/bed_chamfer.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

std::vector<Wall> walls_of(const PartShape& part, const PathTolerance& tolerance) {
  std::vector<Wall> walls;
  const auto add = [&](const Outline& outline, bool outer, std::size_t slab) {
    for (Wall& wall : walls)
      if (wall.last_slab + 1 == slab && wall.outer == outer && same_outline(*wall.outline, outline)) {
        wall.last_slab = slab;
        return;
      }
    walls.push_back({.outline = &outline, .outer = outer, .first_slab = slab, .last_slab = slab});
    if (is_prismatic(outline)) walls.back().path = outline_path(outline, tolerance);
  };
  for (std::size_t i = 0; i < part.slabs.size(); ++i) {
    add(part.slabs[i].outer, true, i);
    for (const Outline& hole : part.slabs[i].holes) add(hole, false, i);
  }
  return walls;
}

/// End of a wall at one height, where it bounds a flat face.
struct WallEnd {
  const Wall* wall = nullptr;
  bool above = false;  ///< the wall stands on this height, else it ends here
  OutlineExtent extent = {};
  std::vector<Point2> polygon = {};      ///< made where the extents do not tell
  std::vector<std::size_t> inside = {};  ///< other ends that contain this one
};

bool is_circle(const WallEnd& end) { return end.wall->path.pieces.size() == 1; }

/// What is known from the circles about the ends' own centres between which they lie.
enum class Nesting { kInside, kApart, kUnknown };
Nesting nesting_by_radii(const OutlineExtent& inner, const OutlineExtent& outer) {
  const double off_mm = (inner.centre - outer.centre).norm();
  if (off_mm > inner.outer_radius_mm + outer.outer_radius_mm ||
      off_mm + outer.outer_radius_mm < inner.inner_radius_mm)
    return Nesting::kApart;
  return off_mm + inner.outer_radius_mm < outer.inner_radius_mm ? Nesting::kInside : Nesting::kUnknown;
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

/// A polygon through the edges of a toothed wall's end; see path_polygon.
std::vector<Point2> loop_polygon(const Brep& brep, const BrepLoop& loop) {
  std::vector<Point2> polygon;
  for (const OrientedEdge& oriented : loop) {
    const BrepEdge& edge = brep.edges[static_cast<std::size_t>(oriented.edge)];
    const Point2 start = brep.vertices[static_cast<std::size_t>(edge.start)].head<2>();
    const Point2 end = brep.vertices[static_cast<std::size_t>(edge.end)].head<2>();
    const BrepCurve& curve = brep.curves[static_cast<std::size_t>(edge.curve)];
    polygon.push_back(start);
    constexpr int kSteps = 32;
    if (const auto* spline = std::get_if<SplineCurve>(&curve)) {
      const SplineBasis basis(spline->degree, spline->knots);
      for (int i = 1; i < kSteps; ++i) {
        const BasisWeights w = basis.at(static_cast<double>(i) / kSteps);
        Point3 sum = Point3::Zero();
        for (int j = 0; j <= spline->degree; ++j)
          sum += w.weight[static_cast<std::size_t>(j)] *
                 spline->poles[static_cast<std::size_t>(w.first + j)];
        polygon.emplace_back(sum.head<2>());
      }
    } else {
      const double radius = start.norm(), from = polar_angle_rad(start);
      const double span = wrapped_rad(polar_angle_rad(end) - from);
      for (int i = 1; i < kSteps; ++i)
        polygon.emplace_back(radius * unit_vector(from + span * i / kSteps));
    }
  }
  return polygon;
}

Status find_nesting(const Brep& brep, std::vector<WallEnd>& ends, const PartShape& part) {
  for (WallEnd& end : ends) end.extent = extent(*end.wall->outline);
  const auto make_polygon = [&](WallEnd& end) {
    if (!end.polygon.empty()) return;
    end.polygon = is_prismatic(*end.wall->outline)
                      ? path_polygon(end.wall->path)
                      : loop_polygon(brep, end.above ? end.wall->lower : end.wall->upper);
  };
  for (WallEnd& inner : ends)
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (&ends[k] == &inner) continue;
      const Nesting nesting = nesting_by_radii(inner.extent, ends[k].extent);
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
  if (auto ok = find_nesting(brep, ends, part); !ok) return ok;
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
  if (bed_depth_mm(part) > 0.0)
    return fail({.code = ErrorCode::kUnsupported,
                 .message = "part " + part.name + ": its chamfer at the bed of a printer is no B-rep",
                 .key = part.name,
                 .remedy = "a mesh format"});
  TRUEFLANK_EXPECTS(!part.slabs.empty());
  for (std::size_t i = 0; i < part.slabs.size(); ++i) {
    TRUEFLANK_EXPECTS(part.slabs[i].z_upper_mm > part.slabs[i].z_lower_mm);
    TRUEFLANK_EXPECTS(i == 0 || part.slabs[i].z_lower_mm == part.slabs[i - 1].z_upper_mm);
  }
  Brep brep;
  std::vector<Wall> walls = walls_of(part, tolerance);
  for (Wall& wall : walls) {
    const double z_lower_mm = part.slabs[wall.first_slab].z_lower_mm;
    const double z_upper_mm = part.slabs[wall.last_slab].z_upper_mm;
    auto ok = check_wall(wall, tolerance);
    if (ok && is_prismatic(*wall.outline)) add_prismatic_wall(brep, wall, z_lower_mm, z_upper_mm);
    else if (ok) ok = add_toothed_wall(brep, wall, z_lower_mm, z_upper_mm, tolerance);
    if (!ok) {
      Error error = ok.error();
      error.message = "part " + part.name + ": " + error.message;
      error.key = part.name;
      return fail(std::move(error));
    }
  }
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
