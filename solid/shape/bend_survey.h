// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>

#include "trueflank/solid/shape/part_shape.h"

// Looking for waves on a displaced toothing. Places in a simple ratio to each other see nothing of a wave
// of that ratio; these stand in none.
namespace trueflank {

/// Shorter than so many tolerances no way is cut: a step in a displacement has no end.
constexpr double kShortestCut = 3.0;

/// Shares between 0 and 1: every stretch of the sequence is spread evenly, and no wave follows it.
class SpreadShares {
 public:
  double next() {
    constexpr double kGolden = 0.6180339887498949;
    at_ += kGolden;
    if (at_ >= 1.0) at_ -= 1.0;
    return at_;
  }

 private:
  double at_ = 0.0;
};

/// Whether the points over the middle and over another share of a way stand farther from its chord's than
/// so much; `way(share)` is a point of it.
template <class Way>
[[nodiscard]] bool is_off_chord(double other_share, double most_mm, const Way& way) {
  const std::array<double, 3> from = way(0.0), to = way(1.0);
  for (const double share : {0.5, other_share}) {
    const std::array<double, 3> inside = way(share);
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += std::pow(inside[k] - std::lerp(from[k], to[k], share), 2);
    if (!(std::sqrt(sum) <= most_mm)) return true;
  }
  return false;
}

/// What a displacement alone asks for: layers over a height of the face and chords of a flank, the same
/// on all teeth.
struct BendCuts {
  double layers = 1.0, chords = 1.0;
};
/// By halving what is off its chords, of many ways of one length some: a sample of all cuts.
/// Cost: some hundred thousand displacements at most, however short the waves are.
[[nodiscard]] BendCuts bend_cuts(const ToothedOutline& teeth, double height_mm, double tolerance_mm);

}  // namespace trueflank
