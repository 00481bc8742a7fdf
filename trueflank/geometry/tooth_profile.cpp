// SPDX-License-Identifier: GPL-3.0-or-later
//
// Builds the half tooth from the tip inwards. The involute's ends are found first: the root form
// point by the geometry of the tool's corner, the tip point by the tip circle or the flanks' meeting.
#include "trueflank/geometry/tooth_profile.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "trueflank/base/tolerance.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/protuberance.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

std::string text(double value) {
  std::string s = std::to_string(value);
  s.erase(s.find_last_not_of('0') + 1);
  if (!s.empty() && s.back() == '.') s.pop_back();
  return s;
}

Error infeasible(std::string key, double value, std::string message, std::string remedy) {
  return {.code = ErrorCode::kInfeasible,
          .message = std::move(message),
          .key = std::move(key),
          .value = text(value),
          .remedy = std::move(remedy)};
}

Error out_of_range(std::string key, double value, std::string remedy) {
  return {.code = ErrorCode::kOutOfRange,
          .message = key + " = " + text(value) + " cannot be",
          .key = std::move(key),
          .value = text(value),
          .remedy = std::move(remedy)};
}

Status check_values(const Gear& g) {
  if (g.teeth < 3) return fail(out_of_range("teeth", g.teeth, "at least 3 teeth"));
  if (!(g.normal_module_mm > 0.0) || !std::isfinite(g.normal_module_mm))
    return fail(out_of_range("module_mm", g.normal_module_mm, "a module above 0"));
  const double a = g.rack.pressure_angle_rad;
  if (!(a > rad_from_deg(1.0) && a < rad_from_deg(45.0)))
    return fail(out_of_range("rack.pressure_angle_deg", deg_from_rad(a), "between 1 and 45 degrees"));
  if (!(std::abs(g.helix_angle_rad) < rad_from_deg(60.0)))
    return fail(out_of_range("helix_angle_deg", deg_from_rad(g.helix_angle_rad), "within +-60 degrees"));
  if (!(g.rack.root_radius >= 0.0))
    return fail(out_of_range("rack.root_radius", g.rack.root_radius, "0 or more"));
  if (!(g.rack.dedendum > 0.0) || !(g.rack.addendum > 0.0))
    return fail(out_of_range("rack.dedendum", g.rack.dedendum, "addendum and dedendum above 0"));
  if (!(g.rack.protuberance >= 0.0) || !(g.rack.grinding_stock >= 0.0) ||
      (g.rack.grinding_stock > 0.0 && !(g.rack.grinding_stock < g.rack.protuberance)))
    return fail(out_of_range("rack.grinding_stock", g.rack.grinding_stock,
                             "less than the protuberance: grinding would leave a step"));
  if (g.rack.protuberance > 0.0 && !(g.rack.protuberance_angle_rad > rad_from_deg(1.0) &&
                                     g.rack.protuberance_angle_rad < a))
    return fail(out_of_range("rack.protuberance_angle_deg",
                             deg_from_rad(g.rack.protuberance_angle_rad),
                             "above 1 degree and below the pressure angle"));
  if (!std::isfinite(g.shift) || !std::isfinite(g.thinning_mm) || !std::isfinite(g.tip_radius_mm))
    return fail(out_of_range("shift", g.shift, "finite numbers"));
  if (!(g.tip_radius_mm > 0.0))
    return fail(out_of_range("tip_diameter_mm", 2.0 * g.tip_radius_mm, "a tip circle above 0"));
  return {};
}

}  // namespace

class ProfileBuilder {
 public:
  explicit ProfileBuilder(const Gear& gear) { p_.gear_ = gear; }

  Result<ToothProfile> build() {
    if (auto ok = check_values(g()); !ok) return fail(ok.error());
    auto made = g().kind == GearKind::kExternal ? build_external() : build_ring();
    if (!made) return fail(made.error());
    return std::move(p_);
  }

 private:
  [[nodiscard]] const Gear& g() const { return p_.gear_; }
  double gap_angle() const { return kPi / g().teeth; }
  double radius_at(double roll_mm) const { return std::hypot(base_radius_mm(g()), roll_mm); }

