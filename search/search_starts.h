// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/search/search_values.h"

namespace trueflank {

/// A point to start an optimiser from.
struct SearchStart {
  FreeShifts free;
  double merit = 0.0;
  double margin = 0.0;  ///< least distance to a limit [modules]
};

/// The best starts of grids over centre distance and shifts, zoomed in; once within all limits and once
/// a little beyond them, because the feasible region has islands smaller than a cell. Empty: the grids
/// found nothing.
[[nodiscard]] std::vector<FreeShifts> grid_starts(SetValues& values);

/// Finer and finer grids around a start: the feasible region has many corners, and an optimum is
/// mostly one of them. `tolerance`: what a point may lack of a limit [modules].
[[nodiscard]] SearchStart zoomed(SetValues& values, SearchStart start, double distance_step,
                                 double shift_step, double tolerance);

}  // namespace trueflank
