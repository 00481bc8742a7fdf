// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency_balance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/contract.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// A mesh that carries load: its members and arm.
struct LoadedMesh {
  std::size_t index = 0;
  int member1 = 0, member2 = 0, arm = kHousing;
  double ratio = 1.0;  ///< speed of gear 2 over gear 1, seen from the arm
};

std::vector<LoadedMesh> loaded_meshes(const BalanceTrain& train) {
  const Topology& topology = train.topology;
  const std::vector<bool> idle = idle_meshes(topology);
  std::vector<LoadedMesh> loaded;
  for (std::size_t k = 0; k < topology.meshes.size(); ++k) {
    const TopologyMesh& mesh = topology.meshes[k];
    if (idle[k]) continue;
    const int z1 = train.signed_teeth[at(mesh.gear1)], z2 = train.signed_teeth[at(mesh.gear2)];
    loaded.push_back({.index = k,
                      .member1 = topology.gears[at(mesh.gear1)].member,
                      .member2 = topology.gears[at(mesh.gear2)].member,
                      .arm = topology.arm_of(mesh),
                      .ratio = -1.0 * z1 / z2});
  }
  return loaded;
}

/// The mesh torques on every member as a linear form of the torques on the first gears. An arm takes
/// what holds its meshes in balance about its own axis; planets are in balance themselves and drop out
/// of that sum.
Eigen::MatrixXd torques_on_members(const Topology& topology, const std::vector<LoadedMesh>& meshes,
                                   const std::vector<double>& torque_ratio) {
  const auto members = static_cast<Eigen::Index>(topology.members.size());
  const auto count = static_cast<Eigen::Index>(meshes.size());
  Eigen::MatrixXd of_meshes = Eigen::MatrixXd::Zero(members, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    of_meshes(meshes[at(static_cast<int>(k))].member1, k) += 1.0;
    of_meshes(meshes[at(static_cast<int>(k))].member2, k) += torque_ratio[at(static_cast<int>(k))];
  }
  Eigen::MatrixXd on_member = of_meshes;
  for (Eigen::Index k = 0; k < count; ++k) {
    const int arm = meshes[at(static_cast<int>(k))].arm;
    if (arm == kHousing) continue;
    for (Eigen::Index m = 0; m < members; ++m)
      if (topology.carrier_of(static_cast<int>(m)) != arm) on_member(arm, k) -= of_meshes(m, k);
  }
  return on_member;
}

bool is_free(const Topology& topology, int member) {
  return member != topology.input && member != topology.output &&
         std::find(topology.fixed.begin(), topology.fixed.end(), member) == topology.fixed.end();
}

/// Torques of the meshes on their first gears for one assignment of driving sides; nullopt where the
/// equations have no solution.
std::optional<Eigen::VectorXd> mesh_torques(const Topology& topology, const Eigen::MatrixXd& on_member,
                                            int driven_at, double driving_torque) {
  const Eigen::Index count = on_member.cols();
  Eigen::MatrixXd equations(0, count);
  const auto add_row = [&](int member) {
    equations.conservativeResize(equations.rows() + 1, Eigen::NoChange);
    equations.row(equations.rows() - 1) = on_member.row(member);
  };
  // members without an outer torque are in balance; those that idle have no row to give
  for (std::size_t m = 0; m < topology.members.size(); ++m)
    if (is_free(topology, static_cast<int>(m)) && !on_member.row(static_cast<Eigen::Index>(m)).isZero(0.0))
      add_row(static_cast<int>(m));
  add_row(driven_at);
  if (equations.rows() != count) return std::nullopt;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  right(count - 1) = -driving_torque;
  return solution_if_regular(equations, right);
}

/// One train and one direction, with what all assignments share.
struct Drive {
  const BalanceTrain& train;
  std::vector<LoadedMesh> meshes;
  int in = kNoMember, out = kNoMember;
};

/// External torques and powers of the members that go with the mesh flows.
void set_members(const Drive& drive, const Eigen::MatrixXd& on_member, const Eigen::VectorXd& torque1,
                 double driving_power, BalanceState& state) {
  const Topology& topology = drive.train.topology;
  const std::size_t members = topology.members.size();
  state.torque.assign(members, 0.0);
  state.power.assign(members, 0.0);
  for (std::size_t m = 0; m < members; ++m) {
    if (!is_free(topology, static_cast<int>(m)))
      for (Eigen::Index k = 0; k < torque1.size(); ++k)
        state.torque[m] -= on_member(static_cast<Eigen::Index>(m), k) * torque1(k);
    state.power[m] = state.torque[m] * state.speed[m] / driving_power;
  }
}

