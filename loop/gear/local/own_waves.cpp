// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/own_waves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop::flank_waves {
namespace {

class OwnWaveSearch {
 public:
  OwnWaveSearch(const std::vector<FlankSums>& flanks, const std::vector<Value>& values,
                const WavesAsked& asked)
      : flanks_(flanks), values_(values), asked_(asked) {}

  /// Waves of one length on every flank, each in its own phase. Askew: those alike all along one
  /// direction are told as forms of the flanks.
  std::vector<OwnWaves> run() const {
    constexpr double kLevel = 1e-4;
    constexpr double kFewest = 8.0;  // flanks
    std::array<std::vector<double>, 2> levels;
    std::array<OwnWaves, 2> peaks;
    for (const std::size_t side : {0U, 1U}) {
      if (known(side) < kFewest) continue;
      levels[side] = levels_of_side(side);
      peaks[side] = own_peak(side, levels[side], [](int, int) { return true; });
    }
    std::vector<OwnWaves> found;
    for (const std::size_t side : {1U, 0U}) {
      // What the other flanks have surely is sought about there alone.
      const OwnWaves& other = peaks[1 - side];
      if (!levels[side].empty() && peaks[side].p_value > kLevel && other.p_value <= kLevel)
        peaks[side] = own_peak(side, levels[side], [&](int a, int b) {
          return std::abs(a - 2.0 * other.waves_profile) <= 1.0 &&
                 std::abs(std::abs(b) - 2.0 * std::abs(other.waves_face)) <= 1.0;
        });
      if (peaks[side].p_value > kLevel) continue;
      found.push_back(peaks[side]);
      sharpen_own(found.back());
    }
    return found;
  }

 private:
  static constexpr int kAround = 2;

  /// Flanks of a side with values enough.
  double known(std::size_t side) const {
    double count = 0.0;
    for (std::size_t f = side; f < flanks_.size(); f += 2)
      count += flanks_[f].count >= kFewestValues ? 1.0 : 0.0;
    return count;
  }

  /// How large the usual flank of a side is at every wavelength, about what its side has in common:
  /// mean squares of Fourier sums in shares of their values.
  std::vector<double> levels_of_side(std::size_t side) const {
    std::vector<double> levels(static_cast<std::size_t>((kProfile + 1) * kColumns), 0.0);
    for_each_piece(static_cast<std::size_t>(asked_.most_profile + 1), [&](std::size_t a) {
      for (int b = -asked_.most_face; b <= asked_.most_face; ++b) {
        const auto wave = FlankSums::at(static_cast<int>(a), b);
        Complex mean{};
        double count = 0.0;
        for (std::size_t f = side; f < flanks_.size(); f += 2) {
          mean += Complex(flanks_[f].real[wave], flanks_[f].imaginary[wave]);
          count += flanks_[f].count;
        }
        std::vector<double> squares;
        for (std::size_t f = side; f < flanks_.size(); f += 2)
          if (const double own = flanks_[f].count; own >= kFewestValues)
            squares.push_back(std::norm(Complex(flanks_[f].real[wave], flanks_[f].imaginary[wave]) -
                                        mean * (own / count)) /
                              own);
        levels[wave] = median(squares) / std::log(2.0);
      }
    });
    return levels;
  }

