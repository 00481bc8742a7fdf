// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/report/drawing/gear_table.h"
#include "trueflank/report/drawing/sheet.h"
#include "trueflank/report/drawing/tolerance_frames.h"

// Frame, title block, tables and notes of a sheet.
namespace trueflank::io {

/// Title block in the manner of ISO 7200.
struct TitleBlock {
  std::string part, design, material, mass, scale, sheet_size;
  std::string general_tolerances;
  std::string surfaces;  ///< "Ra 3.2", of all that have none of their own; empty: nothing is said
  Removal removal = Removal::kAny;
  bool other_surfaces = false;  ///< the drawing has some
};

/// Border of ISO 5457 (20 mm on the left, 10 mm elsewhere) and the title block in the lower right
/// corner.
void draw_frame(Sheet& sheet, const TitleBlock& title);

inline constexpr double kBorderLeft_mm = 20.0, kBorder_mm = 10.0;
inline constexpr double kTitleWidth_mm = 180.0, kTitleHeight_mm = 34.0;
inline constexpr double kRowHeight_mm = 4.4;

/// A table whose upper right corner is at `corner`; the first row is its heading. The size it
/// takes.
struct TableColumn {
  double width_mm = 20.0;
  TextAnchor anchor = TextAnchor::kLeft;
  bool symbols = false;  ///< "m_n" has an index; left-aligned
};
void draw_table(Sheet& sheet, const Point2& corner, const std::vector<TableColumn>& columns,
                const std::vector<std::vector<std::string>>& rows);

/// Numbered sentences upwards from a lower left corner, in lines that end before the title block.
void draw_notes(Sheet& sheet, const Point2& corner, const std::vector<std::string>& notes);

/// Scales of ISO 5455, largest first, as paper over part.
[[nodiscard]] const std::vector<std::pair<std::string, double>>& drawing_scales();

}  // namespace trueflank::io
