// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curves, edges, surfaces and faces of one solid. Points, directions and circles that are the same
// are one entity: that is a third of the file.
#include <algorithm>
#include <array>
#include <map>

#include "trueflank/base/contract.h"
#include "trueflank/export/step/step_entities.h"

namespace trueflank::io {
namespace {

class SolidWriter {
 public:
  SolidWriter(StepEntities& out, const Brep& solid) : out_(out), solid_(solid) {}

  SolidIds write(std::string_view name) {
    up_ = add_direction(out_, Point3::UnitZ());
    up_vector_ = out_.begin("VECTOR('',");
    out_.put(up_).put(",1.").end();
    curve_ids_.assign(solid_.curves.size(), 0);
    surface_ids_.assign(solid_.surfaces.size(), 0);
    has_spline_surfaces_ =
        std::any_of(solid_.surfaces.begin(), solid_.surfaces.end(),
                    [](const BrepSurface& s) { return std::holds_alternative<SplineSurface>(s); });
    for (const Point3& vertex : solid_.vertices) write_vertex(vertex);
    for (const BrepEdge& edge : solid_.edges) write_edge(edge);
    std::vector<StepId> faces;
    for (const BrepFace& face : solid_.faces) faces.push_back(write_face(face));
    const StepId shell = out_.begin("CLOSED_SHELL('',");
    out_.put(faces).end();
    const StepId solid = out_.begin("MANIFOLD_SOLID_BREP(");
    out_.put_quoted(name).put(",").put(shell).end();
    return {solid, std::move(faces)};
  }

 private:
  void write_vertex(const Point3& vertex) {
    points_.push_back(add_point(out_, vertex));
    vertices_.push_back(out_.begin("VERTEX_POINT('',"));
    out_.put(points_.back()).end();
  }

  void write_edge(const BrepEdge& edge) {
    const StepId curve = curve_of(edge);
    edges_.push_back(out_.begin("EDGE_CURVE('',"));
    out_.put(vertices_[static_cast<std::size_t>(edge.start)]).put(",");
    out_.put(vertices_[static_cast<std::size_t>(edge.end)]).put(",").put(curve).put(",.T.").end();
  }

  StepId curve_of(const BrepEdge& edge) {
    StepId& id = curve_ids_[static_cast<std::size_t>(edge.curve)];
    if (id == 0)
      id = std::visit([&](const auto& curve) { return write_curve(curve, edge); },
                      solid_.curves[static_cast<std::size_t>(edge.curve)]);
    return id;
  }

  /// The point of a vertex where a curve passes through it to the last bit, else a new one.
  StepId point_at_vertex(const Point3& point, int vertex) {
    const auto i = static_cast<std::size_t>(vertex);
    return solid_.vertices[i] == point ? points_[i] : add_point(out_, point);
  }

  /// The rim of a spline surface is made of its edges' poles: those are not written again.
  StepId known_point(const Point3& point) {
    const auto found = known_points_.find(key_of(point));
    return found == known_points_.end() ? add_point(out_, point) : found->second;
  }
  static std::array<double, 3> key_of(const Point3& p) { return {p.x(), p.y(), p.z()}; }

  StepId vector_of(const Point3& direction) {
    if (direction == Point3::UnitZ()) return up_vector_;
    const StepId along = add_direction(out_, direction);
    const StepId id = out_.begin("VECTOR('',");
    out_.put(along).put(",1.").end();
    return id;
  }

  StepId write_curve(const LineCurve& line, const BrepEdge& edge) {
    const StepId origin = point_at_vertex(line.origin, edge.start);
    const StepId direction = vector_of(line.direction);
    const StepId id = out_.begin("LINE('',");
    out_.put(origin).put(",").put(direction).end();
    return id;
  }

  StepId write_curve(const CircleCurve& circle, const BrepEdge&) {
    const StepId placement = placement_of(circle.frame);
    const StepId id = out_.begin("CIRCLE('',");
    out_.put(placement).put(",").put_coordinate(circle.radius_mm).end();
    return id;
  }

  StepId write_curve(const SplineCurve& spline, const BrepEdge& edge) {
    std::vector<StepId> poles;
    for (std::size_t i = 0; i < spline.poles.size(); ++i) {
      const Point3& pole = spline.poles[i];
      if (i == 0) poles.push_back(point_at_vertex(pole, edge.start));
      else if (i + 1 == spline.poles.size()) poles.push_back(point_at_vertex(pole, edge.end));
      else poles.push_back(add_point(out_, pole));
      if (has_spline_surfaces_) known_points_.emplace(key_of(pole), poles.back());
    }
    const StepId id = out_.begin("B_SPLINE_CURVE_WITH_KNOTS('',");
    out_.put_integer(spline.degree).put(",").put(poles).put(",.UNSPECIFIED.,.F.,.F.,");
    out_.put_integers(spline.multiplicities).put(",").put_reals(spline.knots);
    out_.put(",.UNSPECIFIED.").end();
    return id;
  }

