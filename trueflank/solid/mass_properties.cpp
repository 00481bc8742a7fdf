// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mass_properties.h"

#include "trueflank/solid/outline_loop.h"

namespace trueflank {
namespace {

/// Chord error of the polygons over which is integrated: far below what any tolerance of mass asks.
constexpr double kChordError_mm = 2e-5;

struct SectionMoments {
  double area_mm2 = 0.0;
  double polar_mm4 = 0.0;  ///< second moment of area about the part's axis
};

/// Green's theorem over the polygon of an outline.
SectionMoments moments(const Outline& outline) {
  const OutlineLoop loop = outline_loop(outline, kChordError_mm);
  SectionMoments sum;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Point2 &p = loop.points[i], &q = loop.points[(i + 1) % loop.points.size()];
    const double cross = p.x() * q.y() - q.x() * p.y();
    sum.area_mm2 += 0.5 * cross;
    sum.polar_mm4 += cross / 12.0 * (p.squaredNorm() + p.dot(q) + q.squaredNorm());
  }
  return sum;
}

}  // namespace

MassProperties mass_properties(const PartShape& shape, double density_kg_m3) {
  MassProperties result;
  double moment_mm5 = 0.0;
  for (const Slab& slab : shape.slabs) {
    SectionMoments section = moments(slab.outer);
    for (const Outline& hole : slab.holes) {
      const SectionMoments empty = moments(hole);
      section.area_mm2 -= empty.area_mm2;
      section.polar_mm4 -= empty.polar_mm4;
    }
    const double height_mm = slab.z_upper_mm - slab.z_lower_mm;
    result.volume_mm3 += section.area_mm2 * height_mm;
    moment_mm5 += section.polar_mm4 * height_mm;
  }
  result.mass_kg = result.volume_mm3 * 1e-9 * density_kg_m3;
  result.axial_inertia_kg_m2 = moment_mm5 * 1e-15 * density_kg_m3;
  return result;
}

BodyInertias body_inertias(const PartShapes& shapes,
                           const std::function<double(const std::string&)>& density_of) {
  BodyInertias bodies;
  int planet_parts = 0;
  for (const PartShape& part : shapes.parts) {
    const MassProperties p = mass_properties(part, density_of(part.name));
    if (part.name == "sun" || part.name == "pinion") bodies.sun_kg_m2 = p.axial_inertia_kg_m2;
    if (part.name == "ring1" || part.name == "ring" || part.name == "wheel")
      bodies.ring1_kg_m2 = p.axial_inertia_kg_m2;
    if (part.name == "ring2") bodies.ring2_kg_m2 = p.axial_inertia_kg_m2;
    if (part.name == "carrier") bodies.carrier_kg_m2 = p.axial_inertia_kg_m2;
    if (!part.name.starts_with("planet")) continue;
    ++planet_parts;
    bodies.planet_kg_m2 += p.axial_inertia_kg_m2;
    bodies.planet_mass_kg += p.mass_kg;
  }
  if (planet_parts > 1) {
    bodies.planet_kg_m2 /= planet_parts;
    bodies.planet_mass_kg /= planet_parts;
  }
  return bodies;
}

}  // namespace trueflank
