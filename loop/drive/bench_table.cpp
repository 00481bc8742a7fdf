// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/bench_table.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/drive/bench_visits.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewestRows = 8;
/// A row this many sigma off a smooth fit is an outlier, where few are.
constexpr double kOutlier = 6.0;
constexpr double kMostOutliers = 0.03;
/// So many of them at one set point are no chance.
constexpr int kComesAgain = 3;

/// Huber regression of one direction's driven torque on powers of load, speed, temperature.
/// Rows weigh by `growth`, the error of each in the direction's.
double fit_direction(const std::vector<BenchPoint>& points, bool forward,
                     const std::vector<double>& growth, std::vector<double>& residual) {
  std::vector<int> rows;
  double load = 1e-300, speed = 1e-300, middle_temperature = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].forward == forward) {
      rows.push_back(static_cast<int>(i));
      load = std::max(load, points[i].load_nm);
      speed = std::max(speed, points[i].speed_rpm);
      if (!std::isnan(points[i].temperature_c)) middle_temperature += points[i].temperature_c;
    }
  if (rows.empty()) return kNaN;
  const auto n = static_cast<Eigen::Index>(rows.size());
  middle_temperature /= static_cast<double>(n);
  const int columns = n >= 40 ? 12 : n >= 16 ? 6 : 3;
  Eigen::MatrixXd x(n, columns);
  Eigen::VectorXd y(n), w = Eigen::VectorXd::Ones(n);
  for (Eigen::Index r = 0; r < n; ++r) {
    const BenchPoint& p = points[rows[r]];
    const double t = p.load_nm / load, v = p.speed_rpm / speed;
    const double c =
        std::isnan(p.temperature_c) ? 0.0 : 0.02 * (p.temperature_c - middle_temperature);
    const double all[12] = {1.0,       t,   v, t * t, t * v, v * v,
                            t * t * t, v * v * v, c, c * v, c * t, std::exp(-5.0 * v)};
    const double own = growth[static_cast<std::size_t>(rows[r])];
    for (int k = 0; k < columns; ++k) x(r, k) = all[k] / own;
    y[r] = p.driven_nm / own;
  }
  Eigen::VectorXd left = y;
  double sigma = 0.0;
  for (int round = 0; round < 12; ++round) {
    Eigen::MatrixXd gram = x.transpose() * w.asDiagonal() * x;
    gram.diagonal().array() += 1e-9 * gram.diagonal().maxCoeff();
    left = y - x * symmetric_solution(gram, x.transpose() * w.asDiagonal() * y);
    std::vector<double> size(n);
    for (Eigen::Index r = 0; r < n; ++r) size[r] = std::abs(left[r]);
    sigma = kSigmaOfMedianSize * median(size) *
            std::sqrt(static_cast<double>(n) / std::max<double>(1.0, static_cast<double>(n - columns)));
    for (Eigen::Index r = 0; r < n; ++r)
      w[r] = std::abs(left[r]) > 2.0 * sigma ? 2.0 * sigma / std::abs(left[r]) : 1.0;
  }
  for (Eigen::Index r = 0; r < n; ++r) residual[rows[r]] = left[r] * growth[rows[r]];
  // What stands on a few steps scatters by these: the middle of its sizes is next to nothing.
  sigma = std::max(sigma, rounding_of(points, forward));
  // Data without noise: far below any sensor, so that weights stay finite.
  return std::max(sigma, 1e-9 * y.cwiseAbs().maxCoeff() + 1e-300);
}

int count_levels(const BenchTable& table, double BenchPoint::*member) {
  constexpr int kMost = 8;
  std::vector<double> values;
  for (const BenchPoint& p : table.points) values.push_back(p.*member);
  std::sort(values.begin(), values.end());
  const double apart = 0.04 * (values.back() - values.front());
  int levels = 1;
  double level = values.front();
  for (const double value : values)
    if (value - level > apart) {
      level = value;
      ++levels;
    }
  return std::min(levels, kMost);
}

class TableMaker {
 public:
  TableMaker(const DriveModel& model, BenchData data) : model_(model), data_(std::move(data)) {}

