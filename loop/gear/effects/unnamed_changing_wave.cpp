// SPDX-License-Identifier: GPL-3.0-or-later
// Waves from tooth to tooth whose size changes: they grow or fade once around, ring and die away,
// or come in a burst; or whose length changes.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/stretching_wave.h"

namespace trueflank::loop::gear_effects {
namespace {

/// Shape values: periods a turn; where it begins (of a burst: its middle); how it goes on; within
/// how many teeth it dies away; opposite on the flanks.
enum ChangingWave : std::size_t { kPeriods, kFirstTooth, kCourse, kWithin, kOppositeFlanks };
constexpr double kGrows = 0.0, kFades = 1.0, kDies = 2.0, kBurst = 3.0;

}  // namespace

EffectFamily unnamed_changing_wave() {
  EffectFamily f = described("unnamed_changing_wave", {"periods_per_turn", "first_tooth", "course",
                                                       "within_teeth", "opposite_flanks"});
  f.columns = [](const EffectShape&) { return 2; };
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factors) {
                    const double z = g.teeth(), course = shape[kCourse];
                    double since = teeth_since(g, tooth, shape[kFirstTooth]);
                    if (course == kBurst && since > 0.5 * z) since -= z;
                    const double angle = kTwoPi * shape[kPeriods] * since / z;
                    const double size = course == kGrows   ? since / (z - 1.0)
                                        : course == kFades ? 1.0 - since / (z - 1.0)
                                        : course == kBurst ? bell(since, shape[kWithin])
                                                           : std::exp(-since / shape[kWithin]);
                    factors[0] = size * std::cos(angle);
                    factors[1] = size * std::sin(angle);
                  },
                  [](const FlankGeometry&, const Place& p, const EffectShape& shape) {
                    return shape[kOppositeFlanks] != 0.0 ? static_cast<double>(p.side) : 1.0;
                  }});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    // (a burst of fewer waves is a swelling)
    constexpr double kFewestWaves = 1.2;
    const auto add = [&](std::size_t k, double value) {
      EffectShape other = shape;
      other[k] = value;
      if (shape[kCourse] != kBurst ||
          2.0 * other[kWithin] * other[kPeriods] >= kFewestWaves * g.teeth())
        shapes.push_back(std::move(other));
    };
    for (const double off : {-2.0, -1.0, 1.0, 2.0})
      add(kFirstTooth, std::fmod(shape[kFirstTooth] - 1.0 + off + g.teeth(), g.teeth()) + 1.0);
    if (shape[kCourse] != kDies && shape[kCourse] != kBurst) return shapes;
    for (const double off : {-0.5, -0.2, -0.07, 0.07, 0.2, 0.5})
      if (shape[kPeriods] + off > 1.0) add(kPeriods, shape[kPeriods] + off);
    for (const double times : {0.7, 0.87, 0.95, 1.05, 1.15, 1.43})
      add(kWithin, std::clamp(times * shape[kWithin], 2.0, 1.0 * g.teeth()));
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) {
    return shape[kCourse] == kDies || shape[kCourse] == kBurst ? 2 : 0;
  };
  f.term_keys = {number("periods_per_turn"),
                 {"first_tooth"},
                 {"course", TermKey::Kind::kWord, {"grows", "fades", "dies_away", "burst"}},
                 number("within_teeth"),
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const double course = shape[kCourse];
    return (course == kBurst ? printed("about tooth %.0f", shape[kFirstTooth])
                             : printed("from tooth %.0f on", shape[kFirstTooth])) +
           (course == kDies || course == kBurst ? "" : ", once around,") + " the teeth stand " +
           (shape[kOppositeFlanks] != 0.0 ? "ahead and behind" : "high and low") +
           printed(" in waves of %.3g a turn", shape[kPeriods]) +
           (course == kGrows   ? " that grow evenly from nothing"
            : course == kFades ? " that fade evenly to nothing"
            : course == kBurst
                ? printed(" in a burst, %.2g teeth to either side", shape[kWithin]) +
                      ", as where a drive rattles for a while"
                : printed(" that die away, to a third within %.2g teeth", shape[kWithin]) +
                      ", as where something rings after a knock");
  };
  return f;
}

/// Waves whose length changes evenly from a tooth on, once around.
EffectFamily unnamed_stretching_wave() {
  enum Value : std::size_t { kAtFirst, kAtLast, kFrom, kSides };
  EffectFamily f = described("unnamed_stretching_wave", {"periods_per_turn", "periods_at_the_end",
                                                         "first_tooth", "opposite_flanks"});
  f.is_drift = true;
  f.columns = [](const EffectShape&) { return 2; };
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factors) {
                    const double share = teeth_since(g, tooth, shape[kFrom]) / (1.0 * g.teeth());
                    const double angle =
                        kTwoPi * share *
                        (shape[kAtFirst] + 0.5 * (shape[kAtLast] - shape[kAtFirst]) * share);
                    factors[0] = std::cos(angle);
                    factors[1] = std::sin(angle);
                  },
                  [](const FlankGeometry&, const Place& p, const EffectShape& shape) {
                    return shape[kSides] != 0.0 ? static_cast<double>(p.side) : 1.0;
                  }});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    const double z = g.teeth();
    std::vector<EffectShape> shapes;
    const auto add = [&](double at_first, double at_last, double teeth) {
      if (at_first < kFewestOfStretching || at_last < kFewestOfStretching ||
          std::max(at_first, at_last) > most_of_stretching(g.teeth()))
        return;
      shapes.push_back(shape);
      shapes.back()[kAtFirst] = at_first;
      shapes.back()[kAtLast] = at_last;
      shapes.back()[kFrom] = std::fmod(shape[kFrom] - 1.0 + teeth + z, z) + 1.0;
    };
    for (const double first : {-0.3, -0.1, -0.03, 0.0, 0.03, 0.1, 0.3})
      for (const double last : {-0.3, -0.1, -0.03, 0.0, 0.03, 0.1, 0.3})
        if (first != 0.0 || last != 0.0) add(shape[kAtFirst] + first, shape[kAtLast] + last, 0.0);
    // (from another tooth on, each tooth has the length that it had)
    for (const double teeth : {-2.0, -1.0, 1.0, 2.0}) {
      const double more = (shape[kAtLast] - shape[kAtFirst]) * teeth / z;
      add(shape[kAtFirst] + more, shape[kAtLast] + more, teeth);
    }
    return shapes;
  };
  f.term_keys = {number("periods_per_turn"),
                 number("periods_at_the_end"),
                 {"first_tooth"},
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return printed("from tooth %.0f on, once around, the teeth stand ", shape[kFrom]) +
           (shape[kSides] != 0.0 ? "ahead and behind" : "high and low") +
           printed(
               " in waves that get evenly %s, of %.3g a turn at first and %.3g a turn at the "
               "end, as where a drive stretches or slips more and more",
               shape[kAtLast] > shape[kAtFirst] ? "shorter" : "longer", shape[kAtFirst],
               shape[kAtLast]);
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
