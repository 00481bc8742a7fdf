// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/bench_scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "trueflank/base/number_text.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewestToScatter = 48, kFewestOfAPart = 10;
constexpr double kTimesAsMuch = 2.0;    ///< as much, or it is not worth a word
constexpr double kSureOfScatter = 5.0;  ///< standard errors, of some twenty places

/// Count, mean and variance of sizes.
struct ScatterSizes {
  double count = 0.0, sum = 0.0, square = 0.0;
  void add(double size) {
    count += 1.0;
    sum += size;
    square += size * size;
  }
  [[nodiscard]] double mean() const { return sum / count; }
  [[nodiscard]] double error_square() const {
    return std::max(0.0, square / count - mean() * mean()) / std::max(1.0, count - 1.0);
  }
  [[nodiscard]] double rms() const { return std::sqrt(square / count); }
};

struct ScatterOver {
  double BenchPoint::*value;
  const char *name, *unit;
};

}  // namespace

std::string where_it_scatters(const BenchTable& table, double ratio,
                              const Eigen::VectorXd& left_nm) {
  const auto& points = table.points;
  if (points.size() < kFewestToScatter) return {};
  // (the directions are read by other sensors)
  std::array<ScatterSizes, 2> of_direction;
  for (std::size_t i = 0; i < points.size(); ++i)
    of_direction[points[i].forward ? 1 : 0].add(left_nm[static_cast<Eigen::Index>(i)]);
  std::vector<double> at_input(points.size()), size(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = std::abs(left_nm[static_cast<Eigen::Index>(i)]);
    const double usual = of_direction[points[i].forward ? 1 : 0].rms();
    size[i] = usual > 0.0 ? off / usual : 0.0;
    at_input[i] = points[i].forward ? off / ratio : off;
  }
  std::string text;
  double surest = kSureOfScatter;
  for (const ScatterOver& over : {ScatterOver{&BenchPoint::load_nm, "load", "N m at the input"},
                                  ScatterOver{&BenchPoint::speed_rpm, "speed", "rpm"},
                                  ScatterOver{&BenchPoint::temperature_c, "temperature", "C"}}) {
    if (over.value == &BenchPoint::temperature_c && !table.has_temperature) continue;
    std::vector<double> values;
    for (const BenchPoint& p : points) values.push_back(p.*over.value);
    std::sort(values.begin(), values.end());
    constexpr int kParts = 8;
    for (int part = 1; part < kParts; ++part) {
      const double at = values[part * values.size() / kParts];
      const auto next = std::upper_bound(values.begin(), values.end(), at);
      if (next == values.end()) continue;
      ScatterSizes low, high, low_nm, high_nm;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const bool below = points[i].*over.value <= at;
        (below ? low : high).add(size[i]);
        (below ? low_nm : high_nm).add(at_input[i]);
      }
      if (std::min(low.count, high.count) < kFewestOfAPart) continue;
      const bool below_more = low.mean() > high.mean();
      const ScatterSizes &more = below_more ? low : high, &less = below_more ? high : low;
      const double sure = (more.mean() - less.mean()) /
                          std::sqrt(std::max(more.error_square() + less.error_square(), 1e-300));
      if (sure < surest || more.rms() < kTimesAsMuch * less.rms()) continue;
      surest = sure;
      text = std::string("the rows ") + (below_more ? "up to" : "from") + " a " + over.name +
             printed(" of %.4g ", below_more ? at : *next) + over.unit + (below_more ? "" : " on") +
             printed(
                 " scatter %.2g times as much as the others, by %.2g N m at the input "
                 "(%.2g N m there): ",
                 more.rms() / less.rms(), (below_more ? low_nm : high_nm).rms(),
                 (below_more ? high_nm : low_nm).rms()) +
             "a controller that hunts, a coupling that rattles? It is no loss";
    }
  }
  return text;
}

}  // namespace trueflank::loop
