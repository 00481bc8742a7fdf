// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/gear_dimensions.h"

#include <algorithm>
#include <cmath>

#include "trueflank/export/number_text.h"
#include "trueflank/geometry/tooth_span.h"

namespace trueflank::io {
namespace {

/// To 1 um.
std::string mm_digits(double length_mm) {
  std::string text;
  append_decimal(text, std::round(length_mm * 1e3) / 1e3);
  return text;
}

}  // namespace


double start_of_active_profile_mm(const GearTrain& train, const TrainGear& gear) {
  double result = kNaN;
  for (const TrainMesh& mesh : train.meshes) {
    const GearPair pair = train.pair(mesh);
    double radius = kNaN;
    if (pair.profile1 == &gear.profile) radius = start_of_active_profile1_mm(pair);
    if (pair.profile2 == &gear.profile) radius = start_of_active_profile2_mm(pair);
    if (std::isnan(radius)) continue;
    const bool ring = gear.profile.gear().kind == GearKind::kInternal;
    if (std::isnan(result))
      result = radius;
    else
      result = ring ? std::max(result, radius) : std::min(result, radius);
  }
  return result;
}

std::string span_obstacle(const TrainGear& gear, int teeth_spanned) {
  const Gear& g = gear.profile.gear();
  if (g.kind == GearKind::kInternal) return "a ring has no span";
  const double needed = span_face_width_mm(g, teeth_spanned);
  const double usable = gear.face_width_mm - 2.0 * gear.edge_chamfer_mm;
  const double face =
      gear.twist.herringbone ? 0.5 * (usable - gear.twist.relief_groove_mm) : usable;
  if (face > needed) return {};
  return "the span over " + std::to_string(teeth_spanned) + " teeth needs a face width above " +
         mm_digits(needed) + " mm, " + (gear.twist.herringbone ? "a half has " : "there are ") +
         mm_digits(face) + " mm";
}

std::string measured_with(const Gear& gear) {
  const bool straight = gear.helix_angle_rad == 0.0;
  const bool opposite = gear.kind == GearKind::kExternal && gear.teeth % 2 == 0;
  return straight || opposite ? "pins" : "balls";
}

MeasuredLimits measured_limits(const TrainGear& gear, double least_mm, double most_mm) {
  const Gear& g = gear.profile.gear();
  const int span_teeth = recommended_span_teeth(g);
  const double pin_mm = recommended_pin_diameter_mm(g);
  const Gear thick = thinned(g, least_mm), thin = thinned(g, most_mm);
  // thicker teeth of a ring leave less room between its pins
  const bool external = g.kind == GearKind::kExternal;
  const Gear &widest = external ? thick : thin, &narrowest = external ? thin : thick;
  MeasuredLimits limits;
  if (span_obstacle(gear, span_teeth).empty()) {
    limits.span_min_mm = base_tangent_length_mm(thin, span_teeth);
    limits.span_max_mm = base_tangent_length_mm(thick, span_teeth);
  }
  limits.over_pins_min_mm = over_pins_mm(narrowest, pin_mm);
  limits.over_pins_max_mm = over_pins_mm(widest, pin_mm);
  return limits;
}

}  // namespace trueflank::io
