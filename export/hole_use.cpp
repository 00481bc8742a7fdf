// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/export/hole_patterns.h"
#include "trueflank/export/part_dimensions.h"

namespace trueflank::io {
namespace {

bool has_step(const HolePattern& pattern, double diameter_mm) {
  return std::any_of(pattern.steps.begin(), pattern.steps.end(), [&](const HoleStep& step) {
    return std::abs(step.diameter_mm - diameter_mm) < tolerance::kSameSize_mm;
  });
}

HoleUse of_fastener(const Screw& screw, const HolePattern& pattern) {
  const std::string thread = "M" + drawing_number(screw.diameter_mm, 2);
  const double play = screw.hole_mm - screw.diameter_mm;
  if (has_step(pattern, screw.insert_hole_mm))
    return {.what = "heat-set insert " + thread, .thread = thread, .play_mm = play};
  if (has_step(pattern, screw.hole_mm)) return {.what = "screw " + thread, .play_mm = play};
  return {};
}

/// Clearance holes of ISO 273, fine to coarse.
HoleUse by_clearance_hole(const HolePattern& pattern) {
  struct Row {
    double screw, fine, coarse;
  };
  static constexpr std::array<Row, 14> kHoles = {{{1.6, 1.7, 2.0},
                                                  {2, 2.2, 2.6},
                                                  {2.5, 2.7, 3.1},
                                                  {3, 3.2, 3.6},
                                                  {4, 4.3, 4.8},
                                                  {5, 5.3, 5.8},
                                                  {6, 6.4, 7.0},
                                                  {8, 8.4, 10.0},
                                                  {10, 10.5, 12.0},
                                                  {12, 13.0, 14.5},
                                                  {16, 17.0, 18.5},
                                                  {20, 21.0, 24.0},
                                                  {24, 25.0, 28.0},
                                                  {30, 31.0, 35.0}}};
  double least = pattern.steps.front().diameter_mm;
  for (const HoleStep& step : pattern.steps) least = std::min(least, step.diameter_mm);
  for (const Row& row : kHoles)
    if (least > row.fine - tolerance::kSameSize_mm && least < row.coarse + tolerance::kSameSize_mm)
      return {.what = "screw M" + drawing_number(row.screw, 2), .play_mm = least - row.screw};
  return {};
}

}  // namespace

HoleUse hole_use(const GearTrain& train, const HolePattern& pattern) {
  if (const auto& machine = train.design.machine) {
    const FastenersDesign& fasteners = machine->fasteners;
    for (const Screw* screw :
         {&fasteners.housing, &fasteners.carrier, &fasteners.output, &fasteners.motor})
      if (HoleUse use = of_fastener(*screw, pattern); !use.what.empty()) return use;
    return {};
  }
  const bool pins = train.topology().has_planets() &&
                    std::abs(pattern.circle_diameter_mm - 2.0 * train.centre_distance_mm) <
                        tolerance::kSameSize_mm;
  return pins ? HoleUse{.what = "pin", .carries_axis = true} : by_clearance_hole(pattern);
}

}  // namespace trueflank::io
