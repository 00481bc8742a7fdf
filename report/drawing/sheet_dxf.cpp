// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>

#include "trueflank/base/units.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/section/dxf_document.h"
#include "trueflank/report/drawing/sheet.h"

namespace trueflank::io {
namespace {

/// Diameter and plus-minus by their old codes, other letters beyond ASCII as \U+XXXX.
std::string dxf_text(std::string_view utf8) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string text;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    if (first < 0x80) {
      if (first >= 0x20) text += utf8[i];
      ++i;
      continue;
    }
    const std::size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    std::uint32_t letter = first & (0x3F >> (length - 1));
    for (std::size_t k = 1; k < length && i + k < utf8.size(); ++k)
      letter = letter << 6 | (static_cast<unsigned char>(utf8[i + k]) & 0x3F);
    i += length;
    if (letter == 0xD8 || letter == 0xB1) {
      text += letter == 0xD8 ? "%%c" : "%%p";
      continue;
    }
    text += "\\U+";
    for (int shift = 12; shift >= 0; shift -= 4) text += kDigits[letter >> shift & 0xF];
  }
  return text;
}

void put_path(DxfText& dxf, const SheetPath& path, int handle) {
  put_dxf_entity(dxf, "LWPOLYLINE", handle, to_text(path.pen));
  dxf.put(100, "AcDbPolyline");
  dxf.put(90, static_cast<int>(path.points.size()));
  dxf.put(70, path.closed ? 1 : 0);
  for (const Point2& point : path.points) dxf.put_point(10, point);
}

void put_arc(DxfText& dxf, const SheetArc& arc, int handle) {
  const bool whole = arc.to_rad - arc.from_rad >= kTwoPi - 1e-12;
  put_dxf_entity(dxf, whole ? "CIRCLE" : "ARC", handle, to_text(arc.pen));
  dxf.put(100, "AcDbCircle");
  dxf.put_point(10, arc.centre);
  dxf.put(30, 0.0);
  dxf.put(40, arc.radius_mm);
  if (whole) return;
  dxf.put(100, "AcDbArc");
  dxf.put(50, deg_from_rad(wrapped_rad(arc.from_rad)));
  dxf.put(51, deg_from_rad(wrapped_rad(arc.to_rad)));
}

/// A triangle or quadrangle; SOLID wants the last two corners exchanged.
void put_fill(DxfText& dxf, const std::vector<Point2>& polygon, int handle) {
  put_dxf_entity(dxf, "SOLID", handle, to_text(Pen::kThin));
  dxf.put(100, "AcDbTrace");
  constexpr std::size_t kOrder[] = {0, 1, 3, 2};
  for (std::size_t i = 0; i < 4; ++i) {
    dxf.put_point(10 + static_cast<int>(i), polygon[std::min(kOrder[i], polygon.size() - 1)]);
    dxf.put(30 + static_cast<int>(i), 0.0);
  }
}

void put_text(DxfText& dxf, const SheetText& text, int handle) {
  const int justified = text.anchor == TextAnchor::kLeft ? 0 : text.anchor == TextAnchor::kMiddle ? 1 : 2;
  put_dxf_entity(dxf, "TEXT", handle, "TEXT");
  dxf.put(100, "AcDbText");
  dxf.put_point(10, text.at);
  dxf.put(30, 0.0);
  dxf.put(40, text.height_mm);
  dxf.put(1, dxf_text(text.text));
  dxf.put(50, deg_from_rad(text.rotation_rad));
  dxf.put(72, justified);
  if (justified != 0) {
    dxf.put_point(11, text.at);
    dxf.put(31, 0.0);
  }
  dxf.put(100, "AcDbText");
}

}  // namespace

Status write_sheet_dxf(const std::filesystem::path& path, const Sheet& sheet) {
  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  std::vector<DxfLayer> layers;
  for (Pen pen : kPens)
    layers.push_back({.name = to_text(pen),
                      .colour = pen == Pen::kHatch ? 8 : 7,
                      .line_type = pen == Pen::kChain ? "CENTER" : "Continuous",
                      .width_hundredths_mm = static_cast<int>(100.0 * width_mm(pen) + 0.5)});
  layers.push_back({.name = "TEXT"});
  Box2 box;
  box.low = Point2::Zero();
  box.high = Point2(sheet.width_mm, sheet.height_mm);
  DxfText dxf(*file);
  begin_dxf(dxf, box, layers,
            static_cast<int>(sheet.paths.size() + sheet.arcs.size() + sheet.fills.size() + sheet.texts.size()));
  int handle = kFirstDxfEntity;
  for (const SheetPath& p : sheet.paths) put_path(dxf, p, handle++);
  for (const SheetArc& arc : sheet.arcs) put_arc(dxf, arc, handle++);
  for (const auto& fill : sheet.fills) put_fill(dxf, fill, handle++);
  for (const SheetText& text : sheet.texts) put_text(dxf, text, handle++);
  end_dxf(dxf);
  return file->commit();
}

}  // namespace trueflank::io
