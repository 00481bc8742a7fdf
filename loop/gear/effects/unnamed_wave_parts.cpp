// SPDX-License-Identifier: GPL-3.0-or-later
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

// Waves of one length that do not run over the whole flank alike. Told in place of waves of several
// lengths and of forms that follow them together (one_form.cpp), and no candidates of
// their own.
namespace trueflank::loop::gear_effects {
namespace {

constexpr double kLow = -1.0, kHigh = 1.0;
constexpr std::array kTimes{0.8, 0.93, 0.98, 1.02, 1.07, 1.25};

/// Cosine and sine of waves over the flank, times how large they are at a place.
template <class Size>
EffectFamily waves_of_size(const std::string& id, std::vector<std::string> shape_names, Size size) {
  EffectFamily f = described(id, std::move(shape_names));
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [size](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const double here = p.surface == Surface::kFlank ? size(g, p, shape) : 0.0;
    const double angle = kTwoPi * along(shape[0], p) / shape[1];
    c[0] = here * std::cos(angle);
    c[1] = here * std::sin(angle);
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = needs_of_direction;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  return f;
}

std::vector<EffectShape> lengths_beside(const EffectShape& shape) {
  std::vector<EffectShape> shapes;
  for (const double times : {0.97, 0.99, 0.997, 1.003, 1.01, 1.03}) {
    shapes.push_back(shape);
    shapes.back()[1] *= times;
  }
  return shapes;
}

std::string waves(const ToldForm& told) {
  return "the same on every tooth, waves " + over(told.shape[0]) +
         long_each(told.shape[0], told.shape[1]);
}

/// Of a burst at least two waves are seen: what dies away sooner is a groove or a ridge.
bool is_burst(const EffectShape& shape) {
  constexpr double kFewestInHalf = 0.75;
  return shape[3] >= kFewestInHalf * shape[1];
}

}  // namespace

/// Over the profile, mirrored on the two flanks: a tool that runs out cuts one flank of a tooth in
/// one sense of its turn and the other flank in the other.
EffectFamily unnamed_waves_mirrored() {
  EffectFamily f = described("unnamed_waves_mirrored", {"wavelength_mm"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    const bool flank = p.surface == Surface::kFlank;
    const double angle = kTwoPi * p.roll_mm / shape[0];
    c[0] = flank ? std::cos(angle) : 0.0;
    c[1] = flank ? p.side * std::sin(angle) : 0.0;
  };
  f.values_sought = [](const EffectShape&) { return 1; };
  f.form_word = "mirrored_waves";  // one law: it is no form that a name would mend
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = [](const EffectShape&) { return NeedsToBeSeen{.along_profile = true}; };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    // (the phases of the two flanks tell the length more exactly than one flank does)
    std::vector<EffectShape> shapes;
    for (const double off : {0.03, 0.01, 0.003, 0.001, 0.0003})
      for (const double sign : {-1.0, 1.0}) shapes.push_back({(1.0 + sign * off) * shape[0]});
    return shapes;
  };
  f.term_keys = {number("wavelength_mm")};
  f.words = [](const ToldForm& told) {
    const FlankGeometry& g = told.geometry;
    const double length = told.shape[0], phase_mm = told.direction_rad() / kTwoPi * length;
    const auto crest = [&](Flank flank) {
      const double at = flank_side(flank, g.gear().kind) * phase_mm;
      const auto [low, high] = std::minmax({end_mm(g, 0.0, -1.0), end_mm(g, 0.0, 1.0)});
      const double first = at + length * std::ceil((low - at) / length);
      return first <= high
                 ? printed("a diameter of %.5g mm", 2.0 * g.on_flank(1, 1, first, 0.0).radius_mm)
                 : std::string();
    };
    const std::string text = "the same on every tooth, " + waves_over(g, 0.0, length) +
                             ", mirrored on the two flanks as of a tool that runs out";
    const std::string left = crest(Flank::kLeft), right = crest(Flank::kRight);
    return left.empty() || right.empty()
               ? text
               : text + ", the first crest at " + left + " on the left ones and " + right +
                     " on the right ones";
  };
  return f;
}

/// From a place on towards an end, where they come up over some length.
EffectFamily unnamed_waves_from() {
  EffectFamily f = waves_of_size(
      "unnamed_waves_from", {"along", "wavelength_mm", "place_mm", "towards", "within_mm"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        constexpr double kSteepness = 4.4;  // of a logistic curve from 0.1 to 0.9
        const double at = stands_at(g, shape[0], shape[2]), end = end_mm(g, shape[0], shape[3]);
        const double beyond = (along(shape[0], p) - at) * (end > at ? 1.0 : -1.0);
        return 1.0 / (1.0 + std::exp(-kSteepness * beyond / shape[4]));
      });
  f.term_keys = {
      kAlong, number("wavelength_mm"), number("place_mm"), {"towards"}, number("within_mm")};
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = lengths_beside(shape);
    for (const EffectShape& moved : places_beside(g, {shape[0], shape[2]}))
      shapes.push_back({shape[0], shape[1], moved[1], shape[3], shape[4]});
    for (const double times : {0.4, 0.7, 1.4, 2.5})
      if (const double within = times * shape[4];
          within > 0.05 * shape[1] && within < 2.0 * shape[1])
        shapes.push_back({shape[0], shape[1], shape[2], shape[3], within});
    return shapes;
  };
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return waves(told) + ", from a place " + at_place(told.geometry, shape[0], shape[2]) + " on" +
           towards(shape[0], shape[3]);
  };
  return f;
}

