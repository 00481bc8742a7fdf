// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "trueflank/loop/drive/drive_effect.h"

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
[[nodiscard]] LikeliestOrder likeliest_order(const DriveContext& context,
                                             const Eigen::VectorXd& left);

/// Sums of size exp(i (first + step k) angle) over all rows, k = 0 ... lines - 1. Every row is spread
/// by a Gaussian on a grid of twice the lines; the grid's fast Fourier transform is the wanted sum
/// times the Gaussian's own transform, which is divided out.
/// Accuracy: 1e-10 of the sum of all |size| (tested against the plain sum).
[[nodiscard]] std::vector<std::complex<double>> line_sums(const std::vector<double>& angle_rad,
                                                          const std::vector<double>& size,
                                                          double first, double step, int lines);

}  // namespace trueflank::loop
