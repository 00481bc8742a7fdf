// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/train/efficiency_balance.h"
#include "trueflank/train/efficiency_sliding.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/losses.h"

namespace trueflank {

/// What a mesh's basic efficiency is taken from.
enum class LossModel {
  kContactRatios,  ///< the paper's formula from approach and recess contact ratio
  kPathIntegral,   ///< sliding loss integrated along the path of contact (efficiency_sliding.h)
};
/// How tooth pairs share the load in every figure here.
inline constexpr LoadSharing kLoadSharing = LoadSharing::kEqual;

struct EfficiencyOptions {
  LossModel model = LossModel::kPathIntegral;
  std::optional<double> friction = {};  ///< instead of the design's
  std::vector<double> mesh_friction = {};  ///< of each mesh, instead of `friction`; empty: all alike
};

/// Basic efficiency of one mesh, 1 - mu pi (1/z1 +- 1/z2) (e1^2 + e2^2 - e1 - e2 + 1) / cos beta_b,
/// + external, - internal. Exact to first order in mu where contact_ratio_formula_applies; outside that it
/// is the same polynomial and no more.
/// Source: H. Matsuki, K. Nagano, Y. Fujimoto, 10.1109/TMECH.2019.2946403, section III.
struct BasicMesh {
  int teeth1 = 1, teeth2 = 1;
  bool internal = false;
  double approach = kNaN, recess = kNaN;  ///< contact ratios e1, e2
  double base_helix_angle_rad = 0.0;
};
[[nodiscard]] double basic_efficiency(const BasicMesh& mesh, double friction);
/// 0 <= e1, e2 <= 1 and e1 + e2 >= 1: one or two pairs touch, and the pitch point lies where it is one.
[[nodiscard]] bool contact_ratio_formula_applies(double approach, double recess);
/// The same of a pair as it is: also no undercut or root form circle takes contact away, and the teeth are
/// spur (helical ones share the load over their lines of contact).
[[nodiscard]] bool contact_ratio_formula_applies(const GearPair& pair);

/// What one mesh does and costs, gear 1 being the inner gear.
struct MeshEfficiency {
  std::string name;                ///< "sun-planet1", ...
  double basic_efficiency = kNaN;  ///< by the chosen model, gear 1 driving
  double by_contact_ratios = kNaN; ///< the paper's formula, the same whichever gear drives
  double by_path_integral = kNaN;  ///< exact sliding loss, gear 1 driving; NaN: contact is interrupted
  double by_path_integral_gear2_driving = kNaN;
  bool formula_applies = true;     ///< contact_ratio_formula_applies of the pair
};

/// A direction of drive, everything per unit of driving torque and of input speed.
struct DirectionEfficiency {
  double efficiency = kNaN;
  bool self_locking = false;
  struct MemberFlow {
    std::string name;  ///< of the body: sun, planet, carrier, ring1, ...
    double speed = kNaN, torque = kNaN, power = kNaN;
  };
  struct MeshFlow {
    std::string name;
    std::string driving_gear;     ///< as seen from the carrier; empty where nothing drives
    double rolling_power = kNaN;  ///< through the mesh, of the driving power
    double loss = kNaN;           ///< of the driving power
    double torque1 = kNaN, torque2 = kNaN;  ///< on gear 1 and 2, all planets together
  };
  std::vector<MemberFlow> members;
  std::vector<MeshFlow> meshes;
};

/// The train with the paper's formula in every mesh; friction of the meshes alone.
struct FormulaEfficiency {
  double forward = kNaN, backward = kNaN;
  bool self_locking = false;
  bool applies = false;  ///< in every mesh
};

struct EfficiencyResult {
  double friction = kNaN;
  double forward = kNaN;      ///< the input drives; NaN for a single gear, or interrupted contact
  double backward = kNaN;     ///< output drives; 0 where self-locking
  double mesh_forward = kNaN, mesh_backward = kNaN;  ///< of the meshes alone
  std::optional<LossyEfficiency> losses = {};  ///< of a design with [losses]: forward, backward are its
  bool self_locking = false;  ///< backward: the output cannot drive the train, whatever its torque
  bool forward_locking = false;  ///< the input cannot drive it either (a speed-increasing train)
  FormulaEfficiency by_formula;
  std::vector<MeshEfficiency> meshes;  ///< in the order of the train
  DirectionEfficiency forward_drive, backward_drive;

  /// NaN where there is no such mesh.
  [[nodiscard]] double basic_efficiency_of(const std::string& mesh_name) const;
};

/// Efficiency of a laid-out train from its shifted geometry: both directions, every member and mesh.
/// Every mesh loses what the gear that drives it in that direction loses. Friction in the meshes, and what the design's [losses] say of bearings, seals and churning, unless a
/// friction is given here: then the meshes alone. Flows and mesh losses are always those of the meshes.
[[nodiscard]] EfficiencyResult efficiency(const GearTrain& train,
                                          const EfficiencyOptions& options = {});

}  // namespace trueflank
