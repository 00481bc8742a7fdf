// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency.h"

#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

MeshEfficiency mesh_efficiency(const GearTrain& train, const TrainMesh& mesh, double friction) {
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
  result.formula_applies = contact_ratio_formula_applies(pair);
  // the halves of a herringbone run alike: one of them tells
  const double helix_width = common_face(train, mesh).helix_mm;
  const SlidingEfficiency sliding =
      sliding_efficiency(contact_path(pair, helix_width), friction, kLoadSharing);
  result.by_path_integral = sliding.gear1_driving;
  result.by_path_integral_gear2_driving = sliding.gear2_driving;
  return result;
}

DirectionEfficiency described(const GearTrain& train, const BalanceState& state) {
  DirectionEfficiency result;
  result.efficiency = state.efficiency;
  result.self_locking = state.self_locking;
  for (std::size_t m = 0; m < state.speed.size(); ++m)
    result.members.push_back({.name = train.topology().members[m].name,
                              .speed = state.speed[m],
                              .torque = state.torque[m],
                              .power = state.power[m]});
  for (std::size_t k = 0; k < state.meshes.size(); ++k) {
    const BalanceState::MeshFlow& flow = state.meshes[k];
    const TrainMesh& mesh = train.meshes[k];
    const bool idle = state.self_locking || flow.torque1 == 0.0;
    result.meshes.push_back({.name = mesh.name,
                             .driving_gear = idle ? "" : train.gear(flow.gear1_drives ? mesh.gear1 : mesh.gear2).name,
                             .rolling_power = flow.rolling_power,
                             .loss = flow.loss,
                             .torque1 = flow.torque1,
                             .torque2 = flow.torque2});
  }
  return result;
}

BalanceTrain balance_of(const GearTrain& train) {
  return {.topology = train.topology(),
          .signed_teeth = signed_teeth(train.design),
          .losses = std::vector<MeshLosses>(train.meshes.size()),
          .speeds = train.speeds};
}

/// Both directions with the meshes' efficiencies by one model.
struct BothDirections {
  BalanceState forward, backward;
};

/// Where contact is interrupted in a mesh: speeds, and nothing else.
BalanceState unknown_state(const BalanceTrain& balance) {
  BalanceState state;
  state.speed = balance.speeds.of;
  state.torque.assign(state.speed.size(), kNaN);
  state.power.assign(state.speed.size(), kNaN);
  state.efficiency = kNaN;
  state.meshes.resize(balance.losses.size());
  return state;
}

BothDirections both_directions(BalanceTrain balance, const std::vector<MeshEfficiency>& meshes,
                               LossModel model) {
  const std::vector<bool> idle = idle_meshes(balance.topology);
  bool known = true;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const MeshEfficiency& mesh = meshes[k];
    const bool exact = model == LossModel::kPathIntegral;
    balance.losses[k] = {.driving1 = exact ? mesh.by_path_integral : mesh.by_contact_ratios,
                         .driving2 = exact ? mesh.by_path_integral_gear2_driving : mesh.by_contact_ratios};
    known = known && (idle[k] || !std::isnan(balance.losses[k].driving1));
  }
  if (!known) return {unknown_state(balance), unknown_state(balance)};
  return {solve_balance(balance, DriveDirection::kForward),
          solve_balance(balance, DriveDirection::kBackward)};
}

FormulaEfficiency formula_efficiency(const BalanceTrain& balance,
                                     const std::vector<MeshEfficiency>& meshes) {
  const BothDirections states = both_directions(balance, meshes, LossModel::kContactRatios);
  const std::vector<bool> idle = idle_meshes(balance.topology);
  bool applies = true;
  for (std::size_t k = 0; k < meshes.size(); ++k) applies = applies && (idle[k] || meshes[k].formula_applies);
  return {.forward = states.forward.efficiency,
          .backward = states.backward.efficiency,
          .self_locking = states.backward.self_locking,
          .applies = applies};
}

/// A backward efficiency that the drag takes is 0 without self_locking: more load moves the drive.
void add_losses(const GearTrain& train, LossModel model, EfficiencyResult& result) {
  const double ratio = std::abs(1.0 / train.speeds.output);
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

bool contact_ratio_formula_applies(const GearPair& pair) {
  const ContactRatios ratios = contact_ratios(pair);
  // as a share of the base pitch; far below what a loss could show
  const bool whole = std::abs(ratios.total - ratios.effective) < 1e-9;
  return whole && pair.gear1().helix_angle_rad == 0.0 &&
         contact_ratio_formula_applies(ratios.approach, ratios.recess);
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
  if (train.meshes.empty()) return result;
  TRUEFLANK_EXPECTS(options.mesh_friction.empty() ||
                    options.mesh_friction.size() == train.meshes.size());
  for (std::size_t k = 0; k < train.meshes.size(); ++k) {
    const double friction =
        options.mesh_friction.empty() ? result.friction : options.mesh_friction[k];
    MeshEfficiency mesh = mesh_efficiency(train, train.meshes[k], friction);
    mesh.basic_efficiency = options.model == LossModel::kPathIntegral ? mesh.by_path_integral
                                                                      : mesh.by_contact_ratios;
    result.meshes.push_back(std::move(mesh));
  }
  const BalanceTrain balance = balance_of(train);
  const auto [forward, backward] = both_directions(balance, result.meshes, options.model);
  result.by_formula = formula_efficiency(balance, result.meshes);
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
