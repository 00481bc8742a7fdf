// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/export/workmanship.h"
#include "trueflank/solid/shape/part_shape.h"

// Holes off a part's axis as a workshop makes them: steps of one axis, alike on one circle.
namespace trueflank::io {

/// One cylinder of a hole.
struct HoleStep {
  double diameter_mm = 0.0;  ///< in the shape
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  double drawn_mm =
      kNaN;  ///< nominal size of its class; part_dimensions() fills in this and the limits
  SizeLimits limits = {};
  [[nodiscard]] double depth_mm() const { return z_upper_mm - z_lower_mm; }
};

/// What holes are for, as far as their sizes tell.
struct HoleUse {
  std::string what = {};      ///< "screw M3", "heat-set insert M3"; empty: not known
  std::string thread = {};    ///< "M3" where the finished hole has one; empty: none
  double play_mm = kNaN;      ///< of the screw in its clearance hole, here or in the other part
  bool carries_axis = false;  ///< of a planet or a bearing
};

/// Equal holes whose centres lie on one circle about the axis.
struct HolePattern {
  std::vector<HoleStep> steps;                  ///< bottom to top, each on the last
  bool open_below = false, open_above = false;  ///< ends in a face, of a pocket too
  double circle_diameter_mm = 0.0;
  std::vector<Point2> centres;  ///< by angle from +x, counter-clockwise
  bool equally_spaced = false;  ///< two or more, at equal angles
  HoleUse use = {};             ///< part_dimensions() fills it in
};

/// All round holes off the axis, largest circle last; those from both faces that do not meet are
/// two. Index marks are none.
[[nodiscard]] std::vector<HolePattern> hole_patterns(const PartShape& part);

/// By the fasteners of a housing, the pins of a carrier, else the clearance holes of ISO 273.
[[nodiscard]] HoleUse hole_use(const GearTrain& train, const HolePattern& pattern);

/// What is drilled, a phrase a tool: "Ø3.4 through", "Ø6 x 3.2 deep from the right". Below is left,
/// as drawings show it.
[[nodiscard]] std::vector<std::string> hole_words(const HolePattern& pattern);
/// Where: "6 equally spaced on Ø89.2", "first at 30 deg"; of a single hole "x 12, y 0".
[[nodiscard]] std::vector<std::string> place_words(const HolePattern& pattern);

}  // namespace trueflank::io
