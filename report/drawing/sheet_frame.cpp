// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/sheet_frame.h"

#include <map>
#include <numeric>
#include <string_view>

#include "trueflank/base/units.h"

namespace trueflank::io {
namespace {

constexpr double kTableText_mm = 2.2, kLabel_mm = 1.6;

void cell(Sheet& sheet, const Point2& low, const Point2& high, const std::string& label,
          const std::string& words, double height_mm) {
  sheet.box(low, high, Pen::kThin);
  sheet.text({low.x() + 1.2, high.y() - 2.6}, label, kLabel_mm);
  // long names shrink rather than leave their cell
  const double room = high.x() - low.x() - 3.0;
  const double width = text_width_mm(words, height_mm);
  sheet.text({low.x() + 1.8, low.y() + 1.6}, words,
             width > room ? height_mm * room / width : height_mm);
}

/// The truncated cone that tells first-angle projection (ISO 5456-2).
void projection_symbol(Sheet& sheet, const Point2& centre) {
  const Point2 cone = centre + Point2(-4.5, 0.0), ends = centre + Point2(4.5, 0.0);
  sheet.paths.push_back({.points = {cone + Point2(-3.0, -1.2), cone + Point2(3.0, -2.4),
                                    cone + Point2(3.0, 2.4), cone + Point2(-3.0, 1.2)},
                         .closed = true,
                         .pen = Pen::kThin});
  sheet.circle(ends, 2.4, Pen::kThin);
  sheet.circle(ends, 1.2, Pen::kThin);
  sheet.line(cone + Point2(-4.0, 0.0), ends + Point2(3.2, 0.0), Pen::kChain);
}

/// What holds where nothing else is said; in brackets that something else is.
void draw_general_surface(Sheet& sheet, const Point2& at, const TitleBlock& title) {
  draw_surface(sheet, at, title.surfaces, title.removal);
  if (!title.other_surfaces) return;
  const double x = at.x() + surface_width_mm(title.surfaces) + 2.0;
  sheet.text({x, at.y() + 2.2}, "(", 4.0);
  draw_surface(sheet, {x + 4.4, at.y() + 0.6}, "", Removal::kAny);
  sheet.text({x + 9.2, at.y() + 2.2}, ")", 4.0);
}

/// Width of a letter of Helvetica or Symbol over the height of capitals; those that symbols begin
/// with.
double letter_width(std::string_view letter) {
  static const std::map<std::string_view, double> kWidths = {
      {"m", 1.16}, {"P", 0.93}, {"W", 1.31}, {"D", 1.0},  {"M", 1.16}, {"F", 0.85},
      {"f", 0.45}, {"j", 0.45}, {"±", 0.81}, {"α", 0.88}, {"s", 0.7},  {" ", 0.39}};
  const auto found = kWidths.find(letter);
  return found == kWidths.end() ? 0.78 : found->second;
}

/// "±f_pT": what follows the underscore is smaller and lower.
void draw_symbol(Sheet& sheet, const Point2& at, const std::string& words) {
  const std::size_t bar = words.find('_');
  double width = 0.0;
  for (std::size_t i = 0; i < bar;) {
    const std::size_t length = static_cast<unsigned char>(words[i]) < 0x80 ? 1 : 2;
    width += kTableText_mm * letter_width(std::string_view(words).substr(i, length));
    i += length;
  }
  sheet.text(at, words.substr(0, bar), kTableText_mm);
  sheet.text(at + Point2(width + 0.15, -0.7), words.substr(bar + 1), 0.72 * kTableText_mm);
}

}  // namespace

void draw_frame(Sheet& sheet, const TitleBlock& title) {
  const Point2 low(kBorderLeft_mm, kBorder_mm),
      high(sheet.width_mm - kBorder_mm, sheet.height_mm - kBorder_mm);
  sheet.box(low, high, Pen::kFrame);
  const double x = high.x() - kTitleWidth_mm, y = low.y();
  const double row = kTitleHeight_mm / 3.0;
  sheet.box({x, y}, {high.x(), y + kTitleHeight_mm}, Pen::kThick);
  const auto put = [&](double x1, double x2, int line, const char* label, const std::string& words,
                       double h) {
    cell(sheet, {x + x1, y + line * row}, {x + x2, y + (line + 1) * row}, label, words, h);
  };
  put(0, 62, 2, "General tolerances", title.general_tolerances, 2.5);
  put(62, 120, 2, "Material", title.material, 2.5);
  put(120, 180, 2, "Mass", title.mass, 2.5);
  put(0, 24, 1, "Projection", "", 2.5);
  projection_symbol(sheet, {x + 12.0, y + 1.35 * row});
  put(24, 62, 1, "Surfaces", "", 2.5);
  if (!title.surfaces.empty()) draw_general_surface(sheet, {x + 28.0, y + row + 1.4}, title);
  put(62, 180, 1, "Title", title.part, 4.0);
  put(0, 62, 0, "Made by", std::string("Trueflank ") + TRUEFLANK_VERSION, 2.5);
  put(62, 130, 0, "Design", title.design, 3.0);
  put(130, 155, 0, "Scale", title.scale, 3.0);
  put(155, 180, 0, "Sheet", title.sheet_size, 3.0);
}

void draw_table(Sheet& sheet, const Point2& corner, const std::vector<TableColumn>& columns,
                const std::vector<std::vector<std::string>>& rows) {
  const double width =
      std::accumulate(columns.begin(), columns.end(), 0.0,
                      [](double sum, const TableColumn& c) { return sum + c.width_mm; });
  const double left = corner.x() - width;
  const double bottom = corner.y() - kRowHeight_mm * static_cast<double>(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double y = corner.y() - kRowHeight_mm * static_cast<double>(i + 1);
    sheet.line({left, y}, {corner.x(), y}, i == 0 ? Pen::kThick : Pen::kThin);
    double x = left;
    for (std::size_t k = 0; k < columns.size() && k < rows[i].size(); ++k) {
      const double room = columns[k].width_mm - 2.0;
      const double words = text_width_mm(rows[i][k], kTableText_mm);
      const double height = words > room ? kTableText_mm * room / words : kTableText_mm;
      const bool right = columns[k].anchor == TextAnchor::kRight;
      if (columns[k].symbols && rows[i][k].find('_') != std::string::npos) {
        draw_symbol(sheet, {x + 1.0, y + 1.2}, rows[i][k]);
        x += columns[k].width_mm;
        continue;
      }
      sheet.text({right ? x + columns[k].width_mm - 1.0 : x + 1.0, y + 1.2}, rows[i][k], height,
                 columns[k].anchor);
      x += columns[k].width_mm;
    }
  }
  double x = left;
  for (const TableColumn& column : columns) {
    sheet.line({x, bottom}, {x, corner.y()}, x == left ? Pen::kThick : Pen::kThin);
    x += column.width_mm;
  }
  sheet.box({left, bottom}, corner, Pen::kThick);
}

namespace {

/// Lines of at most `room` millimetres, broken between words; the second and later ones under the
/// first's words.
std::vector<std::string> broken(const std::string& sentence, double room_mm, double height_mm) {
  std::vector<std::string> lines = {""};
  for (std::size_t from = 0; from < sentence.size();) {
    const std::size_t to = std::min(sentence.find(' ', from), sentence.size());
    const std::string word = sentence.substr(from, to - from);
    if (lines.back().find_first_not_of(' ') != std::string::npos &&
        text_width_mm(lines.back() + " " + word, height_mm) > room_mm)
      lines.push_back("   " + word);
    else
      lines.back() += (lines.back().empty() ? "" : " ") + word;
    from = to + 1;
  }
  return lines;
}

}  // namespace

void draw_notes(Sheet& sheet, const Point2& corner, const std::vector<std::string>& notes) {
  constexpr double kNote_mm = 2.0;
  const double room = sheet.width_mm - kBorder_mm - kTitleWidth_mm - 2.0 - corner.x();
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < notes.size(); ++i)
    for (std::string& line : broken(std::to_string(i + 1) + ". " + notes[i], room, kNote_mm))
      lines.push_back(std::move(line));
  for (std::size_t i = 0; i < lines.size(); ++i)
    sheet.text({corner.x(), corner.y() + 4.0 * static_cast<double>(lines.size() - 1 - i)}, lines[i],
               kNote_mm);
}

const std::vector<std::pair<std::string, double>>& drawing_scales() {
  static const std::vector<std::pair<std::string, double>> kScales = {
      {"50:1", 50.0},   {"20:1", 20.0},  {"10:1", 10.0},  {"5:1", 5.0},    {"2:1", 2.0},
      {"1:1", 1.0},     {"1:2", 0.5},    {"1:5", 0.2},    {"1:10", 0.1},   {"1:20", 0.05},
      {"1:50", 0.02},   {"1:100", 0.01}, {"1:200", 5e-3}, {"1:500", 2e-3}, {"1:1000", 1e-3},
      {"1:2000", 5e-4}, {"1:5000", 2e-4}};
  return kScales;
}

}  // namespace trueflank::io
