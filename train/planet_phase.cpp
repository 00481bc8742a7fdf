// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two gears are in mesh, centred, when the phase of their teeth at the contact direction differs by
// half a pitch: z1 (angle of tooth 1 from the contact direction) +- z2 (...) = pi modulo 2 pi.
#include "trueflank/train/planet_phase.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "trueflank/base/contract.h"
#include "trueflank/base/tolerance.h"

namespace trueflank {
namespace {

/// Tooth counts of a planetary train; teeth of layer 2 are 0 for a simple one.
struct PlanetaryTeeth {
  std::int64_t sun = 0, planet1 = 0, ring1 = 0, planet2 = 0, ring2 = 0;
  [[nodiscard]] std::int64_t sum() const { return sun + ring1; }
};

int teeth_of(const GearTrain& train, const char* name) {
  const TrainGear* gear = train.find(name);
  return gear ? gear->profile.gear().teeth : 0;
}

PlanetaryTeeth planetary_teeth(const GearTrain& train) {
  if (train.design.kind == TrainKind::k3k)
    return {teeth_of(train, "sun"), teeth_of(train, "planet1"), teeth_of(train, "ring1"),
            teeth_of(train, "planet2"), teeth_of(train, "ring2")};
  return {teeth_of(train, "sun"), teeth_of(train, "planet"), teeth_of(train, "ring"), 0, 0};
}

bool is_planetary(const GearTrain& train) {
  return train.design.kind == TrainKind::k3k || train.design.kind == TrainKind::kSimple;
}

/// Smallest k > 0 such that bodies k/(z_s + z_r) turn apart are alike.
std::int64_t identical_step(const PlanetaryTeeth& z) {
  if (z.planet2 == 0) return 1;
  const std::int64_t difference = std::abs(z.ring1 * z.planet2 - z.ring2 * z.planet1);
  if (difference == 0) return 1;
  const std::int64_t modulus = z.sum() * std::gcd(z.planet1, z.planet2);
  return modulus / std::gcd(difference, modulus);
}

/// Offset of P2 against P1 of a body k/(z_s + z_r1) turn from body 1, less that of body 1.
double offset_rad(const PlanetaryTeeth& z, double position_rad) {
  if (z.planet2 == 0) return 0.0;
  const double difference = static_cast<double>(z.ring1 * z.planet2 - z.ring2 * z.planet1);
  const double product = static_cast<double>(z.planet1 * z.planet2);
  const double period = kTwoPi * static_cast<double>(std::gcd(z.planet1, z.planet2)) / product;
  const double offset = centred_rad(difference / product * position_rad, period);
  return std::abs(offset) < tolerance::kAngle_rad ||
                 std::abs(std::abs(offset) - period) < tolerance::kAngle_rad
             ? 0.0
             : offset;
}

double largest_planet_tip_mm(const GearTrain& train) {
  double tip = 0.0;
  for (const TrainGear& gear : train.gears)
    if (gear.name.starts_with("planet")) tip = std::max(tip, gear.profile.tip_radius_mm());
  return tip;
}

/// Multiples of `step` of a turn nearest to equal spacing; empty where neighbours would collide.
std::vector<double> nearest_positions(const GearTrain& train, std::int64_t sum, std::int64_t step) {
  const int n = train.design.planets;
  std::vector<double> angles;
  for (int i = 0; i < n; ++i) {
    // nearest multiple of step to i sum / n, halves away from zero
    const double wanted = static_cast<double>(i) * static_cast<double>(sum) / n;
    const auto k = static_cast<double>(step) * std::round(wanted / static_cast<double>(step));
    angles.push_back(kTwoPi * k / static_cast<double>(sum));
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

}  // namespace

AssemblyCondition assembly_condition(const GearTrain& train) {
  AssemblyCondition condition;
  if (!is_planetary(train)) return condition;
  const PlanetaryTeeth z = planetary_teeth(train);
  const int n = train.design.planets;
  const std::int64_t step = identical_step(z);
  condition.angle_step_rad = kTwoPi * static_cast<double>(step) / static_cast<double>(z.sum());
  condition.equal_spacing = z.sum() % n == 0;
  condition.identical_planets = condition.equal_spacing && (z.sum() / n) % step == 0;
  for (int i = 0; i < n; ++i)
    condition.planet_offsets_rad.push_back(
        condition.equal_spacing ? offset_rad(z, kTwoPi * i / n) : kNaN);
  if (condition.identical_planets)
    for (int i = 0; i < n; ++i) condition.nearest_angles_rad.push_back(kTwoPi * i / n);
  else
    condition.nearest_angles_rad = nearest_positions(train, z.sum(), step);
  return condition;
}

AssemblyPhases phases_in_mesh(const GearTrain& train) {
  AssemblyPhases phases;
  if (train.design.kind == TrainKind::kPair) {
    const double z2 = teeth_of(train, "wheel");
    const bool internal = train.find("wheel")->profile.gear().kind == GearKind::kInternal;
    phases.ring1_rotation_rad =
        internal ? -kPi / z2 : kPi + kPi / z2;  // tooth 1 of the pinion on +x
    return phases;
  }
  if (!is_planetary(train)) return phases;
  const PlanetaryTeeth z = planetary_teeth(train);
  const double z_s = static_cast<double>(z.sun), z_p1 = static_cast<double>(z.planet1),
               z_r1 = static_cast<double>(z.ring1);
  const int n = train.design.planets;
  for (int i = 0; i < n; ++i) phases.planet_position_rad.push_back(kTwoPi * i / n);
  if (!train.assembly.equal_spacing && !train.assembly.nearest_angles_rad.empty())
    phases.planet_position_rad = train.assembly.nearest_angles_rad;

  // ring1 stands; planet: z_p (psi - phi) - z_r (rho - phi) = pi
  const auto planet_rotation = [&](double phi) { return phi + (kPi - z_r1 * phi) / z_p1; };
  const double first = planet_rotation(0.0);
  // sun: z_s (sigma - phi) + z_p (psi - phi - pi) = pi with phi = 0
  phases.sun_rotation_rad = (kPi - z_p1 * (first - kPi)) / z_s;
  if (z.planet2 > 0) {
    // P2 of body 1 stands like its P1: z_p2 psi - z_r2 rho2 = pi
    const double z_p2 = static_cast<double>(z.planet2), z_r2 = static_cast<double>(z.ring2);
    phases.ring2_rotation_rad = (z_p2 * first - kPi) / z_r2;
    for (double phi : phases.planet_position_rad) {
      // the rotation among the z_p1 equivalent ones that needs the least offset
      const double wanted2 = phi + (kPi + z_r2 * (phases.ring2_rotation_rad - phi)) / z_p2;
      double best_rotation = planet_rotation(phi), best_offset = kPi;
      for (std::int64_t k = 0; k < z.planet1; ++k) {
        const double rotation = planet_rotation(phi) + kTwoPi * static_cast<double>(k) / z_p1;
        const double offset = centred_rad(wanted2 - rotation, kTwoPi / z_p2);
        if (std::abs(offset) < std::abs(best_offset) - tolerance::kAngle_rad) {
          best_offset = offset;
          best_rotation = rotation;
        }
      }
      phases.planet_rotation_rad.push_back(best_rotation);
      phases.planet_offset_rad.push_back(
          std::abs(best_offset) < tolerance::kAngle_rad ? 0.0 : best_offset);
    }
  } else {
    for (double phi : phases.planet_position_rad) {
      phases.planet_rotation_rad.push_back(planet_rotation(phi));
      phases.planet_offset_rad.push_back(0.0);
    }
  }
  return phases;
}

}  // namespace trueflank
