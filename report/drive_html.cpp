// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drive_html.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "trueflank/base/number_text.h"
#include "trueflank/report/loop_page.h"

namespace trueflank::loop {
namespace {

constexpr int kMostCells = 14;

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

/// Cells of one axis: the distinct set points where these are few, equal parts of the range else.
struct Axis {
  std::vector<double> centres;
  explicit Axis(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const double span = values.back() - values.front();
    for (std::size_t i = 0; i < values.size();) {
      std::size_t k = i;
      double sum = 0.0;
      while (k < values.size() && values[k] - values[i] <= 0.025 * span) sum += values[k++];
      centres.push_back(sum / static_cast<double>(k - i));
      i = k;
    }
    if (static_cast<int>(centres.size()) <= kMostCells) return;
    const double low = values.front();
    centres.clear();
    for (int i = 0; i < kMostCells; ++i) centres.push_back(low + span * (i + 0.5) / kMostCells);
  }
  [[nodiscard]] int cell(double value) const {
    const auto nearest = std::min_element(centres.begin(), centres.end(), [&](double a, double b) {
      return std::abs(a - value) < std::abs(b - value);
    });
    return static_cast<int>(nearest - centres.begin());
  }
  [[nodiscard]] int count() const { return static_cast<int>(centres.size()); }
};

/// Mean efficiencies of the cells of one direction, in per cent.
struct Map {
  Axis speed, load;
  enum Kind { kMeasured, kBefore, kAfter, kResidual };
  std::array<std::vector<double>, 4> value;
  double low = 1e300, high = -1e300, most_residual = 1e-9;

  Map(const DriveLoop& closed, bool forward)
      : speed(values_of(closed, forward, &BenchPoint::speed_rpm)),
        load(values_of(closed, forward, &BenchPoint::driving_nm)) {
    const std::size_t cells = static_cast<std::size_t>(speed.count() * load.count());
    std::vector<double> lossless(cells, 0.0);
    for (auto& v : value) v.assign(cells, 0.0);
    for (std::size_t i = 0; i < closed.table.points.size(); ++i) {
      const BenchPoint& p = closed.table.points[i];
      if (p.forward != forward) continue;
      const auto c = static_cast<std::size_t>(speed.cell(p.speed_rpm) + speed.count() * load.cell(p.driving_nm));
      lossless[c] += p.load_nm * (forward ? closed.model.ratio : 1.0);
      value[kMeasured][c] += p.driven_nm;
      value[kBefore][c] += p.driven_nm - closed.before_nm[i];
      value[kAfter][c] += p.driven_nm - closed.after_nm[i];
      value[kResidual][c] += closed.after_nm[i];
    }
    double most = 0.0;
    for (const double l : lossless) most = std::max(most, l);
    for (int k = 0; k < 4; ++k)
      for (std::size_t c = 0; c < cells; ++c) {
        // Without load there is no efficiency.
        double& v = value[k][c];
        v = lossless[c] > 1e-3 * most ? 100.0 * v / lossless[c] : kNaN;
        if (std::isnan(v)) continue;
        if (k == kResidual) most_residual = std::max(most_residual, std::abs(v));
        else if (k == kMeasured) {
          low = std::min(low, v);
          high = std::max(high, v);
        }
      }
    low = std::clamp(low, 0.0, 99.0);
    high = std::max(std::clamp(high, 1.0, 120.0), low + 1.0);
  }

