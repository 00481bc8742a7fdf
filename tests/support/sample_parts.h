// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/solid/shape/part_shape.h"

// Part shapes made by hand, and their exact areas and volumes from the profile's own curves.
namespace trueflank::test {

inline PartShape gear_part(std::string name, const ToothProfile& profile, double face_width_mm,
                           std::vector<Outline> holes = {}) {
  return {std::move(name), {Slab{0.0, face_width_mm, ToothedOutline{&profile, 0.0}, std::move(holes)}}};
}

inline PartShape ring_part(std::string name, const ToothProfile& profile, double face_width_mm,
                           std::vector<Outline> more_holes = {}) {
  more_holes.insert(more_holes.begin(), ToothedOutline{&profile, 0.0});
  const double rim_radius_mm = profile.root_radius_mm() + 6.0 * profile.gear().normal_module_mm;
  return {std::move(name),
          {Slab{0.0, face_width_mm, CircleOutline{Point2::Zero(), rim_radius_mm}, std::move(more_holes)}}};
}

/// A gear or ring as above, with the toothing's twist, deviation and so on.
inline PartShape toothed_part(std::string name, const Toothing& toothing,
                              std::vector<Outline> more_holes = {}) {
  const ToothedOutline teeth{.profile = toothing.profile, .twist = toothing.twist,
                             .deviation = toothing.deviation,
                             .edge_chamfer_mm = toothing.edge_chamfer_mm,
                             .displacement = toothing.displacement};
  const ToothProfile& profile = *toothing.profile;
  const double width_mm = toothing.twist.face_width_mm;
  const bool ring = profile.gear().kind == GearKind::kInternal;
  PartShape part = ring ? ring_part(std::move(name), profile, width_mm, std::move(more_holes))
                        : gear_part(std::move(name), profile, width_mm, std::move(more_holes));
  (ring ? part.slabs[0].holes[0] : part.slabs[0].outer) = teeth;
  return part;
}

inline PartShape helical_part(std::string name, const ToothProfile& profile, double face_width_mm,
                              bool herringbone = false, std::vector<Outline> more_holes = {}) {
  return toothed_part(std::move(name),
                      {.profile = &profile,
                       .twist = face_twist(profile.gear(), face_width_mm, herringbone)},
                      std::move(more_holes));
}

/// Compound planet with neck, bore and an index mark sunk into the upper face.
inline PartShape planet_part(const ToothProfile& lower, const ToothProfile& upper) {
  const BoreOutline bore{{.diameter_mm = 8.0}};
  const ToothedOutline teeth1{&lower, 0.0}, teeth2{&upper, 0.07};
  const double neck_mm = std::min(lower.root_radius_mm(), upper.root_radius_mm()) - 0.5;
  return {"planet",
          {Slab{0.0, 10.0, teeth1, {bore}},
           Slab{10.0, 11.0, CircleOutline{Point2::Zero(), neck_mm}, {bore}},
           Slab{11.0, 20.0, teeth2, {bore}},
           Slab{20.0, 20.5, teeth2, {bore, CircleOutline{{9.0, 0.0}, 1.0}}}}};
}

/// Area between a curve and the origin, by trapezoids and Richardson's extrapolation.
inline double swept_area_mm2(const Curve& curve) {
  const auto trapezoids = [&](int n) {
    double sum = 0.0;
    Point2 last = curve.start_point();
    for (int i = 1; i <= n; ++i) {
      const Point2 next = point_at(curve, curve.begin + (curve.end - curve.begin) * i / n);
      sum += 0.5 * cross(last, next);
      last = next;
    }
    return sum;
  };
  std::vector<double> row;
  for (int n = 64; n <= 2048; n *= 2) {
    std::vector<double> next{trapezoids(n)};
    double factor = 4.0;
    for (const double coarser : row) {
      next.push_back(next.back() + (next.back() - coarser) / (factor - 1.0));
      factor *= 4.0;
    }
    row = std::move(next);
  }
  return row.back();
}

inline double area_mm2(const ToothedOutline& outline) {
  double half = 0.0;
  for (const ProfilePiece& piece : outline.profile->pieces()) half += swept_area_mm2(piece.curve);
  return 2.0 * outline.profile->gear().teeth * half;
}
inline double area_mm2(const CircleOutline& outline) {
  return kPi * outline.radius_mm * outline.radius_mm;
}
inline double area_mm2(const BoreOutline& outline) {
  const BoreDesign& b = outline.bore;
  const double r = 0.5 * b.diameter_mm;
  const auto cap = [&](double chord_distance_mm) {  // circle beyond a chord
    return r * r * std::acos(chord_distance_mm / r) -
           chord_distance_mm * std::sqrt(r * r - chord_distance_mm * chord_distance_mm);
  };
  switch (b.kind) {
    case BoreKind::kRound: return kPi * r * r;
    case BoreKind::kDFlat: return kPi * r * r - cap(b.d_flat_mm - r);
    case BoreKind::kHex: return 2.0 * std::sqrt(3.0) * r * r;
    case BoreKind::kKeyway: break;
  }
  // the keyway's rectangle from the chord of its mouth, less the cap the circle fills already
  const double mouth_mm = std::sqrt(r * r - 0.25 * b.keyway_width_mm * b.keyway_width_mm);
  return kPi * r * r - cap(mouth_mm) + b.keyway_width_mm * (r + b.keyway_depth_mm - mouth_mm);
}
inline double area_mm2(const Outline& outline) {
  return std::visit([](const auto& o) { return area_mm2(o); }, outline);
}

inline double exact_volume_mm3(const PartShape& part) {
  double volume = 0.0;
  for (const Slab& slab : part.slabs) {
    double area = area_mm2(slab.outer);
    for (const Outline& hole : slab.holes) area -= area_mm2(hole);
    volume += area * (slab.z_upper_mm - slab.z_lower_mm);
  }
  return volume;
}

}  // namespace trueflank::test
