// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/outline_loop.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

/// Chords of an arc and the error they leave.
struct ArcChords {
  int count = 1;
  double error_mm = 0.0;
};

ArcChords arc_chords(double radius_mm, double angle_rad, double tolerance_mm, int least) {
  const double bounded = std::min(tolerance_mm, 0.5 * radius_mm);
  const double widest = 2.0 * std::acos(1.0 - bounded / radius_mm);
  ArcChords chords;
  chords.count = std::max(least, static_cast<int>(std::ceil(angle_rad / widest - 1e-9)));
  chords.error_mm = radius_mm * (1.0 - std::cos(0.5 * angle_rad / chords.count));
  return chords;
}

void set_radii(OutlineLoop& loop) {
  loop.inner_radius_mm = loop.outer_radius_mm = (loop.points.front() - loop.centre).norm();
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Point2 a = loop.points[i] - loop.centre;
    const Point2 b = loop.points[i + 1 < loop.points.size() ? i + 1 : 0] - loop.centre;
    const Point2 edge = b - a;
    const double u = std::clamp(-a.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    loop.inner_radius_mm = std::min(loop.inner_radius_mm, (a + u * edge).norm());
    loop.outer_radius_mm = std::max(loop.outer_radius_mm, a.norm());
  }
}

OutlineLoop loop_of(const ToothedOutline& outline, double tolerance_mm, int) {
  if (!has_profile_section(outline)) return toothed_section(outline, 0.5 * outline.twist.face_width_mm, tolerance_mm);
  SectionPolygon section = section_polygon(*outline.profile, tolerance_mm, outline.rotation_rad);
  OutlineLoop loop;
  loop.points = std::move(section.points);
  loop.teeth = section.teeth;
  loop.points_per_tooth = section.points_per_tooth;
  loop.chord_error_mm = section.chord_error_mm;
  return loop;
}

OutlineLoop loop_of(const CircleOutline& outline, double tolerance_mm, int least_segments) {
  const ArcChords chords =
      arc_chords(outline.radius_mm, kTwoPi, tolerance_mm, std::max(8, least_segments));
  OutlineLoop loop;
  loop.centre = outline.centre;
  loop.chord_error_mm = chords.error_mm;
  for (int i = 0; i < chords.count; ++i)
    loop.points.push_back(outline.centre +
                          outline.radius_mm * unit_vector(kTwoPi * i / chords.count));
  return loop;
}

OutlineLoop loop_of(const BoreOutline& outline, double tolerance_mm, int least_segments) {
  const double radius = 0.5 * outline.bore.diameter_mm;
  if (outline.bore.kind == BoreKind::kRound)
    return loop_of(CircleOutline{Point2::Zero(), radius}, tolerance_mm, least_segments);
  OutlineLoop loop;
  for (const BoreEdge& edge : bore_edges(outline.bore)) {
    loop.points.push_back(edge.from);
    if (!edge.arc) continue;
    const double from = polar_angle_rad(edge.from);
    const double angle = wrapped_rad(polar_angle_rad(edge.to) - from);
    const int least =
        std::max(2, static_cast<int>(std::ceil(least_segments * angle / kTwoPi)));
    const ArcChords chords = arc_chords(radius, angle, tolerance_mm, least);
    loop.chord_error_mm = std::max(loop.chord_error_mm, chords.error_mm);
    for (int i = 1; i < chords.count; ++i)
      loop.points.push_back(radius * unit_vector(from + angle * i / chords.count));
  }
  return loop;
}

BoreDesign grown_bore(BoreDesign bore, double by_mm) {
  bore.diameter_mm += 2.0 * by_mm;
  if (bore.kind == BoreKind::kKeyway) bore.keyway_width_mm += 2.0 * by_mm;
  if (bore.kind == BoreKind::kDFlat) bore.d_flat_mm += 2.0 * by_mm;
  return bore;
}

OutlineExtent extent_of(const ToothedOutline& outline) {
  const double tip = outline.profile->tip_radius_mm();
  double root = outline.profile->root_radius_mm();
  if (outline.bed != nullptr)
    root += tip < root ? outline.bed->deepest_mm() : -outline.bed->deepest_mm();
  return {Point2::Zero(), std::min(tip, root), std::max(tip, root)};
}
OutlineExtent extent_of(const CircleOutline& outline) {
  const double at_bed = outline.radius_mm + outline.bed.grow_mm;
  return {outline.centre, std::min(outline.radius_mm, at_bed), std::max(outline.radius_mm, at_bed)};
}
OutlineExtent extent_of(const BoreOutline& outline) {
  const auto of = [](const BoreDesign& bore) {
    double inner = 0.5 * bore.diameter_mm;
    if (bore.kind == BoreKind::kDFlat) inner = bore.d_flat_mm - inner;
    return OutlineExtent{Point2::Zero(), inner, largest_radius_mm(bore)};
  };
  const OutlineExtent here = of(outline.bore), at_bed = of(grown_bore(outline.bore, outline.bed.grow_mm));
  return {Point2::Zero(), std::min(here.inner_radius_mm, at_bed.inner_radius_mm),
          std::max(here.outer_radius_mm, at_bed.outer_radius_mm)};
}

