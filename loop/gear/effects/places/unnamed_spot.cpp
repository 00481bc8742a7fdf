// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

// Spots of one tooth and dents of a few: where material stands out or lies back.
namespace trueflank::loop::gear_effects {
namespace {

/// The width of a spot over the profile, along the flank, as a length of roll.
double roll_of_width(const FlankGeometry& g, const EffectShape& shape) {
  return shape[3] / along_profile(g, g.roll_at_radius_mm(0.5 * shape[1]));
}

/// A spot moved a little, or wider or narrower, where it has a place.
std::vector<EffectShape> spots_beside(const FlankGeometry& g, const EffectShape& shape) {
  std::vector<EffectShape> shapes;
  const auto add = [&](std::size_t k, double value) {
    shapes.push_back(shape);
    shapes.back()[k] = value;
  };
  const double roll = stands_at(g, 0.0, shape[1]);
  const auto [low, high] = std::minmax({g.root_form_roll_mm(), g.tip_form_roll_mm()});
  for (const double share : {-0.25, -0.1, -0.04, 0.04, 0.1, 0.25}) {
    if (shape[3] > 0.0)
      add(1,
          2.0 * g.on_flank(1, 1, std::clamp(roll + share * roll_of_width(g, shape), low, high), 0.0)
                    .radius_mm);
    if (shape[4] > 0.0) add(2, std::clamp(shape[2] + share * shape[4], 0.0, g.face_width_mm()));
  }
  for (const std::size_t k : {3U, 4U})
    for (const double times : {0.7, 0.88, 1.14, 1.43})
      if (shape[k] > 0.0) add(k, times * shape[k]);
  // Steep or soft: not alike where they follow the same values.
  for (const double times : {0.85, 1.0, 1.2})
    for (const double share : {-0.12, 0.0, 0.12}) {
      if (shape[4] == 0.0 && share != 0.0) continue;
      const double height = shape[4] > 0.0
                                ? std::clamp(shape[2] + share * shape[4], 0.0, g.face_width_mm())
                                : shape[2];
      shapes.push_back(
          {shape[0], shape[1], height, times * shape[3], times * shape[4], 1.0 - shape[5]});
    }
  return shapes;
}

/// Flat at its place and nothing beyond twice the width: of a burr, which ends.
double plateau(double off, double width) {
  const double square = off * off / (width * width);
  return std::exp(-square * square);
}

/// A bell that ends, at 2.2 times the half width: what is next to nothing far off, where other
/// traces run, would be learnt there.
double hill(double off, double half) {
  constexpr double kEnd = 2.2;
  const double inside = 1.0 - off * off / (kEnd * kEnd * half * half);
  return inside > 0.0 ? inside * inside * inside * inside : 0.0;
}

}  // namespace

namespace {

/// " over a few teeth about tooth 5, about 3 teeth to either side"
std::string about_tooth(int teeth, double tooth, double half_teeth) {
  constexpr double kHardlyBeside = 0.75;  // (the teeth beside have a sixth of it, or less)
  const double z = teeth, whole = std::round(tooth) - 1.0;
  const std::string about = printed("tooth %.0f", whole - z * std::floor(whole / z) + 1.0);
  if (half_teeth < kHardlyBeside) return " at " + about + ", hardly at those beside it";
  if (2.0 * half_teeth >= z) return " around the gear, most about " + about;
  const double beside = std::round(half_teeth);
  return " over a few teeth about " + about +
         (beside == 1.0 ? ", a tooth to either side"
                        : printed(", %.0f teeth to either side", beside));
}

}  // namespace

EffectFamily unnamed_dent() {
  EffectFamily f = described("unnamed_dent", {"tooth", "half_teeth", "height_mm", "half_mm"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double z = g.teeth();
    const double off = off_around(p.tooth - shape[0], z);
    c[0] = bell(off, shape[1]) * (shape[3] > 0.0 ? bell(p.z_mm - shape[2], shape[3]) : 1.0);
  };
  f.term_keys = {number("tooth"), number("half_teeth"), number("height_mm"), number("half_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return a_swelling(told.sign()) + about_tooth(told.geometry.teeth(), shape[0], shape[1]) +
           (shape[3] > 0.0
                ? printed(", at a height of %.3g mm, ", shape[2]) +
                      within(told.geometry, 1.0, shape[3], "", " of the face to either side")
                : "");
  };
  return f;
}

EffectFamily unnamed_swellings() {
  EffectFamily f = described("unnamed_swellings", {"number", "tooth", "half_teeth"});
  f.is_followed_nearly = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double z = g.teeth();
    for (int k = 0; k < static_cast<int>(shape[0]); ++k)
      c[0] += bell(off_around(p.tooth - shape[1] - k * z / shape[0], z), shape[2]);
  };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    const double apart = g.teeth() / shape[0];
    for (const double off : {-0.5, -0.15, -0.04, 0.0, 0.04, 0.15, 0.5})
      for (const double times : {0.8, 0.93, 0.98, 1.0, 1.02, 1.07, 1.25}) {
        EffectShape beside = shape;
        beside[1] = std::fmod(shape[1] - 1.0 + off * shape[2] + apart, apart) + 1.0;
        beside[2] = std::clamp(times * shape[2], 0.5, 0.5 * apart);
        if (beside != shape) shapes.push_back(std::move(beside));
      }
    return shapes;
  };
  f.term_keys = {{"number"}, number("tooth"), number("half_teeth")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const int sign = told.sign();
    return printed("%.0f ", shape[0]) +
           (sign > 0   ? "swellings"
            : sign < 0 ? "hollows"
                       : "swellings or hollows") +
           " evenly spaced around the gear, one" +
           about_tooth(told.geometry.teeth(), shape[1], shape[2]) +
           ", as from gates, ribs, bolts or jaws";
  };
  return f;
}

namespace {

/// What a spot covers of the profile or the face: as far as the flank goes.
struct Covered {
  double low = 0.0, high = 0.0, range = 0.0;
  bool from_low = false, to_high = false;

