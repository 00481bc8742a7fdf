// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drive_html.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/report/drive_points.h"
#include "trueflank/report/loop_page.h"

namespace trueflank::loop {
namespace {

std::string escaped_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') result += "&lt;";
    else if (c == '>') result += "&gt;";
    else if (c == '&') result += "&amp;";
    else result += c;
  }
  return result;
}

/// Mean efficiencies of the cells of one direction, in per cent.
struct Map {
  bool by_driven;  ///< load is the torque on the driven side: the bench held that one
  CellAxis speed, load;
  enum Kind { kMeasured, kBefore, kAfter, kResidual };
  std::array<std::vector<double>, 4> value;
  double low = 1e300, high = -1e300, most_residual = 1e-9;

  Map(const DriveLoop& closed, bool forward)
      : by_driven(CellAxis(values_of(closed, forward, &BenchPoint::driven_nm)).count() <
                  CellAxis(values_of(closed, forward, &BenchPoint::driving_nm)).count()),
        speed(values_of(closed, forward, &BenchPoint::speed_rpm)),
        load(values_of(closed, forward, load_member())) {
    const std::size_t cells = static_cast<std::size_t>(speed.count() * load.count());
    std::vector<double> lossless(cells, 0.0);
    for (auto& v : value) v.assign(cells, 0.0);
    for (std::size_t i = 0; i < closed.table.points.size(); ++i) {
      const BenchPoint& p = closed.table.points[i];
      if (p.forward != forward) continue;
      const auto c = static_cast<std::size_t>(speed.cell(p.speed_rpm) + speed.count() * load.cell(p.*load_member()));
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

  [[nodiscard]] double BenchPoint::*load_member() const {
    return by_driven ? &BenchPoint::driven_nm : &BenchPoint::driving_nm;
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
             "' style='text-anchor:middle;fill:" + ink(map, kind, value) + "'>" + printed_number(value, "%.1f") + "</text>";
    }
  const auto label = [&](double x, double y, const char* anchor, const std::string& text) {
    svg += "<text x='" + printed_number(x) + "' y='" + printed_number(y) + "' style='text-anchor:" + anchor +
           "'>" + text + "</text>";
  };
  for (int v = 0; v < map.speed.count(); ++v)
    if (w >= 34.0 || v == 0 || v + 1 == map.speed.count())
      label(kLeft + (v + 0.5) * w, 217, "middle", printed_number(map.speed.centres[v], "%.4g"));
  label(kLeft + 0.5 * kWidth, 234, "middle", "input speed, rpm");
  for (int t = 0; t < map.load.count(); ++t)
    if (h >= 11.0 || t == 0 || t + 1 == map.load.count())
      label(kLeft - 3, kTop + kHeight - (t + 0.5) * h + 3.0, "end", printed_number(map.load.centres[t], "%.3g"));
  svg += "<text transform='translate(12 106) rotate(-90)' style='text-anchor:middle'>" + std::string(torque_side) +
         " torque, N m</text>";
  return svg + "</svg></figure>";
}

std::string maps_of(const DriveLoop& closed, bool forward) {
  if (!closed.table.has(forward)) return {};
  const Map map(closed, forward);
  const char* side = forward != map.by_driven ? "input" : "output";
  std::string html = std::string("<h2>Efficiency, ") +
                     (forward ? "forward (the input drives)" : "backward (the output drives)") +
                     "</h2><p>Measured and models from " + printed_number(map.low, "%.1f") + " % (dark) to " +
                     printed_number(map.high, "%.1f") + " % (bright); residual to ±" +
                     printed_number(map.most_residual, "%.2g") +
                     " points (red: more than the model). White: no load, or not measured.</p><div class='four'>";
  html += chart(map, Map::kMeasured, "measured", side);
  html += chart(map, Map::kBefore, "model before", side);
  html += chart(map, Map::kAfter, "model after", side);
  html += chart(map, Map::kResidual, "residual after", side);
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
    html += "<tr><td>" + escaped_text(p.id) + "</td><td>" + escaped_text(p.text) + "</td><td>" +
            (met.empty() ? "-" : escaped_text(met)) + "</td><td>" + printed_number(p.left_points) + "</td><td>" +
            printed_number(p.left_nm, "%.4f") + "</td></tr>";
  }
  return html + "</table></div>";
}

}  // namespace

std::string drive_html(const DriveLoop& closed) {
  std::string page = loop_page_opening(closed.result, "What the bench tells of the drive", residual_trends(closed));
  page += possible_table(closed.result);
  if (!closed.table.points.empty())
    page += torque_charts(closed) + residual_charts(closed) + maps_of(closed, true) + maps_of(closed, false);
  return page + loop_page_end(closed.result);
}

}  // namespace trueflank::loop
