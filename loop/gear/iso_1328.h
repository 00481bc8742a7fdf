// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/gear/residual_grid.h"

namespace trueflank::loop {

/// Accuracy class of one quantity to ISO 1328-1:2013.
struct Iso1328Row {
  std::string symbol;       ///< fp, Fp, fHa, ffa, Fa, fHb, ffb, Fb
  double value_um = kNaN;   ///< largest over all measured teeth and both flanks
  double bracket_um = kNaN; ///< the standard's bracket: the tolerance of class 5
  int accuracy_class = 0;   ///< 1 ... 11; 12: worse than 11; 0: not measured
};

struct Iso1328 {
  std::vector<Iso1328Row> rows;
  bool in_scope = true;
  std::string note;  ///< scope, filtering
};

/// Tolerance of an accuracy class [um], rounded as 5.2.3 says.
[[nodiscard]] double iso_1328_tolerance_um(double bracket_um, int accuracy_class);

/// Deviations of the gear as measured. A second opinion: without the standard's filter, on the traces
/// as they are (those of a scan are means over the flank).
/// Source: formulas (5)-(12) of ISO 1328-1:2013 as four public programs agree on them.
[[nodiscard]] Iso1328 iso_1328(const GearLoop& closed);

}  // namespace trueflank::loop
