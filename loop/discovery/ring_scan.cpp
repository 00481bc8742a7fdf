// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/ring_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::loop {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kOrders = 3999, kEnough = 12;

constexpr int kKinds = 5;
constexpr double kTestsOfKinds = 2.0 * kKinds;  // two of every kind
/// What is told is compared with the level once more, after it was multiplied.
constexpr double kSlack = 1.0 + 1e-9;
constexpr int kMostEvery = 8;

/// Square that the best form of a kind takes out of a series of unit variance.
struct BestOfKind {
  double square = 0.0;
  int series = -1, first = 0, count = 0, order = 0;
};
using Best = std::array<BestOfKind, kKinds>;

using RingKind = RingFinding::Kind;
constexpr std::size_t at(RingKind kind) { return static_cast<std::size_t>(kind); }

class RingScan {
 public:
  RingScan(MatrixXd series, const std::vector<int>& place, int ring)
      : series_(std::move(series)), n_(series_.rows()), orders_(std::min<Index>(ring / 2, n_ / 2)) {
    make_waves(place, ring);
    ramps_.resize(0, n_);  // of few places there may be none
    combs_.resize(0, n_);
    make_ramps_and_combs(place, ring);
    make_saws(place, ring);
    for (Index s = 0; s < series_.cols(); ++s) {
      auto column = series_.col(s);
      column.array() -= column.mean();
      scale_.push_back(std::sqrt(column.squaredNorm() / static_cast<double>(n_)));
      if (scale_.back() > 0.0) column /= scale_.back();
    }
  }

  RingFinding run(double level) {
    std::vector<Index> order(static_cast<std::size_t>(n_));
    std::iota(order.begin(), order.end(), 0);
    const Best seen = best_of(order);
    std::mt19937_64 random(20260122);
    std::array<int, kKinds> larger{};
    std::array<double, kKinds> by_size{};
    for (std::size_t k = 0; k < kKinds; ++k) by_size[k] = p_by_size(seen[k].square, k);
    constexpr double kBeyondDoubt = 1e-4;
    const bool ask = *std::min_element(by_size.begin(), by_size.end()) > kBeyondDoubt;
    // Saws are many and would take most of the time. One that chance makes as large so often, or
    // that says less than another form, is not asked for in other orders of the teeth.
    constexpr double kWorthAsking = 0.05;
    const double saw = by_size[at(RingKind::kSaw)];
    const bool saws_too =
        saw < kWorthAsking && saw == *std::min_element(by_size.begin(), by_size.end());
    if (ask && !saws_too) larger[at(RingKind::kSaw)] = kOrders;
    // Of a kind nothing more is asked once it cannot be what is told: another will be less likely,
    // or its F test says less already, or it is above the level.
    const double open_below = kSlack * level / kTestsOfKinds;
    const auto is_open = [&](std::size_t k) {
      return larger[k] <= kEnough &&
             (1.0 + larger[k]) / (1.0 + kOrders) <= std::min(by_size[k], open_below);
    };
    const auto is_asked_further = [&] {
      for (std::size_t k = 0; k < kKinds; ++k)
        if (larger[k] < kEnough && is_open(k)) return true;
      return false;
    };
    int tried = 0;
    while (ask && tried < kOrders && is_asked_further()) {
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
      std::array<bool, kKinds> asked{};
      for (std::size_t k = 0; k < kKinds; ++k) asked[k] = is_open(k);
      const std::array<bool, kKinds> as_large = kinds_as_large(order, seen, asked);
      for (std::size_t k = 0; k < kKinds; ++k) larger[k] += as_large[k] ? 1 : 0;
      ++tried;
    }
    std::size_t best = 0;
    double least = 2.0;
    for (std::size_t k = 0; k < kKinds; ++k) {
      const double p = std::min((1.0 + larger[k]) / (1.0 + tried), by_size[k]);
      if (p > least || (p == least && seen[k].square <= seen[best].square)) continue;
      least = p;
      best = k;
    }
    return finding(seen[best], best, std::min(1.0, kTestsOfKinds * least));
  }

 private:
  void make_waves(const std::vector<int>& place, int ring) {
    waves_.setZero(2 * orders_, n_);
    for (Index k = 0; k < orders_; ++k) {
      for (Index i = 0; i < n_; ++i) {
        const auto turns = (k + 1) * place[static_cast<std::size_t>(i)] % ring;
        const double angle = kTwoPi * static_cast<double>(turns) / ring;
        waves_(2 * k, i) = std::cos(angle);
        waves_(2 * k + 1, i) = std::sin(angle);
      }
      // On some places of a ring a cosine and a sine are not at right angles, nor without a mean.
      auto cosine = waves_.row(2 * k), sine = waves_.row(2 * k + 1);
      make_form(cosine);
      sine -= sine.dot(cosine) * cosine;
      make_form(sine);
    }
  }
  /// Without a mean and of unit norm. Of half the ring there is a cosine only: the rest is
  /// rounding.
  void make_form(MatrixXd::RowXpr form) const {
    form.array() -= form.mean();
    const double square = form.squaredNorm();
    form *= square > 1e-6 * static_cast<double>(n_) ? 1.0 / std::sqrt(square) : 0.0;
  }

