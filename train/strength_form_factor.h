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
  double fillet_radius_mm = kNaN;  ///< of curvature, where the section meets the fillet
  bool tangent_found = true;     ///< else the section of the greatest bending stress was taken
};

/// Tooth form factor Y_F = 6 (h_F/m) cos a_F / ((s_F/m)^2 cos a) from the exact root curve: the section
/// where the fillet's tangent stands at 30 degrees to the tooth's middle (ring: 60 degrees), tip load.
/// Where a sharp or very short fillet has no such tangent, the section of greatest bending stress.
/// Helical: transverse section, thickness brought to the normal section; form_factor does it better.
/// Accuracy: the tangent point is found to 1e-9 of the piece's parameter.
[[nodiscard]] CriticalSection critical_section(const ToothProfile& profile);

/// The critical section of a gear: its own for spur teeth; for helical ones of the virtual spur gear in the
/// normal section, z_n = z / (cos^2 beta_b cos beta) teeth with the same rack, shift and tooth heights
/// (ISO 6336-3, JGMA 401-01), between the two whole numbers of teeth next to it. A shaped ring, whose
/// cutter has no virtual one, and a virtual gear that does not exist count by the transverse section.
[[nodiscard]] CriticalSection normal_section(const ToothProfile& profile);
/// Y_F of it.
[[nodiscard]] double form_factor(const ToothProfile& profile);

}  // namespace trueflank