bool same(const ToothedOutline& a, const ToothedOutline& b) {
  return a.profile == b.profile && a.rotation_rad == b.rotation_rad &&
         a.z_lower_mm == b.z_lower_mm && a.twist == b.twist && a.deviation == b.deviation &&
         a.edge_chamfer_mm == b.edge_chamfer_mm && a.displacement == b.displacement &&
         a.bed == b.bed && a.bed_height_mm == b.bed_height_mm;
}
bool same(const CircleOutline& a, const CircleOutline& b) {
  return a.centre == b.centre && a.radius_mm == b.radius_mm && a.bed == b.bed;
}
bool same(const BoreOutline& a, const BoreOutline& b) {
  return a.bore == b.bore && a.bed == b.bed;
}

}  // namespace

bool has_profile_section(const ToothedOutline& outline) {
  const Toothing toothing = outline.toothing();
  return !toothing.has_deviation() && toothing.displacement == nullptr;
}

bool is_plain_prism(const ToothedOutline& outline) {
  return has_profile_section(outline) && outline.toothing().prismatic();
}

OutlineExtent extent(const Outline& outline) {
  return std::visit([](const auto& o) { return extent_of(o); }, outline);
}

Outline grown(Outline outline, double by_mm) {
  if (auto* circle = std::get_if<CircleOutline>(&outline)) circle->radius_mm += by_mm;
  else if (auto* bore = std::get_if<BoreOutline>(&outline)) bore->bore = grown_bore(bore->bore, by_mm);
  else TRUEFLANK_EXPECTS(false);
  return outline;
}

Outline outline_at_height(const Outline& outline, double z_mm) {
  Outline here = outline;
  BedChamfer bed;
  if (auto* circle = std::get_if<CircleOutline>(&here)) std::swap(bed, circle->bed);
  if (auto* bore = std::get_if<BoreOutline>(&here)) std::swap(bed, bore->bed);
  return grown(std::move(here), bed.grow_at_mm(z_mm));
}

double bed_height_mm(const Outline& outline) {
  if (const auto* toothed = std::get_if<ToothedOutline>(&outline))
    return toothed->bed != nullptr ? toothed->bed_height_mm : 0.0;
  if (const auto* circle = std::get_if<CircleOutline>(&outline)) return circle->bed.height_mm;
  return std::get<BoreOutline>(outline).bed.height_mm;
}

bool same_outline(const Outline& a, const Outline& b) {
  return std::visit(
      [](const auto& p, const auto& q) {
        if constexpr (std::is_same_v<decltype(p), decltype(q)>)
          return same(p, q);
        else
          return false;
      },
      a, b);
}

double largest_radius_mm(const BoreDesign& bore) {
  const double radius = 0.5 * bore.diameter_mm;
  if (!(radius > 0.0)) return 0.0;
  switch (bore.kind) {
    case BoreKind::kKeyway:
      return std::hypot(radius + bore.keyway_depth_mm, 0.5 * bore.keyway_width_mm);
    case BoreKind::kHex:
      return radius / std::cos(kPi / 6.0);
    default:
      return radius;
  }
}

std::vector<BoreEdge> bore_edges(const BoreDesign& bore) {
  const double r = 0.5 * bore.diameter_mm;
  TRUEFLANK_EXPECTS(r > 0.0);
  std::vector<BoreEdge> edges;
  switch (bore.kind) {
    case BoreKind::kRound:
      edges.push_back({{r, 0.0}, {r, 0.0}, true});
      break;
    case BoreKind::kKeyway: {
      const double half = 0.5 * bore.keyway_width_mm, floor = r + bore.keyway_depth_mm;
      const double mouth = std::sqrt(r * r - half * half);
      const Point2 corner[] = {{mouth, -half}, {floor, -half}, {floor, half}, {mouth, half}};
      for (int i = 0; i < 3; ++i) edges.push_back({corner[i], corner[i + 1], false});
      edges.push_back({corner[3], corner[0], true});
      break;
    }
    case BoreKind::kDFlat: {
      const double flat = bore.d_flat_mm - r;
      const double half = std::sqrt(r * r - flat * flat);
      edges.push_back({{flat, -half}, {flat, half}, false});
      edges.push_back({{flat, half}, {flat, -half}, true});
      break;
    }
    case BoreKind::kHex: {
      const double corner = r / std::cos(kPi / 6.0);
      const auto at = [&](int i) { return Point2(corner * unit_vector((2 * i - 1) * kPi / 6.0)); };
      for (int i = 0; i < 6; ++i) edges.push_back({at(i), at((i + 1) % 6), false});
      break;
    }
  }
  return edges;
}

OutlineLoop outline_loop(const Outline& outline, double tolerance_mm, int least_segments) {
  TRUEFLANK_EXPECTS(tolerance_mm > 0.0);
  OutlineLoop loop = std::visit(
      [&](const auto& o) { return loop_of(o, tolerance_mm, least_segments); }, outline);
  set_radii(loop);
  return loop;
}

OutlineLoop loop_through(std::vector<Point2> points, const Point2& centre) {
  OutlineLoop loop;
  loop.centre = centre;
  loop.points = std::move(points);
  set_radii(loop);
  return loop;
}

}  // namespace trueflank