  void add(PieceKind kind, Curve curve) {
    if ((curve.end_point() - curve.start_point()).norm() < tolerance::kShortestPiece_mm) return;
    p_.pieces_.push_back({kind, std::move(curve)});
  }
  void add_arc(PieceKind kind, double radius, double from, double to) {
    if (radius * (to - from) < tolerance::kShortestPiece_mm) return;
    add(kind, {CircularArc{Point2::Zero(), radius}, from, to});
  }
  /// The tip's land, and its rounding into the flank where there is one.
  void add_tip() {
    const double r_b = base_radius_mm(g());
    if (g().tip_rounding_mm == 0.0)
      return add_arc(PieceKind::kTip, p_.tip_radius_mm_, 0.0,
                     tooth_half_angle_rad(g(), std::max(p_.tip_radius_mm_, r_b)));
    add_arc(PieceKind::kTip, p_.tip_radius_mm_, 0.0, polar_angle_rad(rounding_.start_point()));
    add(PieceKind::kTipRounding, rounding_);
  }
  void add_involute(double from_roll_mm, double to_roll_mm) {
    const double r_b = base_radius_mm(g());
    const int sense = g().kind == GearKind::kExternal ? -1 : 1;
    add(PieceKind::kInvolute,
        {Involute{r_b, base_half_angle_rad(g()), sense}, from_roll_mm / r_b, to_roll_mm / r_b});
  }

  Status build_external();
  Status find_pointed_tip();
  Status round_tip();
  Status find_undercut(const Curve& fillet, double& fillet_end);

  Status build_ring();
  Status ring_ends();
  Status ring_fillet_root();
  Status ring_shaper_root();
  Status trim_ring_tip(const CutterTrochoid& fillet, double eta_joint);

  ToothProfile p_;
  Curve rounding_;  ///< of the tip corner, where there is one
};

// ---------------------------------------------------------------- tip rounding

/// The arc's centre lies on the involute parallel to the flank, the radius inside the tooth: turned by
/// rho / r_b, met at the circle r_a - rho (ring: r_a + rho).
Status ProfileBuilder::round_tip() {
  const double rho = g().tip_rounding_mm;
  if (rho == 0.0) return {};
  constexpr const char* kKey = "modifications.tip_rounding_mm";
  if (!(rho > 0.0) || !std::isfinite(rho)) return fail(out_of_range(kKey, rho, "0 or more"));
  const std::string none = "no tip_rounding_mm";
  if (p_.notes_.pointed || p_.notes_.tip_trimmed || p_.notes_.tip_inside_base) {
    const std::string why = p_.notes_.pointed ? "the tooth is pointed"
                            : p_.notes_.tip_trimmed
                                ? "the cutter trims the tip corner"
                                : "the tip circle lies inside the base circle";
    return fail(infeasible(kKey, rho, why + ": there is no corner of tip circle and flank to round",
                           none + ", or another tip_diameter_mm"));
  }
  const double r_b = base_radius_mm(g()), r_a = p_.tip_radius_mm_;
  const double sense = g().kind == GearKind::kExternal ? 1.0 : -1.0;
  const auto centre_angle = [&](double radius) {
    const double inv = involute_function(
        pressure_angle_at_radius_rad(std::max(r_a - sense * radius, r_b), r_b));
    return base_half_angle_rad(g()) - radius / r_b - sense * inv;
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
    double low = 0.0, high = rho;
    for (int i = 0; i < 60; ++i) (room(0.5 * (low + high)) >= 0.0 ? low : high) = 0.5 * (low + high);
    return fail(infeasible(kKey, rho,
                           "no room for this rounding on a tip land of " +
                               text(2.0 * r_a * tooth_half_angle_rad(g(), r_a)) + " mm",
                           "at most " + text(low)));
  }
  const double roll = contact_roll(rho), angle = centre_angle(rho);
  p_.tip_form_radius_mm_ = radius_at(roll);
  // The flank's normal out of the material is the base tangent, at -+ 90 degrees from its radius.
  const double normal = g().kind == GearKind::kExternal
                            ? base_half_angle_rad(g()) - roll / r_b + 0.5 * kPi
                            : base_half_angle_rad(g()) + roll / r_b + 0.5 * kPi;
  const double at_tip = g().kind == GearKind::kExternal ? angle : angle + kPi;
  rounding_ = {CircularArc{(r_a - sense * rho) * unit_vector(angle), rho}, at_tip, normal};
  return {};
}

