// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/loop_charts.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"

namespace trueflank::loop {
namespace {

constexpr int kParts = FlankResiduals::kParts;
/// The drawing within its labels: width, height, room on the left and below [px].
constexpr double kWidth = 560, kHeight = 150, kLeft = 52, kBelow = 24, kAbove = 8;
constexpr double kTopography = 240;

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return "<text x='" + printed_number(x) + "' y='" + printed_number(y) + "' text-anchor='" + anchor + "'>" + text + "</text>";
}

std::string open_svg(double width, double height) {
  return "<svg viewBox='0 0 " + printed_number(width, "%g") + " " + printed_number(height, "%g") + "'>";
}

/// Every how many teeth a number is written.
std::size_t label_step(std::size_t count) {
  for (const std::size_t step : {1, 2, 5, 10, 20, 50, 100})
    if (count <= 14 * step) return step;
  return count;
}

std::string tooth_numbers(std::size_t count) {
  std::string svg;
  const double step = kWidth / static_cast<double>(count);
  const std::size_t every = label_step(count);
  for (std::size_t k = 0; k < count; ++k)
    if (k == 0 || (k + 1) % every == 0)
      svg += text_at(kLeft + (static_cast<double>(k) + 0.5) * step, kAbove + kHeight + 16, "middle",
                     std::to_string(k + 1));
  return svg;
}

/// Lines at the scale's ends, its halves and zero, with their values.
std::string value_axis(double scale) {
  std::string svg;
  for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    const double y = kAbove + 0.5 * kHeight * (1.0 - share);
    svg += "<path class='" + std::string(share == 0.0 ? "zero" : "grid") + "' d='M" + printed_number(kLeft) + " " +
           printed_number(y) + "h" + printed_number(kWidth, "%g") + "'/>" +
           text_at(kLeft - 6, y + 4, "end", printed_number(share * scale, "%g"));
  }
  return svg;
}

std::string bar(double x, double width, double from, double to, const std::string& title) {
  return "<rect class='b' x='" + printed_number(x) + "' y='" + printed_number(std::min(from, to)) + "' width='" + printed_number(width) +
         "' height='" + printed_number(std::abs(to - from)) + "'><title>" + title + "</title></rect>";
}

std::string traces(const ResidualGrid& grid, int side, bool profile, double scale) {
  const double step = kWidth / static_cast<double>(grid.teeth.size());
  std::string svg = open_svg(kLeft + kWidth + 4, kAbove + kHeight + kBelow);
  svg += text_at(kLeft - 6, kAbove + 10, "end", profile ? "tip" : "top") +
         text_at(kLeft - 6, kAbove + kHeight, "end", profile ? "root" : "bottom");
  for (std::size_t k = 0; k < grid.teeth.size(); ++k) {
    const double middle = kLeft + (static_cast<double>(k) + 0.5) * step;
    svg += "<path class='zero' d='M" + printed_number(middle) + " " + printed_number(kAbove) + "v" + printed_number(kHeight, "%g") + "'/>";
    const auto& trace = profile ? grid.teeth[k][side].profile : grid.teeth[k][side].helix;
    std::string path;
    for (int i = 0; i < kParts; ++i) {
      if (std::isnan(trace[i])) continue;
      path += (path.empty() ? "M" : "L") +
              printed_number(middle + 0.45 * step * std::clamp(trace[i] / scale, -1.1, 1.1)) + " " +
              printed_number(kAbove + kHeight * (1.0 - (i + 0.5) / kParts));
    }
    if (!path.empty()) svg += "<path class='t' d='" + path + "'/>";
  }
  return svg + tooth_numbers(grid.teeth.size()) + "</svg>";
}

std::string index_bars(const ResidualGrid& grid, int side, double scale) {
  const double step = kWidth / static_cast<double>(grid.teeth.size()), zero = kAbove + 0.5 * kHeight;
  std::string svg = open_svg(kLeft + kWidth + 4, kAbove + kHeight + kBelow) + value_axis(scale);
  for (std::size_t k = 0; k < grid.teeth.size(); ++k) {
    const double value = grid.teeth[k][side].index;
    if (std::isnan(value)) continue;
    svg += bar(kLeft + (static_cast<double>(k) + 0.15) * step, 0.7 * step, zero,
               zero - 0.5 * kHeight * std::clamp(value / scale, -1.0, 1.0),
               "tooth " + std::to_string(k + 1) + ": " + printed_number(value) + " um");
  }
  return svg + tooth_numbers(grid.teeth.size()) + "</svg>";
}

/// Amplitude of each order around the gear of the flanks' places; index 0 is order 1.
std::vector<double> order_amplitudes(const ResidualGrid& grid, int side) {
  const int z = static_cast<int>(grid.teeth.size());
  std::vector<double> amplitudes;
  for (int n = 1; n <= z / 2; ++n) {
    double c = 0.0, s = 0.0, count = 0.0;
    for (int k = 0; k < z; ++k) {
      const double value = grid.teeth[static_cast<std::size_t>(k)][side].index;
      if (std::isnan(value)) continue;
      c += value * std::cos(kTwoPi * n * k / z);
      s += value * std::sin(kTwoPi * n * k / z);
      count += 1.0;
    }
    amplitudes.push_back(count > 0.0 ? 2.0 * std::hypot(c, s) / count : kNaN);
  }
  return amplitudes;
}

