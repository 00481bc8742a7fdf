// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

// Forms that no polynomial and no slow wave describes: a step, a groove or ridge, a strip, a short
// wave. They describe without a cause and are no candidates: the remainder says which of them, and
// where (remainder.h), or they are tried in place of several effects (one_form.cpp).
namespace trueflank::loop::gear_effects {
namespace {

/// A form moved a little, off both ends.
std::vector<EffectShape> places_inside(const FlankGeometry& g, const EffectShape& shape) {
  constexpr double kEnds = 0.03;
  std::vector<EffectShape> shapes = places_beside(g, shape);
  std::erase_if(shapes, [&](const EffectShape& s) {
    const double share = share_at(g, s[0], s[1]);
    return !(share > kEnds && share < 1.0 - kEnds);
  });
  return shapes;
}

/// True of opposite signs on the two flanks: the shape value behind a form's own.
bool is_opposite(const EffectShape& shape, std::size_t own) {
  return shape.size() > own && shape[own] != 0.0;
}
/// The place of a form that is more than a place away from the lower end or the root.
std::string beyond(double face) { return face != 0.0 ? "above it" : "at larger diameters"; }

/// The same, of opposite signs on the two flanks where one more shape value is not 0.
EffectFamily on_either_flank(EffectFamily f) {
  const auto opposite = [own = f.shape_names.size()](const EffectShape& shape) {
    return is_opposite(shape, own);
  };
  f.shape_names.emplace_back("opposite_flanks");
  f.term_keys.push_back({"flanks", TermKey::Kind::kWord, {"equal", "opposite"}});
  const int count = f.columns ? f.columns({}) : 1;
  f.evaluate = [evaluate = f.evaluate, opposite, count](const FlankGeometry& g, const Place& p,
                                                        const EffectShape& shape, double* c) {
    evaluate(g, p, shape, c);
    if (p.side < 0 && opposite(shape)) std::transform(c, c + count, c, std::negate());
  };
  f.nearby = [nearby = f.nearby](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = nearby(g, shape);
    for (EffectShape& beside : shapes)
      for (std::size_t k = beside.size(); k < shape.size(); ++k) beside.push_back(shape[k]);
    return shapes;
  };
  return f;
}

}  // namespace

double along_profile(const FlankGeometry& geometry, double roll_mm) {
  constexpr double kFromBase =
      0.02;  // the involute begins at the base circle with no length a roll
  return std::max(kFromBase, roll_mm / geometry.base_radius_mm());
}

bool is_step_with_edge(const FlankGeometry& g, double face, double place_mm, double edge_mm) {
  constexpr double kRoom = 0.8;
  const double share = share_at(g, face, place_mm);
  return edge_mm == 0.0 ||
         edge_mm <= kRoom * std::min(share, 1.0 - share) * std::abs(range_mm(g, face));
}

/// From nothing to 1 at its place, at once or over the length of an edge.
EffectFamily unnamed_step() {
  constexpr std::size_t kEdge = 3;
  EffectFamily f = along_flank(
      "unnamed_step", {"along", "place_mm", "opposite_flanks", "edge_mm"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        return (shape[2] != 0.0 ? p.side : 1.0) *
               beyond_edge(along(shape[0], p) - stands_at(g, shape[0], shape[1]), shape[kEdge]);
      });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    // (few values tell where a form bends, any beside a step on which side of it they stand)
    std::vector<EffectShape> shapes =
        places_beside(g, shape, {0.05, 0.02, 0.01, 0.005, 0.002, 0.0007, 0.0002});
    // A sharp one stays sharp: with an edge, one that was found first bends to what stands beside
    // it (edges are sought for all at once: likeliest_steps.cpp). A longer edge is a slope from end
    // to end.
    constexpr double kSharpest = 0.01, kSoftest = 0.25;
    const double range = std::abs(range_mm(g, shape[0])), edge = shape[kEdge];
    if (edge == 0.0) return shapes;
    for (const double times : {0.0, 0.5, 0.7, 0.87, 0.95, 1.05, 1.15, 1.43, 2.0}) {
      const double other = times * edge;
      if (times != 0.0 && !(other >= kSharpest * range && other <= kSoftest * range)) continue;
      shapes.push_back(shape);
      shapes.back()[kEdge] = other;
    }
    std::erase_if(
        shapes, [&](const EffectShape& s) { return !is_step_with_edge(g, s[0], s[1], s[kEdge]); });
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) { return shape[kEdge] > 0.0 ? 2 : 1; };
  f.term_keys = {kAlong,
                 number("place_mm"),
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}},
                 number("edge_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = shape[2] != 0.0;
    return "the same on every tooth, a step " + over(shape[0]) + " " +
           at_place(told.geometry, shape[0], shape[1]) +
           (shape[kEdge] > 0.0 ? printed(", over %.2g mm", shape[kEdge]) +
                                     (shape[0] != 0.0 ? "" : " of roll length")
                               : "") +
           opposite_words(opposite) + there(beyond(shape[0]), told.sign(), opposite);
  };
  return f;
}

