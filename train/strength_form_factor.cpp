// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/strength_form_factor.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

/// Samples of a fillet in the search for its tangent; a fillet turns by less than half a circle.
constexpr int kSamples = 64;

/// Where the load at the tip crosses the tooth's middle (the x axis), and its angle.
struct TipLoad {
  double crossing_mm = kNaN;
  double angle_rad = kNaN;
};

TipLoad tip_load(const ToothProfile& profile) {
  for (const ProfilePiece& piece : profile.pieces()) {
    if (piece.kind != PieceKind::kInvolute) continue;
    // pieces run from the tip: the involute begins where contact ends
    const Point2 place = point_at(piece.curve, piece.curve.begin);
    const Point2 along = tangent_at(piece.curve, piece.curve.begin);
    const Point2 normal(-along.y(), along.x());
    return {.crossing_mm = place.x() - place.y() * normal.x() / normal.y(),
            .angle_rad = std::acos(std::min(1.0, std::abs(normal.y())))};
  }
  return {};
}

/// Angle of a curve's tangent against the tooth's middle, 0 to pi/2.
double tangent_angle(const Curve& curve, double parameter) {
  const Point2 along = tangent_at(curve, parameter);
  return std::atan2(std::abs(along.y()), std::abs(along.x()));
}

/// First parameter from the flank downwards where the tangent stands at the angle.
std::optional<double> parameter_at_tangent(const Curve& curve, double angle_rad) {
  const auto excess = [&](double t) { return tangent_angle(curve, t) - angle_rad; };
  const double step = (curve.end - curve.begin) / kSamples;
  for (int i = 0; i < kSamples; ++i) {
    const double from = curve.begin + i * step, to = curve.begin + (i + 1) * step;
    if (excess(from) * excess(to) <= 0.0) return find_root(excess, from, to);
  }
  return std::nullopt;
}

CriticalSection section_at(const Gear& gear, const TipLoad& load, const Point2& point) {
  CriticalSection section;
  const double m = gear.normal_module_mm;
  section.thickness_mm = 2.0 * std::abs(point.y()) * std::cos(gear.helix_angle_rad);
  section.lever_mm = std::abs(load.crossing_mm - point.x());
  section.load_angle_rad = load.angle_rad;
  section.form_factor = 6.0 * section.lever_mm / m * std::cos(load.angle_rad) /
                        (std::pow(section.thickness_mm / m, 2) *
                         std::cos(gear.rack.pressure_angle_rad));
  return section;
}

/// Radius of curvature by the turn of the tangent over a short piece; 0 at an end that is a corner.
double curvature_radius_mm(const Curve& curve, double parameter) {
  const double step = 1e-4 * (curve.end - curve.begin);
  const auto inside = [&](double t) {
    return std::clamp(t, std::min(curve.begin, curve.end), std::max(curve.begin, curve.end));
  };
  const double from = inside(parameter - step), to = inside(parameter + step);
  const Point2 a = tangent_at(curve, from), b = tangent_at(curve, to);
  const double turn = std::abs(std::atan2(cross(a, b), a.dot(b)));
  return (point_at(curve, to) - point_at(curve, from)).norm() / turn;
}

}  // namespace

CriticalSection critical_section(const ToothProfile& profile) {
  const Gear& gear = profile.gear();
  const TipLoad load = tip_load(profile);
  const double angle =
      gear.kind == GearKind::kInternal ? rad_from_deg(60.0) : rad_from_deg(30.0);
  CriticalSection worst;
  worst.tangent_found = false;
  for (const ProfilePiece& piece : profile.pieces()) {
    if (piece.kind != PieceKind::kFillet) continue;
    if (const auto t = parameter_at_tangent(piece.curve, angle)) {
      CriticalSection section = section_at(gear, load, point_at(piece.curve, *t));
      section.fillet_radius_mm = curvature_radius_mm(piece.curve, *t);
      return section;
    }
    for (const double t : {piece.curve.begin, piece.curve.end}) {
      CriticalSection section = section_at(gear, load, point_at(piece.curve, t));
      section.fillet_radius_mm = curvature_radius_mm(piece.curve, t);
      section.tangent_found = false;
      if (!(section.form_factor <= worst.form_factor)) worst = section;
    }
  }
  if (std::isnan(worst.form_factor)) {
    // no fillet at all: the tooth breaks where its flank meets the root circle
    for (const ProfilePiece& piece : profile.pieces()) {
      if (piece.kind == PieceKind::kRoot) break;
      worst = section_at(gear, load, piece.curve.end_point());
      worst.tangent_found = false;
    }
  }
  return worst;
}

CriticalSection normal_section(const ToothProfile& profile) {
  const Gear& gear = profile.gear();
  const CriticalSection transverse = critical_section(profile);
  if (gear.helix_angle_rad == 0.0 || gear.cutter) return transverse;
  const double cos_b = std::cos(base_helix_angle_rad(gear)), cos_beta = std::cos(gear.helix_angle_rad);
  const double teeth = gear.teeth / (cos_b * cos_b * cos_beta);
  const auto of_virtual = [&](int whole_teeth) {
    Gear spur = gear;
    spur.helix_angle_rad = 0.0;
    spur.teeth = whole_teeth;
    spur.thinning_mm = gear.thinning_mm * cos_beta;
    spur.tip_radius_mm =
        reference_radius_mm(spur) + profile.tip_radius_mm() - reference_radius_mm(gear);
    const auto made = ToothProfile::make(spur);
    return made ? critical_section(*made) : CriticalSection{};
  };
  const double low = std::floor(teeth);
  CriticalSection section = of_virtual(static_cast<int>(low));
  const CriticalSection high = of_virtual(static_cast<int>(low) + 1);
  // nearly linear in 1 / z
  const double share = (1.0 / low - 1.0 / teeth) / (1.0 / low - 1.0 / (low + 1.0));
  for (const auto member : {&CriticalSection::form_factor, &CriticalSection::thickness_mm, &CriticalSection::lever_mm,
                            &CriticalSection::load_angle_rad, &CriticalSection::fillet_radius_mm})
    section.*member += share * (high.*member - section.*member);
  return std::isnan(section.form_factor) ? transverse : section;
}

double form_factor(const ToothProfile& profile) { return normal_section(profile).form_factor; }

}  // namespace trueflank
