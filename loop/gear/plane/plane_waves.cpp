// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/plane/plane_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <utility>
#include <vector>

#include "trueflank/base/many_sines.h"
#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/local/four_waves.h"
#include "trueflank/loop/gear/plane/plane_values.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewestRowsAsked = 400;
/// Waves over the width of the gear: from ... in steps of ... to.
constexpr double kFewestPlaneWaves = 0.5, kPlaneStep = 0.25, kMostPlaneWaves = 120.0;

struct PlaneGain {
  double square = 0.0, amplitude_um = 0.0;
};

/// What a wave takes out of the values.
PlaneGain gain_of(const std::complex<double>& product, const std::complex<double>& square_of_wave,
                  double squares_of_normal) {
  const double cc = 0.5 * (squares_of_normal + square_of_wave.real()),
               ss = 0.5 * (squares_of_normal - square_of_wave.real()),
               cs = 0.5 * square_of_wave.imag(), determinant = cc * ss - cs * cs;
  constexpr double kToldApart = 1e-3;
  if (!(determinant > kToldApart * squares_of_normal * squares_of_normal)) return {};
  const double cosine = (ss * product.real() - cs * product.imag()) / determinant,
               sine = (cc * product.imag() - cs * product.real()) / determinant;
  return {cosine * product.real() + sine * product.imag(), std::hypot(cosine, sine)};
}

/// A row of numbers for each of four values.
struct FourRows {
  explicit FourRows(std::size_t count) : apart(count), real(4 * count), imaginary(4 * count) {}
  std::size_t apart;
  std::vector<double> real, imaginary;
};

/// Waves of so many lengths and more stand in whole registers.
constexpr std::size_t in_fours(std::size_t count) { return (count + 3) / 4 * 4; }

/// Sums of waves of a row of lengths, real and imaginary parts apart.
struct WaveSums {
  explicit WaveSums(std::size_t count) : real(count), imaginary(count) {}
  [[nodiscard]] std::complex<double> of(std::size_t k) const { return {real[k], imaginary[k]}; }
  std::vector<double> real, imaginary;
};

/// Adds the waves at four values, one after the other.
TRUEFLANK_ALWAYS_INLINE inline void add_waves(const FourRows& at, WaveSums& sums) {
  const double *const real = at.real.data(), *const imaginary = at.imaginary.data();
  double *const sum_real = sums.real.data(), *const sum_imaginary = sums.imaginary.data();
  const std::size_t count = at.apart;
  for (std::size_t k = 0; k < count; k += 4) {
    FourDoubles of_real, of_imaginary;
    load(of_real, sum_real + k);
    load(of_imaginary, sum_imaginary + k);
    for (std::size_t i = 0; i < 4; ++i) {
      FourDoubles re, im;
      load(re, real + i * count + k);
      load(im, imaginary + i * count + k);
      of_real += re;
      of_imaginary += im;
    }
    store(of_real, sum_real + k);
    store(of_imaginary, sum_imaginary + k);
  }
}
/// Adds them times a factor each, and their squares times another.
TRUEFLANK_ALWAYS_INLINE inline void add_waves(const FourRows& at,
                                              const std::array<double, 4>& product,
                                              const std::array<double, 4>& square,
                                              WaveSums& products, WaveSums& squares) {
  const double *const real = at.real.data(), *const imaginary = at.imaginary.data();
  double *const product_real = products.real.data(),
                *const product_imaginary = products.imaginary.data(),
                *const square_real = squares.real.data(),
                *const square_imaginary = squares.imaginary.data();
  const std::size_t count = at.apart;
  const double of_product[4] = {product[0], product[1], product[2], product[3]},
               of_square[4] = {square[0], square[1], square[2], square[3]};
  for (std::size_t k = 0; k < count; k += 4) {
    FourDoubles sums[4];
    load(sums[0], product_real + k);
    load(sums[1], product_imaginary + k);
    load(sums[2], square_real + k);
    load(sums[3], square_imaginary + k);
    for (std::size_t i = 0; i < 4; ++i) {
      FourDoubles re, im;
      load(re, real + i * count + k);
      load(im, imaginary + i * count + k);
      sums[0] += of_product[i] * re;
      sums[1] += of_product[i] * im;
      sums[2] += of_square[i] * (re * re - im * im);
      sums[3] += of_square[i] * (2.0 * re * im);
    }
    store(sums[0], product_real + k);
    store(sums[1], product_imaginary + k);
    store(sums[2], square_real + k);
    store(sums[3], square_imaginary + k);
  }
}

