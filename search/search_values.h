// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "trueflank/search/search_layer.h"
#include "trueflank/search/search_optimise.h"

// What the points of a tooth set's optimisation are worth, and what they lack; for its parts alone.
namespace trueflank {

/// A lower bound on another objective's merit, for compromises and figures that are asked for.
struct MeritBound {
  SearchObjective objective;
  double merit = 0.0;
};

/// The torque and the figures asked for, in this order.
[[nodiscard]] std::vector<FigureLimit> asked_limits(const SearchRequirements& requirements);

/// What a laid-out design is worth beside the efficiencies of its meshes.
struct DesignValues {
  DesignDimensions dimensions;
  double torque_nm = 0.0;
  double size_mm = kNaN;
  DesignFigures figures;
};
/// How much wider a design of an allowable torque gets, and how much larger its module, to carry
/// `asked_nm`, as far as both may grow; 1 where `asked_nm` is NaN.
struct Growth {
  double wider = 1.0, larger = 1.0;
};
[[nodiscard]] Growth growth_for(const SearchRequirements& requirements, double asked_nm,
                                double torque_nm, double module_mm);
/// With the width and module that carry the torque asked for, where they may grow.
/// Requires: efficiencies of the meshes alone.
[[nodiscard]] DesignValues design_values(const SearchRequirements& requirements,
                                         const SearchModel& model, const FreeShifts& free,
                                         double mesh_forward, double mesh_backward);

/// Efficiencies with what `[losses]` take.
struct ToldEfficiencies {
  double forward = kNaN, backward = kNaN;
};
[[nodiscard]] ToldEfficiencies told_efficiencies(const SearchRequirements& requirements,
                                                 double ratio, double mesh_forward,
                                                 double mesh_backward);

/// At the output; 0 where the strength does not say.
[[nodiscard]] double allowable_torque_nm(const SearchRequirements& requirements,
                                         const GearTrain& train);

/// Larger is better.
[[nodiscard]] double merit_of_figure(SearchObjective objective, double value);
/// Of a weighted ranking: the sum of each weight times the logarithm of its figure.
[[nodiscard]] double weighted_score(const SearchRequirements& requirements,
                                    const ToldEfficiencies& told, const DesignValues& values);

/// Limits are approached to this (modules), so that rounding leaves a design on the good side.
inline constexpr double kLimitReserve = 1e-7;

/// Merits and margins of one tooth set, counting how often a layer was computed.
class SetValues {
 public:
  /// The requirements must outlive the values.
  SetValues(const SearchRequirements& requirements, const ToothSet& set,
            const LimitReserve& reserve);

  struct State {
    LayerEvaluation layer1;
    LayerEvaluation layer2;
  };
  [[nodiscard]] State state(const FreeShifts& free);
  /// One layer alone; evaluations whose merit `better` denies may be cut short.
  template <class... Arguments>
  [[nodiscard]] LayerEvaluation layer1(const Arguments&... arguments) {
    ++evaluations_;
    return model_.layer1(arguments...);
  }
  template <class... Arguments>
  [[nodiscard]] LayerEvaluation layer2(const Arguments&... arguments) {
    ++evaluations_;
    return model_.layer2(arguments...);
  }

  /// Of layer 0 or 1, margin by margin.
  [[nodiscard]] PartlyJudged in_parts(int layer, double centre_distance, double shift,
                                      double stop_below) {
    ++evaluations_;
    return model_.in_parts(layer, centre_distance, shift, stop_below);
  }

  /// Of layer 0 or 1, without profiles.
  [[nodiscard]] LayerEvaluation outline(int layer, double centre_distance, double shift,
                                        double stop_below) {
    ++evaluations_;
    return model_.outline(layer, centre_distance, shift, stop_below);
  }

  /// Distances to all limits, as many as the model has, [modules]; less what is kept in reserve,
  /// and no farther than an optimiser's model can use.
  void margins(const State& state, double* out) const;
  /// Sum of all breaches; 0 where every limit is kept.
  [[nodiscard]] double breach(const State& state) const;
  [[nodiscard]] double least_margin(const State& state) const;
  /// Of one layer alone, 0 or 1; of what was computed before the profiles, where there are none.
  [[nodiscard]] double layer_margin(int layer, const LayerEvaluation& evaluation,
                                    bool without_profiles) const;
  [[nodiscard]] std::size_t limits_of(int layer) const {
    const std::size_t first2 = model_.train().layer1_limits;
    return layer == 0 ? first2 : model_.limits() - first2;
  }
  /// What a limit of a layer keeps at a margin of it: below 0 it is broken.
  [[nodiscard]] double kept(int layer, std::size_t limit, double margin) const {
    return margin - offset_of(layer, limit) + kLimitReserve;
  }
  /// A margin that surely keeps less than this.
  [[nodiscard]] double surely_below(int layer, std::size_t limit, double kept) const {
    return kept + offset_of(layer, limit) - kLimitReserve - kRounding;
  }
  /// Relative, so that newton metres and efficiencies weigh alike.
  [[nodiscard]] double bound_margin(const State& state, const FreeShifts& free,
                                    const MeritBound& bound) const;
  /// An efficiency is that of the meshes: its best shifts are those with losses too.
  [[nodiscard]] double merit(const State& state, const FreeShifts& free,
                             SearchObjective objective) const;
  /// Of a value that is reported; an efficiency with its losses.
  [[nodiscard]] double told_merit(const State& state, const FreeShifts& free,
                                  SearchObjective objective) const;

  [[nodiscard]] const SearchRequirements& requirements() const { return r_; }
  [[nodiscard]] const SearchModel& model() const { return model_; }
  [[nodiscard]] const LimitReserve& reserve() const { return reserve_; }
  /// The efficiency that is swept for first.
  [[nodiscard]] DriveDirection guide() const { return guide_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  /// More than sums of margins and offsets are rounded by.
  static constexpr double kRounding = 1e-12;

  [[nodiscard]] const DesignValues& design_values(const State& state, const FreeShifts& free) const;
  [[nodiscard]] double offset_of(int layer, std::size_t limit) const {
    return offset_[layer == 0 ? limit : model_.train().layer1_limits + limit];
  }

  const SearchRequirements& r_;
  SearchModel model_;
  LimitReserve reserve_;
  std::array<double, kLimits> offset_{};
  DriveDirection guide_ = DriveDirection::kForward;
  int evaluations_ = 0;
  /// Of the point asked for last: objective and limits ask for the same one after another.
  mutable FreeShifts last_free_;
  mutable DesignValues last_;
};

}  // namespace trueflank
