// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mesh_difference.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/measure/triangle_tree.h"

namespace trueflank {
namespace {

/// Of a body's height: how far inside of its end face a section is taken for a place on the edge.
constexpr double kInside = 1e-4;
/// A section shows a difference where it has at least this share of the distance in space.
constexpr double kShownShare = 0.5;
/// Of the section's largest radius: how far apart points of an outline are looked at, at most.
constexpr double kStep = 0.01;
/// Radii of an outline that vary less than this share of their mean make a circle about the axis.
constexpr double kRoundness = 0.05;

/// Distances from the outlines of a section, by the walls that stand on them.
class Outlines {
 public:
  explicit Outlines(const MeshSection& section) : section_(section), tree_(walls(section)) {}

  [[nodiscard]] Point2 nearest_point(const Point2& p) const {
    hint_ = nearest(p);
    return nearest_on_triangle(Point3(p.x(), p.y(), 0.0), tree_.corners(hint_)).head<2>();
  }
  [[nodiscard]] std::size_t loop_at(const Point2& p) const {
    std::uint32_t wall = nearest(p);
    std::size_t loop = 0;
    for (; wall >= section_.loops[loop].size(); ++loop)
      wall -= static_cast<std::uint32_t>(section_.loops[loop].size());
    return loop;
  }

 private:
  [[nodiscard]] std::uint32_t nearest(const Point2& p) const {
    return tree_.nearest(Point3(p.x(), p.y(), 0.0), hint_).triangle;
  }
  /// A triangle without area for every edge, in the order of the loops.
  static TriangleMesh walls(const MeshSection& section) {
    TriangleMesh mesh;
    for (const auto& loop : section.loops) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      const auto n = static_cast<std::uint32_t>(loop.size());
      for (std::uint32_t i = 0; i < n; ++i) {
        mesh.vertices.push_back({loop[i].x(), loop[i].y(), 0.0});
        const std::uint32_t next = first + (i + 1) % n;
        mesh.triangles.push_back({first + i, next, next});
      }
    }
    return mesh;
  }

  const MeshSection& section_;
  TriangleTree tree_;
  mutable std::uint32_t hint_ = 0;
};

/// Deviations of the corners of one part's outlines and of points between them.
void add_deviations(const MeshSection& section, const MeshSection& other, bool on_golden,
                    std::vector<OutlineRun>& all) {
  const Outlines to(other);
  double extent = 0.0;
  for (const auto& loop : section.loops)
    for (const Point2& p : loop) extent = std::max(extent, p.norm());
  for (const auto& loop : section.loops) {
    OutlineRun run{.on_golden = on_golden, .points = {}};
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point2 edge = loop[(i + 1) % loop.size()] - loop[i];
      const int pieces = std::max(2, static_cast<int>(std::ceil(edge.norm() / (kStep * extent))));
      for (int k = 0; k < pieces; ++k) {
        const Point2 p = loop[i] + edge * (static_cast<double>(k) / pieces);
        const Point2 foot = to.nearest_point(p);
        const double distance = (foot - p).norm();
        // a point of the golden surface within the new material, or of the new one outside the golden
        const bool more = in_material(other, p) == on_golden;
        run.points.push_back({p, foot, more ? distance : -distance});
      }
    }
    all.push_back(std::move(run));
  }
}

/// Both sections in a plane, with their deviations.
void cut(MeshDifference& d, const TriangleMesh& golden, const TriangleMesh& made) {
  d.golden = mesh_section(golden, d.plane);
  d.made = mesh_section(made, d.plane);
  d.outlines.clear();
  if (d.golden.loops.empty() || d.made.loops.empty()) return;
  add_deviations(d.golden, d.made, true, d.outlines);
  add_deviations(d.made, d.golden, false, d.outlines);
}

/// What the section shows near the worst place, as far as that is about the distance found in space.
const OutlineDeviation* shown_deviation(const MeshDifference& d, double largest_mm) {
  const OutlineDeviation* best = nullptr;
  for (const OutlineRun& run : d.outlines)
    for (const OutlineDeviation& o : run.points) {
      if (std::abs(o.deviation_mm) < kShownShare * largest_mm) continue;
      if ((o.point - d.worst).norm() > 2.0 * largest_mm) continue;
      if (!best || std::abs(std::abs(o.deviation_mm) - largest_mm) <
                       std::abs(std::abs(best->deviation_mm) - largest_mm))
        best = &o;
    }
  return best;
}

