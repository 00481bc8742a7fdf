// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/bench_remainder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// Chance that noise alone is called structure; the questions share it.
constexpr double kLevelOfRemainder = 0.005;
constexpr int kFlips = 1999;
/// Flips that are computed beside each other, each with its own sums: one after the other every sum waits for the one before.
constexpr std::size_t kBeside = 8;
using Beside = std::array<double, kBeside>;

/// One question: visits of one cell agree.
struct Question {
  std::string what;
  std::vector<int> cell;  ///< of every visit, from 0 on
  int cells = 0;
  int rank = 0;                           ///< the plainest answer is told
  double agreement = 0.0, p_value = 1.0;  ///< corrected for all questions
};

class Asking {
 public:
  Asking(const BenchTable& table, double ratio, const Eigen::VectorXd& left)
      : table_(table),
        ratio_(ratio),
        left_(left),
        set_point_(set_points_of(table.points)),
        visit_(visits_of(table.points, set_point_)) {
    for (const BenchPoint& p : table.points) {
      double& most = most_sigma_[p.forward ? 1 : 0];
      most = std::max(most, p.sigma_nm);
    }
    gather();
  }

  BenchRemainder run() {
    if (first_.size() < 12) return {};
    pose();
    flip();
    // A zero of the output's sensor moves the driven torque up in one direction and down in the
    // other.
    const double plain = std::min(slow_p_value(false, false), slow_p_value(true, false));
    const double with_load = std::min(slow_p_value(false, true), slow_p_value(true, true));
    const double slow = 4.0 * std::min(plain, with_load);
    slow_with_load_ = with_load < plain;
    BenchRemainder found;
    found.p_value = slow;
    for (const Question& q : questions_) found.p_value = std::min(found.p_value, q.p_value);
    found.p_value = std::min(1.0, 2.0 * found.p_value);
    if (found.p_value <= kLevelOfRemainder)
      describe(found, slow <= 0.5 * kLevelOfRemainder, 0.5 * kLevelOfRemainder);
    else
      stand_out(found);
    return found;
  }

 private:
  /// Means of visits in units of the noise, wild ones held back.
  void gather() {
    const std::size_t n = table_.points.size();
    for (std::size_t i = 0; i < n; ++i)
      if (i == 0 || visit_[i] != visit_[i - 1]) first_.push_back(i);
    std::vector<double> size;
    for (std::size_t v = 0; v < first_.size(); ++v) {
      const std::size_t end = v + 1 < first_.size() ? first_[v + 1] : n;
      double sum = 0.0;
      for (std::size_t i = first_[v]; i < end; ++i)
        sum += left_[static_cast<Eigen::Index>(i)] / table_.points[i].sigma_nm;
      size.push_back(sum / std::sqrt(static_cast<double>(end - first_[v])));
    }
    size_ = Eigen::Map<Eigen::VectorXd>(size.data(), static_cast<Eigen::Index>(size.size()));
    std::vector<double> sizes;
    for (const double s : size) sizes.push_back(std::abs(s));
    if (sizes.empty()) return;
    const double most = 4.0 * median(sizes);
    if (most > 0.0) size_ = size_.cwiseMax(-most).cwiseMin(most);
  }

  [[nodiscard]] std::vector<int> of_visits(const std::vector<int>& of_rows) const {
    std::vector<int> result;
    for (const std::size_t i : first_) result.push_back(of_rows[i]);
    return result;
  }

  void ask(const std::string& what, int rank, const std::vector<int>& of_rows) {
    const std::vector<int> cell = together(of_visits(of_rows), std::vector<int>(first_.size(), 0));
    const int cells = *std::max_element(cell.begin(), cell.end()) + 1;
    if (cells > 1) questions_.push_back({.what = what, .cell = cell, .cells = cells, .rank = rank});
  }

