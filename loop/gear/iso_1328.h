// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/gear/local/residual_grid.h"

namespace trueflank::loop {

/// One quantity of ISO 1328-1:2013, of the flanks of one side or the larger of both.
struct Iso1328Row {
  std::string symbol;       ///< fp, Fp, fu, Fpz/8, fHa, ffa, Fa, fHb, ffb, Fb; fHam, fHbm, Ca, Cb: means
  std::string flank;        ///< both, left, right
  std::string what;         ///< in words
  double value_um = kNaN;   ///< of all measured teeth the largest, slopes with their sign
  double bracket_um = kNaN; ///< the standard's bracket: the tolerance of class 5; NaN: it has none
  int accuracy_class = 0;   ///< 1 ... 11; 12: worse than 11; 0: not measured, or no tolerance
};

struct Iso1328 {
  std::vector<Iso1328Row> rows;  ///< of both flanks first
  bool in_scope = true;
  std::string note;  ///< scope, ranges, filter
};

/// Tolerance of an accuracy class [um], rounded as 5.2.3 says.
[[nodiscard]] double iso_1328_tolerance_um(double bracket_um, int accuracy_class);

/// Deviations of the gear as measured, from its design. Traces are filtered (trace_evaluation.h) and
/// evaluated over 95 % of the profile from the root form or the first point on, and over the face less 5 % or
/// a module at each end; slopes are of the mean line over that range, + = material towards tip or top. Of a
/// scan the mean traces of each flank are taken.
/// Source: formulas (5)-(12) of ISO 1328-1:2013 as four public programs agree on them.
[[nodiscard]] Iso1328 iso_1328(const GearLoop& closed);

/// The same for loop.json.
[[nodiscard]] std::vector<InspectionFigure> inspection_figures(const Iso1328& evaluated);

}  // namespace trueflank::loop
