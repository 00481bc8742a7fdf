// SPDX-License-Identifier: GPL-3.0-or-later
// What one tooth or one gap has as a whole: a tooth bent from its root on, thicker towards its tip
// or swollen between its ends, or that stands aside; a gap whose two walls stand out, or aside.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/one_tooth.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

/// Shape values of a bent tooth: where the form is nothing is -1 (root, lower end), 1 (tip, upper
/// end), or 0 (both).
enum BentTooth : std::size_t { kBentTooth, kBentAlong, kNothingAt, kBentDegree, kBentOpposite };

double bent_from_an_end(const FlankGeometry& g, const Place& p, const EffectShape& shape) {
  const double across =
      shape[kBentAlong] != 0.0 ? g.face_coordinate(p.z_mm) : g.profile_coordinate(p.roll_mm);
  const double turned = shape[kBentOpposite] != 0.0 ? p.side : 1.0;
  if (shape[kNothingAt] == 0.0) return turned * (1.0 - across * across);
  const double way = std::max(0.0, 0.5 * (1.0 - shape[kNothingAt] * across));
  return turned * (shape[kBentDegree] == 1.0 ? way : way * way);
}

std::string end_of_tooth(double along, double end) {
  if (along != 0.0) return end < 0.0 ? "lower end" : "upper end";
  return end < 0.0 ? "root" : "tip";
}

std::string words_of_bent_tooth(const ToldForm& told) {
  const EffectShape& shape = told.shape;
  const double along = shape[kBentAlong], nothing = shape[kNothingAt];
  const int sign = told.sign();
  const std::string size = told.amounts.size() == 1 && std::isfinite(told.amounts[0])
                               ? printed("%.3g um", std::abs(told.amounts[0]))
                               : "most";
  std::string text = printed("tooth %.0f alone ", shape[kBentTooth]);
  if (nothing == 0.0) {
    text += shape[kBentOpposite] != 0.0 ? "is bowed aside" + (sign == 0 ? "" : ", " + turned(sign))
            : sign == 0                 ? std::string("is swollen or hollow")
                                        : std::string(sign > 0 ? "is swollen" : "is hollow");
    return text + ": nothing at the " + end_of_tooth(along, -1.0) + " and the " +
           end_of_tooth(along, 1.0) + ", " + size + " between them";
  }
  const std::string other = end_of_tooth(along, -nothing);
  if (shape[kBentOpposite] != 0.0)
    text += "is bent" + (sign == 0 ? "" : " " + turned(sign));
  else if (told.flank != FlankChoice::kBoth)
    text += stands(sign) + " more and more towards the " + other;
  else
    text += "is " +
            std::string(sign == 0  ? "thicker or thinner"
                        : sign > 0 ? "thicker"
                                   : "thinner") +
            " towards the " + other;
  return text + ": nothing at the " + end_of_tooth(along, nothing) + ", " + size + " at the " +
         other + (shape[kBentDegree] == 1.0 ? "" : ", by the square of the way");
}

/// Shape values of a patch of teeth.
enum PatchOfTeeth : std::size_t {
  kPatchTooth,
  kPatchTeeth,
  kPatchDiameter,
  kPatchProfile,
  kPatchHeight,
  kPatchFace
};

double roll_range(const FlankGeometry& g) {
  return std::abs(g.tip_form_roll_mm() - g.root_form_roll_mm());
}