  void make_ramps_and_combs(const std::vector<int>& place, int ring) {
    const auto add = [&](MatrixXd& forms, VectorXd form) {
      form.array() -= form.mean();
      const double norm = form.norm();
      if (!(norm * norm > 0.5)) return false;
      forms.conservativeResize(forms.rows() + 1, n_);
      forms.row(forms.rows() - 1) = form.transpose() / norm;
      return true;
    };
    for (const int first : place) {
      VectorXd ramp(n_);
      for (Index i = 0; i < n_; ++i)
        ramp[i] =
            static_cast<double>((place[static_cast<std::size_t>(i)] - first + ring) % ring) / ring;
      if (add(ramps_, ramp)) ramp_at_.push_back(first);
    }
    for (int every = 2; every <= kMostEvery && 3 * every <= n_; ++every)
      for (int first = 0; first < every; ++first) {
        VectorXd comb(n_);
        for (Index i = 0; i < n_; ++i)
          comb[i] = static_cast<double>(place[static_cast<std::size_t>(i)] % every == first);
        // Of every other place one half says what the other does.
        if ((every > 2 || first == 0) && comb.sum() >= 2.0 && add(combs_, comb))
          comb_at_.emplace_back(every, first);
      }
  }

  /// Every place from which saws of every length begin: runs of rows that rise together, so that
  /// sums of a series tell them all.
  void make_saws(const std::vector<int>& place, int ring) {
    constexpr int kFewestPlaces = 4, kValuesEach = 4;
    place_ = place;
    ring_ = ring;
    row_from_.resize(static_cast<std::size_t>(ring) + 1);
    for (int at = 0; at <= ring; ++at)
      row_from_[static_cast<std::size_t>(at)] =
          static_cast<int>(std::lower_bound(place_.begin(), place_.end(), at) - place_.begin());
    if (!std::is_sorted(place_.begin(), place_.end())) return;
    for (int every = kFewestPlaces; 2 * every <= ring; ++every) {
      if (every * n_ < static_cast<Index>(kValuesEach) * ring) continue;
      // Where the saw closes around the ring a later start says the same.
      const int starts = ring % every == 0 ? every : ring;
      for (int first = 0; first < starts; ++first) {
        const VectorXd form = saw(first, every);
        const double square = (form.array() - form.mean()).square().sum();
        if (square > 1e-3 * static_cast<double>(n_)) saws_.push_back({first, every, square});
      }
    }
  }

  /// Runs of places [from, to) of a saw that begins anew at `from`, less `before` places of it that
  /// lie at the other end of the ring.
  template <class Work>
  void for_teeth_of_saw(int first, int every, const Work& work) const {
    for (int begin = first; begin < first + ring_; begin += every) {
      const int end = std::min(begin + every, first + ring_);
      if (begin < ring_) work(begin, std::min(end, ring_), 0);
      if (end > ring_)
        work(std::max(begin, ring_) - ring_, end - ring_, std::max(0, ring_ - begin));
    }
  }
  [[nodiscard]] VectorXd saw(int first, int every) const {
    VectorXd form(n_);
    for_teeth_of_saw(first, every, [&](int from, int to, int before) {
      for (int row = row_from_[static_cast<std::size_t>(from)];
           row < row_from_[static_cast<std::size_t>(to)]; ++row)
        form[row] =
            static_cast<double>(before + place_[static_cast<std::size_t>(row)] - from) / every;
    });
    return form;
  }

  void best_saw(const VectorXd& placed, int series, BestOfKind& best) const {
    std::vector<double> sums(static_cast<std::size_t>(n_) + 1), moments(sums.size());
    for (Index i = 0; i < n_; ++i) {
      const auto k = static_cast<std::size_t>(i);
      sums[k + 1] = sums[k] + placed[i];
      moments[k + 1] = moments[k] + placed[i] * place_[k];
    }
    for (const Saw& one : saws_) {
      double product = 0.0;
      for_teeth_of_saw(one.first, one.every, [&](int from, int to, int before) {
        const auto a = static_cast<std::size_t>(row_from_[static_cast<std::size_t>(from)]),
                   b = static_cast<std::size_t>(row_from_[static_cast<std::size_t>(to)]);
        product += moments[b] - moments[a] + (before - from) * (sums[b] - sums[a]);
      });
      product /= one.every;
      improve(best, {.square = product * product / one.square,
                     .series = series,
                     .first = one.first,
                     .count = one.every});
    }
  }