  void pose() {
    const auto& points = table_.points;
    std::vector<int> direction, file, way;
    for (const BenchPoint& p : points) {
      direction.push_back(p.forward ? 1 : 0);
      file.push_back(p.file);
    }
    const std::vector<int> load = load_levels(points), speed = speed_levels(points);
    ask("load", 0, load);
    ask("speed", 0, speed);
    if (table_.has_temperature && table_.temperature_span_c > 3.0)
      ask("temperature", 1, levels_of(values_of(points, &BenchPoint::temperature_c), 0.0, 0.02));
    ask("direction", 1, direction);
    ask("file", 1, together(file, direction));
    for (const BenchPoint& p : points) way.push_back(p.way);
    ask("way of loading (rising or falling)", 1, together(way, direction));
    if (is_swept(way))
      ask("load, otherwise while it rises and while it falls,", 2, together(way, load));
    ask("load, otherwise in each direction,", 2, together(load, direction));
    ask("speed, otherwise in each direction,", 2, together(speed, direction));
    if (table_.has_angle) {
      ask("angle of the input", 1, sectors(1.0));
      if (table_.turns > 1.01) ask("angle of the output", 1, sectors(1.0 / ratio_));
    }
    // What a drive or a sensor remembers: oil that was flung away, a cell that lags.
    ask("load of the set point before", 1, before_of(load));
    ask("speed of the set point before", 1, before_of(speed));
    ask("load and the speed together", 3, set_point_);
  }

  /// True where the load goes up and down in steps, and not anyhow.
  [[nodiscard]] bool is_swept(const std::vector<int>& way) const {
    constexpr std::size_t kFewestTurns = 4, kVisitsEach = 3;
    const std::vector<int> of_each = of_visits(way);
    std::size_t turns = 0;
    for (std::size_t v = 1; v < of_each.size(); ++v) turns += of_each[v] != of_each[v - 1] ? 1 : 0;
    return turns >= kFewestTurns && kVisitsEach * turns <= of_each.size();
  }

  /// The level that each visit's predecessor had.
  [[nodiscard]] std::vector<int> before_of(const std::vector<int>& level) const {
    std::vector<int> before(level.size(), 0);
    for (std::size_t v = 0; v < first_.size(); ++v) {
      const std::size_t end = v + 1 < first_.size() ? first_[v + 1] : level.size();
      std::fill(before.begin() + static_cast<std::ptrdiff_t>(first_[v]),
                before.begin() + static_cast<std::ptrdiff_t>(end),
                level[first_[v] == 0 ? 0 : first_[v] - 1]);
    }
    return before;
  }

  /// The part of a turn, so many times per turn of the input, in which every row lies.
  [[nodiscard]] std::vector<int> sectors(double order) const {
    constexpr double kParts = 12.0;
    std::vector<int> part;
    for (const BenchPoint& p : table_.points) {
      const double turns = order * p.angle_rad / kTwoPi;
      part.push_back(static_cast<int>(kParts * (turns - std::floor(turns))));
    }
    return part;
  }

  /// Sum over pairs of one cell, but for those so near in time that their errors may hang together. Of as many flips as
  /// there are, each as if it were alone; `sums` is room for them.
  [[nodiscard]] static Beside agreement(const Question& q, const std::vector<Beside>& size, int near,
                                        std::vector<Beside>& sums) {
    sums.assign(static_cast<std::size_t>(q.cells), Beside{});
    Beside pairs{};
    for (std::size_t v = 0; v < size.size(); ++v) {
      const Beside& own = size[v];
      Beside& of_cell = sums[static_cast<std::size_t>(q.cell[v])];
      for (std::size_t i = 0; i < kBeside; ++i) {
        pairs[i] += 2.0 * own[i] * of_cell[i];
        of_cell[i] += own[i];
      }
      for (std::size_t w = v - std::min(v, static_cast<std::size_t>(near)); w < v; ++w)
        if (q.cell[w] == q.cell[v])
          for (std::size_t i = 0; i < kBeside; ++i) pairs[i] -= 2.0 * own[i] * size[w][i];
    }
    return pairs;
  }

