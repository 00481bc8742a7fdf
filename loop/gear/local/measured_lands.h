// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/pose/pose.h"
#include "trueflank/loop/measured/measurement.h"

namespace trueflank::loop {

/// Where the tips and roots of a scan really are. A part that shrank or grew, or whose teeth stand off the
/// axis, has its tip lands and fillets where the design has flanks; without normals their points would pass
/// for flanks with a relieved tip.
class MeasuredLands {
 public:
  MeasuredLands(const FlankGeometry& geometry, const ScanData& scan, const Pose& pose, double reach_mm);
  /// True where a point that seems to lie on a flank may lie on a land or in a fillet.
  [[nodiscard]] bool covers(const Place& place, const std::array<double, 3>& point_mm) const;

 private:
  const FlankGeometry& geometry_;
  bool normals_ = false;               ///< tips are told from flanks by them
  double root_form_mm_ = 0.0;          ///< radius, as designed
  std::vector<double> tip_mm_;         ///< of each tooth
  double root_mm_ = 0.0;               ///< displacement of the roots, + away from the tips' side
  double guard_mm_ = 0.0;              ///< three times the scatter of the tips
};

}  // namespace trueflank::loop
