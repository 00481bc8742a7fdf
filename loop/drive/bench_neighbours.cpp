// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/bench_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/drive/bench_visits.h"

namespace trueflank::loop {
namespace {

constexpr double kLevelOfNeighbours = 0.002;  ///< chance that noise alone is called a form
constexpr std::size_t kFewestNear = 40, kMostNear = 1500;
constexpr std::size_t kNearest = 4;     ///< rows to which each is compared
constexpr std::ptrdiff_t kTooSoon = 5;  ///< rows apart in time, so that errors do not hang together
constexpr double kMostOfMiddleSize = 4.0;  ///< wild rows are held back

/// Where every row lies over one thing that was recorded: by rank 0 ... 1, or of a turn.
struct RecordedCourse {
  std::string name;
  std::vector<double> at;
  bool goes_around = false;
};

/// One or two of them, and the pairs of rows that lie near each other there.
struct NearRows {
  std::vector<std::size_t> over;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
};

class Neighbours {
 public:
  Neighbours(const BenchTable& table, double ratio, const std::vector<double>& orders,
             const Eigen::VectorXd& left)
      : table_(table), ratio_(ratio), left_(left) {
    const auto& points = table.points;
    set_point_ = set_points_of(points);
    visit_ = visits_of(points, set_point_);
    for (std::size_t i = 0; i < points.size(); ++i)
      size_.push_back(left[static_cast<Eigen::Index>(i)] / points[i].sigma_nm);
    std::vector<double> sizes;
    for (const double s : size_) sizes.push_back(std::abs(s));
    if (!sizes.empty())
      if (const double most = kMostOfMiddleSize * median(sizes); most > 0.0)
        for (double& s : size_) s = std::clamp(s, -most, most);
    hangs_ = rows_that_hang_together();
    std::size_t begin = 0;  // of the block
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool begins =
          i == 0 || points[i].file != points[i - 1].file ||
          (visit_[i] != visit_[i - 1] && i - begin >= static_cast<std::size_t>(hangs_));
      if (begins) begin = i;
      block_.push_back(i == 0 ? 0 : block_.back() + (begins ? 1 : 0));
    }
    record(orders);
  }

  SharedByNearRows run() {
    SharedByNearRows found;
    std::vector<std::vector<std::size_t>> asked;
    for (std::size_t one = 0; one < courses_.size(); ++one) {
      asked.push_back({one});
      for (std::size_t other = one + 1; other < courses_.size(); ++other)
        if (!(courses_[one].goes_around && courses_[other].goes_around))
          asked.push_back({one, other});
    }
    NearRows told;
    double least = 1e300;
    for (const std::vector<std::size_t>& over : asked) {
      const NearRows near = near_over(over);
      const double p = p_value_of(near) * static_cast<double>(asked.size());
      found.p_value = std::min(found.p_value, p);
      if (p > kLevelOfNeighbours) continue;
      // (of two where one does it, the one: it is told where both share about as much)
      constexpr double kMuchLess = 0.93;
      const double noise = noise_of(near);
      if (noise >= least * (over.size() > told.over.size() ? kMuchLess : 1.0)) continue;
      least = noise;
      told = near;
    }
    if (told.over.empty()) return found;
    const double n = static_cast<double>(size_.size());
    const double rms = std::sqrt(left_.squaredNorm() / n);
    found.noise_nm = least;
    found.share = 1.0 - least * least / (rms * rms);
    // (of sums of products of pairs, beside that of squares)
    found.noise_error_nm =
        0.5 * least * std::sqrt(2.0 / n + error_square_of_share(told)) / (1.0 - found.share);
    found.told = words(told, found);
    return found;
  }

