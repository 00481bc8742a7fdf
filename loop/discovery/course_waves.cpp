// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/course_waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Cosine and sine of whole numbers of waves, with a Hann window.
struct TaperedWave {
  VectorXd cosine, sine;
};
TaperedWave tapered_wave(Index places, Index waves) {
  const auto m = static_cast<double>(places);
  TaperedWave wave{VectorXd(places), VectorXd(places)};
  for (Index i = 0; i < places; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / m;
    const double taper = (1.0 - std::cos(kTwoPi * x)) / m;
    wave.cosine[i] = taper * std::cos(kTwoPi * static_cast<double>(waves) * x);
    wave.sine[i] = taper * std::sin(kTwoPi * static_cast<double>(waves) * x);
  }
  return wave;
}

/// Squared amplitude / 4 of whole numbers of waves, summed over the courses of each set.
std::vector<VectorXd> tapered_powers(const std::vector<MatrixXd>& sets, Index places) {
  std::vector<VectorXd> powers(sets.size(), VectorXd::Zero(places / 2));
  constexpr std::size_t kAtOnce = 8;
  for_each_run(static_cast<std::size_t>(places / 2), kAtOnce,
               [&](std::size_t from, std::size_t to) {
                 for (std::size_t k = std::max<std::size_t>(1, from); k < to; ++k) {
                   const auto waves = static_cast<Index>(k);
                   const TaperedWave wave = tapered_wave(places, waves);
                   for (std::size_t one = 0; one < sets.size(); ++one)
                     powers[one][waves] = (wave.cosine.transpose() * sets[one]).squaredNorm() +
                                          (wave.sine.transpose() * sets[one]).squaredNorm();
                 }
               });
  return powers;
}

/// Where few courses have nearly all of the waves, these are told.
void tell_holders(const MatrixXd& set, CourseFinding& waves) {
  constexpr double kFarAbove = 8.0, kNearlyAll = 0.7;
  const TaperedWave wave = tapered_wave(set.rows(), std::lround(1.0 / waves.width));
  const VectorXd power =
      (set.transpose() * wave.cosine).cwiseAbs2() + (set.transpose() * wave.sine).cwiseAbs2();
  // The power of an error is exponential.
  const double usual = median(std::vector(power.begin(), power.end())) / std::numbers::ln2;
  double held = 0.0;
  std::vector<int> holders;
  for (Index c = 0; c < power.size(); ++c) {
    if (power[c] < kFarAbove * usual) continue;
    holders.push_back(static_cast<int>(c));
    held += power[c];
  }
  if (held < kNearlyAll * power.sum() ||
      3 * holders.size() > static_cast<std::size_t>(power.size()))
    return;
  waves.amount = std::sqrt(4.0 * held / static_cast<double>(holders.size()));
  waves.holders = std::move(holders);
}

}  // namespace

CourseFinding own_waves(const std::vector<MatrixXd>& sets, const std::vector<VectorXd>& loud,
                        double& tests) {
  constexpr double kStandsOut = 3.0, kAboveEach = 1.5;
  // What little stands in the lobes between the wavelengths that a filter took away is no line.
  constexpr double kInALobe = 1.0;
  constexpr Index kOfForms = 2;  // forms rather than errors
  CourseFinding best{CourseFinding::Kind::kOwnWaves};
  // One course that is louder than the others would count for all of them.
  std::vector<MatrixXd> evened;
  for (std::size_t s = 0; s < sets.size(); ++s)
    evened.push_back(sets[s] * loud[s].cwiseInverse().asDiagonal());
  const std::vector<VectorXd> powers = tapered_powers(evened, sets.front().rows());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets[s].cols() < 1) continue;
    const VectorXd& power = powers[s];
    const auto n = static_cast<double>(sets[s].cols());
    const double least = kInALobe * power.tail(std::max<Index>(1, power.size() - kOfForms)).mean();
    for (Index k = 5; k + 4 < power.size(); ++k) {
      tests += 1.0;
      if (power[k] < least) continue;
      double beside = 0.0;
      for (const Index off : {-4, -3, 3, 4})
        beside += 0.25 * std::log(std::max(power[k + off], 1e-300));
      // The edge of what a filter lets through stands above one side alone.
      if (power[k] < kAboveEach * std::max(std::sqrt(power[k - 4] * power[k - 3]),
                                           std::sqrt(power[k + 3] * power[k + 4])))
        continue;
      const double ratio = power[k] / std::exp(beside);
      // Four neighbours; the mean of logarithms knows a little less than that of squares.
      const double p = f_tail(ratio, 2.0 * n, 6.0 * n);
      if (ratio < kStandsOut || !(p < best.p_value)) continue;
      best.p_value = p;
      best.set = static_cast<int>(s);
      best.width = 1.0 / static_cast<double>(k);
      best.amount = std::sqrt(4.0 * power[k] / n * loud[s].cwiseAbs2().mean());
    }
  }
  if (best.set >= 0) tell_holders(sets[static_cast<std::size_t>(best.set)], best);
  return best;
}

}  // namespace trueflank::loop