  ResultAll<BenchTable> make() {
    table_.notes = data_.notes;
    table_.files = data_.files;
    if (Errors errors = settle_signs(data_, table_.notes); !errors.empty())
      return fail_all(std::move(errors));
    if (Errors errors = refuse_no_torque(data_); !errors.empty())
      return fail_all(std::move(errors));
    Impossible swapped = Impossible::kNothing;
    if (Errors errors = judge_units(model_, data_, swapped); !errors.empty())
      return fail_all(std::move(errors));
    undo(swapped);
    leave_out_repeated_rows();
    take_points();
    if (table_.points.size() < kFewestRows)
      return fail_all({{.code = ErrorCode::kOutOfRange,
                        .message = "the bench data hold " + std::to_string(table_.points.size()) +
                                   " usable rows",
                        .remedy = "at least " + std::to_string(kFewestRows) +
                                  "; for a few numbers the quantity,value form",
                        .file = data_.files.empty() ? "" : data_.files.front()}});
    SmoothFit fit = smooth_fit(table_.points);
    if (leave_out_outliers(fit)) fit = smooth_fit(table_.points);
    for (std::size_t i = 0; i < table_.points.size(); ++i) {
      BenchPoint& p = table_.points[i];
      p.carried_nm = (p.forward ? p.driven_nm - fit.residual_nm[i] : p.driving_nm) / model_.ratio;
    }
    for (std::size_t i = 0; i < table_.points.size(); ++i)
      if (std::isnan(table_.points[i].sigma_nm)) table_.points[i].sigma_nm = fit.sigma_nm[i];
    note_places(table_.points);
    assign_blocks(table_, fit);
    measure_extent(table_);
    if (swapped == Impossible::kNothing) look_for_gains();
    return std::move(table_);
  }

 private:
  void undo(Impossible swapped) {
    table_.impossible = swapped;
    if (swapped == Impossible::kSwappedColumns) {
      for (BenchRow& row : data_.rows) std::swap(row.input_nm, row.output_nm);
      table_.impossible_text =
          "input_torque_nm and output_torque_nm are interchanged: the input's is the larger by the "
          "square of the ratio than the drive can make it";
    } else if (swapped == Impossible::kSwappedDirections) {
      for (BenchRow& row : data_.rows) row.forward = !row.forward;
      table_.impossible_text =
          "forward and backward are interchanged: as labelled, every row gains the power that the drive "
          "should lose";
    }
  }

  /// A row that stands twice to the last digit is one measurement; but of coarse readings, of which
  /// rows that differ in one torque alone are about as many, rows are alike by chance.
  void leave_out_repeated_rows() {
    constexpr double kByChance = 0.1;  // of the rows that stand twice
    using Key = std::array<double, 6>;
    const auto known = [](double value) { return std::isnan(value) ? -1e300 : value; };
    constexpr std::size_t kInput = 2, kOutput = 3;
    std::map<Key, const BenchRow*> first;
    std::array<std::map<Key, double>, 2> without;  // of an input, of an output
    std::vector<BenchRow> once;
    std::map<int, std::pair<int, std::string>> repeated;  // by file: how many, an example
    double alike = 0.0, nearly = 0.0;
    for (const BenchRow& row : data_.rows) {
      Key key{row.forward ? 1.0 : 0.0,  row.speed_rpm,       row.input_nm, row.output_nm,
              known(row.temperature_c), known(row.angle_deg)};
      const auto [at, is_new] = first.try_emplace(key, &row);
      if (is_new) {
        once.push_back(row);
        for (const std::size_t torque : {kInput, kOutput}) {
          Key other = key;
          other[torque] = 0.0;
          if (++without[torque - kInput][other] > 1.0) nearly += 1.0;
        }
        continue;
      }
      alike += 1.0;
      auto& [rows, example] = repeated[row.file];
      if (rows++ == 0)
        example = "line " + std::to_string(row.line) + " is line " +
                  std::to_string(at->second->line) +
                  (at->second->file == row.file
                       ? ""
                       : " of " + data_.files[static_cast<std::size_t>(at->second->file)]) +
                  " again";
    }
    if (repeated.empty() || nearly > kByChance * alike) return;
    for (const auto& [file, rows] : repeated)
      table_.notes.push_back(data_.files[static_cast<std::size_t>(file)] + ": " +
                             std::to_string(rows.first) +
                             (rows.first == 1 ? " row stands" : " rows stand") +
                             " twice to the last digit, and count once (" + rows.second + ")");
    data_.rows = std::move(once);
  }

