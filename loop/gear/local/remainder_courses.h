// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/observations.h"

namespace trueflank::loop {

/// Of a scan: cells along a course, and courses that its teeth are gathered to.
inline constexpr int kCells = 960, kScanCourses = 8;
/// Places of which a course is made at most.
inline constexpr int kMostPlaces = 120;

[[nodiscard]] inline bool is_of_trace(ObservationKind kind) {
  return kind == ObservationKind::kProfile || kind == ObservationKind::kHelix;
}

/// What runs over the same places: traces of one kind and source, or a scan's flanks.
struct CourseKey {
  int source = 0;
  ObservationKind kind = ObservationKind::kProfile;
  bool face = false;
  auto operator<=>(const CourseKey&) const = default;
};

/// A value, or the sum of so many, at a place.
struct RemainderSample {
  double at = 0.0, um = 0.0, count = 1.0;
};

/// The samples of one set of courses, left and right flanks apart.
struct Courses {
  std::array<std::map<int, std::vector<RemainderSample>>, 2> of_flank;
  std::array<std::map<int, int>, 2> tooth_of;
  double low = 1e300, high = -1e300;
  std::size_t samples = 0;
  bool scanned = false;
  int lines = 0;  ///< of a mesh of rows and columns, whose values stand in so many; 0: anywhere

  void add(int side, int course, int tooth, double at, double um) {
    of_flank[side][course].push_back({at, um});
    tooth_of[side][course] = tooth;
    low = std::min(low, at);
    high = std::max(high, at);
    ++samples;
  }

  /// Courses of scans are gathered in narrow cells at once: there are many values.
  void open(int side, int course) {
    std::vector<RemainderSample>& cells = of_flank[side][course];
    if (!cells.empty()) return;
    scanned = true;
    cells.resize(kCells);
    for (int i = 0; i < kCells; ++i)
      cells[static_cast<std::size_t>(i)] = {low + (high - low) * (i + 0.5) / kCells, 0.0, 0.0};
  }
  /// To a course that is open.
  static void add_to_cell(std::vector<RemainderSample>& cells, double share, double um) {
    RemainderSample& cell = cells[static_cast<std::size_t>(
        std::clamp(static_cast<int>(share * kCells), 0, kCells - 1))];
    cell.um += um;
    cell.count += 1.0;
  }
  /// Places run over where values stand: at the ends of the flank a scan has none, and one value
  /// would be told of several places.
  void count_cells() {
    constexpr double kBeyond = 0.002;  // of the values: stray ones
    std::vector<double> counts(kCells, 0.0);
    for (const auto& flank : of_flank)
      for (const auto& [course, cells] : flank)
        for (std::size_t i = 0; i < cells.size(); ++i) counts[i] += cells[i].count;
    const double count = std::accumulate(counts.begin(), counts.end(), 0.0);
    samples = static_cast<std::size_t>(count);
    const auto empty_before = [&](auto first, auto last) {
      double passed = 0.0;
      int cells = 0;
      for (; first != last && passed + *first <= kBeyond * count; ++first, ++cells) passed += *first;
      return cells;
    };
    const double cell = (high - low) / kCells;
    const double first = low + cell * empty_before(counts.begin(), counts.end());
    high -= cell * empty_before(counts.rbegin(), counts.rend());
    low = first;
    count_lines(counts);
  }

  [[nodiscard]] int places(bool scan) const {
    if (scan)
      return std::clamp(static_cast<int>(samples / (2 * kScanCourses * 6)), 0,
                        lines > 0 ? std::min(lines, kMostPlaces) : kMostPlaces);
    std::vector<std::size_t> counts;
    for (const auto& flank : of_flank)
      for (const auto& [course, list] : flank) counts.push_back(list.size());
    if (counts.empty()) return 0;
    return static_cast<int>(std::min<std::size_t>(median(counts), kMostPlaces));
  }

  /// How many values of a trace stand at one of the places.
  [[nodiscard]] double values_of_place(int places) const {
    std::vector<double> counts;
    for (const auto& flank : of_flank)
      for (const auto& [course, list] : flank) counts.push_back(static_cast<double>(list.size()));
    return counts.empty() ? 0.0 : median(std::move(counts)) / places;
  }

  /// One flank's courses as columns over the places; gaps are bridged, courses with many left out.
  [[nodiscard]] Eigen::MatrixXd matrix(int side, int places, std::vector<int>& courses) const {
    Eigen::MatrixXd all(places, static_cast<Eigen::Index>(of_flank[side].size()));
    Eigen::Index kept = 0;
    courses.clear();
    for (const auto& [course, list] : of_flank[side]) {
      std::vector<double> sum(static_cast<std::size_t>(places), 0.0), count(sum);
      for (const RemainderSample& sample : list) {
        // The first and the last of a trace stand at the middle of the end places.
        const double share = (sample.at - low) / (high - low);
        const int i = std::clamp(scanned ? static_cast<int>(std::floor(share * places))
                                         : static_cast<int>(std::lround(share * (places - 1))),
                                 0, places - 1);
        sum[static_cast<std::size_t>(i)] += sample.um;
        count[static_cast<std::size_t>(i)] += sample.count;
      }
      if (bridge(sum, count, all.col(kept))) {
        courses.push_back(course);
        ++kept;
      }
    }
    return all.leftCols(kept);
  }

  [[nodiscard]] double place(double share, int places) const {
    if (scanned) return low + (high - low) * share;
    return low + (high - low) * (share * places - 0.5) / (places - 1.0);
  }
  [[nodiscard]] double length(double share, int places) const {
    return (high - low) * share * (scanned ? 1.0 : places / (places - 1.0));
  }

 private:
  void count_lines(const std::vector<double>& counts) {
    constexpr double kScattered = 0.5;
    int known = 0, runs = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (!(counts[i] > 0.0)) continue;
      ++known;
      runs += i == 0 || !(counts[i - 1] > 0.0) ? 1 : 0;
    }
    lines = known < kScattered * kCells ? runs : 0;
  }

  static bool bridge(const std::vector<double>& sum, const std::vector<double>& count,
                     Eigen::Ref<Eigen::VectorXd> to) {
    const auto n = static_cast<int>(sum.size());
    int before = -1, empty = 0;
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (count[k] == 0.0) {
        ++empty;
        continue;
      }
      to[i] = sum[k] / count[k];
      for (int gap = before + 1; gap < i; ++gap)
        to[gap] =
            before < 0 ? to[i] : to[before] + (to[i] - to[before]) * (gap - before) / (i - before);
      before = i;
    }
    if (before < 0 || empty > n / 4) return false;
    for (int gap = before + 1; gap < n; ++gap) to[gap] = to[before];
    to.array() -= to.mean();
    return true;
  }
};

}  // namespace trueflank::loop
