// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency_balance.h"

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

constexpr int index_of(Member member) { return static_cast<int>(member); }

/// Speed ratio of gear 2 to gear 1 of a mesh, seen from the carrier.
double relative_ratio(const BalanceMesh& mesh) {
  return (mesh.internal ? 1.0 : -1.0) * mesh.teeth1 / mesh.teeth2;
}

bool has_free_carrier(const BalanceTrain& train) {
  return train.output != Member::kCarrier && train.fixed != Member::kCarrier;
}

double relative_speed(const Speeds& speed, Member member) {
  return speed[index_of(member)] - speed[index_of(Member::kCarrier)];
}

/// 3k with z_r1 / z_p1 = z_r2 / z_p2: the output stands still.
bool layers_are_equal(const BalanceTrain& train) {
  const BalanceMesh &layer1 = train.meshes[1], &layer2 = train.meshes[2];
  return static_cast<long long>(layer1.teeth2) * layer2.teeth1 ==
         static_cast<long long>(layer1.teeth1) * layer2.teeth2;
}

/// Torques of the meshes on their first gears for one assignment of driving sides; nullopt where the
/// equations have no solution.
std::optional<Eigen::VectorXd> mesh_torques(const BalanceTrain& train,
                                            const std::vector<double>& torque_ratio,
                                            Member driven_at, double driving_torque) {
  const auto count = static_cast<Eigen::Index>(train.meshes.size());
  // row m: sum of the mesh torques on member m as a linear form of the torques on the first gears
  Eigen::MatrixXd on_member = Eigen::MatrixXd::Zero(kMemberCount, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const BalanceMesh& mesh = train.meshes[k];
    on_member(index_of(mesh.member1), k) += 1.0;
    on_member(index_of(mesh.member2), k) += torque_ratio[k];
  }
  // the carrier takes what holds the whole in balance about the central axis
  for (const Member member : {Member::kSun, Member::kRing1, Member::kRing2})
    on_member.row(index_of(Member::kCarrier)) -= on_member.row(index_of(member));

  Eigen::MatrixXd equations(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  Eigen::Index row = 0;
  if (count > 1) equations.row(row++) = on_member.row(index_of(Member::kPlanet));
  if (count > 2) equations.row(row++) = on_member.row(index_of(Member::kCarrier));
  equations.row(row) = on_member.row(index_of(driven_at));
  right(row) = -driving_torque;
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(equations);
  if (!lu.isInvertible()) return std::nullopt;
  return lu.solve(right);
}

/// The state for one assignment (bit k set: gear 2 of mesh k drives); nullopt where it contradicts
/// itself or delivers no power.
std::optional<BalanceState> delivering_state(const BalanceTrain& train, const Speeds& speed,
                                             DriveDirection direction, unsigned gear2_drives) {
  const std::size_t count = train.meshes.size();
  std::vector<double> torque_ratio(count);
  for (std::size_t k = 0; k < count; ++k) {
    const BalanceMesh& mesh = train.meshes[k];
    const double efficiency =
        gear2_drives >> k & 1U ? 1.0 / mesh.efficiency_driving2 : mesh.efficiency_driving1;
    torque_ratio[k] = -efficiency / relative_ratio(mesh);
  }
  const Member in = direction == DriveDirection::kForward ? Member::kSun : train.output;
  const Member out = direction == DriveDirection::kForward ? train.output : Member::kSun;
  // driving power is 1 per unit of torque and speed of the driving member
  const double sense = speed[index_of(in)] < 0.0 ? -1.0 : 1.0;
  const auto torque1 = mesh_torques(train, torque_ratio, in, sense);
  if (!torque1) return std::nullopt;
  const double driving_power = std::abs(speed[index_of(in)]);

  BalanceState state;
  state.speed = speed;
  for (std::size_t k = 0; k < count; ++k) {
    const BalanceMesh& mesh = train.meshes[k];
    BalanceState::MeshFlow flow;
    flow.gear1_drives = !(gear2_drives >> k & 1U);
    flow.torque1 = (*torque1)(static_cast<Eigen::Index>(k));
    flow.torque2 = flow.torque1 * torque_ratio[k];
    const double into1 = -flow.torque1 * relative_speed(speed, mesh.member1) / driving_power;
    const double into2 = -flow.torque2 * relative_speed(speed, mesh.member2) / driving_power;
    if (flow.gear1_drives != (into1 > 0.0)) return std::nullopt;
    flow.rolling_power = flow.gear1_drives ? into1 : into2;
    flow.loss = into1 + into2;
    state.torque[index_of(mesh.member1)] -= flow.torque1;
    state.torque[index_of(mesh.member2)] -= flow.torque2;
    state.meshes.push_back(flow);
  }
  for (const Member member : {Member::kSun, Member::kRing1, Member::kRing2})
    state.torque[index_of(Member::kCarrier)] -= state.torque[index_of(member)];
  state.torque[index_of(Member::kPlanet)] = 0.0;
  if (has_free_carrier(train)) state.torque[index_of(Member::kCarrier)] = 0.0;
  for (int m = 0; m < kMemberCount; ++m)
    state.power[m] = state.torque[m] * speed[m] / driving_power;
  state.efficiency = -state.power[index_of(out)];
  if (!(state.efficiency > 0.0)) return std::nullopt;
  return state;
}

bool meshes_can_carry(const BalanceTrain& train) {
  for (const BalanceMesh& mesh : train.meshes)
    if (!(mesh.efficiency_driving1 > 0.0 && mesh.efficiency_driving2 > 0.0)) return false;
  return true;
}

std::vector<BalanceState> delivering_states(const BalanceTrain& train, DriveDirection direction) {
  std::vector<BalanceState> states;
  const Speeds speed = member_speeds(train);
  const double output = speed[index_of(train.output)];
  if (!std::isfinite(output) || output == 0.0 || !meshes_can_carry(train)) return states;
  for (unsigned assignment = 0; assignment < 1U << train.meshes.size(); ++assignment)
    if (auto state = delivering_state(train, speed, direction, assignment))
      states.push_back(std::move(*state));
  return states;
}

}  // namespace

