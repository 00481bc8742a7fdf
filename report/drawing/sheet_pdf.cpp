// SPDX-License-Identifier: GPL-3.0-or-later
#include <hpdf.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <type_traits>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/report/drawing/sheet.h"

namespace trueflank::io {
namespace {

constexpr float kPointsPerMm = 72.0F / 25.4F;
constexpr double kCapitalHeight = 0.718;  // of Helvetica, over its type size

float points(double mm) { return static_cast<float>(mm) * kPointsPerMm; }

/// A letter in one of the two fonts every reader has: Helvetica in Windows' Latin code page, and Symbol
/// for Greek.
struct Glyph {
  unsigned char code = '?';
  bool symbol = false;
};

/// Greek letters in the encoding of the Symbol font; 0: not Greek.
unsigned char symbol_code(std::uint32_t letter) {
  constexpr std::u32string_view kGreek = U"αβγδεηθλμξπρστφψω";
  constexpr std::string_view kCodes = "abgdehqlmxprstjyw";
  const std::size_t at = kGreek.find(static_cast<char32_t>(letter));
  return at == std::u32string_view::npos ? 0 : static_cast<unsigned char>(kCodes[at]);
}

std::vector<Glyph> glyphs_of(std::string_view utf8) {
  std::vector<Glyph> glyphs;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    std::uint32_t letter = length == 1 ? first : first & (0x3F >> (length - 1));
    for (std::size_t k = 1; k < length && i + k < utf8.size(); ++k)
      letter = letter << 6 | (static_cast<unsigned char>(utf8[i + k]) & 0x3F);
    i += length;
    if (const unsigned char greek = symbol_code(letter))
      glyphs.push_back({greek, true});
    else if (letter >= 0x20 && letter < 0x100 && !(letter >= 0x7F && letter < 0xA0))
      glyphs.push_back({static_cast<unsigned char>(letter), false});
    else
      glyphs.push_back({});
  }
  return glyphs;
}

/// A document of libharu. What fails here fails for want of memory. libharu then hands out null pages and
/// fonts, which its other functions do not look at: nothing is called after an error.
class PdfDocument {
 public:
  PdfDocument() : document_(HPDF_New(nullptr, nullptr), HPDF_Free) {
    if (document_ == nullptr) throw std::bad_alloc();
    HPDF_SetCompressionMode(document(), HPDF_COMP_TEXT);
    helvetica_ = HPDF_GetFont(document(), "Helvetica", "WinAnsiEncoding");
    if (helvetica_ != nullptr) symbol_ = HPDF_GetFont(document(), "Symbol", nullptr);
    if (symbol_ == nullptr) throw std::bad_alloc();
    require_memory();
  }

  void set_title(const std::string& title) {
    std::string latin;
    for (const Glyph& g : glyphs_of(title)) latin += g.symbol ? '?' : static_cast<char>(g.code);
    HPDF_SetInfoAttr(document(), HPDF_INFO_TITLE, latin.c_str());
    require_memory();
    HPDF_SetInfoAttr(document(), HPDF_INFO_PRODUCER, "Trueflank");
    require_memory();
  }

  void add(const Sheet& sheet) {
    page_ = HPDF_AddPage(document());
    if (page_ == nullptr) throw std::bad_alloc();
    require_memory();
    HPDF_Page_SetWidth(page_, points(sheet.width_mm));
    HPDF_Page_SetHeight(page_, points(sheet.height_mm));
    HPDF_Page_SetLineCap(page_, HPDF_ROUND_END);
    HPDF_Page_SetLineJoin(page_, HPDF_ROUND_JOIN);
    for (Pen pen : kPens) draw_with(sheet, pen);
    for (const auto& polygon : sheet.fills) fill(polygon);
    for (const SheetText& text : sheet.texts) write(text);
  }

  /// The file's bytes; nothing where libharu failed.
  [[nodiscard]] std::optional<std::string> bytes() {
    if (HPDF_SaveToStream(document()) != HPDF_OK || HPDF_GetError(document()) != HPDF_OK) return {};
    std::string all(HPDF_GetStreamSize(document()), '\0');
    HPDF_ResetStream(document());
    auto size = static_cast<HPDF_UINT32>(all.size());
    HPDF_ReadFromStream(document(), reinterpret_cast<HPDF_BYTE*>(all.data()), &size);
    all.resize(size);
    return all;
  }

 private:
  [[nodiscard]] HPDF_Doc document() const { return document_.get(); }
  void require_memory() const {
    if (HPDF_GetError(document()) != HPDF_OK) throw std::bad_alloc();
  }