  Covered(double at, double width, double from, double to)
      : low(std::max(from, at - 0.5 * width)),
        high(std::max(low, std::min(to, at + 0.5 * width))),
        range(to - from) {
    constexpr double kEnd = 0.02;  // of the flank, which no measurement comes nearer to
    from_low = low - from < kEnd * range;
    to_high = to - high < kEnd * range;
  }
  [[nodiscard]] double share() const { return (high - low) / range; }
  [[nodiscard]] bool is_whole() const { return share() >= 0.85; }
};

/// Where a spot stands over the face, or over the profile; `length_mm` along the flank.
std::string place_of_spot(const FlankGeometry& g, double face, const Covered& covered,
                          double place_mm, double length_mm) {
  const std::string length = printed("%.2g mm", length_mm);
  if (covered.is_whole()) return face != 0.0 ? ", over the whole face" : ", over the whole profile";
  if (covered.from_low || covered.to_high) {
    if (face != 0.0)
      return (covered.to_high ? ", over the upper " : ", over the lower ") + length +
             " of the face";
    return ", over the " + length + (covered.to_high ? " below the tip" : " above the root");
  }
  return ", " + at_place(g, face, place_mm) + ", " + length + " " + over(face);
}

/// A pit or lump; what covers much of the flank is a part of it.
std::string spot_in_words(const ToldForm& told) {
  constexpr double kPart = 0.4;  // of the profile or the face
  const EffectShape& shape = told.shape;
  const FlankGeometry& g = told.geometry;
  std::string where;
  double most = 0.0;
  bool all_over = shape[3] > 0.0 && shape[4] > 0.0;
  if (shape[3] > 0.0) {
    // (of a ring the roll falls from the root to the tip)
    const double root = g.root_form_roll_mm(), tip = g.tip_form_roll_mm(),
                 turn = tip < root ? -1.0 : 1.0, roll = stands_at(g, 0.0, shape[1]),
                 width = roll_of_width(g, shape);
    const Covered covered(turn * roll, width, turn * root, turn * tip);
    where +=
        place_of_spot(g, 0.0, covered, shape[1], (covered.high - covered.low) / width * shape[3]);
    most = covered.share();
    all_over = all_over && covered.is_whole();
  }
  if (shape[4] > 0.0) {
    const Covered covered(shape[2], shape[4], 0.0, g.face_width_mm());
    where += place_of_spot(g, 1.0, covered, shape[2], covered.high - covered.low);
    most = std::max(most, covered.share());
    all_over = all_over && covered.is_whole();
  }
  const int sign = told.sign();
  const std::string flank = std::string(told.flank == FlankChoice::kLeft ? "left" : "right") +
                            printed(" flank of tooth %.0f", shape[0]);
  if (all_over) return "the " + flank + " " + stands(sign);
  if (most >= kPart)
    return std::string(sign > 0   ? "a raised"
                       : sign < 0 ? "a low"
                                  : "a raised or low") +
           " part of the " + flank + where;
  return std::string(sign > 0   ? "a lump"
                     : sign < 0 ? "a pit"
                                : "a pit or lump") +
         " on the " + flank + where;
}

}  // namespace

EffectFamily unnamed_spot() {
  EffectFamily f = described("unnamed_spot", {"tooth", "diameter_mm", "height_mm",
                                              "width_profile_mm", "width_face_mm", "edges"});
  f.flank_only = true;
  f.is_of_one_tooth = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank || p.tooth != static_cast<int>(shape[0])) return;
    const auto part = [&](double off, double half) {
      return shape[5] != 0.0 ? hill(off, half) : plateau(off, half);
    };
    // A width of 0: over all of it.
    c[0] = (shape[3] > 0.0
                ? part(p.roll_mm - stands_at(g, 0.0, shape[1]), 0.5 * roll_of_width(g, shape))
                : 1.0) *
           (shape[4] > 0.0 ? part(p.z_mm - shape[2], 0.5 * shape[4]) : 1.0);
  };
  f.nearby = spots_beside;
  f.term_keys = {{"tooth"},
                 number("diameter_mm"),
                 number("height_mm"),
                 number("width_profile_mm"),
                 number("width_face_mm"),
                 {"edges", TermKey::Kind::kWord, {"steep", "soft"}}};
  f.words = spot_in_words;
  return f;
}

}  // namespace trueflank::loop::gear_effects
