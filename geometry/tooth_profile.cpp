// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/tooth_profile.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/profile_builder.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

Status check_values(const Gear& g) {
  if (g.teeth < 3) return fail(impossible_value("teeth", g.teeth, "at least 3 teeth"));
  if (!(g.normal_module_mm > 0.0) || !std::isfinite(g.normal_module_mm))
    return fail(impossible_value("module_mm", g.normal_module_mm, "a module above 0"));
  const double a = g.rack.pressure_angle_rad;
  if (!(a > rad_from_deg(1.0) && a <= rad_from_deg(45.0)))
    return fail(
        impossible_value("rack.pressure_angle_deg", deg_from_rad(a), "between 1 and 45 degrees"));
  if (!(std::abs(g.helix_angle_rad) <= rad_from_deg(60.0)))
    return fail(impossible_value("helix_angle_deg", deg_from_rad(g.helix_angle_rad),
                                 "within +-60 degrees"));
  if (!(g.rack.root_radius >= 0.0))
    return fail(impossible_value("rack.root_radius", g.rack.root_radius, "0 or more"));
  if (!(g.rack.dedendum > 0.0) || !(g.rack.addendum > 0.0))
    return fail(impossible_value("rack.dedendum", g.rack.dedendum, "addendum and dedendum above 0"));
  if (!(g.rack.protuberance >= 0.0) || !(g.rack.grinding_stock >= 0.0) ||
      (g.rack.grinding_stock > 0.0 && !(g.rack.grinding_stock < g.rack.protuberance)))
    return fail(impossible_value("rack.grinding_stock", g.rack.grinding_stock,
                                 "less than the protuberance: grinding would leave a step"));
  if (g.rack.protuberance > 0.0 && !(g.rack.protuberance_angle_rad > rad_from_deg(1.0) &&
                                     g.rack.protuberance_angle_rad < a))
    return fail(impossible_value("rack.protuberance_angle_deg",
                                 deg_from_rad(g.rack.protuberance_angle_rad),
                                 "above 1 degree and below the pressure angle"));
  if (!std::isfinite(g.shift) || !std::isfinite(g.thinning_mm) || !std::isfinite(g.tip_radius_mm))
    return fail(impossible_value("shift", g.shift, "finite numbers"));
  if (!(g.tip_radius_mm > 0.0))
    return fail(impossible_value("tip_diameter_mm", 2.0 * g.tip_radius_mm, "a tip circle above 0"));
  return {};
}

}  // namespace

Error no_tooth(std::string key, double value, std::string message, std::string remedy) {
  return {.code = ErrorCode::kInfeasible,
          .message = std::move(message),
          .key = std::move(key),
          .value = trimmed_number(value),
          .remedy = std::move(remedy)};
}

Error impossible_value(std::string key, double value, std::string remedy) {
  return {.code = ErrorCode::kOutOfRange,
          .message = key + " = " + trimmed_number(value) + " cannot be",
          .key = std::move(key),
          .value = trimmed_number(value),
          .remedy = std::move(remedy)};
}

Result<ToothProfile> ProfileBuilder::build() {
  if (auto ok = check_values(g()); !ok) return fail(ok.error());
  base_radius_mm_ = base_radius_mm(g());
  base_half_angle_rad_ = base_half_angle_rad(g());
  auto made = g().kind == GearKind::kExternal ? build_external() : build_ring();
  if (!made) return fail(made.error());
  return std::move(p_);
}

double ProfileBuilder::half_angle_at(double radius_mm) const {
  const double inv =
      involute_function(pressure_angle_at_radius_rad(radius_mm, base_radius_mm_));
  return g().kind == GearKind::kExternal ? base_half_angle_rad_ - inv : base_half_angle_rad_ + inv;
}

/// `least_mm`: the ends are at least that far apart, where more than rounding is known of it.
void ProfileBuilder::add(PieceKind kind, Curve curve, double least_mm) {
  const bool surely = least_mm > 2.0 * tolerance::kShortestPiece_mm;
  if (!surely &&
      (curve.end_point() - curve.start_point()).norm() < tolerance::kShortestPiece_mm)
    return;
  p_.pieces_.push_back({kind, std::move(curve)});
}

void ProfileBuilder::add_arc(PieceKind kind, double radius, double from, double to) {
  if (radius * (to - from) < tolerance::kShortestPiece_mm) return;
  // up to a half turn a chord is at least 2 / pi of its arc
  const double chord = to - from < kPi ? 0.6 * radius * (to - from) : 0.0;
  add(kind, {CircularArc{Point2::Zero(), radius}, from, to}, chord);
}

void ProfileBuilder::add_tip() {
  const double r_b = base_radius_mm_;
  if (g().tip_rounding_mm == 0.0)
    return add_arc(PieceKind::kTip, p_.tip_radius_mm_, 0.0,
                   half_angle_at(std::max(p_.tip_radius_mm_, r_b)));
  add_arc(PieceKind::kTip, p_.tip_radius_mm_, 0.0, polar_angle_rad(rounding_.start_point()));
  add(PieceKind::kTipRounding, rounding_);
}

