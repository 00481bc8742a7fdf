// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/loop/drive/bench_visits.h"

// What came before a row: which way the load went, how long ago the drive stood still.
namespace trueflank::loop {
namespace {

/// A load or a speed, and where its way is noted.
struct Way {
  double BenchPoint::*value;
  int BenchPoint::*way;
  int BenchPoint::*kept;
  double BenchPoint::*moved;
};

/// Which way a load or a speed goes in the rows of one file. Less than `apart` of the largest is no
/// movement.
void note_ways(std::vector<BenchPoint>& points, std::size_t begin, std::size_t end,
               const Way& noted, double most, double apart_share) {
  const double apart = apart_share * most;
  std::size_t turn = begin;  // the row that went furthest
  int way = 0;
  double turned_at = begin < end ? points[begin].*noted.value : 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const double moved = points[i].*noted.value - points[turn].*noted.value;
    if (way == 0 ? std::abs(moved) > apart : -way * moved > apart) {
      const int next = moved > 0.0 ? 1 : -1;
      turned_at = points[turn].*noted.value;
      // What stands at the turn belongs to both ways.
      std::size_t first = i;
      while (first > begin && std::abs(points[first - 1].*noted.value - turned_at) <= apart)
        --first;
      const std::size_t middle = way == 0 ? first : first + (i - first + 1) / 2;
      for (std::size_t k = middle; k < i; ++k) points[k].*noted.way = next;
      if (way == 0)
        for (std::size_t k = first; k < i; ++k) points[k].*noted.kept = next;
      way = next;
      turn = i;
    } else if (way * moved > 0.0) {
      turn = i;
    }
    points[i].*noted.way = points[i].*noted.kept = way;
    points[i].*noted.moved = std::abs(points[i].*noted.value - turned_at) / std::max(most, 1e-300);
  }
}

/// How far a load or a speed steps by its sensor's scatter alone, where it is held over several
/// rows: small steps that go to and fro. The same scatter is in what the drive seems to lose, so
/// that such a step would tell of it. 0: small steps follow each other, as in a slow ramp, or there
/// are few.
double steps_of_scatter(const std::vector<BenchPoint>& points, double BenchPoint::*value,
                        double small) {
  constexpr int kFewest = 20;
  constexpr double kErrors = 4.0;
  double product = 0.0, before = 2.0 * small;
  int pairs = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step = points[i].file == points[i - 1].file
                            ? points[i].*value - points[i - 1].*value
                            : 2.0 * small;
    if (std::abs(step) < small && std::abs(before) < small) {
      product += step * before;
      ++pairs;
    }
    before = step;
  }
  // (of independent errors the product of two steps is on average minus their square)
  return pairs < kFewest || product >= 0.0 ? 0.0 : kErrors * std::sqrt(-2.0 * product / pairs);
}

}  // namespace

void note_history(std::vector<BenchPoint>& points) {
  constexpr double kApart = 0.025;  // of the largest
  double most_load = 0.0, most_speed = 0.0;
  for (const BenchPoint& p : points) {
    most_load = std::max(most_load, p.load_nm);
    most_speed = std::max(most_speed, p.speed_rpm);
  }
  constexpr double kStands = 0.002;  // of the largest
  const double load_stands = std::max(kStands * most_load,
                                      steps_of_scatter(points, &BenchPoint::load_nm,
                                                       kApart * most_load)),
               speed_stands = std::max(kStands * most_speed,
                                       steps_of_scatter(points, &BenchPoint::speed_rpm,
                                                        kApart * most_speed));
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    const bool ends = i == points.size() || points[i].file != points[begin].file;
    if (ends) {
      note_ways(points, begin, i,
                {&BenchPoint::load_nm, &BenchPoint::way, &BenchPoint::way_kept, &BenchPoint::moved},
                most_load, kApart);
      note_ways(points, begin, i,
                {&BenchPoint::speed_rpm, &BenchPoint::speed_way, &BenchPoint::speed_way_kept,
                 &BenchPoint::speed_moved},
                most_speed, kApart);
      begin = i;
    }
    if (i == points.size()) break;
    const bool starts = i == begin;
    if (!starts) {
      const auto stepped = [&](double BenchPoint::*value, double stands) {
        const double by = points[i].*value - points[i - 1].*value;
        return by > stands ? 1 : by < -stands ? -1 : 0;
      };
      points[i].way_stepped = stepped(&BenchPoint::load_nm, load_stands);
      points[i].speed_way_stepped = stepped(&BenchPoint::speed_rpm, speed_stands);
      constexpr double kSame = 1e-6;  // degrees
      const double warmer = points[i].temperature_c - points[i - 1].temperature_c;
      points[i].warmth_stepped = warmer > kSame ? 1 : warmer < -kSame ? -1 : 0;
      points[i].warmth_kept =
          points[i].warmth_stepped != 0 ? points[i].warmth_stepped : points[i - 1].warmth_kept;
    }
    // Rows that could not be used were taken too.
    const int step = starts ? 0 : std::max(1, points[i].line - points[i - 1].line);
    points[i].row = starts ? 0 : points[i - 1].row + step;
    points[i].since_turn =
        starts || points[i].forward != points[i - 1].forward ? 0 : points[i - 1].since_turn + step;
  }
}

void note_places(std::vector<BenchPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].place = static_cast<int>(i);
    points[i].before =
        i > 0 && points[i].file == points[i - 1].file && points[i].row == points[i - 1].row + 1
            ? static_cast<int>(i) - 1
            : -1;
  }
}

}  // namespace trueflank::loop
