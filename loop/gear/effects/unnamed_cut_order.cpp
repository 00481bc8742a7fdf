// SPDX-License-Identifier: GPL-3.0-or-later
// What the order shows in which teeth were cut: a drift from cut to cut where they were not cut one
// beside the other; what slips over some teeth and stays so to the last one; teeth that spring
// apart where a blank was slit; and an arch from the first tooth to the last.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

/// Shape values: by how many teeth each cut lies on from the last one; the first tooth; opposite on
/// the flanks; within how many cuts the drift levels off (0: it is even).
enum CutOrder : std::size_t { kTeethOn, kFirstTooth, kOppositeFlanks, kWithin };

/// How many cuts one tooth lies on from the tooth before it; the step and the number of teeth have
/// no common divisor.
int cuts_from_tooth_to_tooth(int teeth, int step) {
  // (the extended Euclidean algorithm: the inverse of the step)
  int a = step % teeth, b = teeth, x = 1, y = 0;
  while (a > 1) {
    const int q = a / b, rest = a % b;
    a = b;
    b = rest;
    const int next = x - q * y;
    x = y;
    y = next;
  }
  return ((x % teeth) + teeth) % teeth;
}
/// Which cut a tooth is, from 0 on.
int cut_of(int teeth, int step, int since) {
  return static_cast<int>(static_cast<long long>(since) * cuts_from_tooth_to_tooth(teeth, step) %
                          teeth);
}

/// From 0 on the first tooth to 1 on the last one, about its mean.
double drift_at(int teeth, int cut, double within) {
  const double last = teeth - 1.0;
  if (within == 0.0) return cut / last - 0.5;
  const double whole = -std::expm1(-last / within);
  const double mean =
      (1.0 - std::expm1(-teeth / within) / (teeth * std::expm1(-1.0 / within))) / whole;
  return -std::expm1(-cut / within) / whole - mean;
}

}  // namespace

EffectFamily unnamed_cut_order() {
  EffectFamily f = described("unnamed_cut_order",
                             {"step_teeth", "first_tooth", "opposite_flanks", "within_cuts"});
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    factor[0] = drift_at(g.teeth(),
                                         cut_of(g.teeth(), static_cast<int>(shape[kTeethOn]),
                                                teeth_since(g, tooth, shape[kFirstTooth])),
                                         shape[kWithin]);
                  },
                  [](const FlankGeometry&, const Place& p, const EffectShape& shape) {
                    return shape[kOppositeFlanks] != 0.0 ? static_cast<double>(p.side) : 1.0;
                  }});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    for (const double share : {0.0, 0.15, 0.25, 0.4, 0.7})
      if (share * g.teeth() != shape[kWithin]) {
        shapes.push_back(shape);
        shapes.back()[kWithin] = share * g.teeth();
      }
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) { return shape[kWithin] != 0.0 ? 1 : 0; };
  f.term_keys = {{"step_teeth"},
                 {"first_tooth"},
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}},
                 number("within_cuts")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const int z = told.geometry.teeth(), step = static_cast<int>(shape[kTeethOn]),
              first = static_cast<int>(shape[kFirstTooth]);
    const bool aside = shape[kOppositeFlanks] != 0.0;
    const int sign = told.sign();
    // A drift that begins anew so many times a turn, at no whole number of teeth, is the same.
    const int cuts = cuts_from_tooth_to_tooth(z, step), times = std::min(cuts, z - cuts);
    if (times < step && shape[kWithin] == 0.0) {
      const int along = cuts == times ? sign : -sign;
      return std::string("the ") + (aside ? "place of the teeth" : "height of the flanks") +
             " drifts evenly" +
             (sign == 0 ? ""
              : aside   ? std::string(", ") + turned(along)
                        : std::string(along > 0 ? ", towards more material"
                                                : ", towards less material")) +
             printed(", and begins anew %d times a turn", times) +
             printed(", every %.3g teeth", static_cast<double>(z) / times) +
             printed(", first at tooth %d", first);
    }
    return std::string("the ") + (aside ? "place of the teeth" : "height of the flanks") +
           " drifts from cut to cut" + (shape[kWithin] != 0.0 ? " and levels off" : "") +
           (sign == 0 ? ""
            : aside
                ? std::string(", ") + turned(sign)
                : std::string(sign > 0 ? ", towards more material" : ", towards less material")) +
           printed(", where teeth are cut in steps of %d", step) + printed(": tooth %d", first) +
           printed(", then %d", (first - 1 + step) % z + 1) +
           printed(", %d and so on", (first - 1 + 2 * step) % z + 1) +
           ", as from a tool that wears or a machine that warms up";
  };
  return f;
}

