// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

/// Forms of one family on one choice of flanks, and what the first takes out, in squares.
struct LikelyForms {
  double gain = 0.0;
  std::vector<Effect> forms;
};

/// An order around the gear of which a course along the flanks is asked.
struct OrderAsked {
  double order = 0.0;
  bool along_profile = false;  ///< courses over the profile, too
  bool crossed = false;        ///< over profile and face at once, too
  /// On both flanks the same course, each with a phase of its own: forms of the left flanks.
  bool phase_of_each_flank = false;
  bool beside_plain = false;  ///< beside a wave of the order that is alike on the whole flank
};

/// Waves over the profile, and effects beside which they say most.
struct WavesBeside {
  LikelyForms waves;
  std::vector<Effect> beside;
};
struct LikelyWavesBeside {
  WavesBeside mirrored;         ///< unnamed_waves_mirrored
  WavesBeside of_either_flank;  ///< unnamed_waviness of the left flanks: on the right ones, too
};

/// Products of courses that values look like most, to start from: from residuals of scanned flanks
/// and of traces, as sums in cells of the flanks. What other effects beside a form take out is not
/// asked.
class LikeliestProducts {
 public:
  /// Of every row of the table; the geometry stays where it is.
  LikeliestProducts(const FlankGeometry& geometry, const Observations& table,
                    const Patches& patches, const std::vector<float>& row_um);

  [[nodiscard]] double square() const;                                 ///< of the residuals
  [[nodiscard]] std::vector<LikelyForms> same_on_every_tooth() const;  ///< unnamed_crossed
  /// The same beside levels, slopes and bows, and the square of what these leave.
  struct BesideNames {
    std::vector<LikelyForms> forms;
    double square = 0.0;
  };
  [[nodiscard]] BesideNames beside_names() const;
  [[nodiscard]] std::vector<LikelyForms> around_the_gear() const;  ///< unnamed_crossed_around
  /// Steps over the profile (0) or the face (1), the same on every tooth, as the residuals are or
  /// beside slopes and bows: unnamed_step.
  [[nodiscard]] std::vector<LikelyForms> steps(double face, bool beside_names) const;
  /// The same of jumps that die away, skewed hollows and sawteeth; and of two and more steps and
  /// rises at the ends, which stand beside each other.
  [[nodiscard]] std::vector<LikelyForms> jumps(double face, bool beside_names) const;
  [[nodiscard]] std::vector<LikelyForms> stairs(double face, bool beside_names) const;
  /// The same on every tooth, beside the best of these sets of effects.
  [[nodiscard]] LikelyWavesBeside profile_waves(
      const std::vector<std::vector<Effect>>& besides) const;
  [[nodiscard]] std::vector<LikelyForms> waves() const;  ///< unnamed_crossed_waves
  /// Waves over the profile (0) or the face (1) that grow or fade from one tooth on, once around:
  /// unnamed_crossed_waves.
  [[nodiscard]] std::vector<LikelyForms> growing_waves(int face) const;
  /// Courses and waves over the profile (0) or the face (1) of one tooth in so many:
  /// unnamed_crossed_around, unnamed_crossed_waves and unnamed_comb.
  [[nodiscard]] std::vector<LikelyForms> combs(int face) const;
  [[nodiscard]] std::vector<LikelyForms> of_order(
      const OrderAsked& asked) const;  ///< unnamed_crossed_order

 private:
  struct Cells;
  std::shared_ptr<const Cells> cells_;
};

/// True where two of the last so many effects are steps whose edges meet: a hollow; or one is a
/// rise that reaches far, as slopes and bows do, or up to a step.
[[nodiscard]] bool are_no_stairs(const FlankGeometry& geometry, const std::vector<Effect>& effects,
                                 std::size_t count);

}  // namespace trueflank::loop