  /// The largest of what stands beside a wavelength in any direction: errors that hang together
  /// along lines of the scan make ridges, not peaks. 0: there is too little.
  double level_around(const std::vector<double>& levels, int a, int b) const {
    constexpr int kNear = 4, kFar = 8;  // (a strong wave shows within two of its length)
    constexpr std::array<std::array<int, 2>, 4> kWays{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    double largest = 0.0;
    for (const auto& [along, across] : kWays) {
      std::vector<double> beside;
      for (const int sign : {1, -1})
        for (int off = kNear; off <= kFar; ++off) {
          const int i = a + sign * off * along, j = b + sign * off * across;
          if (i >= 0 && i <= asked_.most_profile && std::abs(j) <= asked_.most_face)
            beside.push_back(levels[FlankSums::at(i, j)]);
        }
      if (beside.size() < 3) return 0.0;
      largest = std::max(largest, median(beside));
    }
    return largest;
  }

  /// What stands between no waves and these: errors that hang together rise towards long waves.
  static double level_inside(const std::vector<double>& levels, int a, int b) {
    std::vector<double> inside;
    for (int i = 0; 2 * i <= a; ++i)
      for (int j = 0; 2 * j <= std::abs(b); ++j)
        if (i + j > 0) inside.push_back(levels[FlankSums::at(i, b < 0 ? -j : j)]);
    return median(std::move(inside));
  }

  /// The largest peak of a side among the wavelengths asked for: `asked(a, b)`.
  template <class Asked>
  OwnWaves own_peak(std::size_t side, const std::vector<double>& levels, const Asked& asked) const {
    constexpr double kClearly = 2.0, kAboveLonger = 3.0;
    constexpr int kFewestEach = 2, kFewestOfBoth = 6;  // halves of a wave
    const double degrees = kToldByWaves * known(side);
    OwnWaves best{.side = side == 1 ? 1 : -1};
    double power = 0.0;
    int looks = 0;
    for (int a = kFewestEach; a <= asked_.most_profile; ++a)
      for (int b = -asked_.most_face; b <= asked_.most_face; ++b) {
        if (std::abs(b) < kFewestEach || a + std::abs(b) < kFewestOfBoth || !asked(a, b)) continue;
        const double own = levels[FlankSums::at(a, b)], beside = level_around(levels, a, b);
        if (!(beside > 0.0)) continue;
        ++looks;
        if (own < kClearly * beside || own <= power ||
            own < kAboveLonger * level_inside(levels, a, b))
          continue;
        power = own;
        best.p_value = f_tail(own / beside, degrees, degrees);
        best.waves_profile = 0.5 * a;
        best.waves_face = 0.5 * b;
      }
    best.p_value = std::min(1.0, 2.0 * std::max(1, looks) * best.p_value);
    return best;
  }

  /// The wavelengths at which the flanks' own waves are largest, each in its phase, and how large.
  void sharpen_own(OwnWaves& wave) const {
    double best = 0.0;
    for (const double step : {0.2, 0.08, 0.03}) {
      const double a = wave.waves_profile, b = wave.waves_face;
      for (int i = -kAround; i <= kAround; ++i)
        for (int j = -kAround; j <= kAround; ++j)
          if (const double square = own_square(wave.side, a + i * step, b + j * step);
              square > best) {
            best = square;
            wave.waves_profile = a + i * step;
            wave.waves_face = b + j * step;
          }
    }
    wave.amplitude_um = std::sqrt(best);
  }

  /// The mean square of the amplitudes that the flanks of a side have at some wavelength, less what
  /// chance has.
  double own_square(int side, double waves_profile, double waves_face) const {
    std::vector<Complex> sums(flanks_.size());
    std::vector<double> squares(flanks_.size(), 0.0);
    for (const Value& value : values_) {
      if ((value.side == 1) != (side > 0)) continue;
      const auto flank = static_cast<std::size_t>(2 * (value.tooth - 1) + value.side);
      sums[flank] +=
          std::polar(value.um, -kTwoPi * (waves_profile * value.u + waves_face * value.v));
      squares[flank] += value.um * value.um;
    }
    double sum = 0.0, wholes = 0.0;
    for (std::size_t f = 0; f < flanks_.size(); ++f) {
      const double count = flanks_[f].count;
      if (count < kFewestValues || !(squares[f] > 0.0)) continue;
      // A = 2 |s| / n; beside it each value keeps the rest of its variance, of which |s|^2 has n
      // times.
      const double with_chance = 4.0 * std::norm(sums[f]) / (count * count);
      const double rest = std::max(0.0, squares[f] - 0.5 * with_chance * count) / count;
      sum += with_chance - 4.0 * rest / count;
      wholes += 1.0;
    }
    return std::max(0.0, sum / std::max(1.0, wholes));
  }

  const std::vector<FlankSums>& flanks_;
  const std::vector<Value>& values_;
  const WavesAsked asked_;
};

}  // namespace

std::vector<OwnWaves> own_waves(const std::vector<FlankSums>& flanks,
                                const std::vector<Value>& values, const WavesAsked& asked) {
  return OwnWaveSearch(flanks, values, asked).run();
}

std::string words_of(const FlankGeometry& geometry, const std::vector<OwnWaves>& waves,
                     const OwnWaves& wave, bool both) {
  const double involute_mm = std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
  const bool rises = wave.waves_profile * wave.waves_face < 0.0;
  const bool mirrored = both && rises != (waves[1].waves_profile * waves[1].waves_face < 0.0);
  std::string text = printed(
      "waves across the flanks, %.3g mm of roll length each over the profile and %.3g mm over "
      "the face, ",
      involute_mm / wave.waves_profile, geometry.face_width_mm() / std::abs(wave.waves_face));
  const bool left = (wave.side > 0) == (geometry.sense() > 0.0);
  text += rises ? "rising towards the tip" : "falling towards the tip";
  if (mirrored)
    text += printed(" on %s flanks and %s on %s ones", left ? "left" : "right",
                    rises ? "falling" : "rising", left ? "right" : "left");
  text += printed(", in a phase of its own on every flank, %.3g um", wave.amplitude_um);
  if (!both) text += left ? ", left flanks" : ", right flanks";
  return text;
}

}  // namespace trueflank::loop::flank_waves
