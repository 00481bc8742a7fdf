// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/plane/plane_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/effects/along_flank.h"
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

/// Adds waves times a factor, and their squares times another; no two of the arrays are the same.
TRUEFLANK_ALWAYS_INLINE inline void add_waves(std::size_t count, const double* __restrict real,
                                              const double* __restrict imaginary, double product,
                                              double square, double* __restrict product_real,
                                              double* __restrict product_imaginary,
                                              double* __restrict square_real,
                                              double* __restrict square_imaginary) {
  for (std::size_t k = 0; k < count; ++k) {
    const double re = real[k], im = imaginary[k];
    product_real[k] += product * re;
    product_imaginary[k] += product * im;
    square_real[k] += square * (re * re - im * im);
    square_imaginary[k] += square * (2.0 * re * im);
  }
}

/// Sums over values of waves of a row of wavelengths: of either shift, real and imaginary parts
/// apart, as registers hold them.
struct PlaneSums {
  explicit PlaneSums(std::size_t count)
      : real(count), imaginary(count), of(kSums, std::vector<double>(count)) {}
  enum Sum : std::size_t { kProductReal, kProductImaginary, kSquareReal, kSquareImaginary };
  static constexpr std::size_t kSums = 8;  // those of a shift, then of the other
  [[nodiscard]] std::complex<double> sum(std::size_t along, Sum real_part, std::size_t k) const {
    return {of[4 * along + real_part][k], of[4 * along + real_part + 1][k]};
  }
  /// Adds a value, with the waves as they are at it.
  void add(double nx, double ny, double um) {
    const std::array<double, 4> factor{nx * um, ny * um, nx * nx, ny * ny};
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      for (const std::size_t along : {0U, 1U})
        add_waves(real.size(), real.data(), imaginary.data(), factor[along], factor[along + 2],
                  of[4 * along].data(), of[4 * along + 1].data(), of[4 * along + 2].data(),
                  of[4 * along + 3].data());
    });
  }
  std::vector<double> real, imaginary;  ///< of the waves at a value
  std::vector<std::vector<double>> of;
};

/// Gains of waves over a coordinate, of either shift, from a number of waves over the width on.
std::array<std::vector<PlaneGain>, 2> plane_gains(const PlaneValues& values, int by,
                                                  double width_mm, double first, double step,
                                                  std::size_t count) {
  PlaneSums sums(count);
  std::array<double, 2> normals{};
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    const double angle = kTwoPi * values.at_mm[static_cast<std::size_t>(by)][i] / width_mm;
    const std::complex<double> turn = std::polar(1.0, step * angle);
    std::complex<double> wave = std::polar(1.0, first * angle);
    const double nx = values.normal[0][i], ny = values.normal[1][i];
    normals[0] += nx * nx;
    normals[1] += ny * ny;
    for (std::size_t k = 0; k < count; ++k) {
      const double real = sums.real[k] = wave.real(), imaginary = sums.imaginary[k] = wave.imag();
      wave = {real * turn.real() - imaginary * turn.imag(),
              real * turn.imag() + imaginary * turn.real()};
    }
    sums.add(nx, ny, values.um[i]);
  }
  std::array<std::vector<PlaneGain>, 2> found;
  for (const std::size_t along : {0U, 1U})
    for (std::size_t k = 0; k < count; ++k)
      found[along].push_back(gain_of(sums.sum(along, PlaneSums::kProductReal, k),
                                     sums.sum(along, PlaneSums::kSquareReal, k), normals[along]));
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
  const std::size_t count = values.um.size();
  StripesOfGrid found;
  std::vector<std::vector<double>> squares(static_cast<std::size_t>(kStripeSide) + 1);
  for_each_piece(squares.size(), [&](std::size_t k) {
    const double along_x = static_cast<double>(k) * kStripeStep;
    constexpr std::size_t kAll = 2 * kStripeSide + 1;
    std::array<double, kAll> real{}, imaginary{};
    double rows = 0.0;
    for (std::size_t i = 0; i < count; i += 3) {
      rows += 1.0;
      const double x = kTwoPi * values.at_mm[0][i] / width_mm,
                   y = kTwoPi * values.at_mm[1][i] / width_mm;
      const std::complex<double> turn = std::polar(1.0, kStripeStep * y);
      std::complex<double> wave =
          values.um[i] * std::polar(1.0, along_x * x - kStripeSide * kStripeStep * y);
      for (std::size_t j = 0; j < kAll; ++j) {
        real[j] += wave.real();
        imaginary[j] += wave.imag();
        wave = {wave.real() * turn.real() - wave.imag() * turn.imag(),
                wave.real() * turn.imag() + wave.imag() * turn.real()};
      }
    }
    for (std::size_t j = 0; j < kAll; ++j)
      squares[k].push_back(2.0 * (real[j] * real[j] + imaginary[j] * imaginary[j]) / rows);
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
  std::complex<double> product, squares;
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    const double angle =
        kTwoPi * (wave[0] * values.at_mm[0][i] + wave[1] * values.at_mm[1][i]) / width_mm;
    const std::complex<double> turn = std::polar(1.0, angle);
    product += values.um[i] * turn;
    squares += turn * turn;
  }
  return gain_of(product, squares, static_cast<double>(values.um.size()));
}

}  // namespace

std::optional<PlaneStripes> likeliest_plane_stripes(const FlankGeometry& geometry,
                                                    const Observations& table,
                                                    const std::vector<float>& row_um,
                                                    const std::vector<bool>& used) {
  constexpr double kClearly = 2.5, kBeside = 1.3;  // waves over the width
  const PlaneValues values = values_in_plane(geometry, table, row_um, used);
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
                                        const std::vector<bool>& used) {
  // (the width of the gear over the smallest pixel; a wave that takes out as little is no pixel)
  constexpr double kFinest_mm = 0.012, kSure = 1e-6, kFewestOfAll = 0.05;
  const PlaneValues values = values_in_plane(geometry, table, row_um, used);
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
                                              const std::vector<bool>& used) {
  constexpr double kClearly = 2.5;
  constexpr std::size_t kBeside = 4, kFiner = 9;
  const PlaneValues values = values_in_plane(geometry, table, row_um, used);
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
