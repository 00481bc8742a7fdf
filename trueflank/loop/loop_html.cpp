// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/loop_html.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "trueflank/loop/iso_1328.h"

namespace trueflank::loop {
namespace {

constexpr int kParts = FlankResiduals::kParts;

std::string number(double value, const char* format = "%.2f") {
  char text[40];
  std::snprintf(text, sizeof text, format, value == 0.0 ? 0.0 : value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') result += "&lt;";
    else if (c == '>') result += "&gt;";
    else if (c == '&') result += "&amp;";
    else result += c;
  }
  return result;
}

/// One number that all charts before and after share, so that they can be compared by eye.
double scale_of(const ResidualGrid& before) {
  std::vector<double> sizes;
  for (const auto& tooth : before.teeth)
    for (const auto& flank : tooth)
      for (int i = 0; i < kParts; ++i)
        for (const double value : {flank.profile[i], flank.helix[i]})
          if (!std::isnan(value)) sizes.push_back(std::abs(value));
  if (sizes.empty()) return 1.0;
  std::sort(sizes.begin(), sizes.end());
  return std::max(1e-6, sizes[static_cast<std::size_t>(0.98 * static_cast<double>(sizes.size() - 1))]);
}

/// All teeth side by side, as inspection sheets show them: deviation to the right, course upwards.
std::string trace_chart(const ResidualGrid& grid, int side, bool profile, double scale) {
  const int width = 900, height = 110;
  const double step = static_cast<double>(width) / static_cast<double>(grid.teeth.size());
  std::string svg = "<svg viewBox='0 0 900 110'>";
  for (std::size_t k = 0; k < grid.teeth.size(); ++k) {
    const double middle = (static_cast<double>(k) + 0.5) * step;
    svg += "<path class='z' d='M" + number(middle) + " 5V105'/>";
    std::string path;
    const auto& trace = profile ? grid.teeth[k][side].profile : grid.teeth[k][side].helix;
    for (int i = 0; i < kParts; ++i) {
      if (std::isnan(trace[i])) continue;
      path += (path.empty() ? "M" : "L") + number(middle + 0.45 * step * trace[i] / scale) + " " +
              number(height - 5 - 100.0 * (i + 0.5) / kParts);
    }
    if (!path.empty()) svg += "<path class='t' d='" + path + "'/>";
  }
  return svg + "</svg>";
}

std::string pitch_chart(const ResidualGrid& grid, int side, double scale) {
  const double step = 900.0 / static_cast<double>(grid.teeth.size());
  std::string svg = "<svg viewBox='0 0 900 110'><path class='z' d='M0 55H900'/>";
  for (std::size_t k = 0; k < grid.teeth.size(); ++k) {
    const double value = grid.teeth[k][side].index;
    if (std::isnan(value)) continue;
    const double bar = std::clamp(50.0 * value / scale, -54.0, 54.0);
    svg += "<rect class='b' x='" + number((static_cast<double>(k) + 0.15) * step) + "' y='" +
           number(bar > 0.0 ? 55.0 - bar : 55.0) + "' width='" + number(0.7 * step) + "' height='" +
           number(std::abs(bar)) + "'/>";
  }
  return svg + "</svg>";
}

std::string topography_chart(const ResidualGrid& grid, int side, double scale) {
  std::string svg = "<svg viewBox='0 0 240 240'>";
  for (int u = 0; u < kParts; ++u)
    for (int v = 0; v < kParts; ++v) {
      const double value = grid.topography[side][u][v];
      if (std::isnan(value)) continue;
      const double t = std::clamp(value / scale, -1.0, 1.0);
      const int fade = static_cast<int>(255.0 * (1.0 - std::abs(t)));
      const std::string other = std::to_string(fade);
      svg += "<rect x='" + std::to_string(10 * v) + "' y='" + std::to_string(230 - 10 * u) +
             "' width='10' height='10' fill='rgb(" +
             (t > 0.0 ? "255," + other + "," + other : other + "," + other + ",255") + ")'/>";
    }
  return svg + "</svg>";
}

/// Amplitude of each order around the gear of the flanks' places.
std::string spectrum_chart(const ResidualGrid& grid, int side, double scale) {
  const int z = static_cast<int>(grid.teeth.size()), most = z / 2;
  std::string svg = "<svg viewBox='0 0 900 110'>";
  for (int n = 1; n <= most; ++n) {
    double c = 0.0, s = 0.0, count = 0.0;
    for (int k = 0; k < z; ++k) {
      const double value = grid.teeth[k][side].index;
      if (std::isnan(value)) continue;
      c += value * std::cos(kTwoPi * n * k / z);
      s += value * std::sin(kTwoPi * n * k / z);
      count += 1.0;
    }
    if (count < 1.0) continue;
    const double bar = std::min(105.0, 100.0 * 2.0 * std::hypot(c, s) / count / scale);
    const double step = 900.0 / most;
    svg += "<rect class='b' x='" + number((n - 0.85) * step) + "' y='" + number(108.0 - bar) +
           "' width='" + number(0.7 * step) + "' height='" + number(bar) + "'><title>order " +
           std::to_string(n) + ": " + number(bar * scale / 100.0) + " um</title></rect>";
  }
  return svg + "</svg>";
}

template <class Chart>
void add_section(std::string& page, const char* title, const ResidualGrid& before,
                 const ResidualGrid& after, const FlankGeometry& g, const Chart& chart) {
  page += std::string("<h2>") + title + "</h2><div class='two'>";
  for (const ResidualGrid* grid : {&before, &after})
    for (const Flank flank : {Flank::kLeft, Flank::kRight}) {
      const int side = flank_side(flank, g.gear().kind) > 0 ? 1 : 0;
      page += std::string("<figure><figcaption>") + (grid == &before ? "before" : "after") + ", " +
              (flank == Flank::kLeft ? "left" : "right") + "</figcaption>" + chart(*grid, side) +
              "</figure>";
    }
  page += "</div>";
}

std::string iso_table(const GearLoop& closed) {
  const Iso1328 iso = iso_1328(closed);
  std::string html = "<h2>ISO 1328-1</h2><p>" + iso.note +
                     "</p><table><tr><th></th><th>um</th><th>class</th></tr>";
  for (const Iso1328Row& row : iso.rows) {
    if (std::isnan(row.value_um)) continue;
    const std::string name = row.accuracy_class == 0    ? "-"
                             : row.accuracy_class == 12 ? "over 11"
                                                        : std::to_string(row.accuracy_class);
    html += "<tr><td>" + row.symbol + "</td><td>" + number(row.value_um, "%.1f") + "</td><td>" +
            name + "</td></tr>";
  }
  return html + "</table>";
}

}  // namespace

std::string loop_html(const GearLoop& closed) {
  const ResidualGrid before = residual_grid(closed, false), after = residual_grid(closed, true);
  const double scale = scale_of(before);
  std::string page =
      "<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>Trueflank loop: " +
      escaped(closed.result.gear) +
      "</title><style>body{font:15px sans-serif;max-width:70em;margin:2em auto;padding:0 1em}"
      "svg{width:100%;background:#fafafa;border:1px solid #ddd}.z{stroke:#ccc;fill:none}"
      ".t{stroke:#06c;fill:none;stroke-width:.8}.b{fill:#06c}figure{margin:0}"
      ".two{display:grid;grid-template-columns:1fr 1fr;gap:.6em}pre{white-space:pre-wrap}"
      "td,th{padding:0 .8em;text-align:right}</style></head><body><h1>What the measured " +
      escaped(closed.result.gear) + " tells</h1><pre>" + escaped(loop_text(closed.result)) +
      "</pre><p>Charts: + is too much material; full scale " + number(scale, "%.3g") +
      " um before and after alike.</p>";
  const FlankGeometry& g = closed.geometry;
  add_section(page, "Profile of every tooth (root below, tip above)", before, after, g,
              [&](const auto& grid, int side) { return trace_chart(grid, side, true, scale); });
  add_section(page, "Helix of every tooth (bottom below)", before, after, g,
              [&](const auto& grid, int side) { return trace_chart(grid, side, false, scale); });
  add_section(page, "Place of every flank (index)", before, after, g,
              [&](const auto& grid, int side) { return pitch_chart(grid, side, scale); });
  add_section(page, "Topography, mean of all teeth (height to the right, tip above)", before, after, g,
              [&](const auto& grid, int side) { return topography_chart(grid, side, scale); });
  add_section(page, "Orders around the gear", before, after, g,
              [&](const auto& grid, int side) { return spectrum_chart(grid, side, scale); });
  return page + iso_table(closed) + "</body></html>\n";
}

}  // namespace trueflank::loop
