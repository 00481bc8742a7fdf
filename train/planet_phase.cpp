// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two gears are in mesh, centred, when the phase of their teeth at the contact direction differs by
// half a pitch: z1 (angle of tooth 1 from the contact direction) +- z2 (...) = pi modulo 2 pi.
#include "trueflank/train/planet_phase.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>

#include "trueflank/base/contract.h"
#include "trueflank/base/tolerance.h"

namespace trueflank {
namespace {

/// A planet gear and the central gears it meshes with, its ring first: bodies are placed by it.
struct PlanetGear {
  int gear = 0;
  std::int64_t teeth = 0;
  std::vector<int> mates;
  std::vector<std::int64_t> mate_teeth;  ///< negative for rings
};

std::int64_t teeth_of(const GearTrain& train, int gear) {
  const Gear& g = train.gear(gear).profile.gear();
  return g.kind == GearKind::kInternal ? -g.teeth : g.teeth;
}

std::vector<PlanetGear> planet_gears(const GearTrain& train, int planet) {
  std::vector<PlanetGear> gears;
  for (const int g : train.topology().gears_of(planet)) {
    PlanetGear own{.gear = g, .teeth = teeth_of(train, g)};
    for (const TrainMesh& mesh : train.meshes) {
      if (mesh.gear1 != g && mesh.gear2 != g) continue;
      const int mate = mesh.gear1 == g ? mesh.gear2 : mesh.gear1;
      const auto first = teeth_of(train, mate) < 0 ? own.mates.begin() : own.mates.end();
      own.mates.insert(first, mate);
    }
    TRUEFLANK_EXPECTS(!own.mates.empty());
    for (const int mate : own.mates) own.mate_teeth.push_back(teeth_of(train, mate));
    gears.push_back(std::move(own));
  }
  return gears;
}

/// Angles between planets, in turns: multiples of 1/places mesh with all mates, multiples of
/// step/places are those of identical bodies. 0 places: any angle.
struct Spacing {
  std::int64_t places = 0;
  std::int64_t step = 1;
  bool any_mesh = true;  ///< bodies that differ mesh at any angle
};

/// z1 z_p2 - z2 z_p1 of a later gear of the body against the first, less its sign.
std::int64_t difference(const PlanetGear& first, const PlanetGear& later) {
  return later.mate_teeth[0] * first.teeth - first.mate_teeth[0] * later.teeth;
}

Spacing spacing_of(const std::vector<PlanetGear>& gears) {
  Spacing spacing;
  for (const PlanetGear& gear : gears)
    for (std::size_t i = 1; i < gear.mate_teeth.size(); ++i)
      spacing.places = std::gcd(spacing.places, std::abs(gear.mate_teeth[i] - gear.mate_teeth[0]));
  spacing.any_mesh = spacing.places == 0;
  for (std::size_t i = 1; i < gears.size(); ++i) {
    const std::int64_t apart = std::abs(difference(gears[0], gears[i]));
    if (apart == 0) continue;
    const std::int64_t common = std::gcd(gears[0].teeth, gears[i].teeth);
    if (spacing.places == 0) spacing.places = apart;
    const std::int64_t modulus = spacing.places * common;
    spacing.step = std::lcm(spacing.step, modulus / std::gcd(apart, modulus));
  }
  return spacing;
}

/// Offset of a later gear against the first of a body at a position, less that of body 1.
double offset_rad(const PlanetGear& first, const PlanetGear& later, double position_rad) {
  const auto apart = static_cast<double>(difference(first, later));
  const auto product = static_cast<double>(first.teeth * later.teeth);
  const double period = kTwoPi * static_cast<double>(std::gcd(first.teeth, later.teeth)) / product;
  const double offset = centred_rad(apart / product * position_rad, period);
  return std::abs(offset) < tolerance::kAngle_rad ||
                 std::abs(std::abs(offset) - period) < tolerance::kAngle_rad
             ? 0.0
             : offset;
}

std::vector<double> offsets_rad(const std::vector<PlanetGear>& gears, const std::vector<double>& positions) {
  std::vector<double> all;
  for (const double position : positions)
    all.push_back(gears.size() < 2 ? 0.0 : offset_rad(gears[0], gears[1], position));
  return all;
}

double largest_planet_tip_mm(const GearTrain& train) {
  double tip = 0.0;
  for (std::size_t i = 0; i < train.gears.size(); ++i)
    if (train.topology().is_planet_gear(i)) tip = std::max(tip, train.gears[i].profile.tip_radius_mm());
  return tip;
}

/// Multiples of a step nearest to equal spacing; empty where neighbours would collide. Gaps between neighbours
/// differ by one step at most, so that no other choice leaves the nearest two farther apart.
std::vector<double> nearest_positions(const GearTrain& train, std::int64_t places, std::int64_t multiple) {
  const int n = train.design.planets;
  const auto sum = static_cast<double>(places), step = static_cast<double>(multiple);
  std::vector<double> angles;
  for (int i = 0; i < n; ++i) {
    // nearest multiple of step to i sum / n, halves away from zero
    const double wanted = static_cast<double>(i) * sum / n;
    const double k = step * std::round(wanted / step);
    angles.push_back(kTwoPi * k / sum);
  }
  const double diameter = 2.0 * largest_planet_tip_mm(train);
  for (int i = 0; i < n && n > 1; ++i) {
    const double next = i + 1 < n ? angles[static_cast<std::size_t>(i) + 1] : kTwoPi;
    const double apart = next - angles[static_cast<std::size_t>(i)];
    if (2.0 * train.centre_distance_mm * std::sin(std::min(0.5 * apart, 0.5 * kPi)) <= diameter)
      return {};
  }
  return angles;
}

/// Rotation of a gear (teeth z) whose mate (signed teeth) stands at `mate_rad` in the direction phi of
/// the gear's axis. The gear is the planet.
double planet_rotation_rad(std::int64_t z, std::int64_t mate, double mate_rad, double phi) {
  const double teeth = static_cast<double>(z), other = static_cast<double>(std::abs(mate));
  return mate < 0 ? phi + (kPi + other * (mate_rad - phi)) / teeth
                  : phi + kPi + (kPi - other * (mate_rad - phi)) / teeth;
}

/// Rotation of a central gear (signed teeth) that meshes with a planet gear at phi = 0.
double central_rotation_rad(std::int64_t central, std::int64_t z, double planet_rad) {
  const double teeth = static_cast<double>(z), own = static_cast<double>(std::abs(central));
  return central < 0 ? (teeth * planet_rad - kPi) / own : (kPi - teeth * (planet_rad - kPi)) / own;
}

/// A pair stands with tooth 1 of the pinion on +x, and so does every gear that nothing meshes with.
void place_standing(const GearTrain& train, AssemblyPhases& phases) {
  for (const TrainMesh& mesh : train.meshes) {
    const int wheel = train.topology().gears[static_cast<std::size_t>(mesh.gear2)].member;
    const auto z2 = static_cast<double>(std::abs(teeth_of(train, mesh.gear2)));
    phases.member_rotation_rad[static_cast<std::size_t>(wheel)][0] =
        teeth_of(train, mesh.gear2) < 0 ? -kPi / z2 : kPi + kPi / z2;
  }
}

/// How body i must be turned so that its first gear meshes, and how far its later gears stand ahead:
/// of the equivalent rotations, the one that needs the least offset.
void place_body(const std::vector<PlanetGear>& gears, int planet, std::size_t place,
                const std::function<double(int gear)>& central_rad, AssemblyPhases& phases) {
  const double phi = phases.positions_rad(planet)[place];
  const auto wanted = [&](const PlanetGear& gear) {
    return planet_rotation_rad(gear.teeth, gear.mate_teeth[0], central_rad(gear.mates[0]), phi);
  };
  const double first = wanted(gears[0]);
  double rotation = first;
  if (gears.size() > 1) {
    const double wanted2 = wanted(gears[1]), pitch2 = kTwoPi / static_cast<double>(gears[1].teeth);
    double best_offset = kPi;
    for (std::int64_t k = 0; k < gears[0].teeth; ++k) {
      const double equivalent = first + kTwoPi * static_cast<double>(k) / static_cast<double>(gears[0].teeth);
      const double offset = centred_rad(wanted2 - equivalent, pitch2);
      if (std::abs(offset) < std::abs(best_offset) - tolerance::kAngle_rad) {
        best_offset = offset;
        rotation = equivalent;
      }
    }
  }
  phases.member_rotation_rad[static_cast<std::size_t>(planet)][place] = rotation;
  for (std::size_t j = 1; j < gears.size(); ++j) {
    const double offset =
        centred_rad(wanted(gears[j]) - rotation, kTwoPi / static_cast<double>(gears[j].teeth));
    phases.gear_offset_rad[static_cast<std::size_t>(gears[j].gear)][place] =
        std::abs(offset) < tolerance::kAngle_rad ? 0.0 : offset;
  }
}

/// The first mate of the first planet gear stands with tooth 1 on +x. Planet 1 follows from it, the
/// other central gears from planet 1, whose gears all stand tooth 1 over tooth 1, the other planets
/// from the central gears.
void place_planets(const GearTrain& train, int planet, AssemblyPhases& phases) {
  const std::vector<PlanetGear> gears = planet_gears(train, planet);
  const Topology& topology = train.topology();
  const auto central_rad = [&](int gear) -> double& {
    const int member = topology.gears[static_cast<std::size_t>(gear)].member;
    return phases.member_rotation_rad[static_cast<std::size_t>(member)][0];
  };
  const double first = planet_rotation_rad(gears[0].teeth, gears[0].mate_teeth[0], 0.0, 0.0);
  for (const PlanetGear& gear : gears)
    for (std::size_t i = 0; i < gear.mates.size(); ++i)
      if (gear.gear != gears[0].gear || i > 0)
        central_rad(gear.mates[i]) = central_rotation_rad(gear.mate_teeth[i], gear.teeth, first);
  for (std::size_t place = 0; place < phases.positions_rad(planet).size(); ++place)
    place_body(gears, planet, place, central_rad, phases);
}

}  // namespace

bool planet_bodies_alike(const AssemblyCondition& condition) {
  return std::all_of(condition.planet_offsets_rad.begin(), condition.planet_offsets_rad.end(),
                     [](double offset) { return std::abs(offset) <= tolerance::kAngle_rad; });
}

IndexedPlanets indexed_planets(const GearTrain& train) {
  const int planet = train.topology().first_planet();
  if (planet == kNoMember) return {};
  const std::vector<PlanetGear> gears = planet_gears(train, planet);
  const Spacing spacing = spacing_of(gears);
  if (spacing.any_mesh || spacing.step == 1) return {};
  IndexedPlanets indexed{.angles_rad = nearest_positions(train, spacing.places, 1)};
  indexed.offsets_rad = offsets_rad(gears, indexed.angles_rad);
  return indexed;
}

AssemblyCondition assembly_condition(const GearTrain& train) {
  AssemblyCondition condition;
  const int planet = train.topology().first_planet();
  if (planet == kNoMember) return condition;
  const std::vector<PlanetGear> gears = planet_gears(train, planet);
  const Spacing spacing = spacing_of(gears);
  const int n = train.design.planets;
  condition.equal_spacing = spacing.any_mesh || spacing.places % n == 0;
  condition.identical_planets =
      spacing.places == 0 || (spacing.places % n == 0 && (spacing.places / n) % spacing.step == 0);
  if (spacing.places > 0)
    condition.angle_step_rad =
        kTwoPi * static_cast<double>(spacing.step) / static_cast<double>(spacing.places);
  std::vector<double> equal;
  for (int i = 0; i < n; ++i) equal.push_back(kTwoPi * i / n);
  condition.nearest_angles_rad =
      condition.identical_planets ? equal : nearest_positions(train, spacing.places, spacing.step);
  if (condition.equal_spacing) {
    condition.planet_offsets_rad = offsets_rad(gears, equal);
    return condition;
  }
  if (condition.nearest_angles_rad.empty()) condition.nearest_angles_rad = indexed_planets(train).angles_rad;
  condition.planet_offsets_rad = condition.nearest_angles_rad.empty()
                                     ? std::vector<double>(static_cast<std::size_t>(n), kNaN)
                                     : offsets_rad(gears, condition.nearest_angles_rad);
  return condition;
}

AssemblyPhases phases_in_mesh(const GearTrain& train) {
  AssemblyPhases phases;
  const Topology& topology = train.topology();
  const int planet = topology.first_planet();
  const int n = train.design.planets;
  phases.position_rad.resize(topology.members.size());
  if (planet != kNoMember) {
    std::vector<double>& positions = phases.position_rad[static_cast<std::size_t>(planet)];
    for (int i = 0; i < n; ++i) positions.push_back(kTwoPi * i / n);
    if (!train.assembly.equal_spacing && !train.assembly.nearest_angles_rad.empty())
      positions = train.assembly.nearest_angles_rad;
  }
  for (std::size_t m = 0; m < topology.members.size(); ++m)
    phases.member_rotation_rad.emplace_back(
        static_cast<std::size_t>(train.copies_of(static_cast<int>(m))), 0.0);
  for (const TopologyGear& gear : topology.gears)
    phases.gear_offset_rad.emplace_back(static_cast<std::size_t>(train.copies_of(gear.member)), 0.0);
  if (planet == kNoMember)
    place_standing(train, phases);
  else
    place_planets(train, planet, phases);
  return phases;
}

}  // namespace trueflank
