// SPDX-License-Identifier: GPL-3.0-or-later
// Forms along the flanks with jumps or edges: a jump that dies away behind it, a sawtooth, facets,
// a hollow or swelling that is steeper on one side. They are no candidates of their own: they are
// told in place of slopes, bows, grooves, steps and waves that follow them (products.cpp).
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

/// A form along the flanks, of opposite signs on the two where its last shape value is not 0.
template <class Function>
EffectFamily jumping(const std::string& id, std::vector<std::string> shape_names,
                     Function function) {
  return along_flank(id, std::move(shape_names),
                     [function](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                       return function(g, p, shape) *
                              (shape.back() != 0.0 && p.side < 0 ? -1.0 : 1.0);
                     });
}

const std::vector<double> kFineMoves{0.05, 0.02, 0.01, 0.005, 0.002, 0.0007, 0.0002};

}  // namespace

double fading_jump(double off, double dies_within, double edge) {
  return beyond_edge(off, edge) * std::exp(-std::max(0.0, off) / dies_within);
}

double skewed_bell(double off, double below, double above) {
  return bell(off, off < 0.0 ? below : above);
}

double sawtooth(double off, double period) {
  const double share = off / period;
  return 0.5 - (share - std::floor(share));
}

double arches(double off, double period) {
  const double share = off / period, within = share - std::floor(share);
  return 4.0 * within * (1.0 - within);
}

namespace {

/// Shapes (along, place, period, ...) moved, and of another period about each of several places.
std::vector<EffectShape> periods_beside(const FlankGeometry& g, const EffectShape& shape) {
  constexpr double kShortest = 0.02, kLongest = 0.7;
  const double range = std::abs(range_mm(g, shape[0]));
  std::vector<EffectShape> shapes = places_beside(g, shape, kFineMoves);
  for (const double by : {0.05, 0.02, 0.01, 0.005, 0.002, 0.0007})
    for (const double sign : {-1.0, 1.0}) {
      shapes.push_back(shape);
      shapes.back()[2] *= 1.0 + sign * by;
      // (so that an edge some periods away stays where it is)
      for (const double periods : {-2.0, -1.0, 1.0, 2.0}) {
        shapes.push_back(shape);
        shapes.back()[2] *= 1.0 + sign * by;
        const double moved = stands_at(g, shape[0], shape[1]) + periods * sign * by * shape[2];
        shapes.back()[1] = shape[0] != 0.0 ? moved : 2.0 * g.on_flank(1, 1, moved, 0.0).radius_mm;
      }
    }
  std::erase_if(shapes, [&](const EffectShape& s) {
    const double share = share_at(g, s[0], s[1]);
    return !(share > 0.0 && share < 1.0 && s[2] >= kShortest * range && s[2] <= kLongest * range);
  });
  return shapes;
}

}  // namespace

/// 1 at its place, at once or over the length of an edge, and dying away from there on towards one
/// end.
EffectFamily unnamed_fading_jump() {
  constexpr std::size_t kEdge = 4;
  EffectFamily f = jumping(
      "unnamed_fading_jump",
      {"along", "place_mm", "dies_within_mm", "towards", "edge_mm", "opposite_flanks"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        const double towards = range_mm(g, shape[0]) > 0.0 ? shape[3] : -shape[3];
        return fading_jump(towards * (along(shape[0], p) - stands_at(g, shape[0], shape[1])),
                           shape[2], shape[kEdge]);
      });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kEnds = 0.06, kShortest = 0.01, kLongest = 0.6, kSharpest = 0.005,
                     kSoftest = 0.1;
    const double range = std::abs(range_mm(g, shape[0])), edge = shape[kEdge];
    std::vector<EffectShape> shapes = places_beside(g, shape, kFineMoves);
    for (const double other : {0.0, 0.01 * range, 0.025 * range, 0.5 * edge, 0.7 * edge,
                               0.87 * edge, 1.15 * edge, 1.43 * edge, 2.0 * edge}) {
      if (other == edge ||
          (other > 0.0 && !(other >= kSharpest * range && other <= kSoftest * range)))
        continue;
      shapes.push_back(shape);
      shapes.back()[kEdge] = other;
    }
    for (const double times : {0.7, 0.85, 0.95, 0.98, 1.02, 1.05, 1.18, 1.43}) {
      shapes.push_back(shape);
      shapes.back()[2] *= times;
    }
    std::erase_if(shapes, [&](const EffectShape& s) {
      const double share = share_at(g, s[0], s[1]);
      return !(share > kEnds && share < 1.0 - kEnds && s[2] >= kShortest * range &&
               s[2] <= kLongest * range && s[kEdge] <= 0.5 * s[2]);
    });
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) { return shape[kEdge] > 0.0 ? 3 : 2; };
  f.term_keys = {
      kAlong,      number("place_mm"), number("dies_within_mm"),
      {"towards"}, number("edge_mm"),  {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return "the same on every tooth, a jump " + over(shape[0]) + " " +
           at_place(told.geometry, shape[0], shape[1]) +
           (shape[kEdge] > 0.0 ? printed(", over %.2g mm", shape[kEdge]) +
                                     (shape[0] != 0.0 ? "," : " of roll length,")
                               : "") +
           " that dies away" + towards(shape[0], shape[3]) + ", " +
           within(told.geometry, shape[0], shape[2], "within ", "") +
           opposite_words(shape.back() != 0.0) +
           there("behind it", told.sign(), shape.back() != 0.0);
  };
  return f;
}

