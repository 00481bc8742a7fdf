// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/profile_builder.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/geometry/protuberance.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

/// Sine of an angle whose sign rounding cannot change.
constexpr double kSureShare = 1e-9;

}  // namespace

Status ProfileBuilder::find_pointed_tip() {
  const double r_b = base_radius_mm_;
  p_.tip_radius_mm_ = g().tip_radius_mm;
  if (base_half_angle_rad_ <= 0.0)
    return fail(no_tooth("shift", g().shift,
                         "the teeth have no thickness left at the base circle",
                         "a larger profile shift or less thinning"));
  if (half_angle_at(g().tip_radius_mm) < 0.0) {
    p_.notes_.pointed = true;
    p_.tip_radius_mm_ = r_b / std::cos(inverse_involute_rad(base_half_angle_rad_));
  }
  return {};
}

Status ProfileBuilder::find_undercut(const Curve& fillet, double& fillet_end) {
  // Seen along the trochoid from its joint with the rack's flank inwards, it starts on the gap's
  // side of the involute and dives into the tooth: that crossing is where the involute ends.
  const double r_b = base_radius_mm_;
  const double psi = base_half_angle_rad_;
  const auto outside = [&](double t) {
    const Point2 q = point_at(fillet, t);
    const double r = q.norm();
    // below the base circle there is no involute; count it by the base point's angle
    const double inv = involute_function(pressure_angle_at_radius_rad(r, r_b));
    return polar_angle_rad(q) - (psi - inv);
  };
  // Its sign, by the direction that q has from the involute's: far from it no arc functions are needed.
  const auto is_in_the_tooth = [&](double t) {
    const Point2 q = point_at(fillet, t);
    const double tangent = std::sqrt(std::max(0.0, q.squaredNorm() / (r_b * r_b) - 1.0));
    const double x = q.x() + tangent * q.y(), y = q.y() - tangent * q.x();  // q, turned by -atan(tangent)
    const double c = std::cos(psi - tangent), s = std::sin(psi - tangent);
    const double across = y * c - x * s, along = x * c + y * s;
    return along > 0.0 && std::abs(across) > kSureShare * along ? across < 0.0 : outside(t) < 0.0;
  };
  // Dense near the joint, where a slight undercut crosses; in finer steps where coarse ones find none.
  const double span = fillet.begin - fillet.end;
  for (const int steps : {50, 400}) {
    double last = fillet.end;
    for (int i = 1; i <= steps; ++i) {
      const double u = static_cast<double>(i) / steps;
      const double t = fillet.end + span * u * u;
      if (is_in_the_tooth(t)) {
        const double cross_t = find_root(outside, last, t);
        const double r = point_at(fillet, cross_t).norm();
        if (r < r_b * (1.0 - 1e-12)) break;
        fillet_end = cross_t;
        p_.root_form_radius_mm_ = std::max(r, r_b);
        return {};
      }
      last = t;
    }
  }
  // tangent within rounding: the involute starts on the base circle
  p_.root_form_radius_mm_ = std::max(r_b, point_at(fillet, fillet.end).norm());
  fillet_end = fillet.end;
  return {};
}

Status ProfileBuilder::external_circles() {
  const double full_round = full_round_coefficient(g().rack);
  if (full_round < 0.0)
    return fail(no_tooth(
        "rack.dedendum", g().rack.dedendum,
        "the tooth of the rack is pointed before it reaches its depth",
        "a dedendum of at most " +
            trimmed_number(0.25 * kPi / std::tan(g().rack.pressure_angle_rad)) +
            " or a pressure angle of at most " +
            trimmed_number(deg_from_rad(std::atan(0.25 * kPi / g().rack.dedendum))) + " deg"));
  p_.root_radius_coefficient_ = g().rack.root_radius;
  if (g().rack.root_radius > full_round) {
    p_.root_radius_coefficient_ = full_round;
    p_.notes_.full_round = true;
  }
  p_.root_radius_mm_ = reference_radius_mm(g()) - cutting_depth_mm();
  if (!(p_.root_radius_mm_ > 0.0))
    return fail(no_tooth("shift", g().shift, "the root circle has no radius left",
                         "more teeth or a larger profile shift"));
  if (auto ok = find_pointed_tip(); !ok) return ok;
  if (p_.tip_radius_mm_ <= p_.root_radius_mm_)
    return fail(no_tooth("tip_diameter_mm", 2.0 * p_.tip_radius_mm_,
                         "the tip circle lies inside the root circle",
                         "a tip diameter above " + trimmed_number(2.0 * p_.root_radius_mm_)));
  return {};
}

/// How far the rack's tip line lies below the reference circle.
double ProfileBuilder::cutting_depth_mm() const {
  return g().normal_module_mm * (g().rack.dedendum - g().shift);
}

