// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/compare_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/export/xml_text.h"

namespace trueflank {
namespace {

constexpr double kWidth = 1200, kHeight = 560, kPanel = 370, kPanelTop = 84, kGap = 22.5;
/// Deviations from far too little (blue) over none (grey) to far too much (red).
constexpr std::array<const char*, 7> kColours = {"#08519c", "#3182bd", "#7fb3d8", "#9a9a9a",
                                                 "#f4a582", "#e0603a", "#a50f15"};
constexpr double kExaggeratedShare = 0.12;  ///< of the panel, for the largest deviation
constexpr double kPiece = 12.0;             ///< of an edge with one colour [px]
constexpr double kZoom = 8.0;               ///< the closest view is as many deviations wide

std::string px(double value) { return printed("%.2f", value); }

/// Rounding is no deviation and has no sign.
std::string signed_um(double length_mm) {
  const double rounded = std::round(1e5 * length_mm) * 1e-2;
  return rounded == 0.0 ? "0.00" : printed("%+.2f", rounded);
}

/// The largest of 1, 2, 5 times a power of ten that is not above the value.
double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double share = value / power;
  return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

std::string length_text(double length_mm) {
  return length_mm < 0.0999 ? printed("%g", um_from_mm(length_mm)) + " µm" : printed("%g", length_mm) + " mm";
}

/// A square window of the section on the page.
struct SectionView {
  double left = 0.0;
  Point2 centre{0.0, 0.0};
  double size_mm = 1.0;
  double turn_rad = 0.0;  ///< of the drawing, counter-clockwise

