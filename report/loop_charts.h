// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/loop/gear/local/residual_grid.h"

// The classical inspection charts as SVG with their values for the pointer (loop_page.h), styled by the page's classes: one flank each, deviation
// positive where there is too much material. Same input, same bytes.
namespace trueflank::loop {

/// What a chart shows.
enum class ChartKind {
  kProfile, kHelix, kIndex, kTopography, kOrders,
  kProfileMap, kHelixMap,  ///< every tooth's trace as a column of colours
};

/// Full scale that charts before and after share [um], rounded up to a short number;
/// NaN where nothing of the kind was measured.
[[nodiscard]] double chart_scale_um(ChartKind kind, const ResidualGrid& before);

/// side: 0 clockwise, 1 counter-clockwise.
[[nodiscard]] std::string chart_svg(ChartKind kind, const ResidualGrid& grid, int side, double scale_um);

}  // namespace trueflank::loop