/// Unit vectors in many directions.
struct Turns {
  explicit Turns(const std::vector<double>& angles) : cosine(angles.size()), sine(angles.size()) {
    sines_and_cosines(angles, sine, cosine);
  }
  std::vector<double> cosine, sine;
};

/// From value i on, as far as there are values.
FourWaves waves_at(const Turns& first, const Turns& turn, std::size_t i) {
  FourWaves waves;
  for (std::size_t k = 0; k < std::min<std::size_t>(4, first.sine.size() - i); ++k) {
    waves.real[k] = first.cosine[i + k];
    waves.imaginary[k] = first.sine[i + k];
    waves.turn_real[k] = turn.cosine[i + k];
    waves.turn_imaginary[k] = turn.sine[i + k];
  }
  return waves;
}

/// Gains of waves over a coordinate, of either shift, from a number of waves over the width on.
std::array<std::vector<PlaneGain>, 2> plane_gains(const PlaneValues& values, int by,
                                                  double width_mm, double first, double step,
                                                  std::size_t count) {
  const std::size_t rows = values.um.size();
  std::vector<double> first_angles, steps;
  for (const double at_mm : values.at_mm[static_cast<std::size_t>(by)]) {
    const double angle = kTwoPi * at_mm / width_mm;
    first_angles.push_back(first * angle);
    steps.push_back(step * angle);
  }
  const Turns of_first(first_angles), of_step(steps);
  FourRows at(in_fours(count));
  std::array<WaveSums, 2> products{WaveSums(at.apart), WaveSums(at.apart)}, squares = products;
  std::array<double, 2> normals{};
  for (std::size_t i = 0; i < rows; i += 4) {
    const FourWaves waves = waves_at(of_first, of_step, i);
    std::array<std::array<double, 4>, 2> product{}, square{};
    for (std::size_t k = 0; k < std::min<std::size_t>(4, rows - i); ++k)
      for (const std::size_t along : {0U, 1U}) {
        const double normal = values.normal[along][i + k];
        normals[along] += normal * normal;
        product[along][k] = normal * values.um[i + k];
        square[along][k] = normal * normal;
      }
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      write_waves(waves, at.apart, at.real.data(), at.imaginary.data(), at.apart);
      add_waves(at, product[0], square[0], products[0], squares[0]);
      add_waves(at, product[1], square[1], products[1], squares[1]);
    });
  }
  std::array<std::vector<PlaneGain>, 2> found;
  for (const std::size_t along : {0U, 1U})
    for (std::size_t k = 0; k < count; ++k)
      found[along].push_back(gain_of(products[along].of(k), squares[along].of(k), normals[along]));
  return found;
}

/// A sawtooth of nearly the wavelength in place of a wave, where it says clearly more.
void tell_as_saw(const PlaneValues& values, double width_mm, PlaneWave& wave) {
  constexpr double kClearlyMore = 1.25;
  constexpr int kPhases = 48, kPeriods = 6;
  const auto along = static_cast<std::size_t>(wave.along), by = static_cast<std::size_t>(wave.by);
  double best = kClearlyMore * wave.square;
  const PlaneWave as_wave = wave;
  for (int k = -kPeriods; k <= kPeriods; ++k) {
    // (over the gear a phase of a fraction of a period)
    constexpr double kStep = 0.04;
    const double period = 1.0 / (1.0 / as_wave.wavelength_mm + k * kStep / width_mm);
    for (int phase = 0; phase < kPhases; ++phase) {
      const double jump = period * phase / kPhases;
      double product = 0.0, square = 0.0;
      for (std::size_t i = 0; i < values.um.size(); ++i) {
        const double b =
            values.normal[along][i] * gear_effects::sawtooth(values.at_mm[by][i] - jump, period);
        product += b * values.um[i];
        square += b * b;
      }
      if (!(square > 0.0) || product * product / square <= best) continue;
      best = product * product / square;
      wave.square = best;
      wave.wavelength_mm = period;
      wave.jump_mm = jump;
      wave.amplitude_um = std::abs(product / square);
    }
  }
}

