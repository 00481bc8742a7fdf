// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/gear_dimensions.h"

#include <algorithm>
#include <cmath>

namespace trueflank::io {

double start_of_active_profile_mm(const GearTrain& train, const TrainGear& gear) {
  double result = kNaN;
  for (const TrainMesh& mesh : train.meshes) {
    const GearPair pair = train.pair(mesh);
    double radius = kNaN;
    if (pair.profile1 == &gear.profile) radius = start_of_active_profile1_mm(pair);
    if (pair.profile2 == &gear.profile) radius = start_of_active_profile2_mm(pair);
    if (std::isnan(radius)) continue;
    const bool ring = gear.profile.gear().kind == GearKind::kInternal;
    if (std::isnan(result))
      result = radius;
    else
      result = ring ? std::max(result, radius) : std::min(result, radius);
  }
  return result;
}

}  // namespace trueflank::io
