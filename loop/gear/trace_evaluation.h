// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/units.h"

// A profile or helix trace as inspectors evaluate it: ISO 1328-1:2013 with its filter.
namespace trueflank::loop {

/// One value of a trace: place along it [mm], deviation from the design [um, + = material].
struct TracePoint {
  double at_mm = 0.0, deviation_um = 0.0;
};

/// What a trace is evaluated over [mm].
struct EvaluationRange {
  double from_mm = 0.0, to_mm = 0.0;
  /// Beyond the range, up to here, excess material counts and missing material does not (the tip of a profile);
  /// at or below `to_mm`: no such zone.
  double excess_to_mm = 0.0;
};

struct TraceFigures {
  double slope_um = kNaN;     ///< of the mean line over the range, + = material at its end
  double form_um = kNaN;      ///< band about the mean line
  double total_um = kNaN;     ///< band about the design
  double crowning_um = kNaN;  ///< height of the least squares parabola over its chord, + = convex
};

/// Cut-off of the filter for an evaluated length: a thirtieth of it, at least 0.25 mm.
[[nodiscard]] double cut_off_mm(double length_mm);

/// Gaussian mean line, phase-correct, half transmission at the cut-off; weights at the ends are made up to one.
/// Between two values the course is straight, so that uneven places, near the base circle as far apart as the
/// weight is wide, are averaged over their length and not by their number.
/// Source: ISO 16610-21: exp(-pi (x / (a cut-off))^2), a = sqrt(ln 2 / pi).
[[nodiscard]] std::vector<TracePoint> gaussian_filtered(const std::vector<TracePoint>& trace,
                                                        double cut_off_mm);

/// Figures of a filtered trace; NaN with fewer than 8 points in the range. Mean line: least squares.
/// Requires: points in order of their place.
[[nodiscard]] TraceFigures evaluate_trace(const std::vector<TracePoint>& trace,
                                          const EvaluationRange& range);

}  // namespace trueflank::loop
