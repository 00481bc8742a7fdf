// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/units.h"
#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {

/// The root section that breaks, on the real profile, for a load at the tip.
struct CriticalSection {
  double form_factor = kNaN;     ///< Y_F, load at the tip
  double thickness_mm = kNaN;    ///< s_F, chord
  double lever_mm = kNaN;        ///< h_F, from the section to where the load crosses the tooth's middle
  double load_angle_rad = kNaN;  ///< between the load and the section's plane
  bool tangent_found = true;     ///< else the section of the greatest bending stress was taken
};

/// Tooth form factor Y_F = 6 (h_F/m) cos a_F / ((s_F/m)^2 cos a) from the exact root curve: the section
/// where the fillet's tangent stands at 30 degrees to the tooth's middle (ring: 60 degrees), tip load.
/// Where a sharp or very short fillet has no such tangent, the section of greatest bending stress.
/// Helical: transverse section, thickness brought to the normal section.
/// Accuracy: the tangent point is found to 1e-9 of the piece's parameter.
[[nodiscard]] CriticalSection critical_section(const ToothProfile& profile);

}  // namespace trueflank