  /// Few rows of a file without a temperature have it from the rows beside them, evenly in between:
  /// else the whole bench would be one without.
  void fill_temperatures() {
    constexpr double kMost = 0.05;  // of the rows of a file
    std::vector<BenchPoint>& points = table_.points;
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
      std::vector<std::size_t> known;
      for (end = begin; end < points.size() && points[end].file == points[begin].file; ++end)
        if (!std::isnan(points[end].temperature_c)) known.push_back(end);
      const std::size_t missing = end - begin - known.size();
      if (missing == 0 || static_cast<double>(missing) > kMost * static_cast<double>(end - begin))
        continue;
      for (std::size_t i = begin; i < end; ++i) {
        if (!std::isnan(points[i].temperature_c)) continue;
        const auto after = std::lower_bound(known.begin(), known.end(), i);
        const std::size_t to = after == known.end() ? known.back() : *after,
                          from = after == known.begin() ? to : *std::prev(after);
        const double share =
            to > from ? static_cast<double>(i - from) / static_cast<double>(to - from) : 0.0;
        points[i].temperature_c = points[from].temperature_c +
                                  share * (points[to].temperature_c - points[from].temperature_c);
      }
      table_.notes.push_back(data_.files[static_cast<std::size_t>(points[begin].file)] + ": " +
                             std::to_string(missing) + (missing == 1 ? " row has" : " rows have") +
                             " no temperature: it is taken from the rows beside");
    }
  }

  void take_points() {
    double before = kNaN, turns = 0.0;
    int file = -1;
    bool wrapped = false;
    double least = 1e300, most = -1e300;
    for (const BenchRow& row : data_.rows) {
      BenchPoint p;
      p.forward = row.forward;
      p.speed_rpm = row.speed_rpm;
      p.driving_nm = row.forward ? row.input_nm : row.output_nm;
      p.driven_nm = row.forward ? row.output_nm : row.input_nm;
      p.load_nm = row.forward ? row.input_nm : row.output_nm / model_.ratio;
      p.temperature_c = row.temperature_c;
      p.sigma_nm = row.sigma_nm;
      p.file = row.file;
      p.line = row.line;
      p.angle_rad = rad_from_deg(row.angle_deg);
      if (!std::isnan(row.angle_deg)) {
        least = std::min(least, row.angle_deg);
        most = std::max(most, row.angle_deg);
        if (row.file == file && row.angle_deg < before - 180.0) wrapped = true;
        before = row.angle_deg;
        file = row.file;
      }
      table_.points.push_back(p);
    }
    fill_temperatures();
    std::map<int, std::pair<double, double>> seen;  // file: rows so far, rows
    for (const BenchPoint& p : table_.points) seen[p.file].second += 1.0;
    for (BenchPoint& p : table_.points) {
      auto& [so_far, rows] = seen[p.file];
      p.taken = so_far / std::max(1.0, rows - 1.0);
      so_far += 1.0;
    }
    note_history(table_.points);
    turns = most > least ? (most - least) / 360.0 : 0.0;
    const auto known = [&](double BenchPoint::*value) {
      return std::none_of(table_.points.begin(), table_.points.end(),
                          [&](const BenchPoint& p) { return std::isnan(p.*value); });
    };
    table_.has_temperature = known(&BenchPoint::temperature_c);
    table_.has_angle = known(&BenchPoint::angle_rad) && turns > 0.5;
    table_.turns = turns;
    if (table_.has_angle && (turns > 1.01 || !wrapped)) measure_swing();
    if (table_.has_angle && turns <= 1.0 && wrapped)
      table_.notes.emplace_back(
          "input_angle_deg starts again every turn: only whole orders of the input can be found; an angle "
          "that counts on would show carrier, planets and output too");
  }

  /// An angle that goes on to one side is a time, and says nothing of its own.
  void measure_swing() {
    constexpr double kToOneSide = 0.8;
    const auto& points = table_.points;
    if (points.back().file != points.front().file) return;
    double low = 1e300, high = -1e300, way = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      low = std::min(low, points[i].angle_rad);
      high = std::max(high, points[i].angle_rad);
      if (i > 0) way += std::abs(points[i].angle_rad - points[i - 1].angle_rad);
    }
    if (std::abs(points.back().angle_rad - points.front().angle_rad) > kToOneSide * way) return;
    table_.least_angle_rad = low;
    table_.swing_rad = high - low;
  }

  /// True where rows were left out.
  bool leave_out_outliers(const SmoothFit& fit) {
    std::vector<std::size_t> far;
    for (std::size_t i = 0; i < table_.points.size(); ++i) {
      if (std::abs(fit.residual_nm[i]) > kOutlier * fit.sigma_nm[i]) far.push_back(i);
    }
    // Neighbours that lie off to the same side, about as far, are no slips.
    const auto alike = [&](std::size_t k, std::size_t other) {
      if (far[k] + 1 != far[other] && far[other] + 1 != far[k]) return false;
      const double share = fit.residual_nm[far[k]] / fit.residual_nm[far[other]];
      return share > 0.25 && share < 4.0;
    };
    const auto alone = [&](std::size_t k) {
      return (k == 0 || !alike(k, k - 1)) && (k + 1 == far.size() || !alike(k, k + 1));
    };
    // Rows of one set point that lie off to the same side come again: no slips either.
    const std::vector<int> set_point = set_points_of(table_.points);
    std::map<std::pair<int, bool>, int> again;
    for (const std::size_t i : far) ++again[{set_point[i], fit.residual_nm[i] > 0.0}];
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < far.size(); ++k)
      if (alone(k) && again[{set_point[far[k]], fit.residual_nm[far[k]] > 0.0}] < kComesAgain)
        out.push_back(far[k]);
    if (come_again(fit, out) || is_of_a_turn(out) || lie_among_alike(fit, out)) return false;
    // Many rows far off, or neighbours together, are structure and no slips.
    if (out.empty() || static_cast<double>(out.size()) >
                           std::max(1.0, kMostOutliers * static_cast<double>(table_.points.size())))
      return false;
    for (std::size_t k = 0; k < out.size() && k < 5; ++k) {
      const BenchPoint& p = table_.points[out[k]];
      const std::string text =
          printed(": outlier left out: driven torque %.4g N m lies %.0f sigma off", p.driven_nm,
                  std::abs(fit.residual_nm[out[k]]) / fit.sigma_nm[out[k]]);
      table_.notes.push_back(data_.files[p.file] + ":" + std::to_string(p.line) + text);
    }
    if (out.size() > 5)
      table_.notes.push_back(std::to_string(out.size() - 5) + " more outliers left out");
    table_.outliers = static_cast<int>(out.size());
    for (auto it = out.rbegin(); it != out.rend(); ++it)
      table_.points.erase(table_.points.begin() + static_cast<std::ptrdiff_t>(*it));
    return true;
  }

  /// Several rows that lie off to one side, about as far, are what comes again: a tooth that is
  /// damaged, a seal that sticks. Slips lie to either side, or far beyond each other.
  [[nodiscard]] bool come_again(const SmoothFit& fit, const std::vector<std::size_t>& out) const {
    constexpr std::size_t kSeveral = 4;
    constexpr double kAlike = 3.0, kMost = 0.8;
    if (out.size() < kSeveral) return false;
    std::vector<double> size;
    for (const std::size_t i : out) size.push_back(fit.residual_nm[i] / fit.sigma_nm[i]);
    const double middle = median(size);
    const auto alike = std::count_if(size.begin(), size.end(), [&](double one) {
      return one / middle > 1.0 / kAlike && one / middle < kAlike;
    });
    return static_cast<double>(alike) > kMost * static_cast<double>(size.size());
  }

  /// Rows that all lie in one part of a turn are what a chip or a burr does there (Rayleigh's
  /// test).
  [[nodiscard]] bool is_of_a_turn(const std::vector<std::size_t>& out) const {
    constexpr std::size_t kSeveral = 4;
    constexpr double kSure = 12.0;  // once in 160 000, of few shafts
    constexpr double kTurns = 2.0, kAllAround = 0.3;
    if (!table_.has_angle || out.size() < kSeveral) return false;
    std::vector<double> orders{1.0};
    for (const MemberOrder& member : model_.orders) orders.push_back(member.order);
    return std::any_of(orders.begin(), orders.end(), [&](double order) {
      // (of what was seen all around)
      const auto length = [&](const auto& rows, const auto& angle) {
        double cosine = 0.0, sine = 0.0;
        for (const auto& row : rows) {
          cosine += std::cos(order * angle(row));
          sine += std::sin(order * angle(row));
        }
        return std::hypot(cosine, sine) / static_cast<double>(rows.size());
      };
      const double seen = length(table_.points, [](const BenchPoint&p) { return p.angle_rad; }),
                   far = length(out, [&](std::size_t i) { return table_.points[i].angle_rad; });
      return order * table_.turns >= kTurns && seen < kAllAround &&
             far * far * static_cast<double>(out.size()) > kSure;
    });
  }

  /// Rows whose neighbours over a quantity, or at a place of a turn, lie off to the same side, if
  /// less far, are the top of something that stands there.
  [[nodiscard]] bool lie_among_alike(const SmoothFit& fit,
                                     const std::vector<std::size_t>& out) const {
    constexpr std::size_t kNeighbours = 6;
    constexpr double kMostSize = 3.0, kSure = 5.0;
    if (out.empty()) return false;
    std::vector<double> orders;
    if (table_.has_angle) {
      orders.push_back(1.0);
      for (const MemberOrder& member : model_.orders) orders.push_back(member.order);
    }
    const auto surely = [&](const auto& apart) {
      double sum = 0.0, count = 0.0;
      for (const std::size_t i : out) {
        std::vector<std::pair<double, std::size_t>> others;
        for (std::size_t j = 0; j < table_.points.size(); ++j)
          if (table_.points[j].forward == table_.points[i].forward &&
              std::find(out.begin(), out.end(), j) == out.end())
            others.emplace_back(apart(i, j), j);
        const std::size_t near = std::min(kNeighbours, others.size());
        std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(near),
                          others.end());
        for (std::size_t k = 0; k < near; ++k) {
          const std::size_t j = others[k].second;
          const double size =
              std::clamp(fit.residual_nm[j] / fit.sigma_nm[j], -kMostSize, kMostSize);
          sum += fit.residual_nm[i] > 0.0 ? size : -size;
          count += 1.0;
        }
      }
      return sum > kSure * std::sqrt(count);
    };
    const auto surely_over = [&](const std::vector<double>& quantity) {
      return surely(
          [&](std::size_t i, std::size_t j) { return std::abs(quantity[i] - quantity[j]); });
    };
    const std::vector<BenchPoint>& points = table_.points;
    return std::any_of(orders.begin(), orders.end(),
                       [&](double order) {
                         return surely([&](std::size_t i, std::size_t j) {
                           const double turns =
                               order * (points[i].angle_rad - points[j].angle_rad) / kTwoPi;
                           return std::abs(turns - std::round(turns));
                         });
                       }) ||
           surely_over(values_of(points, &BenchPoint::speed_rpm)) ||
           surely_over(loads_as_set(points, set_points_of(points)));
  }

  void look_for_gains() {
    const PowerGained gained = power_gained(table_.points, model_.ratio, {});
    if (gained.file < 0) return;
    table_.impossible = Impossible::kEfficiencyAboveOne;
    table_.impossible_text =
        data_.files[static_cast<std::size_t>(gained.file)] + ": " + gained.text;
  }

  const DriveModel& model_;
  BenchData data_;
  BenchTable table_;
};

}  // namespace

