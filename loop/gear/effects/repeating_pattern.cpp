// SPDX-License-Identifier: GPL-3.0-or-later
// A pattern of so many teeth that repeats around the gear: of a cutter whose own pitch is uneven,
// of a plate or worm that indexes.
#include "trueflank/loop/gear/effects/repeating_pattern.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {
namespace {

/// "-3.1, 0.4 and 2.7".
std::string list_of_um(const ToldForm& told) {
  const std::size_t values = told.shape.size() - kPatternValues;
  std::string text;
  for (std::size_t k = 0; k < values; ++k)
    text += (k == 0            ? ""
             : k + 1 == values ? " and "
                               : ", ") +
            printed("%.3g", told.amounts[0] * told.shape[kPatternValues + k]);
  return text;
}

std::string words_of_pattern(const ToldForm& told) {
  const EffectShape& shape = told.shape;
  const bool aside = shape[kPatternOpposite] != 0.0;
  const int every = static_cast<int>(shape[kPatternEvery]),
            first = static_cast<int>(shape[kPatternFirst]);
  std::string text =
      std::string(aside ? "the teeth stand aside" : "the flanks stand out and back") +
      printed(" in a pattern that repeats every %d teeth", every) +
      printed(", from tooth %d on", first);
  if (told.amounts.size() == 1) {
    const auto most =
        std::max_element(shape.begin() + kPatternValues, shape.end(),
                         [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto place = static_cast<int>(most - shape.begin() - kPatternValues);
    const double um = told.amounts[0] * *most;
    text += printed(", most at tooth %d", (first - 1 + place) % told.geometry.teeth() + 1) +
            printed(" and every %d teeth after it: ", every) + printed("%.3g um ", std::abs(um)) +
            (aside ? (um > 0.0 ? "counter-clockwise" : "clockwise") : (um > 0.0 ? "out" : "back")) +
            "; its teeth, one after the other: " + list_of_um(told) + " um" +
            (aside ? ", + is counter-clockwise" : ", + is more material");
  }
  return text + "; as from a cutter of so many teeth or starts, or a plate or worm that indexes";
}

}  // namespace

EffectFamily unnamed_pattern() {
  EffectFamily f =
      described("unnamed_pattern", {"every", "first_tooth", "opposite_flanks", "pattern"});
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    const int every = static_cast<int>(shape.size() - kPatternValues);
                    factor[0] =
                        shape[kPatternValues +
                              static_cast<std::size_t>(teeth_since(g, tooth, shape[1]) % every)];
                  },
                  [](const FlankGeometry&, const Place& p, const EffectShape& shape) {
                    return shape[kPatternOpposite] != 0.0 ? static_cast<double>(p.side) : 1.0;
                  }});
  // Its values have their mean, and their size is the amount.
  f.values_sought = [](const EffectShape& shape) {
    return static_cast<int>(shape.size() - kPatternValues) - 2;
  };
  f.term_keys = {{"every"},
                 {"first_tooth"},
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}},
                 {"pattern", TermKey::Kind::kNumbers}};
  f.words = words_of_pattern;
  return f;
}

}  // namespace trueflank::loop::gear_effects