/// From a tooth on, over so many, evenly from nothing to all, and all up to the last tooth before
/// another: a belt that slips, a vice that gives way.
EffectFamily unnamed_slip() {
  constexpr std::size_t kTeeth = 1, kUntil = 2, kSides = 3;
  EffectFamily f =
      described("unnamed_slip", {"first_tooth", "teeth", "before_tooth", "opposite_flanks"});
  f.is_drift = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    const int since = teeth_since(g, tooth, shape[0]),
                              until = teeth_since(g, static_cast<int>(shape[kUntil]), shape[0]);
                    // (where it jumps on its first tooth it goes on once around)
                    factor[0] =
                        until == 0 || since < until ? std::min(1.0, since / shape[kTeeth]) : 0.0;
                  },
                  [](const FlankGeometry&, const Place& p, const EffectShape& shape) {
                    return shape[kSides] != 0.0 ? static_cast<double>(p.side) : 1.0;
                  }});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kFewest = 2.0, kStays = 2.0;
    std::vector<EffectShape> shapes;
    const auto add = [&](double first, double last, double until) {
      EffectShape beside{shape[0] - first, shape[kTeeth] + first + last, shape[kUntil] + until,
                         shape[kSides]};
      for (const std::size_t k : {std::size_t{0}, kUntil})
        beside[k] = std::fmod(beside[k] - 1.0 + g.teeth(), g.teeth()) + 1.0;
      const int left = teeth_since(g, static_cast<int>(beside[kUntil]), beside[0]);
      if (beside[kTeeth] >= kFewest && left > beside[kTeeth] + kStays)
        shapes.push_back(std::move(beside));
    };
    for (const double off : {-4.0, -2.0, -1.0, 1.0, 2.0, 4.0}) {
      add(off, 0.0, 0.0);
      add(0.0, off, 0.0);
      add(off, -off, 0.0);
      add(0.0, 0.0, off);
    }
    return shapes;
  };
  f.term_keys = {{"first_tooth"},
                 {"teeth"},
                 {"before_tooth"},
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const int z = told.geometry.teeth(), first = static_cast<int>(shape[0]), sign = told.sign(),
              last = (first - 1 + static_cast<int>(shape[kTeeth])) % z + 1,
              until = (static_cast<int>(shape[kUntil]) + z - 2) % z + 1;
    const bool aside = shape[kSides] != 0.0;
    return std::string("the ") + (aside ? "place of the teeth" : "height of the flanks") +
           printed(" goes evenly from tooth %d", first) + printed(" to tooth %d", last) +
           (sign == 0 ? ""
            : aside
                ? std::string(", ") + turned(sign)
                : std::string(sign > 0 ? ", towards more material" : ", towards less material")) +
           printed(", and stays so up to tooth %d", until) +
           ", as where a belt slips or something gives way while teeth are cut";
  };
  return f;
}

