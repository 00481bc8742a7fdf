// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/geometry/toothing.h"

namespace trueflank {

/// The transverse section of a modified toothing at a height.
struct ToothSection {
  ToothProfile profile;   ///< symmetric about its tooth; where nothing deviates the design's own
  double turn_rad = 0.0;  ///< of the whole section, + counter-clockwise, beyond the twist
  bool as_designed = true;
};

/// Splits what the deviation does at a height into what is alike on both flanks (the profile) and
/// what turns the tooth (a helix slope). Tooth 0 stands for all.
/// Requires: the deviation is the same on every tooth, and what differs between the flanks is the
/// same over the roll length (design_deviation's fields are so).
/// Not included: edge chamfer (it only removes, at the very ends) and the displacement. A turn takes
/// the fillet along, which on the real tooth fades to nothing at the root circle.
/// Accuracy: 1e-10 mm of section_point; where the tooth is turned by a helix slope, that deviation
/// times the steepness of the profile's (10 um and 8 um over 1.5 mm: 0.05 um), as the exact section is
/// then no longer symmetric. Tested in tests/geometry/section_profile_test.cpp.
[[nodiscard]] ToothSection section_profile(const Toothing& toothing, double z_mm);

}  // namespace trueflank
