// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/ring_scan.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::loop {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kOrders = 3999, kEnough = 12;

/// Squares that the best arc and the best wave take out of a series of unit variance.
struct Best {
  double arc = 0.0, wave = 0.0;
  int arc_series = -1, first = 0, count = 0, wave_series = -1, order = 0;
};

class RingScan {
 public:
  RingScan(MatrixXd series, const std::vector<int>& place, int ring)
      : series_(std::move(series)), n_(series_.rows()), orders_(std::min<Index>(ring / 2, n_ / 2)) {
    waves_.setZero(2 * orders_, n_);
    for (Index k = 0; k < orders_; ++k) {
      for (Index i = 0; i < n_; ++i) {
        const auto turns = (k + 1) * place[static_cast<std::size_t>(i)] % ring;
        const double angle = kTwoPi * static_cast<double>(turns) / ring;
        waves_(2 * k, i) = std::cos(angle);
        waves_(2 * k + 1, i) = std::sin(angle);
      }
      for (const Index row : {2 * k, 2 * k + 1}) {
        const double square = waves_.row(row).squaredNorm();
        // Of half the ring there is a cosine only.
        waves_.row(row) *= square > 1e-6 * static_cast<double>(n_) ? 1.0 / std::sqrt(square) : 0.0;
      }
    }
    for (Index s = 0; s < series_.cols(); ++s) {
      auto column = series_.col(s);
      column.array() -= column.mean();
      scale_.push_back(std::sqrt(column.squaredNorm() / static_cast<double>(n_)));
      if (scale_.back() > 0.0) column /= scale_.back();
    }
  }

  RingFinding run() {
    std::vector<Index> order(static_cast<std::size_t>(n_));
    std::iota(order.begin(), order.end(), 0);
    const Best seen = best_of(order);
    std::mt19937_64 random(20260122);
    int arcs = 0, waves = 0, tried = 0;
    const double arc_by_size = by_size(seen.arc, 1, arcs_looked_at());
    const double wave_by_size = by_size(seen.wave, 2, static_cast<double>(orders_));
    constexpr double kBeyondDoubt = 1e-4;
    const bool ask = std::min(arc_by_size, wave_by_size) > kBeyondDoubt;
    while (ask && tried < kOrders && std::min(arcs, waves) < kEnough) {
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
      const Best shuffled = best_of(order);
      arcs += shuffled.arc >= seen.arc ? 1 : 0;
      waves += shuffled.wave >= seen.wave ? 1 : 0;
      ++tried;
    }
    // Two tests of two kinds.
    constexpr double kTests = 4.0;
    const double of_arc = std::min((1.0 + arcs) / (1.0 + tried), arc_by_size);
    const double of_wave = std::min((1.0 + waves) / (1.0 + tried), wave_by_size);
    RingFinding result;
    result.p_value = std::min(1.0, kTests * std::min(of_arc, of_wave));
    if (of_arc < of_wave || (of_arc == of_wave && seen.arc >= seen.wave)) {
      result.series = seen.arc_series;
      result.first = seen.first;
      result.count = seen.count;
      result.amount = amount_of_arc(seen);
    } else {
      result.series = seen.wave_series;
      result.order = seen.order;
      result.amount = scale_[static_cast<std::size_t>(seen.wave_series)] *
                      std::sqrt(2.0 * seen.wave / static_cast<double>(n_));
    }
    return result;
  }

 private:
  [[nodiscard]] double arcs_looked_at() const {
    return static_cast<double>(n_) * static_cast<double>(n_ / 2 - 1);
  }
  /// F test of what the best of so many takes out of a series, whose squares sum to n.
  [[nodiscard]] double by_size(double square, double degrees, double looked_at) const {
    const double left = static_cast<double>(n_) - 1.0 - degrees;
    const double f = square / degrees / (std::max(static_cast<double>(n_) - square, 1e-12) / left);
    return std::min(1.0,
                    f_tail(f, degrees, left) * looked_at * static_cast<double>(series_.cols()));
  }

  [[nodiscard]] Best best_of(const std::vector<Index>& order) const {
    Best best;
    std::vector<double> sums(static_cast<std::size_t>(2 * n_) + 1);
    VectorXd placed(n_);
    for (Index s = 0; s < series_.cols(); ++s) {
      if (!(scale_[static_cast<std::size_t>(s)] > 0.0)) continue;
      for (Index i = 0; i < n_; ++i) placed[i] = series_(order[static_cast<std::size_t>(i)], s);
      for (Index i = 0; i < 2 * n_; ++i)
        sums[static_cast<std::size_t>(i) + 1] = sums[static_cast<std::size_t>(i)] + placed[i % n_];
      for (Index count = 2; count <= n_ / 2; ++count) {
        const double weight = static_cast<double>(n_) /
                              (static_cast<double>(count) * static_cast<double>(n_ - count));
        for (Index first = 0; first < n_; ++first) {
          const double sum =
              sums[static_cast<std::size_t>(first + count)] - sums[static_cast<std::size_t>(first)];
          if (sum * sum * weight <= best.arc) continue;
          best.arc = sum * sum * weight;
          best.arc_series = static_cast<int>(s);
          best.first = static_cast<int>(first);
          best.count = static_cast<int>(count);
        }
      }
      const VectorXd parts = waves_ * placed;
      for (Index k = 0; k < orders_; ++k) {
        const double square = parts.segment(2 * k, 2).squaredNorm();
        if (square <= best.wave) continue;
        best.wave = square;
        best.wave_series = static_cast<int>(s);
        best.order = static_cast<int>(k + 1);
      }
    }
    return best;
  }

  [[nodiscard]] double amount_of_arc(const Best& best) const {
    double sum = 0.0;
    for (int i = 0; i < best.count; ++i) sum += series_((best.first + i) % n_, best.arc_series);
    return scale_[static_cast<std::size_t>(best.arc_series)] * sum * static_cast<double>(n_) /
           (static_cast<double>(best.count) * static_cast<double>(n_ - best.count));
  }

  MatrixXd series_;
  Index n_, orders_;
  MatrixXd waves_;
  std::vector<double> scale_;
};

}  // namespace

RingFinding scan_ring(const MatrixXd& series, const std::vector<int>& place, int ring) {
  constexpr Index kFewest = 8;
  if (series.rows() < kFewest || series.cols() < 1) return {};
  return RingScan(series, place, ring).run();
}

}  // namespace trueflank::loop
