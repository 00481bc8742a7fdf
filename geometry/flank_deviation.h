// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "trueflank/geometry/gear.h"

namespace trueflank {

/// A deviation of the flanks along their outward normal (+ = more material) as a field over tooth,
/// flank, roll length and height. The one mechanism for design modifications (relief, crowning) and
/// for corrections from measured data.
struct FlankDeviation {
  /// tooth: 0-based, counter-clockwise; roll_length_mm: transverse, of the design flank (asked for a
  /// little beyond either end of it, too); z_mm: from the gear's lower face.
  std::function<double(int tooth, Flank flank, double roll_length_mm, double z_mm)> deviation_mm;
  bool varies_by_tooth = false;
  bool varies_along_face = false;
  /// Where the field bends or starts: meshes and solids put an edge there.
  std::vector<double> roll_breaks_mm = {}, z_breaks_mm = {};

  [[nodiscard]] bool empty() const { return !deviation_mm; }
};

}  // namespace trueflank
