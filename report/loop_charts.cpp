// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/loop_charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trueflank/base/number_text.h"

namespace trueflank::loop {
namespace {

constexpr int kParts = FlankResiduals::kParts;
/// The drawing within its labels: width, height, room on the left and below [px].
constexpr double kWidth = 640, kHeight = 260, kLeft = 56, kBelow = 24, kAbove = 8;
constexpr double kTopography = 320;

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return "<text x='" + printed_number(x) + "' y='" + printed_number(y) + "' text-anchor='" + anchor + "'>" + text + "</text>";
}

/// What the page's script shows under the pointer: where the drawing is, what its rows and parts are called.
struct UnderPointer {
  const char* kind;   ///< columns: a row a tooth, its parts upwards; bars: a value a row; grid: rows upwards
  const char* row;    ///< "tooth", "order"
  const char* along;  ///< "root to tip", "bottom to top"; empty: values have no parts
  double width = kWidth, height = kHeight;
  std::vector<std::vector<double>> rows = {};
  std::vector<int> numbers = {};  ///< of the rows; empty: 1, 2, ...
};

std::string open_svg(double width, double height, const UnderPointer& under) {
  std::string rows;
  for (const auto& row : under.rows) {
    rows += rows.empty() ? "[" : ",[";
    for (std::size_t i = 0; i < row.size(); ++i)
      rows += (i == 0 ? "" : ",") + (std::isnan(row[i]) ? std::string("null") : printed_number(row[i], "%.3g"));
    rows += "]";
  }
  std::string numbers;
  for (const int number : under.numbers) numbers += (numbers.empty() ? "" : ",") + std::to_string(number);
  return "<svg viewBox='0 0 " + printed_number(width, "%g") + " " + printed_number(height, "%g") +
         "' data-chart='{\"kind\":\"" + under.kind + "\",\"row\":\"" + under.row + "\",\"along\":\"" + under.along +
         "\",\"x\":" + printed_number(kLeft, "%g") + ",\"y\":" + printed_number(kAbove, "%g") +
         ",\"w\":" + printed_number(under.width, "%g") + ",\"h\":" + printed_number(under.height, "%g") +
         ",\"unit\":\"µm\",\"numbers\":[" + numbers + "],\"rows\":[" + rows + "]}'>";
}

const std::array<double, kParts>& trace_of(const FlankResiduals& flank, bool profile) {
  return profile ? flank.profile : flank.helix;
}

/// Teeth of which anything was traced, from 1.
std::vector<int> traced_teeth(const ResidualGrid& grid, bool profile) {
  std::vector<int> teeth;
  for (std::size_t k = 0; k < grid.teeth.size(); ++k)
    if (std::any_of(grid.teeth[k].begin(), grid.teeth[k].end(), [&](const FlankResiduals& flank) {
          const auto& trace = trace_of(flank, profile);
          return !std::all_of(trace.begin(), trace.end(), [](double v) { return std::isnan(v); });
        }))
      teeth.push_back(static_cast<int>(k) + 1);
  return teeth;
}

/// A row a traced tooth.
UnderPointer traces_under_pointer(const ResidualGrid& grid, int side, bool profile) {
  UnderPointer under{"columns", "tooth", profile ? "root to tip" : "bottom to top"};
  under.numbers = traced_teeth(grid, profile);
  for (const int tooth : under.numbers) {
    const auto& trace = trace_of(grid.teeth[static_cast<std::size_t>(tooth - 1)][side], profile);
    under.rows.emplace_back(trace.begin(), trace.end());
  }
  return under;
}

UnderPointer bars_under_pointer(const std::vector<double>& values, const char* row) {
  UnderPointer under{"bars", row, ""};
  for (const double value : values) under.rows.push_back({value});
  return under;
}

/// Every how many teeth a number is written.
std::size_t label_step(std::size_t count) {
  for (const std::size_t step : {1, 2, 5, 10, 20, 50, 100})
    if (count <= 14 * step) return step;
  return count;
}

/// Numbers below columns: of all up to `count`, or of those given.
std::string numbers_below(const std::vector<int>& numbers) {
  std::string svg;
  const double step = kWidth / static_cast<double>(numbers.size());
  const std::size_t every = label_step(numbers.size());
  const bool all = numbers.back() == static_cast<int>(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (k == 0 || (all ? numbers[k] % static_cast<int>(every) == 0 : k % every == 0))
      svg += text_at(kLeft + (static_cast<double>(k) + 0.5) * step, kAbove + kHeight + 16, "middle",
                     std::to_string(numbers[k]));
  return svg;
}

std::vector<int> up_to(std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
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
  const std::vector<int> teeth = traced_teeth(grid, profile);
  const double step = kWidth / static_cast<double>(teeth.size());
  std::string svg = open_svg(kLeft + kWidth + 4, kAbove + kHeight + kBelow, traces_under_pointer(grid, side, profile));
  svg += text_at(kLeft - 6, kAbove + 10, "end", profile ? "tip" : "top") +
         text_at(kLeft - 6, kAbove + kHeight, "end", profile ? "root" : "bottom");
  for (std::size_t k = 0; k < teeth.size(); ++k) {
    const double middle = kLeft + (static_cast<double>(k) + 0.5) * step;
    svg += "<path class='zero' d='M" + printed_number(middle) + " " + printed_number(kAbove) + "v" + printed_number(kHeight, "%g") + "'/>";
    const auto& trace = trace_of(grid.teeth[static_cast<std::size_t>(teeth[k] - 1)][side], profile);
    std::string path;
    for (int i = 0; i < kParts; ++i) {
      if (std::isnan(trace[i])) continue;
      path += (path.empty() ? "M" : "L") +
              printed_number(middle + 0.45 * step * std::clamp(trace[i] / scale, -1.1, 1.1)) + " " +
              printed_number(kAbove + kHeight * (1.0 - (i + 0.5) / kParts));
    }
    if (!path.empty()) svg += "<path class='t' d='" + path + "'/>";
  }
  return svg + numbers_below(teeth) + "</svg>";
}

std::string index_bars(const ResidualGrid& grid, int side, double scale) {
  const double step = kWidth / static_cast<double>(grid.teeth.size()), zero = kAbove + 0.5 * kHeight;
  std::vector<double> values;
  for (const auto& tooth : grid.teeth) values.push_back(tooth[side].index);
  std::string svg =
      open_svg(kLeft + kWidth + 4, kAbove + kHeight + kBelow, bars_under_pointer(values, "tooth")) + value_axis(scale);
  for (std::size_t k = 0; k < grid.teeth.size(); ++k) {
    const double value = grid.teeth[k][side].index;
    if (std::isnan(value)) continue;
    svg += bar(kLeft + (static_cast<double>(k) + 0.15) * step, 0.7 * step, zero,
               zero - 0.5 * kHeight * std::clamp(value / scale, -1.0, 1.0),
               "tooth " + std::to_string(k + 1) + ": " + printed_number(value) + " um");
  }
  return svg + numbers_below(up_to(grid.teeth.size())) + "</svg>";
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
  std::string svg =
      open_svg(kLeft + kWidth + 4, kAbove + kHeight + kBelow, bars_under_pointer(amplitudes, "order"));
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
  return svg + numbers_below(up_to(amplitudes.size())) + "</svg>";
}

/// Red: too much material; blue: too little.
std::string colour(double share) {
  const double t = std::clamp(share, -1.0, 1.0);
  const auto mixed = [&](int full) { return std::to_string(static_cast<int>(245 + (full - 245) * std::abs(t))); };
  return t > 0.0 ? "rgb(" + mixed(179) + "," + mixed(38) + "," + mixed(30) + ")"
                 : "rgb(" + mixed(11) + "," + mixed(92) + "," + mixed(173) + ")";
}

/// The colours and what they mean.
std::string colour_key(double x, double scale) {
  std::string svg;
  for (int i = 0; i <= 10; ++i)
    svg += "<rect x='" + printed_number(x) + "' y='" + printed_number(kAbove + 14.0 * i) + "' width='14' height='14.3' fill='" +
           colour(1.0 - 0.2 * i) + "'/>";
  return svg + text_at(x + 18, kAbove + 12, "start", printed_number(scale, "+%g")) + text_at(x + 18, kAbove + 81, "start", "0") +
         text_at(x + 18, kAbove + 152, "start", printed_number(-scale, "%g"));
}

std::string topography(const ResidualGrid& grid, int side, double scale) {
  const double cell = kTopography / kParts;
  UnderPointer under{"grid", "", "", kTopography, kTopography};
  for (const auto& row : grid.topography[side]) under.rows.emplace_back(row.begin(), row.end());
  std::string svg = open_svg(kLeft + kTopography + 90, kAbove + kTopography + kBelow, under);
  for (int u = 0; u < kParts; ++u)
    for (int v = 0; v < kParts; ++v) {
      const double value = grid.topography[side][u][v];
      if (std::isnan(value)) continue;
      svg += "<rect x='" + printed_number(kLeft + cell * v) + "' y='" + printed_number(kAbove + cell * (kParts - 1 - u)) +
             "' width='" + printed_number(cell + 0.3) + "' height='" + printed_number(cell + 0.3) + "' fill='" +
             colour(value / scale) + "'/>";
    }
  svg += text_at(kLeft - 6, kAbove + 10, "end", "tip") + text_at(kLeft - 6, kAbove + kTopography, "end", "root") +
         text_at(kLeft, kAbove + kTopography + 16, "start", "bottom") +
         text_at(kLeft + kTopography, kAbove + kTopography + 16, "end", "top");
  return svg + colour_key(kLeft + kTopography + 18, scale) + "</svg>";
}

/// Every tooth's trace as a column of colours: cells of one colour are one path.
std::string trace_map(const ResidualGrid& grid, int side, bool profile, double scale) {
  constexpr int kSteps = 10;  // of colour, either way
  const std::vector<int> teeth = traced_teeth(grid, profile);
  const double w = kWidth / static_cast<double>(teeth.size()), h = kHeight / kParts;
  std::array<std::string, 2 * kSteps + 1> cells;
  for (std::size_t k = 0; k < teeth.size(); ++k) {
    const auto& trace = trace_of(grid.teeth[static_cast<std::size_t>(teeth[k] - 1)][side], profile);
    for (int i = 0; i < kParts; ++i) {
      if (std::isnan(trace[i])) continue;
      const int step = static_cast<int>(std::lround(kSteps * std::clamp(trace[i] / scale, -1.0, 1.0)));
      cells[static_cast<std::size_t>(step + kSteps)] +=
          "M" + printed_number(kLeft + static_cast<double>(k) * w, "%.1f") + " " +
          printed_number(kAbove + h * (kParts - 1 - i), "%.1f") + "h" + printed_number(w + 0.3, "%.1f") + "v" +
          printed_number(h + 0.3, "%.1f") + "h-" + printed_number(w + 0.3, "%.1f") + "z";
    }
  }
  std::string svg = open_svg(kLeft + kWidth + 70, kAbove + kHeight + kBelow, traces_under_pointer(grid, side, profile));
  svg += text_at(kLeft - 6, kAbove + 10, "end", profile ? "tip" : "top") +
         text_at(kLeft - 6, kAbove + kHeight, "end", profile ? "root" : "bottom");
  for (std::size_t step = 0; step < cells.size(); ++step)
    if (!cells[step].empty())
      svg += "<path d='" + cells[step] + "' fill='" + colour((static_cast<double>(step) - kSteps) / kSteps) + "'/>";
  return svg + numbers_below(teeth) + colour_key(kLeft + kWidth + 12, scale) + "</svg>";
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
      if (kind == ChartKind::kProfile || kind == ChartKind::kProfileMap)
        for (const double value : tooth[side].profile) add(value);
      if (kind == ChartKind::kHelix || kind == ChartKind::kHelixMap)
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
  const bool dense = kind != ChartKind::kIndex && kind != ChartKind::kOrders;
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
    case ChartKind::kProfileMap: return trace_map(grid, side, true, scale_um);
    case ChartKind::kHelixMap: return trace_map(grid, side, false, scale_um);
  }
  return {};
}

}  // namespace trueflank::loop
