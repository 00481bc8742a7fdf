// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace trueflank {

/// Sines and cosines of many angles [rad], four at once: the digits that `std::sin` and `std::cos`
/// give in our programs (elementary_functions.cpp). Requires: as many of either as there are
/// angles.
void sines_and_cosines(std::span<const double> angles_rad, std::span<double> sines,
                       std::span<double> cosines);

}  // namespace trueflank
