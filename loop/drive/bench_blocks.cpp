// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/drive/bench_table.h"
#include "trueflank/loop/drive/bench_visits.h"

// Which rows may share their error, and which are locked away before anything is looked at.
namespace trueflank::loop {
namespace {

/// Rows in a row stay one set point while speed and load move less than this share of their range.
constexpr double kSamePoint = 0.02;
/// Fewer units than this would leave the sign flips nothing to count.
constexpr int kFewUnits = 9;
/// Correlation of neighbours that is told from none: to merge in vain costs little.
constexpr double kLeastCorrelation = 0.12, kCorrelationErrors = 1.5;

struct Range {
  double low = 1e300, high = -1e300;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  [[nodiscard]] double span() const { return std::max(high - low, 1e-300); }
};

void cut_into_set_points(BenchTable& table) {
  Range speed, load;
  for (const BenchPoint& p : table.points) {
    speed.add(p.speed_rpm);
    load.add(p.load_nm);
  }
  int unit = -1;
  const BenchPoint* start = nullptr;
  for (BenchPoint& p : table.points) {
    const bool same = start != nullptr && start->file == p.file && start->forward == p.forward &&
                      std::abs(start->speed_rpm - p.speed_rpm) <= kSamePoint * speed.span() &&
                      std::abs(start->load_nm - p.load_nm) <= kSamePoint * load.span();
    if (!same) {
      ++unit;
      start = &p;
    }
    p.unit = unit;
  }
  table.units = unit + 1;
}

/// Correlation of neighbouring units' mean residuals, in their noise's units, of the errors alone.
double correlation(const BenchTable& table, const SmoothFit& fit,
                   const std::vector<int>& set_point) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(table.units), count = sum;
  // Units of the same set points in the same order come again.
  std::vector<int> of_unit(static_cast<std::size_t>(table.units), 0);
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const BenchPoint& p = table.points[i];
    sum[p.unit] += fit.residual_nm[i] / p.sigma_nm;
    count[p.unit] += 1.0;
    int& here = of_unit[static_cast<std::size_t>(p.unit)];
    if (i == 0 || p.unit != table.points[i - 1].unit)
      here = set_point[i];
    else if (set_point[i] != set_point[i - 1])
      here = static_cast<int>(static_cast<unsigned>(here) * 1009U +
                              static_cast<unsigned>(set_point[i]));
  }
  return correlation_of_visits(sum.cwiseQuotient(count.cwiseMax(1.0).cwiseSqrt()), of_unit);
}

/// Correlation of the means of neighbouring dwells from that of the rows inside them; NaN where set
/// points come again, which tell more, or dwells are short.
double correlation_from_dwells(const BenchTable& table, const SmoothFit& fit,
                               const std::vector<int>& set_point) {
  constexpr double kLong = 5.0;
  const double n = static_cast<double>(table.points.size()), dwells = table.units;
  if (n < kLong * dwells ||
      *std::max_element(set_point.begin(), set_point.end()) + 1 < 0.75 * dwells)
    return kNaN;
  std::vector<double> mean(table.units, 0.0), rows(table.units, 0.0);
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    mean[table.points[i].unit] += fit.residual_nm[i];
    rows[table.points[i].unit] += 1.0;
  }
  double product = 0.0, square = 0.0, between = 0.0;
  const auto off = [&](std::size_t i) {
    const BenchPoint& p = table.points[i];
    return (fit.residual_nm[i] - mean[p.unit] / rows[p.unit]) / p.sigma_nm;
  };
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    square += off(i) * off(i);
    if (i == 0 || table.points[i].unit != table.points[i - 1].unit) continue;
    product += off(i) * off(i - 1);
    between += 1.0;
  }
  if (!(square > 0.0) || between < 1.0) return kNaN;
  // The mean that was taken off makes neighbours look opposite: by about (1 + r) / (rows - 1).
  const double m = n / dwells, seen = product / between / (square / (n - dwells));
  const double r = std::clamp((seen + 1.0 / m) / (1.0 - 1.0 / m), 0.0, 0.95),
               rest = 1.0 - std::pow(r, m);
  const double own = m * (1.0 + r) / (1.0 - r) - 2.0 * r * rest / ((1.0 - r) * (1.0 - r));
  return r * rest * rest / ((1.0 - r) * (1.0 - r)) / own;
}

/// Neighbouring units of one file and direction become one; true where that changed anything.
bool merge_neighbours(BenchTable& table) {
  std::vector<int> merged(table.units, -1);
  std::vector<std::pair<int, bool>> kind(table.units);
  for (const BenchPoint& p : table.points) kind[p.unit] = {p.file, p.forward};
  int next = -1;
  for (int u = 0; u < table.units; ++u) {
    if (u > 0 && kind[u] == kind[u - 1] && (u < 2 || merged[u - 1] != merged[u - 2])) {
      merged[u] = next;
      continue;
    }
    merged[u] = ++next;
  }
  if (next + 1 == table.units) return false;
  for (BenchPoint& p : table.points) p.unit = merged[p.unit];
  table.units = next + 1;
  return true;
}

