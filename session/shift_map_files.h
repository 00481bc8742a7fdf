// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/search/shift_map.h"

// The efficiency over the shifts of one tooth set as files; the same bytes for the same surface.
namespace trueflank {

/// "3k, sun drives ring2, 3 planets": what tells sets of the same teeth apart.
[[nodiscard]] std::string train_text(const ToothSet& set);

/// One line a point of each map: the free variables, efficiency, whether every limit is kept, the
/// limit that is kept least and by how much [modules].
[[nodiscard]] std::string shift_map_csv(const ShiftSurface& surface);
/// Two lines a piece of a limit's border, its ends, each with the free variables there.
[[nodiscard]] std::string shift_borders_csv(const ShiftSurface& surface);
/// An offline page with one picture a map: efficiency as colour where every limit is kept, the
/// border of each limit that ends this region as a line, the best place as a cross.
[[nodiscard]] std::string shift_map_html(const std::string& title, const ToothSet& set,
                                         const ShiftSurface& surface);

}  // namespace trueflank
