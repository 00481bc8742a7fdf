// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/effects/columns.h"

// Forms without a name that run over the profile (0) or the face (1), the first of their shape
// values: places, ends and words of these.
namespace trueflank::loop::gear_effects {

/// Roll length or height of a place [mm], as the form runs over the profile (0) or the face (1).
[[nodiscard]] inline double along(double face, const Place& place) {
  return face != 0.0 ? place.z_mm : place.roll_mm;
}
/// Where a form stands [mm] in the same measure; over the profile a form's place is a diameter.
[[nodiscard]] inline double stands_at(const FlankGeometry& g, double face, double place_mm) {
  return face != 0.0 ? place_mm : g.roll_at_radius_mm(0.5 * place_mm);
}
[[nodiscard]] inline std::string over(double face) {
  return face != 0.0 ? "over the face" : "over the profile";
}

[[nodiscard]] inline double range_mm(const FlankGeometry& g, double face) {
  return face != 0.0 ? g.face_width_mm() : g.tip_form_roll_mm() - g.root_form_roll_mm();
}

/// The place of a form along the flank moved to either side by shares of the flank.
[[nodiscard]] inline std::vector<EffectShape> places_beside(const FlankGeometry& g,
                                                            const EffectShape& shape,
                                                            const std::vector<double>& shares = {
                                                                0.05, 0.02, 0.01, 0.005, 0.002}) {
  std::vector<EffectShape> shapes;
  const double range = range_mm(g, shape[0]), at = stands_at(g, shape[0], shape[1]);
  for (const double share : shares)
    for (const double sign : {-1.0, 1.0}) {
      const double moved = at + sign * share * range;
      EffectShape beside = shape;
      beside[1] = shape[0] != 0.0 ? moved : 2.0 * g.on_flank(1, 1, moved, 0.0).radius_mm;
      shapes.push_back(std::move(beside));
    }
  return shapes;
}

/// The end [mm] of roll or height: the lower one or the root's (-1), the upper one or the tip's
/// (1).
[[nodiscard]] inline double end_mm(const FlankGeometry& g, double face, double end) {
  if (face != 0.0) return end < 0.0 ? 0.0 : g.face_width_mm();
  return end < 0.0 ? g.root_form_roll_mm() : g.tip_form_roll_mm();
}
/// Where a form stands, 0 at the lower end or the root and 1 at the other; and its place for that.
[[nodiscard]] inline double share_at(const FlankGeometry& g, double face, double place_mm) {
  const double low = end_mm(g, face, -1.0), high = end_mm(g, face, 1.0);
  return (stands_at(g, face, place_mm) - low) / (high - low);
}
[[nodiscard]] inline double place_at(const FlankGeometry& g, double face, double share) {
  return face != 0.0 ? share * g.face_width_mm() : diameter_at_roll_share(g, share);
}
/// "a height of 4 mm", "a diameter of 30.12 mm"; a place off the flank is its end.
[[nodiscard]] inline std::string words_of_place(const FlankGeometry& g, double face,
                                                double place_mm) {
  const double share = share_at(g, face, place_mm);
  if (!(share > 0.0)) return face != 0.0 ? "the lower end" : "the root";
  if (!(share < 1.0)) return face != 0.0 ? "the upper end" : "the tip";
  return face != 0.0 ? printed("a height of %.3g mm", place_mm)
                     : printed("a diameter of %.5g mm", place_mm);
}
[[nodiscard]] inline std::string at_place(const FlankGeometry& g, double face, double place_mm) {
  return "at " + words_of_place(g, face, place_mm);
}
[[nodiscard]] inline std::string towards(double face, double end) {
  if (end == 0.0) return " to both sides";
  if (face != 0.0) return end > 0.0 ? " towards the upper end" : " towards the lower end";
  return end > 0.0 ? " towards the tip" : " towards the root";
}

/// ", 1.9 mm long" of waves.
[[nodiscard]] inline std::string long_each(double face, double length_mm) {
  return printed(", %.3g mm long", length_mm) + (face != 0.0 ? "" : " (of roll length)");
}
/// "3.6 waves over the face, 1.9 mm long"; "waves over ..." where they are longer than the flank.
[[nodiscard]] inline std::string waves_over(const FlankGeometry& g, double face, double length_mm) {
  const double waves = std::abs(range_mm(g, face)) / length_mm;
  return (waves > 1.0 ? printed("%.1f ", waves) : "") + "waves " + over(face) +
         long_each(face, length_mm);
}
/// A length along the flank to either side of a place, or to one side of an end; one that reaches
/// all over the flank is said so: "0.35 mm to either side", "over the whole face".
[[nodiscard]] inline std::string within(const FlankGeometry& g, double face, double length_mm,
                                        const std::string& before, const std::string& after) {
  if (length_mm >= std::abs(range_mm(g, face)))
    return std::string("over the whole ") + (face != 0.0 ? "face" : "profile");
  return before + printed("%.2g mm", length_mm) + (face != 0.0 ? "" : " of roll length") + after;
}

/// std::remainder, which takes longer than all else of a form, where the number is not far around.
[[nodiscard]] inline double off_around(double off, double around) {
  const double half = 0.5 * around;
  if (std::abs(off) < half) return off;
  if (off > half && off < 1.5 * around) return off - around;  // without rounding
  if (off < -half && off > -1.5 * around && off != -around) return off + around;
  return std::remainder(off, around);
}

/// 1 at its place, and dying away to both sides.
[[nodiscard]] inline double bell(double off, double width) {
  return std::exp(-off * off / (width * width));
}

/// From nothing to 1 over the length of an edge about 0 (as steep there as a straight one of that
/// length, and about as long from a tenth to nine tenths); at once without one.
[[nodiscard]] inline double beyond_edge(double off, double edge) {
  return edge > 0.0 ? 1.0 / (1.0 + std::exp(-4.0 * off / edge)) : off > 0.0 ? 1.0 : 0.0;
}

/// Nothing before a place, 1 there at once or over the length of an edge, and dying away beyond it.
[[nodiscard]] double fading_jump(double off, double dies_within, double edge);
/// 1 at its place, and dying away to either side over a length of its own.
[[nodiscard]] double skewed_bell(double off, double below, double above);
/// From one half at a jump evenly to minus one half before the next.
[[nodiscard]] double sawtooth(double off, double period);
/// A parabola of height 1 over each period, nothing where one ends and the next begins.
[[nodiscard]] double arches(double off, double period);

/// False where flanks end before the edge of a step does: that is a rise towards an end.
[[nodiscard]] bool is_step_with_edge(const FlankGeometry& g, double face, double place_mm,
                                     double edge_mm);

inline const TermKey kAlong{"along", TermKey::Kind::kWord, {"profile", "face"}};
[[nodiscard]] inline TermKey number(const std::string& name) {
  return {name, TermKey::Kind::kNumber};
}

[[nodiscard]] inline NeedsToBeSeen needs_of_direction(const EffectShape& shape) {
  return {.along_profile = shape[0] == 0.0, .along_face = shape[0] != 0.0};
}

/// A form along the flank: 1 where it acts wholly.
template <class Function>
EffectFamily along_flank(const std::string& id, std::vector<std::string> shape_names,
                         Function function) {
  EffectFamily f = described(id, std::move(shape_names));
  f.evaluate = [function](const FlankGeometry& g, const Place& p, const EffectShape& shape,
                          double* c) {
    c[0] = p.surface == Surface::kFlank ? function(g, p, shape) : 0.0;
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = needs_of_direction;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  return f;
}

/// Of a form of opposite signs on the two flanks.
[[nodiscard]] inline std::string opposite_words(bool opposite) {
  return opposite ? ", opposite on the two flanks" : "";
}

}  // namespace trueflank::loop::gear_effects
