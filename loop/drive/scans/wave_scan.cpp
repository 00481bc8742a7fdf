// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/scans/wave_scan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/wave_spectrum.h"

namespace trueflank::loop {
namespace {

using namespace drive_effects;

constexpr double kHighestOfParts = 14.0;     ///< order
constexpr double kStepOfTurns = 0.35;        ///< of the order: an input's turn over the whole run
constexpr double kMostPartTerms = 6e6;       ///< rows times orders
constexpr int kBinsOfParts = 10;             ///< of as many rows each
constexpr Eigen::Index kOrdersAtOnce = 512;  ///< orders at once
constexpr int kMostOrdersOfPeaks = 2000000;  ///< of which the peaks are sought
constexpr Eigen::Index kOrdersAbout = 6;     ///< to either side of a likely order

/// A row in the noise's units: what is left of it, and how much a wave of 1 N m moves it.
struct PartRow {
  double angle_rad = 0.0, left = 0.0, lever = 0.0;
  bool forward = true;
  double with_load = 0.0, with_speed = 0.0;  ///< what makes a wave larger
  [[nodiscard]] double size(double how) const {
    return how == double(kWaveEven) ? 1.0 : how == double(kWaveWithLoad) ? with_load : with_speed;
  }
};

/// A load, speed, temperature or place of the run in bins, and where they part.
struct Parted {
  double over = 0.0;
  std::vector<double> share;  ///< of every row
  std::vector<int> bin;
  std::vector<double> place;  ///< between bins
};

/// Sums over rows of one order after the other: of what is left with the wave's two phases, and of
/// these phases' products.
struct PartSum {
  Eigen::ArrayXf c, s, cc, cs;
  float weight = 0.0F;
  void clear(Eigen::Index lines) {
    c = s = cc = cs = Eigen::ArrayXf::Zero(lines);
    weight = 0.0F;
  }
  void add(const PartSum& other, float sign) {
    c += sign * other.c;
    s += sign * other.s;
    cc += other.cc;
    cs += other.cs;
    weight += other.weight;
  }
  void remove(const PartSum& other) {
    c -= other.c;
    s -= other.s;
    cc -= other.cc;
    cs -= other.cs;
    weight -= other.weight;
  }
  /// What the wave takes off.
  [[nodiscard]] Eigen::ArrayXf power() const {
    constexpr float kOwn = 1e-3F;
    const Eigen::ArrayXf ss = weight - cc, determinant = cc * ss - cs * cs;
    return (determinant > kOwn * weight * weight)
        .select((c * c * ss - 2.0F * c * s * cs + s * s * cc) / determinant.max(1e-30F), 0.0F);
  }
};

/// What a wave is like besides its order and phase.
struct PartKind {
  double how = kWaveEven, direction = 0.0, over = -1.0;
  int side = kWaveAbove;
  [[nodiscard]] bool has_a_place() const { return over >= 0.0; }
};

struct PartCandidate {
  PartKind kind;
  double gain = 0.0, order = 0.0, place = 0.0;
};

class PartScan {
 public:
  PartScan(const DriveContext& context, const Eigen::VectorXd& left) : context_(context) {
    const auto& points = context.table.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const BenchPoint& p = points[i];
      if (p.fold == 0) continue;
      at_.push_back(i);
      rows_.push_back({.angle_rad = p.angle_rad,
                       .left = left[static_cast<Eigen::Index>(i)] / p.sigma_nm,
                       .lever = in_direction(context, p, 0.0) / p.sigma_nm,
                       .forward = p.forward,
                       .with_load = size_of_wave(context, p, kWaveWithLoad),
                       .with_speed = size_of_wave(context, p, kWaveWithSpeed)});
      const double square = rows_.back().left * rows_.back().left;
      sum_ += square;
      fourths_ += square * square;
    }
    both_ = context.table.has(true) && context.table.has(false);
    wrapped_ = context.table.turns <= 1.01;
    step_ = wrapped_ ? 1.0 : kStepOfTurns / context.table.turns;
    first_ = wrapped_ ? 1.0 : std::max(step_, 1.5 / context.table.turns);
    lines_ = static_cast<Eigen::Index>(std::max(0.0, (kHighestOfParts - first_) / step_)) + 1;
    part(0.0, context.table.levels[0] > 3);
    part(1.0, context.table.levels[1] > 3);
    part(2.0, context.table.has_temperature && context.table.temperature_span_c > 3.0);
    part(kOverRun, has_one_course(context));
  }