std::string order_bars(const ResidualGrid& grid, int side, double scale) {
  const std::vector<double> amplitudes = order_amplitudes(grid, side);
  const double step = kWidth / static_cast<double>(amplitudes.size()), floor = kAbove + kHeight;
  std::string svg = open_svg(kLeft + kWidth + 4, kAbove + kHeight + kBelow);
  for (const double share : {0.0, 0.5, 1.0}) {
    const double y = floor - kHeight * share;
    svg += "<path class='" + std::string(share == 0.0 ? "zero" : "grid") + "' d='M" + printed_number(kLeft) + " " +
           printed_number(y) + "h" + printed_number(kWidth, "%g") + "'/>" +
           text_at(kLeft - 6, y + 4, "end", printed_number(share * scale, "%g"));
  }
  for (std::size_t i = 0; i < amplitudes.size(); ++i)
    if (!std::isnan(amplitudes[i]))
      svg += bar(kLeft + (static_cast<double>(i) + 0.15) * step, 0.7 * step, floor,
                 floor - kHeight * std::min(1.0, amplitudes[i] / scale),
                 "order " + std::to_string(i + 1) + ": " + printed_number(amplitudes[i]) + " um");
  return svg + tooth_numbers(amplitudes.size()) + "</svg>";
}

/// Red: too much material; blue: too little.
std::string colour(double share) {
  const double t = std::clamp(share, -1.0, 1.0);
  const auto mixed = [&](int full) { return std::to_string(static_cast<int>(245 + (full - 245) * std::abs(t))); };
  return t > 0.0 ? "rgb(" + mixed(179) + "," + mixed(38) + "," + mixed(30) + ")"
                 : "rgb(" + mixed(11) + "," + mixed(92) + "," + mixed(173) + ")";
}

std::string topography(const ResidualGrid& grid, int side, double scale) {
  const double cell = kTopography / kParts;
  std::string svg = open_svg(kLeft + kTopography + 90, kAbove + kTopography + kBelow);
  for (int u = 0; u < kParts; ++u)
    for (int v = 0; v < kParts; ++v) {
      const double value = grid.topography[side][u][v];
      if (std::isnan(value)) continue;
      svg += "<rect x='" + printed_number(kLeft + cell * v) + "' y='" + printed_number(kAbove + cell * (kParts - 1 - u)) +
             "' width='" + printed_number(cell + 0.3) + "' height='" + printed_number(cell + 0.3) + "' fill='" +
             colour(value / scale) + "'><title>" + printed_number(value) + " um</title></rect>";
    }
  svg += text_at(kLeft - 6, kAbove + 10, "end", "tip") + text_at(kLeft - 6, kAbove + kTopography, "end", "root") +
         text_at(kLeft, kAbove + kTopography + 16, "start", "bottom") +
         text_at(kLeft + kTopography, kAbove + kTopography + 16, "end", "top");
  const double x = kLeft + kTopography + 18;
  for (int i = 0; i <= 10; ++i)
    svg += "<rect x='" + printed_number(x) + "' y='" + printed_number(kAbove + 14.0 * i) + "' width='14' height='14.3' fill='" +
           colour(1.0 - 0.2 * i) + "'/>";
  svg += text_at(x + 20, kAbove + 12, "start", printed_number(scale, "+%g")) + text_at(x + 20, kAbove + 81, "start", "0") +
         text_at(x + 20, kAbove + 152, "start", printed_number(-scale, "%g"));
  return svg + "</svg>";
}

/// All numbers a kind of chart would draw.
std::vector<double> values_of(ChartKind kind, const ResidualGrid& grid) {
  std::vector<double> values;
  const auto add = [&](double value) {
    if (!std::isnan(value)) values.push_back(std::abs(value));
  };
  for (int side : {0, 1}) {
    if (kind == ChartKind::kTopography)
      for (const auto& row : grid.topography[side])
        for (const double value : row) add(value);
    if (kind == ChartKind::kOrders)
      for (const double value : order_amplitudes(grid, side)) add(value);
    for (const auto& tooth : grid.teeth) {
      if (kind == ChartKind::kIndex) add(tooth[side].index);
      if (kind == ChartKind::kProfile)
        for (const double value : tooth[side].profile) add(value);
      if (kind == ChartKind::kHelix)
        for (const double value : tooth[side].helix) add(value);
    }
  }
  return values;
}

}  // namespace

double chart_scale_um(ChartKind kind, const ResidualGrid& before) {
  std::vector<double> values = values_of(kind, before);
  if (values.empty()) return kNaN;
  std::sort(values.begin(), values.end());
  // bars must all fit; of many traces one wild point may stick out
  const bool dense = kind == ChartKind::kProfile || kind == ChartKind::kHelix || kind == ChartKind::kTopography;
  const auto last = static_cast<double>(values.size() - 1);
  const double size = std::max(values[static_cast<std::size_t>((dense ? 0.98 : 1.0) * last)], 1e-3);
  const double power = std::pow(10.0, std::floor(std::log10(size)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.5})
    if (size <= step * power * (1.0 + 1e-9)) return step * power;
  return 10.0 * power;
}

std::string chart_svg(ChartKind kind, const ResidualGrid& grid, int side, double scale_um) {
  switch (kind) {
    case ChartKind::kProfile: return traces(grid, side, true, scale_um);
    case ChartKind::kHelix: return traces(grid, side, false, scale_um);
    case ChartKind::kIndex: return index_bars(grid, side, scale_um);
    case ChartKind::kTopography: return topography(grid, side, scale_um);
    case ChartKind::kOrders: return order_bars(grid, side, scale_um);
  }
  return {};
}

}  // namespace trueflank::loop