/// Waves of the plane, over the width of the gear, along x and along y.
using WaveVector = std::array<double, 2>;
constexpr double kFewestStripes = 1.0, kMostStripes = 12.0, kStripeStep = 0.4;
constexpr int kStripeSide = static_cast<int>(kMostStripes / kStripeStep);

double waves_apart(const WaveVector& a, const WaveVector& b) {
  // (a wave is the same towards both sides)
  return std::min(std::hypot(a[0] - b[0], a[1] - b[1]), std::hypot(a[0] + b[0], a[1] + b[1]));
}

/// Stripes of a grid, and what each takes out of every third value, about.
struct StripesOfGrid {
  std::vector<WaveVector> waves;
  std::vector<double> square;
};

StripesOfGrid stripes_of_grid(const PlaneValues& values, double width_mm) {
  StripesOfGrid found;
  std::vector<double> um, x, y, steps;
  for (std::size_t i = 0; i < values.um.size(); i += 3) {
    um.push_back(values.um[i]);
    x.push_back(kTwoPi * values.at_mm[0][i] / width_mm);
    y.push_back(kTwoPi * values.at_mm[1][i] / width_mm);
    steps.push_back(kStripeStep * y.back());
  }
  const Turns of_step(steps);
  const auto rows = static_cast<double>(um.size());
  std::vector<std::vector<double>> squares(static_cast<std::size_t>(kStripeSide) + 1);
  for_each_piece(squares.size(), [&](std::size_t k) {
    const double along_x = static_cast<double>(k) * kStripeStep;
    constexpr std::size_t kAll = 2 * kStripeSide + 1;
    std::vector<double> angles;
    for (std::size_t i = 0; i < um.size(); ++i)
      angles.push_back(along_x * x[i] - kStripeSide * kStripeStep * y[i]);
    const Turns first(angles);
    FourRows at(in_fours(kAll));
    WaveSums sums(at.apart);
    for (std::size_t i = 0; i < um.size(); i += 4) {
      FourWaves waves = waves_at(first, of_step, i);
      for (std::size_t v = 0; v < std::min<std::size_t>(4, um.size() - i); ++v) {
        waves.real[v] *= um[i + v];
        waves.imaginary[v] *= um[i + v];
      }
      in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
        write_waves(waves, at.apart, at.real.data(), at.imaginary.data(), at.apart);
        add_waves(at, sums);
      });
    }
    for (std::size_t j = 0; j < kAll; ++j)
      squares[k].push_back(
          2.0 * (sums.real[j] * sums.real[j] + sums.imaginary[j] * sums.imaginary[j]) / rows);
  });
  for (std::size_t k = 0; k < squares.size(); ++k)
    for (std::size_t j = 0; j < squares[k].size(); ++j) {
      const WaveVector wave{static_cast<double>(k) * kStripeStep,
                            (static_cast<double>(j) - kStripeSide) * kStripeStep};
      const double length = std::hypot(wave[0], wave[1]);
      if (length < kFewestStripes || length > kMostStripes || (k == 0 && wave[1] < 0.0)) continue;
      found.waves.push_back(wave);
      found.square.push_back(squares[k][j]);
    }
  return found;
}

PlaneGain gain_of_stripes(const PlaneValues& values, double width_mm, const WaveVector& wave) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < values.um.size(); ++i)
    angles.push_back(kTwoPi * (wave[0] * values.at_mm[0][i] + wave[1] * values.at_mm[1][i]) /
                     width_mm);
  const Turns turns(angles);
  std::complex<double> product, squares;
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    const double cosine = turns.cosine[i], sine = turns.sine[i];
    product += std::complex<double>(values.um[i] * cosine, values.um[i] * sine);
    squares += std::complex<double>(cosine * cosine - sine * sine, cosine * sine + sine * cosine);
  }
  return gain_of(product, squares, static_cast<double>(values.um.size()));
}

}  // namespace

