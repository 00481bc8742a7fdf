// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/export/geometric_tolerances.h"
#include "trueflank/report/drawing/sheet.h"

// Signs on a drawing: tolerance frames of ISO 1101, datums of ISO 5459, surfaces of ISO 21920-1
// (ISO 1302).
namespace trueflank::io {

inline constexpr double kFrameHeight_mm = 6.0;

[[nodiscard]] double frame_width_mm(const GeometricTolerance& tolerance);
/// Sign, value ("Ø0.2" of a position), datum; its lower left corner.
void draw_tolerance(Sheet& sheet, const Point2& corner, const GeometricTolerance& tolerance);
/// The same in a row of a table, `height_mm` high.
void draw_tolerance_small(Sheet& sheet, const Point2& corner, const GeometricTolerance& tolerance,
                          double height_mm);

/// A datum's triangle hanging on a line at `tip`, its letter below.
void draw_datum(Sheet& sheet, const Point2& tip, char letter);

/// Whether material has to be removed; a print is left as it is.
enum class Removal { kAny, kRequired, kForbidden };
inline constexpr double kSurfaceHeight_mm = 7.0;
/// The sign standing on its point, with its words ("Ra 1.6"; may be empty).
void draw_surface(Sheet& sheet, const Point2& at, const std::string& words, Removal removal);
[[nodiscard]] double surface_width_mm(const std::string& words);

}  // namespace trueflank::io