/// A patch moved a little, wider or narrower.
std::vector<EffectShape> patches_beside(const FlankGeometry& g, const EffectShape& shape) {
  constexpr double kLeastTeeth = 0.6, kNarrowest = 0.06, kWidest = 1.0;  // of profile or face
  std::vector<EffectShape> shapes;
  const auto add = [&](std::size_t k, double value) {
    shapes.push_back(shape);
    shapes.back()[k] = value;
  };
  for (const double off : {-0.5, -0.15, -0.05, 0.05, 0.15, 0.5}) add(kPatchTooth, shape[0] + off);
  const auto [low, high] = std::minmax({g.root_form_roll_mm(), g.tip_form_roll_mm()});
  for (const double share : {-0.1, -0.03, -0.01, 0.01, 0.03, 0.1}) {
    const double roll =
        std::clamp(stands_at(g, 0.0, shape[kPatchDiameter]) + share * roll_range(g), low, high);
    add(kPatchDiameter, 2.0 * g.on_flank(1, 1, roll, 0.0).radius_mm);
    add(kPatchHeight,
        std::clamp(shape[kPatchHeight] + share * g.face_width_mm(), 0.0, g.face_width_mm()));
  }
  for (const double times : {0.7, 0.88, 0.96, 1.04, 1.14, 1.43}) {
    add(kPatchTeeth, std::clamp(times * shape[kPatchTeeth], kLeastTeeth, 0.25 * g.teeth()));
    add(kPatchProfile, std::clamp(times * shape[kPatchProfile], kNarrowest * roll_range(g),
                                  kWidest * roll_range(g)));
    add(kPatchFace, std::clamp(times * shape[kPatchFace], kNarrowest * g.face_width_mm(),
                               kWidest * g.face_width_mm()));
  }
  return shapes;
}

std::string words_of_patch(const ToldForm& told) {
  const EffectShape& shape = told.shape;
  const double z = told.geometry.teeth(), middle = shape[kPatchTooth] - 1.0;
  return a_swelling(told.sign()) + " over a few teeth about tooth " +
         printed("%.1f, ", middle - z * std::floor(middle / z) + 1.0) +
         printed("%.1f teeth to either side, ", shape[kPatchTeeth]) +
         printed("at a diameter of %.5g mm", shape[kPatchDiameter]) +
         printed(" and a height of %.3g mm, ", shape[kPatchHeight]) +
         printed("%.2g mm of roll length to either side and ", shape[kPatchProfile]) +
         printed("%.2g mm of the face to either side", shape[kPatchFace]);
}

}  // namespace

