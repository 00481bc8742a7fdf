// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/strength.h"

// Teeth of plastics in the form of VDI 2736 part 2: root and flank against limits that fall with the tooth's own
// temperature and the cycles, wear, deformation. docs/strength.md says which figures are assumed.
namespace trueflank {

/// One gear of a plastic, at the allowable output torque.
struct PlasticTooth {
  std::string mesh, gear, material;
  double root_c = kNaN, flank_c = kNaN;  ///< temperatures; the surroundings' where no speed is said
  double root_limit_mpa = kNaN, flank_limit_mpa = kNaN;
  double root_stress_mpa = kNaN, flank_stress_mpa = kNaN;
  double cycles = kNaN;      ///< 1e8 where no life is said
  double wear_um = kNaN;     ///< of the flank over the life, dry; NaN: greased, oiled, or no coefficient known
  double bent_um = kNaN;     ///< the tooth's tip, in the direction of turning
};

struct PlasticResult {
  double output_torque_nm = kNaN;  ///< rated torque of the spectrum; NaN where no mesh has a plastic gear
  std::string limiting_gear, limiting_mode;  ///< "root", "flank", "temperature"
  std::vector<PlasticTooth> teeth;
};

/// The torque is sought at which the first tooth reaches a limit that its own heat lowers.
/// Errors: as strength().
[[nodiscard]] Result<PlasticResult> strength_plastic(const GearTrain& train, const StrengthOptions& options = {});

}  // namespace trueflank
