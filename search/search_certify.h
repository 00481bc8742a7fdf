// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_requirements.h"
#include "trueflank/train/efficiency_balance.h"

namespace trueflank {

struct CertifyOptions {
  double known = 0.0;  ///< an efficiency that is reached: a bound this close above it is enough
  double close = 1e-5;
  int most_boxes = 8000;  ///< looked at, then what is left is told
};

struct CertifiedBound {
  double efficiency = 1.0;  ///< of the meshes: no shifts that keep the limits give more
  int boxes = 0;
};

/// A proved upper bound on the efficiency of a tooth set: boxes of centre distance and shifts are
/// halved, the one with the highest bound first, and dropped where no point of them keeps every
/// limit, by interval arithmetic rounded outwards.
/// Guarantees: no design of the set that keeps shift bounds, contact ratios, clearances,
/// thicknesses, planet spacing and corners in roots is more efficient; limits on figures and torque
/// only lower it. It does not depend on the optimiser. Source:
/// docs/decisions/0175-certified-bound.md.
[[nodiscard]] CertifiedBound certified_bound(const SearchRequirements& requirements,
                                             const ToothSet& set, DriveDirection direction,
                                             const CertifyOptions& options = {});

}  // namespace trueflank
