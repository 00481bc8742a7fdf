// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/stretching_waves.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/stretching_wave.h"

namespace trueflank::loop {
namespace {

/// Sums of a wave over the teeth: its columns, their products with each other and with the values.
struct SumsOfWave {
  double count = 0.0, cos = 0.0, sin = 0.0, cos_cos = 0.0, sin_sin = 0.0, cos_sin = 0.0,
         cos_um = 0.0, sin_um = 0.0;

  void add(double weight, double sum_um, std::complex<double> wave) {
    const double c = wave.real(), s = wave.imag();
    count += weight;
    cos += weight * c;
    sin += weight * s;
    cos_cos += weight * c * c;
    sin_sin += weight * s * s;
    cos_sin += weight * c * s;
    cos_um += sum_um * c;
    sin_um += sum_um * s;
  }
  /// What both columns take out of values whose mean is 0, beside a level.
  [[nodiscard]] double explained() const {
    constexpr double kToldApart = 0.05;
    const double cc = cos_cos - cos * cos / count, ss = sin_sin - sin * sin / count,
                 cs = cos_sin - cos * sin / count, determinant = cc * ss - cs * cs;
    if (!(determinant > kToldApart * count * count)) return 0.0;
    return (ss * cos_um * cos_um - 2.0 * cs * cos_um * sin_um + cc * sin_um * sin_um) / determinant;
  }
};

/// Teeth that it may begin at are so far apart.
int apart(int teeth) { return std::max(1, teeth / 30); }

/// Calls with the waves a turn at either end.
template <class Take>
void for_each_stretching(int teeth, const Take& take) {
  using gear_effects::kFewestOfStretching;
  constexpr double kStep = 0.5, kLeastChange = 2.0;  // periods a turn
  const double most = gear_effects::most_of_stretching(teeth);
  for (double at_first = kFewestOfStretching; at_first <= most; at_first += kStep)
    for (double at_last = kFewestOfStretching; at_last <= most; at_last += kStep)
      if (std::abs(at_last - at_first) >= kLeastChange) take(at_first, at_last);
}

}  // namespace

std::size_t stretching_waves_looked_at(int teeth) {
  std::size_t looks = 0;
  for_each_stretching(teeth, [&](double, double) {
    looks += static_cast<std::size_t>((teeth - 1) / apart(teeth) + 1);
  });
  return looks;
}

std::vector<EffectShape> stretching_waves(const FlankGeometry& geometry,
                                          const ValuesOfTeeth& values, bool opposite,
                                          std::size_t most) {
  constexpr int kFewestTeeth = 24, kMostSteps = 30;
  const auto teeth = static_cast<int>(values.sum.size());
  double sum = 0.0, count = 0.0;
  int measured = 0;
  for (std::size_t t = 0; t < values.sum.size(); ++t) {
    sum += values.sum[t];
    count += values.count[t];
    measured += values.count[t] > 0.0 ? 1 : 0;
  }
  if (measured < kFewestTeeth) return {};
  const auto wave_from_first = [teeth](double at_first, double at_last) {
    std::vector<std::complex<double>> wave;
    for (int since = 0; since < teeth; ++since) {
      const double share = static_cast<double>(since) / teeth;
      wave.push_back(
          std::polar(1.0, kTwoPi * share * (at_first + 0.5 * (at_last - at_first) * share)));
    }
    return wave;
  };
  const auto explained_by = [&](const std::vector<std::complex<double>>& wave, int first) {
    SumsOfWave sums;
    for (int since = 0; since < teeth; ++since) {
      const auto tooth = static_cast<std::size_t>((first - 1 + since) % teeth);
      const double weight = values.count[tooth];
      sums.add(weight, values.sum[tooth] - weight * sum / count,
               wave[static_cast<std::size_t>(since)]);
    }
    return sums.explained();
  };
  std::vector<std::pair<double, EffectShape>> looked;
  for_each_stretching(teeth, [&](double at_first, double at_last) {
    const std::vector<std::complex<double>> wave = wave_from_first(at_first, at_last);
    std::pair<double, EffectShape> best;
    for (int first = 1; first <= teeth; first += apart(teeth))
      if (const double explained = explained_by(wave, first); explained > best.first)
        best = {explained, {at_first, at_last, double(first), opposite ? 1.0 : 0.0}};
    if (best.first > 0.0) looked.push_back(std::move(best));
  });
  std::sort(looked.begin(), looked.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<EffectShape> shapes;
  const EffectFamily* const family = find_family("unnamed_stretching_wave");
  for (auto& [explained, shape] : looked) {
    if (shapes.size() == most) break;
    // (by what the values themselves say: how large their error is, is not known yet)
    for (int step = 0; step < kMostSteps; ++step) {
      const double before = explained;
      for (const EffectShape& beside : family->nearby(geometry, EffectShape(shape)))
        if (const double more =
                explained_by(wave_from_first(beside[0], beside[1]), static_cast<int>(beside[2]));
            more > explained) {
          explained = more;
          shape = beside;
        }
      if (!(explained > before)) break;
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

}  // namespace trueflank::loop
