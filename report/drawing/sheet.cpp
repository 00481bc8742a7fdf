// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/sheet.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank::io {
namespace {

constexpr double kArrowLength_mm = 2.8, kArrowHalfWidth_mm = 0.5;
constexpr double kExtensionGap_mm = 0.8, kExtensionOver_mm = 1.6;
constexpr double kOutside_mm = 6.0;  // of a dimension line whose arrows stand outside
constexpr double kTextGap_mm = 0.8, kDimensionText_mm = 2.5;

}  // namespace

double width_mm(Pen pen) {
  switch (pen) {
    case Pen::kThick: return 0.5;
    case Pen::kThin: return 0.25;
    case Pen::kChain: return 0.25;
    case Pen::kHatch: return 0.18;
    case Pen::kFrame: return 0.7;
  }
  return 0.25;
}

const char* to_text(Pen pen) {
  switch (pen) {
    case Pen::kThick: return "VISIBLE";
    case Pen::kThin: return "THIN";
    case Pen::kChain: return "CENTRE";
    case Pen::kHatch: return "HATCH";
    case Pen::kFrame: return "FRAME";
  }
  return "0";
}

void Sheet::line(const Point2& from, const Point2& to, Pen pen) {
  paths.push_back({.points = {from, to}, .pen = pen});
}

void Sheet::circle(const Point2& centre, double radius_mm, Pen pen) {
  arcs.push_back({.centre = centre, .radius_mm = radius_mm, .from_rad = 0.0, .to_rad = kTwoPi, .pen = pen});
}

void Sheet::box(const Point2& low, const Point2& high, Pen pen) {
  paths.push_back({.points = {low, {high.x(), low.y()}, high, {low.x(), high.y()}}, .closed = true, .pen = pen});
}

void Sheet::text(const Point2& at, std::string_view words, double letter_mm, TextAnchor anchor,
                 double rotation_rad) {
  texts.push_back({at, std::string(words), letter_mm, anchor, rotation_rad});
}

void Sheet::arrow(const Point2& tip, const Point2& direction) {
  const Point2 back = tip - kArrowLength_mm * direction;
  const Point2 side(-direction.y(), direction.x());
  fills.push_back({tip, back + kArrowHalfWidth_mm * side, back - kArrowHalfWidth_mm * side});
}

void Sheet::dot(const Point2& at) {
  constexpr double kRadius_mm = 0.6;
  for (int half : {0, 1})  // two quadrangles: DXF fills no more corners than that
    fills.push_back({at + kRadius_mm * unit_vector(kPi * half), at + kRadius_mm * unit_vector(kPi * (half + 1.0 / 3.0)),
                     at + kRadius_mm * unit_vector(kPi * (half + 2.0 / 3.0)), at + kRadius_mm * unit_vector(kPi * (half + 1.0))});
}

void Sheet::hatch(const Point2& low, const Point2& high, bool rising, double spacing_mm) {
  // lines y = c + s x with c on one grid for the whole sheet
  const double s = rising ? 1.0 : -1.0;
  const double step = spacing_mm * std::numbers::sqrt2;
  const double c1 = low.y() - s * (rising ? high.x() : low.x());
  const double c2 = high.y() - s * (rising ? low.x() : high.x());
  for (double k = std::ceil(c1 / step); k * step < c2; k += 1.0) {
    const double c = k * step;
    double x1 = (low.y() - c) / s, x2 = (high.y() - c) / s;
    if (x1 > x2) std::swap(x1, x2);
    x1 = std::max(x1, low.x());
    x2 = std::min(x2, high.x());
    if (x2 - x1 > 0.05) line({x1, c + s * x1}, {x2, c + s * x2}, Pen::kHatch);
  }
}

double text_width_mm(std::string_view utf8, double height_mm) {
  // Helvetica: capitals are 0.72 of the type size, a mean letter 0.52 of it wide
  const auto letters = std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return 0.74 * height_mm * static_cast<double>(letters);
}

namespace {

/// How a horizontal dimension is set.
struct HorizontalSetting {
  double x1, x2, width;
  bool arrows_inside, text_inside;
  explicit HorizontalSetting(const Dimension& d)
      : x1(std::min(d.from.x(), d.to.x())), x2(std::max(d.from.x(), d.to.x())), width(text_width_mm(d.text, kDimensionText_mm)),
        arrows_inside(x2 - x1 > 2.0 * kArrowLength_mm + 1.0), text_inside(x2 - x1 > width + 1.0) {}
};

}  // namespace

std::pair<double, double> reach_of(const Dimension& d) {
  const HorizontalSetting set(d);
  const double reach = set.arrows_inside ? 0.0 : kOutside_mm;
  return {set.x1 - reach, set.x2 + (set.text_inside ? reach : kOutside_mm + 1.0 + set.width)};
}