EffectFamily unnamed_bent_tooth() {
  EffectFamily f = described("unnamed_bent_tooth",
                             {"tooth", "along", "nothing_at", "degree", "opposite_flanks"});
  f.is_of_one_tooth = true;
  set_columns(f, {[](const FlankGeometry&, int tooth, const EffectShape& shape, double* factor) {
                    factor[0] = tooth == static_cast<int>(shape[kBentTooth]) ? 1.0 : 0.0;
                  },
                  bent_from_an_end});
  f.needs = [](const EffectShape& shape) {
    return NeedsToBeSeen{.along_profile = shape[kBentAlong] == 0.0,
                         .along_face = shape[kBentAlong] != 0.0};
  };
  f.term_keys = {{"tooth"},
                 kAlong,
                 {"nothing_at"},
                 {"degree"},
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = words_of_bent_tooth;
  return f;
}

std::vector<EffectShape> shapes_of_bent_tooth(int tooth, bool both_flanks) {
  std::vector<EffectShape> shapes;
  for (const double degree : {1.0, 2.0})
    for (const double along : {0.0, 1.0})
      for (const double nothing : {-1.0, 1.0, 0.0})
        for (const double opposite : {0.0, 1.0}) {
          if ((opposite != 0.0 && !both_flanks) || (nothing == 0.0 && degree == 1.0)) continue;
          shapes.push_back({static_cast<double>(tooth), along, nothing, degree, opposite});
        }
  return shapes;
}

EffectFamily unnamed_gap() {
  EffectFamily f = described("unnamed_gap", {"gap_after_tooth", "opposite_flanks"});
  const auto wall = [](const FlankGeometry& g, int tooth, int side, const EffectShape& shape) {
    const int since = teeth_since(g, tooth, shape[0]);
    return (side > 0 && since == 0) || (side < 0 && since == 1);
  };
  f.evaluate = [wall](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank && wall(g, p.tooth, p.side, shape)
               ? (shape[1] != 0.0 ? p.side : 1.0)
               : 0.0;
  };
  f.term_keys = {{"gap_after_tooth"}, {"walls", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const double z = told.geometry.teeth();
    const int sign = told.sign();
    const std::string gap = printed("the gap between teeth %.0f and ", told.shape[0]) +
                            printed("%.0f ", std::fmod(told.shape[0], z) + 1.0);
    if (told.shape[1] != 0.0)
      return gap + "stands aside" + (sign == 0 ? "" : ", " + turned(sign)) +
             ": one of its walls stands out, the other lies back";
    if (sign == 0) return gap + "has another width than the others";
    return gap +
           (sign > 0
                ? "alone is too narrow, as one that was not cut to depth: both its walls stand "
                  "out"
                : "alone is too wide, as one that was cut too deep: both its walls lie back");
  };
  return f;
}

EffectFamily unnamed_swelling_over_teeth() {
  EffectFamily f = described(
      "unnamed_swelling_over_teeth",
      {"tooth", "half_teeth", "diameter_mm", "half_profile_mm", "height_mm", "half_face_mm"});
  f.one_flank_too = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    constexpr double kNothing = 3.0;  // half widths
                    const double off = std::remainder(tooth - shape[kPatchTooth], g.teeth());
                    factor[0] = std::abs(off) < kNothing * shape[kPatchTeeth]
                                    ? bell(off, shape[kPatchTeeth])
                                    : 0.0;
                  },
                  [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                    return bell(p.roll_mm - stands_at(g, 0.0, shape[kPatchDiameter]),
                                shape[kPatchProfile]) *
                           bell(p.z_mm - shape[kPatchHeight], shape[kPatchFace]);
                  }});
  f.needs = [](const EffectShape&) {
    return NeedsToBeSeen{.along_profile = true, .along_face = true, .crossed = true};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = patches_beside;
  f.term_keys = {number("tooth"),           number("half_teeth"), number("diameter_mm"),
                 number("half_profile_mm"), number("height_mm"),  number("half_face_mm")};
  f.words = words_of_patch;
  return f;
}

std::vector<EffectShape> patches_about(const FlankGeometry& geometry, double tooth,
                                       double diameter_mm, double height_mm) {
  std::vector<EffectShape> shapes;
  for (const double teeth : {0.9, 1.4, 2.2})
    for (const double profile : {0.12, 0.22, 0.4})
      for (const double face : {0.12, 0.22, 0.4})
        shapes.push_back({tooth, teeth, diameter_mm, profile * roll_range(geometry), height_mm,
                          face * geometry.face_width_mm()});
  return shapes;
}

EffectFamily unnamed_tooth_aside() {
  EffectFamily f;
  f.id = "unnamed_tooth_aside";
  f.description = "one tooth stands aside";
  f.parameters = {"amount_um"};
  f.shape_names = {"tooth", "aside"};
  f.named = false;
  f.term_keys = {{"tooth"}, {"aside"}};
  f.local = true;
  f.preference = 3;
  f.correctable = Correctable::kNoCause;
  f.shapes = [](const FlankGeometry& g) {
    constexpr double kCounterClockwise = 1.0;
    std::vector<EffectShape> shapes = whole_numbers(1, g.teeth());
    for (EffectShape& shape : shapes) shape.push_back(kCounterClockwise);
    return shapes;
  };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank && p.tooth == static_cast<int>(shape[0]) ? shape[1] * p.side
                                                                                 : 0.0;
  };
  f.words = [](const ToldForm& told) {
    const int sign = told.sign() * (told.shape[1] < 0.0 ? -1 : 1);
    return "tooth " + std::to_string(static_cast<int>(told.shape[0])) + " stands aside, " +
           (sign == 0 ? "ahead on one flank and back on the other" : turned(sign));
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
