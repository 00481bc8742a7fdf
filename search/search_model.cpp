// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_model.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/gear_pair.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/search/search_corner.h"

namespace trueflank {
namespace {

/// Clearances that differ by less are the same; what is exactly kept is kept by a hair, more than
/// the reserve that a climb keeps from its limits.
constexpr double kSameClearance = 1e-9, kHair = 2e-7;

/// Writes margins in order and knows when to stop.
class Margins {
 public:
  Margins(std::array<double, kLayerLimits>& margins, std::size_t count, double stop_below)
      : margins_(margins), count_(count), stop_below_(stop_below) {
    margins_.fill(-1e9);
  }
  void add(double margin) {
    margins_[next_++] = margin;
    least_ = margin < least_ ? margin : least_;
  }
  [[nodiscard]] bool stop() const { return least_ < stop_below_; }
  [[nodiscard]] double least() const { return next_ == count_ ? least_ : std::min(least_, -1e9); }

 private:
  std::array<double, kLayerLimits>& margins_;
  std::size_t count_;
  double stop_below_;
  std::size_t next_ = 0;
  double least_ = 1e300;
};

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

double root_radius(const Gear& gear) { return nominal_root_radius_mm(gear); }

/// What a mesh has before its profiles are known: contact ratios and path from the tip circles.
struct MeshView {
  double approach = 0.0, recess = 0.0;
  double span = 0.0;  ///< between the tangent points of the base circles
  ContactPath path;
};

/// The face width is in modules, as all lengths.
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

/// The part of a path that loses least: of what undercut or a fillet can leave of it nothing loses
/// less. The loss is that of the contact ratios' formula, e1^2 + e2^2 - e1 - e2 + 1, least where both
/// are as close to a half as a whole base pitch allows.
ContactPath best_part(const MeshView& view) {
  ContactPath path = view.path;
  const double approach = std::min(view.approach, std::max(0.5, 1.0 - view.recess)),
               recess = std::min(view.recess, std::max(0.5, 1.0 - view.approach));
  path.start_mm = path.pitch_point_mm - approach * path.base_pitch_mm;
  path.end_mm = path.pitch_point_mm + recess * path.base_pitch_mm;
  return path;
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

/// Tip corners in the mate's roots, both ways, and the contact that undercut and root form leave.
LineOfAction add_root_margins(const SearchRequirements& r, const GearPair& pair, Margins& margins) {
  margins.add(corner_clearance_in_gear1_mm(pair));
  margins.add(corner_clearance_in_gear2_mm(pair));
  const LineOfAction line = line_of_action(pair);
  margins.add((line.effective_end_mm - line.effective_start_mm) / line.base_pitch_mm -
              r.contact_ratio_min);
  return line;
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

double spacing_margin(const SearchRequirements& r, int planets, double a, double tip_radius,
                      double module_mm) {
  if (planets < 2) return 1.0;
  return 2.0 * a * std::sin(kPi / planets) - 2.0 * tip_radius - r.planet_clearance_mm / module_mm;
}

}  // namespace

SearchModel::SearchModel(const SearchRequirements& requirements, const ToothSet& set)
    : requirements_(&requirements), set_(set) {
  set_up_layers();
  set_up_balance();
  least_module_mm_ = requirements.outer_diameter_mm
                         ? *requirements.outer_diameter_mm / greatest_outer_diameter()
                         : requirements.module_mm;
}

void SearchModel::set_up_layers() {
  const auto mesh = [&](int z1, int z2, bool internal) {
    return MeshTeeth{.teeth1 = z1,
                     .teeth2 = z2,
                     .internal = internal,
                     .normal_module_mm = 1.0,
                     .helix_angle_rad = std::abs(requirements_->helix_angle_rad),
                     .pressure_angle_rad = requirements_->rack.pressure_angle_rad};
  };
  for (const SearchLayer& gears : train().layers) {
    const bool first = layers_.empty();
    Layer layer{.module = first ? 1.0 : set_.layer2_module_ratio,
                .planet_at = first ? TrainPlace::kPlanet1 : TrainPlace::kPlanet2,
                .ring_at = first ? TrainPlace::kRing1 : TrainPlace::kRing2};
    layer.planet = set_.teeth_at(layer.planet_at);
    if (gears.sun >= 0) layer.sun = set_.teeth_at(layer.sun_at);
    if (gears.ring >= 0) layer.ring = set_.teeth_at(layer.ring_at);
    if (layer.sun) layer.sun_planet = mesh(layer.sun, layer.planet, false);
    if (layer.ring) layer.planet_ring = mesh(layer.planet, layer.ring, true);
    layers_.push_back(layer);
  }
}

void SearchModel::set_up_balance() {
  const Topology& topology = train().topology;
  std::vector<int> teeth;
  for (std::size_t g = 0; g < topology.gears.size(); ++g) {
    const TrainPlace place = train().place_of(static_cast<int>(g));
    const bool ring = place == TrainPlace::kRing1 || place == TrainPlace::kRing2;
    teeth.push_back(ring ? -set_.teeth_at(place) : set_.teeth_at(place));
  }
  const BalanceState forward =
      solve_balance(balance_train(topology, teeth), DriveDirection::kForward);
  for (std::size_t k = 0; k < topology.meshes.size(); ++k) {
    const TopologyMesh& mesh = topology.meshes[k];
    const auto gear1 = static_cast<std::size_t>(mesh.gear1),
               gear2 = static_cast<std::size_t>(mesh.gear2);
    balance_.push_back({.layer = topology.gears[gear1].layer - 1,
                        .internal = teeth[gear2] < 0,
                        .teeth_ratio = static_cast<double>(teeth[gear2]) / teeth[gear1],
                        .gear1_drives_forward = forward.meshes[k].gear1_drives,
                        .member1 = topology.gears[gear1].member,
                        .member2 = topology.gears[gear2].member});
  }
  ratio_ = signed_ratio(set_);
}

double SearchModel::output_torque(const std::array<double, 3>& torque_ratios) const {
  const Topology& t = train().topology;
  const std::size_t count = balance_.size();
  // What each mesh's torque on its gear 1 does to a member: on a carrier all that its gears do
  // about the axis.
  const auto share = [&](int member, std::size_t k) {
    const BalanceMesh& mesh = balance_[k];
    const bool carrier = t.is_carrier(member);
    const auto acts = [&](int other) {
      return carrier ? (t.is_planet(other) ? 0.0 : -1.0) : other == member ? 1.0 : 0.0;
    };
    return acts(mesh.member1) + acts(mesh.member2) * torque_ratios[k];
  };
  std::array<std::array<double, 4>, 3> rows{};
  std::size_t row = 0;
  for (int member = 0; member < static_cast<int>(t.members.size()); ++member) {
    if (member == t.output || std::find(t.fixed.begin(), t.fixed.end(), member) != t.fixed.end())
      continue;
    TRUEFLANK_EXPECTS(row < count);
    for (std::size_t k = 0; k < count; ++k) rows[row][k] = share(member, k);
    rows[row++][3] = member == t.input ? -1.0 : 0.0;
  }
  TRUEFLANK_EXPECTS(row == count);
  for (std::size_t k = 0; k < count; ++k) {  // Gauss and Jordan, the largest pivot first
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < count; ++i)
      if (std::abs(rows[i][k]) > std::abs(rows[pivot][k])) pivot = i;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = 0; i < count; ++i) {
      if (i == k) continue;
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 4; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  double out = 0.0;
  for (std::size_t k = 0; k < count; ++k) out -= share(t.output, k) * rows[k][3] / rows[k][k];
  return out;
}

double SearchModel::efficiency(const LayerEvaluation& layer1, const LayerEvaluation& layer2,
                               DriveDirection direction) const {
  const bool forward = direction == DriveDirection::kForward;
  std::array<double, 3> torque_ratios{};
  for (std::size_t k = 0; k < balance_.size(); ++k) {
    const BalanceMesh& mesh = balance_[k];
    const LayerEvaluation& layer = mesh.layer == 0 ? layer1 : layer2;
    const MeshLoss& loss = mesh.internal ? layer.planet_ring : layer.sun_planet;
    const bool gear1_drives = mesh.gear1_drives_forward == forward;
    torque_ratios[k] = mesh.teeth_ratio * (gear1_drives ? loss.driving1 : 1.0 / loss.driving2);
  }
  // power out / power in of the forward drive
  const double eta = -output_torque(torque_ratios) / ratio_;
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

LayerEvaluation SearchModel::outline(int number, double centre_distance, double shift,
                                     double stop_below) const {
  return layer(number, centre_distance, shift, stop_below, {}, Profiles::kLeftOut);
}

LayerEvaluation SearchModel::layer(int number, double a1, double shift, double stop_below,
                                   const std::function<bool(const LayerEvaluation&)>& worth,
                                   Profiles profiles) const {
  const SearchRequirements& r = *requirements_;
  LayerEvaluation result;
  if (static_cast<std::size_t>(number) >= layers_.size()) {
    result.least_margin = 1e9;
    return result;
  }
  const Layer& own = layers_[static_cast<std::size_t>(number)];
  const std::size_t first = number == 0 ? 0 : train().layer1_limits;
  Margins margins(result.margins, number == 0 ? train().layer1_limits : limits() - first,
                  stop_below);
  const auto done = [&] {
    result.least_margin = margins.least();
    return result;
  };
  Shifts x{};
  add_shifts(number, a1, shift, x);
  const auto shift_at = [&](TrainPlace place) { return x[static_cast<std::size_t>(place)]; };
  const double x_s = own.sun ? shift_at(own.sun_at) : 0.0, x_p = shift_at(own.planet_at);
  const auto within_bounds = [&](double value) {
    margins.add(value - r.shift_min);
    margins.add(r.shift_max - value);
  };
  if (own.sun) within_bounds(x_s);
  if (own.ring) within_bounds(x_p);
  if (margins.stop()) return done();

  const double a = a1 / own.module, least_module_mm = least_module_mm_ * own.module;
  Gear planet = gear_of(r, GearKind::kExternal, own.planet, x_p);
  std::optional<Gear> sun, ring;
  double shortened_tip = kNaN;  ///< of the planet, by its mesh with the sun
  if (own.ring) ring = gear_of(r, GearKind::kInternal, own.ring, shift_at(own.ring_at));
  if (own.sun) {
    sun = gear_of(r, GearKind::kExternal, own.sun, x_s);
    const double y = a - reference_radius(own.sun + own.planet);
    sun->tip_radius_mm = reference_radius(own.sun) + r.rack.addendum + y - x_p;
    shortened_tip = reference_radius(own.planet) + r.rack.addendum + y - x_s;
    planet.tip_radius_mm = std::min(planet.tip_radius_mm, shortened_tip);
  }
  margins.add(spacing_margin(r, set_.planets, a, planet.tip_radius_mm, least_module_mm));
  const double backlash = backlash_of(r, least_module_mm);
  const auto add_thickness = [&](const Gear& gear) {
    margins.add(gear.tip_radius_mm > base_radius_mm(gear)
                    ? tip_thickness(gear, backlash) - r.tip_thickness
                    : -1.0);
  };
  if (sun) add_thickness(*sun);
  add_thickness(planet);
  if (ring) {
    add_thickness(*ring);
    margins.add(ring->tip_radius_mm - base_radius_mm(*ring));
  }
  if (margins.stop()) return done();

  const double width = r.face_width_mm / least_module_mm;
  const MeshView outer = sun ? view_of(*sun, planet, a, width) : MeshView{};
  const MeshView inner = ring ? view_of(planet, *ring, a, width) : MeshView{};
  if (sun) add_contact_ratio_margins(r, outer, margins);
  if (ring) add_contact_ratio_margins(r, inner, margins);
  if (sun) {
    // The tip circles leave exactly dedendum less addendum: where that is asked for, rounding must
    // not decide.
    const bool exact = std::abs(r.rack.dedendum - r.rack.addendum - r.tip_clearance) < kSameClearance;
    margins.add(exact ? kHair : a - sun->tip_radius_mm - root_radius(planet) - r.tip_clearance);
    margins.add((exact ? std::max(0.0, shortened_tip - planet.tip_radius_mm) + kHair
                       : a - planet.tip_radius_mm - root_radius(*sun) - r.tip_clearance));
  }
  if (ring) {
    add_internal_clearances(r, planet, *ring, a, margins);
    margins.add(trochoid_margin(planet, *ring, a));
  }
  if (margins.stop()) return done();
  const bool formula = r.loss_model == LossModel::kContactRatios;
  const bool known =
      formula || ((!sun || (surely_whole(r, *sun, outer.path.start_mm) &&
                            surely_whole(r, planet, outer.span - outer.path.end_mm))) &&
                  (!ring || (!r.cutter && surely_whole(r, planet, inner.path.start_mm))));
  const auto loss = [&](const MeshTeeth& mesh, const MeshView& view) {
    if (formula) return formula_loss(mesh, view.approach, view.recess);
    return path_loss(!known && profiles == Profiles::kLeftOut ? best_part(view) : view.path);
  };
  if (sun) result.sun_planet = loss(own.sun_planet, outer);
  if (ring) result.planet_ring = loss(own.planet_ring, inner);
  if (profiles == Profiles::kLeftOut || (known && worth && !worth(result))) return done();

  const auto planet_profile = ToothProfile::make(planet);
  if (!planet_profile) return done();
  const auto judge = [&](const GearPair& pair, const MeshView& view, MeshLoss& mesh_loss) {
    const LineOfAction line = add_root_margins(r, pair, margins);
    // undercut, or a root form circle above the mate's tip, shortens the path
    constexpr double kSame_mm = 1e-10;
    if (!formula && (line.effective_start_mm > view.path.start_mm + kSame_mm ||
                     line.effective_end_mm < view.path.end_mm - kSame_mm))
      mesh_loss = path_loss(contact_path(pair, width));
  };
  if (sun) {
    const auto profile = ToothProfile::make(*sun);
    if (!profile) return done();
    judge({&*profile, &*planet_profile, a}, outer, result.sun_planet);
  }
  if (ring) {
    const auto profile = ToothProfile::make(*ring);
    if (!profile) return done();
    judge({&*planet_profile, &*profile, a}, inner, result.planet_ring);
  }
  return done();
}

void SearchModel::add_shifts(int number, double a1, double shift, Shifts& x) const {
  const auto sum = [&](const MeshTeeth& mesh, double a) {
    const auto angle = working_pressure_angle_rad(mesh, a);
    return angle ? shift_sum(mesh, *angle) : -1e3;
  };
  const Layer& own = layers_[static_cast<std::size_t>(number)];
  const double a = a1 / own.module;
  double& planet = x[static_cast<std::size_t>(own.planet_at)];
  planet = shift;
  if (own.ring) {
    x[static_cast<std::size_t>(own.ring_at)] = shift;
    planet = shift - sum(own.planet_ring, a);
  }
  if (own.sun) x[static_cast<std::size_t>(own.sun_at)] = sum(own.sun_planet, a) - planet;
}

SearchModel::Shifts SearchModel::shifts(const FreeShifts& free) const {
  Shifts x{};
  add_shifts(0, free.centre_distance, free.layer1_shift, x);
  if (has_layer2()) add_shifts(1, free.centre_distance, free.layer2_shift, x);
  return x;
}

std::array<double, 2> SearchModel::shift_range(int number, double a) const {
  if (static_cast<std::size_t>(number) >= layers_.size()) return {0.0, 0.0};
  const SearchRequirements& r = *requirements_;
  Shifts x{};
  add_shifts(number, a, 0.0, x);  // planet = shift + x of the planet, sun = x of the sun - shift
  const Layer& own = layers_[static_cast<std::size_t>(number)];
  std::array<double, 2> range{r.shift_min, r.shift_max};
  if (own.ring) {
    const double planet = x[static_cast<std::size_t>(own.planet_at)];
    range = {std::max(range[0], r.shift_min - planet), std::min(range[1], r.shift_max - planet)};
  }
  if (own.sun) {
    const double sun = x[static_cast<std::size_t>(own.sun_at)];
    range = {std::max(range[0], sun - r.shift_max), std::min(range[1], sun - r.shift_min)};
  }
  return range;
}

double SearchModel::outer_diameter(const FreeShifts& free) const {
  const SearchRequirements& r = *requirements_;
  const Shifts x = shifts(free);
  double largest = 0.0;
  for (const Layer& own : layers_) {
    const double x_p = x[static_cast<std::size_t>(own.planet_at)],
                 a = free.centre_distance / own.module;
    if (own.ring) {
      const double x_r = x[static_cast<std::size_t>(own.ring_at)];
      largest = std::max(largest, 2.0 * own.module * (reference_radius(own.ring) + r.rack.dedendum +
                                                      x_r + r.rim));
    } else {
      const double x_s = x[static_cast<std::size_t>(own.sun_at)],
                   y = a - reference_radius(own.sun + own.planet);
      const double planet_tip =
          reference_radius(own.planet) + r.rack.addendum + std::min(x_p, y - x_s);
      const double sun_tip = reference_radius(own.sun) + r.rack.addendum + y - x_p;
      largest = std::max(largest, own.module * (train().has_planets() ? 2.0 * (a + planet_tip)
                                                                      : a + planet_tip + sun_tip));
    }
  }
  return largest;
}

/// No shifts within the bounds and no centre distance give more.
double SearchModel::greatest_outer_diameter() const {
  const SearchRequirements& r = *requirements_;
  double largest = 0.0;
  for (const Layer& own : layers_) {
    const double a = set_.centre_distance_max / own.module;
    const auto tip = [&](int teeth) {
      return reference_radius(teeth) + r.rack.addendum + r.shift_max;
    };
    const double outer = own.ring ? 2.0 * (reference_radius(own.ring) + r.rack.dedendum +
                                           r.shift_max + r.rim)
                         : train().has_planets() ? 2.0 * (a + tip(own.planet))
                                                 : a + tip(own.planet) + tip(own.sun);
    largest = std::max(largest, own.module * outer);
  }
  return largest;
}

double SearchModel::reference_radius(int teeth) const {
  return 0.5 * teeth / std::cos(requirements_->helix_angle_rad);
}

double SearchModel::module_mm(const FreeShifts& free) const {
  const SearchRequirements& r = *requirements_;
  return r.outer_diameter_mm ? *r.outer_diameter_mm / outer_diameter(free) : r.module_mm;
}

GearboxDesign SearchModel::design(const FreeShifts& free,
                                  const DesignDimensions& dimensions) const {
  const SearchRequirements& r = *requirements_;
  const Shifts x = shifts(free);
  const double m1 = std::isnan(dimensions.module_mm) ? module_mm(free) : dimensions.module_mm;
  const double width =
      std::isnan(dimensions.face_width_mm) ? r.face_width_mm : dimensions.face_width_mm;
  GearboxDesign design;
  design.name = r.name;
  design.topology = train().topology;
  design.planets = set_.planets;
  design.module_mm = m1;
  design.centre_distance_mm = free.centre_distance * m1;
  design.friction = r.friction;
  design.losses = r.losses;
  design.shafts = {.rotor_inertia_kg_m2 = r.motor.rotor_kg_m2,
                   .load_inertia_kg_m2 = r.motor.load_kg_m2};
  design.backlash_mm = r.backlash_mm.value_or(kUsualBacklash * m1);
  design.tips = TipCircles::kStandard;  // the circles of this model
  design.rack = r.rack;
  design.helix_angle_rad = r.helix_angle_rad;
  // a material of the requirements' own is in no design's table
  if (r.strength.material != kDefaultMaterial && MaterialTable().find(r.strength.material))
    design.material = r.strength.material;
  for (std::size_t g = 0; g < train().topology.gears.size(); ++g) {
    const TrainPlace place = train().place_of(static_cast<int>(g));
    const bool ring = place == TrainPlace::kRing1 || place == TrainPlace::kRing2;
    const bool upper = place == TrainPlace::kPlanet2 || place == TrainPlace::kRing2;
    const double module = upper ? m1 * set_.layer2_module_ratio : m1;
    GearDesign gear;
    gear.name = train().topology.gears[g].name;
    gear.kind = ring ? GearKind::kInternal : GearKind::kExternal;
    gear.teeth = set_.teeth_at(place);
    gear.shift = x[static_cast<std::size_t>(place)];
    gear.face_width_mm = width;
    if (module != m1) gear.module_mm = module;
    if (ring)
      gear.outer_diameter_mm =
          2.0 * module *
          (reference_radius(gear.teeth) + r.rack.dedendum + *gear.shift + r.rim);
    if (ring && r.cutter) {
      gear.root = RingRoot::kShaper;
      gear.cutter = r.cutter;
    }
    design.gears.push_back(gear);
  }
  return design;
}

}  // namespace trueflank
