// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/flank_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

using Complex = std::complex<double>;

/// Waves asked about, in halves: up to six over the profile, sixteen over the face.
constexpr int kProfile = 12, kFace = 32, kColumns = 2 * kFace + 1;
constexpr std::size_t kMostValues = 40000;
constexpr int kFewestTeeth = 8;
/// A flank with fewer values tells nothing of waves in it.
constexpr int kFewestValues = 12;

/// Without the special cases of infinite numbers, which take most of the time of `*`.
Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

struct Value {
  int tooth = 0, side = 0;
  double u = 0.0, v = 0.0, um = 0.0;  ///< u, v: 0 ... 1
};

/// Values that are added at once.
constexpr std::size_t kAtOnce = 4;

/// Sums over values of the four products of cosines and sines over the profile and over the face.
class WaveProducts {
 public:
  /// At most kAtOnce of them.
  void add(std::span<const Value* const> values) {
    std::array<std::array<double, kAlong>, kAtOnce> along{};
    std::array<std::array<double, kRow>, kAtOnce> across{};
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
  static_assert(kAtOnce == 4 && kRow % 4 == 0);
  std::array<std::array<double, kRow>, kAlong> sums_{};
};

class Spectrum {
 public:
  Spectrum(const FlankGeometry& geometry, const Observations& table,
           const std::vector<float>& row_um, const std::vector<bool>& used)
      : teeth_(geometry.teeth()), flanks_(2 * static_cast<std::size_t>(teeth_)) {
    gather(geometry, table, row_um, used);
    for (std::size_t f = 0; f < flanks_.size(); ++f)
      if (flanks_[f].count >= kFewestValues) ++known_;
  }

  FlankSpectrum run() {
    if (known_ < 2 * kFewestTeeth) return {};
    take_means_off();
    transform();
    return {largest_wave(), apart()};
  }

 private:
  struct Flank {
    int count = 0;
    double mean = 0.0;
    std::vector<Complex> sums;  ///< over kProfile + 1 by kColumns waves
  };
  static std::size_t at(int a, int b) { return static_cast<std::size_t>(a * kColumns + b + kFace); }
  Flank& flank_of(const Value& value) {
    return flanks_[static_cast<std::size_t>(2 * (value.tooth - 1) + value.side)];
  }

