// SPDX-License-Identifier: GPL-3.0-or-later
// Many pits or lumps at random places of the flanks: pitting, pores of a print or of a sintered
// part, beads of spatter.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/places/pits_of_flanks.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {

double depth_of_pit(int hollow, double square) {
  if (square >= kEndOfPit * kEndOfPit) return 0.0;
  switch (hollow) {
    case kFlatFloor:
      return std::exp(-std::pow(square, 6.0));
    case kBowl:
      return std::max(0.0, 1.0 - square);
    default:
      return std::exp(-2.0 * square);
  }
}

namespace {

double depth_at(const FlankGeometry& g, const Place& p, const EffectShape& shape) {
  if (p.surface != Surface::kFlank) return 0.0;
  const int hollow = static_cast<int>(shape[kPitsHollow]);
  const double arc_mm = g.arc_at_roll_mm(p.roll_mm);
  double depth = 0.0;
  for (std::size_t i = kPitsValues; i + kValuesOfPit <= shape.size(); i += kValuesOfPit) {
    const double* const pit = shape.data() + i;
    if (p.tooth != static_cast<int>(pit[kPitTooth]) || p.side != static_cast<int>(pit[kPitSide]))
      continue;
    const double half = 0.5 * pit[kPitWidth], up = p.z_mm - pit[kPitHeight];
    if (std::abs(up) >= kEndOfPit * half) continue;
    const double along = arc_mm - g.arc_at_roll_mm(g.roll_at_radius_mm(0.5 * pit[kPitDiameter]));
    depth += pit[kPitDepth] * depth_of_pit(hollow, (along * along + up * up) / (half * half));
  }
  return depth;
}

/// "on the left flanks", "on both flanks", and of how many teeth.
std::string flanks_of_pits(const FlankGeometry& g, const EffectShape& shape) {
  constexpr std::size_t kFewTeeth = 6;
  std::vector<int> teeth;
  bool left = false, right = false;
  for (std::size_t i = kPitsValues; i < shape.size(); i += kValuesOfPit) {
    teeth.push_back(static_cast<int>(shape[i + kPitTooth]));
    const bool is_left = flank_of(g, g.on_flank(1, static_cast<int>(shape[i + kPitSide]),
                                                g.tip_form_roll_mm(), 0.0)) == FlankChoice::kLeft;
    (is_left ? left : right) = true;
  }
  std::sort(teeth.begin(), teeth.end());
  teeth.erase(std::unique(teeth.begin(), teeth.end()), teeth.end());
  std::string text = left && right ? " at random places of both flanks of "
                     : left        ? " at random places of the left flanks of "
                                   : " at random places of the right flanks of ";
  if (teeth.size() > kFewTeeth)
    return text + printed("%.0f of the ", static_cast<double>(teeth.size())) +
           printed("%d teeth", g.teeth());
  text += "teeth ";
  for (std::size_t i = 0; i < teeth.size(); ++i)
    text += (i == 0 ? "" : i + 1 == teeth.size() ? " and " : ", ") + std::to_string(teeth[i]);
  return text;
}

std::string words_of_pits(const ToldForm& told) {
  const EffectShape& shape = told.shape;
  const int sign = told.sign();
  const std::string one = sign > 0 ? "lump" : sign < 0 ? "pit" : "pit or lump";
  double width = 0.0;
  std::size_t deepest = kPitsValues, shallowest = kPitsValues;
  for (std::size_t i = kPitsValues; i < shape.size(); i += kValuesOfPit) {
    width += shape[i + kPitWidth] / shape[kPitsFound];
    if (shape[i + kPitDepth] > shape[deepest + kPitDepth]) deepest = i;
    if (shape[i + kPitDepth] < shape[shallowest + kPitDepth]) shallowest = i;
  }
  std::string text =
      printed("%.0f ", shape[kPitsFound]) + (sign == 0 ? "pits or lumps" : one + "s");
  if (shape[kPitsLikely] > shape[kPitsFound])
    text += printed(" (with those that too few points met about %.0f,", shape[kPitsLikely]) +
            printed(" at most about %.0f)", shape[kPitsAtMost]);
  text += printed(" of about %.2g mm", width);
  if (told.amounts.size() == 1) {
    const double um = std::abs(told.amounts[0]);
    text += printed(" and %.2g um", um) + printed(" (%.2g to", um * shape[shallowest + kPitDepth]) +
            printed(" %.2g um)", um * shape[deepest + kPitDepth]);
  }
  text += flanks_of_pits(told.geometry, shape);
  const double* const most = shape.data() + deepest;
  const bool left =
      flank_of(told.geometry, told.geometry.on_flank(1, static_cast<int>(most[kPitSide]),
                                                     told.geometry.tip_form_roll_mm(), 0.0)) ==
      FlankChoice::kLeft;
  text += std::string("; the ") + (sign > 0 ? "highest" : "deepest");
  if (told.amounts.size() == 1)
    text += printed(", %.2g um,", std::abs(told.amounts[0]) * most[kPitDepth]);
  text += std::string(" on the ") + (left ? "left" : "right") +
          printed(" flank of tooth %.0f", most[kPitTooth]) + ", " +
          at_place(told.geometry, 0.0, most[kPitDiameter]) + ", " +
          at_place(told.geometry, 1.0, most[kPitHeight]) +
          printed(", %.2g mm wide; as from ", most[kPitWidth]);
  return text + (sign > 0 ? "spatter, beads or grains that stick"
                          : "pitting, or pores of a print, a cast or a sintered part");
}

}  // namespace

EffectFamily unnamed_pits() {
  EffectFamily f =
      described("unnamed_pits", {"number", "number_likely", "number_at_most", "hollow", "pits"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = depth_at(g, p, shape);
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.values_sought = [](const EffectShape& shape) {
    return static_cast<int>(shape.size() - kPitsValues);
  };
  f.term_keys = {{"number"},
                 {"number_likely"},
                 {"number_at_most"},
                 {"hollow", TermKey::Kind::kWord, {"flat_floor", "bowl", "bell"}},
                 {"pits", TermKey::Kind::kNumbers}};
  f.words = words_of_pits;
  return f;
}

}  // namespace trueflank::loop::gear_effects
