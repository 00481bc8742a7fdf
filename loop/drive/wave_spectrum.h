// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <memory>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/drive/bench_table.h"

// Waves over the input's angle in what a model leaves of a bench.
namespace trueflank::loop {

/// The highest line of the spectra over the input's angle [per turn], of the training rows: alike or
/// opposite in the directions, the same at every load or in proportion to it.
struct LikeliestOrder {
  double order = kNaN;   ///< per input turn; NaN: no angles
  double p_value = 1.0;  ///< of so high a line anywhere in the spectra of noise
  bool opposite = false;   ///< the two directions opposite, as what a sensor reads
  bool with_load = false;  ///< in proportion to the load
};
/// Spectra of one bench, for who asks several: what was asked before is not computed again.
class WaveSpectra {
 public:
  WaveSpectra();
  ~WaveSpectra();
  WaveSpectra(const WaveSpectra&) = delete;
  WaveSpectra& operator=(const WaveSpectra&) = delete;
  /// Of what is left of each row [newton metres].
  [[nodiscard]] LikeliestOrder likeliest_order(const BenchTable& table,
                                               const Eigen::VectorXd& left);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

/// Amounts of a wave's two columns, and what they take off.
struct WaveAmounts {
  double cos = 0.0, sin = 0.0, gain = 0.0;
  /// -1/2 ... 1/2 of a period.
  [[nodiscard]] double phase() const { return std::atan2(sin, cos) / kTwoPi; }
};
/// Sums over rows of the products of a wave's two columns, and of each with what is left.
struct WaveProducts {
  double cos_cos = 0.0, cos_sin = 0.0, sin_sin = 0.0, cos_left = 0.0, sin_left = 0.0;
  void add(double cos, double sin, double left) {
    cos_cos += cos * cos;
    cos_sin += cos * sin;
    sin_sin += sin * sin;
    cos_left += cos * left;
    sin_left += sin * left;
  }
  /// By least squares; nothing where the columns are so nearly one that their determinant is no
  /// more than this.
  [[nodiscard]] WaveAmounts solved(double least_determinant = 0.0) const;
};

/// Sums of size exp(i (first + step k) angle) over all rows, k = 0 ... lines - 1.
/// Accuracy: 1e-10 of the sum of all |size| (tested against the plain sum).
[[nodiscard]] std::vector<std::complex<double>> line_sums(const std::vector<double>& angle_rad,
                                                          const std::vector<double>& size,
                                                          double first, double step, int lines);

}  // namespace trueflank::loop