  std::vector<PartWave> likeliest() {
    constexpr std::size_t kFewestRows = 30;
    if (rows_.size() < kFewestRows || !(sum_ > 0.0)) return {};
    if (static_cast<double>(lines_) * static_cast<double>(rows_.size()) <= kMostPartTerms)
      for (first_line_ = 0; first_line_ < lines_; first_line_ += kOrdersAtOnce)
        ask_block(std::min(kOrdersAtOnce, lines_ - first_line_));
    else
      for (const auto& [line, count] : likely_lines()) {
        first_line_ = line;
        ask_block(count);
      }
    std::stable_sort(
        best_.begin(), best_.end(),
        [](const PartCandidate& a, const PartCandidate& b) { return a.gain > b.gain; });
    constexpr std::size_t kMost = 4;
    std::vector<PartWave> waves;
    for (PartCandidate& wave : best_) {
      if (waves.size() == kMost) break;
      if (!is_more_than_noise(wave)) continue;
      PartWave finer = refined(wave);
      finer.looks = looks_at(wave.kind);
      waves.push_back(std::move(finer));
    }
    return waves;
  }

  [[nodiscard]] DriveShape finer(const DriveShape& wave) const {
    PartCandidate about{.kind = {.how = wave[kWaveHow], .direction = wave[kWaveDirection]},
                        .order = wave[kWaveOrder]};
    if (wave.size() > kWaveSide) {
      about.kind.over = wave[kWaveOver];
      about.kind.side = static_cast<int>(wave[kWaveSide]);
      about.place = wave[kWavePlace];
    }
    return refined(about).shape;
  }

 private:
  void part(double over, bool may_be) {
    constexpr double kApart = 0.01;
    if (!may_be) return;
    Parted parted{.over = over, .share = {}, .bin = {}, .place = {}};
    for (const std::size_t i : at_)
      parted.share.push_back(share_for_wave(context_, context_.table.points[i], over));
    std::vector<double> sorted = parted.share;
    std::sort(sorted.begin(), sorted.end());
    for (int k = 1; k < kBinsOfParts; ++k) {
      const std::size_t at = static_cast<std::size_t>(k) * sorted.size() / kBinsOfParts;
      if (at == 0) continue;
      const double place = 0.5 * (sorted[at - 1] + sorted[at]);
      if (sorted[at] > sorted[at - 1] &&
          (parted.place.empty() || place > parted.place.back() + kApart))
        parted.place.push_back(place);
    }
    if (parted.place.empty()) return;
    for (const double share : parted.share)
      parted.bin.push_back(
          static_cast<int>(std::upper_bound(parted.place.begin(), parted.place.end(), share) -
                           parted.place.begin()));
    parted_.push_back(std::move(parted));
  }

  /// Over very many turns: runs of orders, from where on and how many, about those of the drive's
  /// members and the strongest of each direction. A wave of a part stands out near its own order in
  /// the spectrum of all.
  [[nodiscard]] std::map<Eigen::Index, Eigen::Index> likely_lines() const {
    std::set<Eigen::Index> likely;
    constexpr int kMostMultiples = 14;
    for (const MemberOrder& member : context_.model.orders)
      for (int times = 1; times <= kMostMultiples; ++times)
        if (const double order = times * member.order; order >= first_ && order <= kHighestOfParts)
          likely.insert(static_cast<Eigen::Index>((order - first_) / step_ + 0.5));
    for (const bool forward : {true, false}) add_peaks(forward, likely);
    std::map<Eigen::Index, Eigen::Index> runs;
    Eigen::Index end = 0;
    for (const Eigen::Index line : likely) {
      const Eigen::Index begin = std::max(end, line - kOrdersAbout);
      end = std::min(lines_, line + kOrdersAbout + 1);
      for (Eigen::Index at = begin; at < end; at += kOrdersAtOnce)
        runs.emplace(at, std::min(kOrdersAtOnce, end - at));
    }
    return runs;
  }

  void add_peaks(bool forward, std::set<Eigen::Index>& likely) const {
    constexpr int kMostPeaks = 5;
    if (lines_ > kMostOrdersOfPeaks) return;
    std::vector<double> angle, size;
    for (const PartRow& row : rows_)
      if (row.forward == forward) {
        angle.push_back(row.angle_rad);
        size.push_back(row.lever * row.left);
      }
    if (angle.empty()) return;
    std::vector<double> power;
    for (const auto& sum : line_sums(angle, size, first_, step_, static_cast<int>(lines_)))
      power.push_back(std::norm(sum));
    for (int peak = 0; peak < kMostPeaks; ++peak) {
      const auto most = std::max_element(power.begin(), power.end());
      const auto line = most - power.begin();
      likely.insert(line);
      std::fill(power.begin() + std::max<std::ptrdiff_t>(0, line - kOrdersAbout),
                power.begin() + std::min<std::ptrdiff_t>(lines_, line + kOrdersAbout + 1), 0.0);
    }
  }