void ProfileBuilder::add_involute(double from_roll_mm, double to_roll_mm) {
  const double r_b = base_radius_mm_;
  const int sense = g().kind == GearKind::kExternal ? -1 : 1;
  add(PieceKind::kInvolute,
      {Involute{r_b, base_half_angle_rad_, sense}, from_roll_mm / r_b, to_roll_mm / r_b},
      std::abs(radius_at(from_roll_mm) - radius_at(to_roll_mm)));
}

/// The arc's centre lies on the involute parallel to the flank, the radius inside the tooth: turned by
/// rho / r_b, met at the circle r_a - rho (ring: r_a + rho).
Status ProfileBuilder::round_tip() {
  const double rho = g().tip_rounding_mm;
  if (rho == 0.0) return {};
  constexpr const char* kKey = "modifications.tip_rounding_mm";
  if (!(rho > 0.0) || !std::isfinite(rho)) return fail(impossible_value(kKey, rho, "0 or more"));
  const std::string none = "no tip_rounding_mm";
  if (p_.notes_.pointed || p_.notes_.tip_trimmed || p_.notes_.tip_inside_base) {
    const std::string why = p_.notes_.pointed ? "the tooth is pointed"
                            : p_.notes_.tip_trimmed
                                ? "the cutter trims the tip corner"
                                : "the tip circle lies inside the base circle";
    return fail(no_tooth(kKey, rho, why + ": there is no corner of tip circle and flank to round",
                         none + ", or another tip_diameter_mm"));
  }
  const double r_b = base_radius_mm_, r_a = p_.tip_radius_mm_;
  const double sense = g().kind == GearKind::kExternal ? 1.0 : -1.0;
  const auto centre_angle = [&](double radius) {
    const double inv = involute_function(
        pressure_angle_at_radius_rad(std::max(r_a - sense * radius, r_b), r_b));
    return base_half_angle_rad_ - radius / r_b - sense * inv;
  };
  const auto contact_roll = [&](double radius) {
    return roll_length_mm(r_a - sense * radius, r_b) + sense * radius;
  };
  const double root_roll = roll_length_mm(p_.root_form_radius_mm_, r_b);
  const auto room = [&](double radius) {  // > 0: it fits
    if (!(r_a - sense * radius > r_b)) return -1.0;
    const double flank_left = sense * (contact_roll(radius) - root_roll);
    return std::min(centre_angle(radius) * r_a, flank_left);
  };
  if (!(room(rho) >= 0.0)) {
    const double most =
        sides_of_change([&](double radius) { return room(radius) >= 0.0; }, 0.0, rho, 60).first;
    return fail(no_tooth(kKey, rho,
                         "no room for this rounding on a tip land of " +
                         trimmed_number(2.0 * r_a * half_angle_at(r_a)) + " mm",
                         "at most " + trimmed_number(most)));
  }
  const double roll = contact_roll(rho), angle = centre_angle(rho);
  p_.tip_form_radius_mm_ = radius_at(roll);
  // The flank's normal out of the material is the base tangent, at -+ 90 degrees from its radius.
  const double normal = g().kind == GearKind::kExternal
                            ? base_half_angle_rad_ - roll / r_b + 0.5 * kPi
                            : base_half_angle_rad_ + roll / r_b + 0.5 * kPi;
  const double at_tip = g().kind == GearKind::kExternal ? angle : angle + kPi;
  rounding_ = {CircularArc{(r_a - sense * rho) * unit_vector(angle), rho}, at_tip, normal};
  return {};
}

Result<ToothProfile> ToothProfile::make(const Gear& gear) { return ProfileBuilder(gear).build(); }

ToothProfile ToothProfile::with_pieces(std::vector<ProfilePiece> pieces,
                                       std::vector<ProfilePiece> clockwise) const {
  ToothProfile other = *this;
  other.pieces_ = std::move(pieces);
  other.clockwise_ = std::move(clockwise);
  return other;
}

ToothProfile ToothProfile::mirror_image() const {
  ToothProfile other = *this;
  if (!symmetric()) std::swap(other.pieces_, other.clockwise_);
  return other;
}

double ToothProfile::root_form_roll_length_mm() const {
  return roll_length_mm(root_form_radius_mm_, base_radius_mm(gear_));
}
double ToothProfile::tip_form_roll_length_mm() const {
  return roll_length_mm(tip_form_radius_mm_, base_radius_mm(gear_));
}
double ToothProfile::tip_thickness_mm() const {
  const ProfilePiece &first = pieces_.front(), &other = clockwise_pieces().front();
  if (first.kind != PieceKind::kTip || other.kind != PieceKind::kTip) return 0.0;
  return tip_radius_mm_ *
         ((first.curve.end - first.curve.begin) + (other.curve.end - other.curve.begin));
}

}  // namespace trueflank