std::optional<PlaneStripes> likeliest_plane_stripes(const FlankGeometry& geometry,
                                                    const Observations& table,
                                                    const std::vector<float>& row_um,
                                                    const std::vector<std::uint32_t>& rows) {
  constexpr double kClearly = 2.5, kBeside = 1.3;  // waves over the width
  const PlaneValues values = values_in_plane(geometry, table, row_um, rows);
  if (values.um.size() < kFewestRowsAsked) return {};
  const double width_mm = 2.0 * geometry.reference_radius_mm();
  const StripesOfGrid grid = stripes_of_grid(values, width_mm);
  const auto best = std::max_element(grid.square.begin(), grid.square.end()) - grid.square.begin();
  const double most = grid.square[static_cast<std::size_t>(best)];
  if (!(most > 0.0)) return {};
  const WaveVector on_grid = grid.waves[static_cast<std::size_t>(best)];
  WaveVector wave = on_grid;
  const double usual =
      median(std::vector<double>(grid.square)) / std::log(2.0);  // their mean, of chance
  if (!(usual > 0.0)) return {};
  PlaneStripes found;
  found.p_value = std::min(1.0, static_cast<double>(grid.waves.size()) * std::exp(-most / usual));
  constexpr double kSure = 1e-3;
  if (found.p_value > kSure) return {};
  // Between the steps.
  PlaneGain gain = gain_of_stripes(values, width_mm, wave);
  for (double step = 0.5 * kStripeStep; step > 0.01; step *= 0.5)
    for (bool moved = true; moved;) {
      moved = false;
      for (const WaveVector& off : {WaveVector{step, 0.0}, WaveVector{-step, 0.0},
                                    WaveVector{0.0, step}, WaveVector{0.0, -step}}) {
        const WaveVector tried{wave[0] + off[0], wave[1] + off[1]};
        const PlaneGain with = gain_of_stripes(values, width_mm, tried);
        if (!(with.square > gain.square)) continue;
        gain = with;
        wave = tried;
        moved = true;
      }
    }
  // What takes out nearly all needs no comparison: the teeth let others look alike. (Waves as long
  // as the gear look like ovality.)
  constexpr double kNearlyAll = 0.7, kFewestOfThese = 2.0;
  double all = 0.0;
  for (const double um : values.um) all += um * um;
  if (gain.square < kNearlyAll * all || std::hypot(wave[0], wave[1]) < kFewestOfThese)
    for (std::size_t i = 0; i < grid.waves.size(); ++i)
      if (kClearly * grid.square[i] > most && waves_apart(grid.waves[i], on_grid) > kBeside)
        return {};
  found.direction_deg = deg_from_rad(std::atan2(wave[1], wave[0]));
  found.wavelength_mm = width_mm / std::hypot(wave[0], wave[1]);
  found.amplitude_um = gain.amplitude_um;
  found.square =
      gain.square * static_cast<double>(values.rows) / static_cast<double>(values.um.size());
  return found;
}

std::vector<PlaneWave> likeliest_pixels(const FlankGeometry& geometry, const Observations& table,
                                        const std::vector<float>& row_um,
                                        const std::vector<std::uint32_t>& rows) {
  // (the width of the gear over the smallest pixel; a wave that takes out as little is no pixel)
  constexpr double kFinest_mm = 0.012, kSure = 1e-6, kFewestOfAll = 0.05;
  const PlaneValues values = values_in_plane(geometry, table, row_um, rows);
  const double width_mm = 2.0 * geometry.reference_radius_mm();
  const double most = width_mm / kFinest_mm;
  if (values.um.size() < kFewestRowsAsked || most <= kMostPlaneWaves) return {};
  constexpr std::size_t kOfPiece = 500;
  const auto count = static_cast<std::size_t>((most - kMostPlaneWaves) / kPlaneStep);
  const std::size_t pieces = count / kOfPiece + 1;
  std::vector<std::vector<PlaneGain>> of(2 * pieces);
  for_each_piece(of.size(), [&](std::size_t k) {
    const std::size_t by = k % 2, piece = k / 2;
    const double first = kMostPlaneWaves + kPlaneStep * static_cast<double>(piece * kOfPiece);
    of[k] = plane_gains(values, static_cast<int>(by), width_mm, first, kPlaneStep, kOfPiece)[by];
  });
  double all = 0.0;
  for (const double um : values.um) all += um * um;
  std::vector<PlaneWave> found;
  for (const std::size_t by : {0U, 1U}) {
    std::vector<double> squares;
    std::size_t best = 0;
    for (std::size_t piece = 0; piece < pieces; ++piece)
      for (const PlaneGain& gain : of[2 * piece + by]) {
        if (!squares.empty() && gain.square > squares[best]) best = squares.size();
        squares.push_back(gain.square);
      }
    const double usual = median(std::vector<double>(squares)) / std::log(2.0);
    if (!(usual > 0.0) || squares[best] < kFewestOfAll * all) continue;
    PlaneWave saw{.along = static_cast<int>(by), .by = static_cast<int>(by)};
    saw.p_value =
        std::min(1.0, 2.0 * static_cast<double>(squares.size()) * std::exp(-squares[best] / usual));
    if (saw.p_value > kSure) continue;
    constexpr std::size_t kFiner = 17;
    const double first = kMostPlaneWaves + kPlaneStep * (static_cast<double>(best) - 1.0),
                 step = 2.0 * kPlaneStep / (kFiner - 1);
    const auto finer = plane_gains(values, saw.by, width_mm, first, step, kFiner)[by];
    const auto finest = std::max_element(
        finer.begin(), finer.end(),
        [](const PlaneGain& a, const PlaneGain& b) { return a.square < b.square; });
    saw.wavelength_mm = width_mm / (first + step * static_cast<double>(finest - finer.begin()));
    saw.amplitude_um = finest->amplitude_um;
    saw.square = finest->square;
    tell_as_saw(values, width_mm, saw);
    if (!std::isnan(saw.jump_mm)) found.push_back(saw);
  }
  return found;
}

