// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/tolerance_frames.h"

#include "trueflank/base/units.h"
#include "trueflank/export/part_dimensions.h"

namespace trueflank::io {
namespace {

constexpr double kSign_mm = 7.0, kDatum_mm = 6.0,
                 kText_mm = 2.5;  // widths of a frame's fields, height of its letters

std::string value_text(const GeometricTolerance& tolerance) {
  return (tolerance.kind == ToleranceKind::kPosition ? "Ø" : "") +
         drawing_number(tolerance.value_mm, 4);
}

double value_width(const GeometricTolerance& tolerance) {
  return text_width_mm(value_text(tolerance), kText_mm) + 3.0;
}

void slanting_arrow(Sheet& sheet, const Point2& from, const Point2& to) {
  sheet.line(from, to, Pen::kThin);
  sheet.arrow(to, (to - from).normalized());
}

/// The sign of a tolerance about a centre, within a square of 4.4 mm times `size`.
void draw_sign(Sheet& sheet, const Point2& c, ToleranceKind kind, double size) {
  const auto at = [&](double x, double y) { return Point2(c + size * Point2(x, y)); };
  const auto line = [&](const Point2& from, const Point2& to) { sheet.line(from, to, Pen::kThin); };
  switch (kind) {
    case ToleranceKind::kCircularRunout:
      slanting_arrow(sheet, at(-1.7, -1.8), at(1.7, 1.8));
      break;
    case ToleranceKind::kTotalRunout:
      line(at(-2.6, -1.8), at(0.8, -1.8));
      slanting_arrow(sheet, at(-2.6, -1.8), at(0.2, 1.8));
      slanting_arrow(sheet, at(0.0, -1.8), at(2.8, 1.8));
      break;
    case ToleranceKind::kFlatness:
      sheet.paths.push_back({.points = {at(-2.4, -1.2), at(1.2, -1.2), at(2.4, 1.2), at(-1.2, 1.2)},
                             .closed = true,
                             .pen = Pen::kThin});
      break;
    case ToleranceKind::kParallelism:
      line(at(-1.9, -1.8), at(0.3, 1.8));
      line(at(-0.3, -1.8), at(1.9, 1.8));
      break;
    case ToleranceKind::kCylindricity: {
      sheet.circle(at(0.0, 0.0), 1.1 * size, Pen::kThin);
      const Point2 along = Point2(1.0, 1.7).normalized(), aside = 1.1 * perpendicular(along);
      for (double side : {1.0, -1.0})
        line(c + size * Point2(side * aside - 2.0 * along),
             c + size * Point2(side * aside + 2.0 * along));
      break;
    }
    case ToleranceKind::kPosition:
      sheet.circle(at(0.0, 0.0), 1.2 * size, Pen::kThin);
      line(at(-2.0, 0.0), at(2.0, 0.0));
      line(at(0.0, -2.0), at(0.0, 2.0));
      break;
  }
}

void draw_frame_fields(Sheet& sheet, const Point2& corner, const GeometricTolerance& tolerance,
                       double height, double letters) {
  const double scale = letters / kText_mm, w = scale * value_width(tolerance),
               sign = scale * kSign_mm, datum = scale * kDatum_mm;
  const double base = 0.5 * (height - letters);
  sheet.box(corner, corner + Point2(sign, height), Pen::kThin);
  draw_sign(sheet, corner + Point2(0.5 * sign, 0.5 * height), tolerance.kind,
            std::min(1.0, (height - 0.4) / 4.4));
  sheet.box(corner + Point2(sign, 0.0), corner + Point2(sign + w, height), Pen::kThin);
  sheet.text(corner + Point2(sign + 0.5 * w, base), value_text(tolerance), letters,
             TextAnchor::kMiddle);
  if (tolerance.datum == 0) return;
  sheet.box(corner + Point2(sign + w, 0.0), corner + Point2(sign + w + datum, height), Pen::kThin);
  sheet.text(corner + Point2(sign + w + 0.5 * datum, base), std::string(1, tolerance.datum),
             letters, TextAnchor::kMiddle);
}

}  // namespace

double frame_width_mm(const GeometricTolerance& tolerance) {
  return kSign_mm + value_width(tolerance) + (tolerance.datum == 0 ? 0.0 : kDatum_mm);
}

void draw_tolerance(Sheet& sheet, const Point2& corner, const GeometricTolerance& tolerance) {
  draw_frame_fields(sheet, corner, tolerance, kFrameHeight_mm, kText_mm);
}

void draw_tolerance_small(Sheet& sheet, const Point2& corner, const GeometricTolerance& tolerance,
                          double height_mm) {
  draw_frame_fields(sheet, corner, tolerance, height_mm, 2.0);
}

void draw_datum(Sheet& sheet, const Point2& tip, char letter) {
  sheet.fills.push_back({tip, tip + Point2(-1.6, -2.6), tip + Point2(1.6, -2.6)});
  sheet.line(tip - Point2(0.0, 2.6), tip - Point2(0.0, 5.0), Pen::kThin);
  sheet.box(tip + Point2(-2.4, -9.8), tip + Point2(2.4, -5.0), Pen::kThin);
  sheet.text(tip + Point2(0.0, -8.8), std::string(1, letter), 3.0, TextAnchor::kMiddle);
}

double surface_width_mm(const std::string& words) {
  return words.empty() ? 6.1 : 4.6 + text_width_mm(words, kText_mm);
}

void draw_surface(Sheet& sheet, const Point2& at, const std::string& words, Removal removal) {
  constexpr double kShort_mm = 3.5, kSlope = 1.7320508;  // legs at 60 degrees
  const Point2 left = at + Point2(-kShort_mm / kSlope, kShort_mm),
               right = at + Point2(kSurfaceHeight_mm / kSlope, kSurfaceHeight_mm);
  sheet.line(left, at, Pen::kThin);
  sheet.line(at, right, Pen::kThin);
  if (removal == Removal::kRequired)
    sheet.line(left, left + Point2(2.0 * kShort_mm / kSlope, 0.0), Pen::kThin);
  if (removal == Removal::kForbidden)
    sheet.circle(at + Point2(0.0, 2.0 / 3.0 * kShort_mm), kShort_mm / 3.0, Pen::kThin);
  if (words.empty()) return;
  sheet.line(right, right + Point2(0.6 + text_width_mm(words, kText_mm), 0.0), Pen::kThin);
  sheet.text(right + Point2(0.4, -3.4), words, kText_mm);
}

}  // namespace trueflank::io