  /// Of orders from one on: sums of every bin, direction and size.
  void ask_block(Eigen::Index lines) {
    for (const double how : {double(kWaveEven), double(kWaveWithLoad), double(kWaveWithSpeed)}) {
      for (const Parted& parted : parted_) {
        if (how == double(kWaveWithSpeed) && &parted != &parted_.front()) continue;
        sum_bins(parted, how, lines);
        judge_parts(parted, how);
      }
    }
  }

  void sum_bins(const Parted& parted, double how, Eigen::Index lines) {
    const std::size_t bins = parted.place.size() + 1;
    sums_.resize(2 * bins);
    for (PartSum& sum : sums_) sum.clear(lines);
    if (phases_of_ != first_line_ || cosine_.rows() != lines) fill_phases(lines);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const PartRow& row = rows_[i];
      const double weight = row.size(how) * row.lever;
      PartSum& sum = sums_[2 * static_cast<std::size_t>(parted.bin[i]) + (row.forward ? 0 : 1)];
      const auto at = static_cast<Eigen::Index>(i);
      const auto x = cosine_.col(at), y = sine_.col(at);
      sum.c += static_cast<float>(weight * row.left) * x;
      sum.s += static_cast<float>(weight * row.left) * y;
      const auto square = static_cast<float>(weight * weight);
      sum.cc += square * x * x;
      sum.cs += square * x * y;
      sum.weight += square;
    }
  }

  void fill_phases(Eigen::Index lines) {
    const auto n = static_cast<Eigen::Index>(rows_.size());
    cosine_.resize(lines, n);
    sine_.resize(lines, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double angle = rows_[static_cast<std::size_t>(i)].angle_rad,
                   turn_x = std::cos(step_ * angle), turn_y = std::sin(step_ * angle),
                   begin = first_ + step_ * static_cast<double>(first_line_);
      double x = std::cos(begin * angle), y = std::sin(begin * angle);
      for (Eigen::Index k = 0; k < lines; ++k) {
        cosine_(k, i) = static_cast<float>(x);
        sine_(k, i) = static_cast<float>(y);
        const double next = x * turn_x - y * turn_y;
        y = x * turn_y + y * turn_x;
        x = next;
      }
    }
    phases_of_ = first_line_;
  }

  /// Directions that are asked: both, one alone, or as a reading has it.
  [[nodiscard]] std::vector<double> directions() const {
    return both_ ? std::vector{0.0, 1.0, 2.0, kAsItReads} : std::vector{0.0};
  }
  /// The sums of both directions as this one has them.
  static void add_direction(PartSum& to, const PartSum& forward, const PartSum& backward,
                            double direction, float sign) {
    if (direction != 2.0) to.add(forward, direction == kAsItReads ? -sign : sign);
    if (direction != 1.0) to.add(backward, sign);
  }

  void judge_parts(const Parted& parted, double how) {
    const std::size_t bins = parted.place.size() + 1;
    const Eigen::Index lines = sums_.front().c.size();
    const bool first = &parted == &parted_.front();
    for (const double direction : directions()) {
      PartSum all;
      all.clear(lines);
      for (std::size_t b = 0; b < bins; ++b)
        add_direction(all, sums_[2 * b], sums_[2 * b + 1], direction, 1.0F);
      // (a plain one, of both directions alike, is asked elsewhere)
      if (first && (direction == 1.0 || direction == 2.0 ||
                    (direction == 0.0 && how == double(kWaveWithSpeed))))
        judge({how, direction, -1.0, kWaveAbove}, all, 0.0);
      if (how == double(kWaveWithSpeed)) continue;
      PartSum below;
      below.clear(lines);
      for (std::size_t b = 0; b + 1 < bins; ++b) {
        add_direction(below, sums_[2 * b], sums_[2 * b + 1], direction, 1.0F);
        PartSum above = all, over = all;
        above.remove(below);
        over.c = above.c - below.c;
        over.s = above.s - below.s;
        judge({how, direction, parted.over, kWaveBelow}, below, parted.place[b]);
        judge({how, direction, parted.over, kWaveAbove}, above, parted.place[b]);
        judge({how, direction, parted.over, kWaveTurnsOver}, over, parted.place[b]);
      }
    }
  }

  void judge(const PartKind& kind, const PartSum& sum, double place) {
    Eigen::Index line = 0;
    const double gain = sum.power().maxCoeff(&line);
    const auto same = std::find_if(best_.begin(), best_.end(), [&](const PartCandidate& w) {
      return w.kind.how == kind.how && w.kind.direction == kind.direction &&
             w.kind.over == kind.over && w.kind.side == kind.side;
    });
    PartCandidate& wave = same == best_.end() ? best_.emplace_back() : *same;
    if (gain <= wave.gain) return;
    wave = {kind, gain, first_ + step_ * static_cast<double>(first_line_ + line), place};
  }

