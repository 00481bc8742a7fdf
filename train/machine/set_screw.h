// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/train/machine/machine_layout.h"

// What a set screw across a hub needs besides the shape of the hub (docs/gearbox.md).
namespace trueflank {

/// What to order, by standard: the screw, and its nut where it has one. None without a set screw.
[[nodiscard]] std::vector<std::string> bought_for_set_screw(const MachineLayout::SetScrew& screw);

/// What is left to do on the gear before it goes on the shaft; empty without a set screw.
[[nodiscard]] std::string set_screw_operation(const MachineLayout& layout);

/// Width across flats of the screw's socket. Source: ISO 4029.
[[nodiscard]] double set_screw_key_mm(const MachineLayout::SetScrew& screw);

/// Torque that it holds by friction on a shaft, the bore's opposite side included. The force is what
/// its tightening torque gives, or what the plastic behind its nut bears.
[[nodiscard]] double held_torque_nm(const MachineLayout::SetScrew& screw, double shaft_diameter_mm);

/// Length of the shaft's flat that is in the bore.
[[nodiscard]] double flat_in_bore_mm(const MachineLayout& layout);

/// Torque that a bore with a flat holds on so much of the shaft's flat: half its width bears, as
/// hard as the material of the bore stands for a while (60 MPa printed, else 150; a rule of thumb).
[[nodiscard]] double held_by_flat_nm(const GearTrain& train, double flat_in_bore_mm);

}  // namespace trueflank