/// Where the driving torque is set to the same few values and its sensor reads in steps, all rows
/// of one reading share its rounding: they are one unit, and predicted together, or any course over
/// the load would predict the rounding itself. What is locked away stays so. A sensor's step shows where it reads the
/// driven side, which scatters.
void join_equal_readings(BenchTable& table) {
  constexpr double kCoarse =
      0.1;  // rounding, over the variance of the mean of the rows of a reading
  std::array<std::vector<double>, 2> driven, sensitivity, sigma;
  for (const BenchPoint& p : table.points) {
    const std::size_t way = p.forward ? 1 : 0;
    driven[way].push_back(p.driven_nm);
    sensitivity[way].push_back(p.driven_nm / std::max(p.driving_nm, 1e-300));
    sigma[way].push_back(p.sigma_nm);
  }
  if (driven[0].empty() || driven[1].empty()) return;
  int units = 0;
  for (const bool forward : {true, false}) {
    const std::size_t way = forward ? 1 : 0;
    // What drives here is driven in the other direction.
    const double step = step_of(driven[1 - way]);
    const double rounding_nm = step / std::sqrt(12.0) * median(sensitivity[way]);
    std::map<long long, std::vector<BenchPoint*>> readings;
    for (BenchPoint& p : table.points)
      if (p.forward == forward)
        readings[step > 0.0 ? std::llround(p.driving_nm / step) : 0].push_back(&p);
    const double rows =
        static_cast<double>(driven[way].size()) / static_cast<double>(readings.size());
    const double of_mean_nm = median(sigma[way]) / std::sqrt(rows);
    if (!(step > 0.0) || rows < 2.0 ||
        !(rounding_nm * rounding_nm > kCoarse * of_mean_nm * of_mean_nm))
      continue;
    for (const auto& [number, of_reading] : readings) {
      for (BenchPoint* p : of_reading) {
        p->reading = units;
        if (p->fold != 0) p->fold = 1 + units % kBenchFolds;
      }
      ++units;
    }
  }
  if (units == 0) return;
  std::map<std::pair<int, int>, int> number;  // a reading, or a unit where readings are fine
  for (BenchPoint& p : table.points)
    p.unit = number
                 .emplace(p.reading >= 0 ? std::pair(0, p.reading) : std::pair(1, p.unit),
                          static_cast<int>(number.size()))
                 .first->second;
  table.units = static_cast<int>(number.size());
}

/// Folds of n members in shuffled order: two tenths are locked.
int fold_of_rank(int rank) {
  const int tenth = rank % 10;
  return tenth == 0 || tenth == 5 ? 0 : tenth < 5 ? tenth : tenth - 1;
}

/// Cells of direction, speed and load: repeats of a set point stay together.
std::vector<int> cells_of(const BenchTable& table) {
  Range speed, load;
  for (const BenchPoint& p : table.points) {
    speed.add(p.speed_rpm);
    load.add(p.load_nm);
  }
  std::map<int, std::array<double, 3>> means;  // unit -> speed, load, count
  for (const BenchPoint& p : table.points) {
    auto& m = means[p.unit];
    m[0] += p.speed_rpm;
    m[1] += p.load_nm;
    m[2] += 1.0;
  }
  std::vector<int> cell(table.points.size());
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const auto& m = means[table.points[i].unit];
    const int v = static_cast<int>(15.0 * (m[0] / m[2] - speed.low) / speed.span() + 0.5);
    const int t = static_cast<int>(15.0 * (m[1] / m[2] - load.low) / load.span() + 0.5);
    cell[i] = (table.points[i].forward ? 0 : 10000) + 100 * v + t;
  }
  return cell;
}

void lock_hold_out(BenchTable& table, bool log) {
  std::vector<int> cell = cells_of(table);
  for (const bool forward : {true, false}) {
    std::map<int, int> rank;
    for (int pass = 0; pass < 2; ++pass) {
      rank.clear();
      for (std::size_t i = 0; i < table.points.size(); ++i)
        if (table.points[i].forward == forward) rank[cell[i]] = 0;
      if (pass == 0 && (log || rank.size() < 10)) {
        // A log, or too few set points to spare one in five: whole stretches or repeats.
        for (std::size_t i = 0; i < table.points.size(); ++i)
          if (table.points[i].forward == forward) cell[i] = table.points[i].unit;
        continue;
      }
      break;
    }
    std::vector<int> keys;
    for (const auto& [key, unused] : rank) keys.push_back(key);
    std::mt19937_64 random(20260107);
    for (std::size_t i = keys.size(); i > 1; --i) std::swap(keys[i - 1], keys[random() % i]);
    for (std::size_t i = 0; i < keys.size(); ++i) rank[keys[i]] = static_cast<int>(i);
    for (std::size_t i = 0; i < table.points.size(); ++i)
      if (table.points[i].forward == forward) table.points[i].fold = fold_of_rank(rank[cell[i]]);
  }
}

