// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/report/drawing/sheet.h"

// Item numbers of an assembly: circles with a line to the part.
namespace trueflank::io {

inline constexpr double kBalloonRadius_mm = 4.0;
inline constexpr double kBalloonStep_mm = 9.5;  // from one to the next

/// An item and the places where its line may end, on the sheet; one at least.
struct Balloon {
  int number = 0;
  std::vector<Point2> places;
};

/// Gives each item one of the seats (centres of circles) and one of its places, so that lines cross
/// rarely and are short, and draws them. The same input gives the same drawing.
/// Requires: no fewer seats than items.
void draw_balloons(Sheet& sheet, const std::vector<Balloon>& balloons, const std::vector<Point2>& seats);

}  // namespace trueflank::io
