// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/loop_html.h"

#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/export/xml_text.h"
#include "trueflank/loop/gear/iso_1328.h"
#include "trueflank/report/loop_charts.h"
#include "trueflank/report/loop_page.h"

namespace trueflank::loop {
namespace {

std::string charts(const GearLoop& closed) {
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
  const ResidualGrid before = residual_grid(closed, false), after = residual_grid(closed, true);
  const GearKind gear = closed.geometry.gear().kind;
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
        html += std::string("<figure><figcaption><b>") + (grid == &before ? "before" : "after") + "</b>, " +
                (flank == Flank::kLeft ? "left" : "right") + " flanks</figcaption>" +
                chart_svg(section.kind, *grid, flank_side(flank, gear) > 0 ? 1 : 0, scale) + "</figure>";
    html += "</div>";
  }
  if (!missing.empty()) html += "<p class='note'>Not in these data: " + missing + ".</p>";
  return html;
}

std::string iso_table(const GearLoop& closed) {
  const Iso1328 iso = iso_1328(closed);
  std::string rows;
  for (const Iso1328Row& row : iso.rows) {
    if (std::isnan(row.value_um)) continue;
    const std::string name = row.accuracy_class == 0    ? "–"
                             : row.accuracy_class == 12 ? "over 11"
                                                        : std::to_string(row.accuracy_class);
    rows += "<tr><td>" + row.symbol + "</td><td>" + printed_number(row.value_um, "%.1f") + "</td><td>" + name + "</td></tr>";
  }
  if (rows.empty()) return {};
  return "<h2>ISO 1328-1, as measured</h2><p class='note'>" + io::xml_escaped(iso.note) +
         "</p><table><tr><th></th><th>µm</th><th>class</th></tr>" + rows + "</table>";
}

}  // namespace

std::string loop_html(const GearLoop& closed) {
  const LoopResult& r = closed.result;
  return loop_page_opening(r, "What the measured " + r.gear + " tells") + charts(closed) + iso_table(closed) +
         loop_page_end(r);
}

}  // namespace trueflank::loop