std::string round_place(const std::vector<Point2>& loop, std::size_t loops) {
  Point2 middle(0.0, 0.0);
  for (const Point2& p : loop) middle += p / static_cast<double>(loop.size());
  double area = 0.0, least = 1e300, most = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    area += 0.5 * cross(loop[i], loop[(i + 1) % loop.size()]);
    least = std::min(least, loop[i].norm());
    most = std::max(most, loop[i].norm());
  }
  if (area > 0.0) return loops > 1 && most - least < kRoundness * most ? "rim" : "outline";
  if (in_material({.loops = {loop}}, Point2(0.0, 0.0))) return "bore";
  return printed("hole at radius %.3f mm and %.2f deg", middle.norm(),
                 deg_from_rad(wrapped_rad(polar_angle_rad(middle))));
}

void find_regions(MeshDifference& d, double tolerance_mm) {
  for (const ToothRegion region : {ToothRegion::kLeftFlank, ToothRegion::kRightFlank,
                                   ToothRegion::kTip, ToothRegion::kRoot})
    d.regions.push_back({.region = region});
  std::vector<std::array<bool, 4>> off(static_cast<std::size_t>(d.teeth->count));
  const Outlines golden(d.golden);
  for (const OutlineRun& run : d.outlines)
    for (const OutlineDeviation& o : run.points) {
      if (golden.loop_at(o.point) != d.teeth->loop) continue;
      const SectionPlace place = section_place(*d.teeth, o.point);
      const auto index = static_cast<std::size_t>(place.region);
      RegionDifference& region = d.regions[index];
      region.least_mm = std::min(region.least_mm, o.deviation_mm);
      region.greatest_mm = std::max(region.greatest_mm, o.deviation_mm);
      if (std::abs(o.deviation_mm) <= tolerance_mm) continue;
      bool& counted = off[static_cast<std::size_t>(place.tooth - 1)][index];
      region.teeth_off += counted ? 0 : 1;
      counted = true;
    }
}

}  // namespace

MeshDifference mesh_difference(const TriangleMesh& golden, const TriangleMesh& made,
                               const MeshComparison& comparison, const CompareOptions& options) {
  const bool on_golden = comparison.worst_is_on_golden();
  const SurfaceDistance& worst = on_golden ? comparison.from_golden : comparison.from_new;
  const MeshSummary& body = on_golden ? comparison.golden : comparison.made;
  const Point3 place(worst.worst_place_mm.data());
  const double largest = comparison.largest_mm();

  MeshDifference d;
  const double margin = kInside * (body.upper_mm[2] - body.lower_mm[2]);
  const double z = std::clamp(place.z(), body.lower_mm[2] + margin, body.upper_mm[2] - margin);
  d.plane = {.origin_mm = Point3(0.0, 0.0, z)};
  d.worst = place.head<2>();
  cut(d, golden, made);
  d.teeth = find_teeth(d.golden);
  const OutlineDeviation* shown = shown_deviation(d, largest);
  if (shown) {
    d.worst_deviation_mm = std::copysign(largest, shown->deviation_mm);
    const std::size_t loop = Outlines(d.golden).loop_at(d.worst);
    d.on_teeth = d.teeth && d.teeth->loop == loop;
    d.place = d.on_teeth ? place_text(*d.teeth, section_place(*d.teeth, d.worst))
                         : round_place(d.golden.loops[loop], d.golden.loops.size());
    if (d.teeth) find_regions(d, options.tolerance_mm);
    return d;
  }

  // nothing to be seen across the axis: an end face, shown by the plane through axis and place
  const double angle = std::atan2(place.y(), place.x());
  d.across_axis = false;
  d.teeth.reset();
  d.plane = {.origin_mm = Point3::Zero(),
             .u = Point3(std::cos(angle), std::sin(angle), 0.0),
             .v = Point3::UnitZ()};
  d.worst = {place.head<2>().norm(), place.z()};
  cut(d, golden, made);
  shown = shown_deviation(d, largest);
  // where neither section shows it, the point itself tells whether it stands in the other's material
  const bool more = shown ? shown->deviation_mm > 0.0
                          : in_material(on_golden ? d.made : d.golden, d.worst) == on_golden;
  d.worst_deviation_mm = more ? largest : -largest;
  d.place = printed("face at z = %.6g mm", place.z());
  return d;
}

}  // namespace trueflank