// ---------------------------------------------------------------- external

Status ProfileBuilder::find_pointed_tip() {
  const double r_b = base_radius_mm(g());
  p_.tip_radius_mm_ = g().tip_radius_mm;
  if (base_half_angle_rad(g()) <= 0.0)
    return fail(infeasible("shift", g().shift,
                           "the teeth have no thickness left at the base circle",
                           "a larger profile shift or less thinning"));
  if (tooth_half_angle_rad(g(), g().tip_radius_mm) < 0.0) {
    p_.notes_.pointed = true;
    p_.tip_radius_mm_ = r_b / std::cos(inverse_involute_rad(base_half_angle_rad(g())));
  }
  return {};
}

Status ProfileBuilder::find_undercut(const Curve& fillet, double& fillet_end) {
  // Seen along the trochoid from its joint with the rack's flank inwards, it starts on the gap's
  // side of the involute and dives into the tooth: that crossing is where the involute ends.
  const double r_b = base_radius_mm(g());
  const double psi = base_half_angle_rad(g());
  const auto outside = [&](double t) {
    const Point2 q = point_at(fillet, t);
    const double r = q.norm();
    // below the base circle there is no involute; count it by the base point's angle
    const double inv = involute_function(pressure_angle_at_radius_rad(r, r_b));
    return polar_angle_rad(q) - (psi - inv);
  };
  // Dense near the joint, where a slight undercut crosses; in finer steps where coarse ones find none.
  const double span = fillet.begin - fillet.end;
  for (const int steps : {50, 400}) {
    double last = fillet.end;
    for (int i = 1; i <= steps; ++i) {
      const double u = static_cast<double>(i) / steps;
      const double t = fillet.end + span * u * u;
      if (outside(t) < 0.0) {
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

Status ProfileBuilder::build_external() {
  const double m = g().normal_module_mm;
  const double r = reference_radius_mm(g()), r_b = base_radius_mm(g());
  const double alpha_n = g().rack.pressure_angle_rad;
  const double alpha_t = transverse_pressure_angle_rad(g());
  const double stretch = 1.0 / std::cos(g().helix_angle_rad);
  const double full_round = full_round_coefficient(g().rack);
  if (full_round < 0.0)
    return fail(infeasible("rack.dedendum", g().rack.dedendum,
                           "the tooth of the rack is pointed before it reaches its depth",
                           "a dedendum of at most " + text(0.25 * kPi / std::tan(alpha_n))));
  double rho = g().rack.root_radius;
  if (rho > full_round) {
    rho = full_round;
    p_.notes_.full_round = true;
  }
  p_.root_radius_coefficient_ = rho;
  const double depth = m * (g().rack.dedendum - g().shift);
  const double root_radius = r - depth;
  if (!(root_radius > 0.0))
    return fail(infeasible("shift", g().shift, "the root circle has no radius left",
                           "more teeth or a larger profile shift"));
  p_.root_radius_mm_ = root_radius;
  if (auto ok = find_pointed_tip(); !ok) return ok;
  if (p_.tip_radius_mm_ <= root_radius)
    return fail(infeasible("tip_diameter_mm", 2.0 * p_.tip_radius_mm_,
                           "the tip circle lies inside the root circle",
                           "a tip diameter above " + text(2.0 * root_radius)));

  const double half_land = 0.25 * kPi - g().rack.dedendum * std::tan(alpha_n) -
                           rho * (1.0 - std::sin(alpha_n)) / std::cos(alpha_n) +
                           residual_protuberance(g().rack) / std::cos(alpha_n);
  const RackTrochoid corner{.pitch_radius_mm = r,
                            .corner_depth_mm = depth - rho * m,
                            .corner_offset_mm = stretch * m * std::max(half_land, 0.0) +
                                                0.5 * g().thinning_mm,
                            .corner_radius_mm = rho * m,
                            .stretch = stretch,
                            .gap_angle_rad = gap_angle()};
  const double root_end = gap_angle() - corner.corner_offset_mm / r;
  Curve fillet{corner, alpha_n, 0.5 * kPi};  // from the involute to the root circle
  std::optional<Curve> protuberance_side;

  // Roll length where the rack's straight flank stops touching.
  const double joint_depth = corner.corner_depth_mm + corner.corner_radius_mm * std::sin(alpha_n);
  const double joint_roll = r * std::sin(alpha_t) - joint_depth / std::sin(alpha_t);
  if (residual_protuberance(g().rack) > 0.0) {
    p_.notes_.protuberance_undercut_mm = m * residual_protuberance(g().rack);
    p_.notes_.undercut = joint_roll < 0.0;
    const auto cut = cut_protuberance(g(), corner, p_.tip_radius_mm_);
    if (!cut)
      return fail(infeasible("rack.protuberance", g().rack.protuberance,
                             "the protuberance takes the whole flank away",
                             "a smaller protuberance or a larger protuberance_angle_deg"));
    fillet = cut->fillet;
    protuberance_side = cut->side;
    p_.root_form_radius_mm_ = cut->root_form_radius_mm;
  } else if (joint_roll < 0.0) {
    Curve from_root{corner, 0.5 * kPi, alpha_n};
    p_.notes_.undercut = true;
    if (auto ok = find_undercut(from_root, fillet.begin); !ok) return ok;
    p_.notes_.undercut = fillet.begin > alpha_n;
  } else {
    p_.root_form_radius_mm_ = radius_at(joint_roll);
  }
  if (p_.root_form_radius_mm_ >= p_.tip_radius_mm_)
    return fail(infeasible("teeth", g().teeth,
                           "the fillet of the tool reaches diameter " +
                               text(2.0 * p_.root_form_radius_mm_) +
                               " mm, the tooth ends at " + text(2.0 * p_.tip_radius_mm_) +
                               " mm: no involute is left",
                           "a larger profile shift, more teeth or a larger tip diameter"));
  // narrowest place of the foot: looked at closely only where it may be none
  double waist = kPi;
  for (const int steps : {16, 64}) {
    double last = polar_angle_rad(point_at(fillet, fillet.begin)), widest_step = 0.0;
    waist = last;
    for (int i = 1; i <= steps; ++i) {
      const double t = fillet.begin + (fillet.end - fillet.begin) * i / steps;
      const double angle = polar_angle_rad(point_at(fillet, t));
      waist = std::min(waist, angle);
      widest_step = std::max(widest_step, std::abs(angle - last));
      last = angle;
    }
    if (waist > widest_step) break;
  }
  if (waist <= 0.0 || root_end <= 0.0)
    return fail(infeasible("shift", g().shift, "the tool cuts the tooth off at its foot",
                           "a larger profile shift or more teeth"));

  p_.tip_form_radius_mm_ = p_.tip_radius_mm_;
  if (auto ok = round_tip(); !ok) return ok;
  const double roll_root = roll_length_mm(p_.root_form_radius_mm_, r_b);
  const double roll_tip = roll_length_mm(p_.tip_form_radius_mm_, r_b);
  if (!p_.notes_.pointed) add_tip();
  add_involute(roll_tip, roll_root);
  if (protuberance_side) add(PieceKind::kFillet, *protuberance_side);
  add(PieceKind::kFillet, fillet);
  add_arc(PieceKind::kRoot, root_radius, root_end, gap_angle());
  return {};
}

// ---------------------------------------------------------------- ring

Status ProfileBuilder::ring_ends() {
  const double r_b = base_radius_mm(g());
  const double psi = base_half_angle_rad(g());
  p_.root_radius_mm_ = nominal_root_radius_mm(g());
  p_.tip_radius_mm_ = g().tip_radius_mm;
  if (!(p_.root_radius_mm_ > r_b))
    return fail(infeasible("shift", g().shift, "the ring's root circle lies inside its base circle",
                           "a larger profile shift"));
  if (p_.tip_radius_mm_ >= p_.root_radius_mm_)
    return fail(infeasible("tip_diameter_mm", 2.0 * p_.tip_radius_mm_,
                           "the ring's tip circle lies outside its root circle",
                           "a tip diameter below " + text(2.0 * p_.root_radius_mm_)));
  if (psi + involute_function(pressure_angle_at_radius_rad(p_.root_radius_mm_, r_b)) >=
      gap_angle()) {
    p_.notes_.space_closed = true;
    p_.root_radius_mm_ = r_b / std::cos(inverse_involute_rad(gap_angle() - psi));
  }
  if (psi >= gap_angle())
    return fail(infeasible("shift", g().shift, "the ring's tooth spaces are closed",
                           "a larger profile shift"));
  const double tip_half = tooth_half_angle_rad(g(), std::max(p_.tip_radius_mm_, r_b));
  if (tip_half < 0.0) {
    p_.notes_.pointed = true;
    // psi < 0: the flanks meet where inv a = -psi
    p_.tip_radius_mm_ = r_b / std::cos(inverse_involute_rad(-psi));
    if (p_.tip_radius_mm_ >= p_.root_radius_mm_)
      return fail(infeasible("shift", g().shift, "the ring's teeth have no thickness left",
                             "a smaller profile shift"));
  }
  if (p_.tip_radius_mm_ < r_b * (1.0 - 1e-12)) p_.notes_.tip_inside_base = true;
  p_.tip_form_radius_mm_ = std::max(p_.tip_radius_mm_, r_b);
  return {};
}

Status ProfileBuilder::build_ring() {
  if (auto ok = ring_ends(); !ok) return ok;
  const double r_b = base_radius_mm(g());
  const double psi = base_half_angle_rad(g());
  // The root first: it may trim the tip.
  std::vector<ProfilePiece> tip_pieces;
  auto root = g().ring_root == RingRoot::kFillet ? ring_fillet_root() : ring_shaper_root();
  if (!root) return root;
  if (p_.root_form_radius_mm_ <= p_.tip_form_radius_mm_)
    return fail(infeasible("shift", g().shift,
                           "the ring's fillet starts at diameter " +
                               text(2.0 * p_.root_form_radius_mm_) + " mm, inside its tip circle " +
                               text(2.0 * p_.tip_form_radius_mm_) + " mm: no involute is left",
                           "a smaller root_radius or larger cutter, or a smaller tip diameter"));
  if (auto ok = round_tip(); !ok) return ok;
  // root pieces (and a trimmed tip) are in pieces_ already, from the tip outwards: put the rest before
  std::vector<ProfilePiece> rest = std::move(p_.pieces_);
  p_.pieces_.clear();
  const auto is_trim = [](const ProfilePiece& piece) { return piece.kind == PieceKind::kTrim; };
  const auto trim = std::find_if(rest.begin(), rest.end(), is_trim);
  if (trim != rest.end()) {
    add_arc(PieceKind::kTip, p_.tip_radius_mm_, 0.0,
            polar_angle_rad(trim->curve.start_point()));
    p_.pieces_.push_back(*trim);
    rest.erase(trim);
  } else {
    if (!p_.notes_.pointed) add_tip();
    if (p_.notes_.tip_inside_base)
      add(PieceKind::kRadial,
          {StraightLine{Point2::Zero(), unit_vector(psi)}, p_.tip_radius_mm_, r_b});
  }
  add_involute(roll_length_mm(p_.tip_form_radius_mm_, r_b),
               roll_length_mm(p_.root_form_radius_mm_, r_b));
  p_.pieces_.insert(p_.pieces_.end(), rest.begin(), rest.end());
  return {};
}

Status ProfileBuilder::ring_fillet_root() {
  const double r_b = base_radius_mm(g()), r_f = p_.root_radius_mm_;
  const double psi = base_half_angle_rad(g());
  // Angle of the centre of a circle of radius rho that touches flank and root circle.
  const auto centre_angle = [&](double rho) {
    return psi + rho / r_b + involute_function(pressure_angle_at_radius_rad(r_f - rho, r_b));
  };
  double rho = g().rack.root_radius * g().normal_module_mm;
  const double largest = r_f - r_b;  // its centre must not come inside the base circle
  if (rho > largest || centre_angle(rho) > gap_angle()) {
    p_.notes_.full_round = true;
    if (p_.notes_.space_closed) {
      rho = 0.0;
    } else {
      // d(angle)/d(rho) > 0 as long as the centre is outside the base circle
      rho = centre_angle(largest) <= gap_angle()
                ? largest
                : find_root([&](double t) { return centre_angle(t) - gap_angle(); }, 0.0, largest);
    }
  }
  p_.root_radius_coefficient_ = rho / g().normal_module_mm;
  const double roll = roll_length_mm(r_f - rho, r_b) + rho;
  p_.root_form_radius_mm_ = radius_at(roll);
  const double angle = rho > 0.0 ? std::min(centre_angle(rho), gap_angle())
                                 : tooth_half_angle_rad(g(), r_f);
  if (rho > 0.0) {
    // From the flank's touching point (inward normal of the space) to the root circle.
    const double from = psi + roll / r_b - 0.5 * kPi;
    add(PieceKind::kFillet, {CircularArc{(r_f - rho) * unit_vector(angle), rho}, from, angle});
  }
  add_arc(PieceKind::kRoot, r_f, angle, gap_angle());
  return {};
}

Status ProfileBuilder::ring_shaper_root() {
  if (!g().cutter)
    return fail({.code = ErrorCode::kMissingKey,
                 .message = "root = \"shaper\" needs a cutter",
                 .key = "cutter",
                 .remedy = "a table [<ring>.cutter] with teeth, shift, tip_radius"});
  const ShaperCutter& cutter = *g().cutter;
  const double m = transverse_module_mm(g()), m_n = g().normal_module_mm;
  const double alpha_n = g().rack.pressure_angle_rad;
  const double alpha = transverse_pressure_angle_rad(g());
  const int z = g().teeth, z_c = cutter.teeth;
  if (z_c < 3 || z_c >= z)
    return fail(out_of_range("cutter.teeth", z_c, "at least 3 and fewer than the ring's " +
                                                      std::to_string(z)));
  if (!(cutter.tip_radius >= 0.0))
    return fail(out_of_range("cutter.tip_radius", cutter.tip_radius, "0 or more"));
  const double inv_w = involute_function(alpha) +
                       2.0 * std::tan(alpha_n) * (g().shift - cutter.shift) / (z - z_c);
  if (!(inv_w > 0.0))
    return fail(infeasible("cutter.shift", cutter.shift,
                           "cutter and ring do not mesh without backlash at any centre distance",
                           "a smaller cutter shift"));
  const double alpha_w = inverse_involute_rad(inv_w);
  const double a = 0.5 * m * (z - z_c) * std::cos(alpha) / std::cos(alpha_w);
  const double cutter_tip = p_.root_radius_mm_ - a;
  const double r_bc = 0.5 * m * z_c * std::cos(alpha);
  const double pitch_c = r_bc / std::cos(alpha_w);
  if (!(cutter_tip > r_bc))
    return fail(infeasible("cutter.teeth", z_c, "the cutter's tip circle lies inside its base circle",
                           "a cutter with a larger shift or fewer teeth"));
  const double psi_c = 0.5 * kPi / z_c + 2.0 * cutter.shift * std::tan(alpha_n) / z_c +
                       involute_function(alpha) + 0.5 * g().thinning_mm / (0.5 * m * z_c);
  const auto corner_angle = [&](double rho) {
    return psi_c - rho / r_bc -
           involute_function(pressure_angle_at_radius_rad(cutter_tip - rho, r_bc));
  };
  if (corner_angle(0.0) < 0.0)
    return fail(infeasible("cutter.shift", cutter.shift,
                           "the cutter's teeth are pointed before they reach the ring's root circle",
                           "a smaller cutter shift or a smaller dedendum"));
  double rho = cutter.tip_radius * m_n;
  const double largest = cutter_tip - r_bc;
  if (rho > largest || corner_angle(rho) < 0.0) {
    p_.notes_.full_round = true;
    rho = corner_angle(largest) >= 0.0 ? largest
                                       : find_root(corner_angle, 0.0, largest);
  }
  p_.root_radius_coefficient_ = rho / m_n;
  const double roll_c = roll_length_mm(cutter_tip - rho, r_bc) + rho;  // at the corner's joint
  const CutterTrochoid corner{.centre_distance_mm = a,
                              .cutter_pitch_radius_mm = pitch_c,
                              .corner_centre_radius_mm = cutter_tip - rho,
                              .corner_centre_angle_rad = std::max(corner_angle(rho), 0.0),
                              .corner_radius_mm = rho,
                              .ratio = static_cast<double>(z_c) / z,
                              .gap_angle_rad = gap_angle()};
  const double eta_joint = 0.5 * kPi + psi_c - roll_c / r_bc;
  p_.root_form_radius_mm_ = radius_at(a * std::sin(alpha_w) + roll_c);
  const double r_b = base_radius_mm(g());
  const double first_roll = a * std::sin(alpha_w);  // the cutter's involute starts on its base circle
  if (roll_length_mm(p_.tip_form_radius_mm_, r_b) < first_roll) {
    // Inside this the cutter has no involute flank to generate with.
    return fail(infeasible("tip_diameter_mm", 2.0 * p_.tip_radius_mm_,
                           "a cutter with " + std::to_string(z_c) +
                               " teeth generates the ring's involute only outside diameter " +
                               text(2.0 * radius_at(first_roll)) + " mm",
                           "tip_diameter_mm of at least that, a larger shift, or a cutter with "
                           "more teeth"));
  }
  if (auto ok = trim_ring_tip(corner, eta_joint); !ok) return ok;
  add(PieceKind::kFillet, {corner, eta_joint, corner.corner_centre_angle_rad});
  add_arc(PieceKind::kRoot, p_.root_radius_mm_,
          gap_angle() - corner.corner_centre_angle_rad * corner.ratio, gap_angle());
  return {};
}

Status ProfileBuilder::trim_ring_tip(const CutterTrochoid& fillet, double eta_joint) {
  // Rolling out of the gap, the cutter's corner sweeps past the ring's tip. Its envelope there is
  // the second contact of the same corner arc; where it runs inside the tooth, it trims.
  CutterTrochoid sweep = fillet;
  sweep.contact = CutterContact::kTrimming;
  const Curve envelope{sweep, sweep.corner_centre_angle_rad, eta_joint};
  const double r_b = base_radius_mm(g());
  const double psi = base_half_angle_rad(g());
  const auto depth = [&](double eta) {  // < 0: inside the tooth, past the flank
    const Point2 q = point_at(envelope, eta);
    const double inv = involute_function(pressure_angle_at_radius_rad(q.norm(), r_b));
    return polar_angle_rad(q) - (psi + inv);
  };
  const auto beyond_tip = [&](double eta) {
    return point_at(envelope, eta).norm() - p_.tip_radius_mm_;
  };
  constexpr int kSteps = 400;
  const double step = (envelope.end - envelope.begin) / kSteps;
  double cut_tip = kNaN, cut_flank = kNaN;
  for (int i = 0; i < kSteps; ++i) {
    const double u = envelope.begin + step * i, v = u + step;
    if (beyond_tip(u) * beyond_tip(v) < 0.0) {
      const double at = find_root(beyond_tip, u, v);
      if (depth(at) < 0.0) cut_tip = at;
    }
    if (depth(u) * depth(v) < 0.0) {
      const double at = find_root(depth, u, v);
      if (beyond_tip(at) > 0.0 && point_at(envelope, at).norm() < p_.root_form_radius_mm_)
        cut_flank = at;
    }
  }
  if (std::isnan(cut_tip) || std::isnan(cut_flank)) return {};
  if (polar_angle_rad(point_at(envelope, cut_tip)) <= 0.0)
    return fail(infeasible("cutter.teeth", g().cutter->teeth,
                           "the cutter trims the ring's teeth off at their tips",
                           "a cutter with fewer teeth or a larger tip_diameter_mm"));
  p_.notes_.tip_trimmed = true;
  p_.notes_.pointed = false;
  p_.tip_form_radius_mm_ = point_at(envelope, cut_flank).norm();
  add(PieceKind::kTrim, {sweep, cut_tip, cut_flank});
  return {};
}

// ---------------------------------------------------------------- public

Result<ToothProfile> ToothProfile::make(const Gear& gear) { return ProfileBuilder(gear).build(); }

ToothProfile ToothProfile::with_pieces(std::vector<ProfilePiece> pieces) const {
  ToothProfile other = *this;
  other.pieces_ = std::move(pieces);
  return other;
}

double ToothProfile::root_form_roll_length_mm() const {
  return roll_length_mm(root_form_radius_mm_, base_radius_mm(gear_));
}
double ToothProfile::tip_form_roll_length_mm() const {
  return roll_length_mm(tip_form_radius_mm_, base_radius_mm(gear_));
}
double ToothProfile::tip_thickness_mm() const {
  const ProfilePiece& first = pieces_.front();
  if (first.kind != PieceKind::kTip) return 0.0;
  return 2.0 * tip_radius_mm_ * (first.curve.end - first.curve.begin);
}

}  // namespace trueflank
