// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/profile_builder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {

Status ProfileBuilder::ring_ends() {
  const double r_b = base_radius_mm_;
  const double psi = base_half_angle_rad_;
  p_.root_radius_mm_ = nominal_root_radius_mm(g());
  p_.tip_radius_mm_ = g().tip_radius_mm;
  if (!(p_.root_radius_mm_ > r_b))
    return fail(no_tooth("shift", g().shift, "the ring's root circle lies inside its base circle",
                         "a larger profile shift"));
  if (p_.tip_radius_mm_ >= p_.root_radius_mm_)
    return fail(no_tooth("tip_diameter_mm", 2.0 * p_.tip_radius_mm_,
                         "the ring's tip circle lies outside its root circle",
                         "a tip diameter below " + trimmed_number(2.0 * p_.root_radius_mm_)));
  if (psi >= gap_angle())
    return fail(no_tooth("shift", g().shift, "the ring's tooth spaces are closed",
                         "a larger profile shift"));
  if (psi + involute_function(pressure_angle_at_radius_rad(p_.root_radius_mm_, r_b)) >=
      gap_angle()) {
    p_.notes_.space_closed = true;
    p_.root_radius_mm_ = r_b / std::cos(inverse_involute_rad(gap_angle() - psi));
  }
  const double tip_half = half_angle_at(std::max(p_.tip_radius_mm_, r_b));
  if (tip_half < 0.0) {
    p_.notes_.pointed = true;
    // psi < 0: the flanks meet where inv a = -psi
    p_.tip_radius_mm_ = r_b / std::cos(inverse_involute_rad(-psi));
    if (p_.tip_radius_mm_ >= p_.root_radius_mm_)
      return fail(no_tooth("shift", g().shift, "the ring's teeth have no thickness left",
                           "a smaller profile shift"));
  }
  if (p_.tip_radius_mm_ < r_b * (1.0 - 1e-12)) p_.notes_.tip_inside_base = true;
  p_.tip_form_radius_mm_ = std::max(p_.tip_radius_mm_, r_b);
  return {};
}

