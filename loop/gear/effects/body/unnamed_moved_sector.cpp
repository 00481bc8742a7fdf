// SPDX-License-Identifier: GPL-3.0-or-later
// What is moved by where it lies around the gear: some teeth, views of a scan, a radius that drifts
// while it is scanned or made.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

double from_0_to_360(double deg) { return deg - 360.0 * std::floor(deg / 360.0); }

/// Of a whole turn, counter-clockwise from a direction to where a point lies.
double share_of_turn(const Place& p, double from_deg) {
  const double turns = (p.polar_rad - rad_from_deg(from_deg)) / kTwoPi;
  return turns - std::floor(turns);
}

/// The same form from a direction moved a little.
std::vector<EffectShape> directions_beside(const EffectShape& shape, std::size_t from) {
  std::vector<EffectShape> shapes;
  for (const double off : {-3.0, -1.0, -0.3, -0.1, 0.1, 0.3, 1.0, 3.0}) {
    shapes.push_back(shape);
    shapes.back()[from] += off;
  }
  return shapes;
}

}  // namespace

/// Found around the gear (moved_sector.h), and no candidate of its own.
EffectFamily unnamed_moved_sector() {
  EffectFamily f = described("unnamed_moved_sector", {"first_tooth", "teeth"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const int z = g.teeth(), from = static_cast<int>(shape[0]);
    const bool on = ((p.tooth - from) % z + z) % z < static_cast<int>(shape[1]);
    two_directions(g, p, on ? 1.0 : 0.0, c);
  };
  f.faces_a_direction = true;
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    // All but a few teeth aside are the gear off its bore, beside these.
    constexpr double kMost = 0.75;
    std::vector<EffectShape> shapes;
    for (const double first : {-1.0, 0.0, 1.0})
      for (const double last : {-1.0, 0.0, 1.0}) {
        const EffectShape beside{std::fmod(shape[0] - 1.0 + first + g.teeth(), g.teeth()) + 1.0,
                                 shape[1] + last - first};
        if (beside != shape && beside[1] >= 2.0 && beside[1] <= kMost * g.teeth())
          shapes.push_back(beside);
      }
    return shapes;
  };
  f.term_keys = {{"first_tooth"}, {"teeth"}};
  f.words = [](const ToldForm& told) {
    return printed("%.0f teeth from tooth %.0f on stand aside as one body", told.shape[1],
                   told.shape[0]) +
           in_direction(told.direction_rad()) +
           ", as where two views of a scan, halves of a mould or two clampings do not meet";
  };
  return f;
}

/// Points of a scan towards some directions, whatever teeth they are on: the edge of a view runs
/// through teeth. Told in place of moved teeth (part/sectors.cpp), and no candidate of its own.
EffectFamily unnamed_moved_part() {
  EffectFamily f = described("unnamed_moved_part", {"from_deg", "over_deg"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const double off = p.polar_rad - rad_from_deg(shape[0]);
    const bool on = off - kTwoPi * std::floor(off / kTwoPi) < rad_from_deg(shape[1]);
    two_directions(g, p, on ? 1.0 : 0.0, c);
  };
  f.faces_a_direction = true;
  f.is_followed_nearly = true;  // (patches of a scan do not end at its edges)
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    const double pitch_deg = 360.0 / g.teeth();
    std::vector<EffectShape> shapes;
    for (const double share : {0.25, 0.1, 0.03, 0.01})
      for (const double sign : {-1.0, 1.0}) {
        const double off = sign * share * pitch_deg;
        shapes.push_back({shape[0] + off, shape[1] - off});
        shapes.push_back({shape[0], shape[1] + off});
      }
    return shapes;
  };
  f.term_keys = {number("from_deg"), number("over_deg")};
  f.words = [](const ToldForm& told) {
    return printed("all points from %.4g deg to %.4g deg stand aside as one body",
                   from_0_to_360(told.shape[0]), from_0_to_360(told.shape[0] + told.shape[1])) +
           in_direction(told.direction_rad()) +
           ", as where two views of a scan do not meet: the edge runs through teeth";
  };
  return f;
}

