// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueflank/geometry/gear_pair.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/search/search_corner.h"

namespace trueflank {
namespace {

/// Clearances that differ by less are the same; what is exactly kept is kept by a hair, more than
/// the reserve that a climb keeps from its limits.
constexpr double kSameClearance = 1e-9, kHair = 2e-7;

double root_radius(const Gear& gear) { return nominal_root_radius_mm(gear); }

/// Roll length at which a gear's involute begins where the rack's straight flank cuts it; below 0:
/// undercut.
double involute_start_mm(const SearchRequirements& r, const Gear& gear) {
  const double sine = std::sin(r.rack.pressure_angle_rad),
               cosine = std::cos(r.rack.pressure_angle_rad);
  const double full_round = (0.25 * kPi - r.rack.dedendum * sine / cosine) * cosine / (1.0 - sine);
  const double rounding = std::clamp(r.rack.root_radius, 0.0, std::max(0.0, full_round));
  // heights are those of the normal section, the involute that of the transverse one
  const double transverse = std::sin(transverse_pressure_angle_rad(gear));
  return reference_radius_mm(gear) * transverse -
         (r.rack.dedendum - rounding * (1.0 - sine) - gear.shift) / transverse;
}

/// Neither undercut nor a fillet shortens the path between the tips on the involute of a gear of
/// which the lowest point of the path has this roll length.
bool surely_whole(const SearchRequirements& r, const Gear& gear, double lowest_mm) {
  const double start = involute_start_mm(r, gear);
  return start >= 0.0 && lowest_mm >= start;
}

/// Distance the tips of planet and ring keep outside the line of action, on the ring's tip circle;
/// positive and smooth where the tip circles do not even cross.
/// Source: the corner of the ring's tip reaches the point where both tip circles cross when the
/// planet's tip corner has already passed it (docs/interference.md).
double trochoid_margin(const Gear& planet, const Gear& ring, double a) {
  const double r1 = planet.tip_radius_mm, r2 = ring.tip_radius_mm;
  const double cos1 = (r2 * r2 - r1 * r1 - a * a) / (2.0 * a * r1);
  const double cos2 = (a * a + r2 * r2 - r1 * r1) / (2.0 * a * r2);
  if (cos1 >= 1.0 || cos2 >= 1.0) return 0.5 + (r2 - r1 - a);
  if (cos1 <= -1.0 || cos2 <= -1.0) return -1.0;
  const double r_b1 = base_radius_mm(planet), r_b2 = base_radius_mm(ring);
  const double inv_w = involute_function(std::acos(std::min(1.0, (r_b2 - r_b1) / a)));
  const double inv1 = involute_function(pressure_angle_at_radius_rad(r1, r_b1));
  const double inv2 = involute_function(pressure_angle_at_radius_rad(r2, r_b2));
  const double theta1 = std::acos(cos1) + inv1 - inv_w;
  const double theta2 = std::acos(cos2);
  return r2 * (theta1 * planet.teeth / ring.teeth + inv_w - inv2 - theta2);
}

/// The meshes' backlash in modules of the layer.
double backlash_of(const SearchRequirements& r, double module_mm) {
  return r.backlash_mm ? *r.backlash_mm / module_mm : kUsualBacklash;
}

/// Least arc at the tip circle: each gear of a mesh is thinned by half of the backlash, a ring by
/// what its planet leaves of it, which is hardly more.
double tip_thickness(const Gear& gear, double backlash) {
  const double thinning = 0.55 * backlash;
  return 2.0 * gear.tip_radius_mm * tooth_half_angle_rad(gear, gear.tip_radius_mm) -
         thinning * gear.tip_radius_mm / reference_radius_mm(gear);
}

void add_contact_ratio_margins(const SearchRequirements& r, const MeshView& view,
                               Margins& margins) {
  margins.add(view.approach + view.recess - r.contact_ratio_min);
  margins.add(r.contact_ratio_max - view.approach - view.recess);
}

void add_internal_clearances(const SearchRequirements& r, const Gear& planet, const Gear& ring,
                             double a, Margins& margins) {
  margins.add(root_radius(ring) - a - planet.tip_radius_mm - r.tip_clearance);
  margins.add(ring.tip_radius_mm - a - root_radius(planet) - r.tip_clearance);
}

}  // namespace

Gear gear_of(const SearchRequirements& r, GearKind kind, int teeth, double shift) {
  Gear gear{.kind = kind,
            .teeth = teeth,
            .normal_module_mm = 1.0,
            .helix_angle_rad = std::abs(r.helix_angle_rad),
            .rack = r.rack,
            .shift = shift};
  if (kind == GearKind::kInternal && r.cutter) {
    gear.ring_root = RingRoot::kShaper;
    gear.cutter = r.cutter;
  }
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

MeshView view_of(const Gear& gear1, const Gear& gear2, double a, double face_width) {
  const bool internal = gear2.kind == GearKind::kInternal;
  const double r_b1 = base_radius_mm(gear1), r_b2 = base_radius_mm(gear2);
  const double sum = internal ? r_b2 - r_b1 : r_b1 + r_b2;
  const double span = std::sqrt(std::max(0.0, a * a - sum * sum));
  const double pitch_point = r_b1 * span / sum;
  const double tip2 = roll_length_mm(gear2.tip_radius_mm, r_b2);
  const double start = internal ? tip2 - span : span - tip2;
  const double base_pitch = kTwoPi * r_b1 / gear1.teeth;
  const double end = roll_length_mm(gear1.tip_radius_mm, r_b1);
  const double base_helix = base_helix_angle_rad(gear1);
  return {.approach = (pitch_point - start) / base_pitch,
          .recess = (end - pitch_point) / base_pitch,
          .span = span,
          .path = {.base_radius1_mm = r_b1,
                   .base_radius2_mm = r_b2,
                   .internal = internal,
                   .pitch_point_mm = pitch_point,
                   .start_mm = start,
                   .end_mm = end,
                   .base_pitch_mm = base_pitch,
                   .overlap_ratio = face_width * std::tan(base_helix) / base_pitch,
                   .base_helix_angle_rad = base_helix}};
}

/// The loss is that of the contact ratios' formula, e1^2 + e2^2 - e1 - e2 + 1, least where both are
/// as close to a half as a whole base pitch allows.
ContactPath best_part(const MeshView& view) {
  ContactPath path = view.path;
  const double approach = std::min(view.approach, std::max(0.5, 1.0 - view.recess)),
               recess = std::min(view.recess, std::max(0.5, 1.0 - view.approach));
  path.start_mm = path.pitch_point_mm - approach * path.base_pitch_mm;
  path.end_mm = path.pitch_point_mm + recess * path.base_pitch_mm;
  return path;
}

double spacing_margin(const SearchRequirements& r, int planets, double a, double tip_radius,
                      double module_mm) {
  if (planets < 2) return 1.0;
  return 2.0 * a * std::sin(kPi / planets) - 2.0 * tip_radius - r.planet_clearance_mm / module_mm;
}

void add_shift_margins(const SearchRequirements& r, double shift, Margins& margins) {
  margins.add(shift - r.shift_min);
  margins.add(r.shift_max - shift);
}

void add_thickness_margins(const SearchRequirements& r, const LayerGears& gears, double module_mm,
                           Margins& margins) {
  const double backlash = backlash_of(r, module_mm);
  const auto add_thickness = [&](const Gear& gear) {
    margins.add(gear.tip_radius_mm > base_radius_mm(gear)
                    ? tip_thickness(gear, backlash) - r.tip_thickness
                    : -1.0);
  };
  if (gears.sun) add_thickness(*gears.sun);
  add_thickness(gears.planet);
  if (gears.ring) {
    add_thickness(*gears.ring);
    margins.add(gears.ring->tip_radius_mm - base_radius_mm(*gears.ring));
  }
}

void add_mesh_margins(const SearchRequirements& r, const LayerGears& gears, const MeshView& outer,
                      const MeshView& inner, double a, Margins& margins) {
  const Gear& planet = gears.planet;
  if (gears.sun) add_contact_ratio_margins(r, outer, margins);
  if (gears.ring) add_contact_ratio_margins(r, inner, margins);
  if (gears.sun) {
    // The tip circles leave exactly dedendum less addendum: where that is asked for, rounding must
    // not decide.
    const bool exact =
        std::abs(r.rack.dedendum - r.rack.addendum - r.tip_clearance) < kSameClearance;
    margins.add(exact ? kHair
                      : a - gears.sun->tip_radius_mm - root_radius(planet) - r.tip_clearance);
    margins.add((exact ? std::max(0.0, gears.shortened_tip - planet.tip_radius_mm) + kHair
                       : a - planet.tip_radius_mm - root_radius(*gears.sun) - r.tip_clearance));
  }
  if (gears.ring) {
    add_internal_clearances(r, planet, *gears.ring, a, margins);
    margins.add(trochoid_margin(planet, *gears.ring, a));
  }
}

bool is_surely_whole(const SearchRequirements& r, const LayerGears& gears, const MeshView& outer,
                     const MeshView& inner) {
  return (!gears.sun || (surely_whole(r, *gears.sun, outer.path.start_mm) &&
                         surely_whole(r, gears.planet, outer.span - outer.path.end_mm))) &&
         (!gears.ring || (!r.cutter && surely_whole(r, gears.planet, inner.path.start_mm)));
}

MeshLoss formula_loss(const SearchRequirements& r, const MeshTeeth& mesh, double approach,
                      double recess) {
  const double value = basic_efficiency({.teeth1 = mesh.teeth1,
                                         .teeth2 = mesh.teeth2,
                                         .internal = mesh.internal,
                                         .approach = approach,
                                         .recess = recess},
                                        r.friction);
  return {value, value};
}

MeshLoss path_loss(const SearchRequirements& r, ContactPath path) {
  // an optimiser passes through shifts that interrupt contact: the loss goes on smoothly there
  path.end_mm = std::max(path.end_mm, path.start_mm + path.base_pitch_mm * (1.0 + 1e-12));
  const SlidingEfficiency s = sliding_efficiency(path, r.friction, kLoadSharing);
  return {s.gear1_driving, s.gear2_driving};
}

ProfileJudge::ProfileJudge(const SearchRequirements& r, LayerSetting setting)
    : r_(&r),
      setting_(std::move(setting)),
      outer_(setting_.gears.sun ? 1 : 0),
      inner_(setting_.gears.ring ? 1 : 0),
      planet_gear_(setting_.gears.planet) {}

const ToothProfile* ProfileJudge::made(const std::optional<Gear>& gear, Maker& profile) {
  if (!profile) profile = ToothProfile::make(*gear);
  return *profile ? &**profile : nullptr;
}

bool ProfileJudge::exists(std::size_t margin) {
  if (!made(planet_gear_, planet_)) return false;
  if (outer_ > 0 && !made(setting_.gears.sun, sun_)) return false;
  return is_outer(margin) || made(setting_.gears.ring, ring_);
}

GearPair ProfileJudge::pair_of(bool outer) {
  const ToothProfile* planet = made(planet_gear_, planet_);
  const double a = setting_.lengths.centre_distance;
  return outer ? GearPair{made(setting_.gears.sun, sun_), planet, a}
               : GearPair{planet, made(setting_.gears.ring, ring_), a};
}

const LineOfAction& ProfileJudge::line_of(bool outer) {
  auto& line = lines_[outer ? 0 : 1];
  if (!line) line = line_of_action(pair_of(outer));
  return *line;
}

CornerLook ProfileJudge::look(std::size_t margin, double enough, int& first) {
  const bool outer = is_outer(margin);
  switch (margin % 3) {
    case 0:
      return look_for_corner_in_gear1(pair_of(outer), enough, first);
    case 1:
      return look_for_corner_in_gear2(pair_of(outer), enough, first);
    default:
      break;
  }
  // the contact that undercut and root form leave
  const LineOfAction& line = line_of(outer);
  return {(line.effective_end_mm - line.effective_start_mm) / line.base_pitch_mm -
          r_->contact_ratio_min};
}

std::optional<double> ProfileJudge::at_sample(std::size_t margin, int sample) {
  if (margin % 3 == 2) return std::nullopt;
  const bool outer = is_outer(margin), in_planet = outer == (margin % 3 == 1);
  const auto& other = outer ? setting_.gears.sun : setting_.gears.ring;
  const ToothProfile* root =
      in_planet ? made(planet_gear_, planet_) : made(other, outer ? sun_ : ring_);
  if (!root) return std::nullopt;
  return corner_clearance_at_sample_mm({.root = root,
                                        .mate = in_planet ? &*other : &*planet_gear_,
                                        .centre_distance_mm = setting_.lengths.centre_distance},
                                       sample);
}

void ProfileJudge::correct_losses(LayerEvaluation& result) {
  if (r_->loss_model == LossModel::kContactRatios) return;
  const auto correct = [&](bool outer, const MeshView& view, MeshLoss& loss) {
    constexpr double kSame_mm = 1e-10;
    const LineOfAction& line = line_of(outer);
    if (line.effective_start_mm > view.path.start_mm + kSame_mm ||
        line.effective_end_mm < view.path.end_mm - kSame_mm)
      loss = path_loss(*r_, contact_path(pair_of(outer), setting_.lengths.face_width));
  };
  if (outer_ > 0 && exists(0)) correct(true, setting_.outer, result.sun_planet);
  if (inner_ > 0 && exists(3 * outer_)) correct(false, setting_.inner, result.planet_ring);
}

void judge_profiles(const SearchRequirements& r, const LayerSetting& setting, Margins& margins,
                    LayerEvaluation& result) {
  ProfileJudge judge(r, setting);
  int anywhere = -1;
  for (std::size_t i = 0; i < judge.count() && judge.exists(i); ++i)
    margins.add(judge.look(i, kLeastOfAll_mm, anywhere).clearance_mm);
  judge.correct_losses(result);
}

}  // namespace trueflank
