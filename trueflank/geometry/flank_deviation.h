// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "trueflank/geometry/gear.h"

namespace trueflank {

/// A deviation of the flanks along their outward normal (+ = more material) as a field over tooth,
/// flank, roll length and height. The one mechanism for design modifications (relief, crowning) and
/// for corrections from measured data.
struct FlankDeviation {
  /// tooth: 0-based, counter-clockwise; roll_length_mm: transverse; z_mm: from the part's lower face.
  std::function<double(int tooth, Flank flank, double roll_length_mm, double z_mm)> deviation_mm;
  bool varies_by_tooth = false;
  bool varies_along_face = false;

  [[nodiscard]] bool empty() const { return !deviation_mm; }
};

}  // namespace trueflank
