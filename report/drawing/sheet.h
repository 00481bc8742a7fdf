// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/geometry/point2.h"

// A drawing sheet before any file format: lines, arcs, texts and fills in millimetres of paper, origin
// in the lower left corner, y up. PDF and DXF are written from the same sheet.
namespace trueflank::io {

/// Line types of ISO 128: thick visible outlines (0.5 mm), thin (0.25 mm) for dimensions, chain lines
/// for axes and reference circles, hatching (0.18 mm), the frame (0.7 mm).
enum class Pen { kThick, kThin, kChain, kHatch, kFrame };
inline constexpr std::array kPens = {Pen::kThick, Pen::kThin, Pen::kChain, Pen::kHatch, Pen::kFrame};
[[nodiscard]] double width_mm(Pen pen);
/// Layer name in DXF files: "VISIBLE", "THIN", "CENTRE", "HATCH", "FRAME".
[[nodiscard]] const char* to_text(Pen pen);

enum class TextAnchor { kLeft, kMiddle, kRight };

struct SheetPath {
  std::vector<Point2> points;
  bool closed = false;
  Pen pen = Pen::kThick;
};
struct SheetArc {
  Point2 centre;
  double radius_mm = 0.0;
  double from_rad = 0.0, to_rad = 0.0;  ///< counter-clockwise; 0 and 2 pi: the whole circle
  Pen pen = Pen::kThick;
};
struct SheetText {
  Point2 at;                 ///< on the base line
  std::string text;          ///< UTF-8
  double height_mm = 2.5;    ///< of capitals
  TextAnchor anchor = TextAnchor::kLeft;
  double rotation_rad = 0.0;
};

/// One page.
struct Sheet {
  std::string name;   ///< of the part
  std::string title;  ///< of the document, in its properties
  double width_mm = 297.0, height_mm = 210.0;
  std::vector<SheetPath> paths;
  std::vector<SheetArc> arcs;
  std::vector<SheetText> texts;
  std::vector<std::vector<Point2>> fills;  ///< solid polygons: arrow heads

  void line(const Point2& from, const Point2& to, Pen pen);
  void circle(const Point2& centre, double radius_mm, Pen pen);
  void box(const Point2& low, const Point2& high, Pen pen);
  void text(const Point2& at, std::string_view words, double letter_mm = 2.5,
            TextAnchor anchor = TextAnchor::kLeft, double rotation_rad = 0.0);
  /// Arrow head whose tip is at `tip`, pointing along `direction` (of length 1).
  void arrow(const Point2& tip, const Point2& direction);
  /// Where a leader ends inside an outline (ISO 128-22).
  void dot(const Point2& at);
  /// Lines at 45 degrees (`rising`) or 135 over an axis-parallel rectangle; neighbours continue each
  /// other's lines.
  void hatch(const Point2& low, const Point2& high, bool rising, double spacing_mm = 2.0);
};

/// Dimension between two heights (horizontal: places) of the sheet, ISO 129: extension lines from the
/// features, the line with its arrows at `line_at`, the text above it. Arrows stand outside where
/// there is no room between, the text then to the right of a horizontal one.
struct Dimension {
  Point2 from, to;  ///< the features
  double line_at_mm = 0.0;  ///< y of a horizontal dimension line, x of a vertical one
  std::string text;
  double text_aside_mm = 0.0;  ///< of a horizontal one: the text's middle from that of the line
};
void horizontal_dimension(Sheet& sheet, const Dimension& dimension);
/// Moves the texts of dimensions whose `line_at` is chosen along their lines, where extension lines to rows below
/// would cross them and there is room aside.
void move_texts_aside(std::vector<Dimension>& dimensions);
/// From where to where on the sheet a horizontal dimension reaches, its text and outer arrows too.
[[nodiscard]] std::pair<double, double> reach_of(const Dimension& dimension);
/// Rows for horizontal dimensions, the first as near to the part as can be: in a row none touches another.
[[nodiscard]] std::vector<int> dimension_rows(const std::vector<Dimension>& dimensions);
void vertical_dimension(Sheet& sheet, const Dimension& dimension);

/// Approximate width of a text in Helvetica [mm]; never less than what the writers draw by more than a tenth.
[[nodiscard]] double text_width_mm(std::string_view utf8, double height_mm);

/// One page a sheet, by libharu. Same sheets, same bytes: no date is written. Letters beyond Latin-1 and Greek
/// are shown as question marks.
/// Errors: as AtomicFile's.
[[nodiscard]] Status write_pdf(const std::filesystem::path& path, const std::vector<Sheet>& sheets);
/// DXF of AutoCAD 2000 in millimetres of paper, a layer a pen, texts as TEXT. Errors: as AtomicFile's.
[[nodiscard]] Status write_sheet_dxf(const std::filesystem::path& path, const Sheet& sheet);

}  // namespace trueflank::io
