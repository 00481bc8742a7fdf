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

constexpr double kMapWidth = 520, kMapHeight = 420, kMapLeft = 70, kMapTop = 20, kMapRight = 360,
                 kMapBottom = 55;
constexpr int kColours = 24;
constexpr const char* kBorders[] = {
    "#d62728", "#1f77b4", "#2ca02c", "#ff7f0e", "#9467bd", "#8c564b", "#e377c2", "#17becf",
    "#7f7f7f", "#bcbd22", "#111111", "#003f5c", "#f2a900", "#58508d", "#00a087", "#ff6361"};

std::string decimal_or_nothing(double value) { return std::isnan(value) ? std::string() : io::decimal_text(value); }

/// "shift of ring1".
std::string title_of(const ToothSet& set, MapAxis axis) {
  if (axis == MapAxis::kCentreDistance) return "centre distance";
  const SearchLayer& layer = set.train->layers[axis == MapAxis::kLayer1Shift ? 0 : 1];
  const int gear = layer.ring >= 0 ? layer.ring : layer.planet;
  return "shift of " + set.train->topology.gears[static_cast<std::size_t>(gear)].name;
}

std::string limit_text(const LimitEntry& entry) {
  return std::string(to_text(entry.limit)) + ": " + entry.where +
         (entry.which.empty() ? "" : " (" + entry.which + ")");
}

/// From dark blue (least) over green to yellow.
std::string colour_of(int level) {
  const double u = static_cast<double>(level) / (kColours - 1);
  const auto part = [&](double low, double middle, double high) {
    const double value =
        u < 0.5 ? low + 2.0 * u * (middle - low) : middle + (2.0 * u - 1.0) * (high - middle);
    return std::to_string(std::lround(value));
  };
  return "rgb(" + part(68, 33, 253) + "," + part(20, 145, 231) + "," + part(100, 140, 60) + ")";
}

/// One colour for a limit in all pictures, as they appear.
using BorderColours = std::map<std::size_t, std::string>;

class Picture {
 public:
  Picture(const ToothSet& set, const ShiftSurface& surface, const ShiftMap& map,
          BorderColours& colours)
      : set_(set), limits_(surface.limits), map_(map), best_(surface.best), colours_(colours) {}

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
        const int level =
            high > low ? static_cast<int>((efficiency - low) / (high - low) * (kColours - 1) + 0.5)
                       : 0;
        const double left = std::max(kMapLeft, x(map_.x[i]) - 0.5 * w),
                     right = std::min(kMapLeft + kMapWidth, x(map_.x[i]) + 0.5 * w),
                     top = std::max(kMapTop, y(map_.y[j]) - 0.5 * h),
                     bottom = std::min(kMapTop + kMapHeight, y(map_.y[j]) + 0.5 * h);
        paths[level] += "M" + fixed_text(left, 1) + " " + fixed_text(top, 1) + "H" +
                        fixed_text(right, 1) + "V" + fixed_text(bottom, 1) + "H" +
                        fixed_text(left, 1) + "z";
      }
    for (const auto& [level, path] : paths)
      text_ += "<path shape-rendering=\"crispEdges\" fill=\"" + colour_of(level) + "\" d=\"" +
               path + "\"/>\n";
    if (high < low) return note(0, "#5a6675", "no place keeps every limit");
    note(0, colour_of(kColours - 1), fixed_text(100.0 * high, 2) + " %");
    note(1, colour_of(0), fixed_text(100.0 * low, 2) + " %");
  }

  void note(int row, const std::string& colour, const std::string& words) {
    const double top = kMapTop + 16.0 * row;
    text_ += "<rect x=\"" + fixed_text(kMapLeft + kMapWidth + 10, 0) + "\" y=\"" +
             fixed_text(top, 0) + "\" width=\"12\" height=\"12\" fill=\"" + colour +
             "\"/><text x=\"" + fixed_text(kMapLeft + kMapWidth + 28, 0) + "\" y=\"" +
             fixed_text(top + 10, 0) + "\">" + io::xml_escaped(words) + "</text>\n";
  }

  void borders() {
    int row = 3;
    for (std::size_t l = 0; l < limits_.size(); ++l) {
      std::string path;
      for (const BorderPiece& piece : limit_border(map_, l))
        path += "M" + fixed_text(x(piece.from[0]), 1) + " " + fixed_text(y(piece.from[1]), 1) +
                "L" + fixed_text(x(piece.to[0]), 1) + " " + fixed_text(y(piece.to[1]), 1);
      if (path.empty()) continue;
      const std::string colour =
          colours_.emplace(l, kBorders[colours_.size() % std::size(kBorders)]).first->second;
      text_ +=
          "<path fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"2\" d=\"" + path + "\"/>\n";
      note(row++, colour, limit_text(limits_[l]));
    }
  }

  void axes() {
    for (int k = 0; k <= 4; ++k) {
      const double u = map_.x.front() + (map_.x.back() - map_.x.front()) * k / 4,
                   v = map_.y.front() + (map_.y.back() - map_.y.front()) * k / 4;
      text_ += "<text x=\"" + fixed_text(x(u), 1) + "\" y=\"" +
               fixed_text(kMapTop + kMapHeight + 18, 0) + "\" text-anchor=\"middle\">" +
               fixed_text(u, 3) + "</text><text x=\"" + fixed_text(kMapLeft - 6, 0) + "\" y=\"" +
               fixed_text(y(v) + 4, 1) + "\" text-anchor=\"end\">" + fixed_text(v, 3) + "</text>\n";
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
    const std::string u = fixed_text(x(best_at(map_.across)), 1),
                      v = fixed_text(y(best_at(map_.up)), 1);
    text_ += "<path transform=\"translate(" + u + "," + v +
             ")\" stroke=\"#000\" stroke-width=\"2\" d=\"M-7 0H7M0 -7V7\"/>\n";
  }

  const ToothSet& set_;
  const std::vector<LimitEntry>& limits_;
  const ShiftMap& map_;
  FreeShifts best_;
  BorderColours& colours_;
  std::string text_;
};