  void draw_with(const Sheet& sheet, Pen pen) {
    require_memory();
    HPDF_Page_SetLineWidth(page_, points(width_mm(pen)));
    static constexpr HPDF_UINT16 kChain[] = {17, 3, 2, 3};  // points: 6, 1, 0.7, 1 mm
    if (pen == Pen::kChain)
      HPDF_Page_SetDash(page_, kChain, 4, 0);
    else
      HPDF_Page_SetDash(page_, nullptr, 0, 0);
    for (const SheetPath& path : sheet.paths) {
      if (path.pen != pen || path.points.empty()) continue;
      HPDF_Page_MoveTo(page_, points(path.points[0].x()), points(path.points[0].y()));
      for (std::size_t i = 1; i < path.points.size(); ++i)
        HPDF_Page_LineTo(page_, points(path.points[i].x()), points(path.points[i].y()));
      path.closed ? HPDF_Page_ClosePathStroke(page_) : HPDF_Page_Stroke(page_);
      require_memory();
    }
    for (const SheetArc& arc : sheet.arcs)
      if (arc.pen == pen) draw(arc);
  }

  /// Bezier arcs of at most 45 degrees: off the circle by less than 5e-6 of the radius.
  void draw(const SheetArc& arc) {
    const double sweep = arc.to_rad - arc.from_rad;
    const int pieces = std::max(1, static_cast<int>(std::ceil(sweep / (0.25 * kPi) - 1e-9)));
    const double step = sweep / pieces, handle = 4.0 / 3.0 * std::tan(0.25 * step) * arc.radius_mm;
    const auto at = [&](double a) { return Point2(arc.centre + arc.radius_mm * Point2(std::cos(a), std::sin(a))); };
    const Point2 begin = at(arc.from_rad);
    HPDF_Page_MoveTo(page_, points(begin.x()), points(begin.y()));
    for (int i = 0; i < pieces; ++i) {
      const double a = arc.from_rad + i * step, b = a + step;
      const Point2 p1 = at(a) + handle * Point2(-std::sin(a), std::cos(a));
      const Point2 p2 = at(b) - handle * Point2(-std::sin(b), std::cos(b));
      const Point2 p3 = at(b);
      HPDF_Page_CurveTo(page_, points(p1.x()), points(p1.y()), points(p2.x()), points(p2.y()),
                        points(p3.x()), points(p3.y()));
    }
    HPDF_Page_Stroke(page_);
    require_memory();
  }

  void fill(const std::vector<Point2>& polygon) {
    HPDF_Page_MoveTo(page_, points(polygon[0].x()), points(polygon[0].y()));
    for (std::size_t i = 1; i < polygon.size(); ++i)
      HPDF_Page_LineTo(page_, points(polygon[i].x()), points(polygon[i].y()));
    HPDF_Page_Fill(page_);
    require_memory();
  }

  void write(const SheetText& text) {
    const std::vector<Glyph> glyphs = glyphs_of(text.text);
    const float size = points(text.height_mm / kCapitalHeight);
    float width = 0.0F;
    for (const auto& [run, symbol] : runs(glyphs)) {
      HPDF_Page_SetFontAndSize(page_, symbol ? symbol_ : helvetica_, size);
      require_memory();
      width += HPDF_Page_TextWidth(page_, run.c_str());
    }
    const double back = text.anchor == TextAnchor::kLeft ? 0.0 : text.anchor == TextAnchor::kRight ? 1.0 : 0.5;
    const auto c = static_cast<float>(std::cos(text.rotation_rad));
    const auto s = static_cast<float>(std::sin(text.rotation_rad));
    const float start = -width * static_cast<float>(back);
    HPDF_Page_BeginText(page_);
    HPDF_Page_SetTextMatrix(page_, c, s, -s, c, points(text.at.x()) + start * c, points(text.at.y()) + start * s);
    for (const auto& [run, symbol] : runs(glyphs)) {
      HPDF_Page_SetFontAndSize(page_, symbol ? symbol_ : helvetica_, size);
      require_memory();
      HPDF_Page_ShowText(page_, run.c_str());
    }
    HPDF_Page_EndText(page_);
    require_memory();
  }

  /// Neighbouring letters of one font.
  static std::vector<std::pair<std::string, bool>> runs(const std::vector<Glyph>& glyphs) {
    std::vector<std::pair<std::string, bool>> all;
    for (const Glyph& g : glyphs) {
      if (all.empty() || all.back().second != g.symbol) all.push_back({"", g.symbol});
      all.back().first += static_cast<char>(g.code);
    }
    return all;
  }

  std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, void (*)(HPDF_Doc)> document_;
  HPDF_Page page_ = nullptr;
  HPDF_Font helvetica_ = nullptr, symbol_ = nullptr;
};

}  // namespace

Status write_pdf(const std::filesystem::path& path, const std::vector<Sheet>& sheets) {
  TRUEFLANK_EXPECTS(!sheets.empty());
  PdfDocument document;
  document.set_title(sheets.front().title);
  for (const Sheet& sheet : sheets) document.add(sheet);
  const auto bytes = document.bytes();
  if (!bytes) return fail({.code = ErrorCode::kDisk, .message = "no memory for the drawing", .value = path.string()});
  return write_file(path, *bytes);
}

}  // namespace trueflank::io
