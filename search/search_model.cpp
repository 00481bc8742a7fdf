// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_model.h"

#include <algorithm>
#include <cmath>

#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/geometry/gear_pair.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/search/search_corner.h"

namespace trueflank {
namespace {

/// Writes margins in order and knows when to stop.
template <std::size_t N>
class Margins {
 public:
  Margins(std::array<double, N>& margins, double stop_below)
      : margins_(margins), stop_below_(stop_below) {
    margins_.fill(-1e9);
  }
  void add(double margin) {
    margins_[next_++] = margin;
    least_ = margin < least_ ? margin : least_;
  }
  [[nodiscard]] bool stop() const { return least_ < stop_below_; }
  [[nodiscard]] double least() const { return next_ == N ? least_ : std::min(least_, -1e9); }

 private:
  std::array<double, N>& margins_;
  double stop_below_;
  std::size_t next_ = 0;
  double least_ = 1e300;
};

Gear gear_of(const SearchRequirements& r, GearKind kind, int teeth, double shift) {
  Gear gear{.kind = kind, .teeth = teeth, .normal_module_mm = 1.0, .rack = r.rack, .shift = shift};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  return gear;
}

double root_radius(const Gear& gear) { return nominal_root_radius_mm(gear); }

/// What a mesh has before its profiles are known: contact ratios and path from the tip circles.
struct MeshView {
  double approach = 0.0, recess = 0.0;
  ContactPath path;
};

MeshView view_of(const Gear& gear1, const Gear& gear2, double a) {
  const bool internal = gear2.kind == GearKind::kInternal;
  const double r_b1 = base_radius_mm(gear1), r_b2 = base_radius_mm(gear2);
  const double sum = internal ? r_b2 - r_b1 : r_b1 + r_b2;
  const double span = std::sqrt(std::max(0.0, a * a - sum * sum));
  const double pitch_point = r_b1 * span / sum;
  const double tip2 = roll_length_mm(gear2.tip_radius_mm, r_b2);
  const double start = internal ? tip2 - span : span - tip2;
  const double base_pitch = kTwoPi * r_b1 / gear1.teeth;
  const double end = roll_length_mm(gear1.tip_radius_mm, r_b1);
  return {.approach = (pitch_point - start) / base_pitch,
          .recess = (end - pitch_point) / base_pitch,
          .path = {.base_radius1_mm = r_b1,
                   .base_radius2_mm = r_b2,
                   .internal = internal,
                   .pitch_point_mm = pitch_point,
                   .start_mm = start,
                   .end_mm = end,
                   .base_pitch_mm = base_pitch}};
}

/// The straight part of the rack's flank cuts no involute away.
bool surely_not_undercut(const SearchRequirements& r, const Gear& gear) {
  const double sine = std::sin(r.rack.pressure_angle_rad), cosine = std::cos(r.rack.pressure_angle_rad);
  const double full_round = (0.25 * kPi - r.rack.dedendum * sine / cosine) * cosine / (1.0 - sine);
  const double rounding = std::clamp(r.rack.root_radius, 0.0, std::max(0.0, full_round));
  return gear.shift >= r.rack.dedendum - rounding * (1.0 - sine) - 0.5 * gear.teeth * sine * sine;
}

/// Distance the tips of planet and ring keep outside the line of action, on the ring's tip circle;
/// positive and smooth where the tip circles do not even cross.
/// Source: the corner of the ring's tip reaches the point where both tip circles cross when the
/// planet's tip corner has already passed it (docs/search.md).
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

/// Least arc at the tip circle: each gear of a mesh is thinned by half of the backlash, a ring by what its planet
/// leaves of it, which is hardly more.
double tip_thickness(const Gear& gear, double backlash) {
  const double thinning = 0.55 * backlash;
  return 2.0 * gear.tip_radius_mm * tooth_half_angle_rad(gear, gear.tip_radius_mm) -
         thinning * gear.tip_radius_mm / reference_radius_mm(gear);
}

/// Tip corners in the mate's roots, both ways, and the contact that undercut and root form leave.
template <class M>
void add_root_margins(const SearchRequirements& r, const GearPair& pair, M& margins) {
  margins.add(corner_clearance_in_gear1_mm(pair));
  margins.add(corner_clearance_in_gear2_mm(pair));
  const LineOfAction line = line_of_action(pair);
  margins.add((line.effective_end_mm - line.effective_start_mm) / line.base_pitch_mm -
              r.contact_ratio_min);
}

template <class M>
void add_contact_ratio_margins(const SearchRequirements& r, const MeshView& view, M& margins) {
  margins.add(view.approach + view.recess - r.contact_ratio_min);
  margins.add(r.contact_ratio_max - view.approach - view.recess);
}

template <class M>
void add_internal_clearances(const SearchRequirements& r, const Gear& planet, const Gear& ring,
                             double a, M& margins) {
  margins.add(root_radius(ring) - a - planet.tip_radius_mm - r.tip_clearance);
  margins.add(ring.tip_radius_mm - a - root_radius(planet) - r.tip_clearance);
}

double spacing_margin(const SearchRequirements& r, double a, double tip_radius, double module_mm) {
  if (r.planets < 2) return 1.0;
  return 2.0 * a * std::sin(kPi / r.planets) - 2.0 * tip_radius - r.planet_clearance_mm / module_mm;
}

}  // namespace

const char* to_text(Limit limit) {
  switch (limit) {
    case Limit::kShift: return "shift";
    case Limit::kContactRatio: return "contact_ratio";
    case Limit::kFillet: return "fillet_interference";
    case Limit::kTipClearance: return "tip_clearance";
    case Limit::kTrochoid: return "trochoid_interference";
    case Limit::kTipThickness: return "tip_thickness";
    case Limit::kPlanetSpacing: return "planet_spacing";
    case Limit::kRingTip: return "ring_tip";
  }
  return "";
}

const std::array<LimitEntry, kLimits>& limit_entries() {
  using enum Limit;
  static const std::array<LimitEntry, kLimits> kEntries{{
      {kShift, 1, "sun"}, {kShift, 1, "sun"}, {kShift, 1, "planet1"}, {kShift, 1, "planet1"},
      {kPlanetSpacing, 1, "planet1"}, {kTipThickness, 1, "sun"}, {kTipThickness, 1, "planet1"},
      {kTipThickness, 1, "ring1"}, {kRingTip, 1, "ring1"},
      {kContactRatio, 1, "sun-planet1"}, {kContactRatio, 1, "sun-planet1"},
      {kContactRatio, 1, "planet1-ring1"}, {kContactRatio, 1, "planet1-ring1"},
      {kTipClearance, 1, "sun-planet1"}, {kTipClearance, 1, "sun-planet1"},
      {kTipClearance, 1, "planet1-ring1"}, {kTipClearance, 1, "planet1-ring1"},
      {kTrochoid, 1, "planet1-ring1"},
      {kFillet, 1, "sun-planet1"}, {kFillet, 1, "sun-planet1"}, {kContactRatio, 1, "sun-planet1"},
      {kFillet, 1, "planet1-ring1"}, {kFillet, 1, "planet1-ring1"},
      {kContactRatio, 1, "planet1-ring1"},
      {kShift, 2, "planet2"}, {kShift, 2, "planet2"}, {kPlanetSpacing, 2, "planet2"},
      {kTipThickness, 2, "planet2"}, {kTipThickness, 2, "ring2"}, {kRingTip, 2, "ring2"},
      {kContactRatio, 2, "planet2-ring2"}, {kContactRatio, 2, "planet2-ring2"},
      {kTipClearance, 2, "planet2-ring2"}, {kTipClearance, 2, "planet2-ring2"},
      {kTrochoid, 2, "planet2-ring2"},
      {kFillet, 2, "planet2-ring2"}, {kFillet, 2, "planet2-ring2"},
      {kContactRatio, 2, "planet2-ring2"},
  }};
  return kEntries;
}

SearchModel::SearchModel(const SearchRequirements& requirements, const ToothSet& set)
    : requirements_(&requirements), set_(set) {
  const auto mesh = [&](int z1, int z2, bool internal) {
    return MeshTeeth{.teeth1 = z1, .teeth2 = z2, .internal = internal, .normal_module_mm = 1.0,
                     .pressure_angle_rad = requirements.rack.pressure_angle_rad};
  };
  mesh_a_ = mesh(set.sun, set.planet1, false);
  mesh_b_ = mesh(set.planet1, set.ring1, true);
  mesh_c_ = mesh(set.planet2, set.ring2, true);
  const BalanceTrain ideal = balance_train(train_topology("3k", to_text(set.output)),
                                           {set.sun, set.planet1, -set.ring1, set.planet2, -set.ring2});
  const BalanceState forward = solve_balance(ideal, DriveDirection::kForward);
  for (std::size_t k = 0; k < 3; ++k) {
    gear1_drives_forward_[k] = forward.meshes[k].gear1_drives;
    gear1_drives_backward_[k] = !forward.meshes[k].gear1_drives;
  }
  sun_speed_over_output_ = signed_ratio(set);
  least_module_mm_ = module_mm({0.0, requirements.shift_max, requirements.shift_max});
}

double SearchModel::efficiency(const MeshLoss& a, const MeshLoss& b, const MeshLoss& c,
                               DriveDirection direction) const {
  const bool forward = direction == DriveDirection::kForward;
  const auto& gear1_drives = forward ? gear1_drives_forward_ : gear1_drives_backward_;
  // torque on gear 2 per torque on gear 1
  const auto ratio = [&](const MeshTeeth& mesh, const MeshLoss& loss, bool gear1) {
    const double efficiency = gear1 ? loss.driving1 : 1.0 / loss.driving2;
    return (mesh.internal ? -1.0 : 1.0) * efficiency * mesh.teeth2 / mesh.teeth1;
  };
  const double k_a = ratio(mesh_a_, a, gear1_drives[0]);
  const double k_b = ratio(mesh_b_, b, gear1_drives[1]);
  const double k_c = ratio(mesh_c_, c, gear1_drives[2]);
  // unit torque on the sun; planet: k_a + t_b + t_c = 0, all about the axis: 1 + k_b t_b + k_c t_c = 0
  const double t_b = (k_c * k_a - 1.0) / (k_b - k_c);
  const double t_c = -k_a - t_b;
  const double out = set_.output == OutputMember::kRing2 ? k_c * t_c : k_b * t_b;
  // power out / power in of the forward drive: - out w_out / w_sun
  const double eta = -out / sun_speed_over_output_;
  const double result = forward ? eta : 1.0 / eta;
  return result > 0.0 && result <= 1.0 + 1e-12 ? result : 0.0;
}

MeshLoss SearchModel::formula_loss(const MeshTeeth& mesh, double approach, double recess) const {
  const double value = basic_efficiency({.teeth1 = mesh.teeth1,
                                         .teeth2 = mesh.teeth2,
                                         .internal = mesh.internal,
                                         .approach = approach,
                                         .recess = recess},
                                        requirements_->friction);
  return {value, value};
}

MeshLoss SearchModel::path_loss(ContactPath path) const {
  // an optimiser passes through shifts that interrupt contact: the loss goes on smoothly there
  path.end_mm = std::max(path.end_mm, path.start_mm + path.base_pitch_mm * (1.0 + 1e-12));
  const SlidingEfficiency s = sliding_efficiency(path, requirements_->friction, kLoadSharing);
  return {s.gear1_driving, s.gear2_driving};
}

Layer1Evaluation SearchModel::layer1(
    double a, double ring1_shift, double stop_below,
    const std::function<bool(const Layer1Evaluation&)>& worth) const {
  const SearchRequirements& r = *requirements_;
  Layer1Evaluation result;
  Margins margins(result.margins, stop_below);
  const auto done = [&] {
    result.least_margin = margins.least();
    return result;
  };
  const Shifts x = shifts({a, ring1_shift, 0.0});
  margins.add(x.sun - r.shift_min);
  margins.add(r.shift_max - x.sun);
  margins.add(x.planet1 - r.shift_min);
  margins.add(r.shift_max - x.planet1);
  if (margins.stop()) return done();

  Gear sun = gear_of(r, GearKind::kExternal, set_.sun, x.sun);
  Gear planet = gear_of(r, GearKind::kExternal, set_.planet1, x.planet1);
  const Gear ring = gear_of(r, GearKind::kInternal, set_.ring1, x.ring1);
  const double y = a - 0.5 * (set_.sun + set_.planet1);
  sun.tip_radius_mm = 0.5 * set_.sun + r.rack.addendum + y - x.planet1;
  planet.tip_radius_mm = std::min(planet.tip_radius_mm,
                                  0.5 * set_.planet1 + r.rack.addendum + y - x.sun);
  margins.add(spacing_margin(r, a, planet.tip_radius_mm, least_module_mm_));
  const double backlash = backlash_of(r, least_module_mm_);
  for (const Gear* gear : {static_cast<const Gear*>(&sun), static_cast<const Gear*>(&planet), &ring})
    margins.add(gear->tip_radius_mm > base_radius_mm(*gear) ? tip_thickness(*gear, backlash) - r.tip_thickness
                                                            : -1.0);
  margins.add(ring.tip_radius_mm - base_radius_mm(ring));
  if (margins.stop()) return done();

  const MeshView view_a = view_of(sun, planet, a), view_b = view_of(planet, ring, a);
  add_contact_ratio_margins(r, view_a, margins);
  add_contact_ratio_margins(r, view_b, margins);
  margins.add(a - sun.tip_radius_mm - root_radius(planet) - r.tip_clearance);
  margins.add(a - planet.tip_radius_mm - root_radius(sun) - r.tip_clearance);
  add_internal_clearances(r, planet, ring, a, margins);
  margins.add(trochoid_margin(planet, ring, a));
  if (margins.stop()) return done();
  const bool formula = r.loss_model == LossModel::kContactRatios;
  const bool known = formula || (surely_not_undercut(r, sun) && surely_not_undercut(r, planet));
  result.sun_planet =
      formula ? formula_loss(mesh_a_, view_a.approach, view_a.recess) : path_loss(view_a.path);
  result.planet_ring =
      formula ? formula_loss(mesh_b_, view_b.approach, view_b.recess) : path_loss(view_b.path);
  if (known && worth && !worth(result)) return done();

  const auto sun_profile = ToothProfile::make(sun), planet_profile = ToothProfile::make(planet),
             ring_profile = ToothProfile::make(ring);
  if (!sun_profile || !planet_profile || !ring_profile) return done();
  const GearPair pair_a{&*sun_profile, &*planet_profile, a};
  const GearPair pair_b{&*planet_profile, &*ring_profile, a};
  add_root_margins(r, pair_a, margins);
  add_root_margins(r, pair_b, margins);
  if (!known) {
    result.sun_planet = path_loss(contact_path(pair_a, r.face_width_mm));
    result.planet_ring = path_loss(contact_path(pair_b, r.face_width_mm));
  }
  return done();
}

Layer2Evaluation SearchModel::layer2(
    double a1, double ring2_shift, double stop_below,
    const std::function<bool(const Layer2Evaluation&)>& worth) const {
  const SearchRequirements& r = *requirements_;
  Layer2Evaluation result;
  Margins margins(result.margins, stop_below);
  const auto done = [&] {
    result.least_margin = margins.least();
    return result;
  };
  const double m2 = set_.layer2_module_ratio, a = a1 / m2;
  const Shifts x = shifts({a1, 0.0, ring2_shift});
  margins.add(x.planet2 - r.shift_min);
  margins.add(r.shift_max - x.planet2);
  if (margins.stop()) return done();

  const Gear planet = gear_of(r, GearKind::kExternal, set_.planet2, x.planet2);
  const Gear ring = gear_of(r, GearKind::kInternal, set_.ring2, x.ring2);
  margins.add(spacing_margin(r, a, planet.tip_radius_mm, least_module_mm_ * m2));
  const double backlash = backlash_of(r, least_module_mm_ * m2);
  for (const Gear* gear : {&planet, &ring})
    margins.add(gear->tip_radius_mm > base_radius_mm(*gear) ? tip_thickness(*gear, backlash) - r.tip_thickness
                                                            : -1.0);
  margins.add(ring.tip_radius_mm - base_radius_mm(ring));
  if (margins.stop()) return done();

  const MeshView view = view_of(planet, ring, a);
  add_contact_ratio_margins(r, view, margins);
  add_internal_clearances(r, planet, ring, a, margins);
  margins.add(trochoid_margin(planet, ring, a));
  if (margins.stop()) return done();
  const bool formula = r.loss_model == LossModel::kContactRatios;
  const bool known = formula || surely_not_undercut(r, planet);
  result.planet_ring = formula ? formula_loss(mesh_c_, view.approach, view.recess) : path_loss(view.path);
  if (known && worth && !worth(result)) return done();

  const auto planet_profile = ToothProfile::make(planet), ring_profile = ToothProfile::make(ring);
  if (!planet_profile || !ring_profile) return done();
  const GearPair pair{&*planet_profile, &*ring_profile, a};
  add_root_margins(r, pair, margins);
  if (!known) result.planet_ring = path_loss(contact_path(pair, r.face_width_mm));
  return done();
}

SearchModel::Shifts SearchModel::shifts(const FreeShifts& free) const {
  const auto sum = [&](const MeshTeeth& mesh, double a) {
    const auto angle = working_pressure_angle_rad(mesh, a);
    return angle ? shift_sum(mesh, *angle) : -1e3;
  };
  Shifts x{};
  x.ring1 = free.ring1_shift;
  x.planet1 = x.ring1 - sum(mesh_b_, free.centre_distance);
  x.sun = sum(mesh_a_, free.centre_distance) - x.planet1;
  x.ring2 = free.ring2_shift;
  x.planet2 = x.ring2 - sum(mesh_c_, free.centre_distance / set_.layer2_module_ratio);
  return x;
}

std::array<double, 2> SearchModel::ring1_shift_range(double a) const {
  const SearchRequirements& r = *requirements_;
  const Shifts x = shifts({a, 0.0, 0.0});  // planet1 = x_r1 + x.planet1, sun = x.sun - x_r1
  return {std::max({r.shift_min, r.shift_min - x.planet1, x.sun - r.shift_max}),
          std::min({r.shift_max, r.shift_max - x.planet1, x.sun - r.shift_min})};
}

std::array<double, 2> SearchModel::ring2_shift_range(double a) const {
  const SearchRequirements& r = *requirements_;
  const Shifts x = shifts({a, 0.0, 0.0});
  return {std::max(r.shift_min, r.shift_min - x.planet2),
          std::min(r.shift_max, r.shift_max - x.planet2)};
}

double SearchModel::outer_diameter(const FreeShifts& free) const {
  const SearchRequirements& r = *requirements_;
  const auto outer = [&](int teeth, double shift, double module) {
    return module * (teeth + 2.0 * (r.rack.dedendum + shift + r.rim));
  };
  return std::max(outer(set_.ring1, free.ring1_shift, 1.0),
                  outer(set_.ring2, free.ring2_shift, set_.layer2_module_ratio));
}

double SearchModel::module_mm(const FreeShifts& free) const {
  const SearchRequirements& r = *requirements_;
  return r.outer_diameter_mm ? *r.outer_diameter_mm / outer_diameter(free) : r.module_mm;
}

GearboxDesign SearchModel::design(const FreeShifts& free) const {
  const SearchRequirements& r = *requirements_;
  const Shifts x = shifts(free);
  const double m1 = module_mm(free), m2 = m1 * set_.layer2_module_ratio;
  GearboxDesign design;
  design.name = r.name;
  design.topology = train_topology("3k", to_text(set_.output));
  design.planets = r.planets;
  design.module_mm = m1;
  design.centre_distance_mm = free.centre_distance * m1;
  design.friction = r.friction;
  design.losses = r.losses;
  design.backlash_mm = r.backlash_mm.value_or(kUsualBacklash * m1);
  design.tips = TipCircles::kStandard;  // the circles of this model
  design.rack = r.rack;
  // a material of the requirements' own is in no design's table
  if (r.strength.material != kDefaultMaterial && MaterialTable().find(r.strength.material))
    design.material = r.strength.material;
  const auto add = [&](const char* name, GearKind kind, int teeth, double shift, double module) {
    GearDesign gear;
    gear.name = name;
    gear.kind = kind;
    gear.teeth = teeth;
    gear.shift = shift;
    gear.face_width_mm = r.face_width_mm;
    if (module != m1) gear.module_mm = module;
    if (kind == GearKind::kInternal)
      gear.outer_diameter_mm = module * (teeth + 2.0 * (r.rack.dedendum + shift + r.rim));
    design.gears.push_back(gear);
  };
  add("sun", GearKind::kExternal, set_.sun, x.sun, m1);
  add("planet1", GearKind::kExternal, set_.planet1, x.planet1, m1);
  add("ring1", GearKind::kInternal, set_.ring1, x.ring1, m1);
  add("planet2", GearKind::kExternal, set_.planet2, x.planet2, m2);
  add("ring2", GearKind::kInternal, set_.ring2, x.ring2, m2);
  return design;
}

}  // namespace trueflank
