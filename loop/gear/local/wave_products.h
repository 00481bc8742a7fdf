// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"

// Fourier sums over the values of one flank, of all waves that are asked about at once.
namespace trueflank::loop::flank_waves {

using Complex = std::complex<double>;

/// Waves asked about, in halves: up to six over the profile, sixteen over the face.
constexpr int kProfile = 12, kFace = 32, kColumns = 2 * kFace + 1;

/// Without the special cases of infinite numbers, which take most of the time of `*`.
inline Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

struct Value {
  int tooth = 0, side = 0;
  double u = 0.0, v = 0.0, um = 0.0;  ///< u, v: 0 ... 1
};

/// Values that are added at once.
constexpr std::size_t kWavesAtOnce = 4;

/// Sums over values of the four products of cosines and sines over the profile and over the face.
class WaveProducts {
 public:
  /// At most kWavesAtOnce of them.
  void add(std::span<const Value* const> values) {
    std::array<std::array<double, kAlong>, kWavesAtOnce> along{};
    std::array<std::array<double, kRow>, kWavesAtOnce> across{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Complex step_u = std::polar(1.0, kPi * values[i]->u),
                    step_v = std::polar(1.0, kPi * values[i]->v);
      Complex of_v = 1.0;
      for (std::size_t b = 0; b < kHalf; ++b, of_v = product(of_v, step_v)) {
        across[i][b] = of_v.real();
        across[i][kHalf + b] = of_v.imag();
      }
      Complex of_u = values[i]->um;
      for (std::size_t a = 0; a < kAlong; a += 2, of_u = product(of_u, step_u)) {
        along[i][a] = of_u.real();
        along[i][a + 1] = of_u.imag();
      }
    }
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      for (std::size_t a = 0; a < kAlong; ++a)
        for (std::size_t b = 0; b < kRow; ++b)
          sums_[a][b] += along[0][a] * across[0][b] + along[1][a] * across[1][b] +
                         along[2][a] * across[2][b] + along[3][a] * across[3][b];
    });
  }
  /// Sum of um exp(-i pi (a u + b v)), or with `sign` -1 of the wave that falls.
  [[nodiscard]] Complex sum(int a, int b, double sign) const {
    const auto i = 2 * static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    return {sums_[i][j] - sign * sums_[i + 1][kHalf + j],
            -sums_[i + 1][j] - sign * sums_[i][kHalf + j]};
  }

 private:
  static constexpr std::size_t kAlong = 2 * (kProfile + 1), kHalf = kFace + 1, kRow = 2 * kHalf + 2;
  static_assert(kWavesAtOnce == 4 && kRow % 4 == 0);
  std::array<std::array<double, kRow>, kAlong> sums_{};
};

/// A flank with fewer values tells nothing of waves in it.
constexpr int kFewestValues = 12;
/// A median of exponentials is known as well as a mean of so many of them.
constexpr double kToldByWaves = 0.48;

/// Of one flank: how many values, their mean [um], and their Fourier sums.
struct FlankSums {
  int count = 0;
  double mean = 0.0;
  std::vector<double> real, imaginary;  ///< over kProfile + 1 by kColumns waves
  static std::size_t at(int a, int b) { return static_cast<std::size_t>(a * kColumns + b + kFace); }
  [[nodiscard]] Complex sum(int a, int b) const { return {real[at(a, b)], imaginary[at(a, b)]}; }
};

}  // namespace trueflank::loop::flank_waves