/// So many views of a scan, evenly spaced, each moved outwards by an amount of its own: how many,
/// from where on, and what each has, of a mean square of 1. Told in place of what goes around the
/// gear (part/body/body_forms.cpp), and no candidate of its own.
EffectFamily unnamed_views() {
  constexpr std::size_t kValues = 2;
  EffectFamily f = described("unnamed_views", {"number", "from_deg", "pattern"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const std::size_t views = shape.size() - kValues;
    const auto view = static_cast<std::size_t>(share_of_turn(p, shape[1]) * double(views));
    c[0] = shape[kValues + std::min(view, views - 1)] *
           normal_part(g, p, p.polar_direction[0], p.polar_direction[1]);
  };
  f.faces_a_direction = true;
  f.is_followed_nearly = true;  // (patches of a scan do not end at its edges)
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    return directions_beside(shape, 1);
  };
  f.values_sought = [](const EffectShape& shape) {
    return static_cast<int>(shape.size() - kValues);
  };
  f.term_keys = {{"number"}, number("from_deg"), {"pattern", TermKey::Kind::kNumbers}};
  f.words = [](const ToldForm& told) {
    const std::size_t views = told.shape.size() - kValues;
    std::string text =
        printed("%.0f views of a scan, each of ", double(views)) +
        printed("%.4g deg", 360.0 / double(views)) +
        printed(
            ", the first from %.4g deg on, each moved outwards or inwards by an amount of its "
            "own",
            from_0_to_360(told.shape[1]));
    if (told.amounts.size() == 1)
      for (std::size_t k = 0; k < views; ++k)
        text += (k == 0           ? ": "
                 : k + 1 == views ? " and "
                                  : ", ") +
                printed("%.3g", told.amounts[0] * told.shape[kValues + k]);
    return text + (told.amounts.size() == 1 ? " um of radius, + is outwards" : "") +
           ", as where views are not put together well";
  };
  return f;
}

/// A radius that drifts evenly once around, counter-clockwise from a direction on, and jumps back
/// there: what warms up while it is scanned or made; or (`moved` 1) all walls along their normals:
/// the offset of a wire. `zero_at`: of no mean over the turn, nothing where it begins, or nothing
/// where it ends. Found before anything else (part/spirals.h), or told as views are.
EffectFamily unnamed_spiral() {
  EffectFamily f = described("unnamed_spiral", {"from_deg", "zero_at", "moved"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const double nothing = shape[1] == kMeanOfDrift ? 0.5 : shape[1] == kFirstOfDrift ? 0.0 : 1.0;
    const double worth = shape[2] == 0.0
                             ? normal_part(g, p, p.polar_direction[0], p.polar_direction[1])
                         : p.surface == Surface::kFlank ? 1.0
                                                        : 0.0;
    c[0] = (share_of_turn(p, shape[0]) - nothing) * worth;
  };
  f.is_drift = true;
  f.faces_a_direction = true;
  f.is_followed_nearly = true;
  f.nearby = [](const FlankGeometry&, const EffectShape& shape) {
    return directions_beside(shape, 0);
  };
  f.values_sought = [](const EffectShape&) { return 1; };
  f.term_keys = {number("from_deg"),
                 {"zero_at", TermKey::Kind::kWord, {"mean", "beginning", "end"}},
                 {"moved", TermKey::Kind::kWord, {"outwards", "along_normal"}}};
  f.words = [](const ToldForm& told) {
    const int sign = told.sign();
    const bool walls = told.shape[2] != 0.0;
    const std::string by = sign == 0 ? "" : printed(" by %.3g um", std::abs(told.amounts[0]));
    return printed("from %.4g deg on, once around towards larger angles, ",
                   from_0_to_360(told.shape[0])) +
           (walls ? "all walls drift evenly" + by +
                        (sign < 0   ? ", towards less material"
                         : sign > 0 ? ", towards more material"
                                    : "")
                  : std::string("the radius ") +
                        (sign < 0   ? "shrinks"
                         : sign > 0 ? "grows"
                                    : "grows or shrinks") +
                        " evenly" + by) +
           (told.shape[1] == kMeanOfDrift    ? ""
            : told.shape[1] == kFirstOfDrift ? ", from nothing at its beginning"
                                             : ", to nothing at its end") +
           (walls ? ", and jump back, as where the offset of a wire or tool drifts along its way"
                  : ", and jumps back, as where table or part warm up while it is scanned or made");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
