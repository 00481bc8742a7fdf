// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/base/units.h"
#include "trueflank/train/gear_train.h"
#include "trueflank/train/materials.h"

// Allowable torque by tooth root bending and surface durability, in the form of JGMA 401-01 and
// 402-01 (ISO 6336 has the same Y_F, Y_beta, Z_H and Z_E). docs/strength.md says which factor is what.
namespace trueflank {

struct StrengthOptions {
  MaterialTable materials;
  std::string material = kDefaultMaterial;         ///< of every gear not named below
  std::map<std::string, std::string> material_of;  ///< gear name -> material name
  /// The drive is loaded both ways: every tooth bends both ways. Otherwise only those of planets that
  /// are driven on one flank and drive with the other.
  bool reversing = true;
  double overload_factor = 1.0;         ///< K_O, assumed
  double dynamic_factor = 1.0;          ///< K_V, assumed
  double face_load_factor = 1.0;        ///< K_Hbeta, assumed
  double planet_load_factor = 1.0;      ///< worst planet's share over the mean, assumed
  double bending_life_factor = 1.0;     ///< K_L, 1 for 1e7 cycles and more
  double contact_life_factor = 1.0;     ///< K_HL
  double lubrication_factor = 1.0;      ///< Z_L Z_R Z_V Z_W together, assumed
  double bending_safety = 1.2;          ///< S_F
  double contact_safety = 1.15;         ///< S_H
  std::optional<double> input_speed_rpm = {};  ///< omitted: no cycles, no temperature
  std::optional<double> life_h = {};           ///< omitted: the endurance limit
  double ambient_c = 20.0;
  std::string lubrication = "grease";   ///< of plastics: dry, grease, oil
  std::vector<LoadStep> spectrum = {};  ///< empty: the rated torque all the time
};

/// One factor of the calculation and whether it came from the geometry or from the options.
struct StrengthFactor {
  std::string symbol;
  double value = kNaN;
  bool computed = false;
};

/// Strength of one mesh; torques of all planets together.
struct MeshStrength {
  std::string name;
  struct Tooth {
    std::string gear;
    std::string material;
    double form_factor = kNaN;        ///< Y_F
    bool bends_both_ways = false;     ///< sigma_Flim x 2/3
    double bending_force_n = kNaN;    ///< allowable tangential force of one mesh at the reference circle
    double bending_torque_nm = kNaN;  ///< allowable torque on this gear, all planets together
  };
  Tooth tooth1, tooth2;
  double contact_force_n = kNaN;      ///< allowable by surface durability, of one mesh
  double contact_torque1_nm = kNaN;   ///< on gear 1, all planets together
  double bending_output_nm = kNaN;    ///< output torque at which the weaker tooth reaches its bending limit
  double contact_output_nm = kNaN;    ///< output torque at which the flanks reach theirs
  std::vector<StrengthFactor> factors;
};

struct StrengthResult {
  double output_torque_nm = kNaN;  ///< allowable at the output, the input driving; NaN where that locks
  double input_torque_nm = kNaN;   ///< that goes with it, friction included
  std::string limiting_mesh;
  std::string limiting_gear;  ///< by bending; both gears' names by contact: "sun, planet1"
  std::string limiting_mode;  ///< "bending" or "contact"
  std::vector<MeshStrength> meshes;
};

/// Options with what the design says of them; a pair that says nothing runs one way.
[[nodiscard]] StrengthOptions with_factors_of(const GearboxDesign& design, StrengthOptions options);

/// Errors: kInconsistent where a material is not in the table.
[[nodiscard]] Result<StrengthResult> strength(const GearTrain& train,
                                              const StrengthOptions& options = {});

}  // namespace trueflank
