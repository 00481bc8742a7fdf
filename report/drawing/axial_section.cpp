// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/axial_section.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace trueflank::io {
namespace {

struct Interval {
  double from = 0.0, to = 0.0;
  bool operator==(const Interval&) const = default;
};
using Intervals = std::vector<Interval>;

constexpr double kSame_mm = 1e-9;

/// Where the x axis lies inside an outline; for teeth the root circle of an external gear, the tip
/// circle of a ring: what is free of teeth.
std::optional<Interval> crossing(const Outline& outline) {
  if (const auto* teeth = std::get_if<ToothedOutline>(&outline)) {
    const double r = std::min(teeth->profile->root_radius_mm(), teeth->profile->tip_radius_mm());
    return Interval{-r, r};
  }
  if (const auto* circle = std::get_if<CircleOutline>(&outline)) {
    const double h2 = circle->radius_mm * circle->radius_mm - circle->centre.y() * circle->centre.y();
    if (h2 <= 0.0) return std::nullopt;
    return Interval{circle->centre.x() - std::sqrt(h2), circle->centre.x() + std::sqrt(h2)};
  }
  const BoreDesign& bore = std::get<BoreOutline>(outline).bore;
  const double r = 0.5 * bore.diameter_mm;
  switch (bore.kind) {
    case BoreKind::kRound: return Interval{-r, r};
    case BoreKind::kKeyway: return Interval{-r, r + bore.keyway_depth_mm};
    case BoreKind::kDFlat: return Interval{-r, bore.d_flat_mm - r};
    case BoreKind::kHex: return Interval{-r, r};
  }
  return std::nullopt;
}

/// Root and tip radius of a toothed outline.
std::optional<Interval> tooth_band(const Outline& outline) {
  const auto* teeth = std::get_if<ToothedOutline>(&outline);
  if (!teeth) return std::nullopt;
  return Interval{std::min(teeth->profile->root_radius_mm(), teeth->profile->tip_radius_mm()),
                  std::max(teeth->profile->root_radius_mm(), teeth->profile->tip_radius_mm())};
}

Intervals without(const Intervals& material, const Interval& hole) {
  Intervals left;
  for (const Interval& m : material) {
    if (hole.from > m.from + kSame_mm) left.push_back({m.from, std::min(m.to, hole.from)});
    if (hole.to < m.to - kSame_mm) left.push_back({std::max(m.from, hole.to), m.to});
  }
  std::erase_if(left, [](const Interval& i) { return i.to - i.from < kSame_mm; });
  return left;
}

struct SlabSection {
  Intervals body;   // hatched
  Intervals teeth;
  Intervals solid;  // both, joined where they touch
};

SlabSection section_of(const Slab& slab) {
  SlabSection section;
  if (const auto outer = crossing(slab.outer)) section.body.push_back(*outer);
  for (const Outline& hole : slab.holes) {
    if (const auto band = tooth_band(hole)) {
      section.body = without(section.body, {-band->to, band->to});
      section.teeth.insert(section.teeth.end(), {{-band->to, -band->from}, {band->from, band->to}});
    } else if (const auto inside = crossing(hole)) {
      section.body = without(section.body, *inside);
    }
  }
  if (const auto band = tooth_band(slab.outer))
    section.teeth.insert(section.teeth.end(), {{-band->to, -band->from}, {band->from, band->to}});
  section.solid = section.body;
  section.solid.insert(section.solid.end(), section.teeth.begin(), section.teeth.end());
  std::sort(section.solid.begin(), section.solid.end(),
            [](const Interval& a, const Interval& b) { return a.from < b.from; });
  Intervals joined;
  for (const Interval& i : section.solid) {
    if (!joined.empty() && i.from <= joined.back().to + kSame_mm)
      joined.back().to = std::max(joined.back().to, i.to);
    else
      joined.push_back(i);
  }
  section.solid = joined;
  return section;
}

/// Edges of a face between the material below and above it: where only one of them is, and the rims
/// seen behind the holes between.
void add_face(AxialSection& section, double z, const Intervals& below, const Intervals& above) {
  Intervals differs;
  for (const Interval& i : below) {
    Intervals rest = {i};
    for (const Interval& j : above) rest = without(rest, j);
    differs.insert(differs.end(), rest.begin(), rest.end());
  }
  for (const Interval& i : above) {
    Intervals rest = {i};
    for (const Interval& j : below) rest = without(rest, j);
    differs.insert(differs.end(), rest.begin(), rest.end());
  }
  if (differs.empty()) return;
  Interval span = differs.front();
  for (const Interval& i : differs) span = {std::min(span.from, i.from), std::max(span.to, i.to)};
  Intervals lines = {span};
  for (const Interval& i : below)
    for (const Interval& j : above)
      if (std::min(i.to, j.to) > std::max(i.from, j.from))
        lines = without(lines, {std::max(i.from, j.from), std::min(i.to, j.to)});
  for (const Interval& i : lines) section.edges.push_back({z, i.from, z, i.to});
}

}  // namespace

double outermost_mm(const Outline& outline) {
  if (const auto band = tooth_band(outline)) return band->to;
  if (const auto* circle = std::get_if<CircleOutline>(&outline)) return circle->centre.norm() + circle->radius_mm;
  const BoreDesign& bore = std::get<BoreOutline>(outline).bore;
  return 0.5 * bore.diameter_mm + (bore.kind == BoreKind::kKeyway ? bore.keyway_depth_mm : 0.0);
}

AxialSection axial_section(const PartShape& part) {
  AxialSection section;
  Intervals below;
  for (const Slab& slab : part.slabs) {
    const SlabSection s = section_of(slab);
    add_face(section, slab.z_lower_mm, below, s.solid);
    for (const Interval& i : s.body)
      section.bands.push_back({slab.z_lower_mm, slab.z_upper_mm, i.from, i.to, false});
    for (const Interval& i : s.teeth)
      section.bands.push_back({slab.z_lower_mm, slab.z_upper_mm, i.from, i.to, true});
    for (const SectionBand& band : section.bands) {
      if (band.z_lower_mm != slab.z_lower_mm) continue;
      section.edges.push_back({slab.z_lower_mm, band.from_mm, slab.z_upper_mm, band.from_mm});
      section.edges.push_back({slab.z_lower_mm, band.to_mm, slab.z_upper_mm, band.to_mm});
    }
    below = s.solid;
  }
  if (!part.slabs.empty()) add_face(section, part.slabs.back().z_upper_mm, below, {});
  return section;
}

}  // namespace trueflank::io