  StepId placement_of(const Frame3& frame) {
    if (last_placement_ != 0 && frame.origin == last_frame_.origin &&
        frame.axis == last_frame_.axis && frame.reference == last_frame_.reference)
      return last_placement_;
    last_frame_ = frame;
    return last_placement_ = add_placement(out_, frame);
  }

  StepId surface_of(const BrepFace& face) {
    StepId& id = surface_ids_[static_cast<std::size_t>(face.surface)];
    if (id == 0)
      id = std::visit([&](const auto& surface) { return write_surface(surface); },
                      solid_.surfaces[static_cast<std::size_t>(face.surface)]);
    return id;
  }

  StepId write_surface(const PlaneSurface& plane) {
    const StepId placement = placement_of(plane.frame);
    const StepId id = out_.begin("PLANE('',");
    out_.put(placement).end();
    return id;
  }

  StepId write_surface(const CylinderSurface& cylinder) {
    const StepId placement = placement_of(cylinder.frame);
    const StepId id = out_.begin("CYLINDRICAL_SURFACE('',");
    out_.put(placement).put(",").put_coordinate(cylinder.radius_mm).end();
    return id;
  }

  StepId write_surface(const ExtrusionSurface& extrusion) {
    const StepId curve = curve_ids_[static_cast<std::size_t>(extrusion.curve)];
    TRUEFLANK_EXPECTS(curve != 0);  // an edge of the face runs along it
    const StepId direction = vector_of(extrusion.direction);
    const StepId id = out_.begin("SURFACE_OF_LINEAR_EXTRUSION('',");
    out_.put(curve).put(",").put(direction).end();
    return id;
  }

  StepId write_surface(const SplineSurface& s) {
    std::vector<StepId> poles;
    for (const Point3& pole : s.poles) poles.push_back(known_point(pole));
    const StepId id = out_.begin("B_SPLINE_SURFACE_WITH_KNOTS('',");
    out_.put_integer(s.degree_u).put(",").put_integer(s.degree_v);
    char separator = ',';
    const auto row = static_cast<std::ptrdiff_t>(s.count_v);
    for (auto p = poles.begin(); p != poles.end(); p += row) {
      out_.put(std::string_view(&separator, 1)).put(p == poles.begin() ? "(" : "");
      out_.put(std::vector<StepId>(p, p + row));
    }
    out_.put("),.UNSPECIFIED.,.F.,.F.,.F.,");
    out_.put_integers(s.multiplicities_u).put(",").put_integers(s.multiplicities_v).put(",");
    out_.put_reals(s.knots_u).put(",").put_reals(s.knots_v).put(",.UNSPECIFIED.").end();
    return id;
  }

  StepId write_face(const BrepFace& face) {
    std::vector<StepId> bounds;
    for (const BrepLoop& loop : face.loops) {
      std::vector<StepId> oriented;
      for (const OrientedEdge& e : loop) {
        oriented.push_back(out_.begin("ORIENTED_EDGE('',*,*,"));
        out_.put(edges_[static_cast<std::size_t>(e.edge)]).put(e.forward ? ",.T." : ",.F.").end();
      }
      const StepId edge_loop = out_.begin("EDGE_LOOP('',");
      out_.put(oriented).end();
      // readers take the first bound for the outer one even where the name says so
      bounds.push_back(out_.begin(bounds.empty() ? "FACE_OUTER_BOUND(''," : "FACE_BOUND('',"));
      out_.put(edge_loop).put(",.T.").end();
    }
    const StepId surface = surface_of(face);
    const StepId id = out_.begin("ADVANCED_FACE('',");
    out_.put(bounds).put(",").put(surface).put(face.same_sense ? ",.T." : ",.F.").end();
    return id;
  }

  StepEntities& out_;
  const Brep& solid_;
  StepId up_ = 0, up_vector_ = 0, last_placement_ = 0;
  Frame3 last_frame_;
  std::vector<StepId> points_, vertices_, edges_, curve_ids_, surface_ids_;
  bool has_spline_surfaces_ = false;
  std::map<std::array<double, 3>, StepId> known_points_;
};

}  // namespace

StepId add_point(StepEntities& out, const Point3& point) {
  const StepId id = out.begin("CARTESIAN_POINT('',(");
  out.put_coordinate(point.x()).put(",").put_coordinate(point.y()).put(",");
  out.put_coordinate(point.z()).put(")").end();
  return id;
}

StepId add_direction(StepEntities& out, const Point3& direction) {
  const StepId id = out.begin("DIRECTION('',(");
  out.put(direction.x()).put(",").put(direction.y()).put(",").put(direction.z()).put(")").end();
  return id;
}

StepId add_placement(StepEntities& out, const Frame3& frame) {
  const StepId origin = add_point(out, frame.origin);
  const StepId axis = add_direction(out, frame.axis);
  const StepId reference = add_direction(out, frame.reference);
  const StepId id = out.begin("AXIS2_PLACEMENT_3D('',");
  out.put(origin).put(",").put(axis).put(",").put(reference).end();
  return id;
}

SolidIds add_solid(StepEntities& out, const Brep& solid, std::string_view name) {
  return SolidWriter(out, solid).write(name);
}

}  // namespace trueflank::io
