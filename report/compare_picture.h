// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/solid/measure/mesh_difference.h"

namespace trueflank {

struct ComparePictureOptions {
  std::string title, subtitle;
  double tolerance_mm = 1e-3;
};

/// SVG of a difference in three views: the whole section with the new outline coloured by deviation,
/// the tooth at the worst place (tip up) with deviations exaggerated along the normal, and the worst
/// place itself to scale with both outlines. Same input, same bytes.
[[nodiscard]] std::string compare_picture_svg(const MeshDifference& difference,
                                              const ComparePictureOptions& options);

}  // namespace trueflank
