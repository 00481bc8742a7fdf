// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/machine/machine_layout.h"

// What the layouts of every train have in common: the motor's side and the output's side. Each step
// reads and fills the layout that it is given.
namespace trueflank {

/// Free height between the motor's collar and the hub on its shaft, and between a gear and its stop.
inline constexpr double kHubGap_mm = 0.5;
/// Room beside a hub that passes no planet.
inline constexpr double kNoPlanet_mm = 1e300;
/// A hub stays this part of the module inside the roots.
inline constexpr double kHubInset = 0.1;

/// Walls, fits and clearance, of the design and its process.
void settle_walls(const GearboxDesign& design, MachineLayout& m);

/// The floor under a cavity that begins at a height, `least_mm` thick at least, with the motor's
/// screws in it.
void place_floor(const MachineDesign& machine, double cavity_mm, double least_mm, MachineLayout& m);

/// The motor's shaft, and the hub of the gear on it as wide as the roots let it and as the heads of
/// the motor's screws do. Requires: the floor; the driven gear.
void place_shaft(const Motor& motor, MachineLayout& m);
void widen_hub(const TrainGear& gear, const MachineDesign& machine, MachineLayout& m);

/// The set screw of a gear on a round shaft, where the floor has room for it in a hole of at most
/// this radius; its heights follow with the hub. And the least floor that it wants.
void plan_set_screw(const GearTrain& train, double hole_room_mm, MachineLayout& m);
[[nodiscard]] double floor_of_set_screw_mm(const Motor& motor, const MachineLayout& m);
/// Puts it into the hub, and sizes the hole in the floor that collar and hub go through. Requires: the hub.
void place_set_screw(const GearTrain& train, MachineLayout& m);
/// Radius that the heads of the motor's screws leave for that hole.
[[nodiscard]] double room_of_hole_mm(const MachineDesign& machine, const MachineLayout& m);

/// The cup that a ring makes which drives out: its wall, and the disc over it from a height on.
void place_cup(const TrainGear& ring, const Screw& output, double disc_mm, MachineLayout& m);

/// From the disc that carries it: retainer, bearings, roof of the lid, plate, and their screws.
/// Requires: m.disc, m.output_axis.
void place_output(const MachineDesign& machine, MachineLayout& m);

/// Lays out a pair of gears on parallel axes, the wheel external or a ring around its pinion.
[[nodiscard]] MachineLayout pair_layout(const GearTrain& train, const MachineDesign& machine);

}  // namespace trueflank
