// SPDX-License-Identifier: GPL-3.0-or-later
// A ridge or groove in a straight line aslant over the flanks, the same on every tooth, or around
// the gear as it rises: a scratch, the way of a tool, the seam of a print.
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

/// Shape values [mm]: its height in the middle of the profile, towards 0 deg; how much higher it is
/// at the tip than at the root; how much higher it is a turn on, counter-clockwise (0: the same on
/// every tooth); its width; and where it begins and ends, in turns on from that place [1].
enum SlantedRidge : std::size_t { kHeight, kOverProfile, kPerTurn, kWidth, kFrom, kTo };

double slanted_ridge(const FlankGeometry& g, const Place& p, const EffectShape& shape) {
  double off =
      p.z_mm - shape[kHeight] - 0.5 * shape[kOverProfile] * g.profile_coordinate(p.roll_mm);
  if (shape[kPerTurn] != 0.0) {
    const double turn = p.polar_rad / kTwoPi;
    off = off_around(off - shape[kPerTurn] * (turn - std::floor(turn)), std::abs(shape[kPerTurn]));
  }
  if (shape[kPerTurn] != 0.0) {
    const double turns = (p.z_mm - off - shape[kHeight]) / shape[kPerTurn];
    if (turns < shape[kFrom] || turns > shape[kTo]) return 0.0;
  }
  return bell(off, shape[kWidth]);
}

double height_after(const EffectShape& shape, double turns) {
  return shape[kHeight] + turns * shape[kPerTurn];
}
/// Ends on the face.
bool is_ended(const FlankGeometry& g, const EffectShape& shape) {
  const double one = height_after(shape, shape[kFrom]), other = height_after(shape, shape[kTo]);
  return std::min(one, other) > 0.0 || std::max(one, other) < g.face_width_mm();
}

/// Where a line aslant leaves the flank towards the root (-1) or the tip (1).
std::string end_of_line(const FlankGeometry& g, const EffectShape& shape, double end) {
  const double height = shape[kHeight] + 0.5 * shape[kOverProfile] * end, face = g.face_width_mm();
  if (height >= 0.0 && height <= face)
    return printed("a height of %.3g mm", height) + (end < 0.0 ? " at the root" : " at the tip");
  const bool lower = height < 0.0;
  const double share =
      0.5 * (1.0 + ((lower ? 0.0 : face) - shape[kHeight]) / (0.5 * shape[kOverProfile]));
  return printed("a diameter of %.5g mm", diameter_at_roll_share(g, std::clamp(share, 0.0, 1.0))) +
         (lower ? " at the lower end" : " at the upper end");
}

/// A line aslant of which most lies off the flanks is what stands at a corner.
bool is_off_the_flanks(const FlankGeometry& g, const EffectShape& shape) {
  constexpr double kMostlyOn = 0.35;
  const double half = 0.5 * std::abs(shape[kOverProfile]);
  const double on =
      std::min(shape[kHeight] + half, g.face_width_mm()) - std::max(shape[kHeight] - half, 0.0);
  return shape[kPerTurn] == 0.0 && on < kMostlyOn * 2.0 * half;
}

std::vector<EffectShape> ridges_beside(const FlankGeometry& g, const EffectShape& shape) {
  const double face = g.face_width_mm();
  std::vector<EffectShape> shapes;
  const auto add = [&](std::size_t k, double value) {
    shapes.push_back(shape);
    shapes.back()[k] = value;
  };
  for (const double share : {0.05, 0.02, 0.007, 0.002})
    for (const double sign : {-1.0, 1.0}) {
      add(kHeight, shape[kHeight] + sign * share * face);
      if (shape[kPerTurn] == 0.0)
        add(kOverProfile, shape[kOverProfile] + 2.0 * sign * share * face);
      if (shape[kPerTurn] == 0.0) continue;
      // The line in the middle of the face stays.
      const double turns = (0.5 * face - shape[kHeight]) / shape[kPerTurn];
      const double per_turn = shape[kPerTurn] * (1.0 + sign * share);
      add(kPerTurn, per_turn);
      shapes.back()[kHeight] = 0.5 * face - turns * per_turn;
    }
  for (const double times : {0.7, 0.85, 0.95, 1.05, 1.18, 1.43}) add(kWidth, times * shape[kWidth]);
  std::erase_if(shapes, [&](const EffectShape& beside) { return is_off_the_flanks(g, beside); });
  if (shape[kPerTurn] == 0.0) return shapes;
  for (const std::size_t end : {kFrom, kTo})
    for (const double turns : {-0.3, -0.1, -0.03, -0.01, -0.003, 0.003, 0.01, 0.03, 0.1, 0.3})
      add(end, shape[end] + turns);
  return shapes;
}

}  // namespace

EffectFamily unnamed_slanted_ridge() {
  EffectFamily f = described(
      "unnamed_slanted_ridge",
      {"height_mm", "over_profile_mm", "per_turn_mm", "width_mm", "from_turns", "to_turns"});
  f.one_flank_too = true;
  f.is_followed_nearly = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank ? slanted_ridge(g, p, shape) : 0.0;
  };
  f.same_on_every_tooth = [](const EffectShape& shape) { return shape[kPerTurn] == 0.0; };
  f.needs = [](const EffectShape& shape) {
    const bool crossed = shape[kOverProfile] != 0.0;
    return NeedsToBeSeen{.along_profile = crossed, .along_face = true, .crossed = crossed};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = ridges_beside;
  f.values_sought = [](const EffectShape& shape) { return shape[kPerTurn] == 0.0 ? 3 : 5; };
  f.term_keys = {number("height_mm"), number("over_profile_mm"), number("per_turn_mm"),
                 number("width_mm"),  number("from_turns"),      number("to_turns")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const FlankGeometry& g = told.geometry;
    const std::string wide = within(g, 1.0, shape[kWidth], "", " to either side");
    if (shape[kPerTurn] == 0.0)
      return "the same on every tooth, " + a_ridge(told.sign()) +
             " in a line aslant over the flanks, from " + end_of_line(g, shape, -1.0) + " to " +
             end_of_line(g, shape, 1.0) + ", " + wide +
             " (in height), as from a scratch or the way of a tool";
    double height = std::fmod(shape[kHeight], std::abs(shape[kPerTurn]));
    if (height < 0.0) height += std::abs(shape[kPerTurn]);
    return a_ridge(told.sign()) + " that runs around the gear as it rises, by " +
           printed("%.3g mm a turn ", std::abs(shape[kPerTurn])) +
           (shape[kPerTurn] > 0.0 ? "counter-clockwise" : "clockwise") +
           printed(", at a height of %.3g mm towards 0 deg", height) +
           (height + std::abs(shape[kPerTurn]) < g.face_width_mm() ? " and so much higher a turn on"
                                                                   : "") +
           ", " + wide +
           (is_ended(g, shape)
                ? printed(", from a height of %.3g mm",
                          std::clamp(height_after(shape, shape[kFrom]), 0.0, g.face_width_mm())) +
                      printed(" to one of %.3g mm",
                              std::clamp(height_after(shape, shape[kTo]), 0.0, g.face_width_mm()))
                : "") +
           ", as from the seam of a print or the way of a tool";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