std::vector<int> dimension_rows(const std::vector<Dimension>& dimensions) {
  std::vector<int> rows;
  std::vector<std::vector<std::pair<double, double>>> taken;
  for (const Dimension& d : dimensions) {
    const std::pair<double, double> own = reach_of(d);
    std::size_t row = 0;
    const auto free = [&](const std::pair<double, double>& other) { return own.second < other.first + 1e-6 || own.first > other.second - 1e-6; };
    while (row < taken.size() && !std::all_of(taken[row].begin(), taken[row].end(), free)) ++row;
    if (row == taken.size()) taken.emplace_back();
    taken[row].push_back(own);
    rows.push_back(static_cast<int>(row));
  }
  return rows;
}

void move_texts_aside(std::vector<Dimension>& dimensions) {
  constexpr int kTries = 8;  // to either side
  for (Dimension& d : dimensions) {
    const HorizontalSetting set(d);
    if (!set.text_inside) continue;
    const auto crossed = [&](double aside) {
      const double middle = 0.5 * (set.x1 + set.x2) + aside, half = 0.5 * set.width + 0.3;
      return std::any_of(dimensions.begin(), dimensions.end(), [&](const Dimension& other) {
        return other.line_at_mm < d.line_at_mm && (std::abs(other.from.x() - middle) < half || std::abs(other.to.x() - middle) < half);
      });
    };
    const double room = 0.5 * (set.x2 - set.x1 - set.width);
    for (int i = 0; i <= 2 * kTries; ++i) {
      const double aside = room * ((i + 1) / 2) / kTries * (i % 2 == 0 ? 1.0 : -1.0);
      if (crossed(aside)) continue;
      d.text_aside_mm = aside;
      break;
    }
  }
}

void horizontal_dimension(Sheet& sheet, const Dimension& d) {
  const double y = d.line_at_mm;
  const HorizontalSetting set(d);
  for (const Point2& p : {d.from, d.to}) {
    const double up = y > p.y() ? 1.0 : -1.0;
    sheet.line({p.x(), p.y() + up * kExtensionGap_mm}, {p.x(), y + up * kExtensionOver_mm}, Pen::kThin);
  }
  const double left = set.arrows_inside ? 0.0 : kOutside_mm, right = set.text_inside ? left : kOutside_mm + 1.0 + set.width;
  sheet.line({set.x1 - left, y}, {set.x2 + right, y}, Pen::kThin);
  sheet.arrow({set.x1, y}, set.arrows_inside ? Point2(-1.0, 0.0) : Point2(1.0, 0.0));
  sheet.arrow({set.x2, y}, set.arrows_inside ? Point2(1.0, 0.0) : Point2(-1.0, 0.0));
  if (set.text_inside)
    sheet.text({0.5 * (set.x1 + set.x2) + d.text_aside_mm, y + kTextGap_mm}, d.text, kDimensionText_mm, TextAnchor::kMiddle);
  else
    sheet.text({set.x2 + kOutside_mm + 0.5, y + kTextGap_mm}, d.text, kDimensionText_mm);
}

void vertical_dimension(Sheet& sheet, const Dimension& d) {
  const double x = d.line_at_mm;
  const double y1 = std::min(d.from.y(), d.to.y()), y2 = std::max(d.from.y(), d.to.y());
  for (const Point2& p : {d.from, d.to}) {
    const double right = x > p.x() ? 1.0 : -1.0;
    sheet.line({p.x() + right * kExtensionGap_mm, p.y()}, {x + right * kExtensionOver_mm, p.y()}, Pen::kThin);
  }
  const double width = text_width_mm(d.text, kDimensionText_mm);
  const bool inside = y2 - y1 > 2.0 * kArrowLength_mm + 1.0;
  const bool text_inside = y2 - y1 > width + 1.0;
  const double reach = inside ? 0.0 : kOutside_mm;
  // a text that is longer than the distance goes on upwards: below there may be a datum
  const double middle = text_inside ? 0.5 * (y1 + y2) : y1 + 1.0 + 0.5 * width;
  sheet.line({x, y1 - reach}, {x, std::max(y2 + reach, middle + 0.5 * (text_inside ? 0.0 : width))}, Pen::kThin);
  sheet.arrow({x, y1}, inside ? Point2(0.0, -1.0) : Point2(0.0, 1.0));
  sheet.arrow({x, y2}, inside ? Point2(0.0, 1.0) : Point2(0.0, -1.0));
  sheet.text({x - kTextGap_mm, middle}, d.text, kDimensionText_mm, TextAnchor::kMiddle, 0.5 * kPi);
}

}  // namespace trueflank::io