std::optional<PlaneWave> likeliest_plane_wave(const FlankGeometry& geometry,
                                              const Observations& table,
                                              const std::vector<float>& row_um,
                                              const std::vector<std::uint32_t>& rows) {
  constexpr double kClearly = 2.5;
  constexpr std::size_t kBeside = 4, kFiner = 9;
  const PlaneValues values = values_in_plane(geometry, table, row_um, rows);
  if (values.um.size() < kFewestRowsAsked) return {};
  const double width_mm = 2.0 * geometry.reference_radius_mm();
  const auto count =
      static_cast<std::size_t>((kMostPlaneWaves - kFewestPlaneWaves) / kPlaneStep) + 1;
  std::array<std::array<std::vector<PlaneGain>, 2>, 2> of;  // by coordinate, then by shift
  for_each_piece(2, [&](std::size_t by) {
    of[by] =
        plane_gains(values, static_cast<int>(by), width_mm, kFewestPlaneWaves, kPlaneStep, count);
  });
  std::size_t best_by = 0, best_along = 0, best = 0;
  const auto at = [&](std::size_t by, std::size_t along, std::size_t k) -> const PlaneGain& {
    return of[by][along][k];
  };
  for (const std::size_t by : {0U, 1U})
    for (const std::size_t along : {0U, 1U})
      for (std::size_t k = 0; k < count; ++k)
        if (at(by, along, k).square > at(best_by, best_along, best).square) {
          best_by = by;
          best_along = along;
          best = k;
        }
  const double most = at(best_by, best_along, best).square;
  if (!(most > 0.0)) return {};
  std::vector<double> others;
  for (const std::size_t by : {0U, 1U})
    for (const std::size_t along : {0U, 1U})
      for (std::size_t k = 0; k < count; ++k) {
        const bool own = by == best_by && along == best_along;
        if (own) others.push_back(at(by, along, k).square);
        if (own && k + kBeside >= best && k <= best + kBeside) continue;
        if (kClearly * at(by, along, k).square > most) return {};
      }
  const double usual = median(std::move(others)) / std::log(2.0);  // their mean, of chance
  if (!(usual > 0.0)) return {};
  PlaneWave found{.along = static_cast<int>(best_along), .by = static_cast<int>(best_by)};
  found.p_value = std::min(1.0, 4.0 * static_cast<double>(count) * std::exp(-most / usual));
  // Between the steps.
  const double first = kFewestPlaneWaves + kPlaneStep * (static_cast<double>(best) - 1.0),
               step = 2.0 * kPlaneStep / (kFiner - 1);
  const auto finer =
      plane_gains(values, found.by, width_mm, std::max(first, step), step, kFiner)[best_along];
  const auto finest =
      std::max_element(finer.begin(), finer.end(),
                       [](const PlaneGain& a, const PlaneGain& b) { return a.square < b.square; });
  found.wavelength_mm =
      width_mm / (std::max(first, step) + step * static_cast<double>(finest - finer.begin()));
  found.amplitude_um = finest->amplitude_um;
  found.square = finest->square;
  constexpr double kSure = 1e-3;
  if (found.p_value < kSure) tell_as_saw(values, width_mm, found);
  found.square *= static_cast<double>(values.rows) / static_cast<double>(values.um.size());
  return found;
}

}  // namespace trueflank::loop