/// The state for one assignment (bit k set: gear 2 of loaded mesh k drives); nullopt where it
/// contradicts itself or delivers no power.
std::optional<BalanceState> delivering_state(const Drive& drive, unsigned gear2_drives) {
  const std::size_t count = drive.meshes.size();
  const MemberSpeeds& speeds = drive.train.speeds;
  std::vector<double> torque_ratio(count);
  for (std::size_t k = 0; k < count; ++k) {
    const MeshLosses& losses = drive.train.losses[drive.meshes[k].index];
    const double efficiency = gear2_drives >> k & 1U ? 1.0 / losses.driving2 : losses.driving1;
    if (!(efficiency > 0.0 && std::isfinite(efficiency))) return std::nullopt;  // blocked by friction
    torque_ratio[k] = -efficiency / drive.meshes[k].ratio;
  }
  // driving power is 1 per unit of torque and speed of the driving member
  const double driving_speed = speeds.of[at(drive.in)], driving_power = std::abs(driving_speed);
  const Eigen::MatrixXd on_member = torques_on_members(drive.train.topology, drive.meshes, torque_ratio);
  const auto torque1 =
      mesh_torques(drive.train.topology, on_member, drive.in, driving_speed < 0.0 ? -1.0 : 1.0);
  if (!torque1) return std::nullopt;

  BalanceState state;
  state.speed = speeds.of;
  BalanceState::MeshFlow idle;
  idle.rolling_power = idle.loss = idle.torque1 = idle.torque2 = 0.0;
  state.meshes.assign(drive.train.topology.meshes.size(), idle);
  for (std::size_t k = 0; k < count; ++k) {
    const LoadedMesh& mesh = drive.meshes[k];
    BalanceState::MeshFlow& flow = state.meshes[mesh.index];
    const double arm = speeds.of_arm(mesh.arm);
    flow.gear1_drives = !(gear2_drives >> k & 1U);
    flow.torque1 = (*torque1)(static_cast<Eigen::Index>(k));
    flow.torque2 = flow.torque1 * torque_ratio[k];
    const double into1 = -flow.torque1 * (speeds.of[at(mesh.member1)] - arm) / driving_power;
    const double into2 = -flow.torque2 * (speeds.of[at(mesh.member2)] - arm) / driving_power;
    if (flow.gear1_drives != (into1 > 0.0)) return std::nullopt;
    flow.rolling_power = flow.gear1_drives ? into1 : into2;
    flow.loss = into1 + into2;
  }
  set_members(drive, on_member, *torque1, driving_power, state);
  state.efficiency = -state.power[at(drive.out)];
  if (!(state.efficiency > 0.0)) return std::nullopt;
  return state;
}

bool can_carry(const Drive& drive) {
  return std::all_of(drive.meshes.begin(), drive.meshes.end(), [&](const LoadedMesh& mesh) {
    const MeshLosses& losses = drive.train.losses[mesh.index];
    return losses.driving1 > 0.0 && losses.driving2 > 0.0;
  });
}

std::vector<BalanceState> delivering_states(const BalanceTrain& train, DriveDirection direction) {
  std::vector<BalanceState> states;
  const Topology& topology = train.topology;
  const double output = train.speeds.output;
  if (!std::isfinite(output) || output == 0.0) return states;
  Drive drive{train, loaded_meshes(train), topology.input, topology.output};
  if (direction == DriveDirection::kBackward) std::swap(drive.in, drive.out);
  if (!can_carry(drive)) return states;
  for (unsigned assignment = 0; assignment < 1U << drive.meshes.size(); ++assignment)
    if (auto state = delivering_state(drive, assignment)) states.push_back(std::move(*state));
  return states;
}

}  // namespace

BalanceTrain balance_train(const Topology& topology, std::vector<int> signed_teeth) {
  MemberSpeeds speeds = member_speeds(topology, signed_teeth);
  return {.topology = topology,
          .signed_teeth = std::move(signed_teeth),
          .losses = std::vector<MeshLosses>(topology.meshes.size()),
          .speeds = std::move(speeds)};
}

BalanceState solve_balance(const BalanceTrain& train, DriveDirection direction) {
  TRUEFLANK_EXPECTS(train.losses.size() == train.topology.meshes.size());
  std::vector<BalanceState> states = delivering_states(train, direction);
  if (states.empty()) {
    BalanceState state;
    state.speed = train.speeds.of;
    state.efficiency = 0.0;
    state.self_locking = true;
    state.torque.assign(train.topology.members.size(), kNaN);
    state.power.assign(train.topology.members.size(), kNaN);
    state.meshes.resize(train.topology.meshes.size());
    return state;
  }
  // more than one does not happen (tested); the lossiest would be the cautious answer
  std::size_t worst = 0;
  for (std::size_t i = 1; i < states.size(); ++i)
    if (states[i].efficiency < states[worst].efficiency) worst = i;
  return std::move(states[worst]);
}

int count_delivering_states(const BalanceTrain& train, DriveDirection direction) {
  return static_cast<int>(delivering_states(train, direction).size());
}

}  // namespace trueflank
