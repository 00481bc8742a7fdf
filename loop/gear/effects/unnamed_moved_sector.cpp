// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {

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
    const auto turned = [](double deg) { return deg - 360.0 * std::floor(deg / 360.0); };
    return printed("all points from %.4g deg to %.4g deg stand aside as one body",
                   turned(told.shape[0]), turned(told.shape[0] + told.shape[1])) +
           in_direction(told.direction_rad()) +
           ", as where two views of a scan do not meet: the edge runs through teeth";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
