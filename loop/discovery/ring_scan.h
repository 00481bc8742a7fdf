// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

// Looks for structure in values that stand in a ring, one a tooth. Knows nothing of gears.
namespace trueflank::loop {

struct RingFinding {
  enum class Kind {
    kArc,   ///< `count` rows from row `first` on stand out
    kWave,  ///< of `order`
    kRamp,  ///< rises evenly once around, from the place `first` on
    kComb,  ///< every `count`-th place stands out, the first of them `first`
    kSaw    ///< rises evenly and begins anew after every `count` places, first at `first`
  };
  Kind kind = Kind::kWave;
  double p_value = 1.0;  ///< corrected for all series and forms
  int series = -1;
  int first = 0, count = 0, order = 0;
  /// Of arc and comb above the rest; amplitude of a wave; whole rise of a ramp, of a saw of each
  /// tooth.
  double amount = 0.0;
};

/// Arcs of neighbours that stand out, waves, ramps that begin anew at one place (a tool that wears,
/// a machine that warms up) or after so many places each time (a wheel that is dressed), and combs
/// (a cutter with few teeth), in any of the series (one a column). Rows are places of the ring in
/// order, `place` 0 ... ring - 1 of each; of some places there may be no value. Two tests of one
/// question, each at half the level: against the same values in shuffled order, whole rows
/// together, so that series that hang together are no finding; and an F test with Bonferroni's
/// correction, because few values in any order often make an arc. Saws are shuffled only where the
/// F test has them first and likely: they are many. Sequential: shuffles end once the answer is no;
/// the answer is no where the p-value is above `level`, and then it may be any above that. Waves up
/// to half the values. Source of the stopping rule: Besag, Clifford 1991,
/// doi 10.1093/biomet/78.2.301.
[[nodiscard]] RingFinding scan_ring(const Eigen::MatrixXd& series, const std::vector<int>& place,
                                    int ring, double level = 1.0);

/// How likely two series of as many values each agree as they do, or are opposite, by chance: a
/// t test of their correlation about their means. 1 of fewer than five values: four agree too
/// often. Values of one series may be as noisy as they like if none knows of the other's.
[[nodiscard]] double chance_of_agreement(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace trueflank::loop
