// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/shift_map_files.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/export/number_text.h"
#include "trueflank/export/xml_text.h"
#include "trueflank/session/fixed_text.h"

namespace trueflank {
namespace {

constexpr double kMapWidth = 520, kMapHeight = 420, kMapLeft = 70, kMapTop = 20, kMapRight = 250, kMapBottom = 55;
constexpr int kColours = 24;
constexpr const char* kBorders[] = {"#d62728", "#1f77b4", "#2ca02c", "#ff7f0e",
                                    "#9467bd", "#8c564b", "#e377c2", "#17becf"};

std::string decimal_or_nothing(double value) {
  std::string text;
  if (value == value) io::append_decimal(text, value);
  return text;
}

/// "shift of ring1".
std::string title_of(const ToothSet& set, MapAxis axis) {
  if (axis == MapAxis::kCentreDistance) return "centre distance";
  const SearchLayer& layer = set.train->layers[axis == MapAxis::kLayer1Shift ? 0 : 1];
  const int gear = layer.ring >= 0 ? layer.ring : layer.planet;
  return "shift of " + set.train->topology.gears[static_cast<std::size_t>(gear)].name;
}

std::string limit_text(const ToothSet& set, std::size_t limit) {
  const LimitEntry& entry = set.train->limits[limit];
  return std::string(to_text(entry.limit)) + ": " + entry.where +
         (entry.which.empty() ? "" : " (" + entry.which + ")");
}

/// From dark blue (least) over green to yellow.
std::string colour_of(int level) {
  const double u = static_cast<double>(level) / (kColours - 1);
  const auto part = [&](double low, double middle, double high) {
    const double value = u < 0.5 ? low + 2.0 * u * (middle - low) : middle + (2.0 * u - 1.0) * (high - middle);
    return std::to_string(std::lround(value));
  };
  return "rgb(" + part(68, 33, 253) + "," + part(20, 145, 231) + "," + part(100, 140, 60) + ")";
}

/// One colour for a limit in all pictures, as they appear.
using BorderColours = std::map<std::size_t, std::string>;

class Picture {
 public:
  Picture(const ToothSet& set, const ShiftMap& map, const FreeShifts& best, BorderColours& colours)
      : set_(set), map_(map), best_(best), colours_(colours) {}

  std::string text() {
    text_ = "<svg viewBox=\"0 0 " + fixed_text(kMapLeft + kMapWidth + kMapRight, 0) + " " +
            fixed_text(kMapTop + kMapHeight + kMapBottom, 0) + "\" font-size=\"12\">\n<rect x=\"" +
            fixed_text(kMapLeft, 0) + "\" y=\"" + fixed_text(kMapTop, 0) + "\" width=\"" +
            fixed_text(kMapWidth, 0) + "\" height=\"" + fixed_text(kMapHeight, 0) +
            "\" fill=\"#e4e6ea\"/>\n";
    cells();
    borders();
    axes();
    cross();
    return text_ + "</svg>\n";
  }

 private:
  static double place(const std::vector<double>& line, double value) {
    return (value - line.front()) / (line.back() - line.front());
  }
  [[nodiscard]] double x(double value) const { return kMapLeft + kMapWidth * place(map_.x, value); }
  [[nodiscard]] double y(double value) const {
    return kMapTop + kMapHeight * (1.0 - place(map_.y, value));
  }
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return j * map_.x.size() + i; }

