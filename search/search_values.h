// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "trueflank/search/search_optimise.h"

// What the points of a tooth set's optimisation are worth, and what they lack; for its parts alone.
namespace trueflank {

/// A lower bound on another objective's merit, for compromises and a torque that is asked for.
struct MeritBound {
  SearchObjective objective;
  double merit = 0.0;
};

/// Limits are approached to this (modules), so that rounding leaves a design on the good side.
inline constexpr double kLimitReserve = 1e-7;

/// Merits and margins of one tooth set, counting how often a layer was computed.
class SetValues {
 public:
  /// The requirements must outlive the values.
  SetValues(const SearchRequirements& requirements, const ToothSet& set, const LimitReserve& reserve);

  struct State {
    Layer1Evaluation layer1;
    Layer2Evaluation layer2;
  };
  [[nodiscard]] State state(const FreeShifts& free);
  /// One layer alone; evaluations whose merit `better` denies may be cut short.
  template <class... Arguments>
  [[nodiscard]] Layer1Evaluation layer1(const Arguments&... arguments) {
    ++evaluations_;
    return model_.layer1(arguments...);
  }
  template <class... Arguments>
  [[nodiscard]] Layer2Evaluation layer2(const Arguments&... arguments) {
    ++evaluations_;
    return model_.layer2(arguments...);
  }

  /// Distances to all limits, kLimits of them, [modules]; less what is kept in reserve, and no farther
  /// than an optimiser's model can use.
  void margins(const State& state, double* out) const;
  /// Sum of all breaches; 0 where every limit is kept.
  [[nodiscard]] double breach(const State& state) const;
  [[nodiscard]] double least_margin(const State& state) const;
  /// Relative, so that newton metres and efficiencies weigh alike.
  [[nodiscard]] double bound_margin(const State& state, const FreeShifts& free,
                                    const MeritBound& bound) const;
  [[nodiscard]] double merit(const State& state, const FreeShifts& free,
                             SearchObjective objective) const;
  [[nodiscard]] double allowable_torque(const FreeShifts& free) const;

  [[nodiscard]] const SearchRequirements& requirements() const { return r_; }
  [[nodiscard]] const SearchModel& model() const { return model_; }
  [[nodiscard]] const LimitReserve& reserve() const { return reserve_; }
  /// Enough distance for every limit.
  [[nodiscard]] double grid_margin() const { return grid_margin_; }
  /// The efficiency that the grids look at.
  [[nodiscard]] DriveDirection guide() const { return guide_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  const SearchRequirements& r_;
  SearchModel model_;
  LimitReserve reserve_;
  std::array<double, kLimits> offset_{};
  double grid_margin_ = 0.0;
  DriveDirection guide_ = DriveDirection::kForward;
  int evaluations_ = 0;
};

/// Place i of `count` from low to high; the ends lie a hair inside, since optima often lie at a bound.
[[nodiscard]] double at_grid(double low, double high, int i, int count);

}  // namespace trueflank
