// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/loop/drive/bench_visits.h"

// What came before a row: which way the load went, how long ago the drive stood still.
namespace trueflank::loop {
namespace {

/// Which way a load or a speed goes in the rows of one file.
void note_ways(std::vector<BenchPoint>& points, std::size_t begin, std::size_t end,
               double BenchPoint::*value, int BenchPoint::*noted, double apart) {
  std::size_t turn = begin;  // the row that went furthest
  int way = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const double moved = points[i].*value - points[turn].*value;
    if (way == 0 ? std::abs(moved) > apart : -way * moved > apart) {
      const int next = moved > 0.0 ? 1 : -1;
      // What stands at the turn belongs to both ways.
      std::size_t first = i;
      while (first > begin && std::abs(points[first - 1].*value - points[turn].*value) <= apart)
        --first;
      const std::size_t middle = way == 0 ? first : first + (i - first + 1) / 2;
      for (std::size_t k = middle; k < i; ++k) points[k].*noted = next;
      way = next;
      turn = i;
    } else if (way * moved > 0.0) {
      turn = i;
    }
    points[i].*noted = way;
  }
}

}  // namespace

void note_history(std::vector<BenchPoint>& points) {
  constexpr double kApart = 0.025;  // of the largest
  double most_load = 0.0, most_speed = 0.0;
  for (const BenchPoint& p : points) {
    most_load = std::max(most_load, p.load_nm);
    most_speed = std::max(most_speed, p.speed_rpm);
  }
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    const bool ends = i == points.size() || points[i].file != points[begin].file;
    if (ends) {
      note_ways(points, begin, i, &BenchPoint::load_nm, &BenchPoint::way, kApart * most_load);
      note_ways(points, begin, i, &BenchPoint::speed_rpm, &BenchPoint::speed_way,
                kApart * most_speed);
      begin = i;
    }
    if (i == points.size()) break;
    const bool starts = i == begin;
    // Rows that could not be used were taken too.
    const int step = starts ? 0 : std::max(1, points[i].line - points[i - 1].line);
    points[i].row = starts ? 0 : points[i - 1].row + step;
    points[i].since_turn =
        starts || points[i].forward != points[i - 1].forward ? 0 : points[i - 1].since_turn + step;
  }
}

}  // namespace trueflank::loop
