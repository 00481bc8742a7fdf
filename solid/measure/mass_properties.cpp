// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/mass_properties.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/tooth_profile.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

/// Chord error of the polygons over which is integrated: far below what any tolerance of mass asks.
constexpr double kChordError_mm = 2e-5;

struct SectionMoments {
  double area_mm2 = 0.0;
  double polar_mm4 = 0.0;  ///< second moment of area about the part's axis
};

/// Bands between two breaks of a section that changes over the face, and the places of Gauss's rule in
/// each: exact for polynomials of the fifth degree, crowning and reliefs of the second.
constexpr int kBands = 4;
constexpr std::array<double, 3> kGaussPlaces = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> kGaussWeights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/// Green's theorem over a polygon.
SectionMoments moments(const OutlineLoop& loop) {
  SectionMoments sum;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Point2 &p = loop.points[i], &q = loop.points[(i + 1) % loop.points.size()];
    const double cross = p.x() * q.y() - q.x() * p.y();
    sum.area_mm2 += 0.5 * cross;
    sum.polar_mm4 += cross / 12.0 * (p.squaredNorm() + p.dot(q) + q.squaredNorm());
  }
  return sum;
}

SectionMoments moments(const CircleOutline& circle) {
  const double square = circle.radius_mm * circle.radius_mm, area = kPi * square;
  return {area, area * (0.5 * square + circle.centre.squaredNorm())};
}

/// Between a curve and the origin, by n chords.
SectionMoments chord_moments(const Curve& curve, int n) {
  SectionMoments sum;
  Point2 p = curve.start_point();
  for (int i = 1; i <= n; ++i) {
    const Point2 q = point_at(curve, std::lerp(curve.begin, curve.end, static_cast<double>(i) / n));
    const double twice_area = cross(p, q);
    sum.area_mm2 += 0.5 * twice_area;
    sum.polar_mm4 += twice_area / 12.0 * (p.squaredNorm() + p.dot(q) + q.squaredNorm());
    p = q;
  }
  return sum;
}

/// Of a section that is nothing but its profile: the half tooth by Romberg's rule (the error of chords at
/// equal steps of the parameter has even powers of the step alone), to 1e-9 of the whole.
SectionMoments moments(const ToothProfile& profile) {
  SectionMoments sum;
  for (const ProfilePiece& piece : profile.pieces()) {
    constexpr int kLevels = 4, kFewest = 6;
    std::array<SectionMoments, kLevels> level;
    for (int k = 0; k < kLevels; ++k) level[k] = chord_moments(piece.curve, kFewest << k);
    double power = 4.0;
    for (int step = 1; step < kLevels; ++step, power *= 4.0)
      for (int k = kLevels - 1; k >= step; --k) {
        const auto better = [&](double SectionMoments::*value) {
          level[k].*value += (level[k].*value - level[k - 1].*value) / (power - 1.0);
        };
        better(&SectionMoments::area_mm2);
        better(&SectionMoments::polar_mm4);
      }
    sum.area_mm2 += level.back().area_mm2;
    sum.polar_mm4 += level.back().polar_mm4;
  }
  const double halves = 2.0 * profile.gear().teeth;
  return {halves * sum.area_mm2, halves * sum.polar_mm4};
}

/// Whether a toothing's section, but for its turn, is the same at every height.
bool is_uniform(const ToothedOutline& outline) {
  return outline.edge_chamfer_mm == 0.0 && outline.displacement == nullptr && outline.bed == nullptr &&
         !(outline.toothing().has_deviation() && outline.deviation->varies_along_face);
}

/// A circle or bore, whose bed chamfer changes its section as a square of the height.
SectionMoments integrated_plain(const Outline& outline, double z_lower_mm, double z_upper_mm) {
  SectionMoments sum;
  const double bed = std::clamp(bed_height_mm(outline), z_lower_mm, z_upper_mm);
  const auto add = [&](double z_mm, double height_mm) {
    const Outline here = outline_at_height(outline, z_mm);
    const auto* circle = std::get_if<CircleOutline>(&here);
    const SectionMoments m = circle != nullptr ? moments(*circle) : moments(outline_loop(here, kChordError_mm));
    sum.area_mm2 += m.area_mm2 * height_mm;
    sum.polar_mm4 += m.polar_mm4 * height_mm;
  };
  add(z_upper_mm, z_upper_mm - bed);
  if (bed > z_lower_mm)
    for (std::size_t k = 0; k < kGaussPlaces.size(); ++k)
      add(std::lerp(z_lower_mm, bed, kGaussPlaces[k]), kGaussWeights[k] * (bed - z_lower_mm));
  return sum;
}

