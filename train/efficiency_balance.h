// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/train/kinematics.h"

// Speeds, torques and powers of a train whose meshes lose a known share of the power that crosses
// them. Nothing but the topology, tooth numbers and mesh efficiencies goes in; theory:
// docs/efficiency.md.
namespace trueflank {

/// What a mesh leaves of the power that crosses it, seen from its arm. All planets of a set count as one.
struct MeshLosses {
  double driving1 = 1.0;  ///< efficiency where gear 1 drives
  double driving2 = 1.0;  ///< and where gear 2 drives
};

/// A train with its teeth and losses; speeds follow from topology and teeth.
struct BalanceTrain {
  Topology topology;
  std::vector<int> signed_teeth;  ///< of every gear, a ring's negative
  std::vector<MeshLosses> losses;  ///< of every mesh
  MemberSpeeds speeds;
};

/// Lossless. Tooth numbers in the order of the gears, a ring's negative.
[[nodiscard]] BalanceTrain balance_train(const Topology& topology, std::vector<int> signed_teeth);

/// A consistent state of the train driven at one shaft, per unit of driving torque and input speed: the
/// external torque on every member (in the order of Topology::members, sense of the input's turning
/// positive) and the flow through every mesh as seen from its arm.
struct BalanceState {
  double efficiency = kNaN;  ///< power out / power in; 0 where the train locks itself
  bool self_locking = false;
  std::vector<double> speed;  ///< per unit of input speed; backward the train turns the other way
  std::vector<double> torque;
  std::vector<double> power;  ///< + into the train, of the driving power
  struct MeshFlow {
    bool gear1_drives = true;     ///< seen from the arm
    double rolling_power = kNaN;  ///< that enters the mesh, of the driving power
    double loss = kNaN;           ///< share of the driving power the mesh costs
    double torque1 = kNaN, torque2 = kNaN;  ///< of the mesh on its gears, all planets together
  };
  std::vector<MeshFlow> meshes;
};

enum class DriveDirection { kForward, kBackward };

/// Solves the torque balance: every assignment of loss directions to the meshes that carry load is
/// tried, and only one in which each mesh really is driven as assumed is kept. Self-locking where none
/// of these delivers power: whatever drives, the other shaft has to be helped; efficiency and mesh
/// losses of a self-locking state are 0 and NaN. Idle meshes (idle_meshes) carry and lose nothing.
/// Guarantees: power in = power out + losses to rounding.
[[nodiscard]] BalanceState solve_balance(const BalanceTrain& train, DriveDirection direction);

/// How many of the assignments are consistent and deliver power: 1 for a train that runs, 0 for one
/// that locks. For tests: more than one would be an ambiguity of the friction model.
[[nodiscard]] int count_delivering_states(const BalanceTrain& train, DriveDirection direction);

}  // namespace trueflank