/// What a point of a map has along an axis; of the third variable the best place's.
double value_at(const ShiftMap& map, const FreeShifts& best, MapAxis axis, double across,
                double up) {
  if (axis == map.across) return across;
  if (axis == map.up) return up;
  return axis == MapAxis::kCentreDistance ? best.centre_distance
         : axis == MapAxis::kLayer1Shift  ? best.layer1_shift
                                          : best.layer2_shift;
}

std::string place_text(const ShiftMap& map, const FreeShifts& best, double across, double up) {
  std::string text;
  for (const MapAxis axis :
       {MapAxis::kCentreDistance, MapAxis::kLayer1Shift, MapAxis::kLayer2Shift})
    text += (text.empty() ? "" : ",") + decimal_or_nothing(value_at(map, best, axis, across, up));
  return text;
}

}  // namespace

std::string train_text(const ToothSet& set) {
  const SearchTrain& train = *set.train;
  std::string text = train.kind();
  const std::string planets =
      ", " + std::to_string(set.planets) + (set.planets == 1 ? " planet" : " planets");
  if (train.stage > 0)
    text = "stage " + std::to_string(train.stage) + " of " + text + planets;
  else if (train.kind() == "pair")
    text += train.internal_wheel ? ", internal wheel" : ", external wheel";
  else
    text += ", " + train.input + " drives " + train.output + planets;
  if (set.layer2_module_ratio != 1.0)
    text += ", second module " + decimal_or_nothing(set.layer2_module_ratio) + " of the first";
  return text;
}

std::string shift_map_csv(const ShiftSurface& surface) {
  std::string text =
      "map,centre_distance_modules,layer1_shift,layer2_shift,efficiency,feasible,limit,margin_"
      "modules\n";
  for (std::size_t m = 0; m < surface.maps.size(); ++m) {
    const ShiftMap& map = surface.maps[m];
    for (std::size_t k = 0; k < map.efficiency.size(); ++k) {
      const std::size_t limit = map.nearest_limit(k);
      text += std::to_string(m + 1) + "," +
              place_text(map, surface.best, map.x[k % map.x.size()], map.y[k / map.x.size()]) +
              "," + decimal_or_nothing(map.efficiency[k]) + (map.feasible(k) ? ",1," : ",0,") +
              limit_text(surface.limits[limit]) + "," + decimal_or_nothing(map.margins[limit][k]) +
              "\n";
    }
  }
  return text;
}

std::string shift_borders_csv(const ShiftSurface& surface) {
  std::string text = "map,limit,piece,centre_distance_modules,layer1_shift,layer2_shift\n";
  for (std::size_t m = 0; m < surface.maps.size(); ++m)
    for (std::size_t l = 0; l < surface.limits.size(); ++l) {
      std::size_t number = 0;
      for (const BorderPiece& piece : limit_border(surface.maps[m], l)) {
        const std::string start = std::to_string(m + 1) + "," + limit_text(surface.limits[l]) +
                                  "," + std::to_string(++number) + ",";
        for (const auto& point : {piece.from, piece.to})
          text += start + place_text(surface.maps[m], surface.best, point[0], point[1]) + "\n";
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
      "</title>\n<style>body { font: 16px/1.5 system-ui, sans-serif; max-width: 54rem; margin: "
      "1rem "
      "auto; padding: 0 1rem } svg { width: 100%; height: auto; margin-bottom: 2rem "
      "}</style></head>\n<body><h1>" +
      heading + "</h1>\n<p>" + io::xml_escaped(train_text(set)) + ".</p>\n<p>";
  text += surface.efficiency == surface.efficiency
              ? "Best: " + fixed_text(100.0 * surface.efficiency, 3) +
                    " % at the cross, centre distance " +
                    fixed_text(surface.best.centre_distance, 5) + " modules."
              : std::string("No shifts keep every limit; the cross is where the breach is least.");
  text +=
      " Colours: efficiency where every limit is kept. Lines: the limits that end this region. The "
      "third variable is as at the cross.</p>\n";
  BorderColours colours;
  for (const ShiftMap& map : surface.maps) text += Picture(set, surface, map, colours).text();
  return text + "</body></html>\n";
}

}  // namespace trueflank
