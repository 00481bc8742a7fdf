// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/flank_geometry.h"

namespace trueflank::loop {

struct Observations;

/// Gives the rows of profile and helix traces the number of the line of their flank in which they
/// stand: several profiles of a flank run at different heights, several helix traces at different
/// diameters, with one zero for all (`# zero = common`) or with zeros of their own. Between lines
/// lies more than a fortieth of the face or the profile. 0 is the lowest, at most 255.
void number_lines(const FlankGeometry& geometry, Observations& table);

}  // namespace trueflank::loop