  void flip() {
    const double n = static_cast<double>(size_.size());
    // Of dwells the table knows it from the rows inside them.
    const bool dwells = !table_.drifts && static_cast<double>(left_.size()) > 5.0 * n;
    const double correlation = dwells ? 0.0 : correlation_of_visits(size_, of_visits(set_point_));
    const bool hangs = correlation > std::max(0.12, 1.5 / std::sqrt(n));
    const int block =
        hangs ? std::clamp(static_cast<int>(
                               std::ceil(std::log(0.15) / std::log(std::min(0.9, correlation)))),
                           2, std::max(2, static_cast<int>(n / 16.0)))
              : 1;
    std::mt19937_64 random(20261122);
    const auto asked = static_cast<Eigen::Index>(questions_.size());
    const int near = hangs ? block : 0;
    std::vector<Beside> flipped(first_.size()), sums;
    for (std::size_t v = 0; v < first_.size(); ++v) flipped[v].fill(size_[static_cast<Eigen::Index>(v)]);
    for (Question& q : questions_) q.agreement = agreement(q, flipped, near, sums)[0];
    const int flips = n > 1000.0 ? kFlips / 4 : kFlips;
    Eigen::MatrixXd of_flips(flips, asked);
    for (int first = 0; first < flips; first += static_cast<int>(kBeside)) {
      const int count = std::min(static_cast<int>(kBeside), flips - first);
      for (int i = 0; i < count; ++i) {
        const auto shift = static_cast<Eigen::Index>(random() % static_cast<std::uint64_t>(block));
        double sign = 1.0;
        std::map<int, double> of_reading;  // what shares the rounding of one reading turns together
        for (Eigen::Index v = 0; v < size_.size(); ++v) {
          if (v == 0 || (v + shift) % block == 0) sign = (random() & 1) != 0 ? 1.0 : -1.0;
          const int reading = table_.points[first_[static_cast<std::size_t>(v)]].reading;
          flipped[static_cast<std::size_t>(v)][static_cast<std::size_t>(i)] =
              size_[v] * (reading < 0 ? sign : of_reading.emplace(reading, sign).first->second);
        }
      }
      for (Eigen::Index k = 0; k < asked; ++k) {
        const Beside found = agreement(questions_[static_cast<std::size_t>(k)], flipped, near, sums);
        for (int i = 0; i < count; ++i) of_flips(first + i, k) = found[static_cast<std::size_t>(i)];
      }
    }
    judge_against(of_flips);
  }

  /// Each against its own flips; beyond the largest of these by their spread and skewness, never
  /// below a tenth of what flips can tell.
  void judge_against(const Eigen::MatrixXd& of_flips) {
    const double flips = static_cast<double>(of_flips.rows());
    for (std::size_t k = 0; k < questions_.size(); ++k) {
      Question& q = questions_[k];
      if (!(q.agreement > 0.0)) continue;
      const auto values = of_flips.col(static_cast<Eigen::Index>(k)).array();
      const double mean = values.mean(), spread = std::sqrt((values - mean).square().mean());
      if (!(spread > 0.0)) continue;
      const double tail =
          skewed_tail((q.agreement - mean) / spread, ((values - mean) / spread).cube().mean());
      const double above = static_cast<double>((values >= q.agreement).count());
      const double asked = static_cast<double>(questions_.size());
      q.p_value = std::min(1.0, asked * std::max({tail, above / flips, 0.1 / flips}));
    }
  }

