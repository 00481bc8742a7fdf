// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/train/strength.h"
#include "trueflank/train/strength_form_factor.h"

// Tooth root and flank in the form of ISO 6336-2 and -3, beside JGMA: stresses with notch and contact ratio
// factors, limits with life and size factors, the rim's thickness, a load spectrum. docs/strength.md says which
// factor is computed and which is assumed.
namespace trueflank {

/// One mesh at a tangential force of 1 N on the reference circle of gear 1.
struct Iso6336Mesh {
  std::string name;
  struct Tooth {
    std::string gear;
    double form_factor = kNaN;        ///< Y_Fa, load at the tip
    double notch_factor = kNaN;       ///< Y_Sa
    double rim_factor = 1.0;          ///< Y_B; NaN: a rim so thin that the standard gives none
    double life_factor = 1.0;         ///< Y_NT
    double size_factor = 1.0;         ///< Y_X
    double sensitivity_factor = 1.0;  ///< Y_deltarelT
    double stress_per_n = kNaN;       ///< sigma_F0 [MPa/N]
    double limit_mpa = kNaN;          ///< sigma_FG
    double output_nm = kNaN;          ///< output torque at which this tooth reaches its limit
    double cycles = kNaN;             ///< of load, in the asked life; NaN: none asked
  };
  Tooth tooth1, tooth2;
  double zone_factor = kNaN, elasticity_factor = kNaN, contact_ratio_factor = kNaN, helix_factor = kNaN;
  double single_contact_factor1 = 1.0;  ///< Z_B of gear 1; Z_D of gear 2 beside it
  double single_contact_factor2 = 1.0;
  double contact_stress_per_root_n = kNaN;  ///< sigma_H0 at 1 N; grows with the root of the force [MPa/sqrt N]
  double contact_limit1_mpa = kNaN, contact_limit2_mpa = kNaN;  ///< sigma_HG
  double contact_output_nm = kNaN;
};

struct Iso6336Result {
  double output_torque_nm = kNaN;  ///< allowable at the output, rated torque of the spectrum
  std::string limiting_mesh, limiting_gear, limiting_mode;
  std::vector<Iso6336Mesh> meshes;
};

/// Y_Sa of ISO 6336-3 (DIN 3990-3) of a critical section.
[[nodiscard]] double notch_factor(const CriticalSection& section);
/// Y_B: external by rim over tooth height, internal by rim over module; NaN below the standard's range.
[[nodiscard]] double rim_factor(bool internal, double rim_mm, double tooth_height_mm, double module_mm);
/// Of a limit with a slope: (sum of share k^p)^(1/p), the constant torque that does the same damage.
[[nodiscard]] double equivalent_load(const std::vector<LoadStep>& spectrum, double exponent);

/// Errors: as strength().
[[nodiscard]] Result<Iso6336Result> strength_iso6336(const GearTrain& train, const StrengthOptions& options = {});

}  // namespace trueflank