 private:
  /// Rows after which what is left of one says nothing of the other any more: where what rows that
  /// far apart share, and twice as far, is next to nothing.
  [[nodiscard]] std::ptrdiff_t rows_that_hang_together() const {
    constexpr double kNothing = 0.05, kByChance = 1.5;
    constexpr std::size_t kFewestBlocks = 12;
    const auto& points = table_.points;
    const std::size_t n = size_.size(), most = n / kFewestBlocks;
    double square = 0.0;
    for (const double s : size_) square += s * s;
    if (!(square > 0.0)) return 1;
    std::vector<double> shared{1.0};  // of every lag
    for (std::size_t apart = 1; apart < most; ++apart) {
      for (std::size_t lag = shared.size(); lag <= 2 * apart; ++lag) {
        double product = 0.0;
        for (std::size_t i = lag; i < n; ++i)
          if (points[i].file == points[i - lag].file) product += size_[i] * size_[i - lag];
        shared.push_back(product / square);
      }
      double mean = 0.0;
      for (std::size_t lag = apart; lag <= 2 * apart; ++lag)
        mean += shared[lag] / static_cast<double>(apart + 1);
      if (mean < std::max(kNothing, kByChance / std::sqrt(static_cast<double>(n * (apart + 1)))))
        return static_cast<std::ptrdiff_t>(apart);
    }
    return static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, most));
  }

  void record(const std::vector<double>& orders) {
    const auto& points = table_.points;
    add_ranked("the speed", values_of(points, &BenchPoint::speed_rpm));
    add_ranked("the load", loads_as_set(points, set_point_));
    if (table_.has_temperature && table_.temperature_span_c > 3.0)
      add_ranked("the temperature", values_of(points, &BenchPoint::temperature_c));
    std::vector<double> before;
    for (std::size_t i = 0; i < points.size(); ++i)
      before.push_back(points[i > 0 && points[i - 1].file == points[i].file ? i - 1 : i].load_nm);
    add_ranked("the load of the row before", before);
    if (!table_.has_angle) return;
    std::vector<double> asked{1.0};
    constexpr double kFewestTurns = 2.0;
    const auto ask = [&](double order) {
      if (order * table_.turns >= kFewestTurns &&
          std::none_of(asked.begin(), asked.end(),
                       [&](double a) { return std::abs(a - order) * table_.turns < 0.5; }))
        asked.push_back(order);
    };
    ask(1.0 / ratio_);
    for (const double order : orders) ask(order);
    for (const double order : asked) {
      RecordedCourse course{order == 1.0            ? "the angle of the input"
                            : order == 1.0 / ratio_ ? "the angle of the output"
                                                    : printed("the place in a wave of %.4g per "
                                                              "turn of the input",
                                                              order),
                            {},
                            true};
      for (const BenchPoint& p : points) {
        const double turns = order * p.angle_rad / kTwoPi;
        course.at.push_back(turns - std::floor(turns));
      }
      courses_.push_back(std::move(course));
    }
  }

  /// Where few levels were run rows of one level are equally near.
  void add_ranked(const std::string& name, const std::vector<double>& values) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    if (sorted.empty() || !(sorted.back() > sorted.front())) return;
    RecordedCourse course{name, {}, false};
    for (const double v : values) {
      const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), v);
      course.at.push_back(0.5 *
                          static_cast<double>((low - sorted.begin()) + (high - sorted.begin())) /
                          static_cast<double>(sorted.size()));
    }
    courses_.push_back(std::move(course));
  }

  [[nodiscard]] bool too_soon(std::size_t i, std::size_t j) const {
    const auto& points = table_.points;
    return visit_[i] == visit_[j] ||
           (points[i].reading >= 0 && points[i].reading == points[j].reading) ||
           (points[i].file == points[j].file &&
            std::abs(static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(j)) <
                std::max(kTooSoon, hangs_));
  }

  [[nodiscard]] double apart(const std::vector<std::size_t>& over, std::size_t i,
                             std::size_t j) const {
    double square = 0.0;
    for (const std::size_t k : over) {
      double by = std::abs(courses_[k].at[i] - courses_[k].at[j]);
      if (courses_[k].goes_around) by = std::min(by, 1.0 - by);
      square += by * by;
    }
    return square;
  }

  /// Each row with the nearest of its direction; a pair once. (Of rows that are equally near those
  /// that come next: none is everyone's neighbour.)
  [[nodiscard]] NearRows near_over(const std::vector<std::size_t>& over) const {
    NearRows near{over, {}};
    const auto& points = table_.points;
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t i = 0; i < points.size(); ++i) {
      others.clear();
      for (std::size_t step = 1; step < points.size(); ++step) {
        const std::size_t j = (i + step) % points.size();
        if (points[j].forward == points[i].forward && !too_soon(i, j))
          others.emplace_back(apart(over, i, j), step);
      }
      const std::size_t count = std::min(kNearest, others.size());
      std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count),
                        others.end());
      for (std::size_t k = 0; k < count; ++k)
        near.pairs.push_back(std::minmax(i, (i + others[k].second) % points.size()));
    }
    std::sort(near.pairs.begin(), near.pairs.end());
    near.pairs.erase(std::unique(near.pairs.begin(), near.pairs.end()), near.pairs.end());
    return near;
  }

  /// Of the sum of products of pairs, were the sign of every visit, or of so many rows as hang
  /// together, by chance: by its spread, and its skewness of three rows that are all near each
  /// other.
  [[nodiscard]] double p_value_of(const NearRows& near) const {
    double sum = 0.0, square = 0.0, cube = 0.0;
    std::vector<std::vector<std::size_t>> of_row(size_.size());
    std::map<std::pair<int, int>, double> of_blocks;
    for (const auto& [i, j] : near.pairs) {
      const double product = size_[i] * size_[j];
      sum += product;
      of_blocks[{block_[i], block_[j]}] += product;
      of_row[i].push_back(j);
    }
    for (const auto& [blocks, product] : of_blocks) square += product * product;
    for (const auto& [i, j] : near.pairs)
      for (const std::size_t k : of_row[j])
        if (std::binary_search(of_row[i].begin(), of_row[i].end(), k))
          cube += 6.0 * std::pow(size_[i] * size_[j] * size_[k], 2);
    if (!(square > 0.0) || !(sum > 0.0)) return 1.0;
    return skewed_tail(sum / std::sqrt(square), cube / std::pow(square, 1.5));
  }

  /// Half the square of what pairs differ by, of each direction, in N m; what jumps between two
  /// rows held back.
  [[nodiscard]] double noise_of(const NearRows& near) const {
    constexpr double kMostOfMiddleStep = 5.0;
    const auto& points = table_.points;
    double square = 0.0;
    for (const bool forward : {true, false}) {
      std::vector<double> steps;
      for (const auto& [i, j] : near.pairs)
        if (points[i].forward == forward)
          steps.push_back(std::abs(left_[static_cast<Eigen::Index>(i)] / points[i].sigma_nm -
                                   left_[static_cast<Eigen::Index>(j)] / points[j].sigma_nm));
      double of_rows = 0.0, whole = 0.0, count = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].forward != forward) continue;
        of_rows += points[i].sigma_nm * points[i].sigma_nm;
        whole += std::pow(left_[static_cast<Eigen::Index>(i)], 2);
        count += 1.0;
      }
      if (steps.empty() || !(count > 0.0)) {
        square += whole;
        continue;
      }
      const double most = kMostOfMiddleStep * median(std::vector(steps));
      double sum = 0.0;
      for (const double step : steps) sum += std::pow(std::min(step, most), 2);
      square += std::min(whole, of_rows * 0.5 * sum / static_cast<double>(steps.size()));
    }
    return std::sqrt(square / static_cast<double>(points.size()));
  }
  [[nodiscard]] double error_square_of_share(const NearRows& near) const {
    double product = 0.0, square = 0.0;
    for (const auto& [i, j] : near.pairs) {
      product += std::pow(size_[i] * size_[j], 2);
      square += 0.5 * (size_[i] * size_[i] + size_[j] * size_[j]);
    }
    return product / std::max(square * square, 1e-300);
  }

  /// Of every row what it and its neighbours have left on average, N m at the input.
  [[nodiscard]] std::vector<double> means_of(const NearRows& near) const {
    const auto at_input = [&](std::size_t i) {
      return left_[static_cast<Eigen::Index>(i)] / (table_.points[i].forward ? ratio_ : 1.0);
    };
    std::vector<double> mean, count(size_.size(), 1.0);
    for (std::size_t i = 0; i < size_.size(); ++i) mean.push_back(at_input(i));
    for (const auto& [i, j] : near.pairs) {
      mean[i] += at_input(j);
      mean[j] += at_input(i);
      count[i] += 1.0;
      count[j] += 1.0;
    }
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] /= count[i];
    return mean;
  }

  [[nodiscard]] std::string words(const NearRows& near, const SharedByNearRows& found) const {
    std::string over = courses_[near.over.front()].name;
    if (near.over.size() > 1) over += " and " + courses_[near.over.back()].name + " together";
    const std::vector<double> mean = means_of(near);
    const auto low = static_cast<std::size_t>(std::min_element(mean.begin(), mean.end()) -
                                              mean.begin()),
               high = static_cast<std::size_t>(std::max_element(mean.begin(), mean.end()) -
                                               mean.begin());
    return "follows " + over +
           printed(": rows that are near there share %.0f %% of what is left",
                   100.0 * found.share) +
           printed(" (without it the noise is %.3g N m, +-%.2g); ", found.noise_nm,
                   2.0 * found.noise_error_nm) +
           printed("on average %.2g N m ", mean[low]) + place_of(near, low) +
           printed(", %.2g N m ", mean[high]) + place_of(near, high) +
           " (at the input; below zero the drive loses more than the model)";
  }
  [[nodiscard]] std::string place_of(const NearRows& near, std::size_t row) const {
    const BenchPoint& p = table_.points[row];
    std::string text;
    for (const std::size_t k : near.over) {
      const std::string& name = courses_[k].name;
      std::string one = printed("%.3g N m", p.load_nm);
      if (courses_[k].goes_around)
        one = printed("%.0f degrees", 360.0 * courses_[k].at[row]);
      else if (name == "the speed")
        one = printed("%.4g rpm", p.speed_rpm);
      else if (name == "the temperature")
        one = printed("%.3g C", p.temperature_c);
      else if (name == "the load of the row before")
        one = printed("%.3g N m before", table_.points[row > 0 ? row - 1 : 0].load_nm);
      text += (text.empty() ? "about " : " and ") + one;
    }
    return text + (table_.has(!p.forward) ? p.forward ? ", forward" : ", backward" : "");
  }

  const BenchTable& table_;
  const double ratio_;
  const Eigen::VectorXd& left_;
  std::vector<int> set_point_, visit_;
  std::vector<double> size_;  ///< of every row, in its noise's units
  std::ptrdiff_t hangs_ = 1;  ///< rows whose errors hang together
  std::vector<int> block_;    ///< of every row: a visit, or so many rows
  std::vector<RecordedCourse> courses_;
};

}  // namespace

SharedByNearRows ask_neighbours(const BenchTable& table, double ratio,
                                const std::vector<double>& orders, const Eigen::VectorXd& left_nm) {
  if (table.points.size() < kFewestNear || table.points.size() > kMostNear) return {};
  return Neighbours(table, ratio, orders, left_nm).run();
}

}  // namespace trueflank::loop