/// Straight to its place and straight on in another direction: nothing on the one side, 1 at the
/// end of the other; or a roof, 1 at the end of the longer side; or a waist, 1 at both ends.
EffectFamily unnamed_kink() {
  constexpr double kBefore = -1.0, kBoth = 0.0, kBeyond = 1.0, kWaist = 2.0;
  EffectFamily f = along_flank(
      "unnamed_kink", {"along", "place_mm", "bends"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        const double at = stands_at(g, shape[0], shape[1]), off = along(shape[0], p) - at;
        const double low = end_mm(g, shape[0], kBefore) - at,
                     high = end_mm(g, shape[0], kBeyond) - at;
        if (shape[2] == kBoth) return std::abs(off) / std::max(std::abs(low), std::abs(high));
        const bool beyond = shape[2] == kWaist ? off * high > 0.0 : shape[2] == kBeyond;
        const double range = beyond ? high : low;
        return range != 0.0 ? std::max(0.0, off / range) : 0.0;
      });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = places_inside(g, shape);
    if (shape[2] == kWaist) return shapes;  // (one in the middle is a roof)
    for (const double bends : {kBefore, kBeyond, kBoth})
      if (bends != shape[2]) shapes.push_back({shape[0], shape[1], bends});
    return shapes;
  };
  f.is_like_many = true;
  f.term_keys = {kAlong, number("place_mm"), {"bends"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = is_opposite(shape, 3);
    return "the same on every tooth, a kink " + over(shape[0]) + " " +
           at_place(told.geometry, shape[0], shape[1]) +
           (shape[2] == kWaist
                ? ", from there straight to both ends alike"
                : ", straight on in another direction" + towards(shape[0], shape[2])) +
           opposite_words(opposite) + there("there", told.sign(), opposite);
  };
  return on_either_flank(std::move(f));
}

/// Flat to its place, and from there on a parabola: 1 at the end it bends towards. Towards both
/// ends (0): the same from the other end, the place being the upper one, or that towards the tip.
EffectFamily unnamed_bend() {
  constexpr double kLowEnd = -1.0, kBothEnds = 0.0, kHighEnd = 1.0;
  EffectFamily f = along_flank(
      "unnamed_bend", {"along", "place_mm", "curves"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        const double low = end_mm(g, shape[0], kLowEnd), high = end_mm(g, shape[0], kHighEnd),
                     at = stands_at(g, shape[0], shape[1]);
        const double end = shape[2] == kLowEnd ? low : high, range = end - at;
        if (range == 0.0) return 0.0;
        const double share = (along(shape[0], p) - at) / range;
        const double from_low = (low + high - along(shape[0], p) - at) / range;
        const double most = shape[2] == kBothEnds ? std::max(share, from_low) : share;
        return most > 0.0 ? most * most : 0.0;
      });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = places_inside(g, shape);
    if (shape[2] != kBothEnds) {
      shapes.push_back({shape[0], shape[1], shape[2] == kLowEnd ? kHighEnd : kLowEnd});
      return shapes;
    }
    // Longer ones are nearly a parabola over all of it: a crowning.
    constexpr double kNearest = 0.65;
    std::erase_if(shapes, [&](const EffectShape& s) { return share_at(g, s[0], s[1]) < kNearest; });
    return shapes;
  };
  f.is_like_many = true;
  f.term_keys = {kAlong, number("place_mm"), {"curves"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = is_opposite(shape, 3);
    return "the same on every tooth, flat to a place " + over(shape[0]) + " " +
           at_place(told.geometry, shape[0], shape[1]) + ", and curved from there on" +
           (shape[2] == 0.0 ? ", and as far from the other end" : towards(shape[0], shape[2])) +
           opposite_words(opposite) + there("there", told.sign(), opposite);
  };
  return on_either_flank(std::move(f));
}