  [[nodiscard]] double looked_at(std::size_t kind) const {
    const auto n = static_cast<double>(n_);
    return kind == at(RingKind::kArc)    ? n * static_cast<double>(n_ / 2 - 1)
           : kind == at(RingKind::kWave) ? static_cast<double>(orders_)
           : kind == at(RingKind::kRamp) ? static_cast<double>(ramps_.rows())
           : kind == at(RingKind::kSaw)  ? static_cast<double>(saws_.size())
                                         : static_cast<double>(combs_.rows());
  }
  /// F test of what the best of so many takes out of a series, whose squares sum to n.
  [[nodiscard]] double p_by_size(double square, std::size_t kind) const {
    if (!(looked_at(kind) > 0.0)) return 1.0;  // too few places for any form of the kind
    const double degrees = kind == at(RingKind::kWave) ? 2.0 : 1.0;
    const double left = static_cast<double>(n_) - 1.0 - degrees;
    const double f = square / degrees / (std::max(static_cast<double>(n_) - square, 1e-12) / left);
    return std::min(
        1.0, f_tail(f, degrees, left) * looked_at(kind) * static_cast<double>(series_.cols()));
  }

  [[nodiscard]] Best best_of(const std::vector<Index>& order) const {
    Best best;
    VectorXd placed(n_);
    for (Index s = 0; s < series_.cols(); ++s) {
      if (!(scale_[static_cast<std::size_t>(s)] > 0.0)) continue;
      place_series(order, s, placed);
      for (std::size_t k = 0; k < kKinds; ++k) best_of_kind(k, placed, static_cast<int>(s), best[k]);
    }
    return best;
  }

  /// Of the kinds asked for those that in this order of the rows take out as much as was seen.
  [[nodiscard]] std::array<bool, kKinds> kinds_as_large(const std::vector<Index>& order,
                                                        const Best& seen,
                                                        std::array<bool, kKinds> asked) const {
    std::array<bool, kKinds> as_large = asked;
    Best best;
    VectorXd placed(n_);
    for (Index s = 0; s < series_.cols(); ++s) {
      if (!(scale_[static_cast<std::size_t>(s)] > 0.0)) continue;
      place_series(order, s, placed);
      for (std::size_t k = 0; k < kKinds; ++k) {
        if (!asked[k]) continue;
        best_of_kind(k, placed, static_cast<int>(s), best[k]);
        asked[k] = best[k].square < seen[k].square;
      }
    }
    for (std::size_t k = 0; k < kKinds; ++k)
      as_large[k] = as_large[k] && best[k].square >= seen[k].square;
    return as_large;
  }

  void place_series(const std::vector<Index>& order, Index s, VectorXd& placed) const {
    for (Index i = 0; i < n_; ++i) placed[i] = series_(order[static_cast<std::size_t>(i)], s);
  }

  void best_of_kind(std::size_t kind, const VectorXd& placed, int series, BestOfKind& best) const {
    switch (static_cast<RingKind>(kind)) {
      case RingKind::kArc:
        best_arc(placed, series, best);
        break;
      case RingKind::kWave: {
        const VectorXd parts = waves_ * placed;
        for (Index k = 0; k < orders_; ++k)
          improve(best, {.square = parts.segment(2 * k, 2).squaredNorm(),
                         .series = series,
                         .order = static_cast<int>(k + 1)});
        break;
      }
      case RingKind::kRamp: {
        const VectorXd ramps = ramps_ * placed;
        for (Index k = 0; k < ramps.size(); ++k)
          improve(best, {.square = ramps[k] * ramps[k],
                         .series = series,
                         .first = ramp_at_[static_cast<std::size_t>(k)]});
        break;
      }
      case RingKind::kComb: {
        const VectorXd combs = combs_ * placed;
        for (Index k = 0; k < combs.size(); ++k) {
          const auto [every, first] = comb_at_[static_cast<std::size_t>(k)];
          improve(best,
                  {.square = combs[k] * combs[k], .series = series, .first = first, .count = every});
        }
        break;
      }
      case RingKind::kSaw:
        best_saw(placed, series, best);
    }
  }

  static void improve(BestOfKind& best, const BestOfKind& other) {
    if (other.square > best.square) best = other;
  }

  /// Of the differences of so many numbers. Several beside each other, as each waits for the one
  /// before it alone.
  static double largest_square(const double* from, const double* to, Index count) {
    constexpr Index kBeside = 8;
    double largest[kBeside] = {};
    Index i = 0;
    for (; i + kBeside <= count; i += kBeside)
      for (Index k = 0; k < kBeside; ++k) {
        const double off = to[i + k] - from[i + k], square = off * off;
        largest[k] = square > largest[k] ? square : largest[k];
      }
    for (; i < count; ++i) {
      const double off = to[i] - from[i];
      largest[0] = std::max(largest[0], off * off);
    }
    return *std::max_element(largest, largest + kBeside);
  }

