// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/section/section_contour.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/geometry/spline_basis.h"
#include "trueflank/solid/brep/outline_path.h"
#include "trueflank/solid/brep/toothing_path.h"

namespace trueflank::io {
namespace {

/// Bulge of the arc from `a` through `middle` to `b`: half the turn between the two chords is a
/// quarter of the arc's angle.
double bulge_through(const Point2& a, const Point2& middle, const Point2& b) {
  const Point2 first = middle - a, second = b - middle;
  return std::tan(0.5 * std::atan2(cross(first, second), first.dot(second)));
}

/// Bulge of edge i of a half tooth, from the true curve between its ends.
double edge_bulge(const HalfToothPolyline& half, const ToothProfile& profile, std::size_t i) {
  const HalfToothPolyline::Edge& edge = half.edges[i];
  const Point2 middle = point_at(profile.pieces()[edge.piece].curve, 0.5 * (edge.from + edge.to));
  return bulge_through(half.points[i], middle, half.points[i + 1]);
}

/// One tooth, from the clockwise gap's end; see section_polygon.
std::vector<ContourVertex> tooth_vertices(const ToothProfile& profile,
                                          const HalfToothPolyline& half) {
  const std::size_t edges = half.edges.size();
  std::vector<double> bulges(edges);
  for (std::size_t i = 0; i < edges; ++i) bulges[i] = edge_bulge(half, profile, i);
  // Edges across the middle of tooth and gap lie on tip and root circle.
  const auto across = [](const Point2& a, const Point2& b) {
    const Point2 towards = (a + b).normalized();
    return bulge_through(a, a.norm() * towards, b);
  };
  const Point2 gap = unit_vector(kPi / profile.gear().teeth);
  const Point2& gap_end = half.points.back();
  const Point2 beyond_gap = 2.0 * gap_end.dot(gap) * gap - gap_end;

  std::vector<ContourVertex> tooth;
  for (std::size_t i = edges; i > 0; --i)  // mirrored and run backwards: the bulge stays
    tooth.push_back({mirrored(half.points[i]), bulges[i - 1]});
  const Point2& tip = half.points.front();
  if (!half.vertex_at_tooth_middle) tooth.push_back({mirrored(tip), across(mirrored(tip), tip)});
  for (std::size_t i = 0; i < edges; ++i) tooth.push_back({half.points[i], bulges[i]});
  if (!half.vertex_at_gap_middle) tooth.push_back({gap_end, across(gap_end, beyond_gap)});
  return tooth;
}

/// Adds a spline's vertices but its last: as many equal steps as keep its chords within the tolerance.
void add_spline(Contour& contour, const PlaneSpline& spline, double tolerance_mm) {
  constexpr int kProbes = 8, kMostSteps = 1 << 16;
  const SplineBasis basis(spline.degree, spline.knots);
  const auto point = [&](double u) { return point_at(spline, basis, u); };
  const auto error_of = [&](int steps) {
    double worst = 0.0;
    for (int i = 0; i < steps; ++i) {
      const Point2 a = point(1.0 * i / steps);
      const Point2 chord = point((i + 1.0) / steps) - a;
      for (int k = 1; k < kProbes; ++k)
        worst = std::max(worst, std::abs(cross(point((i + 1.0 * k / kProbes) / steps) - a,
                                               chord.normalized())));
    }
    return worst;
  };
  int steps = 1;
  double error = error_of(steps);
  while (error > tolerance_mm && steps < kMostSteps) {  // errors fall with the square of the steps
    steps = std::max(steps + 1, static_cast<int>(0.9 * steps * std::sqrt(error / tolerance_mm)));
    error = error_of(steps);
  }
  contour.chord_error_mm = std::max(contour.chord_error_mm, error);
  for (int i = 0; i < steps; ++i) {
    const Point2 a = point(1.0 * i / steps), b = point((i + 1.0) / steps);
    contour.vertices.push_back({a, bulge_through(a, point((i + 0.5) / steps), b)});
  }
}

Contour contour_of_path(const OutlinePath& path, double tolerance_mm);

Contour contour(const ToothedOutline& outline, double tolerance_mm) {
  TRUEFLANK_EXPECTS(outline.profile != nullptr);
  if (!is_plain(outline.toothing())) return contour_of_path(outline_path(outline), tolerance_mm);
  const double rotation_rad = outline.rotation_rad +
                              section_turn_rad(outline.twist, 0.5 * outline.twist.face_width_mm);
  const HalfToothPolyline half = tessellate(*outline.profile, tolerance_mm);
  const std::vector<ContourVertex> tooth = tooth_vertices(*outline.profile, half);
  Contour result;
  result.chord_error_mm = half.chord_error_mm;
  const int teeth = outline.profile->gear().teeth;
  for (int k = 0; k < teeth; ++k)
    for (const ContourVertex& vertex : tooth)
      result.vertices.push_back(
          {rotated(vertex.point, rotation_rad + kTwoPi * k / teeth), vertex.bulge});
  return result;
}

Contour contour(const CircleOutline& outline, double) { return {.circle = outline}; }

/// Adds an arc's vertices but its last.
void add_arc(Contour& contour, const Point2& centre, const Point2& from,
             const Point2& to, double tolerance_mm) {
  const double radius = (from - centre).norm();
  const double begin = polar_angle_rad(from - centre);
  const double angle = wrapped_rad(polar_angle_rad(to - centre) - begin);
  const int edges = std::max(
      1, static_cast<int>(std::ceil(circle_segments(radius, tolerance_mm) * angle / kTwoPi)));
  const double bulge = std::tan(0.25 * angle / edges);
  contour.chord_error_mm =
      std::max(contour.chord_error_mm, radius * (1.0 - std::cos(0.5 * angle / edges)));
  for (int i = 0; i < edges; ++i)
    contour.vertices.push_back({i == 0 ? from : Point2(centre + radius * unit_vector(begin + angle * i / edges)),
                        bulge});
}

Contour contour_of_path(const OutlinePath& path, double tolerance_mm) {
  if (path.pieces.size() == 1)
    return {.circle = CircleOutline{path.circles[0].centre, path.circles[0].radius_mm}};
  Contour result;
  // the path's own distance from the outline counts, too
  tolerance_mm = std::max(tolerance_mm - path.fit_error_mm, 0.5 * tolerance_mm);
  for (std::size_t i = 0; i < path.pieces.size(); ++i) {
    const PathPiece& piece = path.pieces[i];
    const Point2& next = path.pieces[(i + 1) % path.pieces.size()].start;
    if (const auto* arc = std::get_if<PathArc>(&piece.shape))
      add_arc(result, path.circles[arc->circle].centre, piece.start, next, tolerance_mm);
    else if (const auto* s = std::get_if<PathSpline>(&piece.shape))
      add_spline(result, s->spline, tolerance_mm);
    else
      result.vertices.push_back({piece.start, 0.0});
  }
  result.chord_error_mm += path.fit_error_mm;
  return result;
}

Contour contour(const BoreOutline& outline, double tolerance_mm) {
  return contour_of_path(outline_path(outline), tolerance_mm);
}

SectionBody section_body(const Slab& slab, const std::string& name, PartRole role,
                         double tolerance_mm) {
  SectionBody body{name, role, contour_of(slab.outer, tolerance_mm), {}};
  for (const Outline& hole : slab.holes) body.holes.push_back(contour_of(hole, tolerance_mm));
  return body;
}

bool has_teeth(const Slab& slab) {
  const auto toothed = [](const Outline& o) { return std::holds_alternative<ToothedOutline>(o); };
  return toothed(slab.outer) || std::any_of(slab.holes.begin(), slab.holes.end(), toothed);
}

/// A body's slab where the assembly stands.
struct PlacedSlab {
  std::size_t body = 0;
  const Slab* slab = nullptr;
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
};

std::vector<PlacedSlab> placed_slabs(const PartShapes& shapes) {
  std::vector<PlacedSlab> slabs;
  for (std::size_t i = 0; i < shapes.assembly.size(); ++i) {
    const Placement& body = shapes.assembly[i];
    for (const Slab& slab : shapes.parts[body.part].slabs)
      slabs.push_back({i, &slab, slab.z_lower_mm + body.translation_mm[2],
                       slab.z_upper_mm + body.translation_mm[2]});
  }
  return slabs;
}

/// A range of heights that cuts the same slabs throughout.
struct Cut {
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  std::vector<PlacedSlab> slabs;
  std::set<std::pair<std::size_t, const Slab*>> teeth;
};

std::vector<Cut> cuts_of(const std::vector<PlacedSlab>& slabs) {
  std::set<double> heights;
  for (const PlacedSlab& s : slabs) heights.insert({s.z_lower_mm, s.z_upper_mm});
  std::vector<Cut> cuts;
  for (auto low = heights.begin(); low != heights.end(); ++low) {
    const auto high = std::next(low);
    if (high == heights.end()) break;
    Cut cut{*low, *high, {}, {}};
    const double middle = 0.5 * (*low + *high);
    for (const PlacedSlab& s : slabs) {
      if (s.z_lower_mm > middle || s.z_upper_mm < middle) continue;
      cut.slabs.push_back(s);
      if (has_teeth(*s.slab)) cut.teeth.emplace(s.body, s.slab);
    }
    cuts.push_back(std::move(cut));
  }
  // A cut all of whose teeth another one shows as well tells nothing new.
  std::vector<Cut> kept;
  for (const Cut& cut : cuts) {
    const auto within = [&](const Cut& other) {
      return std::includes(other.teeth.begin(), other.teeth.end(), cut.teeth.begin(), cut.teeth.end());
    };
    const bool redundant =
        cut.teeth.empty() ||
        std::any_of(cuts.begin(), cuts.end(), [&](const Cut& other) {
          return within(other) && other.teeth.size() > cut.teeth.size();
        }) ||
        std::any_of(kept.begin(), kept.end(), within);
    if (!redundant) kept.push_back(cut);
  }
  return kept;
}

}  // namespace

Contour contour_of(const Outline& outline, double tolerance_mm) {
  TRUEFLANK_EXPECTS(tolerance_mm > 0.0);
  return std::visit([&](const auto& o) { return contour(o, tolerance_mm); }, outline);
}

Contour placed(Contour contour, double rotation_rad, const Point2& translation) {
  if (contour.circle) contour.circle->centre = rotated(contour.circle->centre, rotation_rad) + translation;
  for (ContourVertex& vertex : contour.vertices)
    vertex.point = rotated(vertex.point, rotation_rad) + translation;
  return contour;
}

void include(Box2& box, const Contour& contour) {
  const auto add = [&](const Point2& p) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  };
  if (contour.circle) {
    const Point2 radius = Point2::Constant(contour.circle->radius_mm);
    add(contour.circle->centre - radius);
    add(contour.circle->centre + radius);
  }
  for (const ContourVertex& vertex : contour.vertices) add(vertex.point);
}

