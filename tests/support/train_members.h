// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "trueflank/train/gear_train.h"
#include "trueflank/train/inertia.h"

// Members of a train by their names, as tests speak of them.
namespace trueflank::test {

/// Of a design that a test takes to be right; throws what is wrong where it is not.
inline GearTrain laid_out(const GearboxDesign& design) {
  auto train = lay_out(design);
  if (!train) throw std::runtime_error(train.error().front().message);
  return std::move(*train);
}

/// Per unit of input speed.
inline double speed_of(const GearTrain& train, std::string_view member) {
  return train.speeds.of.at(static_cast<std::size_t>(train.topology().find_member(member)));
}

/// Of a body that is there once.
inline double rotation_of(const GearTrain& train, const AssemblyPhases& phases, std::string_view member) {
  return phases.rotation_rad(train.topology().find_member(member), 0);
}

/// Offsets of a later gear against the first of its body, planet by planet.
inline const std::vector<double>& offsets_of(const GearTrain& train, std::string_view gear) {
  return train.phases.gear_offset_rad.at(static_cast<std::size_t>(train.topology().find_gear(gear)));
}

/// Inertias with those given by name, all others 0.
inline BodyInertia& inertia_of(const GearTrain& train, BodyInertias& bodies, std::string_view member) {
  bodies.resize(train.topology().members.size());
  return bodies.at(static_cast<std::size_t>(train.topology().find_member(member)));
}

}  // namespace trueflank::test
