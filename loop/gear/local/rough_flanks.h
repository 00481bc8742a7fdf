// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/discovery/rough_zone.h"
#include "trueflank/loop/gear/local/remainder_courses.h"

namespace trueflank::loop {

/// A part of the traces of both sides (-1) or of one in which the surface, or the probe on it, is
/// rougher. Without a length: there is none.
struct RoughFlanks {
  int side = -1;
  RoughZone zone;
};

/// The surest one, its p-value corrected for the sides looked at.
[[nodiscard]] RoughFlanks rough_flanks(const Courses& courses);

}  // namespace trueflank::loop