/// Largest at an end, and dying away from it.
EffectFamily unnamed_waves_dying() {
  EffectFamily f = waves_of_size(
      "unnamed_waves_dying", {"along", "wavelength_mm", "dies_within_mm", "towards"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        return std::exp(-std::abs(along(shape[0], p) - end_mm(g, shape[0], shape[3])) / shape[2]);
      });
  f.term_keys = {kAlong, number("wavelength_mm"), number("dies_within_mm"), {"towards"}};
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    std::vector<EffectShape> shapes = lengths_beside(shape);
    for (const double times : kTimes) {
      shapes.push_back(shape);
      shapes.back()[2] *= times;
    }
    return shapes;
  };
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return waves(told) + ", that grow" + towards(shape[0], shape[3]) + ", " +
           within(told.geometry, shape[0], shape[2], "and die away from it within ", "");
  };
  return f;
}

/// Nothing at one end, and evenly more towards the other.
EffectFamily unnamed_waves_growing() {
  EffectFamily f = waves_of_size(
      "unnamed_waves_growing", {"along", "wavelength_mm", "towards"},
      [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
        const double to = end_mm(g, shape[0], shape[2]), from = end_mm(g, shape[0], -shape[2]);
        return (along(shape[0], p) - from) / (to - from);
      });
  f.term_keys = {kAlong, number("wavelength_mm"), {"towards"}};
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) { return lengths_beside(shape); };
  f.words = [](const ToldForm& told) {
    return waves(told) + ", that grow evenly" + towards(told.shape[0], told.shape[2]);
  };
  return f;
}

/// About a place, and dying away to both sides of it: a burst of chatter.
EffectFamily unnamed_waves_burst() {
  EffectFamily f =
      waves_of_size("unnamed_waves_burst", {"along", "wavelength_mm", "place_mm", "half_mm"},
                    [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                      return bell(along(shape[0], p) - stands_at(g, shape[0], shape[2]), shape[3]);
                    });
  f.term_keys = {kAlong, number("wavelength_mm"), number("place_mm"), number("half_mm")};
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kWidest = 0.4;  // of the flank: wider ones are all over it
    std::vector<EffectShape> shapes = lengths_beside(shape);
    for (const EffectShape& moved : places_beside(g, {shape[0], shape[2]}))
      shapes.push_back({shape[0], shape[1], moved[1], shape[3]});
    for (const double times : kTimes)
      if (times * shape[3] <= kWidest * std::abs(range_mm(g, shape[0])))
        shapes.push_back({shape[0], shape[1], shape[2], times * shape[3]});
    std::erase_if(shapes, [](const EffectShape& beside) { return !is_burst(beside); });
    return shapes;
  };
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return waves(told) + ", in a burst " + at_place(told.geometry, shape[0], shape[2]) + ", " +
           within(told.geometry, shape[0], shape[3], "dying away within ", " to either side");
  };
  return f;
}