  [[nodiscard]] double scale() const { return kPanel / size_mm; }
  [[nodiscard]] Point2 at(const Point2& p) const {
    const Point2 q = rotated(p - centre, turn_rad) * scale();
    return {left + 0.5 * kPanel + q.x(), kPanelTop + 0.5 * kPanel - q.y()};
  }
  /// Near enough to be drawn; what is clipped costs only bytes.
  [[nodiscard]] bool shows(const Point2& p, double margin = 1.0) const {
    return (p - centre).norm() < (0.75 + margin) * size_mm;
  }
};

std::string point_px(const Point2& p) { return px(p.x()) + "," + px(p.y()); }

/// Closed outlines as path data. Far outside of the view corners are thinned out: long edges would lose
/// nothing but bytes, yet every outline must stay closed to be filled.
std::string path_of(const MeshSection& section, const SectionView& view) {
  std::string path;
  for (const auto& loop : section.loops) {
    bool near = false;
    std::string text;
    std::size_t skipped = 0;
    for (const Point2& p : loop) {
      const bool shown = view.shows(p);
      near = near || shown || (p - view.centre).norm() < 3.0 * view.size_mm;
      if (!shown && skipped < 3) {
        ++skipped;
        continue;
      }
      skipped = 0;
      text += (text.empty() ? "M" : "L") + point_px(view.at(p));
    }
    if (!text.empty()) path += text + "Z";
  }
  return path;
}

std::string frame(const SectionView& view, int index, const std::string& caption) {
  const std::string box = "x=\"" + px(view.left) + "\" y=\"" + px(kPanelTop) + "\" width=\"" +
                          px(kPanel) + "\" height=\"" + px(kPanel) + "\"";
  return "<clipPath id=\"view" + std::to_string(index) + "\"><rect " + box + " rx=\"6\"/></clipPath>\n<rect " +
         box + " rx=\"6\" fill=\"#fff\" stroke=\"#c8c8c8\"/>\n<text x=\"" + px(view.left + 4) + "\" y=\"" +
         px(kPanelTop - 9) + "\" class=\"c\">" + io::xml_escaped(caption) + "</text>\n";
}

std::string clipped(int index, const std::string& content) {
  return "<g clip-path=\"url(#view" + std::to_string(index) + ")\">\n" + content + "</g>\n";
}

std::string scale_bar(const SectionView& view) {
  const double length = round_down(0.3 * view.size_mm);
  const double x = view.left + 14, y = kPanelTop + kPanel - 14, to = x + length * view.scale();
  const std::string label = length_text(length);
  return "<rect x=\"" + px(x - 8) + "\" y=\"" + px(y - 22) + "\" width=\"" + px(to - x + 16) +
         "\" height=\"30\" rx=\"4\" fill=\"#fff\" opacity=\"0.85\"/><path d=\"M" + px(x) + "," + px(y - 5) + "v5H" + px(to) +
         "v-5\" fill=\"none\" stroke=\"#222\"/><text x=\"" + px(0.5 * (x + to)) + "\" y=\"" + px(y - 8) +
         "\" class=\"n\" text-anchor=\"middle\">" + label + "</text>\n";
}

std::size_t colour_of(double deviation_mm, double full_mm) {
  const double share = std::clamp(deviation_mm / full_mm, -1.0, 1.0);
  return static_cast<std::size_t>(std::lround(3.0 + 3.0 * share));
}

/// The new outline, coloured by deviation.
std::string coloured_outline(const MeshDifference& d, const SectionView& view, double full_mm, double width) {
  std::array<std::string, kColours.size()> paths;
  for (const OutlineRun& run : d.outlines) {
    if (run.on_golden) continue;
    for (std::size_t i = 0; i < run.points.size(); ++i) {
      const OutlineDeviation &here = run.points[i], &next = run.points[(i + 1) % run.points.size()];
      if (!view.shows(here.point, 0.3) && !view.shows(next.point, 0.3)) continue;
      // from point to point the colour follows the deviation
      const Point2 edge = next.point - here.point;
      const int pieces = std::clamp(static_cast<int>(edge.norm() * view.scale() / kPiece), 1, 40);
      for (int k = 0; k < pieces; ++k) {
        const double middle = (k + 0.5) / pieces;
        const double deviation = here.deviation_mm + (next.deviation_mm - here.deviation_mm) * middle;
        paths[colour_of(deviation, full_mm)] +=
            "M" + point_px(view.at(here.point + edge * (static_cast<double>(k) / pieces))) + "L" +
            point_px(view.at(here.point + edge * ((k + 1.0) / pieces)));
      }
    }
  }
  std::string text;
  for (std::size_t c = 0; c < paths.size(); ++c)
    if (!paths[c].empty())
      text += "<path d=\"" + paths[c] + "\" fill=\"none\" stroke=\"" + kColours[c] +
              "\" stroke-width=\"" + px(width) + "\" stroke-linecap=\"round\"/>\n";
  return text;
}

/// From the golden outline towards the new one, many times as far.
std::string exaggerated(const MeshDifference& d, const SectionView& view, double full_mm, double factor) {
  std::array<std::string, kColours.size()> whiskers;
  std::string line;
  for (const OutlineRun& run : d.outlines) {
    if (!run.on_golden) continue;
    bool drawing = false;
    for (std::size_t i = 0; i <= run.points.size(); ++i) {
      const OutlineDeviation& here = run.points[i % run.points.size()];
      const bool shown = view.shows(here.point, 0.3);
      if (shown) {
        const Point2 end = here.point + (here.nearest - here.point) * factor;
        whiskers[colour_of(here.deviation_mm, full_mm)] +=
            "M" + point_px(view.at(here.point)) + "L" + point_px(view.at(end));
        line += (drawing ? "L" : "M") + point_px(view.at(end));
      }
      drawing = shown;
    }
  }
  std::string text;
  for (std::size_t c = 0; c < whiskers.size(); ++c)
    if (!whiskers[c].empty())
      text += "<path d=\"" + whiskers[c] + "\" stroke=\"" + kColours[c] + "\" stroke-width=\"1.4\"/>\n";
  return text + "<path d=\"" + line + "\" fill=\"none\" stroke=\"#222\" stroke-width=\"0.9\"/>\n";
}

/// Nearest point of the other outline to the worst place, which lies on one of them.
Point2 opposite(const MeshDifference& d) {
  Point2 best = d.worst;
  double nearest_to_size = 1e300;
  const double size = std::abs(d.worst_deviation_mm);
  for (const MeshSection* section : {&d.golden, &d.made}) {
    double nearest = 1e300;
    Point2 foot = d.worst;
    for (const auto& loop : section->loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point2 &a = loop[i], edge = loop[(i + 1) % loop.size()] - a;
        const double t = std::clamp((d.worst - a).dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0.0, 1.0);
        const Point2 p = a + t * edge;
        if ((p - d.worst).norm() < nearest) nearest = (p - d.worst).norm(), foot = p;
      }
    // of the two outlines the one that is not the place's own
    if (std::abs(nearest - size) < nearest_to_size) nearest_to_size = std::abs(nearest - size), best = foot;
  }
  return best;
}

std::string dimension(const MeshDifference& d, const SectionView& view) {
  const Point2 a = view.at(d.worst), b = view.at(opposite(d));
  const Point2 middle = 0.5 * (a + b);
  Point2 aside = perpendicular(b - a);
  aside = aside.norm() > 1e-9 ? Point2(aside.normalized()) : Point2(1.0, 0.0);
  if (aside.x() < 0.0) aside = -aside;
  const Point2 label = middle + 16.0 * aside + Point2(0.0, 5.0);
  return "<path d=\"M" + point_px(a) + "L" + point_px(b) +
         "\" stroke=\"#222\" stroke-width=\"1.6\" marker-start=\"url(#a)\" marker-end=\"url(#a)\"/><circle cx=\"" +
         px(a.x()) + "\" cy=\"" + px(a.y()) + "\" r=\"3\" fill=\"#222\"/><text x=\"" + px(label.x()) + "\" y=\"" +
         px(label.y()) + "\" class=\"d\">" + signed_um(d.worst_deviation_mm) +
         " µm</text>\n";
}

std::string fill(const MeshSection& section, const SectionView& view) {
  return "<path d=\"" + path_of(section, view) +
         "\" fill=\"#e4e4e0\" fill-rule=\"evenodd\" stroke=\"#777\" stroke-width=\"0.8\"/>\n";
}

/// Colours, what they mean, and what each region of the teeth has.
std::string legend(const MeshDifference& d, double full_mm, double tolerance_mm) {
  const double top = kPanelTop + kPanel + 28, step = 30;
  std::string text;
  for (std::size_t c = 0; c < kColours.size(); ++c)
    text += "<rect x=\"" + px(kGap + step * static_cast<double>(c)) + "\" y=\"" + px(top) + "\" width=\"" +
            px(step) + "\" height=\"10\" fill=\"" + kColours[c] + "\"/>";
  text += "\n<text x=\"" + px(kGap) + "\" y=\"" + px(top + 26) + "\" class=\"n\">" +
          printed("%+.2f µm", um_from_mm(-full_mm)) + "</text><text x=\"" + px(kGap + 7 * step) + "\" y=\"" +
          px(top + 26) + "\" class=\"n\" text-anchor=\"end\">" + printed("%+.2f µm", um_from_mm(full_mm)) +
          "</text><text x=\"" + px(kGap) + "\" y=\"" + px(top + 46) +
          "\" class=\"n\">deviation of the new part; + too much material</text>\n";
  double x = kGap * 2 + kPanel;
  for (const RegionDifference& region : d.regions) {
    std::string name = std::string(to_text(region.region)) + "s";
    text += "<text x=\"" + px(x) + "\" y=\"" + px(top + 10) + "\" class=\"t\">" + name + "</text><text x=\"" +
            px(x) + "\" y=\"" + px(top + 29) + "\" class=\"n\">" + signed_um(region.least_mm) + " … " +
            signed_um(region.greatest_mm) + " µm" + "</text><text x=\"" + px(x) +
            "\" y=\"" + px(top + 46) + "\" class=\"n\">" + std::to_string(region.teeth_off) + " of " +
            std::to_string(d.teeth->count) + " beyond " + printed("%g µm", um_from_mm(tolerance_mm)) +
            "</text>\n";
    x += 196;
  }
  return text;
}

SectionView whole_view(const MeshDifference& d) {
  Point2 low(1e300, 1e300), high(-1e300, -1e300);
  for (const MeshSection* section : {&d.golden, &d.made})
    for (const auto& loop : section->loops)
      for (const Point2& p : loop) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (!(high.x() >= low.x())) low = high = d.worst;
  return {.left = kGap, .centre = 0.5 * (low + high),
          .size_mm = std::max(1.08 * (high - low).maxCoeff(), 1e-6)};
}

/// The tooth at the worst place, its tip up; without teeth the surroundings of the place.
SectionView tooth_view(const MeshDifference& d, const SectionView& whole) {
  SectionView view{.left = 2 * kGap + kPanel, .centre = d.worst,
            .size_mm = std::max(0.15 * whole.size_mm, 4.0 * std::abs(d.worst_deviation_mm))};
  if (!d.on_teeth) return view;
  const SectionTeeth& teeth = *d.teeth;
  const double middle = 0.5 * (teeth.tip_radius_mm + teeth.root_radius_mm);
  const double pitch = kTwoPi / teeth.count;
  const double index = (polar_angle_rad(d.worst) - teeth.first_centre_rad) / pitch;
  const double angle = teeth.first_centre_rad + std::round(index) * pitch;
  view.centre = middle * unit_vector(angle);
  view.turn_rad = (teeth.internal ? -0.5 : 0.5) * kPi - angle;
  view.size_mm = 1.6 * std::max(pitch * middle, std::abs(teeth.tip_radius_mm - teeth.root_radius_mm));
  return view;
}

}  // namespace

std::string compare_picture_svg(const MeshDifference& d, const ComparePictureOptions& options) {
  const double largest = std::max(std::abs(d.worst_deviation_mm), 1e-6);
  const SectionView whole = whole_view(d);
  const SectionView tooth = tooth_view(d, whole);
  const SectionView close{.left = 3 * kGap + 2 * kPanel, .centre = 0.5 * (d.worst + opposite(d)),
                   .size_mm = kZoom * largest, .turn_rad = tooth.turn_rad};
  const double factor = std::max(1.0, round_down(kExaggeratedShare * tooth.size_mm / largest));
  const Point2 mark = whole.at(d.worst);

  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(kWidth) + " " + px(kHeight) +
      "\" width=\"" + px(kWidth) + "\" height=\"" + px(kHeight) +
      "\" font-family=\"Helvetica,Arial,sans-serif\">\n<style>.h{font-size:19px;font-weight:bold}"
      ".c{font-size:13px;fill:#444}.n{font-size:12px;fill:#333}.t{font-size:13px;font-weight:bold}"
      ".d{font-size:15px;font-weight:bold;paint-order:stroke;stroke:#fff;stroke-width:4px}</style>\n"
      "<defs><marker id=\"a\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"7\" markerHeight=\"7\" "
      "orient=\"auto-start-reverse\"><path d=\"M0,1 L10,5 L0,9z\" fill=\"#222\"/></marker></defs>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fafaf8\"/>\n<text x=\"" + px(kGap) +
      "\" y=\"30\" class=\"h\">" + io::xml_escaped(options.title) + "</text>\n<text x=\"" + px(kGap) +
      "\" y=\"51\" class=\"n\">" + io::xml_escaped(options.subtitle) + "</text>\n";
  const std::string section =
      d.across_axis ? "section across the axis at z = " + printed("%.3f mm", d.plane.origin_mm.z())
                    : "section along the axis at " +
                          printed("%.2f deg", deg_from_rad(wrapped_rad(polar_angle_rad(d.plane.u.head<2>()))));
  svg += frame(whole, 0, section) +
         clipped(0, fill(d.golden, whole) + coloured_outline(d, whole, largest, 1.6) + "<circle cx=\"" +
                        px(mark.x()) + "\" cy=\"" + px(mark.y()) +
                        "\" r=\"9\" fill=\"none\" stroke=\"#222\" stroke-width=\"1.6\"/>\n" + scale_bar(whole));
  svg += frame(tooth, 1, d.place + ", deviations × " + printed("%g", factor)) +
         clipped(1, fill(d.golden, tooth) + exaggerated(d, tooth, largest, factor) + scale_bar(tooth));
  svg += frame(close, 2, "the worst place: golden grey, new coloured") +
         clipped(2, fill(d.golden, close) + coloured_outline(d, close, largest, 2.2) + dimension(d, close) +
                        scale_bar(close));
  return svg + legend(d, largest, options.tolerance_mm) + "</svg>\n";
}

}  // namespace trueflank