  /// Each point's surroundings in the colour of its efficiency, where every limit is kept.
  void cells() {
    double low = 1.0, high = 0.0;
    for (std::size_t k = 0; k < map_.efficiency.size(); ++k)
      if (map_.feasible(k) && map_.efficiency[k] == map_.efficiency[k])
        low = std::min(low, map_.efficiency[k]), high = std::max(high, map_.efficiency[k]);
    const double w = kMapWidth / static_cast<double>(map_.x.size() - 1),
                 h = kMapHeight / static_cast<double>(map_.y.size() - 1);
    std::map<int, std::string> paths;
    for (std::size_t j = 0; j < map_.y.size(); ++j)
      for (std::size_t i = 0; i < map_.x.size(); ++i) {
        const double efficiency = map_.efficiency[at(i, j)];
        if (!map_.feasible(at(i, j)) || efficiency != efficiency) continue;
        const int level = high > low ? static_cast<int>((efficiency - low) / (high - low) * (kColours - 1) + 0.5) : 0;
        const double left = std::max(kMapLeft, x(map_.x[i]) - 0.5 * w),
                     right = std::min(kMapLeft + kMapWidth, x(map_.x[i]) + 0.5 * w),
                     top = std::max(kMapTop, y(map_.y[j]) - 0.5 * h),
                     bottom = std::min(kMapTop + kMapHeight, y(map_.y[j]) + 0.5 * h);
        paths[level] += "M" + fixed_text(left, 1) + " " + fixed_text(top, 1) + "H" +
                        fixed_text(right, 1) + "V" + fixed_text(bottom, 1) + "H" +
                        fixed_text(left, 1) + "z";
      }
    for (const auto& [level, path] : paths)
      text_ += "<path shape-rendering=\"crispEdges\" fill=\"" + colour_of(level) + "\" d=\"" + path + "\"/>\n";
    if (high < low) return note(0, "#5a6675", "no place keeps every limit");
    note(0, colour_of(kColours - 1), fixed_text(100.0 * high, 2) + " %");
    note(1, colour_of(0), fixed_text(100.0 * low, 2) + " %");
  }

  void note(int row, const std::string& colour, const std::string& words) {
    const double top = kMapTop + 16.0 * row;
    text_ += "<rect x=\"" + fixed_text(kMapLeft + kMapWidth + 10, 0) + "\" y=\"" + fixed_text(top, 0) +
             "\" width=\"12\" height=\"12\" fill=\"" + colour + "\"/><text x=\"" +
             fixed_text(kMapLeft + kMapWidth + 28, 0) + "\" y=\"" + fixed_text(top + 10, 0) + "\">" +
             io::xml_escaped(words) + "</text>\n";
  }

  /// Where a margin is 0, beside a place that keeps every limit.
  void borders() {
    int row = 3;
    for (std::size_t l = 0; l < map_.margins.size(); ++l) {
      std::string path;
      for (std::size_t j = 0; j + 1 < map_.y.size(); ++j)
        for (std::size_t i = 0; i + 1 < map_.x.size(); ++i) path += border(map_.margins[l], i, j);
      if (path.empty()) continue;
      const std::string colour =
          colours_.emplace(l, kBorders[colours_.size() % std::size(kBorders)]).first->second;
      text_ += "<path fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"2\" d=\"" + path + "\"/>\n";
      note(row++, colour, limit_text(set_, l));
    }
  }

  [[nodiscard]] std::string border(const std::vector<double>& margin, std::size_t i,
                                   std::size_t j) const {
    const std::size_t corner[] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
    if (std::none_of(std::begin(corner), std::end(corner), [&](std::size_t k) { return map_.feasible(k); }))
      return {};
    std::string path;
    for (int k = 0; k < 4; ++k) {
      const std::size_t p = corner[k], q = corner[(k + 1) % 4];
      const double m = margin[p], n = margin[q];
      if ((m >= 0.0) == (n >= 0.0)) continue;
      const double share = m / (m - n);
      const auto between = [&](const std::vector<double>& line, std::size_t a, std::size_t b) {
        return line[a] + share * (line[b] - line[a]);
      };
      const std::size_t columns = map_.x.size();
      path += (path.empty() ? "M" : "L") + fixed_text(x(between(map_.x, p % columns, q % columns)), 1) +
              " " + fixed_text(y(between(map_.y, p / columns, q / columns)), 1);
    }
    return path;
  }