/// 1 on the tooth behind a gap and minus 1 on the one before it, dying away on both sides.
EffectFamily unnamed_slit() {
  constexpr std::size_t kWithinTeeth = 1, kSides = 2;
  EffectFamily f = described("unnamed_slit", {"after_tooth", "within_teeth", "opposite_flanks"});
  f.is_drift = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    const int since = teeth_since(g, tooth, shape[0] + 1.0), z = g.teeth();
                    // (a tooth right across the gear is pushed from both sides)
                    const double behind = std::exp(-since / shape[kWithinTeeth]),
                                 before = std::exp(-(z - 1 - since) / shape[kWithinTeeth]);
                    factor[0] = behind - before;
                  },
                  [](const FlankGeometry&, const Place& p, const EffectShape& shape) {
                    return shape[kSides] != 0.0 ? static_cast<double>(p.side) : 1.0;
                  }});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kShortest = 0.6, kLongest = 0.2;  // teeth; of all teeth
    std::vector<EffectShape> shapes;
    for (const double off : {-1.0, 1.0}) {
      shapes.push_back(shape);
      shapes.back()[0] = std::fmod(shape[0] - 1.0 + off + g.teeth(), g.teeth()) + 1.0;
    }
    for (const double times : {0.7, 0.87, 0.95, 1.05, 1.15, 1.43}) {
      const double within = times * shape[kWithinTeeth];
      if (!(within >= kShortest && within <= kLongest * g.teeth())) continue;
      shapes.push_back(shape);
      shapes.back()[kWithinTeeth] = within;
    }
    return shapes;
  };
  f.values_sought = [](const EffectShape&) { return 1; };
  f.term_keys = {{"after_tooth"},
                 number("within_teeth"),
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const int z = told.geometry.teeth(), before = static_cast<int>(shape[0]),
              behind = before % z + 1, sign = told.sign();
    const std::string places =
        printed("between tooth %d", before) + printed(" and tooth %d, ", behind);
    const std::string dies =
        printed(", dying away to both sides, to a third within %.2g teeth", shape[kWithinTeeth]);
    if (shape[kSides] != 0.0)
      return places + "the teeth stand " +
             (sign > 0   ? "apart, "
              : sign < 0 ? "closer, "
                         : "apart or closer, ") +
             "to opposite sides by the same amount" + dies +
             ", as where a ring springs at a slit and stress is freed";
    return places + "the height of the flanks jumps" +
           (sign > 0   ? " up, from too little to too much material"
            : sign < 0 ? " down, from too much to too little material"
                       : "") +
           dies;
  };
  return f;
}

/// From nothing at a tooth in one parabola once around to nothing: 1 half a turn on.
EffectFamily unnamed_arch_around() {
  constexpr std::size_t kSides = 1;
  EffectFamily f = described("unnamed_arch_around", {"first_tooth", "opposite_flanks"});
  f.is_drift = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    const double share =
                        static_cast<double>(teeth_since(g, tooth, shape[0])) / g.teeth();
                    factor[0] = 4.0 * share * (1.0 - share);
                  },
                  [](const FlankGeometry&, const Place& p, const EffectShape& shape) {
                    return shape[kSides] != 0.0 ? static_cast<double>(p.side) : 1.0;
                  }});
  f.term_keys = {{"first_tooth"}, {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const int z = told.geometry.teeth(), first = static_cast<int>(shape[0]), sign = told.sign();
    const double most = std::fmod(first - 1.0 + 0.5 * z, z) + 1.0;
    const bool aside = shape[kSides] != 0.0;
    return printed("from tooth %d on, once around in one arch, ", first) +
           (aside ? "the teeth stand " : "the flanks stand ") +
           (sign == 0 ? (aside ? "aside" : "high or low")
            : aside   ? turned(sign)
                      : std::string(sign > 0 ? "out" : "back")) +
           printed(", most at tooth %.3g, and are back where they began", most) +
           ", as where a machine drifts and spreads what does not close evenly over all teeth";
  };
  return f;
}

bool can_be_cut_in_steps(int teeth, int step) { return std::gcd(teeth, step) == 1; }

}  // namespace trueflank::loop::gear_effects