namespace {

/// The same of loads as one side says them: `by_driven` as what comes out.
PowerGained gained_by(const std::vector<BenchPoint>& points, double ratio,
                      const std::vector<double>& taken_off_nm, bool by_driven) {
  struct Cell {
    double excess = 0.0, taken = 0.0, count = 0.0;
    std::map<int, std::pair<double, int>> units;
  };
  const auto load_nm = [&](const BenchPoint& p) {
    return !by_driven ? p.load_nm : p.forward ? p.driven_nm / ratio : p.driven_nm;
  };
  double most_load_nm = 0.0;
  for (const BenchPoint& p : points) most_load_nm = std::max(most_load_nm, load_nm(p));
  std::map<std::tuple<bool, int, int>, Cell> cells;  // direction, load, file
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BenchPoint& p = points[i];
    const int sixth = std::min(5, static_cast<int>(6.0 * load_nm(p) / most_load_nm));
    Cell& cell = cells[{p.forward, sixth, p.file}];
    const double lossless = p.forward ? ratio * p.driving_nm : p.driving_nm / ratio;
    const double excess = p.driven_nm - lossless - (taken_off_nm.empty() ? 0.0 : taken_off_nm[i]);
    cell.excess += excess;
    cell.taken += lossless;
    cell.count += 1.0;
    auto& [sum, rows] = cell.units[p.unit];
    sum += excess;
    ++rows;
  }
  PowerGained gained;
  for (const auto& [key, cell] : cells) {
    if (cell.units.size() < 3 || !(cell.excess > 0.0)) continue;
    const double mean = cell.excess / cell.count;
    double spread = 0.0;
    for (const auto& [unit, part] : cell.units) {
      const double off = part.first - part.second * mean;
      spread += off * off;
    }
    const double units = static_cast<double>(cell.units.size());
    const double error = std::sqrt(spread * units / (units - 1.0)) / cell.count;
    if (mean < 4.5 * error || cell.excess < 2e-3 * cell.taken) continue;
    const char* direction = std::get<0>(key) ? "forward" : "backward";
    const char* load = std::get<1>(key) <= 1 ? "low" : std::get<1>(key) <= 3 ? "middle" : "high";
    constexpr double kNothing = 0.01;  // of what comes out: a ratio to it says nothing
    gained.text =
        cell.taken > kNothing * cell.excess
            ? printed(
                  "%s, the apparent efficiency at %s load is %.3f (+-%.3f): no gearbox delivers "
                  "more than it takes",
                  direction, load, 1.0 + cell.excess / cell.taken,
                  2.0 * error * cell.count / cell.taken)
            : printed(
                  "%s, at %s load %.3g (+-%.2g) N m come out where next to nothing goes in: no "
                  "gearbox delivers more than it takes",
                  direction, load, mean, 2.0 * error);
    gained.file = std::get<2>(key);
  }
  return gained;
}

}  // namespace