/// 1 at an end, and dying away from it; the same at both ends (0).
EffectFamily unnamed_rise() {
  constexpr double kLow = -1.0, kBothEnds = 0.0, kHigh = 1.0;
  EffectFamily f = along_flank(
      "unnamed_rise", {"along", "dies_within_mm", "towards"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        const auto from = [&](double end) {
          return std::exp(-std::abs(along(shape[0], p) - end_mm(g, shape[0], end)) / shape[1]);
        };
        return shape[2] == kBothEnds ? from(kLow) + from(kHigh) : from(shape[2]);
      });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    // Longer ones, at both ends, are nearly a parabola: a crowning.
    constexpr double kLongestAtBoth = 0.2;
    const auto fits = [&](double length_mm) {
      return shape[2] != kBothEnds || length_mm <= kLongestAtBoth * std::abs(range_mm(g, shape[0]));
    };
    std::vector<EffectShape> shapes;
    for (const double times : {0.7, 0.85, 0.95, 1.05, 1.18, 1.43})
      if (fits(times * shape[1])) shapes.push_back({shape[0], times * shape[1], shape[2]});
    return shapes;
  };
  f.is_like_many = true;
  f.term_keys = {kAlong, number("dies_within_mm"), {"towards"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = is_opposite(shape, 3);
    return "the same on every tooth, more and more " + over(shape[0]) +
           (shape[2] == 0.0 ? " towards both ends" : towards(shape[0], shape[2])) + ", " +
           within(told.geometry, shape[0], shape[1], "within ", "") + opposite_words(opposite) +
           there("there", told.sign(), opposite);
  };
  return on_either_flank(std::move(f));
}

namespace {

/// Where a cubic that is nothing at both ends of -1 to 1 and has its other root outside them is
/// largest: from a third to two thirds of the way. About the middle it is a parabola: a crowning.
constexpr double kOffTheMiddle = 0.08, kFarthest = 0.33;

/// Off the middle of the range, in halves of it.
double off_the_middle(const FlankGeometry& g, double face, double at_mm) {
  const double low = end_mm(g, face, -1.0), high = end_mm(g, face, 1.0);
  return (2.0 * at_mm - low - high) / (high - low);
}

}  // namespace

/// As designed at both ends, and one hollow or swelling between them, 1 at its place.
EffectFamily unnamed_sag() {
  EffectFamily f = along_flank(
      "unnamed_sag", {"along", "place_mm"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        const double at = std::clamp(off_the_middle(g, shape[0], stands_at(g, shape[0], shape[1])),
                                     -kFarthest, kFarthest);
        const double leans = 2.0 * at / (1.0 - 3.0 * at * at);
        const auto height = [&](double v) { return (1.0 - v * v) * (1.0 + leans * v); };
        const double v = off_the_middle(g, shape[0], along(shape[0], p));
        return height(v) / height(at);
      });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes =
        places_beside(g, shape, {0.05, 0.02, 0.01, 0.005, 0.002, 0.0007, 0.0002});
    std::erase_if(shapes, [&](const EffectShape& s) {
      const double off = std::abs(off_the_middle(g, s[0], stands_at(g, s[0], s[1])));
      return off < kOffTheMiddle || off > kFarthest;
    });
    return shapes;
  };
  f.is_followed_nearly = true;
  f.term_keys = {kAlong, number("place_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return "the same on every tooth, " + a_swelling(told.sign()) + " " + over(shape[0]) +
           " from end to end, most " + at_place(told.geometry, shape[0], shape[1]);
  };
  return f;
}

EffectFamily unnamed_band() {
  EffectFamily f =
      along_flank("unnamed_band", {"along", "place_mm", "width_mm"},
                  [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                    return bell(along(shape[0], p) - stands_at(g, shape[0], shape[1]), shape[2]);
                  });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = places_beside(g, shape);
    for (const double times : {0.7, 0.85, 0.95, 1.05, 1.18, 1.43})
      shapes.push_back({shape[0], shape[1], times * shape[2]});
    return shapes;
  };
  f.term_keys = {kAlong, number("place_mm"), number("width_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = is_opposite(shape, 3);
    const int sign = opposite ? 0 : told.sign();
    return "the same on every tooth, " + a_ridge(sign) + " " + over(shape[0]) + " " +
           at_place(told.geometry, shape[0], shape[1]) + ", " +
           within(told.geometry, shape[0], shape[2], "", " to either side") +
           opposite_words(opposite) + (opposite ? there("there", told.sign(), true) : "");
  };
  return on_either_flank(std::move(f));
}

