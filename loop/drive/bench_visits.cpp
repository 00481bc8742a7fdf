// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/bench_visits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// Orthonormal half wave k of n values.
double half_wave(int k, Eigen::Index i, Eigen::Index n) {
  return std::sqrt(2.0 / static_cast<double>(n)) *
         std::cos(0.5 * kTwoPi * k * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
}

}  // namespace

std::vector<int> levels_of(const std::vector<double>& values, double scatter, double of_range) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<int> level(values.size(), 0);
  if (values.empty()) return level;
  const double low = values[order.front()], span = values[order.back()] - low;
  int count = 0;
  double start = low, longest = 0.0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    const double before = values[order[k - 1]], here = values[order[k]];
    if (here - before > scatter * std::abs(here) + of_range * span) {
      ++count;
      start = here;
    }
    longest = std::max(longest, here - start);
    level[order[k]] = count;
  }
  if (longest <= 0.25 * span) return level;
  for (std::size_t i = 0; i < values.size(); ++i)
    level[i] = std::min(9, static_cast<int>(10.0 * (values[i] - low) / span));
  return level;
}

double step_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double rounding = 1e-6 * std::max(std::abs(values.front()), std::abs(values.back()));
  double step = 1e300;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] - values[k - 1] > rounding) step = std::min(step, values[k] - values[k - 1]);
  return step < 1e300 ? step : 0.0;
}

double lattice_step_of(const std::vector<double>& values) {
  constexpr std::size_t kFewest = 16;
  constexpr double kOff = 0.02;  // of a step
  const double step = step_of(values);
  if (values.size() < kFewest || !(step > 0.0)) return 0.0;
  std::set<long long> places;
  for (const double value : values) {
    const double steps = value / step;
    if (std::abs(steps - std::round(steps)) > kOff) return 0.0;
    places.insert(std::llround(steps));
  }
  return 4 * places.size() < 3 * values.size() ? step : 0.0;
}

double rounding_of(const std::vector<BenchPoint>& points, bool forward) {
  std::vector<double> own, other;
  double sensitivity = 0.0, rows = 0.0;
  for (const BenchPoint& p : points) {
    (p.forward == forward ? own : other).push_back(p.driven_nm);
    if (p.forward != forward || !(p.driving_nm > 0.0)) continue;
    sensitivity += p.driven_nm / p.driving_nm;
    rows += 1.0;
  }
  if (!(rows > 0.0)) return 0.0;
  return std::hypot(lattice_step_of(own), sensitivity / rows * lattice_step_of(other)) /
         std::sqrt(12.0);
}

std::vector<double> values_of(const std::vector<BenchPoint>& points, double BenchPoint::*member) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const BenchPoint& p : points) values.push_back(p.*member);
  return values;
}

std::vector<int> load_levels(const std::vector<BenchPoint>& points) {
  return levels_of(values_of(points, &BenchPoint::load_nm), 0.012, 0.006);
}
std::vector<int> speed_levels(const std::vector<BenchPoint>& points) {
  return levels_of(values_of(points, &BenchPoint::speed_rpm), 0.015, 0.003);
}

std::vector<int> together(const std::vector<int>& a, const std::vector<int>& b) {
  std::map<std::pair<int, int>, int> number;
  std::vector<int> result;
  for (std::size_t i = 0; i < a.size(); ++i)
    result.push_back(
        number.emplace(std::pair(a[i], b[i]), static_cast<int>(number.size())).first->second);
  return result;
}

void take_means(Eigen::VectorXd& values, const std::vector<int>& cell) {
  std::map<int, std::pair<double, double>> sums;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    auto& [sum, count] = sums[cell[static_cast<std::size_t>(i)]];
    sum += values[i];
    count += 1.0;
  }
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto& [sum, count] = sums[cell[static_cast<std::size_t>(i)]];
    values[i] -= sum / count;
  }
}

double on_half_wave(const Eigen::VectorXd& values, int k) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    sum += values[i] * half_wave(k, i, values.size());
  return sum;
}
void take_slow(Eigen::VectorXd& values, int waves) {
  const Eigen::VectorXd from = values;
  values.array() -= from.mean();
  for (int k = 1; k <= waves; ++k) {
    const double size = on_half_wave(from, k);
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values[i] -= size * half_wave(k, i, values.size());
  }
}

std::vector<int> set_points_of(const std::vector<BenchPoint>& points) {
  std::vector<int> direction;
  for (const BenchPoint& p : points) direction.push_back(p.forward ? 1 : 0);
  return together(together(load_levels(points), speed_levels(points)), direction);
}

std::vector<int> visits_of(const std::vector<BenchPoint>& points,
                           const std::vector<int>& set_point) {
  std::vector<int> visit;
  for (std::size_t i = 0; i < points.size(); ++i)
    visit.push_back(i == 0 ? 0
                    : set_point[i] == set_point[i - 1] && points[i].file == points[i - 1].file
                        ? visit.back()
                        : visit.back() + 1);
  return visit;
}

