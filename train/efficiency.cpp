// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/train/efficiency_sliding.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

MeshEfficiency mesh_efficiency(const GearTrain& train, const TrainMesh& mesh, double friction,
                               SlidingEfficiency& sliding) {
  const GearPair pair = train.pair(mesh);
  const ContactRatios ratios = contact_ratios(pair);
  MeshEfficiency result;
  result.name = mesh.name;
  result.by_contact_ratios =
      basic_efficiency({.teeth1 = pair.gear1().teeth,
                        .teeth2 = pair.gear2().teeth,
                        .internal = pair.internal(),
                        .approach = ratios.approach,
                        .recess = ratios.recess,
                        .base_helix_angle_rad = base_helix_angle_rad(pair.gear1())},
                       friction);
  result.formula_applies = contact_ratio_formula_applies(ratios.approach, ratios.recess);
  // the halves of a herringbone run alike: one of them tells
  const double helix_width = common_face(train, mesh).helix_mm;
  sliding = sliding_efficiency(contact_path(pair, helix_width), friction, LoadSharing::kEqual);
  result.by_path_integral = sliding.gear1_driving;
  return result;
}

const char* member_name(TrainKind kind, Member member) {
  switch (member) {
    case Member::kSun: return kind == TrainKind::kPair ? "pinion" : "sun";
    case Member::kPlanet: return "planet";
    case Member::kRing1:
      return kind == TrainKind::kPair ? "wheel" : kind == TrainKind::kSimple ? "ring" : "ring1";
    case Member::kRing2: return "ring2";
    case Member::kCarrier: return "carrier";
  }
  return "";
}

std::vector<Member> members_of(TrainKind kind) {
  if (kind == TrainKind::kPair) return {Member::kSun, Member::kRing1};
  std::vector<Member> members{Member::kSun, Member::kPlanet, Member::kCarrier, Member::kRing1};
  if (kind == TrainKind::k3k) members.push_back(Member::kRing2);
  return members;
}

DirectionEfficiency described(const GearTrain& train, const BalanceState& state) {
  DirectionEfficiency result;
  result.efficiency = state.efficiency;
  result.self_locking = state.self_locking;
  for (const Member member : members_of(train.design.kind)) {
    const auto m = static_cast<std::size_t>(member);
    result.members.push_back({.name = member_name(train.design.kind, member),
                              .speed = state.speed[m],
                              .torque = state.torque[m],
                              .power = state.power[m]});
  }
  for (std::size_t k = 0; k < state.meshes.size(); ++k) {
    const BalanceState::MeshFlow& flow = state.meshes[k];
    const TrainMesh& mesh = train.meshes[k];
    const int driving = flow.gear1_drives ? mesh.gear1 : mesh.gear2;
    result.meshes.push_back({.name = mesh.name,
                             .driving_gear = state.self_locking ? "" : train.gears[driving].name,
                             .rolling_power = flow.rolling_power,
                             .loss = flow.loss,
                             .torque1 = flow.torque1,
                             .torque2 = flow.torque2});
  }
  return result;
}

BalanceTrain balance_of(const GearTrain& train) {
  std::vector<int> teeth;
  for (const GearDesign& gear : train.design.gears) teeth.push_back(gear.teeth);
  BalanceTrain balance = balance_train(train.design.kind, train.design.output, teeth);
  for (std::size_t k = 0; k < balance.meshes.size(); ++k)
    balance.meshes[k].internal = train.pair(train.meshes[k]).internal();
  return balance;
}

/// A backward efficiency that the drag takes is 0 without self_locking: more load moves the drive.
void add_losses(const GearTrain& train, LossModel model, EfficiencyResult& result) {
  const double ratio = std::abs(1.0 / member_speeds(train).output);
  if (!std::isfinite(ratio)) return;
  const MeshEfficiencies meshes = [&](double forward, double backward) {
    const auto at = [&](double friction) {
      return efficiency(train, {.model = model, .friction = friction});
    };
    const double back = at(backward).backward;
    return std::pair(at(forward).forward, back);
  };
  result.losses = lossy_efficiency(*train.design.losses, train.design.friction, ratio, meshes);
  result.forward = result.losses->forward;
  result.backward = result.losses->backward;
}

}  // namespace

bool contact_ratio_formula_applies(double approach, double recess) {
  return approach >= 0.0 && recess >= 0.0 && approach <= 1.0 && recess <= 1.0 &&
         approach + recess >= 1.0;
}

double basic_efficiency(const BasicMesh& mesh, double friction) {
  const double e1 = mesh.approach, e2 = mesh.recess;
  const double curvature = 1.0 / mesh.teeth1 + (mesh.internal ? -1.0 : 1.0) / mesh.teeth2;
  return 1.0 - friction * kPi * curvature * (e1 * e1 + e2 * e2 - e1 - e2 + 1.0) /
                   std::cos(mesh.base_helix_angle_rad);
}

double EfficiencyResult::basic_efficiency_of(const std::string& mesh_name) const {
  for (const MeshEfficiency& mesh : meshes)
    if (mesh.name == mesh_name) return mesh.basic_efficiency;
  return kNaN;
}

EfficiencyResult efficiency(const GearTrain& train, const EfficiencyOptions& options) {
  EfficiencyResult result;
  result.friction = options.friction.value_or(train.design.friction);
  if (train.design.kind == TrainKind::kGear) return result;
  TRUEFLANK_EXPECTS(options.mesh_friction.empty() ||
                    options.mesh_friction.size() == train.meshes.size());
  BalanceTrain balance = balance_of(train);
  for (std::size_t k = 0; k < train.meshes.size(); ++k) {
    SlidingEfficiency sliding;
    const double friction =
        options.mesh_friction.empty() ? result.friction : options.mesh_friction[k];
    MeshEfficiency mesh = mesh_efficiency(train, train.meshes[k], friction, sliding);
    const bool exact = options.model == LossModel::kPathIntegral;
    balance.meshes[k].efficiency_driving1 = exact ? sliding.gear1_driving : mesh.by_contact_ratios;
    balance.meshes[k].efficiency_driving2 = exact ? sliding.gear2_driving : mesh.by_contact_ratios;
    mesh.basic_efficiency = balance.meshes[k].efficiency_driving1;
    result.meshes.push_back(std::move(mesh));
  }
  const BalanceState forward = solve_balance(balance, DriveDirection::kForward);
  const BalanceState backward = solve_balance(balance, DriveDirection::kBackward);
  result.forward = forward.efficiency;
  result.backward = backward.efficiency;
  result.self_locking = backward.self_locking;
  result.forward_locking = forward.self_locking;
  result.forward_drive = described(train, forward);
  result.backward_drive = described(train, backward);
  result.mesh_forward = result.forward;
  result.mesh_backward = result.backward;
  if (train.design.losses && !options.friction && options.mesh_friction.empty())
    add_losses(train, options.model, result);
  return result;
}

}  // namespace trueflank