  void gather(const FlankGeometry& geometry, const Observations& table,
              const std::vector<float>& row_um, const std::vector<bool>& used) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < used.size(); ++i)
      count += used[i] && table.rows[i].kind == ObservationKind::kScanFlank ? 1 : 0;
    if (count == 0) return;
    // Of many values some, in no rhythm with the lines of the scan.
    const double share =
        std::min(1.0, static_cast<double>(kMostValues) / static_cast<double>(count));
    const auto most = static_cast<std::uint64_t>(share * 4294967296.0);
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (((i * 2654435761ull) & 0xffffffffull) >= most) continue;
      if (!used[i] || table.rows[i].kind != ObservationKind::kScanFlank) continue;
      const Place& place = table.place(table.rows[i]);
      values_.push_back({place.tooth, place.side > 0 ? 1 : 0,
                         0.5 * (geometry.profile_coordinate(place.roll_mm) + 1.0),
                         0.5 * (geometry.face_coordinate(place.z_mm) + 1.0), row_um[i]});
      Flank& flank = flank_of(values_.back());
      ++flank.count;
      flank.mean += row_um[i];
    }
  }

  void take_means_off() {
    for (Flank& flank : flanks_) flank.mean /= std::max(1, flank.count);
    double square = 0.0;
    for (Value& value : values_) {
      value.um -= flank_of(value).mean;
      square += value.um * value.um;
    }
    // Wild values count no more than a few spreads.
    const double most = 4.0 * std::sqrt(square / static_cast<double>(values_.size()));
    for (Value& value : values_) value.um = std::clamp(value.um, -most, most);
  }

  /// Values in the order of their flanks; `first` of each flank.
  [[nodiscard]] std::vector<const Value*> by_flank(std::vector<std::size_t>& first) {
    first.assign(flanks_.size() + 1, 0);
    for (std::size_t f = 0; f < flanks_.size(); ++f)
      first[f + 1] = first[f] + static_cast<std::size_t>(flanks_[f].count);
    std::vector<std::size_t> next = first;
    std::vector<const Value*> sorted(values_.size());
    for (const Value& value : values_)
      sorted[next[static_cast<std::size_t>(&flank_of(value) - flanks_.data())]++] = &value;
    return sorted;
  }

  /// Sums of all waves of every flank. Cosines and sines over the profile times those over the
  /// face: waves that rise and waves that fall are made of the same four products.
  void transform() {
    std::vector<std::size_t> first;
    const std::vector<const Value*> sorted = by_flank(first);
    // Flanks do not ask each other: the same sums on any number of processors.
    for_each_piece(flanks_.size(), [&](std::size_t f) {
      Flank& flank = flanks_[f];
      WaveProducts products;
      const std::size_t end = first[f + 1];
      for (std::size_t next = first[f]; next < end; next += kAtOnce)
        products.add({sorted.data() + next, std::min(kAtOnce, end - next)});
      flank.sums.assign(static_cast<std::size_t>((kProfile + 1) * kColumns), 0.0);
      for (int a = 0; a <= kProfile; ++a)
        for (int b = 0; b <= kFace; ++b) {
          flank.sums[at(a, b)] = products.sum(a, b, 1.0);
          flank.sums[at(a, -b)] = products.sum(a, b, -1.0);
        }
    });
  }

  /// Power of all orders at one pair of wavelengths on one side.
  void powers(int a, int b, int side, std::vector<double>& power) const {
    power.assign(static_cast<std::size_t>(teeth_), 0.0);
    double count = 0.0;
    for (int k = 0; k < teeth_; ++k) count += flanks_[static_cast<std::size_t>(2 * k + side)].count;
    for (int n = 0; n < teeth_; ++n) {
      const Complex step = std::polar(1.0, -kTwoPi * n / teeth_);
      Complex sum = 0.0, turn = 1.0;
      for (int k = 0; k < teeth_; ++k, turn = product(turn, step))
        sum += product(flanks_[static_cast<std::size_t>(2 * k + side)].sums[at(a, b)], turn);
      power[static_cast<std::size_t>(n)] = std::norm(sum) / std::max(1.0, count);
    }
  }

  /// The powers of all orders at one pair of wavelengths on one side, in short.
  struct Orders {
    int a = 0, b = 0, order = 0;
    double median = 0.0, largest = 0.0;
  };

  Orders orders_at(int a, int b, int side, std::vector<double>& power) const {
    powers(a, b, side, power);
    Orders found{a, b};
    for (int n = 0; n < teeth_; ++n) {
      // The same on every tooth along one direction is looked for elsewhere.
      if (n == 0 && (a < 1 || std::abs(b) < 1)) continue;
      if (power[static_cast<std::size_t>(n)] <= found.largest) continue;
      found.largest = power[static_cast<std::size_t>(n)];
      found.order = 2 * n > teeth_ ? n - teeth_ : n;
    }
    found.median = median(power);
    return found;
  }

  std::optional<FlankWaves> largest_wave() const {
    std::array<std::vector<Orders>, 2> of_side;
    std::array<double, 2> usual{};  // a probe may be noisier on one side
    std::vector<double> power;
    for (std::size_t side = 0; side < 2; ++side)
      for (int a = 0; a <= kProfile; ++a)
        for (int b = a == 0 ? 4 : -kFace; b <= kFace; ++b) {
          if (a + std::abs(b) < 4) continue;
          of_side[side].push_back(orders_at(a, b, static_cast<int>(side), power));
          usual[side] += of_side[side].back().median;
        }
    if (!(usual[0] > 0.0 && usual[1] > 0.0)) return {};
    double best = 0.0;
    FlankWaves found;
    for (std::size_t i = 0; i < of_side[0].size(); ++i) {
      const double level =
          0.5 * (of_side[0][i].median / usual[0] + of_side[1][i].median / usual[1]) / std::log(2.0);
      for (std::size_t side = 0; side < 2 && level > 0.0; ++side) {
        const Orders& one = of_side[side][i];
        const double ratio = one.largest / usual[side] / level;
        if (ratio <= best) continue;
        best = ratio;
        found = {1.0, side == 1 ? 1 : -1, 0.5 * one.a, 0.5 * one.b, one.order, 0.0};
      }
    }
    // The level is a median of as many: known as well as a mean of half of them.
    const double known = teeth_, tested = 2.0 * teeth_ * static_cast<double>(of_side[0].size());
    found.p_value = std::min(1.0, tested * std::pow(1.0 + best / known, -known));
    if (found.p_value >= 1.0) return {};
    sharpen(found);
    return found;
  }

  static constexpr int kAround = 2, kSteps = 2 * kAround + 1;
  using Amplitudes = std::array<std::array<double, kSteps>, kSteps>;

  /// Wavelengths between those asked about, and the amplitude.
  void sharpen(FlankWaves& wave) const {
    double best = 0.0;
    for (const double step : {0.25, 0.1, 0.04, 0.016}) {
      const double a = wave.waves_profile, b = wave.waves_face;
      const Amplitudes amplitudes = amplitudes_around(wave, step);
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double amplitude =
              amplitudes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
          if (amplitude <= best) continue;
          best = amplitude;
          wave.waves_profile = a + (i - kAround) * step;
          wave.waves_face = b + (j - kAround) * step;
        }
    }
    wave.amplitude_um = best;
  }

  /// Amplitudes of a wave and of those some steps of wavelength off.
  [[nodiscard]] Amplitudes amplitudes_around(const FlankWaves& wave, double step) const {
    std::array<std::array<Complex, kSteps>, kSteps> sums{};
    double count = 0.0;
    for (const Value& value : values_) {
      if ((value.side == 1) != (wave.side > 0)) continue;
      const double phase = (wave.waves_profile - kAround * step) * value.u +
                           (wave.waves_face - kAround * step) * value.v +
                           static_cast<double>(wave.order) * (value.tooth - 1) / teeth_;
      const Complex step_u = std::polar(1.0, -kTwoPi * step * value.u),
                    step_v = std::polar(1.0, -kTwoPi * step * value.v);
      Complex of_row = value.um * std::polar(1.0, -kTwoPi * phase);
      for (auto& row : sums) {
        Complex turned = of_row;
        for (Complex& sum : row) {
          sum += turned;
          turned = product(turned, step_v);
        }
        of_row = product(of_row, step_u);
      }
      count += 1.0;
    }
    Amplitudes amplitudes{};
    for (std::size_t i = 0; i < kSteps; ++i)
      for (std::size_t j = 0; j < kSteps; ++j)
        amplitudes[i][j] = 2.0 * std::abs(sums[i][j]) / std::max(1.0, count);
    return amplitudes;
  }

  /// Squares of one Fourier sum of the flanks, in shares of their values, about the mean of their
  /// side.
  std::vector<double> squares_at(int a, int b) const {
    std::array<Complex, 2> mean{};
    std::array<double, 2> count{};
    const auto sum_of = [&](const Flank& flank) {
      return a == 0 && b == 0 ? Complex(flank.mean * flank.count) : flank.sums[at(a, b)];
    };
    for (std::size_t f = 0; f < flanks_.size(); ++f) {
      mean[f % 2] += sum_of(flanks_[f]);
      count[f % 2] += flanks_[f].count;
    }
    std::vector<double> squares;
    for (std::size_t f = 0; f < flanks_.size(); ++f) {
      const Flank& flank = flanks_[f];
      if (flank.count < kFewestValues) continue;
      squares.push_back(std::norm(sum_of(flank) - mean[f % 2] * (flank.count / count[f % 2])) /
                        flank.count);
    }
    return squares;
  }

  /// What the errors alone make of the heights of the flanks.
  struct LevelOfHeights {
    double level = 0.0;    ///< 0: not bounded
    double degrees = 0.0;  ///< how well it is known, as of a chi-square
  };

  /// Told by one and two waves along one direction. No spectrum of errors that hang together over
  /// some length rises further towards long waves than one of which each error keeps a share of the
  /// last: its inverse is a straight line over the square of the frequency.
  [[nodiscard]] LevelOfHeights extended_level(double one, double two) const {
    const double inverse = (4.0 / one - 1.0 / two) / 3.0;
    const double variance = (16.0 / (one * one) + 1.0 / (two * two)) / 9.0 / (kToldByWaves * known_);
    if (!(inverse > 0.0) || !std::isfinite(inverse)) return {};
    return {1.0 / inverse, 2.0 * inverse * inverse / variance};
  }

  /// The most it can be where errors hang together over no more than so many values in a row: a
  /// slower one is a form of each flank.
  [[nodiscard]] LevelOfHeights most_level(double one, double two, double values) const {
    constexpr double kHangTogether = 12.0;
    const double x = std::pow(kTwoPi * kHangTogether / values, 2);
    return {0.5 * (one * (1.0 + x) + two * (1.0 + 4.0 * x)), kToldByWaves * known_};
  }

  /// Heights of the flanks against the longest waves within them, over the face and over the
  /// profile: the direction that allows more.
  std::optional<TeethApart> apart() const {
    constexpr double kMedianOfSquare = 0.4549, kClearly = 1.6;
    // A median tells less than a mean: of a chi-square with one degree as much as 0.37 of the
    // values.
    constexpr double kToldByMedian = 0.37;
    std::vector<double> squares = squares_at(0, 0);
    const double height = median(squares) / kMedianOfSquare;
    double values = 0.0, sum = 0.0;
    for (const Flank& flank : flanks_) values += flank.count;
    for (const double square : squares) sum += square;
    TeethApart found;
    found.p_value = 0.0;
    double level = 0.0;
    for (const auto& [a, b] : {std::array{0, 2}, std::array{2, 0}}) {
      const double one = median(squares_at(a, b)) / std::log(2.0),
                   two = median(squares_at(2 * a, 2 * b)) / std::log(2.0);
      double least = 1.0, of_least = 0.0;
      for (const LevelOfHeights& errors : {extended_level(one, two), most_level(one, two, values / known_)}) {
        if (!(errors.level > 0.0) || height < kClearly * errors.level) continue;
        // Either bound holds: two tests.
        const double p = 2.0 * f_tail(height / errors.level, kToldByMedian * known_, errors.degrees);
        if (p >= least) continue;
        least = p;
        of_least = errors.level;
      }
      if (least >= 1.0) return {};
      found.p_value = std::max(found.p_value, least);
      level = std::max(level, of_least);
    }
    found.spread_um = std::sqrt(std::max(0.0, sum / known_ - level)) / std::sqrt(values / known_);
    return found;
  }

  /// A median of exponentials is known as well as a mean of so many of them.
  static constexpr double kToldByWaves = 0.48;

  int teeth_, known_ = 0;
  std::vector<Flank> flanks_;
  std::vector<Value> values_;
};

}  // namespace

FlankSpectrum flank_spectrum(const FlankGeometry& geometry, const Observations& table,
                             const std::vector<float>& row_um, const std::vector<bool>& used) {
  return Spectrum(geometry, table, row_um, used).run();
}

}  // namespace trueflank::loop
