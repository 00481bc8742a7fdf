// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/search/search_interval.h"

namespace trueflank {

/// A mesh in units of its module, as the loss sees it.
struct LossMesh {
  double base_radius1 = 0.0, base_radius2 = 0.0;
  bool internal = false, gear1_drives = true;
  double base_pitch = 0.0, friction = 0.0;
};

/// Path of contact before and after the pitch point, and the tangent of the working pressure angle.
struct LossPath {
  Slope approach, recess, tangent;
};

/// Efficiency of a mesh along the path of contact, tooth pairs sharing the load in equal parts
/// (efficiency_sliding.h with LoadSharing::kEqual), anywhere in a box.
/// Where a path may be shorter than a base pitch the function is continued smoothly.
/// Source: docs/decisions/0175-certified-bound.md.
[[nodiscard]] Slope enclosed_path_efficiency(const LossMesh& mesh, const LossPath& path);

}  // namespace trueflank