  void axes() {
    for (int k = 0; k <= 4; ++k) {
      const double u = map_.x.front() + (map_.x.back() - map_.x.front()) * k / 4,
                   v = map_.y.front() + (map_.y.back() - map_.y.front()) * k / 4;
      text_ += "<text x=\"" + fixed_text(x(u), 1) + "\" y=\"" + fixed_text(kMapTop + kMapHeight + 18, 0) +
               "\" text-anchor=\"middle\">" + fixed_text(u, 3) + "</text><text x=\"" +
               fixed_text(kMapLeft - 6, 0) + "\" y=\"" + fixed_text(y(v) + 4, 1) +
               "\" text-anchor=\"end\">" + fixed_text(v, 3) + "</text>\n";
    }
    text_ += "<text x=\"" + fixed_text(kMapLeft + kMapWidth / 2, 0) + "\" y=\"" +
             fixed_text(kMapTop + kMapHeight + 42, 0) + "\" text-anchor=\"middle\">" +
             title_of(set_, map_.across) + " [modules]</text><text transform=\"translate(16," +
             fixed_text(kMapTop + kMapHeight / 2, 0) + ") rotate(-90)\" text-anchor=\"middle\">" +
             title_of(set_, map_.up) + " [modules]</text>\n";
  }

  [[nodiscard]] double best_at(MapAxis axis) const {
    return axis == MapAxis::kCentreDistance ? best_.centre_distance
           : axis == MapAxis::kLayer1Shift  ? best_.layer1_shift
                                            : best_.layer2_shift;
  }
  void cross() {
    const std::string u = fixed_text(x(best_at(map_.across)), 1), v = fixed_text(y(best_at(map_.up)), 1);
    text_ += "<path transform=\"translate(" + u + "," + v +
             ")\" stroke=\"#000\" stroke-width=\"2\" d=\"M-7 0H7M0 -7V7\"/>\n";
  }

  const ToothSet& set_;
  const ShiftMap& map_;
  FreeShifts best_;
  BorderColours& colours_;
  std::string text_;
};

}  // namespace

std::string shift_map_csv(const ToothSet& set, const ShiftSurface& surface) {
  std::string text =
      "map,centre_distance_modules,layer1_shift,layer2_shift,efficiency,feasible,limit,margin_modules\n";
  for (std::size_t m = 0; m < surface.maps.size(); ++m) {
    const ShiftMap& map = surface.maps[m];
    for (std::size_t k = 0; k < map.efficiency.size(); ++k) {
      const double u = map.x[k % map.x.size()], v = map.y[k / map.x.size()];
      const auto value = [&](MapAxis axis, double best) {
        return decimal_or_nothing(axis == map.across ? u : axis == map.up ? v : best);
      };
      const std::size_t limit = map.nearest_limit(k);
      text += std::to_string(m + 1) + "," +
              value(MapAxis::kCentreDistance, surface.best.centre_distance) + "," +
              value(MapAxis::kLayer1Shift, surface.best.layer1_shift) + "," +
              value(MapAxis::kLayer2Shift, surface.best.layer2_shift) + "," +
              decimal_or_nothing(map.efficiency[k]) + (map.feasible(k) ? ",1," : ",0,") +
              limit_text(set, limit) + "," + decimal_or_nothing(map.margins[limit][k]) + "\n";
    }
  }
  return text;
}

std::string shift_map_html(const std::string& title, const ToothSet& set,
                           const ShiftSurface& surface) {
  const std::string heading = io::xml_escaped(title);
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>" +
      heading +
      "</title>\n<style>body { font: 16px/1.5 system-ui, sans-serif; max-width: 54rem; margin: 1rem "
      "auto; padding: 0 1rem } svg { width: 100%; height: auto; margin-bottom: 2rem }</style></head>\n<body><h1>" +
      heading + "</h1>\n<p>";
  text += surface.efficiency == surface.efficiency
              ? "Best: " + fixed_text(100.0 * surface.efficiency, 3) + " % at the cross, centre distance " +
                    fixed_text(surface.best.centre_distance, 5) + " modules."
              : std::string("No shifts keep every limit; the cross is where the breach is least.");
  text += " Colours: efficiency where every limit is kept. Lines: the limits that end this region. The "
          "third variable is as at the cross.</p>\n";
  BorderColours colours;
  for (const ShiftMap& map : surface.maps) text += Picture(set, map, surface.best, colours).text();
  return text + "</body></html>\n";
}

}  // namespace trueflank