/// Ever shorter towards one end: the waves in a mm change evenly, by a share of those in the middle
/// to either side.
EffectFamily unnamed_waves_changing() {
  EffectFamily f = described("unnamed_waves_changing", {"along", "wavelength_mm", "change"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const double low = end_mm(g, shape[0], kLow), range = end_mm(g, shape[0], kHigh) - low;
    const double share = (along(shape[0], p) - low) / range;
    const double angle = kTwoPi * range / shape[1] * (share + shape[2] * (share * share - share));
    const bool flank = p.surface == Surface::kFlank;
    c[0] = flank ? std::cos(angle) : 0.0;
    c[1] = flank ? std::sin(angle) : 0.0;
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = needs_of_direction;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.term_keys = {kAlong, number("wavelength_mm"), number("change")};
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    constexpr double kMost = 0.97;
    std::vector<EffectShape> shapes = lengths_beside(shape);
    // (of many waves a thousandth more is a tenth of a wave at the end)
    for (const double times : {0.999, 1.001}) {
      shapes.push_back(shape);
      shapes.back()[1] *= times;
    }
    for (const double off : {-0.1, -0.03, -0.01, -0.003, -0.001, 0.001, 0.003, 0.01, 0.03, 0.1})
      if (std::abs(shape[2] + off) < kMost) shapes.push_back({shape[0], shape[1], shape[2] + off});
    return shapes;
  };
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return "the same on every tooth, waves " + over(shape[0]) +
           printed(" that change their length, %.3g mm at the ", shape[1] / (1.0 - shape[2])) +
           (shape[0] != 0.0 ? "lower end" : "root") +
           printed(", %.3g mm at the ", shape[1] / (1.0 + shape[2])) +
           (shape[0] != 0.0 ? "upper one" : "tip") + (shape[0] != 0.0 ? "" : " (of roll length)");
  };
  return f;
}

std::vector<Effect> parts_of_waves(const FlankGeometry& geometry, double face, FlankChoice flank,
                                   double wavelength_mm) {
  constexpr double kComeUp = 0.3;  // of a wave
  const double low = end_mm(geometry, face, kLow), range = end_mm(geometry, face, kHigh) - low;
  std::vector<Effect> parts;
  for (const double times : {0.96, 1.0, 1.04})
    for (const double end : {kLow, kHigh}) {
      for (const double share : {0.15, 0.3, 0.45, 0.6, 0.75}) {
        const double at = low + share * range;
        parts.push_back({find_family("unnamed_waves_from"),
                         flank,
                         {face, times * wavelength_mm,
                          face != 0.0 ? at : 2.0 * geometry.on_flank(1, 1, at, 0.0).radius_mm, end,
                          kComeUp * wavelength_mm}});
      }
      for (const double within : {0.15, 0.3, 0.6, 1.2})
        parts.push_back({find_family("unnamed_waves_dying"),
                         flank,
                         {face, times * wavelength_mm, within * std::abs(range), end}});
      parts.push_back(
          {find_family("unnamed_waves_growing"), flank, {face, times * wavelength_mm, end}});
    }
  for (const double times : {0.96, 1.0, 1.04})
    for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9})
      for (const double half : {0.09, 0.15, 0.25}) {
        const double at = low + share * range;
        EffectShape shape{face, times * wavelength_mm,
                          face != 0.0 ? at : 2.0 * geometry.on_flank(1, 1, at, 0.0).radius_mm,
                          half * std::abs(range)};
        if (is_burst(shape))
          parts.push_back({find_family("unnamed_waves_burst"), flank, std::move(shape)});
      }
  for (const double times : {0.75, 0.85, 0.93, 1.0, 1.08, 1.18, 1.33})
    for (const double change : {-0.5, -0.35, -0.2, -0.1, 0.1, 0.2, 0.35, 0.5})
      parts.push_back(
          {find_family("unnamed_waves_changing"), flank, {face, times * wavelength_mm, change}});
  return parts;
}

}  // namespace trueflank::loop::gear_effects