Status ProfileBuilder::build_ring() {
  if (auto ok = ring_ends(); !ok) return ok;
  const double r_b = base_radius_mm_;
  const double psi = base_half_angle_rad_;
  // The root first: it may trim the tip.
  std::vector<ProfilePiece> tip_pieces;
  auto root = g().ring_root == RingRoot::kFillet ? ring_fillet_root() : ring_shaper_root();
  if (!root) return root;
  if (p_.root_form_radius_mm_ <= p_.tip_form_radius_mm_)
    return fail(no_tooth("shift", g().shift,
                         "the ring's fillet starts at diameter " +
                         trimmed_number(2.0 * p_.root_form_radius_mm_) + " mm, inside its tip circle " +
                         trimmed_number(2.0 * p_.tip_form_radius_mm_) + " mm: no involute is left",
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
  const double r_b = base_radius_mm_, r_f = p_.root_radius_mm_;
  const double psi = base_half_angle_rad_;
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
                                 : half_angle_at(r_f);
  if (rho > 0.0) {
    // From the flank's touching point (inward normal of the space) to the root circle.
    const double from = psi + roll / r_b - 0.5 * kPi;
    add(PieceKind::kFillet, {CircularArc{(r_f - rho) * unit_vector(angle), rho}, from, angle});
  }
  add_arc(PieceKind::kRoot, r_f, angle, gap_angle());
  return {};
}

Result<ProfileBuilder::ShaperMesh> ProfileBuilder::shaper_mesh(const ShaperCutter& cutter) const {
  const double alpha_n = g().rack.pressure_angle_rad;
  const double alpha = transverse_pressure_angle_rad(g());
  const int z = g().teeth, z_c = cutter.teeth;
  if (z_c < 3 || z_c >= z)
    return fail(impossible_value("cutter.teeth", z_c, "at least 3 and fewer than the ring's " +
                                 std::to_string(z)));
  if (!(cutter.tip_radius >= 0.0))
    return fail(impossible_value("cutter.tip_radius", cutter.tip_radius, "0 or more"));
  const double inv_w = involute_function(alpha) +
                       2.0 * std::tan(alpha_n) * (g().shift - cutter.shift) / (z - z_c);
  if (!(inv_w > 0.0))
    return fail(no_tooth("cutter.shift", cutter.shift,
                         "cutter and ring do not mesh without backlash at any centre distance",
                         "a smaller cutter shift"));
  const double m = transverse_module_mm(g());
  ShaperMesh mesh;
  mesh.pressure_angle_rad = inverse_involute_rad(inv_w);
  mesh.centre_distance_mm = 0.5 * m * (z - z_c) * std::cos(alpha) / std::cos(mesh.pressure_angle_rad);
  mesh.cutter_base_radius_mm = 0.5 * m * z_c * std::cos(alpha);
  mesh.cutter_tip_radius_mm = p_.root_radius_mm_ - mesh.centre_distance_mm;
  mesh.cutter_half_angle_rad = 0.5 * kPi / z_c + 2.0 * cutter.shift * std::tan(alpha_n) / z_c +
                               involute_function(alpha) + 0.5 * g().thinning_mm / (0.5 * m * z_c);
  if (!(mesh.cutter_tip_radius_mm > mesh.cutter_base_radius_mm))
    return fail(no_tooth("cutter.teeth", z_c, "the cutter's tip circle lies inside its base circle",
                         "a cutter with a larger shift or fewer teeth"));
  return mesh;
}

Result<CutterTrochoid> ProfileBuilder::shaper_corner(const ShaperCutter& cutter, const ShaperMesh& mesh) {
  const double r_bc = mesh.cutter_base_radius_mm, tip = mesh.cutter_tip_radius_mm;
  const auto corner_angle = [&](double rho) {
    return mesh.cutter_half_angle_rad - rho / r_bc -
           involute_function(pressure_angle_at_radius_rad(tip - rho, r_bc));
  };
  if (corner_angle(0.0) < 0.0)
    return fail(no_tooth("cutter.shift", cutter.shift,
                         "the cutter's teeth are pointed before they reach the ring's root circle",
                         "a smaller cutter shift or a smaller dedendum"));
  double rho = cutter.tip_radius * g().normal_module_mm;
  const double largest = tip - r_bc;
  if (rho > largest || corner_angle(rho) < 0.0) {
    p_.notes_.full_round = true;
    rho = corner_angle(largest) >= 0.0 ? largest
                                       : find_root(corner_angle, 0.0, largest);
  }
  return CutterTrochoid{.centre_distance_mm = mesh.centre_distance_mm,
                        .cutter_pitch_radius_mm = r_bc / std::cos(mesh.pressure_angle_rad),
                        .corner_centre_radius_mm = tip - rho,
                        .corner_centre_angle_rad = std::max(corner_angle(rho), 0.0),
                        .corner_radius_mm = rho,
                        .ratio = static_cast<double>(cutter.teeth) / g().teeth,
                        .gap_angle_rad = gap_angle()};
}

Status ProfileBuilder::ring_shaper_root() {
  if (!g().cutter)
    return fail({.code = ErrorCode::kMissingKey,
                 .message = "root = \"shaper\" needs a cutter",
                 .key = "cutter",
                 .remedy = "a table [<ring>.cutter] with teeth, shift, tip_radius"});
  const auto mesh = shaper_mesh(*g().cutter);
  if (!mesh) return fail(mesh.error());
  const auto corner = shaper_corner(*g().cutter, *mesh);
  if (!corner) return fail(corner.error());
  const double rho = corner->corner_radius_mm, r_bc = mesh->cutter_base_radius_mm;
  p_.root_radius_coefficient_ = rho / g().normal_module_mm;
  const double roll_c = roll_length_mm(mesh->cutter_tip_radius_mm - rho, r_bc) + rho;  // at the corner's joint
  const double eta_joint = 0.5 * kPi + mesh->cutter_half_angle_rad - roll_c / r_bc;
  // the cutter's involute starts on its base circle
  const double first_roll = mesh->centre_distance_mm * std::sin(mesh->pressure_angle_rad);
  p_.root_form_radius_mm_ = radius_at(first_roll + roll_c);
  if (roll_length_mm(p_.tip_form_radius_mm_, base_radius_mm_) < first_roll) {
    // Inside this the cutter has no involute flank to generate with.
    return fail(no_tooth("tip_diameter_mm", 2.0 * p_.tip_radius_mm_,
                         "a cutter with " + std::to_string(g().cutter->teeth) +
                         " teeth generates the ring's involute only outside diameter " +
                         trimmed_number(2.0 * radius_at(first_roll)) + " mm",
                         "tip_diameter_mm of at least that, a larger shift, or a cutter with "
                         "more teeth"));
  }
  if (auto ok = trim_ring_tip(*corner, eta_joint); !ok) return ok;
  add(PieceKind::kFillet, {*corner, eta_joint, corner->corner_centre_angle_rad});
  add_arc(PieceKind::kRoot, p_.root_radius_mm_,
          gap_angle() - corner->corner_centre_angle_rad * corner->ratio, gap_angle());
  return {};
}

Status ProfileBuilder::trim_ring_tip(const CutterTrochoid& fillet, double eta_joint) {
  // Rolling out of the gap, the cutter's corner sweeps past the ring's tip. Its envelope there is
  // the second contact of the same corner arc; where it runs inside the tooth, it trims.
  CutterTrochoid sweep = fillet;
  sweep.contact = CutterContact::kTrimming;
  const Curve envelope{sweep, sweep.corner_centre_angle_rad, eta_joint};
  const double r_b = base_radius_mm_;
  const double psi = base_half_angle_rad_;
  const auto depth = [&](double eta) {  // < 0: inside the tooth, past the flank
    const Point2 q = point_at(envelope, eta);
    const double inv = involute_function(pressure_angle_at_radius_rad(q.norm(), r_b));
    return polar_angle_rad(q) - (psi + inv);
  };
  const auto beyond_tip = [&](double eta) {
    return point_at(envelope, eta).norm() - p_.tip_radius_mm_;
  };
  constexpr std::size_t kSteps = 400;
  const auto place = [&](std::size_t i) {
    return envelope.begin + (envelope.end - envelope.begin) / kSteps * static_cast<double>(i);
  };
  std::array<double, kSteps + 1> beyond{};
  for (std::size_t i = 0; i <= kSteps; ++i) beyond[i] = beyond_tip(place(i));
  double cut_tip = kNaN, cut_flank = kNaN;
  for (std::size_t i = 0; i < kSteps; ++i)
    if (beyond[i] * beyond[i + 1] < 0.0)
      if (const double at = find_root(beyond_tip, place(i), place(i + 1)); depth(at) < 0.0)
        cut_tip = at;
  if (std::isnan(cut_tip)) return {};
  for (std::size_t i = 0; i < kSteps; ++i) {
    if (std::max(beyond[i], beyond[i + 1]) <= 0.0) continue;  // no flank inside the tip circle
    if (!(depth(place(i)) * depth(place(i + 1)) < 0.0)) continue;
    const double at = find_root(depth, place(i), place(i + 1));
    if (beyond_tip(at) > 0.0 && point_at(envelope, at).norm() < p_.root_form_radius_mm_)
      cut_flank = at;
  }
  if (std::isnan(cut_flank)) return {};
  if (polar_angle_rad(point_at(envelope, cut_tip)) <= 0.0)
    return fail(no_tooth("cutter.teeth", g().cutter->teeth,
                         "the cutter trims the ring's teeth off at their tips",
                         "a cutter with fewer teeth or a larger tip_diameter_mm"));
  p_.notes_.tip_trimmed = true;
  p_.notes_.pointed = false;
  p_.tip_form_radius_mm_ = point_at(envelope, cut_flank).norm();
  add(PieceKind::kTrim, {sweep, cut_tip, cut_flank});
  return {};
}

}  // namespace trueflank