std::vector<Section> part_sections(const PartShape& part, double tolerance_mm) {
  std::vector<Section> sections;
  for (const Slab& slab : part.slabs)
    sections.push_back({"section " + std::to_string(sections.size() + 1), slab.z_lower_mm,
                        slab.z_upper_mm, {section_body(slab, part.name, part.role, tolerance_mm)}});
  return sections;
}

std::vector<Section> assembly_sections(const PartShapes& shapes, double tolerance_mm) {
  std::vector<Section> sections;
  for (const Cut& cut : cuts_of(placed_slabs(shapes))) {
    Section section{"section " + std::to_string(sections.size() + 1), cut.z_lower_mm, cut.z_upper_mm, {}};
    for (const PlacedSlab& s : cut.slabs) {
      const Placement& body = shapes.assembly[s.body];
      const Point2 move(body.translation_mm[0], body.translation_mm[1]);
      SectionBody drawn =
          section_body(*s.slab, body.name, shapes.parts[body.part].role, tolerance_mm);
      drawn.outer = placed(std::move(drawn.outer), body.rotation_rad, move);
      for (Contour& hole : drawn.holes) hole = placed(std::move(hole), body.rotation_rad, move);
      section.bodies.push_back(std::move(drawn));
    }
    sections.push_back(std::move(section));
  }
  return sections;
}

}  // namespace trueflank::io