BalanceTrain balance_train(TrainKind kind, OutputMember output, const std::vector<int>& teeth) {
  BalanceTrain train;
  TRUEFLANK_EXPECTS(kind != TrainKind::kGear && teeth.size() == gear_names(kind).size());
  if (kind == TrainKind::kPair) {
    train.meshes.push_back({Member::kSun, Member::kRing1, teeth[0], teeth[1], false, 1.0, 1.0});
    train.output = Member::kRing1;
    train.fixed = Member::kCarrier;
    return train;
  }
  train.meshes.push_back({Member::kSun, Member::kPlanet, teeth[0], teeth[1], false, 1.0, 1.0});
  train.meshes.push_back({Member::kPlanet, Member::kRing1, teeth[1], teeth[2], true, 1.0, 1.0});
  if (kind == TrainKind::kSimple) {
    const bool ring_out = output == OutputMember::kRing;
    train.output = ring_out ? Member::kRing1 : Member::kCarrier;
    train.fixed = ring_out ? Member::kCarrier : Member::kRing1;
    return train;
  }
  train.meshes.push_back({Member::kPlanet, Member::kRing2, teeth[3], teeth[4], true, 1.0, 1.0});
  const bool type2 = output == OutputMember::kRing1;
  train.output = type2 ? Member::kRing1 : Member::kRing2;
  train.fixed = type2 ? Member::kRing2 : Member::kRing1;
  return train;
}

Speeds member_speeds(const BalanceTrain& train) {
  // seen from the carrier everything follows from the sun
  Speeds relative{};
  relative[index_of(Member::kSun)] = 1.0;
  for (const BalanceMesh& mesh : train.meshes)
    relative[index_of(mesh.member2)] = relative[index_of(mesh.member1)] * relative_ratio(mesh);
  // the fixed member stands: carrier + relative (1 - carrier) = 0
  const double fixed = relative[index_of(train.fixed)];
  const double carrier = train.fixed == Member::kCarrier ? 0.0 : fixed / (fixed - 1.0);
  Speeds speed{};
  speed[index_of(Member::kSun)] = 1.0;
  speed[index_of(Member::kCarrier)] = carrier;
  for (const BalanceMesh& mesh : train.meshes)
    if (mesh.member2 != train.fixed)
      speed[index_of(mesh.member2)] = carrier + relative[index_of(mesh.member2)] * (1.0 - carrier);
  if (train.meshes.size() == 3 && layers_are_equal(train))
    speed[index_of(train.output)] = 0.0;  // and not a rounding error of the sum above
  return speed;
}

BalanceState solve_balance(const BalanceTrain& train, DriveDirection direction) {
  std::vector<BalanceState> states = delivering_states(train, direction);
  if (states.empty()) {
    BalanceState state;
    state.speed = member_speeds(train);
    state.efficiency = 0.0;
    state.self_locking = true;
    state.torque.fill(kNaN);
    state.power.fill(kNaN);
    state.meshes.resize(train.meshes.size());
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
