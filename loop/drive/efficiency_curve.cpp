// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/efficiency_curve.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop {
namespace {

constexpr double kCurveStep = 0.02, kCurveEnd = 0.6;
/// Step of the friction where no secant exists yet.
constexpr double kFrictionStep = 1e-3;

}  // namespace

EfficiencyCurve::EfficiencyCurve(const DriveModel& model) {
  for (double mu = 0.0; mu <= kCurveEnd + 3.5 * kCurveStep; mu += kCurveStep) {
    const DriveEfficiency e = model.at(mu);
    forward_.push_back(e.forward);
    backward_.push_back(e.backward);
  }
}

EfficiencyCurve::EfficiencyCurve(const DriveModel& model, std::size_t mesh) {
  const double back =
      model.losses ? model.losses->backward_friction.value_or(model.friction) : model.friction;
  for (double mu = 0.0; mu <= kCurveEnd + 3.5 * kCurveStep; mu += kCurveStep) {
    std::vector<double> one(model.meshes.size(), model.friction), other(model.meshes.size(), back);
    one[mesh] = other[mesh] = mu;
    forward_.push_back(model.efficiency(one).forward);
    backward_.push_back(back == model.friction ? model.efficiency(one).backward
                                               : model.efficiency(other).backward);
  }
}

double EfficiencyCurve::at(bool forward, double friction) const {
  const std::vector<double>& y = forward ? forward_ : backward_;
  const double x = std::clamp(friction, 0.0, kCurveEnd) / kCurveStep;
  const auto i = static_cast<std::size_t>(
      std::clamp(std::floor(x) - 1.0, 0.0, static_cast<double>(y.size()) - 4.0));
  const double t = x - static_cast<double>(i);
  // Lagrange through four neighbours
  return -y[i] * (t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0 +
         y[i + 1] * t * (t - 2.0) * (t - 3.0) / 2.0 - y[i + 2] * t * (t - 1.0) * (t - 3.0) / 2.0 +
         y[i + 3] * t * (t - 1.0) * (t - 2.0) / 6.0;
}

double EfficiencyCurve::secant(bool forward, double from, double to) const {
  if (std::abs(to - from) < 1e-6) to = from + kFrictionStep;
  return (at(forward, to) - at(forward, from)) / (to - from);
}

}  // namespace trueflank::loop