/// The path of the rack's tip corner.
RackTrochoid ProfileBuilder::rack_corner() const {
  const double m = g().normal_module_mm, alpha_n = g().rack.pressure_angle_rad;
  const double rho = p_.root_radius_coefficient_;
  const double stretch = 1.0 / std::cos(g().helix_angle_rad);
  const double half_land = 0.25 * kPi - g().rack.dedendum * std::tan(alpha_n) -
                           rho * (1.0 - std::sin(alpha_n)) / std::cos(alpha_n) +
                           residual_protuberance(g().rack) / std::cos(alpha_n);
  return {.pitch_radius_mm = reference_radius_mm(g()),
          .corner_depth_mm = cutting_depth_mm() - rho * m,
          .corner_offset_mm = stretch * m * std::max(half_land, 0.0) + 0.5 * g().thinning_mm,
          .corner_radius_mm = rho * m,
          .stretch = stretch,
          .gap_angle_rad = gap_angle()};
}

/// Where the involute ends on the fillet, or on what a protuberance leaves.
Status ProfileBuilder::find_root_form(const RackTrochoid& corner, Curve& fillet,
                                      std::optional<Curve>& protuberance_side) {
  const double alpha_n = g().rack.pressure_angle_rad;
  const double alpha_t = transverse_pressure_angle_rad(g());
  // Roll length where the rack's straight flank stops touching.
  const double joint_depth = corner.corner_depth_mm + corner.corner_radius_mm * std::sin(alpha_n);
  const double joint_roll =
      corner.pitch_radius_mm * std::sin(alpha_t) - joint_depth / std::sin(alpha_t);
  if (residual_protuberance(g().rack) > 0.0) {
    p_.notes_.protuberance_undercut_mm = g().normal_module_mm * residual_protuberance(g().rack);
    p_.notes_.undercut = joint_roll < 0.0;
    const auto cut = cut_protuberance(g(), corner, p_.tip_radius_mm_);
    if (!cut)
      return fail(no_tooth("rack.protuberance", g().rack.protuberance,
                           "the protuberance takes the whole flank away",
                           "a smaller protuberance or a larger protuberance_angle_deg"));
    fillet = cut->fillet;
    protuberance_side = cut->side;
    p_.root_form_radius_mm_ = cut->root_form_radius_mm;
  } else if (joint_roll < 0.0) {
    Curve from_root{corner, 0.5 * kPi, alpha_n};
    if (auto ok = find_undercut(from_root, fillet.begin); !ok) return ok;
    p_.notes_.undercut = fillet.begin > alpha_n;
  } else {
    p_.root_form_radius_mm_ = radius_at(joint_roll);
  }
  if (p_.root_form_radius_mm_ >= p_.tip_radius_mm_)
    return fail(no_tooth("teeth", g().teeth,
                         "the fillet of the tool reaches diameter " +
                         trimmed_number(2.0 * p_.root_form_radius_mm_) +
                         " mm, the tooth ends at " + trimmed_number(2.0 * p_.tip_radius_mm_) +
                         " mm: no involute is left",
                         "a larger profile shift, more teeth or a larger tip diameter"));
  return {};
}

/// Angle from the tooth's middle at its narrowest place, looked at closely only where it may be
/// none.
double ProfileBuilder::waist_rad(const Curve& fillet) {
  double waist = kPi;
  for (const int steps : {4, 16, 64}) {
    double last = polar_angle_rad(point_at(fillet, fillet.begin)), widest_step = 0.0;
    waist = last;
    for (int i = 1; i <= steps; ++i) {
      const double t = fillet.begin + (fillet.end - fillet.begin) * i / steps;
      const double angle = polar_angle_rad(point_at(fillet, t));
      waist = std::min(waist, angle);
      widest_step = std::max(widest_step, std::abs(angle - last));
      last = angle;
    }
    if (waist > 2.0 * widest_step) break;
  }
  return waist;
}

Status ProfileBuilder::build_external() {
  if (auto ok = external_circles(); !ok) return ok;
  const RackTrochoid corner = rack_corner();
  // from the involute to the root circle
  Curve fillet{corner, g().rack.pressure_angle_rad, 0.5 * kPi};
  std::optional<Curve> protuberance_side;
  if (auto ok = find_root_form(corner, fillet, protuberance_side); !ok) return ok;
  const double root_end = gap_angle() - corner.corner_offset_mm / corner.pitch_radius_mm;
  if (waist_rad(fillet) <= 0.0 || root_end <= 0.0)
    return fail(no_tooth("shift", g().shift, "the tool cuts the tooth off at its foot",
                         "a larger profile shift or more teeth"));

  p_.tip_form_radius_mm_ = p_.tip_radius_mm_;
  if (auto ok = round_tip(); !ok) return ok;
  const double r_b = base_radius_mm_;
  const double roll_root = roll_length_mm(p_.root_form_radius_mm_, r_b);
  const double roll_tip = roll_length_mm(p_.tip_form_radius_mm_, r_b);
  if (!p_.notes_.pointed) add_tip();
  add_involute(roll_tip, roll_root);
  if (protuberance_side) add(PieceKind::kFillet, *protuberance_side);
  add(PieceKind::kFillet, fillet);
  add_arc(PieceKind::kRoot, p_.root_radius_mm_, root_end, gap_angle());
  return {};
}

}  // namespace trueflank