/// 1 at its place, and dying away to either side over a length of its own.
EffectFamily unnamed_skewed_band() {
  EffectFamily f = jumping(
      "unnamed_skewed_band", {"along", "place_mm", "below_mm", "above_mm", "opposite_flanks"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        return skewed_bell(along(shape[0], p) - stands_at(g, shape[0], shape[1]), shape[2],
                           shape[3]);
      });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    // (as wide to both sides it is a band, and wider than that a bow and a slope)
    constexpr double kEnds = 0.05, kNarrowest = 0.02, kWidest = 0.5, kNarrow = 0.25, kSkewed = 1.25;
    const double range = std::abs(range_mm(g, shape[0]));
    std::vector<EffectShape> shapes = places_beside(g, shape, kFineMoves);
    for (const double times : {0.7, 0.85, 0.95, 0.98, 1.02, 1.05, 1.18, 1.43}) {
      for (const std::size_t side : {2U, 3U}) {
        shapes.push_back(shape);
        shapes.back()[side] *= times;
      }
      // (as its place moves one side grows and the other shrinks)
      shapes.push_back(shape);
      const double off = (times - 1.0) * std::min(shape[2], shape[3]);
      const double moved = stands_at(g, shape[0], shape[1]) + off;
      shapes.back()[1] = shape[0] != 0.0 ? moved : 2.0 * g.on_flank(1, 1, moved, 0.0).radius_mm;
      shapes.back()[2] += off;
      shapes.back()[3] -= off;
    }
    std::erase_if(shapes, [&](const EffectShape& s) {
      const double share = share_at(g, s[0], s[1]);
      const auto [narrow, wide] = std::minmax({s[2], s[3]});
      return !(share > kEnds && share < 1.0 - kEnds && narrow >= kNarrowest * range &&
               narrow <= kNarrow * range && wide <= kWidest * range && wide >= kSkewed * narrow);
    });
    return shapes;
  };
  f.term_keys = {kAlong,
                 number("place_mm"),
                 number("below_mm"),
                 number("above_mm"),
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = shape.back() != 0.0;
    const std::string roll = shape[0] != 0.0 ? "" : " of roll length";
    return "the same on every tooth, " + a_ridge(opposite ? 0 : told.sign()) + " " +
           over(shape[0]) + " " + at_place(told.geometry, shape[0], shape[1]) +
           (shape[0] != 0.0 ? printed(", %.2g mm downwards and %.2g mm upwards", shape[2], shape[3])
                            : printed(", %.2g mm towards smaller and %.2g mm towards larger "
                                      "diameters",
                                      shape[2], shape[3])) +
           roll + opposite_words(shape.back() != 0.0) +
           (opposite ? there("there", told.sign(), true) : "");
  };
  return f;
}

/// Straight from one half to minus one half over a period, and back at once.
EffectFamily unnamed_sawtooth() {
  EffectFamily f =
      jumping("unnamed_sawtooth", {"along", "place_mm", "period_mm", "opposite_flanks"},
              [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                return sawtooth(along(shape[0], p) - stands_at(g, shape[0], shape[1]), shape[2]);
              });
  f.nearby = periods_beside;
  f.term_keys = {kAlong,
                 number("place_mm"),
                 number("period_mm"),
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return "the same on every tooth, a sawtooth " + over(shape[0]) +
           printed(", period %.3g mm", shape[2]) + (shape[0] != 0.0 ? "" : " of roll length") +
           ", one of its jumps " + at_place(told.geometry, shape[0], shape[1]) +
           opposite_words(shape.back() != 0.0) +
           there(shape[0] != 0.0 ? "right above a jump" : "at diameters right beyond a jump",
                 told.sign(), shape.back() != 0.0);
  };
  return f;
}

/// Nothing at the edges of facets, one edge at its place, and 1 in the middle of each.
EffectFamily unnamed_arches() {
  EffectFamily f =
      jumping("unnamed_arches", {"along", "place_mm", "period_mm", "opposite_flanks"},
              [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                return arches(along(shape[0], p) - stands_at(g, shape[0], shape[1]), shape[2]);
              });
  f.nearby = periods_beside;
  f.term_keys = {kAlong,
                 number("place_mm"),
                 number("period_mm"),
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = shape.back() != 0.0;
    const int sign = opposite ? 0 : told.sign();
    return (sign < 0   ? "the same on every tooth, facets "
            : sign > 0 ? "the same on every tooth, scallops "
                       : "the same on every tooth, facets or scallops ") +
           over(shape[0]) + printed(", each %.3g mm long", shape[2]) +
           (shape[0] != 0.0 ? "" : " (of roll length)") + ", one of their edges " +
           at_place(told.geometry, shape[0], shape[1]) + opposite_words(opposite) +
           there("between the edges", told.sign(), opposite) +
           (sign < 0 ? ", as of a model or a path whose curves are polygons" : "");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