  [[nodiscard]] std::size_t looks_at(const PartKind& kind) const {
    const std::size_t kinds = 2 * directions().size();  // even, or with the load
    return static_cast<std::size_t>(lines_) * kinds *
           (kind.has_a_place() ? 3 * kBinsOfParts * parted_.size() : 1);
  }
  [[nodiscard]] bool is_more_than_noise(const PartCandidate& wave) const {
    constexpr double kSure = 1e-6;
    // (rows of a small error may be few of all, and make most of the sum: a place finds them)
    const double n = wave.kind.has_a_place()
                         ? std::min(static_cast<double>(rows_.size()), 3.0 * sum_ * sum_ / fourths_)
                         : static_cast<double>(rows_.size());
    const double single =
        std::pow(std::max(0.0, 1.0 - wave.gain / sum_), 0.5 * std::max(0.0, n - 3.0));
    return single * static_cast<double>(looks_at(wave.kind)) < kSure;
  }

  /// What a wave of this kind takes off, and its amounts.
  [[nodiscard]] WaveAmounts fitted(const PartKind& kind, double order, double place,
                                   const Parted* parted) const {
    WaveProducts products;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const PartRow& row = rows_[i];
      double weight = row.lever * row.size(kind.how);
      if (kind.direction == 1.0 && !row.forward) continue;
      if (kind.direction == 2.0 && row.forward) continue;
      if (kind.direction == kAsItReads && row.forward) weight = -weight;
      if (parted != nullptr) {
        const bool above = parted->share[i] > place;
        if (kind.side == kWaveTurnsOver)
          weight = above ? weight : -weight;
        else if (above != (kind.side == kWaveAbove))
          continue;
      }
      products.add(weight * std::cos(order * row.angle_rad),
                   weight * std::sin(order * row.angle_rad), row.left);
    }
    return products.solved(1e-6 * products.cos_cos * products.sin_sin);
  }

  [[nodiscard]] PartWave refined(const PartCandidate& wave) const {
    const PartKind& kind = wave.kind;
    const auto at = std::find_if(parted_.begin(), parted_.end(),
                                 [&](const Parted& p) { return p.over == kind.over; });
    const Parted* parted = at == parted_.end() ? nullptr : &*at;
    double order = wave.order, place = wave.place;
    WaveAmounts best = fitted(kind, order, place, parted);
    for (int round = 0; round < 2; ++round) {
      for (double by = 0.5 * step_; !wrapped_ && by > 0.01 * step_; by *= 0.5) {
        const double middle = order;
        for (const double other : {middle - by, middle + by})
          if (const WaveAmounts now = fitted(kind, other, place, parted); now.gain > best.gain) {
            best = now;
            order = other;
          }
      }
      if (parted == nullptr) break;
      for (const double other : places_about(*parted, place))
        if (const WaveAmounts now = fitted(kind, order, other, parted); now.gain > best.gain) {
          best = now;
          place = other;
        }
    }
    PartWave found{.shape = {order, kind.how, kind.direction, best.phase()},
                   .is_of_part = kind.has_a_place()};
    if (found.is_of_part)
      found.shape.insert(found.shape.end(), {kind.over, place, double(kind.side)});
    return found;
  }

  /// Between all rows of the bins next to a place.
  static std::vector<double> places_about(const Parted& parted, double place) {
    const auto at = std::lower_bound(parted.place.begin(), parted.place.end(), place);
    const double low = at <= parted.place.begin() + 1 ? -1.0 : *(at - 2),
                 high = parted.place.end() - at < 3 ? 2.0 : *(at + 2);
    std::vector<double> shares;
    for (const double share : parted.share)
      if (share > low && share < high) shares.push_back(share);
    const auto all = static_cast<std::ptrdiff_t>(shares.size());
    return places_between(std::move(shares), place, all);
  }

  const DriveContext& context_;
  std::vector<std::size_t> at_;
  std::vector<PartRow> rows_;
  std::vector<Parted> parted_;
  std::vector<PartSum> sums_;
  Eigen::ArrayXXf cosine_, sine_;  ///< orders x rows
  std::vector<PartCandidate> best_;
  double sum_ = 0.0, fourths_ = 0.0, step_ = 1.0, first_ = 1.0;
  Eigen::Index lines_ = 0, first_line_ = 0, phases_of_ = -1;
  bool both_ = false, wrapped_ = false;
};

}  // namespace

DriveShape finer_part_wave(const DriveContext& context, const Eigen::VectorXd& left,
                           const DriveShape& wave) {
  return PartScan(context, left).finer(wave);
}

std::vector<PartWave> waves_of_parts(const DriveContext& context, const Eigen::VectorXd& left) {
  if (!context.table.has_angle || context.table.turns < 0.9) return {};
  return PartScan(context, left).likeliest();
}

}  // namespace trueflank::loop
