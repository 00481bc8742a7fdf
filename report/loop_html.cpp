// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/loop_html.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/threads.h"
#include "trueflank/export/xml_text.h"
#include "trueflank/report/loop_charts.h"
#include "trueflank/report/loop_page.h"

namespace trueflank::loop {
namespace {

/// One drawing of many, made on all processors.
struct Drawing {
  ChartKind kind;
  const ResidualGrid* grid;
  int side;
  double scale;
};

std::vector<std::string> drawn(const std::vector<Drawing>& drawings) {
  std::vector<std::string> all(drawings.size());
  for_each_piece(all.size(), [&](std::size_t i) {
    const Drawing& one = drawings[i];
    all[i] = chart_svg(one.kind, *one.grid, one.side, one.scale);
  });
  return all;
}

std::string charts(const GearLoop& closed, const ResidualGrid& before, const ResidualGrid& after) {
  struct Section {
    ChartKind kind;
    const char *title, *lead;
  };
  constexpr Section kSections[] = {
      {ChartKind::kProfile, "Profiles", "Each tooth's mean trace from root to tip"},
      {ChartKind::kHelix, "Helices", "Each tooth's mean trace from the lower to the upper face"},
      {ChartKind::kIndex, "Place of every flank", "Index deviation [µm] by tooth"},
      {ChartKind::kOrders, "Orders around the gear", "Amplitude [µm] of the flanks' places by order"},
      {ChartKind::kTopography, "Topography", "Mean of all teeth [µm]: root to tip over the face"}};
  const GearKind gear = closed.geometry.gear().kind;
  std::vector<Drawing> drawings;
  for (const Section& section : kSections) {
    const double scale = chart_scale_um(section.kind, before);
    if (std::isnan(scale)) continue;
    for (const Flank flank : {Flank::kLeft, Flank::kRight})
      for (const ResidualGrid* grid : {&before, &after})
        drawings.push_back({section.kind, grid, flank_side(flank, gear) > 0 ? 1 : 0, scale});
  }
  const std::vector<std::string> figures = drawn(drawings);
  auto figure = figures.begin();
  std::string html, missing;
  for (const Section& section : kSections) {
    const double scale = chart_scale_um(section.kind, before);
    if (std::isnan(scale)) {
      missing += (missing.empty() ? "" : ", ") + std::string(section.title);
      continue;
    }
    const bool traces = section.kind == ChartKind::kProfile || section.kind == ChartKind::kHelix;
    html += std::string("<h2>") + section.title + "</h2><p class='note'>" + section.lead +
            (traces ? "; a tooth's column is " + printed_number(2.0 * scale / 0.9, "%.3g") + " µm wide, too much material to the right"
                    : "") +
            ". One scale before and after.</p><div class='two'>";
    for (const Flank flank : {Flank::kLeft, Flank::kRight})
      for (const ResidualGrid* grid : {&before, &after})
        html += std::string("<figure><figcaption><b>") + (grid == &before ? "before" : "after") +
                "</b>, " + (flank == Flank::kLeft ? "left" : "right") + " flanks</figcaption>" +
                *figure++ + "</figure>";
    html += "</div>";
  }
  if (!missing.empty()) html += "<p class='note'>Not in these data: " + missing + ".</p>";
  return html;
}

/// What the fit leaves, tooth by tooth.
std::string remainder(const GearLoop& closed, const ResidualGrid& after) {
  const GearKind gear = closed.geometry.gear().kind;
  std::string html;
  for (const ChartKind kind : {ChartKind::kProfileMap, ChartKind::kHelixMap}) {
    const double scale = chart_scale_um(kind, after);
    if (std::isnan(scale)) continue;
    for (const Flank flank : {Flank::kLeft, Flank::kRight})
      html += std::string("<figure><figcaption><b>") + (kind == ChartKind::kProfileMap ? "profiles" : "helices") + "</b>, " +
              (flank == Flank::kLeft ? "left" : "right") + " flanks, a column a tooth [µm]</figcaption>" +
              chart_svg(kind, after, flank_side(flank, gear) > 0 ? 1 : 0, scale) + "</figure>";
  }
  if (html.empty()) return {};
  return "<h2>The remainder after the fit</h2><p class='note'>Red: too much material, blue: too little. Noise looks like "
         "sand; stripes, steps and spots are structure that the effects above do not explain.</p><div class='two'>" + html +
         "</div>";
}

std::string class_text(int accuracy_class) {
  return accuracy_class == 0 ? "–" : accuracy_class == 12 ? "over 11" : std::to_string(accuracy_class);
}

/// A row a quantity: left, right, class of the worse.
std::string iso_table(const LoopResult& r) {
  if (r.iso_1328.empty()) return {};
  std::string rows;
  const auto value = [&](const std::string& symbol, const char* flank) {
    for (const InspectionFigure& f : r.iso_1328)
      if (f.symbol == symbol && f.flank == flank) return printed_number(f.value_um, "%.1f");
    return std::string("–");
  };
  for (const InspectionFigure& f : r.iso_1328) {
    if (f.flank != "both") continue;
    rows += "<tr><td>" + f.symbol + " <span class='id'>" + f.what + "</span></td><td>" + value(f.symbol, "left") +
            "</td><td>" + value(f.symbol, "right") + "</td><td>" + class_text(f.accuracy_class) + "</td></tr>";
  }
  return "<h2>ISO 1328-1, as measured</h2><p class='note'>" + io::xml_escaped(r.iso_1328_note) +
         "</p><div class='scroll'><table><tr><th></th><th>left, µm</th><th>right, µm</th><th>class</th></tr>" + rows +
         "</table></div>";
}

}  // namespace

std::string loop_html(const GearLoop& closed) {
  const LoopResult& r = closed.result;
  const std::array<ResidualGrid, 2> grids = residual_grids(closed);
  const ResidualGrid &before = grids[0], &after = grids[1];
  auto left = begun_beside([&] { return remainder(closed, after); });
  const std::string all = charts(closed, before, after);
  return loop_page_opening(r, "What the measured " + r.gear + " shows") + left.get() + all +
         iso_table(r) + loop_page_end(r);
}

}  // namespace trueflank::loop
