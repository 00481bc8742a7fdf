// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "trueflank/search/search_values.h"

// A layer at one place, of which no more is computed than is asked. Between two places that break
// the same limit most places break it too: one corner at one point of one root tells that.
namespace trueflank {

/// Where the corners of a layer's limits were found to be closest last.
using CornerPlaces = std::array<int, kLayerLimits>;

class PlaceInParts {
 public:
  /// No margin that was computed is less.
  static constexpr double kNotComputed = -1e8;

  /// Values and corner places must outlive it.
  PlaceInParts(SetValues& values, int layer, double distance, double shift, double stop_below,
               CornerPlaces& corners);
  /// All of it known.
  PlaceInParts(SetValues& values, int layer, double shift, const LayerEvaluation& evaluation,
               double margin, CornerPlaces& corners);

  [[nodiscard]] double shift() const { return shift_; }
  [[nodiscard]] std::size_t limits() const { return limits_; }
  /// Whether something is known of a limit, perhaps no more than that it is broken.
  [[nodiscard]] bool is_known(std::size_t limit) const { return state_[limit] != State::kOpen; }
  /// What a limit keeps; where that is less than `enough`, anything between that and `enough`. Not
  /// a number, or far below all else: no such limit could be computed.
  [[nodiscard]] double kept(std::size_t limit, double enough);
  /// Whether a limit is broken. One that cannot be computed is not; but a corner counts that cuts
  /// into a gear's root where another gear of the layer has no teeth.
  [[nodiscard]] bool breaks(std::size_t limit) {
    return kept(limit, 0.0) < 0.0 && evaluation_.margins[limit] > kNotComputed;
  }
  [[nodiscard]] bool is_known_broken(std::size_t limit) const {
    return is_known(limit) && keeps_at_most(limit) < 0.0 &&
           evaluation_.margins[limit] > kNotComputed;
  }
  /// Requires: something is known of the limit.
  [[nodiscard]] double keeps_at_most(std::size_t limit) const {
    return values_.kept(layer_, limit, evaluation_.margins[limit]);
  }
  /// Whether every limit is kept. Looks at those first that `beside` breaks; of one that is broken
  /// no more is computed than that it keeps less than `enough`.
  [[nodiscard]] bool is_feasible(PlaceInParts& beside, double enough);
  /// What the limits keep least, where that is more than `least`.
  [[nodiscard]] std::optional<double> margin_above(double least);
  /// What the limits keep least.
  [[nodiscard]] double margin();
  /// With the margins that were computed.
  [[nodiscard]] const LayerEvaluation& evaluation() const { return evaluation_; }

 private:
  enum class State : char { kOpen, kBounded, kComputed };

  SetValues& values_;
  int layer_;
  double shift_;
  CornerPlaces& corners_;
  std::size_t limits_, first_of_profiles_;
  LayerEvaluation evaluation_;
  std::optional<ProfileJudge> profiles_;
  std::array<State, kLayerLimits> state_{};
  std::optional<double> margin_;
};

/// Whether a limit is broken at both places.
[[nodiscard]] bool break_the_same(PlaceInParts& p, PlaceInParts& q);
/// Whether at one of two places all limits that both break may keep more than `least`, as far as is
/// known: false only where they do not.
[[nodiscard]] bool may_be_close(const PlaceInParts& p, const PlaceInParts& q, double least);

}  // namespace trueflank
