// SPDX-License-Identifier: GPL-3.0-or-later
//
// The side of the protuberance is a rack flank of its own: it rises from the corner's arc at its
// angle and cuts the involute of its own base circle. From the root outwards the tooth is bounded by
// the trochoid, then by that involute, then by the finished flank; the second may be missing.
#include "trueflank/geometry/protuberance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

/// Where an involute flank ends the counter-clockwise half of tooth 1.
struct FlankLine {
  double base_radius_mm = 1.0;
  double base_half_angle_rad = 0.0;

  [[nodiscard]] double half_angle_rad(double radius_mm) const {
    return base_half_angle_rad -
           involute_function(pressure_angle_at_radius_rad(radius_mm, base_radius_mm));
  }
  /// Angle by which a point lies on the gap's side of the flank.
  [[nodiscard]] double beyond_rad(const Point2& p) const {
    return polar_angle_rad(p) - half_angle_rad(p.norm());
  }
};

FlankLine side_line(const Gear& gear, const RackTrochoid& corner) {
  const double a = gear.rack.protuberance_angle_rad;
  const double a_t = std::atan(std::tan(a) * corner.stretch);
  const double depth = corner.corner_depth_mm + corner.corner_radius_mm * std::sin(a);
  const double width =  // half the tool's tooth on its pitch line, if the side went on to there
      corner.corner_offset_mm +
      corner.stretch * (corner.corner_radius_mm * std::cos(a) + depth * std::tan(a));
  const double r = corner.pitch_radius_mm;
  return {r * std::cos(a_t), corner.gap_angle_rad - width / r + involute_function(a_t)};
}

/// The first place, from the root outwards, at which the trochoid leaves the tooth across a flank.
struct Crossing {
  double parameter = 0.0;
  bool of_side = false;  ///< else of the finished flank
};

std::optional<Crossing> first_crossing(const Curve& trochoid, double pressure_angle_rad,
                                       const FlankLine& flank, const FlankLine& side) {
  // At the pressure angle the trochoid is deepest in the flank, by as little as the protuberance is
  // high: that place must be among the samples, which are dense about it.
  constexpr int kSteps = 400;
  double last = trochoid.end;
  for (const auto& [from, to] : {std::pair(trochoid.end, pressure_angle_rad),
                                 std::pair(pressure_angle_rad, trochoid.begin)}) {
    const bool dense_at_end = to == pressure_angle_rad;
    for (int i = 1; i <= kSteps; ++i) {
      const double u = static_cast<double>(i) / kSteps;
      const double t = i == kSteps    ? to
                       : dense_at_end ? to + (from - to) * (1.0 - u) * (1.0 - u)
                                      : from + (to - from) * u * u;
      for (const FlankLine* line : {&flank, &side}) {
        const auto beyond = [&](double at) { return line->beyond_rad(point_at(trochoid, at)); };
        if (!(beyond(last) < 0.0 && beyond(t) > 0.0)) continue;
        const double at = find_root(beyond, last, t);
        if (point_at(trochoid, at).norm() < line->base_radius_mm * (1.0 - 1e-12)) continue;
        return Crossing{at, line == &side};
      }
      last = t;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<ProtuberanceCut> cut_protuberance(const Gear& gear, const RackTrochoid& corner,
                                                double tip_radius_mm) {
  const FlankLine flank{base_radius_mm(gear), base_half_angle_rad(gear)};
  const FlankLine side = side_line(gear, corner);
  const double a = gear.rack.protuberance_angle_rad;
  const double a_t = std::atan(std::tan(a) * corner.stretch);
  ProtuberanceCut cut{.fillet = {corner, a, 0.5 * kPi}, .side = {}, .root_form_radius_mm = 0.0};

  const auto crossing = first_crossing(cut.fillet, gear.rack.pressure_angle_rad, flank, side);
  if (crossing) cut.fillet.begin = crossing->parameter;
  const double joint = cut.fillet.start_point().norm();
  if (crossing && !crossing->of_side) {
    cut.root_form_radius_mm = std::max(joint, flank.base_radius_mm);
    if (cut.root_form_radius_mm >= tip_radius_mm) return std::nullopt;
    return cut;
  }
  const double joint_roll =
      corner.pitch_radius_mm * std::sin(a_t) -
      (corner.corner_depth_mm + corner.corner_radius_mm * std::sin(a)) / std::sin(a_t);
  const double low = std::max({joint, side.base_radius_mm, flank.base_radius_mm});
  const auto thicker = [&](double radius) {
    return side.half_angle_rad(radius) - flank.half_angle_rad(radius);
  };
  if (!(low < tip_radius_mm) || !(thicker(low) < 0.0) || !(thicker(tip_radius_mm) > 0.0) ||
      (!crossing && joint_roll < 0.0))
    return std::nullopt;
  cut.root_form_radius_mm = find_root(thicker, low, tip_radius_mm);
  const auto roll = [&](double radius) {
    return roll_length_mm(radius, side.base_radius_mm) / side.base_radius_mm;
  };
  const double end = crossing ? roll(joint) : joint_roll / side.base_radius_mm;
  cut.side = Curve{Involute{side.base_radius_mm, side.base_half_angle_rad, -1},
                   roll(cut.root_form_radius_mm), end};
  return cut;
}

}  // namespace trueflank
