// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/basic_rack.h"

#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank {

double residual_protuberance(const BasicRack& rack) {
  return rack.protuberance > 0.0 ? rack.protuberance - rack.grinding_stock : 0.0;
}

double full_round_coefficient(const BasicRack& rack) {
  // Half tip land pi/4 - hf tan a; an arc of radius r takes r (1 - sin a) / cos a of it; a
  // protuberance moves it outwards.
  const double a = rack.pressure_angle_rad;
  const double half_land = 0.25 * kPi - rack.dedendum * std::tan(a) +
                           residual_protuberance(rack) / std::cos(a);
  return half_land * std::cos(a) / (1.0 - std::sin(a));
}

}  // namespace trueflank