  /// Mean square of the half waves beside the slow ones; of errors that hang together these fall
  /// off, and the slow ones are as much larger by chance.
  [[nodiscard]] static double beside_slow(const Eigen::VectorXd& size, int first, int last) {
    constexpr double kLeastShared = 0.25, kByChance = 3.0;
    // (of errors of which each row keeps a part of the one before: a power of how far the nearer
    // half waves stand above the others)
    constexpr double kPower = 1.2;
    const int middle = first + (last - first) / 3;
    double near = 0.0, far = 0.0;
    for (int k = first; k <= last; ++k)
      (k < middle ? near : far) += std::pow(on_half_wave(size, k), 2);
    const double beside = (near + far) / (last - first + 1);
    Eigen::VectorXd fast = size;
    take_slow(fast, 2 * kSlowWaves);
    const Eigen::Index n = fast.size();
    const double shared = fast.head(n - 1).dot(fast.tail(n - 1)) / fast.squaredNorm();
    if (middle == first || !(far > 0.0) ||
        !(shared > std::max(kLeastShared, kByChance / std::sqrt(static_cast<double>(n)))))
      return beside;
    return beside *
           std::pow(std::max(1.0, near / (middle - first) / (far / (last - middle + 1))), kPower);
  }

  /// The slowest half waves over the run against those beside them, of what set points do not
  /// explain: of what is left, or of that in proportion to the load, as friction changes.
  [[nodiscard]] double slow_p_value(bool opposite, bool with_load) const {
    if (size_.size() < 24) return 1.0;
    Eigen::VectorXd size = size_;
    // The rounding of a coarse reading is no course over time.
    std::vector<int> reading;
    for (const std::size_t i : first_) reading.push_back(table_.points[i].reading);
    if (*std::max_element(reading.begin(), reading.end()) >= 0) take_means(size, reading);
    for (std::size_t v = 0; v < first_.size(); ++v) {
      const BenchPoint& p = table_.points[first_[v]];
      if (opposite && !p.forward) size[static_cast<Eigen::Index>(v)] *= -1.0;
      if (with_load) size[static_cast<Eigen::Index>(v)] *= p.load_nm / table_.most_load_nm;
    }
    // A course that comes and goes within a part of a long run needs twice as many; of a short one
    // errors that hang together would look so.
    constexpr Eigen::Index kLongRun = 96;
    const int first = 2 * kSlowWaves + 1;
    const int last = std::min<int>(first + 23, static_cast<int>(size_.size()) / 2);
    double slow = 0.0, p_value = 1.0;
    const double beside = beside_slow(size, first, last);
    if (!(beside > 0.0)) return 1.0;
    for (int k = 1; k <= 2 * kSlowWaves; ++k) {
      slow += std::pow(on_half_wave(size, k), 2);
      if (k == kSlowWaves || (k == 2 * kSlowWaves && size.size() >= kLongRun))
        p_value = std::min(p_value, f_tail(slow / k / beside, k, last - first + 1));
    }
    return p_value;
  }

  /// A row's error in the largest one: 1, or less where it grows with the load or the speed.
  [[nodiscard]] double weight_of(Eigen::Index row) const {
    return table_.points[static_cast<std::size_t>(row)].sigma_nm / most_sigma_[of(row)];
  }
  [[nodiscard]] std::size_t of(Eigen::Index row) const {
    return table_.points[static_cast<std::size_t>(row)].forward ? 1 : 0;
  }

  /// The scatter of a direction's rows about their own kind, wild ones without weight: of repeated
  /// set points, of dwells, else of all.
  [[nodiscard]] double scatter_of(const std::vector<Eigen::Index>& rows,
                                  const std::vector<int>& kind) const {
    std::map<int, std::vector<double>> kinds;
    for (const Eigen::Index i : rows)
      kinds[kind[static_cast<std::size_t>(i)]].push_back(left_[i] / weight_of(i));
    std::vector<double> off;
    for (const auto& [number, values] : kinds) {
      const double n = static_cast<double>(values.size());
      if (values.size() < 2) continue;
      // Of many the middle one: a few far off move their mean.
      const bool many = values.size() >= 5;
      std::vector<double> sorted = values;
      std::nth_element(sorted.begin(),
                       sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                       sorted.end());
      const double mean =
          many ? sorted[sorted.size() / 2] : std::accumulate(values.begin(), values.end(), 0.0) / n;
      for (const double v : values) off.push_back(std::abs(v - mean) * std::sqrt(n / (n - 1.0)));
    }
    if (2 * off.size() < rows.size()) return kNaN;
    // By the middle and by the upper end: coarse readings are often equal.
    const auto at = [&](double share, double of_normal) {
      return nth_smallest(off, static_cast<std::size_t>(share * static_cast<double>(off.size()))) / of_normal;
    };
    return std::max(at(0.5, 0.6745), at(0.7, 1.0364));
  }