  static std::vector<double> values_of(const DriveLoop& closed, bool forward,
                                       double BenchPoint::*member) {
    std::vector<double> values;
    for (const BenchPoint& p : closed.table.points)
      if (p.forward == forward) values.push_back(p.*member);
    return values;
  }
};

/// Dark blue (low) over green to yellow (high); the residual red above, blue below zero.
std::string colour(const Map& map, Map::Kind kind, double value) {
  if (kind == Map::kResidual) {
    const double t = std::clamp(value / map.most_residual, -1.0, 1.0);
    const std::string other = std::to_string(static_cast<int>(255.0 * (1.0 - std::abs(t))));
    return t > 0.0 ? "rgb(255," + other + "," + other + ")" : "rgb(" + other + "," + other + ",255)";
  }
  const double t = std::clamp((value - map.low) / (map.high - map.low), 0.0, 1.0);
  const auto mix = [&](double a, double b, double c) {
    return std::to_string(static_cast<int>(t < 0.5 ? a + (b - a) * 2.0 * t : b + (c - b) * (2.0 * t - 1.0)));
  };
  return "rgb(" + mix(60, 40, 250) + "," + mix(20, 150, 225) + "," + mix(110, 140, 60) + ")";
}

/// A number's colour that can be read on the cell's.
const char* ink(const Map& map, Map::Kind kind, double value) {
  if (kind == Map::kResidual)
    return std::abs(value) > 0.6 * map.most_residual ? "#fff" : "#111";
  return value < map.low + 0.4 * (map.high - map.low) ? "#fff" : "#111";
}

std::string chart(const Map& map, Map::Kind kind, const char* caption, const char* torque_side) {
  constexpr double kLeft = 52.0, kTop = 6.0, kWidth = 240.0, kHeight = 200.0;
  const double w = kWidth / map.speed.count(), h = kHeight / map.load.count();
  std::string svg = std::string("<figure><figcaption>") + caption +
                    "</figcaption><svg viewBox='0 0 300 246'>";
  for (int v = 0; v < map.speed.count(); ++v)
    for (int t = 0; t < map.load.count(); ++t) {
      const double value = map.value[kind][static_cast<std::size_t>(v + map.speed.count() * t)];
      if (std::isnan(value)) continue;
      const double x = kLeft + v * w, y = kTop + kHeight - (t + 1) * h;
      svg += "<rect x='" + printed_number(x) + "' y='" + printed_number(y) + "' width='" + printed_number(w + 0.2) +
             "' height='" + printed_number(h + 0.2) + "' fill='" + colour(map, kind, value) + "'><title>" +
             printed_number(map.speed.centres[v], "%.4g") + " rpm, " + printed_number(map.load.centres[t], "%.4g") +
             " N m: " + printed_number(value) + " %</title></rect>";
      if (w < 26.0 || h < 11.0) continue;
      svg += "<text x='" + printed_number(x + 0.5 * w) + "' y='" + printed_number(y + 0.5 * h + 3.0) +
             "' style='fill:" + ink(map, kind, value) + "'>" + printed_number(value, "%.1f") + "</text>";
    }
  const auto label = [&](double x, double y, const char* anchor, const std::string& text) {
    svg += "<text x='" + printed_number(x) + "' y='" + printed_number(y) + "' style='text-anchor:" + anchor +
           "'>" + text + "</text>";
  };
  label(kLeft, 216, "start", printed_number(map.speed.centres.front(), "%.4g"));
  label(kLeft + kWidth, 216, "end", printed_number(map.speed.centres.back(), "%.4g"));
  label(kLeft + 0.5 * kWidth, 230, "middle", "input speed, rpm");
  label(kLeft - 3, kTop + kHeight - 2, "end", printed_number(map.load.centres.front(), "%.3g"));
  label(kLeft - 3, kTop + 9, "end", printed_number(map.load.centres.back(), "%.3g"));
  svg += "<text transform='translate(12 106) rotate(-90)'>" + std::string(torque_side) +
         " torque, N m</text>";
  return svg + "</svg></figure>";
}

std::string maps_of(const DriveLoop& closed, bool forward) {
  if (!closed.table.has(forward)) return {};
  const Map map(closed, forward);
  const char* side = forward ? "input" : "output";
  std::string html = std::string("<h2>Efficiency, ") +
                     (forward ? "forward (the input drives)" : "backward (the output drives)") +
                     "</h2><p>Measured and models from " + printed_number(map.low, "%.1f") + " % (dark) to " +
                     printed_number(map.high, "%.1f") + " % (bright); residual to +-" +
                     printed_number(map.most_residual, "%.2g") +
                     " points (red: more than the model). White: no load, or not measured.</p><div class='four'>";
  html += chart(map, Map::kMeasured, "measured", side);
  html += chart(map, Map::kBefore, "model before", side);
  html += chart(map, Map::kAfter, "model after", side);
  html += chart(map, Map::kResidual, "residual after", side);
  return html + "</div>";
}

/// Points of one chart: places on the paper, and words for the pointer.
struct Dots {
  std::string circles, under_pointer;
  void add(const char* kind, double x, double y, const std::string& words) {
    const std::string at_x = printed_number(x, "%.1f"), at_y = printed_number(y, "%.1f");
    circles += std::string("<circle class='") + kind + "' cx='" + at_x + "' cy='" + at_y + "' r='2.2'/>";
    if (words.empty()) return;
    under_pointer += (under_pointer.empty() ? "[" : ",[") + at_x + "," + at_y + ",\"" + words + "\"]";
  }
};

constexpr double kLeft = 66, kTop = 8, kWide = 600, kHigh = 260;

std::string svg_of(const Dots& dots, const std::string& axes) {
  return "<svg viewBox='0 0 " + printed_number(kLeft + kWide + 14, "%g") + " " + printed_number(kTop + kHigh + 40, "%g") +
         "' data-chart='{\"kind\":\"points\",\"rows\":[" + dots.under_pointer + "]}'>" + axes + dots.circles + "</svg>";
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return "<text x='" + printed_number(x) + "' y='" + printed_number(y) + "' text-anchor='" + anchor + "'>" + text + "</text>";
}

/// Four lines each way with their values.
std::string axes(double x_low, double x_high, double y_low, double y_high, const std::string& x_name) {
  std::string svg;
  for (int i = 0; i <= 4; ++i) {
    const double share = 0.25 * i, x = kLeft + kWide * share, y = kTop + kHigh * (1.0 - share);
    const double value = y_low + (y_high - y_low) * share;
    svg += "<path class='" + std::string(std::abs(value) < 1e-9 * (y_high - y_low) ? "zero" : "grid") + "' d='M" +
           printed_number(kLeft) + " " + printed_number(y) + "h" + printed_number(kWide, "%g") + "'/>" +
           text_at(kLeft - 6, y + 4, "end", printed_number(value, "%.3g")) +
           text_at(x, kTop + kHigh + 16, i == 0 ? "start" : i == 4 ? "end" : "middle",
                   printed_number(x_low + (x_high - x_low) * share, "%.4g"));
  }
  return svg + text_at(kLeft + 0.5 * kWide, kTop + kHigh + 34, "middle", x_name);
}

/// Points a chart can carry: of long logs every n-th.
std::size_t stride_of(const DriveLoop& closed) {
  constexpr std::size_t kMostPoints = 3000;
  return closed.table.points.size() / kMostPoints + 1;
}

std::string set_point(const BenchPoint& p) {
  return std::string(p.forward ? "forward " : "backward ") + printed_number(p.speed_rpm, "%.4g") + " rpm, " +
         printed_number(p.driving_nm, "%.4g") + " N m driving: ";
}

/// Residual before (grey) and after (blue) over one quantity, as torque lost at the input.
std::string residual_chart(const DriveLoop& closed, const char* caption,
                           const std::function<double(const BenchPoint&)>& abscissa) {
  double low = 1e300, high = -1e300, size = 1e-300;
  const auto at_input = [&](std::size_t i, const std::vector<double>& residual) {
    const BenchPoint& p = closed.table.points[i];
    return residual[i] / (p.forward ? closed.model.ratio : 1.0);
  };
  for (std::size_t i = 0; i < closed.table.points.size(); ++i) {
    low = std::min(low, abscissa(closed.table.points[i]));
    high = std::max(high, abscissa(closed.table.points[i]));
    size = std::max(size, std::abs(at_input(i, closed.before_nm)));
  }
  if (!(high > low)) return {};
  Dots dots;
  for (const bool after : {false, true})
    for (std::size_t i = 0; i < closed.table.points.size(); i += stride_of(closed)) {
      const BenchPoint& p = closed.table.points[i];
      const double value = at_input(i, after ? closed.after_nm : closed.before_nm);
      dots.add(after ? "a" : "f", kLeft + kWide * (abscissa(p) - low) / (high - low),
               kTop + 0.5 * kHigh * (1.0 - std::clamp(value / size, -1.0, 1.0)),
               after ? set_point(p) + "left " + printed_number(value, "%.3g") + " N m, before " +
                           printed_number(at_input(i, closed.before_nm), "%.3g")
                     : "");
    }
  return std::string("<figure><figcaption>residual [N m at the input] over the <b>") + caption + "</b></figcaption>" +
         svg_of(dots, axes(low, high, -size, size, caption)) + "</figure>";
}

/// Predicted over measured torque of the driven side: on the line the model is right.
std::string torque_chart(const DriveLoop& closed, bool forward, bool after) {
  const std::vector<double>& residual = after ? closed.after_nm : closed.before_nm;
  double high = 1e-300;
  for (const BenchPoint& p : closed.table.points)
    if (p.forward == forward) high = std::max(high, p.driven_nm);
  Dots dots;
  for (std::size_t i = 0; i < closed.table.points.size(); i += stride_of(closed)) {
    const BenchPoint& p = closed.table.points[i];
    if (p.forward != forward) continue;
    const double predicted = p.driven_nm - residual[i];
    dots.add(after ? "a" : "f", kLeft + kWide * std::clamp(p.driven_nm / high, 0.0, 1.0),
             kTop + kHigh * (1.0 - std::clamp(predicted / high, 0.0, 1.0)),
             set_point(p) + "measured " + printed_number(p.driven_nm, "%.4g") + ", model " + printed_number(predicted, "%.4g"));
  }
  std::string line = axes(0.0, high, 0.0, high, "measured, N m");
  line += "<path class='zero' d='M" + printed_number(kLeft) + " " + printed_number(kTop + kHigh) + "L" +
          printed_number(kLeft + kWide) + " " + printed_number(kTop) + "'/>";
  return std::string("<figure><figcaption><b>") + (after ? "after" : "before") + "</b>, " +
         (forward ? "forward: output" : "backward: input") + " torque of the model [N m] over the measured one</figcaption>" +
         svg_of(dots, line) + "</figure>";
}

std::string torques(const DriveLoop& closed) {
  std::string html = "<h2>Torque, measured and predicted</h2><p class='note'>On the line the model is right.</p><div class='two'>";
  for (const bool forward : {true, false})
    for (const bool after : {false, true})
      if (closed.table.has(forward)) html += torque_chart(closed, forward, after);
  return html + "</div>";
}

std::string possible_table(const LoopResult& result) {
  if (result.possible.empty()) return {};
  std::string html =
      "<h2>What could explain the numbers</h2><div class='scroll'><table class='words'><tr><th>effect</th><th>what it would have to be</th>"
      "<th>explains</th><th>left, points</th><th>left, N m</th></tr>";
  for (const PossibleExplanation& p : result.possible) {
    std::string met;
    for (const std::string& name : p.explains) met += (met.empty() ? "" : ", ") + name;
    html += "<tr><td>" + escaped(p.id) + "</td><td>" + escaped(p.text) + "</td><td>" +
            (met.empty() ? "-" : escaped(met)) + "</td><td>" + printed_number(p.left_points) + "</td><td>" +
            printed_number(p.left_nm, "%.4f") + "</td></tr>";
  }
  return html + "</table></div>";
}

}  // namespace

std::string drive_html(const DriveLoop& closed) {
  std::string page = loop_page_opening(closed.result, "What the bench tells of the drive");
  page += possible_table(closed.result);
  if (!closed.table.points.empty()) {
    page += torques(closed);
    page += "<h2>Residual before (grey) and after (blue)</h2><div class='two'>";
    page += residual_chart(closed, "load (as torque at the input, N m)",
                           [](const BenchPoint& p) { return p.load_nm; });
    page += residual_chart(closed, "input speed, rpm", [](const BenchPoint& p) { return p.speed_rpm; });
    if (closed.table.has_temperature)
      page += residual_chart(closed, "temperature, C", [](const BenchPoint& p) { return p.temperature_c; });
    if (closed.table.has_angle)
      page += residual_chart(closed, "input angle, turns",
                             [](const BenchPoint& p) { return p.angle_rad / kTwoPi; });
    page += "</div>" + maps_of(closed, true) + maps_of(closed, false);
  }
  return page + loop_page_end(closed.result);
}

}  // namespace trueflank::loop