PowerGained power_gained(const std::vector<BenchPoint>& points, double ratio,
                         const std::vector<double>& taken_off_nm) {
  // Of rows with little on one side that side may only read too little, or lose less than others:
  // who gains power does so in the order of either side.
  if (gained_by(points, ratio, taken_off_nm, true).file < 0) return {};
  return gained_by(points, ratio, taken_off_nm, false);
}

bool BenchTable::has(bool forward) const {
  return std::any_of(points.begin(), points.end(),
                     [&](const BenchPoint& p) { return p.forward == forward; });
}

BenchTable without_rows(const BenchTable& table) {
  BenchTable some = table;
  some.points.clear();
  if (some.all_points == nullptr) some.all_points = &table.points;
  return some;
}

void measure_extent(BenchTable& table) {
  double low = 1e300, high = -1e300, sum = 0.0;
  table.least_speed_rpm = table.least_load_nm = table.least_carried_nm = 1e300;
  for (const BenchPoint& p : table.points) {
    table.most_speed_rpm = std::max(table.most_speed_rpm, p.speed_rpm);
    table.least_speed_rpm = std::min(table.least_speed_rpm, p.speed_rpm);
    table.most_load_nm = std::max(table.most_load_nm, p.load_nm);
    table.least_load_nm = std::min(table.least_load_nm, p.load_nm);
    table.most_carried_nm = std::max(table.most_carried_nm, p.carried_nm);
    table.least_carried_nm = std::min(table.least_carried_nm, p.carried_nm);
    double& of_direction = table.most_carried_of[p.forward ? 1 : 0];
    of_direction = std::max(of_direction, p.carried_nm);
    low = std::min(low, p.temperature_c);
    high = std::max(high, p.temperature_c);
    sum += p.temperature_c;
  }
  table.levels = {count_levels(table, &BenchPoint::load_nm), count_levels(table, &BenchPoint::speed_rpm), 0};
  if (!table.has_temperature) return;
  table.levels[2] = high - low >= 3.0 ? count_levels(table, &BenchPoint::temperature_c) : 0;
  table.mean_temperature_c = sum / static_cast<double>(table.points.size());
  table.least_temperature_c = low;
  table.temperature_span_c = high - low;
}

