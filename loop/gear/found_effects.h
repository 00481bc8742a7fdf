// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/discovery.h"
#include "trueflank/loop/gear/fit/point_fit.h"
#include "trueflank/loop/gear/shape_refinement.h"
#include "trueflank/loop/result/loop_result.h"

// From chosen columns to what people read: parameters with intervals, words, what cannot be told apart.
namespace trueflank::loop {

struct EffectSources {
  const FlankGeometry& geometry;
  const PointFit& fit;
  const DiscoveryResult& discovery;             ///< chosen groups in the order of the fit's effects
  const std::vector<Effect>& candidates;
  const ShapeUncertainty& uncertainty;
  const std::vector<std::string>& not_observable;
  Makings makings = kAnyMaking;  ///< ways of making that are open
  /// Candidates whose form the data do not have: no alternatives to what they show; empty: none.
  std::vector<bool> unseen = {};
  double explained = kNaN;       ///< share of the variance that shares add up to; NaN: of this fit
  /// Which of the fit's effects to describe; empty: all.
  std::vector<bool> only = {};
  /// What was measured: which waves the traced teeth cannot tell apart; nullptr: is not asked.
  const Observations* table = nullptr;
};

/// Value of every parameter for the coefficients of an effect.
[[nodiscard]] std::vector<std::pair<std::string, double>> parameter_values(
    const Effect& effect, const Eigen::VectorXd& coefficients);

/// Named effects in the order they were chosen, unnamed terms gathered by their order.
[[nodiscard]] std::vector<FoundEffect> describe_effects(const EffectSources& sources);

/// An effect in words: "twice per turn, sloping over the face, equal on both flanks"; with its
/// coefficients, where they are known, where there is more material.
[[nodiscard]] std::string words_for(const FlankGeometry& geometry, const Effect& effect,
                                    std::span<const double> amounts = {});

}  // namespace trueflank::loop
