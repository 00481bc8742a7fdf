// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/scans/rest_scan.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"

namespace trueflank::loop {
namespace {

constexpr int kShortestPeriod = 4, kLongestPeriod = 120;
constexpr double kFewestRests = 6.0, kFewestRowsOfRests = 48.0;

/// Share of a quantity's variance that its place in the period tells, beyond what as many means
/// take by chance.
double told_by_place(const std::vector<BenchPoint>& points, int period, double BenchPoint::*value) {
  std::vector<double> sum(static_cast<std::size_t>(period), 0.0), count = sum;
  double all = 0.0, square = 0.0;
  const double n = static_cast<double>(points.size());
  for (const BenchPoint& p : points) {
    const auto k = static_cast<std::size_t>(p.row % period);
    sum[k] += p.*value;
    count[k] += 1.0;
    all += p.*value;
    square += p.*value * (p.*value);
  }
  const double whole = square - all * all / n;
  if (!(whole > 1e-9 * square)) return 0.0;
  double between = -all * all / n;
  for (std::size_t k = 0; k < sum.size(); ++k)
    if (count[k] > 0.0) between += sum[k] * sum[k] / count[k];
  const double by_chance = (period - 1.0) / n;
  return (between / whole - by_chance) / (1.0 - by_chance);
}

/// SumsOfPeriod over the rows of each place in the period.
struct SumsOfPeriod {
  std::vector<double> square, product;
  double all_square = 0.0, all_product = 0.0;
};

SumsOfPeriod sums_of_period(const DriveContext& context, const Eigen::VectorXd& left, int period) {
  SumsOfPeriod sums{std::vector<double>(static_cast<std::size_t>(period), 0.0),
                    std::vector<double>(static_cast<std::size_t>(period), 0.0)};
  const auto& points = context.table.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BenchPoint& p = points[i];
    if (p.fold == 0) continue;
    const double column = drive_effects::changed_nm(context, p, drive_effects::kDrag) / p.sigma_nm;
    const double one = left[static_cast<Eigen::Index>(i)] / p.sigma_nm;
    const auto k = static_cast<std::size_t>(p.row % period);
    sums.square[k] += column * column;
    sums.product[k] += column * one;
    sums.all_square += column * column;
    sums.all_product += column * one;
  }
  return sums;
}

}  // namespace

std::vector<int> periods_of_rests(const std::vector<BenchPoint>& points) {
  constexpr double kTold = 0.3;
  std::vector<int> periods;
  const int longest =
      std::min(kLongestPeriod, static_cast<int>(static_cast<double>(points.size()) / kFewestRests));
  for (int period = kShortestPeriod; period <= longest; ++period)
    if (told_by_place(points, period, &BenchPoint::load_nm) <= kTold &&
        told_by_place(points, period, &BenchPoint::speed_rpm) <= kTold)
      periods.push_back(period);
  return periods;
}

LikeliestRest likeliest_rest(const DriveContext& context, const Eigen::VectorXd& left) {
  LikeliestRest best;
  const auto& points = context.table.points;
  if (!drive_effects::has_one_course(context) ||
      static_cast<double>(points.size()) < kFewestRowsOfRests)
    return best;
  double whole = 0.0, looks = 0.0, highest = 0.0;
  std::set<int> units;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].fold == 0) continue;
    units.insert(points[i].unit);
    whole += std::pow(left[static_cast<Eigen::Index>(i)] / points[i].sigma_nm, 2);
  }
  for (const int period : periods_of_rests(points)) {
    const SumsOfPeriod sums = sums_of_period(context, left, period);
    if (!(sums.all_square > 0.0)) continue;
    const double beside_constant = whole - sums.all_product * sums.all_product / sums.all_square;
    for (const double rows : {0.6, 1.2, 2.5, 5.0, 10.0, 20.0}) {
      if (rows > 0.3 * period) break;
      for (int phase = 0; phase < period; ++phase) {
        double square = 0.0, cross = 0.0, product = 0.0;
        for (int k = 0; k < period; ++k) {
          const auto at = static_cast<std::size_t>((k + phase) % period);
          const double size = std::exp(-k / rows);
          square += size * size * sums.square[at];
          cross += size * sums.square[at];
          product += size * sums.product[at];
        }
        ++looks;
        square -= cross * cross / sums.all_square;
        product -= cross / sums.all_square * sums.all_product;
        if (!(square > 0.0)) continue;
        const double share = product * product / square / beside_constant;
        if (share <= highest) continue;
        highest = share;
        best = {.period = double(period), .phase = double(phase), .rows = rows};
      }
    }
  }
  if (!(highest > 0.0)) return best;
  const double independent = static_cast<double>(units.size());
  best.p_value = std::min(
      1.0, looks * std::pow(std::max(0.0, 1.0 - highest), 0.5 * std::max(0.0, independent - 4.0)));
  return best;
}

}  // namespace trueflank::loop