/// 1 between two places, with sides over a length.
EffectFamily unnamed_strip() {
  EffectFamily f =
      along_flank("unnamed_strip", {"along", "from_mm", "to_mm", "side_mm"},
                  [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                    const double at = along(shape[0], p);
                    return beyond_edge(at - stands_at(g, shape[0], shape[1]), shape[3]) *
                           beyond_edge(stands_at(g, shape[0], shape[2]) - at, shape[3]);
                  });
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    const double range = std::abs(range_mm(g, shape[0]));
    const auto moved = [&](double place_mm, double share) {
      const double at = stands_at(g, shape[0], place_mm) + share * range;
      return shape[0] != 0.0 ? at : 2.0 * g.on_flank(1, 1, at, 0.0).radius_mm;
    };
    // (one that reaches an end is a step)
    constexpr double kEnds = 0.06;
    const auto share_of = [&](double place_mm) { return share_at(g, shape[0], place_mm); };
    const auto add = [&](EffectShape beside) {
      const auto [first, last] = std::minmax({share_of(beside[1]), share_of(beside[2])});
      if (first > kEnds && last < 1.0 - kEnds &&
          stands_at(g, beside[0], beside[1]) < stands_at(g, beside[0], beside[2]))
        shapes.push_back(std::move(beside));
    };
    for (const double share : {0.05, 0.02, 0.01, 0.005, 0.002})
      for (const double sign : {-1.0, 1.0})
        for (const std::size_t k : {1U, 2U}) {
          EffectShape beside = shape;
          beside[k] = moved(shape[k], sign * share);
          add(std::move(beside));
        }
    constexpr double kSteepest = 0.005, kFlattest = 0.25;  // of the range
    for (const double times : {0.5, 0.7, 0.87, 1.15, 1.43, 2.0}) {
      EffectShape beside = shape;
      beside[3] = std::clamp(times * shape[3], kSteepest * range, kFlattest * range);
      if (beside != shape) add(std::move(beside));
    }
    return shapes;
  };
  f.term_keys = {kAlong, number("from_mm"), number("to_mm"), number("side_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = is_opposite(shape, 4);
    return "the same on every tooth, a strip " + over(shape[0]) + " " +
           (shape[0] != 0.0
                ? printed("between heights of %.3g and %.3g mm", shape[1], shape[2])
                : printed("between diameters of %.5g and %.5g mm", shape[1], shape[2])) +
           (opposite ? "" : " " + stands(told.sign())) +
           printed(", with sides of %.2g mm", shape[3]) +
           (shape[0] != 0.0 ? "" : " of roll length") + opposite_words(opposite) +
           (opposite ? there("there", told.sign(), true) : "");
  };
  return on_either_flank(std::move(f));
}

namespace {

/// ", the first crest at a height of 0.4 mm": from the lower end, or the root, on; empty where it
/// is not known.
std::string first_crest(const ToldForm& told) {
  const FlankGeometry& g = told.geometry;
  const double face = told.shape[0], length = told.shape[1];
  const auto [low, high] = std::minmax({end_mm(g, face, -1.0), end_mm(g, face, 1.0)});
  const double crest = told.direction_rad() / kTwoPi * length;
  const double first = crest + length * std::ceil((low - crest) / length);
  if (!(first <= high)) return "";
  const double place = face != 0.0 ? first : 2.0 * g.on_flank(1, 1, first, 0.0).radius_mm;
  return ", the first crest " + at_place(g, face, place);
}

/// "waves across the flanks, 2.1 over the profile, 3.4 mm of roll length each, and 3.6 over the
/// face, 1.9 mm each"; those along one direction alone by that.
std::string waves_across(const FlankGeometry& g, double over_profile, double over_face) {
  // Less than a quarter of a wave: the crests lie straight along the flank, as near as waves of
  // one flank tell it.
  constexpr double kNone = 0.25;
  const double profile = std::abs(over_profile), face = std::abs(over_face);
  const double profile_mm = std::abs(range_mm(g, 0.0)) / profile, face_mm = range_mm(g, 1.0) / face;
  if (profile < kNone && face < kNone) return "the flanks stand in waves around the gear";
  if (profile < kNone) return waves_over(g, 1.0, face_mm);
  if (face < kNone) return waves_over(g, 0.0, profile_mm);
  return printed(
             "waves across the flanks, %.1f over the profile, %.3g mm of roll length each, and "
             "%.1f over the face, %.3g mm each",
             profile, profile_mm, face, face_mm) +
         (over_profile * over_face < 0.0 ? ", rising towards the tip"
                                         : ", falling towards the tip");
}

/// ", that march from tooth to tooth: 15 periods a turn, towards the tip": along the direction in
/// which there are more waves.
std::string marching(const EffectShape& shape) {
  const double periods = std::abs(shape[2]);
  const double face = std::abs(shape[1]) >= std::abs(shape[0]) ? 1.0 : 0.0;
  const double waves = face != 0.0 ? shape[1] : shape[0];
  return ", that march from tooth to tooth: " +
         (periods == 1.0 ? std::string("one period") : printed("%.3g periods", periods)) +
         " a turn" + (waves == 0.0 ? "" : "," + towards(face, waves * shape[2] < 0.0 ? 1.0 : -1.0));
}

}  // namespace

