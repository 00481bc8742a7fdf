// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/result.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/gear.h"

// Flank tolerances of ISO 1328-1:2013.
namespace trueflank {

/// Flank tolerance classes of the standard.
inline constexpr int kFinestToleranceClass = 1, kCoarsestToleranceClass = 11;

/// Allowed deviations of one gear in one class, rounded as the standard rounds them [um].
struct FlankTolerances {
  double single_pitch_um = kNaN;            ///< f_pT, either sign
  double total_cumulative_pitch_um = kNaN;  ///< F_pT
  double profile_slope_um = kNaN;           ///< f_HalphaT, either sign
  double profile_form_um = kNaN;            ///< f_falphaT
  double total_profile_um = kNaN;           ///< F_alphaT
  double helix_slope_um = kNaN;             ///< f_HbetaT, either sign
  double helix_form_um = kNaN;              ///< f_fbetaT
  double total_helix_um = kNaN;             ///< F_betaT
  double runout_um = kNaN;                  ///< F_rT, informative in the standard
};

/// What the standard's formulas depend on.
struct ToleranceSize {
  int teeth = 0;
  double reference_diameter_mm = 0.0;
  double normal_module_mm = 0.0;
  double face_width_mm = 0.0;
  double helix_angle_rad = 0.0;
};
[[nodiscard]] ToleranceSize tolerance_size(const Gear& gear, double face_width_mm);

/// Errors: kOutOfRange outside of the standard's scope (5 <= z <= 1000, 5 <= d <= 15000 mm,
/// 0.5 <= m_n <= 70 mm, 4 <= b <= 1200 mm, helix at most 45 deg), from which it forbids to
/// extrapolate, with the one that is outside; kOutOfRange for a class that does not exist.
/// Source: ISO 1328-1:2013, 5.2 and 5.3, as public implementations have it.
[[nodiscard]] Result<FlankTolerances> flank_tolerances(const ToleranceSize& size,
                                                       int tolerance_class);

}  // namespace trueflank
