// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "trueflank/base/many_sines.h"
#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/loop/gear/local/four_waves.h"

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
    std::array<double, 2 * kWavesAtOnce> angles{}, sines, cosines;
    for (std::size_t i = 0; i < values.size(); ++i) {
      angles[i] = kPi * values[i]->u;
      angles[kWavesAtOnce + i] = kPi * values[i]->v;
    }
    sines_and_cosines(angles, sines, cosines);
    FourWaves over_profile, over_face;  // these from one wave on
    for (std::size_t i = 0; i < values.size(); ++i) {
      over_profile.real[i] = values[i]->um;
      over_profile.turn_real[i] = cosines[i];
      over_profile.turn_imaginary[i] = sines[i];
      over_face.real[i] = over_face.turn_real[i] = cosines[kWavesAtOnce + i];
      over_face.imaginary[i] = over_face.turn_imaginary[i] = sines[kWavesAtOnce + i];
    }
    std::array<std::array<double, kRow>, kWavesAtOnce> across{};
    std::array<std::array<double, 2 * kAlong>, kWavesAtOnce> along;
    for (std::size_t i = 0; i < values.size(); ++i) across[i][kConstant] = 1.0;
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      write_waves(over_face, kFace, across[0].data(), across[0].data() + kFace, kRow);
      write_waves(over_profile, kAlong, along[0].data(), along[0].data() + kAlong, 2 * kAlong);
      const double* const rows = across[0].data();
      for (std::size_t a = 0; a < 2 * kAlong; ++a) {
        if (!is_asked(a)) continue;
        const double factor[kWavesAtOnce] = {along[0][a], along[1][a], along[2][a], along[3][a]};
        double* const sums = sums_[a].data();
        const auto add_four = [&](std::size_t b) TRUEFLANK_ALWAYS_INLINE {
          FourDoubles sum, first, second, third, last;
          load(sum, sums + b);
          load(first, rows + b);
          load(second, rows + kRow + b);
          load(third, rows + 2 * kRow + b);
          load(last, rows + 3 * kRow + b);
          sum += factor[0] * first + factor[1] * second + factor[2] * third + factor[3] * last;
          store(sum, sums + b);
        };
        for (std::size_t b = 0; b < kConstant; b += 16) {
          add_four(b);
          add_four(b + 4);
          add_four(b + 8);
          add_four(b + 12);
        }
        add_four(kConstant);
      }
    });
  }
  /// Sum of um exp(-i pi (a u + b v)), or with `sign` -1 of the wave that falls.
  [[nodiscard]] Complex sum(int a, int b, double sign) const {
    const OfRow &real = sums_[static_cast<std::size_t>(a)],
                &imaginary = sums_[kAlong + static_cast<std::size_t>(a)];
    if (b == 0) return {real[kConstant], -imaginary[kConstant]};
    const auto j = static_cast<std::size_t>(b - 1);
    return {real[j] - sign * imaginary[kFace + j], -imaginary[j] - sign * real[kFace + j]};
  }

 private:
  /// Real parts of the waves over the profile, then imaginary ones, in whole registers; those over
  /// the face, and after them the wave that is constant.
  static constexpr std::size_t kAlong = (kProfile + 4) / 4 * 4, kConstant = 2 * kFace,
                               kRow = kConstant + 4;
  static_assert(kWavesAtOnce == 4 && kConstant % 16 == 0);
  using OfRow = std::array<double, kRow>;

  /// The constant has no imaginary part.
  static constexpr bool is_asked(std::size_t along) {
    return along % kAlong <= kProfile && along != kAlong;
  }
  std::array<OfRow, 2 * kAlong> sums_{};
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