  /// More is left than the rows' own scatter: a few set points that lie far off agree with too few
  /// others to be seen by agreement.
  void stand_out(BenchRemainder& found) const {
    // Of noise with long tails or in proportion to the load it is up to 1.6, of coarse readings 1.9.
    constexpr double kMuchMore = 2.0;
    const std::vector<int> all(left_.size(), 0);
    double times = 0.0, noise = 0.0;
    for (const bool forward : {true, false}) {
      const std::vector<Eigen::Index> rows = rows_of(forward);
      if (rows.size() < 8) continue;
      double scatter = scatter_of(rows, set_point_);
      if (const double of_all = scatter_of(rows, all); !(scatter < of_all)) scatter = of_all;
      std::vector<double> driven;
      for (const Eigen::Index i : rows)
        driven.push_back(table_.points[static_cast<std::size_t>(i)].driven_nm);
      scatter = std::max({scatter, step_of(std::move(driven)) / std::sqrt(12.0),
                          rounding_of(table_.points, forward)});
      double square = 0.0;
      for (const Eigen::Index i : rows) {
        square += std::pow(left_[i] / weight_of(i), 2);
        noise += std::pow(scatter * weight_of(i), 2);
      }
      const double rms = std::sqrt(square / static_cast<double>(rows.size()));
      times = std::max(times, rms / std::max(scatter, 1e-9 * left_.cwiseAbs().maxCoeff() + 1e-300));
    }
    if (times < kMuchMore) return;
    found.noise_nm = std::sqrt(noise / static_cast<double>(left_.size()));
    found.structure_nm = left_;
    found.share = 1.0 - 1.0 / (times * times);
    Eigen::Index worst = 0;
    left_.cwiseAbs().maxCoeff(&worst);
    const BenchPoint& p = table_.points[static_cast<std::size_t>(worst)];
    found.follows = "what is left is " + printed("%.2g", times) +
                    " times the scatter of the rows and stands at few of them: most " +
                    printed("%.2g", left_[worst] / (p.forward ? ratio_ : 1.0)) +
                    " N m at the input, " + (p.forward ? "forward" : "backward") +
                    printed(" at %.3g N m and %.4g rpm", p.load_nm, p.speed_rpm) + " (line " +
                    std::to_string(p.line) + ")";
  }

  void describe(BenchRemainder& found, bool slow, double level) const {
    double most = 0.0;
    for (const Question& q : questions_)
      if (q.p_value <= level) most = std::max(most, q.agreement);
    const Question* told = nullptr;
    for (const Question& q : questions_)
      if (q.p_value <= level && q.agreement >= 0.6 * most &&
          (told == nullptr || q.rank < told->rank ||
           (q.rank == told->rank && q.agreement > told->agreement)))
        told = &q;
    // Where the time tells more than a mean that differs between ways, files or directions.
    if (slow && told != nullptr && told->rank == 1) told = nullptr;
    // Set points that come again hold all of load, speed and direction.
    const bool each = set_points_come_again() &&
                      std::any_of(questions_.begin(), questions_.end(), [&](const Question& q) {
                        return q.p_value <= level && q.rank != 1;
                      });
    Eigen::VectorXd noise = left_;
    double fitted = 0.0;
    for (int round = 0; round < 3; ++round) {
      fitted = 0.0;
      for (const Question& q : questions_) {
        const bool last = &q == &questions_.back();
        if (each && q.rank != 1 ? !last : q.p_value > level) continue;
        const std::vector<int> cell = of_rows(q.cell);
        for (const bool forward : {true, false}) take_means_of(noise, cell, forward, fitted);
      }
      if (slow) {
        for (const bool forward : {true, false}) take_slow_of(noise, forward);
        fitted += 2.0 * (1.0 + 2.0 * kSlowWaves);
      }
    }
    found.structure_nm = left_ - noise;
    const double n = static_cast<double>(left_.size());
    found.share = 1.0 - noise.squaredNorm() / std::max(left_.squaredNorm(), 1e-300);
    found.noise_nm = std::sqrt(noise.squaredNorm() / std::max(1.0, n - fitted));
    const double times = std::sqrt(left_.squaredNorm() / n) / std::max(found.noise_nm, 1e-300);
    constexpr double kHardly = 1.1;
    found.follows =
        (times < kHardly ? "what is left is mostly scatter of single rows, but a small part of it "
                         : "what is left is " + printed("%.2g", times) + " times the noise and ") +
        (told != nullptr ? follows_in_words(*told) : slow_in_words(noise));
  }

