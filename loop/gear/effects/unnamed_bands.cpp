// SPDX-License-Identifier: GPL-3.0-or-later
// Bands that come again along the flanks, and flights of steps: of layers, of a path that is
// repeated, of a stack of sheets. Edges are sharp. No candidates of their own: they are looked for
// before anything is chosen (bands.h).
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

constexpr std::size_t kPeriod = 2, kBandWidth = 3;

double sign_of_side(const Place& p, const EffectShape& shape) {
  return shape.back() != 0.0 && p.side < 0 ? -1.0 : 1.0;
}

/// The edge moved, and other periods that leave one of the edges where it is; bands wider or
/// narrower, to either side.
std::vector<EffectShape> edges_beside(const FlankGeometry& g, const EffectShape& shape,
                                      bool bands) {
  const double range = std::abs(range_mm(g, shape[0])), period = shape[kPeriod];
  std::vector<EffectShape> shapes;
  const auto add = [&](double moved, double periods, double wider) {
    shapes.push_back(shape);
    EffectShape& beside = shapes.back();
    const double at = stands_at(g, shape[0], shape[1]) + moved;
    beside[1] = shape[0] != 0.0 ? at : 2.0 * g.on_flank(1, 1, at, 0.0).radius_mm;
    beside[kPeriod] = period * periods;
    if (bands) beside[kBandWidth] = shape[kBandWidth] + wider;
  };
  const double edges = std::floor(range / period);
  for (const double share : {0.1, 0.04, 0.015, 0.006, 0.002, 0.0007})
    for (const double sign : {-1.0, 1.0}) {
      const double off = sign * share * period;
      add(off, 1.0, 0.0);
      for (const double held : {0.0, 0.5, 1.0})  // of the edges, from the first on
        add(-held * off, 1.0 + sign * share / std::max(1.0, edges), 0.0);
      if (!bands) continue;
      add(0.0, 1.0, off);
      add(off, 1.0, -off);
    }
  std::erase_if(shapes, [&](const EffectShape& s) {
    const double share = share_at(g, s[0], s[1]);
    return !(share > 0.0 && share < 1.0 && s[kPeriod] > 0.005 * range &&
             s[kPeriod] < 0.55 * range) ||
           (bands && !(s[kBandWidth] > 0.08 * s[kPeriod] && s[kBandWidth] < 0.92 * s[kPeriod]));
  });
  return shapes;
}

const TermKey kFlanksOfBands{"flanks", TermKey::Kind::kWord, {"equal", "opposite"}};

}  // namespace

/// 1 from its place on over the width of a band, and so on after each period; 0 between.
EffectFamily unnamed_bands() {
  EffectFamily f = along_flank(
      "unnamed_bands", {"along", "place_mm", "period_mm", "band_mm", "opposite_flanks"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        const double share =
                         (along(shape[0], p) - stands_at(g, shape[0], shape[1])) / shape[kPeriod],
                     within = share - std::floor(share);
        return within * shape[kPeriod] < shape[kBandWidth] ? sign_of_side(p, shape) : 0.0;
      });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    return edges_beside(g, shape, true);
  };
  f.term_keys = {kAlong, number("place_mm"), number("period_mm"), number("band_mm"),
                 kFlanksOfBands};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return "the same on every tooth, bands with sharp edges " + over(shape[0]) +
           printed(" that come again every %.3g mm", shape[kPeriod]) +
           (shape[0] != 0.0 ? "" : " of roll length") + ", each " +
           printed("%.3g mm wide, one from ", shape[kBandWidth]) +
           words_of_place(told.geometry, shape[0], shape[1]) + " on" +
           opposite_words(shape.back() != 0.0) +
           there("on the bands", told.sign(), shape.back() != 0.0) +
           ", as of layers or of a path that is repeated";
  };
  return f;
}

/// 0 below its place, 1 from there on, 2 a period further, and so on.
EffectFamily unnamed_flight() {
  EffectFamily f =
      along_flank("unnamed_flight", {"along", "place_mm", "period_mm", "opposite_flanks"},
                  [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                    const double share =
                        (along(shape[0], p) - stands_at(g, shape[0], shape[1])) / shape[kPeriod];
                    return (std::floor(share) + 1.0) * sign_of_side(p, shape);
                  });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    return edges_beside(g, shape, false);
  };
  f.term_keys = {kAlong, number("place_mm"), number("period_mm"), kFlanksOfBands};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return "the same on every tooth, a flight of steps " + over(shape[0]) +
           printed(", one every %.3g mm", shape[kPeriod]) +
           (shape[0] != 0.0 ? "" : " of roll length") + ", one of them " +
           at_place(told.geometry, shape[0], shape[1]) + opposite_words(shape.back() != 0.0) +
           there("above each step, beside what is below it,", told.sign(), shape.back() != 0.0) +
           ", as of layers, each a little larger or further on than the one below";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