double correlation_of_visits(const Eigen::VectorXd& size, const std::vector<int>& set_point) {
  std::map<int, double> count;
  std::map<std::pair<int, int>, double> beside;  // cells -> how often one follows the other
  for (std::size_t v = 0; v < set_point.size(); ++v) {
    count[set_point[v]] += 1.0;
    if (v == 0) continue;
    beside[{set_point[v - 1], set_point[v]}] += 1.0;
    beside[{set_point[v], set_point[v - 1]}] += 1.0;
  }
  const double n = static_cast<double>(size.size());
  double again = 0.0;
  for (const auto& [cell, visits] : count) again += visits > 1.0 ? visits : 0.0;
  // Without set points that come again only the slow course can be taken off.
  const bool means = again > 0.5 * n;
  Eigen::VectorXd error = size;
  if (means) take_means(error, set_point);
  if (size.size() >= 24) take_slow(error, kSlowWaves);
  double product = 0.0, kept = 0.0;
  for (std::size_t v = 1; v < set_point.size(); ++v) {
    product += error[static_cast<Eigen::Index>(v)] * error[static_cast<Eigen::Index>(v) - 1];
    // What taking the means off leaves of the product of neighbours.
    const int here = set_point[v], before = set_point[v - 1];
    const auto in = [&](std::size_t w, int cell) {
      return w < set_point.size() && set_point[w] == cell ? 1.0 : 0.0;
    };
    const double of_before = in(v - 1, before) + in(v + 1, before);
    const double of_here = in(v, here) + (v >= 2 ? in(v - 2, here) : 0.0);
    kept += means ? 1.0 - of_before / count[before] - of_here / count[here] +
                        beside[{before, here}] / (count[before] * count[here])
                  : 1.0;
  }
  const double freedom = means ? n - static_cast<double>(count.size()) : n;
  if (!(error.squaredNorm() > 0.0) || kept < 0.1 * n || freedom < 1.0) return 0.0;
  return std::clamp(product / kept / (error.squaredNorm() / freedom), -1.0, 1.0);
}

std::vector<double> loads_as_set(const std::vector<BenchPoint>& points,
                                 const std::vector<int>& set_point) {
  constexpr double kApart = 4.0;  // of what the loads of one set point scatter
  std::map<int, std::vector<double>> loads;
  for (std::size_t i = 0; i < points.size(); ++i) loads[set_point[i]].push_back(points[i].load_nm);
  double square = 0.0, degrees = 0.0;
  for (const auto& [point, of_point] : loads) {
    const double n = static_cast<double>(of_point.size()),
                 mean = std::accumulate(of_point.begin(), of_point.end(), 0.0) / n;
    for (const double load : of_point) square += (load - mean) * (load - mean);
    degrees += n - 1.0;
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return points[a].load_nm < points[b].load_nm; });
  if (order.empty()) return {};
  constexpr double kOneLoad = 0.03;  // of the largest
  const double least = points[order.front()].load_nm, most = points[order.back()].load_nm;
  if (most - least <= kOneLoad * std::abs(most)) return std::vector<double>(points.size(), most);
  const double apart = degrees > 0.0 ? kApart * std::sqrt(square / degrees) : 0.0;
  constexpr double kMostOfRange = 0.5;  // beyond, the loads stand at no levels
  std::vector<double> level(points.size());
  double inside = 0.0;  // of levels, together
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double load = points[order[k]].load_nm,
                 step = k > 0 ? load - points[order[k - 1]].load_nm : apart + 1.0;
    level[order[k]] = step <= apart ? level[order[k - 1]] : load;
    inside += step <= apart ? step : 0.0;
  }
  return inside < kMostOfRange * (most - least) ? level : values_of(points, &BenchPoint::load_nm);
}

PartsOfRun::PartsOfRun(const std::vector<double>& column, const std::vector<double>& value,
                       FirstLevel first)
    : first_(first) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < value.size(); ++i) {
    product_.push_back(product_.back() + column[i] * value[i]);
    square_.push_back(square_.back() + column[i] * column[i]);
    value_.push_back(value_.back() + value[i] * value[i]);
    if (i > 0) steps.push_back(std::abs(value[i] - value[i - 1]));
  }
  const double step = steps.empty() ? 0.0 : kSigmaOfMedianSize * median(steps);
  noise_ = std::max(0.5 * step * step, 1e-300);
}

double PartsOfRun::left(std::size_t from, std::size_t to) const {
  const double all = value_[to] - value_[from], own = square_[to] - square_[from];
  if ((from == 0 && first_ == FirstLevel::kNothing) || !(own > 0.0)) return all;
  const double along = product_[to] - product_[from];
  return all - along * along / own;
}

double PartsOfRun::level(std::size_t from, std::size_t to) const {
  const double own = square_[to] - square_[from];
  return own > 0.0 ? (product_[to] - product_[from]) / own : 0.0;
}

std::vector<std::size_t> PartsOfRun::likeliest_cuts() const {
  constexpr std::size_t kFewestOfAPart = 4, kMostRows = 1500;
  constexpr double kEachFigure = 6.6;  // chi-square
  const std::size_t n = rows();
  if (n > kMostRows) return {};
  const double cost =
      noise_ * (kEachFigure + 2.0 * std::log(std::max(1.0, static_cast<double>(n))));
  std::vector<double> least(n + 1, 1e300);
  std::vector<std::size_t> from(n + 1, 0), cuts;
  for (std::size_t to = kFewestOfAPart; to <= n; ++to) {
    least[to] = left(0, to);
    for (std::size_t cut = kFewestOfAPart; cut + kFewestOfAPart <= to; ++cut)
      if (const double with = least[cut] + cost + left(cut, to); with < least[to]) {
        least[to] = with;
        from[to] = cut;
      }
  }
  for (std::size_t to = n; from[to] != 0; to = from[to]) cuts.push_back(from[to]);
  std::reverse(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace trueflank::loop
