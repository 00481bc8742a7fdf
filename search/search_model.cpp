// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/search/search_layer.h"

namespace trueflank {

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

LayerEvaluation SearchModel::outline(int number, double centre_distance, double shift,
                                     double stop_below) const {
  return layer(number, centre_distance, shift, stop_below, {}, Profiles::kLeftOut);
}

std::size_t SearchModel::limits_of(int number) const {
  return number == 0 ? train().layer1_limits : limits() - train().layer1_limits;
}

std::optional<LayerSetting> SearchModel::set_out(int number, double a1, double shift,
                                                 Margins& margins) const {
  const SearchRequirements& r = *requirements_;
  const Layer& own = layers_[static_cast<std::size_t>(number)];
  Shifts x{};
  add_shifts(number, a1, shift, x);
  const auto shift_at = [&](TrainPlace place) { return x[static_cast<std::size_t>(place)]; };
  const double x_s = own.sun ? shift_at(own.sun_at) : 0.0, x_p = shift_at(own.planet_at);
  if (own.sun) add_shift_margins(r, x_s, margins);
  if (own.ring) add_shift_margins(r, x_p, margins);
  if (margins.stop()) return std::nullopt;

  const double a = a1 / own.module, least_module_mm = least_module_mm_ * own.module;
  LayerSetting setting{.gears = {.planet = gear_of(r, GearKind::kExternal, own.planet, x_p)}};
  LayerGears& gears = setting.gears;
  if (own.ring) gears.ring = gear_of(r, GearKind::kInternal, own.ring, shift_at(own.ring_at));
  if (own.sun) {
    gears.sun = gear_of(r, GearKind::kExternal, own.sun, x_s);
    const double y = a - reference_radius(own.sun + own.planet);
    gears.sun->tip_radius_mm = reference_radius(own.sun) + r.rack.addendum + y - x_p;
    gears.shortened_tip = reference_radius(own.planet) + r.rack.addendum + y - x_s;
    gears.planet.tip_radius_mm = std::min(gears.planet.tip_radius_mm, gears.shortened_tip);
  }
  margins.add(spacing_margin(r, set_.planets, a, gears.planet.tip_radius_mm, least_module_mm));
  add_thickness_margins(r, gears, least_module_mm, margins);
  if (margins.stop()) return std::nullopt;

  setting.lengths = {a, r.face_width_mm / least_module_mm};
  const double width = setting.lengths.face_width;
  if (gears.sun) setting.outer = view_of(*gears.sun, gears.planet, a, width);
  if (gears.ring) setting.inner = view_of(gears.planet, *gears.ring, a, width);
  add_mesh_margins(r, gears, setting.outer, setting.inner, a, margins);
  if (margins.stop()) return std::nullopt;
  return setting;
}

PartlyJudged SearchModel::in_parts(int number, double a1, double shift, double stop_below) const {
  PartlyJudged result;
  Margins margins(result.evaluation.margins, limits_of(number), stop_below);
  auto setting = set_out(number, a1, shift, margins);
  result.first_of_profiles = margins.added();
  if (setting) result.profiles.emplace(*requirements_, std::move(*setting));
  return result;
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
  Margins margins(result.margins, limits_of(number), stop_below);
  const auto done = [&] {
    result.least_margin = margins.least();
    return result;
  };
  const auto setting = set_out(number, a1, shift, margins);
  if (!setting) return done();
  const bool formula = r.loss_model == LossModel::kContactRatios;
  const bool known = formula || is_surely_whole(r, setting->gears, setting->outer, setting->inner);
  const auto loss = [&](const MeshTeeth& mesh, const MeshView& view) {
    if (formula) return formula_loss(r, mesh, view.approach, view.recess);
    return path_loss(r, !known && profiles == Profiles::kLeftOut ? best_part(view) : view.path);
  };
  if (own.sun) result.sun_planet = loss(own.sun_planet, setting->outer);
  if (own.ring) result.planet_ring = loss(own.planet_ring, setting->inner);
  if (profiles == Profiles::kLeftOut || (known && worth && !worth(result))) return done();
  judge_profiles(r, *setting, margins, result);
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
      largest = std::max(
          largest, 2.0 * own.module * (reference_radius(own.ring) + r.rack.dedendum + x_r + r.rim));
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
    const double outer =
        own.ring ? 2.0 * (reference_radius(own.ring) + r.rack.dedendum + r.shift_max + r.rim)
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
          2.0 * module * (reference_radius(gear.teeth) + r.rack.dedendum + *gear.shift + r.rim);
    if (ring && r.cutter) {
      gear.root = RingRoot::kShaper;
      gear.cutter = r.cutter;
    }
    design.gears.push_back(gear);
  }
  return design;
}

}  // namespace trueflank
