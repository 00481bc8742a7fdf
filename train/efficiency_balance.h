// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/train/gearbox_design.h"

// Speeds, torques and powers of a train whose meshes lose a known share of the power that crosses
// them. Nothing but tooth numbers and mesh efficiencies goes in; theory: docs/efficiency.md.
namespace trueflank {

/// Bodies that turn. A pair is the sun-ring1 mesh on a standing carrier.
enum class Member { kSun, kPlanet, kRing1, kRing2, kCarrier };
inline constexpr int kMemberCount = 5;

/// One mesh as the balance sees it. All planets of a set count as one.
struct BalanceMesh {
  Member member1 = Member::kSun, member2 = Member::kPlanet;
  int teeth1 = 1, teeth2 = 1;
  bool internal = false;
  double efficiency_driving1 = 1.0;  ///< basic efficiency where gear 1 drives, seen from the carrier
  double efficiency_driving2 = 1.0;  ///< and where gear 2 drives
};

/// Which members are held, driven and loaded. The input is always the sun (pinion).
struct BalanceTrain {
  std::vector<BalanceMesh> meshes;  ///< at most three
  Member output = Member::kRing2;
  Member fixed = Member::kRing1;
};

/// Tooth numbers in the order of gear_names(kind); lossless meshes, a pair's wheel external.
/// Requires: not a single gear.
[[nodiscard]] BalanceTrain balance_train(TrainKind kind, OutputMember output,
                                         const std::vector<int>& teeth);

/// Angular speed of every member per unit of sun speed, index = Member; members the train does not
/// have turn at 0. The output of a 3k with equal layers stands at exactly 0.
using Speeds = std::array<double, kMemberCount>;
[[nodiscard]] Speeds member_speeds(const BalanceTrain& train);

/// A consistent state of the train driven at one shaft, per unit of driving torque and sun speed:
/// the external torque on every member (index = Member, sense of the sun's turning positive) and
/// the flow through every mesh as seen from the carrier.
struct BalanceState {
  double efficiency = kNaN;  ///< power out / power in; 0 where the train locks itself
  bool self_locking = false;
  Speeds speed{};            ///< per unit of sun speed; backward the train turns the other way
  std::array<double, kMemberCount> torque{};
  std::array<double, kMemberCount> power{};  ///< + into the train, of the driving power
  struct MeshFlow {
    bool gear1_drives = true;     ///< seen from the carrier
    double rolling_power = kNaN;  ///< that enters the mesh, of the driving power
    double loss = kNaN;           ///< share of the driving power the mesh costs
    double torque1 = kNaN, torque2 = kNaN;  ///< of the mesh on its gears, all planets together
  };
  std::vector<MeshFlow> meshes;
};

enum class DriveDirection { kForward, kBackward };

/// Solves the torque balance: every assignment of loss directions to meshes is tried, and only one in
/// which each mesh really is driven as assumed is kept. Self-locking where none of these delivers
/// power: whatever drives, the other shaft has to be helped; efficiency and mesh losses of a
/// self-locking state are 0 and NaN.
/// Guarantees: power in = power out + losses to rounding.
[[nodiscard]] BalanceState solve_balance(const BalanceTrain& train, DriveDirection direction);

/// How many of the assignments are consistent and deliver power: 1 for a train that runs, 0 for one
/// that locks. For tests: more than one would be an ambiguity of the friction model.
[[nodiscard]] int count_delivering_states(const BalanceTrain& train, DriveDirection direction);

}  // namespace trueflank
