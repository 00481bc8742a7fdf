// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "tests/loop/words_of_forms.h"

namespace trueflank::test {

/// A form of one coefficient, what is said of it with a positive and a negative one, and a place
/// that this speaks of: tooth, side, profile and face coordinate.
struct FormInWords {
  std::string family;
  loop::EffectShape shape;
  std::string positive, negative;
  int tooth, side;
  double u, v;
  loop::FlankChoice flank = loop::FlankChoice::kBoth;
};

/// All of one coefficient, of a spur gear of 24 teeth and 10 mm.
[[nodiscard]] std::vector<FormInWords> forms_in_words(const loop::FlankGeometry& g);

}  // namespace trueflank::test