EffectFamily unnamed_waviness() {
  EffectFamily f = described("unnamed_waviness", {"along", "wavelength_mm"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    const bool flank = p.surface == Surface::kFlank;
    const double angle = kTwoPi * along(shape[0], p) / shape[1];
    c[0] = flank ? std::cos(angle) : 0.0;
    c[1] = flank ? std::sin(angle) : 0.0;
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = needs_of_direction;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    for (const double times : {0.97, 0.99, 0.997, 1.003, 1.01, 1.03})
      shapes.push_back({shape[0], times * shape[1]});
    return shapes;
  };
  f.term_keys = {kAlong, number("wavelength_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = is_opposite(shape, 2);
    const std::string crest = first_crest(told);
    return "the same on every tooth, " + waves_over(told.geometry, shape[0], shape[1]) +
           opposite_words(opposite) + crest +
           (!opposite || crest.empty()                                ? ""
            : flank_side(Flank::kLeft, told.geometry.gear().kind) > 0 ? " on the left ones"
                                                                      : " on the right ones");
  };
  return on_either_flank(std::move(f));
}

namespace {

/// Of waves along the face alone: fewer are forms that teeth have, and told as those.
bool is_bow_over_face(const EffectShape& waves) {
  constexpr double kFewest = 2.0;
  return waves[0] == 0.0 && std::abs(waves[1]) < kFewest;
}

}  // namespace

/// Waves in any direction across the flanks, which run on from tooth to tooth.
EffectFamily unnamed_marks() {
  EffectFamily f = described("unnamed_marks", {"waves_over_profile", "waves_over_face", "order"});
  f.columns = [](const EffectShape&) { return 2; };
  f.one_flank_too = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const bool flank = p.surface == Surface::kFlank;
    const double angle = kPi * (shape[0] * (g.profile_coordinate(p.roll_mm) + 1.0) +
                                shape[1] * (g.face_coordinate(p.z_mm) + 1.0)) +
                         kTwoPi * shape[2] * (p.tooth - 1) / g.teeth();
    c[0] = flank ? std::cos(angle) : 0.0;
    c[1] = flank ? std::sin(angle) : 0.0;
  };
  f.needs = [](const EffectShape& shape) {
    const bool profile = shape[0] != 0.0, face = shape[1] != 0.0;
    return NeedsToBeSeen{.along_profile = profile, .along_face = face, .crossed = profile && face};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    for (const double off : {0.1, 0.03, 0.01})
      for (const double sign : {-1.0, 1.0}) {
        if (shape[0] != 0.0) shapes.push_back({shape[0] + sign * off, shape[1], shape[2]});
        if (shape[1] != 0.0) shapes.push_back({shape[0], shape[1] + sign * off, shape[2]});
      }
    std::erase_if(shapes, is_bow_over_face);
    return shapes;
  };
  f.term_keys = {number("waves_over_profile"), number("waves_over_face"), number("order")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return waves_across(told.geometry, shape[0], shape[1]) +
           (shape[2] == 0.0 ? ", the same on every tooth" : marching(shape));
  };
  return f;
}

/// Arches with sharp edges between them, one beside the other across the flanks, the same on every
/// tooth: what feed leaves. Told in place of a wave and its multiples (products.cpp), and no
/// candidate of its own.
EffectFamily unnamed_scallops() {
  EffectFamily f = described("unnamed_scallops",
                             {"waves_over_profile", "waves_over_face", "from_share", "parabolas"});
  f.one_flank_too = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    constexpr double kMeanOfSine = 2.0 / kPi, kMeanOfParabola = 2.0 / 3.0;
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double waves = 0.5 * (shape[0] * (g.profile_coordinate(p.roll_mm) + 1.0) +
                                shape[1] * (g.face_coordinate(p.z_mm) + 1.0)) +
                         shape[2];
    const double off = waves - std::floor(waves) - 0.5;  // from the middle of an arch
    c[0] = shape[3] != 0.0 ? 1.0 - 4.0 * off * off - kMeanOfParabola
                           : std::cos(kPi * off) - kMeanOfSine;
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = [](const EffectShape& shape) {
    return NeedsToBeSeen{.along_profile = shape[0] != 0.0, .along_face = shape[1] != 0.0};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    // (turned about the middle of the flank: the places of edges there stay)
    for (const std::size_t k : {0, 1})
      for (const double off : {0.1, 0.03, 0.01, 0.003, 0.001, 0.0003})
        for (const double sign : {-1.0, 1.0}) {
          shapes.push_back(shape);
          shapes.back()[k] += sign * off;
          shapes.back()[2] -= 0.5 * sign * off;
        }
    for (const double off : {0.05, 0.01, 0.003, 0.001, 0.0003})
      for (const double sign : {-1.0, 1.0}) {
        shapes.push_back(shape);
        shapes.back()[2] += sign * off;
      }
    shapes.push_back({shape[0], shape[1], shape[2], 1.0 - shape[3]});
    for (EffectShape& beside : shapes) beside[2] -= std::floor(beside[2]);
    constexpr double kFewest = 2.0;  // arches: fewer are bows
    std::erase_if(shapes, [](const EffectShape& beside) { return std::abs(beside[1]) < kFewest; });
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) { return shape[0] != 0.0 ? 3 : 2; };
  f.form_word = "scallops";  // one law: it is no form that a name would mend
  f.term_keys = {number("waves_over_profile"),
                 number("waves_over_face"),
                 number("from_share"),
                 {"arches", TermKey::Kind::kWord, {"sines", "parabolas"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const int sign = told.sign();
    return "the same on every tooth, scallops with sharp " +
           std::string(sign > 0   ? "grooves"
                       : sign < 0 ? "ridges"
                                  : "ridges or grooves") +
           " between them, " + waves_across(told.geometry, shape[0], shape[1]);
  };
  return f;
}

/// Waves as unnamed_marks has them, of no whole number of periods a turn: they begin at a tooth.
/// Told in place of waves of whole orders that follow them (waves.cpp), and no candidate
/// of its own.
EffectFamily unnamed_walking_waves() {
  EffectFamily f = described("unnamed_walking_waves",
                             {"waves_over_profile", "waves_over_face", "order", "from_tooth"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const bool flank = p.surface == Surface::kFlank;
    const double angle = kPi * (shape[0] * (g.profile_coordinate(p.roll_mm) + 1.0) +
                                shape[1] * (g.face_coordinate(p.z_mm) + 1.0)) +
                         kTwoPi * shape[2] * teeth_since(g, p.tooth, shape[3]) / g.teeth();
    c[0] = flank ? std::cos(angle) : 0.0;
    c[1] = flank ? std::sin(angle) : 0.0;
  };
  f.needs = [](const EffectShape& shape) {
    return NeedsToBeSeen{.along_profile = shape[0] != 0.0, .along_face = shape[1] != 0.0};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    const auto add = [&](std::size_t k, double off) {
      shapes.push_back(shape);
      shapes.back()[k] += off;
    };
    for (const double off : {0.1, 0.03, 0.01})
      for (const double sign : {-1.0, 1.0}) {
        add(0, sign * off);
        if (shape[1] != 0.0) add(1, sign * off);
        add(2, sign * off);
      }
    const int z = g.teeth();
    for (const int off : {-4, -2, -1, 1, 2, 4}) {
      shapes.push_back(shape);
      shapes.back()[3] = (static_cast<int>(shape[3]) - 1 + off + z) % z + 1;
    }
    std::erase_if(shapes, is_bow_over_face);
    return shapes;
  };
  f.term_keys = {
      number("waves_over_profile"), number("waves_over_face"), number("order"), {"from_tooth"}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return waves_across(told.geometry, shape[0], shape[1]) +
           marching({shape[0], shape[1], shape[2]}) +
           printed(
               ", no whole number: they begin anew at tooth %.0f, as from a vibration that keeps "
               "no step with the turn",
               shape[3]);
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
