// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/loop/gear/effect.h"

// How signs are said: material that stands out or lies back, teeth that are turned
// counter-clockwise or clockwise, and towards which end there is more. A sign of 0 is not known:
// both are said, or neither.
namespace trueflank::loop::gear_effects {

/// "a ridge", "a groove"; of an unknown sign "a groove or ridge".
[[nodiscard]] std::string a_ridge(int sign);
/// "a swelling", "a hollow"; of an unknown sign "a hollow or swelling".
[[nodiscard]] std::string a_swelling(int sign);
/// "stand out", "lie back"; of one thing "stands out", "lies back".
[[nodiscard]] std::string stand(int sign);
[[nodiscard]] std::string stands(int sign);
/// "counter-clockwise", "clockwise"; empty of an unknown sign.
[[nodiscard]] std::string turned(int sign);
/// Of flanks that stand out or lie back, of teeth that are turned, where a form is opposite on the
/// two flanks: ": beyond it the flanks stand out", ": beyond it the teeth stand clockwise". Empty
/// of an unknown sign.
[[nodiscard]] std::string there(const std::string& where, int sign, bool opposite);
/// ", at 35 deg first": the crest of a wave around the gear; ", at 35 deg" of one wave a turn.
/// Empty of an unknown direction.
[[nodiscard]] std::string first_at(double direction_rad, double order);
/// ", towards 35 deg"; empty of an unknown direction.
[[nodiscard]] std::string in_direction(double direction_rad);

/// Courses over profile and face (0 constant, 1 sloping, 2 bowed, ...) of flanks or teeth.
struct CourseOfTeeth {
  double profile_degree = 0.0, face_degree = 0.0;
  bool opposite = false;  ///< on the two flanks
  FlankChoice flank = FlankChoice::kBoth;
  int sign = 0;
  double um = kNaN;  ///< its coefficient's size; NaN: not known
  /// How far a bow goes from the middle to its ends, of a coefficient of 1: that of u^2; Legendre's
  /// 1.5. (A lean of 1 goes from -1 to 1.)
  double bow = 1.0;

  /// The degrees over profile and face and the flanks, from the k-th shape value on.
  [[nodiscard]] static CourseOfTeeth at(const ToldForm& form, std::size_t k);

  /// Where there is how much: "more material at the upper end", "the tip stands clockwise", "the
  /// flanks stand out"; empty of an unknown sign.
  [[nodiscard]] std::string material() const;
  /// What a lean or a bow comes to from one end to the other, as drawings have it: ", by 12.5 um
  /// from root to tip", ", by 6 um from the middle to the ends"; empty of others, and where it is
  /// not known.
  [[nodiscard]] std::string in_all() const;
  /// What one tooth does: "leans over the face: more material at the upper end, by 6 um over the
  /// face".
  [[nodiscard]] std::string does() const;
  /// What changes from tooth to tooth, "the lean over the face", and in which direction: ", towards
  /// more material at the upper end".
  [[nodiscard]] std::string what() const;
  [[nodiscard]] std::string direction() const;
};

}  // namespace trueflank::loop::gear_effects
