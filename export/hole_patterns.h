// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/solid/shape/part_shape.h"

// Holes off a part's axis as a workshop makes them: steps of one axis, alike on one circle.
namespace trueflank::io {

/// One cylinder of a hole.
struct HoleStep {
  double diameter_mm = 0.0;
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  [[nodiscard]] double depth_mm() const { return z_upper_mm - z_lower_mm; }
};

/// Equal holes whose centres lie on one circle about the axis.
struct HolePattern {
  std::vector<HoleStep> steps;  ///< bottom to top, each on the last
  bool open_below = false, open_above = false;  ///< ends in a face, of a pocket too
  double circle_diameter_mm = 0.0;
  std::vector<Point2> centres;  ///< by angle from +x, counter-clockwise
  bool equally_spaced = false;  ///< two or more, at equal angles
};

/// All round holes off the axis, largest circle last; those from both faces that do not meet are two.
[[nodiscard]] std::vector<HolePattern> hole_patterns(const PartShape& part);

/// What is drilled, a phrase a tool: "Ø3.4 through", "Ø6 x 3.2 deep from the right". Below is left,
/// as drawings show it.
[[nodiscard]] std::vector<std::string> hole_words(const HolePattern& pattern);
/// Where: "6 equally spaced on Ø89.2", "first at 30 deg"; of a single hole "x 12, y 0".
[[nodiscard]] std::vector<std::string> place_words(const HolePattern& pattern);

}  // namespace trueflank::io