/// Moments of an outline's section integrated over a slab's height: area to volume. A twist turns
/// sections and changes neither (Cavalieri).
SectionMoments integrated(const Outline& outline, double z_lower_mm, double z_upper_mm) {
  SectionMoments sum;
  const auto add = [&](const SectionMoments& section, double height_mm) {
    sum.area_mm2 += section.area_mm2 * height_mm;
    sum.polar_mm4 += section.polar_mm4 * height_mm;
  };
  const auto* toothed = std::get_if<ToothedOutline>(&outline);
  if (toothed == nullptr) return integrated_plain(outline, z_lower_mm, z_upper_mm);
  if (is_uniform(*toothed) && !toothed->toothing().has_deviation()) {
    add(moments(*toothed->profile), z_upper_mm - z_lower_mm);
    return sum;
  }
  if (is_uniform(*toothed)) {
    add(moments(outline_loop(outline, kChordError_mm)), z_upper_mm - z_lower_mm);
    return sum;
  }
  const double lower = z_lower_mm - toothed->z_lower_mm, upper = z_upper_mm - toothed->z_lower_mm;
  const double face = toothed->twist.face_width_mm;
  std::vector<double> breaks{lower, upper};
  const auto add_break = [&](double z) {
    if (z > lower && z < upper) breaks.push_back(z);
  };
  for (const double z : {toothed->edge_chamfer_mm, toothed->bed_height_mm, 0.5 * face, face - toothed->edge_chamfer_mm})
    add_break(z);
  if (toothed->toothing().has_deviation())
    for (const double z : toothed->deviation->z_breaks_mm) add_break(z);
  std::sort(breaks.begin(), breaks.end());
  struct Section {
    double z_mm = 0.0, height_mm = 0.0;
    SectionMoments moments = {};
  };
  std::vector<Section> sections;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int band = 0; band < kBands; ++band) {
      const double height = (breaks[i + 1] - breaks[i]) / kBands;
      for (std::size_t k = 0; k < kGaussPlaces.size(); ++k)
        sections.push_back({breaks[i] + height * (band + kGaussPlaces[k]), kGaussWeights[k] * height});
    }
  for_each_piece(sections.size(), [&](std::size_t i) {
    sections[i].moments = moments(toothed_section(*toothed, sections[i].z_mm, kChordError_mm));
  });
  for (const Section& section : sections) add(section.moments, section.height_mm);
  return sum;
}

}  // namespace

MassProperties mass_properties(const PartShape& shape, double density_kg_m3) {
  MassProperties result;
  double moment_mm5 = 0.0;
  for (const Slab& slab : shape.slabs) {
    SectionMoments solid = integrated(slab.outer, slab.z_lower_mm, slab.z_upper_mm);
    for (const Outline& hole : slab.holes) {
      const SectionMoments empty = integrated(hole, slab.z_lower_mm, slab.z_upper_mm);
      solid.area_mm2 -= empty.area_mm2;
      solid.polar_mm4 -= empty.polar_mm4;
    }
    result.volume_mm3 += solid.area_mm2;
    moment_mm5 += solid.polar_mm4;
  }
  result.mass_kg = result.volume_mm3 * 1e-9 * density_kg_m3;
  result.axial_inertia_kg_m2 = moment_mm5 * 1e-15 * density_kg_m3;
  return result;
}

BodyInertias body_inertias(const GearTrain& train, const PartShapes& shapes,
                           const std::function<double(const PartShape&)>& density_of) {
  const Topology& topology = train.topology();
  BodyInertias bodies(topology.members.size());
  std::vector<int> places(bodies.size(), 0);
  std::vector<MassProperties> own;
  for (const PartShape& part : shapes.parts)
    own.push_back(part.member == kNoMember || !part.bought.empty()
                      ? MassProperties{}
                      : mass_properties(part, density_of(part)));
  for (const Placement& placement : shapes.assembly) {
    const auto part = static_cast<std::size_t>(placement.part);
    const int member = shapes.parts[part].member;
    if (member == kNoMember || !(own[part].mass_kg > 0.0)) continue;
    const auto m = static_cast<std::size_t>(member);
    ++places[m];
    bodies[m].axial_kg_m2 += own[part].axial_inertia_kg_m2;
    bodies[m].mass_kg += own[part].mass_kg;
    if (topology.is_planet(member)) continue;  // about its own axis; it is carried round elsewhere
    const double off_axis_m = 1e-3 * std::hypot(placement.translation_mm[0], placement.translation_mm[1]);
    if (topology.has_planets()) bodies[m].axial_kg_m2 += own[part].mass_kg * off_axis_m * off_axis_m;
  }
  for (std::size_t m = 0; m < bodies.size(); ++m)
    if (topology.is_planet(static_cast<int>(m)) && places[m] > 1) {
      bodies[m].axial_kg_m2 /= places[m];
      bodies[m].mass_kg /= places[m];
    }
  return bodies;
}

}  // namespace trueflank
