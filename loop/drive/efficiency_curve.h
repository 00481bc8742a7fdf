// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/drive/drive_model.h"

namespace trueflank::loop {

/// Efficiencies of a drive's meshes over their common friction, tabulated once.
class EfficiencyCurve {
 public:
  explicit EfficiencyCurve(const DriveModel& model);
  /// Over the friction of one mesh, the others' as designed.
  EfficiencyCurve(const DriveModel& model, std::size_t mesh);
  /// Accuracy: 1e-7 for friction up to 0.6 (cubic between steps of 0.02); beyond, the end's value.
  [[nodiscard]] double at(bool forward, double friction) const;
  /// Change per unit of friction, from one to the other; of two that are one the slope.
  [[nodiscard]] double secant(bool forward, double from, double to) const;

 private:
  std::vector<double> forward_, backward_;
};

/// What was asked of an efficiency's curve last: where the friction is that of the row before, as
/// it mostly is, it is computed once. Not for several threads.
class LastEfficiency {
 public:
  explicit LastEfficiency(bool forward) : forward_(forward) {}
  [[nodiscard]] double at(const EfficiencyCurve& curve, double friction) {
    if (friction != friction_) value_ = curve.at(forward_, friction_ = friction);
    return value_;
  }
  /// Change of the efficiency per unit of friction, from one to the other.
  [[nodiscard]] double secant(const EfficiencyCurve& curve, double from, double to) {
    if (from != from_ || to != to_) secant_ = curve.secant(forward_, from_ = from, to_ = to);
    return secant_;
  }

 private:
  bool forward_;
  double friction_ = -1.0, value_ = 0.0;
  double from_ = -1.0, to_ = -1.0, secant_ = 0.0;
};

}  // namespace trueflank::loop
