// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/pose/part_frame.h"

#include <cmath>
#include <variant>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/shape/part_shape.h"

namespace trueflank::loop {
namespace {

using Point3 = std::array<double, 3>;

/// Where a gear's own frame stands in its part's.
struct PlaceInPart {
  double z_mm = 0.0, turn_rad = 0.0;

  [[nodiscard]] Point3 own(const Point3& p, bool direction) const {
    const double c = std::cos(turn_rad), s = std::sin(turn_rad);
    return {c * p[0] + s * p[1], -s * p[0] + c * p[1], direction ? p[2] : p[2] - z_mm};
  }
};

PlaceInPart place_in_part(const GearTrain& train, const TrainGear& gear) {
  PlaceInPart place;
  const auto shapes = part_shapes(train);
  if (!shapes) return place;
  bool found = false;
  const auto look = [&](const Outline& outline) {
    const auto* teeth = std::get_if<ToothedOutline>(&outline);
    if (found || teeth == nullptr || teeth->profile != &gear.profile) return;
    place = {teeth->z_lower_mm, teeth->rotation_rad};
    found = true;
  };
  for (const PartShape& part : shapes->parts)
    for (const Slab& slab : part.slabs) {
      look(slab.outer);
      for (const Outline& hole : slab.holes) look(hole);
    }
  return place;
}

/// Points on the gear's flanks, within its face.
int on_flanks(const FlankGeometry& geometry, const std::vector<Point3>& points) {
  int count = 0;
  for (const Point3& p : points) {
    if (p[2] < 0.0 || p[2] > geometry.face_width_mm()) continue;
    const PlacedPoint near = geometry.nearest_flank(p, 0.03);
    count += near.place.surface == Surface::kFlank &&
             std::abs(near.distance_mm) < 0.15 * geometry.gear().normal_module_mm;
  }
  return count;
}

}  // namespace

void move_into_gear_frame(const GearTrain& train, const TrainGear& gear, const FlankGeometry& geometry,
                          MeasuredData& data) {
  const PlaceInPart place = place_in_part(train, gear);
  if (place.z_mm == 0.0 && place.turn_rad == 0.0) return;
  for (ScanData& scan : data.scans) {
    std::vector<Point3> moved;
    moved.reserve(scan.points_mm.size());
    for (const Point3& p : scan.points_mm) moved.push_back(place.own(p, false));
    if (on_flanks(geometry, moved) <= 2 * on_flanks(geometry, scan.points_mm)) continue;
    scan.points_mm = std::move(moved);
    for (auto& normal : scan.normals) {
      const Point3 n = place.own({normal[0], normal[1], normal[2]}, true);
      for (std::size_t k = 0; k < 3; ++k) normal[k] = static_cast<std::decay_t<decltype(normal[k])>>(n[k]);
    }
    data.notes.push_back(scan.file + printed(": taken in the frame of the part, in which %s begins at z = %.6g mm",
                                             gear.name.c_str(), place.z_mm));
  }
}

}  // namespace trueflank::loop