SmoothFit smooth_fit(const std::vector<BenchPoint>& points) {
  SmoothFit fit;
  const std::array<double, 2> rounding_of_direction{rounding_of(points, false),
                                                    rounding_of(points, true)};
  fit.residual_nm.assign(points.size(), 0.0);
  std::vector<double> growth(points.size(), 1.0);
  const auto fit_both = [&] {
    fit.sigma_forward_nm = fit_direction(points, true, growth, fit.residual_nm);
    fit.sigma_backward_nm = fit_direction(points, false, growth, fit.residual_nm);
  };
  fit_both();
  // (what every direction's noise is follows the weights; growth is asked in the plain ones' units)
  const std::vector<double> grows = growth_of_noise(points, fit);
  if (std::any_of(grows.begin(), grows.end(), [](double g) { return g != 1.0; })) {
    growth = grows;
    fit_both();
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    fit.sigma_nm.push_back(
        std::max((points[i].forward ? fit.sigma_forward_nm : fit.sigma_backward_nm) * growth[i],
                 rounding_of_direction[points[i].forward ? 1 : 0]));
  return fit;
}

ResultAll<BenchTable> make_bench_table(const DriveModel& model, const BenchData& data) {
  return TableMaker(model, data).make();
}

}  // namespace trueflank::loop