  [[nodiscard]] bool set_points_come_again() const {
    return !questions_.empty() &&
           4 * questions_.back().cells <= 3 * static_cast<int>(first_.size());
  }
  [[nodiscard]] std::vector<int> of_rows(const std::vector<int>& of_visits) const {
    std::vector<int> result;
    for (std::size_t v = 0; v < first_.size(); ++v)
      result.resize(v + 1 < first_.size() ? first_[v + 1] : table_.points.size(), of_visits[v]);
    return result;
  }
  [[nodiscard]] std::vector<Eigen::Index> rows_of(bool forward) const {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < table_.points.size(); ++i)
      if (table_.points[i].forward == forward) rows.push_back(static_cast<Eigen::Index>(i));
    return rows;
  }
  void take_means_of(Eigen::VectorXd& values, const std::vector<int>& cell, bool forward,
                     double& fitted) const {
    const std::vector<Eigen::Index> rows = rows_of(forward);
    Eigen::VectorXd part = values(rows);
    std::vector<int> cells;
    for (const Eigen::Index i : rows) cells.push_back(cell[static_cast<std::size_t>(i)]);
    take_means(part, cells);
    values(rows) = part;
    std::sort(cells.begin(), cells.end());
    fitted += static_cast<double>(std::unique(cells.begin(), cells.end()) - cells.begin());
  }
  void take_slow_of(Eigen::VectorXd& values, bool forward) const {
    const std::vector<Eigen::Index> rows = rows_of(forward);
    if (rows.empty()) return;
    Eigen::VectorXd part = values(rows);
    if (slow_with_load_)
      take_slow_with_load(part, rows);
    else
      take_slow(part, 2 * kSlowWaves);
    values(rows) = part;
  }

  /// Least squares of the slow half waves times the load.
  void take_slow_with_load(Eigen::VectorXd& values, const std::vector<Eigen::Index>& rows) const {
    const Eigen::Index n = values.size(), columns = std::min<Eigen::Index>(2 * kSlowWaves + 1, n);
    Eigen::MatrixXd x(n, columns);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double load =
          table_.points[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)])].load_nm;
      for (Eigen::Index k = 0; k < columns; ++k)
        x(i, k) = load * std::cos(kPi * static_cast<double>(k) * (static_cast<double>(i) + 0.5) /
                                  static_cast<double>(n));
    }
    values -= x * least_squares(x, values);
  }

  /// Mean of what is left, as torque at the input, of the cells in which it is lowest and highest.
  [[nodiscard]] std::string follows_in_words(const Question& q) const {
    std::map<int, std::tuple<double, double, std::size_t>> cells;
    const std::vector<int> cell = of_rows(q.cell);
    for (std::size_t i = 0; i < table_.points.size(); ++i) {
      auto& [sum, count, at] = cells.try_emplace(cell[i], 0.0, 0.0, i).first->second;
      sum += left_[static_cast<Eigen::Index>(i)] / (table_.points[i].forward ? ratio_ : 1.0);
      count += 1.0;
    }
    const auto mean = [](const auto& c) { return std::get<0>(c.second) / std::get<1>(c.second); };
    const auto [low, high] =
        std::minmax_element(cells.begin(), cells.end(),
                            [&](const auto& a, const auto& b) { return mean(a) < mean(b); });
    const auto words = [&](const auto& c) {
      return printed("%.2g", mean(c)) + " N m " +
             place_in_words(q, table_.points[std::get<2>(c.second)]);
    };
    const std::string what = q.what.ends_with(',') ? q.what.substr(0, q.what.size() - 1) : q.what;
    return "follows the " + what + ": on average " + words(*low) + ", " + words(*high) +
           " (at the input; below zero the drive loses more than the model)";
  }
  [[nodiscard]] std::string place_in_words(const Question& q, const BenchPoint& p) const {
    const std::string way = p.forward ? "forward" : "backward";
    const std::string load = printed("%.3g", p.load_nm) + " N m",
                      speed = printed("%.4g", p.speed_rpm) + " rpm";
    if (q.what == "direction") return way;
    if (q.what == "file") return way + " in file " + std::to_string(p.file + 1);
    if (q.what.starts_with("angle")) {
      const double turns = p.angle_rad / (q.what.ends_with("output") ? ratio_ : 1.0) / kTwoPi;
      return printed("at %.0f degrees",
                     30.0 * std::floor(12.0 * (turns - std::floor(turns))) + 15.0);
    }
    if (q.what == "temperature") return "at " + printed("%.3g", p.temperature_c) + " C";
    if (q.what == "load") return "at " + load;
    if (q.what == "speed") return "at " + speed;
    if (q.what.ends_with("before")) {
      const BenchPoint& before = &p == &table_.points.front() ? p : (&p)[-1];
      return "after " + (q.what.front() == 'l' ? printed("%.3g", before.load_nm) + " N m"
                                               : printed("%.4g", before.speed_rpm) + " rpm");
    }
    if (q.what.front() == 'w')
      return way + (p.way < 0 ? " falling" : p.way > 0 ? " rising" : " at the start");
    if (q.what.find("rises") != std::string::npos)
      return (p.way < 0 ? "falling at " : "rising at ") + load;
    if (q.rank == 2) return way + " at " + (q.what.front() == 's' ? speed : load);
    return way + " at " + load + " and " + speed;
  }
  /// Where on the run it is lowest and highest.
  [[nodiscard]] std::string slow_in_words(const Eigen::VectorXd& noise) const {
    const Eigen::VectorXd slow = left_ - noise;
    Eigen::Index low = 0, high = 0;
    slow.minCoeff(&low);
    slow.maxCoeff(&high);
    const auto at = [&](Eigen::Index i) {
      const BenchPoint& p = table_.points[static_cast<std::size_t>(i)];
      return printed("%.2g", slow[i] / (p.forward ? ratio_ : 1.0)) + " N m in line " +
             std::to_string(p.line);
    };
    if (slow_with_load_)
      return "moves slowly over the run in proportion to the load: " + at(low) + ", " + at(high) +
             " (at the input): friction that changes (wear, running in, another lubricant), or a "
             "gain that drifts";
    return "moves slowly over the run: " + at(low) + ", " + at(high) +
           " (at the input): a zero that wanders or jumps, or warmth";
  }

  const BenchTable& table_;
  const double ratio_;
  const Eigen::VectorXd& left_;
  const std::vector<int> set_point_, visit_;
  std::array<double, 2> most_sigma_{};  ///< backward, forward
  std::vector<std::size_t> first_;  ///< row of every visit
  Eigen::VectorXd size_;            ///< of every visit, in its noise's units
  std::vector<Question> questions_;
  bool slow_with_load_ = false;  ///< what moves slowly is in proportion to the load
};

}  // namespace

BenchRemainder ask_remainder(const BenchTable& table, double ratio,
                             const Eigen::VectorXd& left_nm) {
  return Asking(table, ratio, left_nm).run();
}

}  // namespace trueflank::loop
