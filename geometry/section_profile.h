// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/geometry/toothing.h"

namespace trueflank {

/// The transverse section of a modified toothing at a height, in the frame of the design's section (not
/// turned by the twist).
struct ToothSection {
  ToothProfile profile;  ///< its halves differ where the flanks deviate unlike (a helix slope)
  bool as_designed = true;  ///< nothing deviates here
};

/// The section as it is made: tips, flanks and the fillets that fade to the root circle are those of
/// section_point, on either side. Tooth 0 stands for all.
/// Requires: the deviation is the same on every tooth.
/// Not included: edge chamfer (it only removes, at the very ends) and the displacement.
/// Accuracy: 1e-10 mm of section_point, tested in tests/geometry/section_profile_test.cpp.
[[nodiscard]] ToothSection section_profile(const Toothing& toothing, double z_mm);

}  // namespace trueflank