/// The same without what differs between a load that rises and one that falls, or dies away after a
/// change of direction: neighbours share it, and it is no error.
SmoothFit without_memory(const BenchTable& table, const SmoothFit& fit) {
  constexpr std::size_t kFewestTurns = 4, kFewestRows = 48;
  constexpr Eigen::Index kColumns = 8;
  const auto& points = table.points;
  std::size_t turns = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    turns +=
        points[i].way != points[i - 1].way || points[i].forward != points[i - 1].forward ? 1 : 0;
  if (turns < kFewestTurns || points.size() < kFewestRows) return fit;
  double most = 1e-300;
  for (const BenchPoint& p : points) most = std::max(most, p.load_nm);
  Eigen::MatrixXd x(static_cast<Eigen::Index>(points.size()), kColumns);
  Eigen::VectorXd left(x.rows());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BenchPoint& p = points[i];
    const double side = p.forward ? 1.0 : -1.0, share = p.load_nm / most;
    const double middle = 4.0 * share * (1.0 - share);
    x.row(static_cast<Eigen::Index>(i)) << p.way, side * p.way, middle * p.way,
        side * middle * p.way, p.way_kept, side * p.way_kept, std::exp(-p.since_turn / 2.0),
        std::exp(-p.since_turn / 6.0);
    left[static_cast<Eigen::Index>(i)] = fit.residual_nm[i] / p.sigma_nm;
  }
  left -= x * least_squares(x, left);
  SmoothFit cleaned = fit;
  for (std::size_t i = 0; i < points.size(); ++i)
    cleaned.residual_nm[i] = left[static_cast<Eigen::Index>(i)] * points[i].sigma_nm;
  return cleaned;
}

/// The same without what differs between files: another day is no error that neighbours share.
SmoothFit without_means_of_files(const BenchTable& table, const SmoothFit& fit) {
  std::vector<int> file, direction;
  Eigen::VectorXd off(static_cast<Eigen::Index>(table.points.size()));
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const BenchPoint& p = table.points[i];
    file.push_back(p.file);
    direction.push_back(p.forward ? 1 : 0);
    off[static_cast<Eigen::Index>(i)] = fit.residual_nm[i] / p.sigma_nm;
  }
  if (file.back() == file.front()) return fit;
  take_means(off, together(file, direction));
  SmoothFit cleaned = fit;
  for (std::size_t i = 0; i < table.points.size(); ++i)
    cleaned.residual_nm[i] = off[static_cast<Eigen::Index>(i)] * table.points[i].sigma_nm;
  return cleaned;
}

}  // namespace

void deal_hold_out_anew(BenchTable& table) {
  constexpr std::size_t kParts = 4, kShortest = 3;
  std::map<int, std::size_t> rows_of_unit, taken;
  for (const BenchPoint& p : table.points) ++rows_of_unit[p.unit];
  std::map<std::pair<int, std::size_t>, int> rank;  // of a unit and its part
  std::vector<std::pair<int, std::size_t>> part;
  for (const BenchPoint& p : table.points) {
    const std::size_t length = std::max(kShortest, rows_of_unit[p.unit] / kParts);
    part.emplace_back(p.unit, taken[p.unit]++ / length);
    rank[part.back()] = 0;
  }
  std::vector<std::pair<int, std::size_t>> keys;
  for (const auto& [key, unused] : rank) keys.push_back(key);
  std::mt19937_64 random(20261129);
  for (std::size_t i = keys.size(); i > 1; --i) std::swap(keys[i - 1], keys[random() % i]);
  for (std::size_t i = 0; i < keys.size(); ++i) rank[keys[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < table.points.size(); ++i)
    table.points[i].fold = fold_of_rank(rank[part[i]]);
}

void assign_blocks(BenchTable& table, const SmoothFit& whole_fit) {
  const SmoothFit fit = without_memory(table, without_means_of_files(table, whole_fit));
  cut_into_set_points(table);
  const std::vector<int> set_point = set_points_of(table.points);
  bool log = false;
  const double of_dwells = correlation_from_dwells(table, fit, set_point);
  while (!(of_dwells <= kLeastCorrelation) && table.units > 2 * kFewUnits &&
         correlation(table, fit, set_point) >
             std::max(kLeastCorrelation,
                      kCorrelationErrors / std::sqrt(static_cast<double>(table.units)))) {
    if (!merge_neighbours(table)) break;
    log = true;
  }
  table.drifts = log;
  lock_hold_out(table, log);
  if (!log) join_equal_readings(table);
}

}  // namespace trueflank::loop