  void best_arc(const VectorXd& placed, int series, BestOfKind& best) const {
    std::vector<double> sums(static_cast<std::size_t>(2 * n_) + 1);
    for (Index i = 0; i < 2 * n_; ++i)
      sums[static_cast<std::size_t>(i) + 1] = sums[static_cast<std::size_t>(i)] + placed[i % n_];
    for (Index count = 2; count <= n_ / 2; ++count) {
      const double weight =
          static_cast<double>(n_) / (static_cast<double>(count) * static_cast<double>(n_ - count));
      const double* const from = sums.data();
      const double* const to = from + count;
      if (largest_square(from, to, n_) * weight <= best.square)
        continue;  // of few there are larger ones
      for (Index first = 0; first < n_; ++first) {
        const double sum = to[first] - from[first];
        if (sum * sum * weight <= best.square) continue;
        best = {sum * sum * weight, series, static_cast<int>(first), static_cast<int>(count), 0};
      }
    }
  }

  [[nodiscard]] RingFinding finding(const BestOfKind& best, std::size_t kind, double p) const {
    RingFinding result{.kind = static_cast<RingKind>(kind),
                       .p_value = p,
                       .series = best.series,
                       .first = best.first,
                       .count = best.count,
                       .order = best.order};
    if (best.series < 0) return result;
    const double scale = scale_[static_cast<std::size_t>(best.series)];
    const auto rows_of = [&](const MatrixXd& forms, auto is_it) {
      Index row = 0;
      while (!is_it(static_cast<std::size_t>(row))) ++row;
      return VectorXd(forms.row(row));
    };
    // Forms of unit norm, back to their own height.
    const auto height = [&](const VectorXd& form) {
      return scale * form.dot(series_.col(best.series)) * (form.maxCoeff() - form.minCoeff());
    };
    switch (result.kind) {
      case RingKind::kArc:
        result.amount = amount_of_arc(best);
        break;
      case RingKind::kWave:
        result.amount = scale * std::sqrt(2.0 * best.square / static_cast<double>(n_));
        break;
      case RingKind::kRamp:
        result.amount =
            height(rows_of(ramps_, [&](std::size_t i) { return ramp_at_[i] == best.first; }));
        break;
      case RingKind::kComb:
        result.amount = height(rows_of(combs_, [&](std::size_t i) {
          return comb_at_[i] == std::pair(best.count, best.first);
        }));
        break;
      case RingKind::kSaw: {
        VectorXd form = saw(best.first, best.count);
        form.array() -= form.mean();
        result.amount = scale * form.dot(series_.col(best.series)) / form.squaredNorm();
      }
    }
    return result;
  }

  [[nodiscard]] double amount_of_arc(const BestOfKind& best) const {
    double sum = 0.0;
    for (int i = 0; i < best.count; ++i) sum += series_((best.first + i) % n_, best.series);
    return scale_[static_cast<std::size_t>(best.series)] * sum * static_cast<double>(n_) /
           (static_cast<double>(best.count) * static_cast<double>(n_ - best.count));
  }

  MatrixXd series_;
  Index n_, orders_;
  MatrixXd waves_, ramps_, combs_;  ///< of unit norm, a form (of waves two) a row
  std::vector<int> ramp_at_;
  std::vector<std::pair<int, int>> comb_at_;
  struct Saw {
    int first = 0, every = 0;
    double square = 0.0;  ///< of its values about their mean
  };
  std::vector<Saw> saws_;
  std::vector<int> place_, row_from_;  ///< of every row; the first row at or beyond a place
  int ring_ = 0;
  std::vector<double> scale_;
};

}  // namespace

RingFinding scan_ring(const MatrixXd& series, const std::vector<int>& place, int ring,
                      double level) {
  constexpr Index kFewest = 8;
  if (series.rows() < kFewest || series.cols() < 1) return {};
  return RingScan(series, place, ring).run(level);
}

double chance_of_agreement(const VectorXd& a, const VectorXd& b) {
  constexpr Index kFewest = 5;
  const Index n = a.size();
  if (n < kFewest) return 1.0;
  const VectorXd from_a = a.array() - a.mean(), from_b = b.array() - b.mean();
  const double squares = from_a.squaredNorm() * from_b.squaredNorm();
  if (!(squares > 0.0)) return 1.0;
  const double r = std::abs(from_a.dot(from_b)) / std::sqrt(squares);
  const auto degrees = static_cast<double>(n - 2);
  const double left = std::max(1.0 - r * r, 1e-12);
  return student_two_sided(r * std::sqrt(degrees / left), degrees);
}

}  // namespace trueflank::loop
